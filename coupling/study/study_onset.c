/* SPDX-License-Identifier: BSD-3-Clause */
/* breech onset: onset.h as a study. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/onset.h"

#include <stdlib.h>

static void answer_free(void *owned)
{
    if (owned) study_onset_answer_free(owned);
    free(owned);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    onset_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    const status done = study_onset_run(s, &of->in->onset, a);
    out->result = &a->result;
    if (a->shot.is.steps > 0) out->shot = &a->shot;
    return done;
}

static status possible(const study_case *of)
{
    return study_onset_possible(&of->in->onset);
}

const study study_onset = {
    .name = "onset",
    .doc = "where along the barrel gouging begins: a shot past its grains",
    .more = "Runs the shot, then as many impact scenes as the threshold velocity needs (study.max_scenes at most).",
    .example = "breech onset cases/default_shot --store out/scenes --max-walltime 2h",
    .needs = CASE_FOR_ONSET,
    .many_scenes = true,
    .keys = study_onset_keys,
    .shows_shot = true,
    .report = { report_onset_head, report_onset_section },
    .print = study_onset_print,
    .possible = possible,
    .run = run,
    .free = answer_free,
};
