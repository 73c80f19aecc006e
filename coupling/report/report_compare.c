/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a comparison of surfaces.  First which is best and whether it can be told apart; then the speed at which
 * each gives way beside the speeds of the shot; then each surface by itself. */
#include "coupling/report/report_onset.h"

#include "coupling/report/report_svg.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the headline ---- */

/* There are grains that no scene was run for. */
static bool is_undrawn(const cJSON *entry)
{
    return !isfinite(report_number(entry, "gouges"));
}

static const double QUIET = 0.05; /* probability below which the screen calls grains so, as the verdict takes it */

static bool gouges_not(const cJSON *entry)
{
    const bool quiet = is_undrawn(entry) && report_number(entry, "probability_gouge") < QUIET;
    return (report_number(entry, "gouges") == 0.0 || quiet) && !isfinite(report_number(entry, "threshold_velocity"));
}

static void write_threshold(FILE *out, const cJSON *entry)
{
    report_page_interval(out, report_number(entry, "threshold_velocity"),
                         report_element(entry, "threshold_interval", 0), report_element(entry, "threshold_interval", 1),
                         1.0, "m/s");
}

static void write_gouges(FILE *out, const cJSON *entry)
{
    report_page_interval(out, report_number(entry, "gouges"), report_element(entry, "gouges_interval", 0),
                         report_element(entry, "gouges_interval", 1), 1.0, "gouges a shot");
}

static const cJSON *untreated_of(const cJSON *ranking)
{
    const cJSON *entry;
    cJSON_ArrayForEach(entry, ranking)
    {
        if (strcmp(report_text(entry, "surface"), "untreated") == 0) return entry;
    }
    return NULL;
}

/* One sentence of a surface: from which speed on it gouges, and how often. */
static void write_surface(FILE *out, const cJSON *entry)
{
    if (gouges_not(entry)) {
        fputs("does not gouge in this shot", out);
        if (report_number(entry, "scenes") == 0.0) fputs(" as far as is known: no scene of its own was run", out);
        return;
    }
    if (is_undrawn(entry) && !isfinite(report_number(entry, "threshold_velocity"))) {
        fputs("may gouge or not: no scene was run for some of its grains", out);
        return;
    }
    fputs("gouges from ", out);
    write_threshold(out, entry);
    fputs(" on, ", out);
    if (is_undrawn(entry))
        fputs("how often is not known: no scene was run for some of its grains", out);
    else
        write_gouges(out, entry);
}

/* The verdict as the summary has it, as a sentence. */
static void write_verdict(FILE *out, const char *verdict)
{
    const char first[2] = { (char)toupper((unsigned char)verdict[0]), '\0' };
    if (!verdict[0]) return;
    fputs("<p class=\"verdict\">", out);
    report_svg_escaped(out, first);
    report_svg_escaped(out, verdict + 1);
    fputs(".</p>\n", out);
}

void report_compare_head(const page *p)
{
    const cJSON *ranking = report_page_list(p, "ranking"), *plain = untreated_of(ranking), *best = ranking->child;
    if (!report_page_is_done(p) || !best) return;
    write_verdict(p->out, report_text(p->source->summary, "verdict"));
    fputs("<ul>\n<li><b>", p->out);
    report_svg_escaped(p->out, report_text(best, "surface"));
    fputs("</b> ", p->out);
    write_surface(p->out, best);
    fputs(".</li>\n", p->out);
    if (plain && plain != best) {
        fputs("<li>The untreated rail ", p->out);
        write_surface(p->out, plain);
        fputs(".</li>\n", p->out);
    }
    fputs("</ul>\n", p->out);
}

/* ---- where each gives way ---- */

enum { WIDTH = 440, LEFT = 58, RIGHT = 14, TOP = 22, CURVE = 170, ROW = 34 };

#define HALO "font-size=\"12\" paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"4\""

typedef struct {
    FILE *out;
    report_scale v, x; /* velocity across, position up */
    double bottom;     /* of the whole */
} beside;

static void draw_grid(const beside *b)
{
    report_svg_grid_across(b->out, &b->v, 6, TOP, b->bottom, 16.0);
    report_svg_text(b->out, 0.5 * (b->v.from + b->v.to), b->bottom + 36.0, "middle", "", "velocity [m/s]");
    report_svg_grid_up(b->out, &b->x, 4, b->v.from, b->v.to);
    report_svg_upward_title(b->out, TOP + 0.5 * CURVE, "reached at [m]");
}

static void draw_curve(const beside *b, const report_curve *c, size_t n)
{
    double *x = malloc((n + 1) * sizeof *x), *y = malloc((n + 1) * sizeof *y);
    for (size_t i = 0; x && y && i < n; i++) {
        x[i] = report_scale_at(&b->v, c->y[i]);
        y[i] = report_scale_at(&b->x, c->x[i]);
    }
    if (x && y) report_svg_line(b->out, x, y, n, report_blue, 2.0, false);
    free(x);
    free(y);
}

/* A thin line from the velocity up to the shot's curve. */
static void draw_lead(const beside *b, const cJSON *entry, int k, const report_curve *c, double fastest)
{
    const double v = report_number(entry, "threshold_velocity"), y = TOP + CURVE + 14.0 + ROW * k + 22.0;
    size_t i = 0;
    if (!(v <= fastest)) return;
    while (i + 1 < c->n && c->y[i] < v) i++;
    const double at = report_scale_at(&b->v, v);
    report_svg_line(b->out, (double[2]){ at, at }, (double[2]){ report_scale_at(&b->x, c->x[i]), y }, 2,
                    report_shade(k), 1.0, true);
}

/* The interval as a bar, the velocity as a dot. */
static void draw_surface(const beside *b, const cJSON *entry, int k)
{
    const double v = report_number(entry, "threshold_velocity"), lo = report_element(entry, "threshold_interval", 0),
                 hi = report_element(entry, "threshold_interval", 1);
    const double y = TOP + CURVE + 14.0 + ROW * k + 22.0;
    const char *colour = report_shade(k);
    char text[300], value[REPORT_VALUE_SIZE];
    report_value_interval(v, lo, hi, value);
    snprintf(text, sizeof text, "%.40s: %s", report_text(entry, "surface"),
             strcmp(value, "&ndash;") ? value : "not known");
    report_svg_text(b->out, LEFT + 4.0, y - 8.0, "start", HALO, text);
    const double a = isfinite(lo) ? fmax(report_scale_at(&b->v, lo), b->v.from) : b->v.from,
                 e = isfinite(hi) ? fmin(report_scale_at(&b->v, hi), b->v.to) : b->v.to;
    if (isfinite(lo) || isfinite(hi))
        fprintf(b->out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"8\" fill=\"%s\" fill-opacity=\"0.35\"/>\n",
                a, y - 3.0, e - a, colour);
    if (!isfinite(hi) && isfinite(lo)) report_svg_text(b->out, b->v.to, y + 5.0, "end", "", "\342\206\222");
    if (!isfinite(v)) return;
    const double at = report_scale_at(&b->v, v);
    fprintf(b->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\"/>\n", at, y + 1.0, colour);
}

/* Velocities that the picture has to hold: those of the shot, and of every surface. */
static double largest_velocity(const cJSON *ranking, double fastest)
{
    double largest = fastest;
    const cJSON *entry;
    cJSON_ArrayForEach(entry, ranking)
    {
        const double all[] = { report_number(entry, "threshold_velocity"),
                               report_element(entry, "threshold_interval", 0),
                               report_element(entry, "threshold_interval", 1) };
        for (int k = 0; k < 3; k++)
            if (isfinite(all[k])) largest = fmax(largest, fmin(all[k], 3.0 * fastest));
    }
    return largest;
}

static void draw_beside(FILE *out, const page *p, const report_curve *c, size_t n)
{
    const cJSON *ranking = report_page_list(p, "ranking"), *entry;
    const int rows = cJSON_GetArraySize(ranking);
    const double fastest = c->y[n - 1];
    beside b = { .out = out,
                 .v = { 0.0, 1.05 * largest_velocity(ranking, fastest), LEFT, WIDTH - RIGHT, false },
                 .x = { 0.0, 1.03 * c->x[n - 1], TOP + CURVE, TOP, false },
                 .bottom = TOP + CURVE + 20.0 + ROW * rows };
    int k = 0;
    report_svg_begin(out, WIDTH, b.bottom + 44.0, "where each surface gives way");
    draw_grid(&b);
    draw_curve(&b, c, n);
    const double muzzle = report_scale_at(&b.v, fastest);
    report_svg_line(out, (double[2]){ muzzle, muzzle }, (double[2]){ TOP, b.bottom }, 2, "#555555", 1.3, true);
    report_svg_text(out, muzzle - 4.0, TOP - 6.0, "end", "font-size=\"12\" fill=\"#555\"", "muzzle");
    cJSON_ArrayForEach(entry, ranking) draw_lead(&b, entry, k++, c, fastest);
    k = 0;
    cJSON_ArrayForEach(entry, ranking) draw_surface(&b, entry, k++);
    report_svg_end(out);
}

static void section_beside(const page *p)
{
    char *text = NULL;
    size_t size;
    const double exit = report_number(report_page_list(p, "shot"), "muzzle_time");
    report_curve time = report_curve_read(p->source, "/shot/time", "/shot/position");
    report_curve c = report_curve_read(p->source, "/shot/position", "/shot/velocity");
    const size_t until = isfinite(exit) ? report_curve_until(&time, exit) : c.n, n = until < c.n ? until : c.n;
    FILE *out = n > 1 ? open_memstream(&text, &size) : NULL;
    if (out) {
        draw_beside(out, p, &c, n);
        fclose(out);
        report_page_svg(
            p, "ranking",
            "Curve: where the shot has a velocity. Below, best first: from which velocity on each surface "
            "gouges, with its interval; the dashed lines lead to where that is along the barrel. A bar with an "
            "arrow has no upper end that is known.",
            text);
    }
    report_curve_free(&time);
    report_curve_free(&c);
}

/* ---- each by itself ---- */

/* clang-format off */
static const page_column ranking_columns[] = {
    { "surface", "surface", 1.0, "", NULL },
    { "tied", "rank", 1.0, "", NULL },
    { "threshold_velocity", "gouges from", 1.0, "m/s", "threshold_interval" },
    { "threshold_position", "passed at", 1.0, "m", "threshold_position_interval" },
    { "gouges", "gouges a shot", 1.0, "", "gouges_interval" },
    { "last_gouges", "of the last shot", 1.0, "", NULL },
    { "layer_worn", "layers worn by", 1e-6, "\302\265m", NULL },
    { "deposit", "armature metal on it", 1e-6, "\302\265m", NULL },
    { "better_than_next", "better than the next", 0.01, "%", NULL },
    { "significant", "that is significant", 1.0, "", NULL },
    { "gouged_volume", "gouged volume", 1e-9, "mm\302\263", "gouged_volume_interval" },
    { "life", "shots until a crack", 1.0, "", NULL },
    { "layer", "its layers", 1.0, "", NULL },
    { "layer_failed", "layers over the crater that failed", 0.01, "%", NULL },
    { "scenes", "scenes", 1.0, "", NULL } };
/* clang-format on */

/* The growth of each surface's grooves in a chart of its own, with its interval. */
static void section_each(const page *p)
{
    const cJSON *entry;
    int k = 0;
    if (!cJSON_GetObjectItemCaseSensitive(report_page_list(p, "ranking")->child, "scene_prefix")) {
        report_page_plots_begin(p);
        report_onset_threshold_chart(p, "threshold", "One point a scene, of all surfaces.", NULL, NULL);
        report_page_plots_end(p);
        return;
    }
    report_page_plots_begin(p);
    cJSON_ArrayForEach(entry, report_page_list(p, "ranking"))
    {
        char name[40], caption[160];
        snprintf(name, sizeof name, "threshold-%d", ++k);
        snprintf(caption, sizeof caption, "%d: %.100s. Shaded: its interval.", k, report_text(entry, "surface"));
        report_onset_threshold_chart(p, name, caption, entry, report_text(entry, "scene_prefix"));
    }
    report_page_plots_end(p);
}

void report_compare_section(const page *p)
{
    if (cJSON_GetArraySize(report_page_list(p, "ranking")) == 0) return;
    report_page_heading(p, "Where each surface gives way");
    section_beside(p);
    report_page_heading(p, "Surfaces, best first");
    report_page_list_table(p, report_page_list(p, "ranking"), ranking_columns, PAGE_COUNT(ranking_columns));
    if (cJSON_GetArraySize(report_page_list(p, "scenes")) == 0) return;
    report_page_heading(p, "The scenes that decide");
    section_each(p);
    report_onset_scene_tables(p);
}
