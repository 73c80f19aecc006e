/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of one impact on a rail, and of an ensemble of it. */
#include "coupling/report/report_page.h"

#include <string.h>

/* clang-format off */
static const page_column scene_cards[] = { { "crater_length", "length", 1e-3, "mm", NULL },
                                     { "crater_width", "width", 1e-3, "mm", NULL },
                                     { "crater_depth", "depth", 1e-3, "mm", NULL },
                                     { "rim_height", "rim", 1e-3, "mm", NULL },
                                     { "crater_volume", "volume", 1e-9, "mm&sup3;", NULL },
                                     { "widening", "widening", 1.0, "", NULL },
                                     { "length_over_width", "length over width", 1.0, "", NULL },
                                     { "severity", "severity", 1.0, "", NULL },
                                     { "groove_growth", "growth of the groove", 1e6, "/&micro;s", NULL },
                                     { "front_speed_ratio", "its front over the armature", 1.0, "", NULL },
                                     { "peak_pressure", "pressure, 99.9 %", 1e9, "GPa", NULL },
                                     { "peak_temperature", "peak temperature", 1.0, "K", NULL },
                                     { "energy_error", "energy error", 1.0, "", NULL },
                                     { "momentum_error", "momentum error", 1.0, "", NULL },
                                     { "wall_seconds", "took", 1.0, "s", NULL } };
/* clang-format on */

void report_scene_head(const page *p)
{
    const cJSON *s = p->source->summary;
    const char *class = report_text(s, "class");
    if (report_page_is_done(p)) {
        fprintf(p->out, "<p class=\"verdict\" style=\"border-color:%s\">Damage class: <b>%s</b>.</p>\n",
                report_colour(class), class[0] ? class : "not measured");
        if (report_text(s, "reason")[0]) report_page_paragraph(p, "reason", report_text(s, "reason"));
    }
    report_page_cards(p, s, scene_cards, PAGE_COUNT(scene_cards));
}

/* ---- the same scene on several grids ---- */

void report_ensemble_head(const page *p)
{
    const cJSON *scenes = report_page_list(p, "scenes"), *scene;
    const char *class = cJSON_GetArraySize(scenes) > 0 ? report_text(scenes->child, "class") : "";
    int alike = 0;
    if (!report_page_is_done(p)) return;
    cJSON_ArrayForEach(scene, scenes) alike += strcmp(report_text(scene, "class"), class) == 0;
    fprintf(p->out, "<p class=\"verdict\">The same scene on %d shifted grids", cJSON_GetArraySize(scenes));
    if (class[0]) fprintf(p->out, ": %d of them give the class <b>%s</b>", alike, class);
    fputs(".</p>\n", p->out);
}

/* The mean and the deviation over the grids: no more digits than that leaves. */
static void number_row(report_table *t, const cJSON *number)
{
    const double mean = report_number(number, "mean"), deviation = report_number(number, "deviation");
    const char *unit = report_text(number, "unit");
    char text[REPORT_VALUE_SIZE];
    if (!(report_number(number, "scenes") > 0.0)) return;
    report_table_row(t);
    report_table_text(t, number->string);
    report_value_known(mean, mean - deviation, mean + deviation, text);
    report_table_html(t, text);
    report_table_number(t, deviation, 1.0);
    report_table_number(t, report_number(number, "least"), 1.0);
    report_table_number(t, report_number(number, "largest"), 1.0);
    report_table_text(t, strcmp(unit, "1") == 0 ? "" : unit);
    report_table_number(t, report_number(number, "scenes"), 1.0);
}

static void scene_row(report_table *t, const cJSON *scene)
{
    report_table_row(t);
    report_table_text(t, report_text(scene, "scene"));
    for (int k = 0; k < 3; k++) report_table_number(t, report_element(scene, "grid_shift", k), 1.0);
    report_table_coloured(t, report_text(scene, "class"), report_colour(report_text(scene, "class")));
    report_table_number(t, report_number(scene, "wall_seconds"), 1.0);
}

void report_ensemble_section(const page *p)
{
    static const char *const numbers[] = { "mean", "deviation", "smallest", "largest", "unit", "scenes", NULL };
    static const char *const scenes[] = { "shift x [cells]", "shift y", "shift z", "class", "time [s]", NULL };
    const cJSON *item, *list = report_page_list(p, "numbers");
    report_table t;
    if (cJSON_GetArraySize(list) == 0) return;
    report_page_heading(p, "The ensemble");
    report_page_paragraph(p, "",
                          "The same scene on grids that are shifted by part of a cell: what its numbers owe to "
                          "where the cells happen to lie.");
    report_table_begin(&t, p->out);
    report_table_text_title(&t, "number");
    for (int k = 0; numbers[k]; k++) report_table_title(&t, numbers[k], "");
    cJSON_ArrayForEach(item, list) number_row(&t, item);
    report_table_end(&t);
    report_table_begin(&t, p->out);
    report_table_text_title(&t, "scene");
    for (int k = 0; scenes[k]; k++) report_table_title(&t, scenes[k], "");
    cJSON_ArrayForEach(item, report_page_list(p, "scenes")) scene_row(&t, item);
    report_table_end(&t);
}
