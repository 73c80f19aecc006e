/* SPDX-License-Identifier: BSD-3-Clause */
/* breech compare: compare.h as a study. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/compare.h"

#include <stdlib.h>

static void answer_free(void *owned)
{
    if (owned) study_compare_answer_free(owned);
    free(owned);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    compare_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    const status done = study_compare_run(s, &of->in->onset, &of->in->treatments, a);
    out->result = &a->result;
    if (a->n > 0 && a->answer[0].shot.is.steps > 0) out->shot = &a->answer[0].shot;
    return done;
}

const study study_compare = {
    .name = "compare",
    .doc = "rail surfaces ranked by where gouging begins on each",
    .more = "As onset, for the case as it is and for each of its treatments; study.max_scenes holds for each surface.",
    .example = "breech compare cases/treatments --store out/scenes",
    .needs = CASE_FOR_ONSET | CASE_FOR_COMPARE,
    .many_scenes = true,
    .keys = study_compare_keys,
    .shows_shot = true,
    .report = { report_compare_head, report_compare_section },
    .print = study_compare_print,
    .run = run,
    .free = answer_free,
};
