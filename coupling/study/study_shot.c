/* SPDX-License-Identifier: BSD-3-Clause */
/* breech shot: the electromechanical shot alone, with the firing times that the case wishes to be found. */
#include "coupling/study/study.h"
#include "coupling/gouge/session_shot.h"
#include "coupling/report/report_page.h"
#include "coupling/study/firing_found.h"

#include <stdlib.h>

typedef struct {
    shot_record record; /* borrows from `firing` */
    firing_found firing;
} shot_answer;

static void answer_free(void *owned)
{
    shot_answer *a = owned;
    if (a) study_firing_free(&a->firing);
    free(a);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    shot_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for a shot");
    case_flight flight = case_flight_of(&of->in->onset);
    shot_outcome o;
    if (of->in->given.optimise) TRY(study_firing_find(s, &of->in->optimise, of->prefix, &flight, &a->firing));
    const status done = gouge_session_shot(s, &flight, NULL, !of->one_of_several, &o, &a->record);
    gouge_shot_outcome_free(&o);
    if (of->in->given.optimise) study_firing_record(s, &of->in->optimise, &a->firing, &a->record);
    if (done.code == STATUS_OK) out->result = &a->record;
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
