/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/watch.h"

#include <math.h>
#include <string.h>

static const double SETTLED_SHARE = 0.1; /* of the measuring depth */
static const double DEAD_SHARE = 0.1;    /* of its largest plastic power, below which a groove is dead */

/* ---- the crater so far ---- */

/* The map widens with the groove, as the scene's cells do; its own cells and what they measure stay. */
static status measure_crater(const gouge_watch *w, const mpm *m, crater *out)
{
    gouge_points p;
    const gouge_scene *s = w->scene;
    const double wider = 1 << gouge_finest_level(s, &w->state.gauges);
    crater_spec spec = s->crater;
    spec.z_hi = fmin(s->beside, wider * spec.z_hi);
    TRY(gouge_points_of_rail(s, &spec, m, &p));
    const crater_points rail = { .n = p.n, .position = p.position, .size = p.size, .damage = p.damage };
    const status done = gouge_crater_measure(&rail, &spec, out);
    gouge_points_free(&p);
    return done;
}

static void take_shape(gouge_watch *w, const crater *now)
{
    w->state.gauge_length_over_width = gouge_crater_length_over_width(now);
    w->state.gauge_length = now->length;
}

/* At the second gauge, where a scene of a search ends: a whole scene is judged by the same crater. */
static status note_shape(gouge_watch *w, const mpm *m)
{
    crater now;
    TRY(measure_crater(w, m, &now));
    take_shape(w, &now);
    gouge_crater_free(&now);
    return status_ok();
}

/* ---- is it over? ---- */

static bool is_gauged(const gouge_watch *w, const mpm_report *now)
{
    const gouge_gauges *g = &w->state.gauges;
    return w->scene->gauged && (g->at[1] > 0.0 || gouge_groove_dies(w->scene, g, &w->state.front, now->time));
}

static status due(void *user, const mpm *m, const mpm_report *now, bool *ends)
{
    gouge_watch *w = user;
    gouge_watched *seen = &w->state;
    if (gouge_front_is_due(w->scene, now, &seen->front)) TRY(gouge_front_look(w->scene, m, &seen->front));
    gouge_gauges_note(w->scene, &seen->front, &seen->gauges);
    *ends = is_gauged(w, now);
    if (!*ends && seen->gauges.at[1] > 0.0 && seen->gauge_length_over_width == 0.0) return note_shape(w, m);
    return status_ok();
}

static int finest(void *user)
{
    const gouge_watch *w = user;
    return gouge_finest_level(w->scene, &w->state.gauges);
}

/* Is a groove that is followed dead, or has the armature's contact face gone over its front? */
static bool groove_over(const gouge_scene *s, const gouge_front *f, double time)
{
    return time > gouge_grain_passed(s) && (f->power < DEAD_SHARE * f->peak || gouge_face_tail(s, time) > f->front);
}

/* Largest distance that a sound rail point of the map would still go until the end [m]. */
static status distance_left(const gouge_scene *s, const mpm *m, double *distance)
{
    gouge_points p;
    TRY(gouge_points_of_rail(s, &s->crater, m, &p));
    double fastest2 = 0.0;
    for (size_t i = 0; i < p.n; i++) {
        const double *v = p.velocity + 3 * i;
        if (p.damage[i] < 1.0) fastest2 = fmax(fastest2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    gouge_points_free(&p);
    *distance = sqrt(fastest2) * (s->scene.end_time - mpm_glance(m).time);
    return status_ok();
}

static status is_settled(const gouge_watch *w, const mpm *m, const mpm_report *now, bool *settled)
{
    const gouge_scene *s = w->scene;
    double distance;
    if (!s->stop_when_settled) return status_ok();
    if (gouge_is_followed(s)) {
        *settled = groove_over(s, &w->state.front, now->time);
        return status_ok();
    }
    if (now->time < gouge_crossing_time(s)) return status_ok();
    TRY(distance_left(s, m, &distance));
    *settled = distance < SETTLED_SHARE * gouge_crater_measuring_depth(&s->crater);
    return status_ok();
}

static status piece(void *user, const mpm *m, bool *over)
{
    gouge_watch *w = user;
    const mpm_report now = mpm_glance(m);
    if (now.steps == 0) TRY(gouge_armature_metal(w->scene, m, &w->state.start));
    *over = is_gauged(w, &now);
    return *over ? status_ok() : is_settled(w, m, &now, over);
}

/* ---- what it has come to ---- */

/* Not where the scene's end came first: then the groove might have grown on. */
static bool growth_decides(const gouge_watch *w, double time)
{
    const gouge_scene *s = w->scene;
    const gouge_watched *seen = &w->state;
    if (!gouge_is_followed(s)) return false;
    return s->gauged || seen->gauges.at[1] > 0.0 || groove_over(s, &seen->front, time) ||
           gouge_groove_dies(s, &seen->gauges, &seen->front, time);
}

/* Had the contact face's tail left where the groove begins when that was judged?  A groove that is no longer pressed on
 * all of its length takes less power. */
static bool face_passed(const gouge_watch *w, double time)
{
    const double second = w->state.gauges.at[1];
    return gouge_face_tail(w->scene, second > 0.0 ? second : time) > w->scene->grain_end;
}

/* A groove that grows is worth going on with. */
static status finish(void *user, const mpm *m, bool *keep)
{
    gouge_watch *w = user;
    const double since = host_wall_clock();
    TRY(gouge_armature_metal(w->scene, m, &w->end));
    TRY(measure_crater(w, m, &w->found));
    if (w->state.gauge_length_over_width == 0.0) take_shape(w, &w->found); /* ends there, or before */
    TRY(gouge_carried_volumes(w->scene, m, w->carried));
    mpm_failed_volumes(m, w->failed);
    w->rail = mpm_body_state(m, w->scene->rail);
    w->armature = mpm_body_state(m, w->scene->armature);
    memcpy(w->peak_force, mpm_peak_contact_force(m, w->scene->scene.body[w->scene->rail].group), sizeof w->peak_force);
    w->growth = gouge_growth(&w->state.gauges, &w->state.front);
    w->front_speed = gouge_front_speed(&w->state.gauges);
    w->growth_decides = growth_decides(w, mpm_glance(m).time);
    w->face_passed = w->growth_decides && !(w->growth > 0.0) && face_passed(w, mpm_glance(m).time);
    *keep = w->growth > 0.0;
    if (w->timing) host_timing_add(w->timing, "crater", host_wall_clock() - since);
    return status_ok();
}

/* ---- what it adds to the history ---- */

static const history_column columns[] = {
    { "plastic_front", "m", "rail deforms plastically behind it" },
    { "plastic_power", "W", "of the rail, as computed" },
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void row(void *user, double *to)
{
    const gouge_watch *w = user;
    to[0] = w->state.front.front, to[1] = w->state.front.power;
}

void gouge_watch_print_columns(FILE *out)
{
    output_history_print_columns("/scene/<name> of an impact on the rail, also", columns, COLUMNS, out);
}

scene_watch gouge_watch_of(gouge_watch *w)
{
    return (scene_watch){ .due = due,
                          .finest = finest,
                          .piece = piece,
                          .finish = finish,
                          .user = w,
                          .state = &w->state,
                          .state_bytes = sizeof w->state,
                          .column = columns,
                          .columns = COLUMNS,
                          .row = row };
}
