/* SPDX-License-Identifier: BSD-3-Clause */
/* How a comparison's result is written and printed. */
#include "coupling/study/compare.h"
#include "coupling/host/table.h"

#include <math.h>

static const summary_key entry_keys[] = {
    SUMMARY_TEXT(compare_entry, "surface", surface, "of the rail"),
    SUMMARY_TEXT(compare_entry, "scene_prefix", scene_prefix,
                 "with which the names of its scenes begin; empty: of the untreated one"),
    SUMMARY_NUMBER(compare_entry, "threshold_velocity", threshold_velocity, "m/s", ""),
    SUMMARY_VECTOR(compare_entry, "threshold_interval", threshold_interval, 2, "m/s", ""),
    SUMMARY_NUMBER(compare_entry, "scratch_velocity", scratch_velocity, "m/s",
                   "always null: surfaces are ranked by the gouge alone, and the scratch is not looked for"),
    SUMMARY_VECTOR(compare_entry, "scratch_interval", scratch_interval, 2, "m/s", "as threshold_interval"),
    SUMMARY_NUMBER(compare_entry, "onset_position", onset_position, "m",
                   "of the first shot's first grain that gouges, with populations the median; null: no gouging"),
    SUMMARY_NUMBER(compare_entry, "gouged_volume", gouged_volume, "m3", "a shot, mean of all shots"),
    SUMMARY_VECTOR(compare_entry, "gouged_volume_interval", gouged_volume_interval, 2, "m3",
                   "5 and 95 % of what may be true"),
    SUMMARY_NUMBER(compare_entry, "threshold_position", threshold_position, "m",
                   "where the threshold velocity is passed, whether a grain is there or not"),
    SUMMARY_VECTOR(compare_entry, "threshold_position_interval", threshold_position_interval, 2, "m",
                   "where the ends of threshold_interval are passed; null: that end is not known, or "
                   "not passed in this shot"),
    SUMMARY_NUMBER(compare_entry, "threshold_deviation", threshold_deviation, "m/s",
                   "standard deviation over study.threshold_ensemble grids; its interval holds it; null: not known"),
    SUMMARY_NUMBER(compare_entry, "gouges", gouges, "1",
                   "a shot, expected, mean of all shots: what ranks; null: there are grains that no scene was run for, "
                   "unless the screen calls them quiet and others have scenes"),
    SUMMARY_VECTOR(compare_entry, "gouges_interval", gouges_interval, 2, "1", "5 and 95 % of what may be true"),
    SUMMARY_NUMBER(compare_entry, "last_gouges", last_gouges, "1",
                   "expected of the last shot, on the rail that the shots before it have left"),
    SUMMARY_NUMBER(compare_entry, "layer_worn", layer_worn, "m",
                   "thickness that sliding has worn off its layers before the last shot: the largest from "
                   "study.velocity_low on; null: no layer has a wear_rate, or there is one shot"),
    SUMMARY_NUMBER(compare_entry, "deposit", deposit, "m",
                   "armature metal on it before the last shot, as a thickness, the largest alike; null: "
                   "study.deposit_kept is not given, or there is one shot"),
    SUMMARY_NUMBER(compare_entry, "probability_gouge", probability_gouge, "1", "that a shot gouges, mean of all shots"),
    SUMMARY_NUMBER(
        compare_entry, "better_than_next", better_than_next, "1",
        "fraction of what may be true in which it gouges less than the next; null: gouges is null of either"),
    SUMMARY_NUMBER(compare_entry, "worse_than_best", worse_than_best, "1",
                   "fraction of what may be true in which the best gouges less than it; of the best null, and where "
                   "gouges is null of either"),
    SUMMARY_VALUE(compare_entry, KEY_FLAG, "significant", significant, "",
                  "better_than_next is at least 0.95, by scenes and not by the screen alone"),
    SUMMARY_VALUE(compare_entry, KEY_INTEGER, "tied", tied, "1",
                  "rank of the best of its group, from which it cannot be told: 1, it cannot be told from the best"),
    SUMMARY_VALUE(compare_entry, KEY_INTEGER, "scenes", scenes, "1", "its own, shared ones not counted twice"),
    SUMMARY_TEXT(compare_entry, "layer", layer,
                 "what its layers suffer: none (no layers), intact, dented, spalled, sheared off, worn through"),
    SUMMARY_NUMBER(compare_entry, "layer_failed", layer_failed, "1",
                   "fraction of the layers over the crater that failed"),
    SUMMARY_NUMBER(compare_entry, "layer_velocity", layer_velocity, "m/s", "of the scene that says so"),
    SUMMARY_NUMBER(
        compare_entry, "life", life, "1",
        "shots until a crack, with life.load: armature; null: not asked for, not judged, or it lasts for good"),
    SUMMARY_VECTOR(compare_entry, "life_quantiles", life_quantiles, 3, "1", "the same with 5, 50 and 95 %"),
    SUMMARY_VALUE(compare_entry, KEY_INTEGER, "life_rank", life_rank, "1",
                  "as `tied`, by life, 1 for the longest; 0: not asked for"),
    SUMMARY_LIST(compare_entry, "interval_parts", part, n_parts, study_onset_part_keys, sizeof(onset_part),
                 "what its intervals hold, keys as in those of an onset"),
    SUMMARY_END
};

const summary_key study_compare_keys[] = {
    SUMMARY_TEXT(compare_result, "verdict", verdict, "which surface is best, and can it be told from the others"),
    SUMMARY_LIST(compare_result, "ranking", ranking, n, entry_keys, sizeof(compare_entry),
                 "a surface each, best first"),
    SUMMARY_LIST(compare_result, "scenes", scene, n_scenes, run_scene_keys, sizeof(onset_scene),
                 "a scene each, keys as in onset"),
    SUMMARY_VALUE(compare_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    SUMMARY_VALUE(compare_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1",
                  "by the screen, shared or bounded by others"),
    SUMMARY_VALUE(compare_result, KEY_INTEGER, "scenes_reused", scenes_reused, "1", "taken from the store"),
    SUMMARY_VALUE(compare_result, KEY_INTEGER, "shots", shots, "1", "on the same rail, study.shots"),
    SUMMARY_VALUE(compare_result, KEY_INTEGER, "histories", histories, "1", "of the Monte Carlo"),
    SUMMARY_NUMBER(compare_result, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END
};

static void print_gouges(const compare_entry *e, FILE *out)
{
    fprintf(out, "%s: ", e->surface);
    if (isfinite(e->gouges))
        fprintf(out, "%.3g gouges a shot", e->gouges);
    else
        fputs("gouges a shot not known, for no scene was run for some of its grains", out);
}

/* The verdict, and what it says of the first surface in numbers. */
static void print_verdict(const compare_result *c, FILE *out)
{
    const compare_entry *best = c->ranking, *next = c->ranking + 1;
    if (c->n < 2) return;
    fprintf(out, "\n%s\n", c->verdict);
    print_gouges(best, out);
    if (isfinite(best->gouges)) fprintf(out, " (%.3g .. %.3g)", best->gouges_interval[0], best->gouges_interval[1]);
    if (isfinite(best->threshold_velocity)) fprintf(out, ", threshold %.0f m/s", best->threshold_velocity);
    fputs("; ", out);
    print_gouges(next, out);
    fputc('\n', out);
}

static void print_ranking(const compare_result *c, FILE *out)
{
    table *t;
    const bool several = c->shots > 1;
    if (host_table_create(several ? "#|surface|gouges|from|to|the last|[mm3]|better|layer"
                                  : "#|surface|gouges|from|to|[mm3]|better|layer",
                          &t)
            .code != STATUS_OK)
        return;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        char n[24], few[24], many[24], last[24], volume[24], better[24];
        host_table_row(t, "%d|%s|%s|%s|%s%s%s|%s|%s|%s", e->tied ? e->tied : i + 1, e->surface,
                       output_cell(e->gouges, 1.0, "%.3g", n), output_cell(e->gouges_interval[0], 1.0, "%.3g", few),
                       output_cell(e->gouges_interval[1], 1.0, "%.3g", many), several ? TABLE_NEXT : "",
                       several ? output_cell(e->last_gouges, 1.0, "%.3g", last) : "",
                       output_cell(e->gouged_volume, 1e-9, "%.3g", volume),
                       output_cell(e->better_than_next, 0.01, "%.0f %%", better), e->layer);
    }
    host_table_print(t, out);
    host_table_free(t);
}

/* The threshold of each surface and where it is passed, both with their intervals. */
static void print_thresholds(const compare_result *c, FILE *out)
{
    table *t;
    if (host_table_create("surface|v_th [m/s]|from|to|x [m]|from|to", &t).code != STATUS_OK) return;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        char v[24], low[24], high[24], x[24], near[24], far[24];
        host_table_row(t, "%s|%s|%s|%s|%s|%s|%s", e->surface, output_cell(e->threshold_velocity, 1.0, "%.0f", v),
                       output_cell(e->threshold_interval[0], 1.0, "%.0f", low),
                       output_cell(e->threshold_interval[1], 1.0, "%.0f", high),
                       output_cell(e->threshold_position, 1.0, "%.3f", x),
                       output_cell(e->threshold_position_interval[0], 1.0, "%.3f", near),
                       output_cell(e->threshold_position_interval[1], 1.0, "%.3f", far));
    }
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

/* What the last shot finds on the rail of former ones; nothing where that is not carried on. */
static void print_left(const compare_result *c, FILE *out)
{
    table *t;
    bool carried = false;
    for (int i = 0; i < c->n; i++)
        carried = carried || isfinite(c->ranking[i].layer_worn) || isfinite(c->ranking[i].deposit);
    if (!carried || host_table_create("before the last shot|worn [um]|metal [um]", &t).code != STATUS_OK) return;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        char worn[24], metal[24];
        host_table_row(t, "%s|%s|%s", e->surface, output_cell(e->layer_worn, 1e-6, "%.3g", worn),
                       output_cell(e->deposit, 1e-6, "%.3g", metal));
    }
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

static double life_of(const compare_entry *e)
{
    return e->lasts ? INFINITY : e->life;
}

/* Which surface lasts longest?  Nothing where none is judged. */
static void print_life(const compare_result *c, FILE *out)
{
    const compare_entry *best = NULL;
    int tied = 0;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        if (e->life_rank != 1) continue;
        if (!best || life_of(e) > life_of(best)) best = e;
        tied++;
    }
    if (!best || isnan(life_of(best))) return;
    fprintf(out, "longest life: %s, ", best->surface);
    if (best->lasts)
        fputs("which lasts for good", out);
    else
        fprintf(out, "a crack after %.3g shots", best->life);
    fputs(tied > 1 ? "; others cannot be told apart from it\n" : "\n", out);
}

void study_compare_print(const void *result, FILE *out)
{
    const compare_result *c = result;
    print_ranking(c, out);
    print_thresholds(c, out);
    print_left(c, out);
    print_verdict(c, out);
    print_life(c, out);
}
