/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a launcher's rail and its life.  First after how many shots it cracks, where along the barrel, how deep
 * and by what; then life, strain and depth along the barrel. */
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the head ---- */

static const double LEAST_CHANCE = 1e-4; /* that is said as a number */

/* Lives come from a fit of scattered tests: two digits. */
static void write_shots(const page *p, double shots)
{
    char text[REPORT_VALUE_SIZE];
    report_value_known(shots, 0.7 * shots, 1.3 * shots, text);
    fprintf(p->out, "%s shots", text);
}

static void write_depth(const page *p, double depth)
{
    if (depth == 0.0) {
        fputs("at the face", p->out);
        return;
    }
    report_page_number(p->out, depth, 1e-3, "mm");
    fputs(" below the face", p->out);
}

static void write_place(const page *p, double position, double depth)
{
    report_page_number(p->out, position, 1.0, "m");
    fputs(" from the breech, ", p->out);
    write_depth(p, depth);
}

static void write_verdict(const page *p, const cJSON *s)
{
    const double life = report_number(s, "life");
    fputs("<p class=\"verdict\">", p->out);
    if (isfinite(life)) {
        fputs("The rail cracks ", p->out);
        if (life < 1.0)
            fputs("in the first shot", p->out);
        else
            fputs("after ", p->out), write_shots(p, life);
        fputs(", ", p->out);
        write_place(p, report_number(s, "life_position"), report_number(s, "life_depth"));
        fprintf(p->out, ", by %s.",
                strcmp(report_text(s, "life_cause"), "heat") == 0 ? "the heat of the passage" : "the contact's load");
    } else {
        fputs("No place of the rail is known to crack.", p->out);
    }
    fputs("</p>\n", p->out);
}

/* What is not known of A, and what heat does. */
static void write_doubts(const page *p, const cJSON *s)
{
    const double early = report_element(s, "life_quantiles", 0), late = report_element(s, "life_quantiles", 2);
    const double cold = report_number(s, "life_without_heat");
    fputs("<ul>\n", p->out);
    if (isfinite(early)) {
        fputs("<li>By how well the fatigue of the metal is known, with 5 % it does so within ", p->out);
        write_shots(p, early);
        fputs(", with 95 % within ", p->out);
        write_shots(p, late);
        fputs(".</li>\n", p->out);
    }
    if (isfinite(cold)) {
        fputs("<li>If heat strained nothing: ", p->out);
        write_shots(p, cold);
        fputs(", ", p->out);
        write_place(p, report_number(s, "without_heat_position"), report_number(s, "without_heat_depth"));
        fputs(".</li>\n", p->out);
    }
    const double cracked = report_number(s, "probability_cracked");
    if (isfinite(cracked)) {
        fprintf(p->out, "<li>Cracked after study.shots = %.0f: ", report_number(s, "shots"));
        if (cracked < LEAST_CHANCE)
            fputs("less than 0.01 %", p->out);
        else
            report_page_number(p->out, cracked, 1e-2, "%");
        fputs(".</li>\n", p->out);
    }
    const double from = report_number(s, "rayleigh_position");
    if (isfinite(from)) {
        fputs("<li>From ", p->out);
        report_page_number(p->out, from, 1.0, "m");
        fputs(" on the armature is faster than the rail's Rayleigh waves: no life is known there.</li>\n", p->out);
    }
    fputs("</ul>\n", p->out);
}

void report_rail_life_head(const page *p)
{
    static const page_column cards[] = { { "life_first", "shots until the first damage there", 1.0, "", NULL },
                                         { "life_range", "strain range there, largest", 1e-2, "%", NULL },
                                         { "rayleigh_speed", "Rayleigh waves of the rail", 1.0, "m/s", NULL },
                                         { "wall_seconds", "took", 1.0, "s", NULL } };
    const cJSON *s = p->source->summary;
    if (report_page_is_done(p)) {
        write_verdict(p, s);
        write_doubts(p, s);
    }
    report_page_cards(p, s, cards, PAGE_COUNT(cards));
}

/* ---- along the barrel ---- */

enum { COLUMNS = 8 };
static const char *const along[COLUMNS] = { "position",           "life", "without_heat",  "depth",
                                            "depth_without_heat", "rise", "moving_factor", "velocity" };

typedef struct {
    double *of[COLUMNS], *early, *late; /* n each; the first owns all */
    size_t n;
} barrel;

static bool read_barrel(const page *p, barrel *b)
{
    const cJSON *list = report_page_list(p, "life_along"), *entry;
    const size_t n = list ? (size_t)cJSON_GetArraySize(list) : 0;
    size_t k = 0;
    *b = (barrel){ .n = n };
    double *all = n > 1 ? malloc((COLUMNS + 2) * n * sizeof *all) : NULL;
    if (!all) return false;
    for (size_t c = 0; c < COLUMNS; c++) b->of[c] = all + c * n;
    b->early = all + COLUMNS * n, b->late = all + (COLUMNS + 1) * n;
    cJSON_ArrayForEach(entry, list)
    {
        for (size_t c = 0; c < COLUMNS; c++) b->of[c][k] = report_number(entry, along[c]);
        b->early[k] = report_element(entry, "life_interval", 0), b->late[k] = report_element(entry, "life_interval", 1);
        k++;
    }
    return true;
}

static report_chart *chart_of(const char *label, const char *unit, bool log)
{
    return report_chart_create(
        (report_axis){ .label = "along the barrel", .unit = "m", .from_zero = true, .fixed = true },
        (report_axis){ .label = label, .unit = unit, .log = log, .from_zero = !log });
}

static void draw(const page *p, const barrel *b)
{
    report_chart *c = chart_of("shots until a crack", "1", true);
    report_chart_line(c, "life", report_red, b->of[0], b->of[1], b->n);
    report_chart_thin_line(c, "5 and 95 %", report_red, b->of[0], b->early, b->n);
    report_chart_thin_line(c, "", report_red, b->of[0], b->late, b->n);
    report_chart_dashed(c, "without heat", report_blue, b->of[0], b->of[2], b->n);
    report_page_chart(p, "life-along",
                      "Shots until a crack along the barrel; the thin lines bound what may be true of "
                      "the metal's fatigue.",
                      c);
    c = chart_of("depth of the crack", "m", false);
    report_chart_line(c, "with heat", report_red, b->of[0], b->of[3], b->n);
    report_chart_dashed(c, "without heat", report_blue, b->of[0], b->of[4], b->n);
    report_page_chart(p, "depth-along", "How deep below the face the crack begins.", c);
    c = chart_of("rise of the face", "K", false);
    report_chart_line(c, "", report_red, b->of[0], b->of[5], b->n);
    report_page_chart(p, "rise-along",
                      "How much the passage warms the rail's face, no warmer than the armature's film.", c);
    c = chart_of("stress over that at rest", "1", false);
    report_chart_line(c, "", report_red, b->of[0], b->of[6], b->n);
    report_page_chart(p, "factor-along",
                      "How much more a load that runs so fast strains the rail than one that stands.", c);
}

void report_rail_life_section(const page *p)
{
    static const page_column columns[] = { { "position", "x", 1.0, "m", NULL },
                                           { "velocity", "speed", 1.0, "m/s", NULL },
                                           { "pressure", "pressure", 1e6, "MPa", NULL },
                                           { "friction", "friction", 1.0, "", NULL },
                                           { "rise", "rise", 1.0, "K", NULL },
                                           { "range", "strain range", 1e-2, "%", NULL },
                                           { "depth", "depth", 1e-3, "mm", NULL },
                                           { "life", "shots", 1.0, "", "life_interval" },
                                           { "without_heat", "without heat", 1.0, "", NULL } };
    barrel b;
    if (read_barrel(p, &b)) {
        report_page_heading(p, "Life along the barrel");
        report_page_plots_begin(p);
        draw(p, &b);
        report_page_plots_end(p);
        report_page_listed(p, "life_along", "Places", columns, PAGE_COUNT(columns));
    }
    free(b.of[0]);
}
