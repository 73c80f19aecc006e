/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_plain.h"

#include "coupling/case/case.h"
#include "coupling/case/case_place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- an impact ---- */

static case_impact impact_of(const breech_case *c)
{
    return (case_impact){ .rail = c->rail,
                          .armature = c->projectile,
                          .particle = c->particle,
                          .scene = c->scene,
                          .materials = c->materials,
                          .snapshots = c->output.snapshots,
                          .checkpoint_interval = c->output.checkpoint_interval };
}

bool case_impact_is_gauged(const case_impact *i)
{
    return i->scene.stop_when_gauged && i->scene.follow;
}

static bool names_material(const void *of, const char *name)
{
    const case_impact *i = of;
    for (int k = 0; k < i->rail.layers.n; k++)
        if (strcmp(i->rail.layers.item[k].material, name) == 0) return true;
    return strcmp(i->rail.material, name) == 0 || strcmp(i->armature.material, name) == 0 ||
           strcmp(i->particle.material, name) == 0;
}

/* By name, so that the order in which the case came upon them does not count. */
static int by_name(const void *a, const void *b)
{
    return strcmp(((const mpm_material *)a)->name, ((const mpm_material *)b)->name);
}

/* Those of all that are named; out->item is owned. */
static status named_materials(const case_materials *all, bool (*named)(const void *of, const char *name),
                              const void *of, case_materials *out)
{
    *out = (case_materials){ 0, calloc((size_t)all->n + 1, sizeof *out->item) };
    CHECK(out->item, STATUS_MEMORY, "no memory for %d materials", all->n);
    for (int k = 0; k < all->n; k++)
        if (named(of, all->item[k].name)) out->item[out->n++] = all->item[k];
    qsort(out->item, (size_t)out->n, sizeof *out->item, by_name);
    return status_ok();
}

static case_output output_of(int snapshots)
{
    return (case_output){ .snapshots = snapshots, .history_interval = NAN, .checkpoint_interval = 60.0 };
}

/* Layers as a scene knows them: what wears them between shots decides nothing there.  out->item is owned. */
static status unworn_layers(const case_layers *all, case_layers *out)
{
    *out = (case_layers){ 0, NULL };
    for (int k = 0; k < all->n; k++) {
        case_layer layer = all->item[k];
        layer.wear_rate = NAN;
        TRY(case_layers_add(out, k, &layer));
    }
    return status_ok();
}

static status write_impact(const case_impact *i, const case_layers *layers, FILE *file)
{
    breech_case one = { .name = "scene",
                        .rail = i->rail,
                        .projectile = i->armature,
                        .particle = i->particle,
                        .scene = i->scene,
                        .output = output_of(i->snapshots),
                        .given = {
                            .rail = true, .projectile = true, .particle = true, .scene = true, .output = true } };
    one.rail.layers = *layers;
    TRY(named_materials(&i->materials, names_material, i, &one.materials));
    const status done = case_write_used(&one, file);
    free(one.materials.item);
    return done;
}

status case_impact_write(const case_impact *i, FILE *file)
{
    case_layers layers;
    status done = unworn_layers(&i->rail.layers, &layers);
    if (done.code == STATUS_OK) done = write_impact(i, &layers, file);
    free(layers.item);
    return done;
}

/* ---- a scene of bodies ---- */

static bool is_of_a_body(const void *of, const char *name)
{
    const mpm_scene *s = of;
    for (int i = 0; i < s->bodies; i++)
        if (strcmp(s->body[i].material->name, name) == 0) return true;
    return false;
}

status case_body_scene_write(const case_body_scene *s, FILE *file)
{
    breech_case one = { .name = "scene",
                        .bodies = *s->bodies,
                        .output = output_of(s->snapshots),
                        .given = { .bodies = true, .output = true } };
    TRY(named_materials(s->materials, is_of_a_body, &s->bodies->scene, &one.materials));
    const status done = case_write_used(&one, file);
    free(one.materials.item);
    return done;
}

case_body_scene case_body_scene_of(const case_inputs *in)
{
    return (case_body_scene){ .bodies = &in->bodies,
                              .materials = &in->onset.impact.materials,
                              .snapshots = in->output.snapshots,
                              .checkpoint_interval = in->output.checkpoint_interval };
}

/* ---- a shot over grains ---- */

static circuit_shot_config launcher_of(const breech_case *c)
{
    circuit_shot_config config = {
        .rails = c->rails, .barrel = c->barrel, .armature = c->armature, .options = c->options
    };
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++)
        config.supplies[k] = (circuit_supply_list){ c->supplies[k].n, c->supplies[k].item };
    return config;
}

static case_onset onset_of(const breech_case *c)
{
    return (case_onset){ .launcher = launcher_of(c),
                         .history_interval = c->output.history_interval,
                         .sites = c->sites,
                         .populations = c->populations,
                         .has_body = case_has_body(c),
                         .impact = impact_of(c),
                         .study = c->study };
}

case_flight case_flight_of(const case_onset *c)
{
    return (case_flight){ .launcher = c->launcher,
                          .body = c->has_body ? &c->impact.armature : NULL,
                          .site = c->sites.item,
                          .n_sites = c->sites.n,
                          .history_interval = c->history_interval };
}

case_surface case_surface_of(const case_onset *c)
{
    const mpm_material *armature = case_material(&c->impact.materials, c->impact.armature.material);
    return (case_surface){ .armature = armature,
                           .armature_hardness = c->impact.armature.yield_scale * armature->hardness,
                           .rail = c->impact.rail,
                           .materials = c->impact.materials,
                           .screen_low = c->study.screen_low };
}

/* ---- the whole ---- */

case_inputs case_inputs_of(const breech_case *c)
{
    return (case_inputs){ .name = c->name,
                          .title = c->title,
                          .path = c->path,
                          .warnings = c->warnings,
                          .given = c->given,
                          .onset = onset_of(c),
                          .optimise = c->optimise,
                          .treatments = c->treatments,
                          .bodies = c->bodies,
                          .sweep = c->sweep,
                          .strike = c->strike,
                          .targets = c->targets,
                          .life = c->life,
                          .vessel = c->vessel,
                          .output = c->output,
                          .file = c };
}

/* Takes over what was read. */
static status wrap(status read, breech_case *c, case_inputs **out)
{
    *out = NULL;
    TRY(read);
    *out = malloc(sizeof **out);
    if (!*out) case_free(c);
    CHECK(*out, STATUS_MEMORY, "no memory for a case");
    **out = case_inputs_of(c);
    return status_ok();
}

status case_inputs_read(const char *path, const char *const *sets, int n_sets, const case_options *options,
                        case_inputs **out, char **errors)
{
    breech_case *c;
    const status read = case_read(path, sets, n_sets, options, &c, errors);
    return wrap(read, c, out);
}

status case_inputs_read_memory(const case_text *text, const case_options *options, case_inputs **out, char **errors)
{
    breech_case *c;
    const status read = case_read_memory(text, options, &c, errors);
    return wrap(read, c, out);
}

void case_inputs_free(case_inputs *in)
{
    if (in) case_free((breech_case *)in->file); /* made by wrap */
    free(in);
}

void case_inputs_place(const case_inputs *in, const char *message, char *out, size_t size)
{
    case_places_find(in->file->places, message, out, size);
}

status case_inputs_write(const case_inputs *in, FILE *file)
{
    breech_case one = *in->file; /* borrows all */
    one.bodies = in->bodies;
    return case_write_used(&one, file);
}

status case_inputs_write_scene(const case_inputs *in, const mpm_scene *s, FILE *file)
{
    return case_write_scene(in->file, s, file);
}
