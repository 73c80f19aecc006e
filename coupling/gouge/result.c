/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/result.h"

#include <math.h>
#include <string.h>

static void take_crater(scene_result *r, const crater *c)
{
    r->class = r->crater_class = c->class;
    snprintf(r->reason, sizeof r->reason, "%s", c->reason);
    snprintf(r->crater_reason, sizeof r->crater_reason, "%s", c->reason);
    r->severity = c->severity;
    r->widening = c->widening;
    r->crater_length = c->length;
    r->crater_width = c->width;
    r->crater_depth = c->depth;
    r->crater_volume = c->volume;
    r->rim_height = c->rim_height;
    r->crater_truncated = c->truncated;
    r->length_over_width = gouge_crater_length_over_width(c);
}

/* The mirror half of a half model doubles what acts in its plane and cancels what acts across it. */
static void take_bodies(scene_result *r, const gouge_scene *s, const gouge_watch *w, const mpm_report *m)
{
    const bool mirrored = s->crater.mirrored;
    const double halves = mirrored ? 2.0 : 1.0;
    r->peak_force[0] = halves * w->peak_force[0];
    r->peak_force[1] = halves * w->peak_force[1];
    r->peak_force[2] = mirrored ? 0.0 : w->peak_force[2];
    r->eroded_mass = halves * m->eroded_mass;
    r->bodies = s->scene.bodies;
    for (int b = 0; b < r->bodies; b++) {
        memcpy(r->body[b], s->scene.body[b].name, sizeof r->body[b]);
        r->failed_volume[b] = halves * w->failed[b];
        r->carried_volume[b] = w->carried[b];
        if (!gouge_is_layer(s, b)) continue;
        r->layers_failed_volume += r->failed_volume[b];
        r->layers_carried_volume += r->carried_volume[b];
    }
    r->peak_mises_armature = w->armature.peak_mises;
    r->peak_mises_rail = w->rail.peak_mises;
    r->peak_mises_armature_999 = w->armature.peak_mises_999;
    r->peak_mises_rail_999 = w->rail.peak_mises_999;
    r->peak_pressure_armature_999 = w->armature.peak_pressure_999;
    r->peak_pressure_rail_999 = w->rail.peak_pressure_999;
}

/* The power of a groove that the contact face leaves falls whatever it would have done. */
static void leave_open(scene_result *r)
{
    r->class = DAMAGE_UNDECIDED;
    snprintf(r->reason, sizeof r->reason,
             "the groove does not grow, but the contact face's tail had passed the grain before that was judged, which "
             "alone would do it: a longer contact face (armature.length), or study.judge: severity");
}

/* By the groove's growth between its gauges and its crater's shape at the second, whether the scene ended there or went
 * on: a whole scene and one of a search say the same.  What left no crater is `none`. */
static void judge_by_growth(scene_result *r, const gouge_scene *s)
{
    const double folds = gouge_growth_folds(r->groove_growth, s->crater.particle_radius, s->velocity);
    const double excess = gouge_tear_drop_excess(folds, r->gauge_length_over_width, s->limit_length_over_width);
    const bool decided = fabs(excess) >= s->growth_scatter;
    const damage_class below = r->class == DAMAGE_NONE ? DAMAGE_NONE : DAMAGE_SCRATCH;
    r->class = !decided ? DAMAGE_UNDECIDED : excess > 0.0 ? DAMAGE_GOUGE : below;
    if (isnan(r->groove_growth))
        snprintf(r->reason, sizeof r->reason, "no groove that lived to its first gauge and left its grain");
    else
        snprintf(r->reason, sizeof r->reason,
                 "the groove's plastic power changes by %.2f e-folds from gauge to gauge, its crater is %.1f times as "
                 "long as wide (limit %g): %.2f, %s %.2f",
                 folds, r->gauge_length_over_width, s->limit_length_over_width, excess, decided ? "beyond" : "within",
                 s->growth_scatter);
}

/* What grows without a groove that has left its grain is no growth: power in the grain's own seat. */
static bool has_left_grain(const gouge_scene *s, const gouge_watch *w)
{
    const mpm_body *body = s->scene.body;
    const double least = gouge_shortest_groove(s->crater.particle_radius, body[s->armature].material->density,
                                               body[s->rail].material->density);
    return w->state.gauge_length >= least;
}

scene_result gouge_result(const gouge_scene *s, const gouge_watch *w, const scene_outcome *o)
{
    const mpm_report *m = &o->report;
    scene_result r;
    memset(&r, 0, sizeof r);
    take_crater(&r, &w->found);
    take_bodies(&r, s, w, m);
    r.groove_growth = w->growth_decides && w->growth > 0.0 && !has_left_grain(s, w) ? NAN : w->growth;
    r.growth_per_way = r.groove_growth / s->velocity;
    r.front_speed_ratio = w->front_speed / s->velocity;
    r.gauge_length_over_width = w->growth_decides ? w->state.gauge_length_over_width : NAN;
    r.peak_pressure = fmax(r.peak_pressure_armature_999, r.peak_pressure_rail_999);
    r.max_pressure = m->peak_pressure;
    r.peak_temperature = m->peak_temperature;
    r.momentum_error = o->ledger.momentum_error;
    r.energy_error = o->ledger.energy_error;
    r.end_time = m->time;
#define WORK(member, text) r.member = m->member;
#include "coupling/scene/scene_work.def"
    r.wall_seconds = o->wall;
    r.threads = o->threads;
    if (!w->growth_decides) return r;
    memset(r.reason, 0, sizeof r.reason); /* results are compared byte by byte */
    if (w->face_passed)
        leave_open(&r);
    else
        judge_by_growth(&r, s);
    return r;
}
