/* SPDX-License-Identifier: BSD-3-Clause */
/* breech life: how many cycles of a load the rail lasts, and where it cracks. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/life.h"

#include <math.h>
#include <stdlib.h>

static const summary_key keys[] = {
    SUMMARY_NUMBER(life_result, "life_first", life_first, "1",
                   "load cycles until the first direction is cut, by the closed field of the intact rail"),
    SUMMARY_NUMBER(life_result, "first_range", first.range, "1", "of its strain in a cycle"),
    SUMMARY_NUMBER(life_result, "first_least", first.least, "1", "least strain of the cycle, no load included"),
    SUMMARY_NUMBER(life_result, "first_largest", first.largest, "1", "largest one"),
    SUMMARY_NUMBER(life_result, "first_position", first.position, "m",
                   "where, along the rail from the middle of the patch; null: a passage, all places are alike"),
    SUMMARY_NUMBER(life_result, "first_depth", first.depth, "m", "below the face"),
    SUMMARY_NUMBER(life_result, "first_angle", first.angle, "rad",
                   "of that direction, from the rail's direction towards the depth"),
    SUMMARY_NUMBER(life_result, "peak_pressure", peak_pressure, "Pa", "of the contact"),
    SUMMARY_NUMBER(life_result, "normal_force", normal_force, "N/m", "on a metre of contact across the rail"),
    SUMMARY_NUMBER(life_result, "tangential_force", tangential_force, "N/m", "the same along the rail"),
    SUMMARY_NUMBER(life_result, "wall_seconds", wall_seconds, "s", "wall time of the study"),
    SUMMARY_END,
};

static status possible(const study_case *of)
{
    contact_load load;
    return life_contact_load(&of->in->life, &load);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const case_life *c = &of->in->life;
    const material *m = case_material(&of->in->onset.impact.materials, c->material);
    const fatigue_law law = mpm_fatigue_law(m);
    contact_load load;
    life_result *r = out->owned = calloc(1, sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for an answer");
    host_progress_task(&s->progress, "first cut", 0.0, 0);
    const double since = host_wall_clock();
    TRY(life_contact_load(c, &load));
    const life_first_how how = { m->youngs_modulus, m->poisson, c->measure, c->cycle };
    r->peak_pressure = load.peak;
    life_contact_forces(&load, &r->normal_force, &r->tangential_force);
    r->first = life_first_cut(&load, &how);
    r->life_first = mpm_fatigue_cycles(&law, r->first.range);
    r->wall_seconds = host_wall_clock() - since;
    host_timing_add(&s->timing, "first cut", r->wall_seconds);
    out->result = r;
    return status_ok();
}

static void verdict(const page *p)
{
    static const page_column cards[] = { { "life_first", "cycles to the first cut", 1.0, "" },
                                         { "first_range", "its strain range", 1e-2, "%" },
                                         { "first_depth", "its depth", 1e-3, "mm" },
                                         { "first_position", "its place", 1e-3, "mm" },
                                         { "peak_pressure", "peak pressure", 1e6, "MPa" } };
    report_page_cards(p, p->source->summary, cards, PAGE_COUNT(cards));
}

const study study_life = {
    .name = "life",
    .doc = "how many load cycles the rail lasts",
    .more = "Needs the section life.",
    .example = "breech life cases/rail_fatigue",
    .needs = CASE_FOR_LIFE,
    .keys = keys,
    .can_vary = true,
    .report = { verdict, NULL },
    .possible = possible,
    .run = run,
    .free = free,
};
