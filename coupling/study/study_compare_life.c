/* SPDX-License-Identifier: BSD-3-Clause */
/* breech compare of a case with life.load: armature and no grains: life_compare.h as a study. */
#include "coupling/study/study.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/study/life_compare.h"

#include <stdlib.h>

static const summary_key entry_keys[] = {
    SUMMARY_TEXT(life_entry, "surface", surface, "of the rail"),
    SUMMARY_TEXT(life_entry, "metal", metal, "whose constants of fatigue are taken: that on top"),
    SUMMARY_TEXT(life_entry, "lacks", lacks, "why it is not judged; empty: it is"),
    SUMMARY_NUMBER(life_entry, "life", is.life, "1",
                   "shots until a crack at its weakest place: what ranks; null: not judged, or it lasts for good"),
    SUMMARY_VECTOR(life_entry, "life_quantiles", is.quantiles, 3, "1", "the same with 5, 50 and 95 %"),
    SUMMARY_NUMBER(life_entry, "life_position", is.position, "m", "of that place, from the breech"),
    SUMMARY_NUMBER(life_entry, "life_depth", is.depth, "m", "of the crack, below the face"),
    SUMMARY_CHOICE(life_entry, "life_cause", is.cause, study_rail_life_cause_names, "as in rail_life"),
    SUMMARY_NUMBER(life_entry, "life_range", is.range, "1", "largest strain range of a direction there"),
    SUMMARY_NUMBER(life_entry, "life_without_heat", is.without_heat, "1", "as in rail_life"),
    SUMMARY_NUMBER(life_entry, "better_than_next", better_than_next, "1",
                   "that it lasts longer than the next; null: not known"),
    SUMMARY_VALUE(life_entry, KEY_FLAG, "significant", significant, "", "better_than_next is at least 0.95"),
    SUMMARY_VALUE(life_entry, KEY_INTEGER, "tied", tied, "1",
                  "rank of the best of its group, from which it cannot be told: 1, it cannot be told from the best"),
    SUMMARY_END,
};

static const summary_key keys[] = {
    SUMMARY_LIST(life_ranking, "ranking", ranking, n, entry_keys, sizeof(life_entry),
                 "a surface each, the one that lasts longest first; those that are not judged last"),
    SUMMARY_NUMBER(life_ranking, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END,
};

typedef struct {
    life_ranking result;
    shot_record shot;
} answer;

static bool by_life(const case_inputs *in)
{
    return in->given.life && in->life.load == LIFE_ARMATURE && in->onset.sites.n == 0 && in->onset.populations.n == 0;
}

static status possible(const study_case *of)
{
    const case_inputs *in = of->in;
    return study_rail_life_possible(&in->onset, &in->life,
                                    case_material(&in->onset.impact.materials, in->life.material));
}

static status run(session *s, const study_case *of, study_answer *out)
{
    answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    const case_inputs *in = of->in;
    TRY(study_life_compare_run(s, &in->onset, &in->treatments, &in->life, !of->one_of_several, &a->result, &a->shot));
    for (int k = 0; k < a->result.n; k++)
        if (a->result.ranking[k].lacks[0])
            run_session_warn(s, "%s is not judged: %s", a->result.ranking[k].surface, a->result.ranking[k].lacks);
    out->result = &a->result;
    out->shot = &a->shot;
    return status_ok();
}

static void print(const void *result, FILE *out)
{
    const life_ranking *r = result;
    table *t;
    if (host_table_create("#|surface|metal|shots|5 %|95 %|x [m]|depth [mm]|by|better", &t).code != STATUS_OK) return;
    for (int k = 0; k < r->n; k++) {
        const life_entry *e = &r->ranking[k];
        char text[6][24];
        host_table_row(
            t, "%d|%s|%s|%s|%s|%s|%s|%s|%s|%s", e->tied, e->surface, e->metal,
            output_cell(e->is.life, 1.0, "%.3g", text[0]), output_cell(e->is.quantiles[0], 1.0, "%.3g", text[1]),
            output_cell(e->is.quantiles[2], 1.0, "%.3g", text[2]), output_cell(e->is.position, 1.0, "%.3f", text[3]),
            output_cell(e->is.depth, 1e-3, "%.3f", text[4]),
            e->lacks[0] ? "not judged" : study_rail_life_cause_names[e->is.cause],
            output_cell(e->better_than_next, 0.01, "%.0f %%", text[5]));
    }
    host_table_print(t, out);
    host_table_free(t);
}

static void free_owned(void *owned)
{
    answer *a = owned;
    if (a) study_life_compare_free(&a->result);
    free(a);
}

const study study_compare_life = {
    .name = "compare_life",
    .doc = "breech compare of a case with life.load: armature and no grains",
    .more = "",
    .instead = &study_compare_targets,
    .takes = by_life,
    .needs = CASE_FOR_SHOT | CASE_FOR_COMPARE | CASE_FOR_LIFE,
    .keys = keys,
    .shows_shot = true,
    .report = { report_compare_life_head, report_compare_life_section },
    .print = print,
    .possible = possible,
    .run = run,
    .free = free_owned,
};
