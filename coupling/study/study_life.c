/* SPDX-License-Identifier: BSD-3-Clause */
/* breech life: how many cycles of a load the rail lasts, and where it cracks. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/life.h"

#include <math.h>
#include <stdlib.h>

static const double FIRST_OFF = 0.15; /* of life_first: the grid's may differ so far without a warning */

static const summary_key keys[] = {
    SUMMARY_NUMBER(life_result, "life", crack.life, "1",
                   "load cycles until a crack: a point has lost life.limit_index of its directions; null: not reached"),
    SUMMARY_NUMBER(life_result, "life_first", life_first, "1",
                   "load cycles until the first direction is cut, by the closed field of the intact rail"),
    SUMMARY_NUMBER(life_result, "life_position", crack.position, "m",
                   "of the crack, along the rail from the middle of the patch; null: of a passage, all are alike"),
    SUMMARY_NUMBER(life_result, "life_depth", crack.depth, "m", "of the crack, below the face"),
    SUMMARY_NUMBER(life_result, "life_angle", crack.angle, "rad",
                   "mean of its cut directions, from the rail's direction towards the depth; the crack lies across it"),
    SUMMARY_NUMBER(life_result, "first_range", first.range, "1", "of its strain in a cycle"),
    SUMMARY_NUMBER(life_result, "first_least", first.least, "1", "least strain of the cycle, no load included"),
    SUMMARY_NUMBER(life_result, "first_largest", first.largest, "1", "largest one"),
    SUMMARY_NUMBER(life_result, "first_position", first.position, "m",
                   "where, along the rail from the middle of the patch; null: a passage, all places are alike"),
    SUMMARY_NUMBER(life_result, "first_depth", first.depth, "m", "below the face"),
    SUMMARY_NUMBER(life_result, "first_angle", first.angle, "rad",
                   "of that direction, from the rail's direction towards the depth"),
    SUMMARY_NUMBER(life_result, "grid_first", crack.first, "1", "life_first by the grid and its directions"),
    SUMMARY_NUMBER(life_result, "life_alone", crack.alone, "1", "life if no cut changed the strain of its neighbours"),
    SUMMARY_NUMBER(life_result, "field_error", crack.field_error, "1",
                   "rms of the grid's stress against the closed field in the intact rail, over peak_pressure"),
    SUMMARY_NUMBER(life_result, "face_error", crack.face_error, "1",
                   "largest of the strain along the face, over the largest strain there; added to the grid's"),
    SUMMARY_VALUE(life_result, KEY_INTEGER, "cuts", crack.cuts, "", "directions cut until the crack"),
    SUMMARY_VALUE(life_result, KEY_INTEGER, "solves", crack.solves, "", "solutions of the rail's equilibrium"),
    SUMMARY_VALUE(life_result, KEY_INTEGER, "iterations", crack.iterations, "", "of conjugate gradients, all of them"),
    SUMMARY_VALUE(life_result, KEY_INTEGER, "unsettled", crack.unsettled, "",
                  "steps after which some cuts still opened and closed"),
    SUMMARY_NUMBER(life_result, "peak_pressure", peak_pressure, "Pa", "of the contact"),
    SUMMARY_NUMBER(life_result, "normal_force", normal_force, "N/m", "on a metre of contact across the rail"),
    SUMMARY_NUMBER(life_result, "tangential_force", tangential_force, "N/m", "the same along the rail"),
    SUMMARY_NUMBER(
        life_result, "moving_factor", moving_factor, "1",
        "K of (L-7): stress along the face over that at rest, under a pressure that runs at life.speed; 1 at "
        "rest"),
    SUMMARY_NUMBER(life_result, "wall_seconds", wall_seconds, "s", "wall time of the study"),
    SUMMARY_END,
};

static status possible(const study_case *of)
{
    const case_life *c = &of->in->life;
    const mpm_material *m = case_material(&of->in->onset.impact.materials, c->material);
    contact_load load;
    TRY(life_contact_load(c, &load));
    if (c->speed == 0.0) return status_ok();
    CHECK(m->density > 0.0, STATUS_BAD_INPUT, "life.speed: material %s lacks its density", m->name);
    const double limit = life_contact_rayleigh(m->youngs_modulus, m->poisson, m->density);
    CHECK(c->speed < limit, STATUS_BAD_INPUT,
          "life.speed = %g m/s: must lie below the speed of Rayleigh waves in %s, %.4g m/s", c->speed, m->name, limit);
    return status_ok();
}

static void show(void *user, double fraction)
{
    host_progress_update(user, fraction, 0);
}

static life_crack_how how_of(session *s, const case_life *c, const mpm_material *m, const contact_load *load)
{
    return (life_crack_how){ .load = load,
                             .how = { m->youngs_modulus, m->poisson, c->measure, c->cycle, c->speed, m->density },
                             .law = mpm_fatigue_law(m),
                             .fan = c->fan == LIFE_LATTICE ? mpm_fatigue_fan_lattice()
                                                           : mpm_fatigue_fan_even(c->directions),
                             .cells = c->cells_per_half_length,
                             .wide = c->grid_half_width,
                             .deep = c->grid_depth,
                             .limit = c->limit_index,
                             .batch = c->batch,
                             .most_cuts = c->max_cuts,
                             .threads = s->threads,
                             .step = show,
                             .user = &s->progress,
                             .stop = s->stop };
}

/* /scene/rail/index, /scene/rail/least_life: maps over the rail's points. */
static status save_map(session *s, const study_case *of, const life_crack *c, const char *name, const char *doc,
                       const double *values)
{
    char scene[SUMMARY_NAME_SIZE];
    snprintf(scene, sizeof scene, "%.60srail", of->prefix ? of->prefix : "");
    const history_map map = { .name = name,
                              .across = { { "x", "m", "along the rail, from the middle of the patch" },
                                          { "z", "m", "below the face; the first row stands for the face itself" } },
                              .value = { name, "1", doc },
                              .n = { c->nx, c->nz },
                              .first = { -0.5 * (c->nx - 1) * c->cell, 0.5 * c->cell },
                              .step = { c->cell, c->cell },
                              .values = values };
    return output_history_map(s->history, scene, &map);
}

static void warn(session *s, const life_result *r, const case_life *c)
{
    const double off = r->crack.first / r->life_first - 1.0;
    if (isnan(r->crack.life) && c->max_cuts > 0)
        run_session_warn(s, "no crack within life.max_cuts = %d cuts", c->max_cuts);
    if (fabs(off) > FIRST_OFF)
        run_session_warn(s,
                         "the first cut on the grid comes after %+.0f %% of the cycles of the closed field: take more "
                         "directions, or more cells_per_half_length",
                         100.0 * off);
}

static status look_for_crack(session *s, const study_case *of, const mpm_material *m, const contact_load *load,
                             life_result *r)
{
    const double since = host_wall_clock();
    const life_crack_how how = how_of(s, &of->in->life, m, load);
    host_progress_task(&s->progress, "cuts until a crack", 0.0, 0);
    TRY(life_crack_find(&how, &r->crack));
    host_timing_add(&s->timing, "cuts until a crack", host_wall_clock() - since);
    TRY(save_map(s, of, &r->crack, "index", "fraction of the point's directions that are cut", r->crack.index));
    TRY(save_map(s, of, &r->crack, "least_life", "least life that a direction of the point has left",
                 r->crack.least_life));
    warn(s, r, &of->in->life);
    return status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const case_life *c = &of->in->life;
    const mpm_material *m = case_material(&of->in->onset.impact.materials, c->material);
    const fatigue_law law = mpm_fatigue_law(m);
    contact_load load;
    life_result *r = out->owned = calloc(1, sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for an answer");
    r->crack = life_crack_none();
    host_progress_task(&s->progress, "first cut", 0.0, 0);
    const double since = host_wall_clock();
    TRY(life_contact_load(c, &load));
    const life_first_how how = { m->youngs_modulus, m->poisson, c->measure, c->cycle, c->speed, m->density };
    const contact_speed speed = life_contact_speed(how.youngs, how.poisson, how.density, how.speed);
    r->peak_pressure = load.peak;
    r->moving_factor = c->speed > 0.0 ? life_contact_factor(&speed) : 1.0;
    life_contact_forces(&load, &r->normal_force, &r->tangential_force);
    r->first = life_first_cut(&load, &how);
    r->life_first = mpm_fatigue_cycles(&law, r->first.range);
    CHECK(isfinite(r->life_first), STATUS_BAD_INPUT,
          "life.material = %s: the largest strain range, %.3g, lies below its fatigue limit, %g: no direction is ever "
          "cut",
          m->name, r->first.range, law.limit);
    host_timing_add(&s->timing, "first cut", host_wall_clock() - since);
    if (c->until == LIFE_UNTIL_CRACK) TRY(look_for_crack(s, of, m, &load, r));
    r->wall_seconds = host_wall_clock() - since;
    out->result = r;
    return status_ok();
}

static void free_owned(void *owned)
{
    life_result *r = owned;
    if (r) life_crack_free(&r->crack);
    free(r);
}

const study study_life = {
    .name = "life",
    .doc = "how many load cycles the rail lasts",
    .more = "Needs the section life.  Of a wheel's load it writes maps of the rail's index and least life; of an "
            "armature's (life.load) it needs a shot's sections and answers along the barrel.",
    .example = "breech life cases/rail_life",
    .instead = &study_rail_life,
    .needs = CASE_FOR_LIFE,
    .keys = keys,
    .can_vary = true,
    .report = { report_life_head, report_life_section },
    .possible = possible,
    .run = run,
    .free = free_owned,
};
