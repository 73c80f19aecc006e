/* SPDX-License-Identifier: BSD-3-Clause */
/* What the studies add to the report. */
#include "coupling/report/report_page.h"

#include <string.h>

/* ---- a scene ---- */

static void scene_sentence(const page *p, const cJSON *s)
{
    const char *class = report_text(s, "class");
    fprintf(p->out, "<p class=\"verdict\" style=\"border-color:%s\">Damage class: %s.</p>\n", report_colour(class),
            class[0] ? class : "not measured");
    if (report_text(s, "reason")[0]) report_page_paragraph(p, "reason", report_text(s, "reason"));
}

/* clang-format off */
static const page_column scene_cards[] = { { "severity", "severity", 1.0, "" },
                                     { "groove_growth", "growth of the groove", 1e6, "1/&micro;s" },
                                     { "front_speed_ratio", "speed of its front over the armature's", 1.0, "" },
                                     { "length_over_width", "length over width", 1.0, "" },
                                     { "widening", "widening", 1.0, "" },
                                     { "crater_length", "length", 1e-3, "mm" },
                                     { "crater_width", "width", 1e-3, "mm" },
                                     { "crater_depth", "depth", 1e-3, "mm" },
                                     { "crater_volume", "volume", 1e-9, "mm&sup3;" },
                                     { "rim_height", "rim", 1e-3, "mm" },
                                     { "peak_pressure", "pressure, 99.9 %", 1e9, "GPa" },
                                     { "peak_temperature", "peak temperature", 1.0, "K" },
                                     { "energy_error", "energy error", 1.0, "" },
                                     { "momentum_error", "momentum error", 1.0, "" },
                                     { "wall_seconds", "wall time", 1.0, "s" } };
/* clang-format on */

void report_scene_verdict(const page *p)
{
    if (report_page_is_done(p)) scene_sentence(p, p->source->summary);
    report_page_cards(p, p->source->summary, scene_cards, PAGE_COUNT(scene_cards));
}

/* ---- where gouging begins ---- */

static void onset_sentence(const page *p)
{
    const cJSON *s = p->source->summary;
    const char *verdict = report_text(s, "verdict");
    FILE *out = p->out;
    if (strcmp(verdict, "gouges") == 0) {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">Gouging begins ", report_colour("gouge"));
        report_page_number(out, report_number(s, "onset_position"), 1.0, "m");
        fputs(" from the breech (", out);
        report_page_number(out, report_element(s, "onset_interval", 0), 1.0, "");
        fputs(" to ", out);
        report_page_number(out, report_element(s, "onset_interval", 1), 1.0, "m");
        fputs("), at ", out);
        report_page_number(out, report_number(s, "threshold_velocity"), 1.0, "m/s");
        fputs(" (", out);
        report_page_number(out, report_element(s, "threshold_interval", 0), 1.0, "");
        fputs(" to ", out);
        report_page_number(out, report_element(s, "threshold_interval", 1), 1.0, "m/s");
        fputs(").</p>\n", out);
    } else if (strcmp(verdict, "no_gouging") == 0) {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">No gouging in this shot.</p>\n",
                report_colour("none"));
    } else {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">Undecided.</p>\n", report_colour("undecided"));
    }
    if (report_text(s, "reason")[0]) report_page_paragraph(p, "reason", report_text(s, "reason"));
}

/* clang-format off */
static const page_column onset_cards[] = { { "threshold_velocity", "a grain gouges from", 1.0, "m/s" },
                                     { "scratch_velocity", "a groove grows from", 1.0, "m/s" },
                                     { "onset_position", "onset position", 1.0, "m" },
                                     { "probability_gouge", "probability of a gouge", 1.0, "" },
                                     { "scenes_run", "scenes run", 1.0, "" },
                                     { "scenes_skipped", "scenes skipped", 1.0, "" },
                                     { "wall_seconds", "wall time", 1.0, "s" } };
/* clang-format on */

void report_onset_verdict(const page *p)
{
    if (report_page_is_done(p)) onset_sentence(p);
    report_page_cards(p, p->source->summary, onset_cards, PAGE_COUNT(onset_cards));
}

/* clang-format off */
static const page_column site_columns[] = { { "position", "x", 1.0, "m" },
                                      { "velocity", "v", 1.0, "m/s" },
                                      { "radius", "radius", 1e-3, "mm" },
                                      { "current", "current", 1e3, "kA" },
                                      { "contact_pressure", "contact pressure", 1e6, "MPa" },
                                      { "impact_pressure", "impact pressure", 1e9, "GPa" },
                                      { "screen", "p/H", 1.0, "" },
                                      { "outcome", "outcome", 1.0, "" },
                                      { "scene", "scene", 1.0, "" } };
static const page_column scene_columns[] = { { "name", "scene", 1.0, "" },
                                       { "velocity", "v", 1.0, "m/s" },
                                       { "radius", "radius", 1e-3, "mm" },
                                       { "cells_per_radius", "cells per radius", 1.0, "" },
                                       { "class", "class", 1.0, "" },
                                       { "gauged", "only until its growth was known", 1.0, "" },
                                       { "severity", "severity", 1.0, "" },
                                       { "groove_growth", "growth", 1e6, "1/&micro;s" },
                                       { "growth_per_way", "growth", 1e3, "1/mm" },
                                       { "front_speed_ratio", "front over armature", 1.0, "" },
                                       { "widening", "widening", 1.0, "" },
                                       { "crater_length", "length", 1e-3, "mm" },
                                       { "crater_width", "width", 1e-3, "mm" },
                                       { "length_over_width", "length over width", 1.0, "" },
                                       { "crater_depth", "depth", 1e-3, "mm" },
                                       { "rim_height", "rim", 1e-3, "mm" },
                                       { "crater_volume", "volume", 1e-9, "mm&sup3;" },
                                       { "wall_seconds", "time", 1.0, "s" } };
static const page_column size_columns[] = {
    { "family", "kind", 1.0, "" },        { "shape", "shape", 1.0, "" },
    { "material", "material", 1.0, "" },  { "radius", "radius", 1e-3, "mm" },
    { "grains", "grains", 1.0, "" },      { "threshold_velocity", "threshold", 1.0, "m/s" },
    { "threshold_interval", "interval", 1.0, "m/s" }, { "scratch_velocity", "scratches from", 1.0, "m/s" },
    { "scratch_interval", "interval", 1.0, "m/s" },   { "scenes", "scenes of this size", 1.0, "" } };
static const page_column skip_columns[] = { { "rests_on", "why no scene was needed", 1.0, "" },
                                            { "scenes", "scenes", 1.0, "" } };
static const page_column sensitivity_columns[] = {
    { "input", "changed", 1.0, "" },                      { "change", "by", 0.01, "%" },
    { "muzzle_velocity", "muzzle velocity", 1.0, "m/s" }, { "threshold_velocity", "threshold", 1.0, "m/s" },
    { "threshold_position", "passed at", 1.0, "m" },      { "expected_gouges", "expected gouges", 1.0, "" } };
static const page_column null_model_columns[] = {
    { "name", "null model", 1.0, "" },                 { "says", "the cause it takes", 1.0, "" },
    { "threshold_velocity", "threshold", 1.0, "m/s" }, { "threshold_interval", "interval", 1.0, "m/s" },
    { "threshold_position", "passed at", 1.0, "m" } };
static const page_column repeated_columns[] = {
    { "shot", "shot", 1.0, "" },                       { "probability_gouge", "P(gouge)", 1.0, "" },
    { "expected_gouges", "expected gouges", 1.0, "" }, { "expected_gouged_volume", "gouged volume", 1e-9, "mm&sup3;" },
    { "onset_position", "onset", 1.0, "m" },           { "onset_interval", "5 to 95 %", 1.0, "m" },
    { "rail_rise", "rail warmer by", 1.0, "K" },       { "threshold_velocity", "threshold there", 1.0, "m/s" },
    { "muzzle_velocity", "muzzle", 1.0, "m/s" } };
static const page_column ranking_columns[] = {
    { "surface", "surface", 1.0, "" },
    { "gouges", "gouges", 1.0, "" },                       { "gouges_interval", "5 to 95 %", 1.0, "" },
    { "better_than_next", "better than the next", 0.01, "%" },
    { "significant", "significant", 1.0, "" },             { "tied", "rank", 1.0, "" },
    { "threshold_velocity", "threshold", 1.0, "m/s" },     { "threshold_interval", "interval", 1.0, "m/s" },
    { "onset_position", "onset", 1.0, "m" },
    { "gouged_volume", "gouged volume", 1e-9, "mm&sup3;" }, { "gouged_volume_interval", "5 to 95 %", 1e-9, "mm&sup3;" },
    { "layer", "its layers", 1.0, "" },                    { "layer_failed", "failed", 0.01, "%" },
    { "scenes", "scenes", 1.0, "" } };
/* clang-format on */

static const cJSON *list_of(const page *p, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(p->source->summary, key);
}

static void section_threshold(const page *p)
{
    if (cJSON_GetArraySize(list_of(p, "scenes")) == 0) return;
    report_page_heading(p, "The threshold");
    if (cJSON_GetArraySize(list_of(p, "surface")) > 1) {
        report_page_draw(p, report_plot_surface, "surface",
                         "One point a scene. Line and shade: the threshold and its interval.");
        report_page_list_table(p, list_of(p, "surface"), size_columns, PAGE_COUNT(size_columns));
    }
    report_page_draw(p, report_plot_threshold, "threshold",
                     "One point a scene that was run. Shaded: the interval of gouges and, paler, of scratches.");
    report_page_list_table(p, list_of(p, "scenes"), scene_columns, PAGE_COUNT(scene_columns));
}

void report_section_onset(const page *p)
{
    if (cJSON_GetArraySize(list_of(p, "sites")) > 0) {
        report_page_heading(p, "Along the barrel");
        report_page_draw(p, report_plot_barrel, "barrel",
                         "Shaded: the intervals of the onset position and of the threshold velocity.");
        report_page_list_table(p, list_of(p, "sites"), site_columns, PAGE_COUNT(site_columns));
    }
    section_threshold(p);
    report_page_listed(p, "null_models", "What one number of the two metals alone would say (7075 on copper: 1325 m/s)",
                       null_model_columns, PAGE_COUNT(null_model_columns));
    report_page_listed(p, "skips", "Scenes that were not needed", skip_columns, PAGE_COUNT(skip_columns));
    report_page_listed(p, "sensitivities", "What moves the answer", sensitivity_columns,
                       PAGE_COUNT(sensitivity_columns));
    report_page_listed(p, "shots", "Shot after shot on the same rail", repeated_columns, PAGE_COUNT(repeated_columns));
}

void report_section_compare(const page *p)
{
    if (cJSON_GetArraySize(list_of(p, "ranking")) > 0) {
        report_page_heading(p, "Surfaces, best first");
        report_page_draw(p, report_plot_ranking, "ranking", "");
        report_page_list_table(p, list_of(p, "ranking"), ranking_columns, PAGE_COUNT(ranking_columns));
    }
    report_section_onset(p);
}

void report_section_inductance(const page *p)
{
    report_page_heading(p, "Inductance and resistance gradients");
    report_page_draw(p, report_plot_inductance, "inductance", "");
    report_page_draw(p, report_plot_perimeter, "perimeter", "Current and heating along the rail's surface.");
}
