/* SPDX-License-Identifier: BSD-3-Clause */
/* breech vessel: when and where on its way a shell with gas and liquid in it bursts, by the reduced model. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/vessel.h"

#include <stdlib.h>

static const summary_key keys[] = {
    SUMMARY_VALUE(vessel_answer, KEY_FLAG, "burst", is.burst, "", "did the film burst before vessel.end_time?"),
    SUMMARY_NUMBER(vessel_answer, "rupture_time", is.rupture.time, "s", "when it burst; null: it did not"),
    SUMMARY_NUMBER(vessel_answer, "rupture_swelling", is.rupture.swelling, "1",
                   "outer diameter then, over that at the start"),
    SUMMARY_NUMBER(vessel_answer, "rupture_pressure", is.rupture.pressure, "Pa",
                   "pressure inside then, above the ambient one"),
    SUMMARY_NUMBER(vessel_answer, "rupture_film", is.rupture.film, "m", "thickness of the film then"),
    SUMMARY_NUMBER(vessel_answer, "rupture_strain", is.rupture.strain, "1",
                   "equivalent plastic strain of its inner layer then"),
    SUMMARY_NUMBER(vessel_answer, "rupture_bubble", is.rupture.bubble, "m", "radius of the largest bubble then"),
    SUMMARY_NUMBER(vessel_answer, "peak_pressure", is.peak_pressure, "Pa", "largest, above the ambient one"),
    SUMMARY_NUMBER(vessel_answer, "vent_time", is.vent_time, "s",
                   "from the rupture until the pressure is half of what it was; null: not reached"),
    SUMMARY_NUMBER(vessel_answer, "vent_flow", is.rupture.flow, "mol/s", "through the hole at first"),
    SUMMARY_NUMBER(vessel_answer, "end_swelling", is.end.swelling, "1", "outer diameter at the end"),
    SUMMARY_NUMBER(vessel_answer, "end_pressure", is.end.pressure, "Pa", "pressure at the end"),
    SUMMARY_NUMBER(vessel_answer, "end_damage", is.end.damage, "1", "damage of the film's inner layer at the end"),
    SUMMARY_NUMBER(vessel_answer, "surface_pressure", is.laplace, "Pa",
                   "of surface tension in the smallest bubble at the start; left out of everything else"),
    SUMMARY_VALUE(vessel_answer, KEY_INTEGER, "steps", is.steps, "", "of time"),
    SUMMARY_NUMBER(vessel_answer, "wall_seconds", wall_seconds, "s", "wall time of the study"),
    SUMMARY_END,
};

static const history_column columns[] = {
    { "time", "s", "since the start" },
    { "swelling", "1", "outer diameter over that at the start" },
    { "pressure", "Pa", "inside, above the ambient one" },
    { "film", "m", "thickness of the film" },
    { "strain", "1", "equivalent plastic strain of the film's inner layer" },
    { "damage", "1", "of the film's inner layer" },
    { "moles", "mol", "gas in all bubbles; of a cylinder a metre's" },
    { "bubble", "m", "radius of the largest bubble" },
    { "flow", "mol/s", "of gas through the hole" },
};
enum { COLUMNS = sizeof columns / sizeof *columns };

void study_vessel_print_columns(FILE *out)
{
    output_history_print_columns("/vessel", columns, COLUMNS, out);
}

typedef struct {
    session *session;
    double end;
    int series;
    status written;
} writing;

static void write_row(void *user, const vessel_state *at)
{
    writing *w = user;
    const double row[COLUMNS] = { at->time,   at->swelling, at->pressure, at->film, at->strain,
                                  at->damage, at->moles,    at->bubble,   at->flow };
    if (w->written.code == STATUS_OK && w->series >= 0)
        w->written = output_history_append(w->session->history, w->series, row);
    host_progress_update(&w->session->progress, at->time / w->end, 0);
}

static vessel_how how_of(const case_inputs *in)
{
    const case_vessel *c = &in->vessel;
    const case_materials *all = &in->onset.impact.materials;
    return (vessel_how){ .is = c,
                         .film = case_material(all, c->film_material),
                         .liquid = case_material(all, c->liquid_material) };
}

static status possible(const study_case *of)
{
    const vessel_how how = how_of(of->in);
    return vessel_possible(&how);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    vessel_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    writing w = { .session = s, .end = of->in->vessel.end_time, .series = -1, .written = status_ok() };
    vessel_how how = how_of(of->in);
    const double since = host_wall_clock();
    how.step = write_row, how.stop = s->stop, how.user = &w;
    host_progress_task(&s->progress, "until it bursts", 0.0, 0);
    if (!of->one_of_several) TRY(output_history_series(s->history, "/vessel", columns, COLUMNS, &w.series));
    const status done = vessel_run(&how, &a->is);
    host_timing_add(&s->timing, "until it bursts", host_wall_clock() - since);
    a->wall_seconds = host_wall_clock() - since;
    out->result = a;
    TRY(done);
    TRY(w.written);
    if (!a->is.burst) run_session_warn(s, "it does not burst within vessel.end_time = %g s", w.end);
    return status_ok();
}

const study study_vessel = {
    .name = "vessel",
    .doc = "when a shell with gas and liquid in it bursts",
    .more = "Needs the section vessel.  A reduced model: no scene is run.",
    .example = "breech vessel cases/gel_droplet",
    .needs = CASE_FOR_VESSEL,
    .keys = keys,
    .can_vary = true,
    .report = { report_vessel_head, report_vessel_section },
    .possible = possible,
    .run = run,
    .free = free,
};
