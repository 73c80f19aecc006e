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

/* NULL: not asked for. */
static const case_life *life_of(const case_inputs *in)
{
    return in->given.life && in->life.load == LIFE_ARMATURE ? &in->life : NULL;
}

static status possible(const study_case *of)
{
    const case_life *life = life_of(of->in);
    const case_onset *c = &of->in->onset;
    return life ? study_rail_life_possible(c, life, case_material(&c->impact.materials, life->material)) : status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    compare_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    const status done = study_compare_run(s, &of->in->onset, &of->in->treatments, life_of(of->in), a);
    out->result = &a->result;
    if (a->n > 0 && a->answer[0].shot.is.steps > 0) out->shot = &a->answer[0].shot;
    return done;
}

const study study_compare = {
    .name = "compare",
    .doc = "rail surfaces ranked by where gouging begins on each, or targets by what holds",
    .more = "As onset, for the case as it is and for each of its treatments; study.max_scenes holds for each surface.  "
            "With life.load: armature by life too, and by life alone in a case without sites and populations.  "
            "A case with targets and no treatments compares those, as strike does each.",
    .example = "breech compare cases/treatments --store out/scenes",
    .instead = &study_compare_life,
    .needs = CASE_FOR_ONSET | CASE_FOR_COMPARE,
    .many_scenes = true,
    .keys = study_compare_keys,
    .shows_shot = true,
    .report = { report_compare_head, report_compare_section },
    .print = study_compare_print,
    .possible = possible,
    .run = run,
    .free = answer_free,
};
