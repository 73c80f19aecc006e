#include "coupling/case/case_plain.h"

shot_config case_launcher(const breech_case *c)
{
    shot_config config = { .rails = c->rails, .barrel = c->barrel, .armature = c->armature, .options = c->options };
    for (int k = 0; k < SUPPLY_KINDS; k++) config.supplies[k] = (supply_list){ c->supplies[k].n, c->supplies[k].item };
    return config;
}

case_flight case_flight_of(const breech_case *c)
{
    return (case_flight){ .launcher = case_launcher(c),
                          .body = c->given.projectile ? &c->projectile : NULL,
                          .site = c->sites.item,
                          .n_sites = c->sites.n,
                          .history_interval = c->output.history_interval };
}

case_surface case_surface_of(const breech_case *c)
{
    const case_layers *layers = &c->rail.layers;
    const case_layer *top = layers->n > 0 ? &layers->item[layers->n - 1] : NULL;
    return (case_surface){ .rail = case_material(c, top ? top->material : c->rail.material),
                           .armature = case_material(c, c->projectile.material),
                           .yield_scale = top ? top->yield_scale : c->rail.yield_scale,
                           .screen_low = c->study.screen_low };
}
