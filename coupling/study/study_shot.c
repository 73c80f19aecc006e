/* SPDX-License-Identifier: BSD-3-Clause */
/* breech shot: the electromechanical shot alone, with the firing times that the case wishes to be found. */
#include "coupling/study/study.h"
#include "coupling/gouge/session_shot.h"
#include "coupling/report/report_page.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    shot_record record;
    double *fire_at; /* of the record, owned */
} shot_answer;

static void answer_free(void *owned)
{
    shot_answer *a = owned;
    if (a) free(a->fire_at);
    free(a);
}

static status shoot(session *s, const case_flight *flight, bool with_history, study_answer *out)
{
    shot_answer *a = out->owned;
    shot_outcome o;
    const status done = gouge_session_shot(s, flight, NULL, with_history, &o, &a->record);
    gouge_shot_outcome_free(&o);
    if (done.code == STATUS_OK) out->result = &a->record;
    return done;
}

/* Shoots with the firing times that are found. */
static status shoot_optimised(session *s, const study_case *of, shot_module *modules, study_answer *out)
{
    shot_answer *a = out->owned;
    case_flight flight = case_flight_of(&of->in->onset);
    supply_list *bank = &flight.launcher.supplies[SUPPLY_capacitor];
    const double since = host_wall_clock();
    firing_result found;
    host_progress_task(&s->progress, "search for firing times", 0.0, 0);
    TRY(circuit_firing_optimise(&flight.launcher, &of->in->optimise, s->stop, modules, &found));
    host_timing_add(&s->timing, "firing times", host_wall_clock() - since);
    bank->item = modules;
    const status done = shoot(s, &flight, !of->one_of_several, out);
    a->record.firing = found;
    a->record.n_fire_at = bank->n;
    a->record.fire_at = a->fire_at;
    for (int k = 0; k < bank->n; k++) a->fire_at[k] = modules[k].fire_at;
    return done;
}

static status run(session *s, const study_case *of, study_answer *out)
{
    shot_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for a shot");
    const case_flight flight = case_flight_of(&of->in->onset);
    if (!of->in->given.optimise) return shoot(s, &flight, !of->one_of_several, out);
    const size_t n = (size_t)flight.launcher.supplies[SUPPLY_capacitor].n;
    shot_module *modules = malloc((n + 1) * sizeof *modules);
    a->fire_at = malloc((n + 1) * sizeof *a->fire_at);
    const status done = modules && a->fire_at ? shoot_optimised(s, of, modules, out)
                                              : base_status_error(STATUS_MEMORY, "no memory for %zu groups", n);
    free(modules);
    return done;
}

static void print(const void *result, FILE *out)
{
    output_keys_print(&(summary_object){ run_shot_keys, result }, out);
    fputc('\n', out);
    run_shot_verdict(result, out);
}

static status possible(const study_case *of)
{
    const case_flight flight = case_flight_of(&of->in->onset);
    return of->in->given.optimise ? circuit_firing_check(&flight.launcher, &of->in->optimise) : status_ok();
}

const study study_shot = {
    .name = "shot",
    .doc = "the electromechanical shot alone",
    .more = "Needs the sections bank (or another supply), rail, barrel and armature.  Writes the shot's history.",
    .example = "breech shot cases/default_shot --set \"bank.charge=9 kV\" -o out/9kV",
    .needs = CASE_FOR_SHOT,
    .keys = run_shot_keys,
    .can_vary = true,
    .report = { report_shot_head, NULL },
    .print = print,
    .possible = possible,
    .run = run,
    .free = answer_free,
};
