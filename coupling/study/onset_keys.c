/* SPDX-License-Identifier: BSD-3-Clause */
/* How an onset's result is written and printed. */
#include "coupling/study/onset.h"
#include "coupling/host/table.h"

const char *const study_site_outcome_names[] = {
    "not_reached", "skipped", "none", "scratch", "gouge", "undecided", NULL
};
static const char *const verdict_names[] = { "gouges", "no_gouging", "undecided", NULL };

static const summary_key site_keys[] = {
    SUMMARY_NUMBER(onset_site, "position", position, "m", "along the barrel"),
    SUMMARY_NUMBER(onset_site, "radius", radius, "m", "of the grain"),
    SUMMARY_NUMBER(onset_site, "time", time, "s", "of the armature's arrival; null: not reached"),
    SUMMARY_NUMBER(onset_site, "velocity", velocity, "m/s", "at arrival"),
    SUMMARY_NUMBER(onset_site, "current", current, "A", "at arrival"),
    SUMMARY_NUMBER(onset_site, "contact_pressure", contact_pressure, "Pa", "at arrival"),
    SUMMARY_NUMBER(onset_site, "lead_face_temperature", lead_face_temperature, "K",
                   "of the armature's lead face at arrival; null: armature.throat_area is not given"),
    SUMMARY_NUMBER(onset_site, "impact_pressure", impact_pressure, "Pa", "by impedance match"),
    SUMMARY_NUMBER(onset_site, "screen", screen, "1",
                   "impact pressure over hardness of the harder partner, of the rail as deep as the grain is high"),
    SUMMARY_NUMBER(onset_site, "screen_probability", screen_probability, "1",
                   "that it gouges, by that number alone: 5 % at 4.05, 95 % at 10.4, never below 1 %"),
    SUMMARY_NUMBER(onset_site, "threshold_velocity", threshold_velocity, "m/s", "of a gouge, for its grain"),
    SUMMARY_VECTOR(onset_site, "threshold_interval", threshold_interval, 2, "m/s", "of a gouge, for its grain"),
    SUMMARY_NUMBER(onset_site, "scratch_velocity", scratch_velocity, "m/s", "of a scratch, for its grain"),
    SUMMARY_VECTOR(onset_site, "scratch_interval", scratch_interval, 2, "m/s", "of a scratch, for its grain"),
    SUMMARY_NUMBER(onset_site, "gouged_volume", gouged_volume, "m3", "of its crater"),
    SUMMARY_CHOICE(onset_site, "outcome", outcome, study_site_outcome_names,
                   "not_reached, skipped, none, scratch, gouge, undecided"),
    SUMMARY_TEXT(onset_site, "scene", scene, "that decided, empty if none"),
    SUMMARY_END
};

static const summary_key surface_keys[] = {
    SUMMARY_VALUE(onset_size, KEY_INTEGER, "family", family, "1", "of grains alike in all but size"),
    SUMMARY_TEXT(onset_size, "shape", shape, "of its grains"),
    SUMMARY_TEXT(onset_size, "material", material, "of its grains"),
    SUMMARY_NUMBER(onset_size, "radius", radius, "m", "of the grain"),
    SUMMARY_NUMBER(onset_size, "grains", grains, "1", "this size stands for"),
    SUMMARY_NUMBER(onset_size, "threshold_velocity", threshold_velocity, "m/s",
                   "from which it gouges; null: outside of the search"),
    SUMMARY_VECTOR(onset_size, "threshold_interval", threshold_interval, 2, "m/s",
                   "its own band, widened as the interval of the size that was searched"),
    SUMMARY_NUMBER(onset_size, "scratch_velocity", scratch_velocity, "m/s",
                   "from which its groove grows; null: not looked for, or outside"),
    SUMMARY_VECTOR(onset_size, "scratch_interval", scratch_interval, 2, "m/s", "as threshold_interval"),
    SUMMARY_VALUE(onset_size, KEY_INTEGER, "scenes", scenes, "1", "of this size; 0: bounded by those of other sizes"),
    SUMMARY_END
};

static const summary_key skip_keys[] = { SUMMARY_TEXT(onset_skip, "rests_on", rests_on, "why no scene was needed"),
                                         SUMMARY_VALUE(onset_skip, KEY_INTEGER, "scenes", scenes, "1",
                                                       "sites, sizes or populations skipped for it"),
                                         SUMMARY_END };

static const summary_key sensitivity_keys[] = {
    SUMMARY_TEXT(onset_sensitivity, "input", input, "what is changed, by its keys, all else as it was"),
    SUMMARY_NUMBER(onset_sensitivity, "change", change, "1", "relative"),
    SUMMARY_NUMBER(onset_sensitivity, "muzzle_velocity", muzzle_velocity, "m/s", ""),
    SUMMARY_NUMBER(onset_sensitivity, "threshold_velocity", threshold_velocity, "m/s",
                   "of the grain that speaks for the case"),
    SUMMARY_NUMBER(onset_sensitivity, "threshold_position", threshold_position, "m", "along the barrel"),
    SUMMARY_NUMBER(onset_sensitivity, "expected_gouges", expected_gouges, "1", "a shot"),
    SUMMARY_END
};

const summary_key study_onset_part_keys[] = {
    SUMMARY_TEXT(onset_part, "part", part, "bracket, cells, place of the grid, or the key of an uncertain input"),
    SUMMARY_NUMBER(onset_part, "threshold_below", threshold_below, "m/s",
                   "how far it alone reaches below the gouge's velocity; null: not asked for, so not in the interval"),
    SUMMARY_NUMBER(onset_part, "threshold_above", threshold_above, "m/s", "the same above"),
    SUMMARY_NUMBER(onset_part, "scratch_below", scratch_below, "m/s", "the same below the scratch velocity"),
    SUMMARY_NUMBER(onset_part, "scratch_above", scratch_above, "m/s", "the same above it"),
    SUMMARY_END
};

static const summary_key null_model_keys[] = {
    SUMMARY_TEXT(onset_null_model, "name", name, "N1, N2, N3"),
    SUMMARY_TEXT(onset_null_model, "says", says, "what it takes for the cause"),
    SUMMARY_NUMBER(onset_null_model, "threshold_velocity", threshold_velocity, "m/s",
                   "its constant makes 7075 on copper begin at 1325 m/s"),
    SUMMARY_VECTOR(onset_null_model, "threshold_interval", threshold_interval, 2, "m/s",
                   "its constant by the two onsets reported for that pair, 1300 and 1350 m/s"),
    SUMMARY_NUMBER(onset_null_model, "threshold_position", threshold_position, "m",
                   "where that velocity is passed; null: nowhere"),
    SUMMARY_END
};

static const summary_key shot_keys[] = {
    SUMMARY_VALUE(onset_shot, KEY_INTEGER, "shot", shot, "1", "from 1, on the same rail"),
    SUMMARY_NUMBER(onset_shot, "probability_gouge", probability_gouge, "1", "that it gouges"),
    SUMMARY_NUMBER(onset_shot, "expected_gouges", expected_gouges, "1", ""),
    SUMMARY_NUMBER(onset_shot, "expected_gouged_volume", expected_gouged_volume, "m3", ""),
    SUMMARY_NUMBER(onset_shot, "onset_position", onset_position, "m",
                   "median of the first gouge; null: less than half gouge"),
    SUMMARY_VECTOR(onset_shot, "onset_interval", onset_interval, 2, "m", "5 and 95 % of the shots"),
    SUMMARY_NUMBER(onset_shot, "muzzle_velocity", muzzle_velocity, "m/s",
                   "through rails as warm as they are in the mean"),
    SUMMARY_NUMBER(onset_shot, "rail_rise", rail_rise, "K",
                   "of the rail before it: the largest from study.velocity_low on"),
    SUMMARY_NUMBER(onset_shot, "threshold_velocity", threshold_velocity, "m/s",
                   "as the study's, where the rail is that warm, worn and plated"),
    SUMMARY_NUMBER(onset_shot, "layer_worn", layer_worn, "m",
                   "thickness that sliding has worn off the rail's layers before it: the largest from "
                   "study.velocity_low on; null: no layer has a wear_rate"),
    SUMMARY_NUMBER(
        onset_shot, "deposit", deposit, "m",
        "armature metal on the rail before it, as a thickness, the largest alike; null: study.deposit_kept is "
        "not given"),
    SUMMARY_END
};

const summary_key study_onset_keys[] = {
    SUMMARY_CHOICE(onset_result, "verdict", verdict, verdict_names, "gouges, no_gouging, undecided"),
    SUMMARY_TEXT(onset_result, "reason", reason, "of the verdict"),
    SUMMARY_NUMBER(onset_result, "probability_gouge", probability_gouge, "1", "that the shot gouges"),
    SUMMARY_NUMBER(onset_result, "threshold_velocity", threshold_velocity, "m/s",
                   "from which a grain gouges, at the population's median size for a population; with "
                   "study.threshold_ensemble the mean over its grids"),
    SUMMARY_VECTOR(onset_result, "threshold_interval", threshold_interval, 2, "m/s",
                   "bracket, resolution, scatter with the grid and input uncertainty"),
    SUMMARY_NUMBER(onset_result, "growth_deviation", growth_deviation, "1",
                   "standard deviation of what decides, growth in e-folds or ln of the shape, over "
                   "study.threshold_ensemble grids, nearest the threshold; null: not asked for"),
    SUMMARY_NUMBER(onset_result, "threshold_deviation", threshold_deviation, "m/s",
                   "what that makes of the threshold; its interval holds it"),
    SUMMARY_NUMBER(onset_result, "scratch_velocity", scratch_velocity, "m/s",
                   "as threshold_velocity, from which a groove grows, furrow or gouge; null: not looked for"),
    SUMMARY_VECTOR(onset_result, "scratch_interval", scratch_interval, 2, "m/s", "as threshold_interval"),
    SUMMARY_NUMBER(onset_result, "scratch_deviation", scratch_deviation, "m/s", "as threshold_deviation"),
    SUMMARY_NUMBER(onset_result, "onset_position", onset_position, "m",
                   "of the first grain that gouges, with populations the median of the first gouge; null: none does"),
    SUMMARY_VECTOR(onset_result, "onset_interval", onset_interval, 2, "m",
                   "of it: the first site that may gouge, the first that does for sure; with populations 5 and 95 %"),
    SUMMARY_NUMBER(onset_result, "threshold_position", threshold_position, "m",
                   "where the threshold velocity is passed, whether a grain is there or not"),
    SUMMARY_VECTOR(onset_result, "threshold_position_interval", threshold_position_interval, 2, "m",
                   "where the ends of threshold_interval are passed; null: that end is not known, or "
                   "not passed in this shot"),
    SUMMARY_NUMBER(onset_result, "scratch_position", scratch_position, "m", "where the scratch velocity is passed"),
    SUMMARY_VECTOR(onset_result, "scratch_position_interval", scratch_position_interval, 2, "m",
                   "as threshold_position_interval, of scratch_interval"),
    SUMMARY_NUMBER(onset_result, "muzzle_velocity_feedback", muzzle_velocity_feedback, "m/s",
                   "with what the gouges take; null: nothing taken"),
    SUMMARY_VALUE(onset_result, KEY_INTEGER, "gouges", gouges, "1", "sites of the list that gouge"),
    SUMMARY_NUMBER(onset_result, "expected_gouges", expected_gouges, "1", "a shot, sites and populations"),
    SUMMARY_VECTOR(onset_result, "expected_gouges_interval", expected_gouges_interval, 2, "1",
                   "5 and 95 % of what may be true"),
    SUMMARY_NUMBER(onset_result, "expected_gouged_volume", expected_gouged_volume, "m3", "a shot"),
    SUMMARY_VECTOR(onset_result, "expected_gouged_volume_interval", expected_gouged_volume_interval, 2, "m3",
                   "5 and 95 %"),
    SUMMARY_VALUE(onset_result, KEY_INTEGER, "histories", histories, "1", "of the Monte Carlo"),
    SUMMARY_NUMBER(onset_result, "monte_carlo_seconds", monte_carlo_seconds, "s", "time they took"),
    SUMMARY_ARRAY(onset_result, "along", along, n_along, "m", "along the barrel"),
    SUMMARY_ARRAY(onset_result, "probability_along", probability_along, n_along, "1", "that a gouge lies before it"),
    SUMMARY_LIST(onset_result, "surface", surface, n_surface, surface_keys, sizeof(onset_size),
                 "a family and size each, keys below"),
    SUMMARY_LIST(onset_result, "skips", skip, n_skips, skip_keys, sizeof(onset_skip),
                 "why scenes were not needed, keys below"),
    SUMMARY_LIST(onset_result, "sensitivities", sensitivities, n_sensitivities, sensitivity_keys,
                 sizeof(onset_sensitivity), "keys below"),
    SUMMARY_LIST(onset_result, "shots", shot, n_shots, shot_keys, sizeof(onset_shot), "on the same rail, keys below"),
    SUMMARY_LIST(onset_result, "interval_parts", part, n_parts, study_onset_part_keys, sizeof(onset_part),
                 "what both intervals hold: the bracket, and on it the root of the sum of squares of all others, keys "
                 "below"),
    SUMMARY_LIST(onset_result, "null_models", null_model, n_null_models, null_model_keys, sizeof(onset_null_model),
                 "what one number of the two metals alone would say, keys below"),
    SUMMARY_VALUE(onset_result, KEY_INTEGER, "scenes_reused", scenes_reused, "1", "taken from the store"),
    SUMMARY_VALUE(onset_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    SUMMARY_VALUE(onset_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1", "by the screen or shared"),
    SUMMARY_LIST(onset_result, "sites", site, n_sites, site_keys, sizeof(onset_site), "a site each, keys below"),
    SUMMARY_LIST(onset_result, "scenes", scene, n_scenes, run_scene_keys, sizeof(onset_scene),
                 "a scene each, keys below"),
    SUMMARY_NUMBER(onset_result, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END
};

/* ---- for people ---- */

/* A blank line, the table, and its end. */
static void close_table(table *t, FILE *out)
{
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

static void print_sites(const onset_result *o, FILE *out)
{
    table *t;
    if (o->n_sites == 0 ||
        host_table_create("site|x [m]|v [m/s]|I [kA]|p [GPa]|p/H|outcome|scene", &t).code != STATUS_OK)
        return;
    for (int i = 0; i < o->n_sites; i++) {
        const onset_site *s = &o->site[i];
        char x[24], v[24], current[24], p[24], h[24];
        host_table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s", i + 1, output_cell(s->position, 1.0, "%.3f", x),
                       output_cell(s->velocity, 1.0, "%.0f", v), output_cell(s->current, 1e3, "%.0f", current),
                       output_cell(s->impact_pressure, 1e9, "%.2f", p), output_cell(s->screen, 1.0, "%.1f", h),
                       study_site_outcome_names[s->outcome], s->scene);
    }
    close_table(t, out);
}

static void print_grooves(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "scene|v [m/s]|r [mm]|cells/r|growth [1/us]|front/v|l/w|class|time [s]";
    if (o->n_scenes == 0 || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_scenes; i++) {
        const onset_scene *s = &o->scene[i];
        char v[24], r[24], c[24], growth[24], front[24], shape[24], w[24];
        host_table_row(t, "%s|%s|%s|%s|%s|%s|%s|%s|%s", s->name, output_cell(s->velocity, 1.0, "%.0f", v),
                       output_cell(s->radius, 1e-3, "%.3g", r), output_cell(s->cells_per_radius, 1.0, "%.3g", c),
                       output_cell(s->result.groove_growth, 1e6, "%.3f", growth),
                       output_cell(s->result.front_speed_ratio, 1.0, "%.2f", front),
                       output_cell(s->result.length_over_width, 1.0, "%.1f", shape), run_damage_names[s->result.class],
                       s->reused ? "reused" : output_cell(s->result.wall_seconds, 1.0, "%.1f", w));
    }
    close_table(t, out);
}

/* Of the scenes that went to their end. */
static void print_craters(const onset_result *o, FILE *out)
{
    table *t;
    int n = 0;
    const char *titles = "whole crater|v [m/s]|severity|widening|length [mm]|width [mm]|depth [mm]|class|by shape";
    if (host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_scenes; i++) {
        const onset_scene *s = &o->scene[i];
        char v[24], severity[24], widening[24], l[24], w[24], d[24];
        if (s->gauged) continue;
        host_table_row(t, "%s|%s|%s|%s|%s|%s|%s|%s|%s", s->name, output_cell(s->velocity, 1.0, "%.0f", v),
                       output_cell(s->result.severity, 1.0, "%.2f", severity),
                       output_cell(s->result.widening, 1.0, "%.2f", widening),
                       output_cell(s->result.crater_length, 1e-3, "%.2f", l),
                       output_cell(s->result.crater_width, 1e-3, "%.2f", w),
                       output_cell(s->result.crater_depth, 1e-3, "%.2f", d), run_damage_names[s->result.class],
                       run_damage_names[s->result.crater_class]);
        n++;
    }
    if (n > 0)
        close_table(t, out);
    else
        host_table_free(t);
}

/* What the intervals hold; "-": not asked for. */
static void print_parts(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "in the interval|gouge - [m/s]|gouge + [m/s]|scratch - [m/s]|scratch + [m/s]";
    if (o->n_parts == 0 || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_parts; i++) {
        const onset_part *p = &o->part[i];
        char cell[4][24];
        host_table_row(t, "%s|%s|%s|%s|%s", p->part, output_cell(p->threshold_below, 1.0, "%.0f", cell[0]),
                       output_cell(p->threshold_above, 1.0, "%.0f", cell[1]),
                       output_cell(p->scratch_below, 1.0, "%.0f", cell[2]),
                       output_cell(p->scratch_above, 1.0, "%.0f", cell[3]));
    }
    close_table(t, out);
}

/* The scenes' answer among those of one number each. */
static void print_null_models(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "threshold by|v_th [m/s]|from|to|passed at [m]";
    char v[24], low[24], high[24], x[24];
    if (o->n_null_models == 0 || host_table_create(titles, &t).code != STATUS_OK) return;
    host_table_row(t, "scenes, a scratch|%s|%s|%s|%s", output_cell(o->scratch_velocity, 1.0, "%.0f", v),
                   output_cell(o->scratch_interval[0], 1.0, "%.0f", low),
                   output_cell(o->scratch_interval[1], 1.0, "%.0f", high),
                   output_cell(o->scratch_position, 1.0, "%.3f", x));
    host_table_row(t, "scenes, a gouge|%s|%s|%s|%s", output_cell(o->threshold_velocity, 1.0, "%.0f", v),
                   output_cell(o->threshold_interval[0], 1.0, "%.0f", low),
                   output_cell(o->threshold_interval[1], 1.0, "%.0f", high),
                   output_cell(o->threshold_position, 1.0, "%.3f", x));
    for (int i = 0; i < o->n_null_models; i++) {
        const onset_null_model *m = &o->null_model[i];
        host_table_row(t, "%s|%s|%s|%s|%s", m->name, output_cell(m->threshold_velocity, 1.0, "%.0f", v),
                       output_cell(m->threshold_interval[0], 1.0, "%.0f", low),
                       output_cell(m->threshold_interval[1], 1.0, "%.0f", high),
                       output_cell(m->threshold_position, 1.0, "%.3f", x));
    }
    close_table(t, out);
    for (int i = 0; i < o->n_null_models; i++)
        fprintf(out, "%s: by %s\n", o->null_model[i].name, o->null_model[i].says);
    fputs("N1 to N3 have one constant each, by 7075 on copper at 1325 m/s\n", out);
}

static void print_shots(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "shot|rail +[K]|worn [um]|metal [um]|muzzle [m/s]|v_th [m/s]|gouges|[mm3]|onset [m]";
    if (o->n_shots < 2 || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_shots; i++) {
        const onset_shot *s = &o->shot[i];
        char rise[24], worn[24], metal[24], muzzle[24], v[24], n[24], volume[24], x[24];
        host_table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s|%s", s->shot, output_cell(s->rail_rise, 1.0, "%.0f", rise),
                       output_cell(s->layer_worn, 1e-6, "%.3g", worn), output_cell(s->deposit, 1e-6, "%.3g", metal),
                       output_cell(s->muzzle_velocity, 1.0, "%.0f", muzzle),
                       output_cell(s->threshold_velocity, 1.0, "%.0f", v),
                       output_cell(s->expected_gouges, 1.0, "%.3g", n),
                       output_cell(s->expected_gouged_volume, 1e-9, "%.3g", volume),
                       output_cell(s->onset_position, 1.0, "%.3f", x));
    }
    close_table(t, out);
}

void study_onset_print(const void *result, FILE *out)
{
    const onset_result *o = result;
    output_keys_print(&(summary_object){ study_onset_keys, o }, out);
    print_sites(o, out);
    print_grooves(o, out);
    print_craters(o, out);
    print_parts(o, out);
    print_null_models(o, out);
    print_shots(o, out);
    if (o->reason[0]) fprintf(out, "\n%s: %s\n", verdict_names[o->verdict], o->reason);
}
