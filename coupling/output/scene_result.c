/* A scene's result from what solver and crater say. */
#include "coupling/output/summary.h"

#include <math.h>
#include <string.h>

static int body_named(const mpm_scene *scene, const char *name)
{
    for (int b = 0; b < scene->bodies; b++)
        if (strcmp(scene->body[b].name, name) == 0) return b;
    return -1;
}

static double of_body(const double *values, int body)
{
    return body < 0 ? NAN : values[body];
}

static void take_crater(scene_result *r, const crater *c)
{
    r->class = DAMAGE_UNDECIDED;
    r->severity = r->widening = NAN;
    r->crater_length = r->crater_width = r->crater_depth = r->crater_volume = r->rim_height = NAN;
    snprintf(r->reason, sizeof r->reason, "the crater was not measured");
    if (!c) return;
    r->class = c->class;
    snprintf(r->reason, sizeof r->reason, "%s", c->reason);
    r->severity = c->severity;
    r->widening = c->widening;
    r->crater_length = c->length;
    r->crater_width = c->width;
    r->crater_depth = c->depth;
    r->crater_volume = c->volume;
    r->rim_height = c->rim_height;
    r->crater_truncated = c->truncated;
}

/* The mirror half of a half model doubles what acts in its plane and cancels what acts across it. */
static void take_bodies(scene_result *r, const scene_outcome *o)
{
    const double halves = o->mirrored ? 2.0 : 1.0;
    const mpm_report *m = o->report;
    r->peak_force[0] = halves * m->peak_contact_force[0];
    r->peak_force[1] = halves * m->peak_contact_force[1];
    r->peak_force[2] = o->mirrored ? 0.0 : m->peak_contact_force[2];
    r->eroded_mass = halves * m->eroded_mass;
    r->bodies = o->scene->bodies;
    for (int b = 0; b < r->bodies; b++) {
        memcpy(r->body[b], o->scene->body[b].name, sizeof r->body[b]);
        r->failed_volume[b] = halves * m->failed_volume[b];
    }
    const int armature = body_named(o->scene, "armature"), rail = body_named(o->scene, "rail");
    r->peak_mises_armature = of_body(m->peak_mises, armature);
    r->peak_mises_rail = of_body(m->peak_mises, rail);
    r->peak_mises_armature_999 = of_body(m->peak_mises_999, armature);
    r->peak_mises_rail_999 = of_body(m->peak_mises_999, rail);
    r->peak_pressure_armature_999 = of_body(m->peak_pressure_999, armature);
    r->peak_pressure_rail_999 = of_body(m->peak_pressure_999, rail);
}

double output_scene_growth(const mpm_report *m)
{
    const bool whole = m->gauge_at[1] > 0.0;
    const double from = m->gauge_at[0], to = whole ? m->gauge_at[1] : m->plastic_time;
    const double power = fmax(whole ? m->gauge_power[1] : m->plastic_power, 1e-3 * m->gauge_power[0]);
    if (!(from > 0.0 && to > from && m->gauge_power[0] > 0.0)) return NAN;
    return log(power / m->gauge_power[0]) / (to - from);
}

scene_result output_scene_result(const scene_outcome *o)
{
    const mpm_report *m = o->report;
    scene_result r;
    memset(&r, 0, sizeof r);
    take_crater(&r, o->crater);
    take_bodies(&r, o);
    r.groove_growth = output_scene_growth(m);
    r.peak_pressure = m->peak_pressure;
    r.peak_temperature = m->peak_temperature;
    r.momentum_error = o->ledger->momentum_error;
    r.energy_error = o->ledger->energy_error;
    r.end_time = m->time;
    r.particles = m->particles;
    r.steps = m->steps;
    r.particle_steps = m->particle_steps;
    r.particle_steps_dense = m->particle_steps_dense;
    r.clamps_pressure = m->clamps_pressure;
    r.clamps_compression = m->clamps_compression;
    r.wall_seconds = o->wall_seconds;
    r.threads = o->threads;
    return r;
}
