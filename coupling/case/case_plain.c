#include "coupling/case/case_plain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    return (case_surface){ .rail = case_material(&c->materials, top ? top->material : c->rail.material),
                           .armature = case_material(&c->materials, c->projectile.material),
                           .yield_scale = top ? top->yield_scale : c->rail.yield_scale,
                           .screen_low = c->study.screen_low };
}

/* ---- an impact ---- */

case_impact case_impact_of(const breech_case *c)
{
    return (case_impact){ .rail = c->rail,
                          .armature = c->projectile,
                          .particle = c->particle,
                          .scene = c->scene,
                          .materials = c->materials,
                          .snapshots = c->output.snapshots,
                          .checkpoint_interval = c->output.checkpoint_interval };
}

static bool names_material(const case_impact *i, const char *name)
{
    for (int k = 0; k < i->rail.layers.n; k++)
        if (strcmp(i->rail.layers.item[k].material, name) == 0) return true;
    return strcmp(i->rail.material, name) == 0 || strcmp(i->armature.material, name) == 0 ||
           strcmp(i->particle.material, name) == 0;
}

/* By name, so that the order in which the case came upon them does not count. */
static int by_name(const void *a, const void *b)
{
    return strcmp(((const material *)a)->name, ((const material *)b)->name);
}

/* The materials named; out->item is owned. */
static status named_materials(const case_impact *i, case_materials *out)
{
    *out = (case_materials){ 0, calloc((size_t)i->materials.n + 1, sizeof *out->item) };
    CHECK(out->item, STATUS_MEMORY, "no memory for %d materials", i->materials.n);
    for (int k = 0; k < i->materials.n; k++)
        if (names_material(i, i->materials.item[k].name)) out->item[out->n++] = i->materials.item[k];
    qsort(out->item, (size_t)out->n, sizeof *out->item, by_name);
    return status_ok();
}

status case_impact_write(const case_impact *i, FILE *file)
{
    const case_output plain = { .snapshots = i->snapshots, .history_interval = NAN, .checkpoint_interval = 60.0 };
    breech_case one = { .name = "scene",
                        .rail = i->rail,
                        .projectile = i->armature,
                        .particle = i->particle,
                        .scene = i->scene,
                        .output = plain,
                        .given = {
                            .rail = true, .projectile = true, .particle = true, .scene = true, .output = true } };
    TRY(named_materials(i, &one.materials));
    const status done = case_write_used(&one, file);
    free(one.materials.item);
    return done;
}
