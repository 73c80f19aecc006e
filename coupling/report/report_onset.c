/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a study of the onset.  First what a designer asks: from which speed on, where along the barrel, how sure,
 * what to do about it.  Then what that rests on. */
#include "coupling/report/report_onset.h"

#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- scenes ---- */

/* It ended once the growth of its groove was known: judged by growth, those of the search do. */
static bool is_gauged(const cJSON *scene)
{
    return cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(scene, "gauged"));
}

static bool are_judged_by_growth(const cJSON *scenes)
{
    const cJSON *scene;
    cJSON_ArrayForEach(scene, scenes)
    {
        if (is_gauged(scene)) return true;
    }
    return false;
}

/* ---- the two speeds ---- */

typedef struct {
    const char *what, *means, *velocity, *interval, *position, *position_interval, *outcome;
} speed;

static const speed speeds[] = {
    { "Scratches", "the groove behind a grain grows, as a furrow or a gouge", "scratch_velocity", "scratch_interval",
      "scratch_position", "scratch_position_interval", "scratch" },
    { "Gouges", "the groove becomes a tear-drop with a rim", "threshold_velocity", "threshold_interval",
      "threshold_position", "threshold_position_interval", "gouge" },
};

/* What the summary says of a number with an interval. */
typedef struct {
    double at, lo, hi;
} known;

static known known_of(const cJSON *s, const char *key, const char *interval)
{
    return (known){ report_number(s, key), report_element(s, interval, 0), report_element(s, interval, 1) };
}

static bool is_known(const known *k)
{
    return isfinite(k->at) || isfinite(k->lo) || isfinite(k->hi);
}

static void write_known(FILE *out, const known *k, const char *unit)
{
    report_page_interval(out, k->at, k->lo, k->hi, 1.0, unit);
}

static void speed_box(const page *p, const speed *k)
{
    const cJSON *s = p->source->summary;
    const known v = known_of(s, k->velocity, k->interval), x = known_of(s, k->position, k->position_interval);
    if (!is_known(&v)) return;
    fprintf(p->out, "<div class=\"speed\" style=\"border-color:%s\"><span>%s from</span><b>", report_colour(k->outcome),
            k->what);
    write_known(p->out, &v, "m/s");
    fputs("</b>", p->out);
    if (is_known(&x)) {
        fputs("<span>passed at</span><b>", p->out);
        write_known(p->out, &x, "m");
        fputs("</b><span>from the breech</span>", p->out);
    } else {
        fputs("<span>not reached in this shot</span>", p->out);
    }
    fprintf(p->out, "<small>%s</small></div>\n", k->means);
}

/* ---- the verdict ---- */

static void verdict_sentence(const page *p)
{
    const cJSON *s = p->source->summary;
    const char *verdict = report_text(s, "verdict");
    const known v = known_of(s, "threshold_velocity", "threshold_interval"),
                x = known_of(s, "threshold_position", "threshold_position_interval");
    const bool gouges = strcmp(verdict, "gouges") == 0, none = strcmp(verdict, "no_gouging") == 0;
    fprintf(p->out, "<p class=\"verdict\" style=\"border-color:%s\">",
            report_colour(gouges ? "gouge"
                          : none ? "none"
                                 : "undecided"));
    if (gouges) {
        fputs("This rail gouges: from ", p->out);
        write_known(p->out, &v, "m/s");
        if (is_known(&x)) {
            fputs(" on, a speed that the armature has ", p->out);
            write_known(p->out, &x, "m");
            fputs(" from the breech", p->out);
        }
        fputs(".</p>\n", p->out);
    } else if (none) {
        fputs("No gouging in this shot.", p->out);
        if (is_known(&v)) {
            fputs(" A grain gouges from ", p->out);
            write_known(p->out, &v, "m/s");
            fputs(" on.", p->out);
        }
        fputs("</p>\n", p->out);
    } else {
        fputs(is_known(&v) ? "Undecided: this shot comes near the speed at which a grain gouges, "
                           : "Undecided: from which speed on a grain gouges is not known",
              p->out);
        if (is_known(&v)) write_known(p->out, &v, "m/s");
        fputs(".</p>\n", p->out);
    }
}

/* ---- the barrel in one picture ---- */

enum { STRIP_WIDTH = 440, STRIP_LEFT = 14, STRIP_RIGHT = 14 };

/* Fades from one colour to the next over an interval of the barrel, from the breech where its lower velocity is not
 * known; nothing where nothing is. */
static void strip_zone(FILE *out, const report_scale *s, const known *x, const known *v, double end, int n,
                       const char *from, const char *to)
{
    const double lo = isfinite(v->lo) ? x->lo : is_known(v) ? 0.0 : NAN, hi = isfinite(x->hi) ? x->hi : end;
    if (!isfinite(lo) || lo >= end) return;
    const double a = report_scale_at(s, lo), b = fmax(report_scale_at(s, fmin(hi, end)), a + 0.1);
    fprintf(out,
            "<linearGradient id=\"fade%d\"><stop offset=\"0\" stop-color=\"%s\"/><stop offset=\"1\" "
            "stop-color=\"%s\"/></linearGradient>\n<rect x=\"%.1f\" y=\"44\" width=\"%.1f\" height=\"22\" "
            "fill=\"url(#fade%d)\"/>\n<rect x=\"%.1f\" y=\"44\" width=\"%.1f\" height=\"22\" fill=\"%s\"/>\n",
            n, from, to, a, b - a, n, b, s->to - b, to);
}

static void strip_mark(FILE *out, const report_scale *s, const known *x, double y, const char *what, const char *colour)
{
    char text[120], value[REPORT_VALUE_SIZE];
    if (!isfinite(x->at)) return;
    const double at = report_scale_at(s, x->at);
    const bool late = at > 0.6 * STRIP_WIDTH;
    report_value_known(x->at, x->lo, x->hi, value);
    snprintf(text, sizeof text, "%s from %.60s m", what, value);
    report_svg_segment(out, at, y, at, 66.0, colour, 2.0);
    report_svg_text(out, at + (late ? -5.0 : 5.0), y + 9.0, late ? "end" : "start", "font-weight=\"600\"", text);
}

/* Where the armature leaves: the last of the shot's curve before its muzzle's time, NaN without one. */
static double barrel_end(const report_source *r)
{
    const cJSON *shot = cJSON_GetObjectItemCaseSensitive(r->summary, "shot");
    report_curve x = report_curve_read(r, "/shot/time", "/shot/position");
    const double time = report_number(shot, "muzzle_time");
    const double end = isfinite(time) ? report_curve_at(&x, time) : x.n > 0 ? x.y[x.n - 1] : NAN;
    report_curve_free(&x);
    return end;
}

static void draw_strip(FILE *out, const report_source *r, double end)
{
    static const char *const pale[] = { "#cfe3cf", "#f1d68a", "#dd7a6c" }, grey[] = "#d8d8d8";
    const known scratch = known_of(r->summary, speeds[0].velocity, speeds[0].interval),
                gouge = known_of(r->summary, speeds[1].velocity, speeds[1].interval);
    const bool quiet = isfinite(scratch.lo) || (!is_known(&scratch) && isfinite(gouge.lo)) ||
                       strcmp(report_text(r->summary, "verdict"), "no_gouging") == 0;
    const char *const base = quiet ? pale[0] : grey;
    const report_scale s = { 0.0, end, STRIP_LEFT, STRIP_WIDTH - STRIP_RIGHT, false };
    double tick[REPORT_TICKS], step;
    report_svg_begin(out, STRIP_WIDTH, 104.0, "the barrel from breech to muzzle");
    fprintf(out, "<rect x=\"%d\" y=\"44\" width=\"%.1f\" height=\"22\" fill=\"%s\"/>\n", STRIP_LEFT, s.to - s.from,
            base);
    for (int k = 0; k < 2; k++) {
        const known x = known_of(r->summary, speeds[k].position, speeds[k].position_interval);
        strip_zone(out, &s, &x, k ? &gouge : &scratch, end, k, k ? pale[k] : base, pale[k + 1]);
    }
    fprintf(out, "<rect x=\"%d\" y=\"44\" width=\"%.1f\" height=\"22\" fill=\"none\" stroke=\"#777\"/>\n", STRIP_LEFT,
            s.to - s.from);
    const cJSON *site;
    cJSON_ArrayForEach(site, cJSON_GetObjectItemCaseSensitive(r->summary, "sites"))
    {
        const double x = report_number(site, "position");
        if (x >= 0.0 && x <= end)
            fprintf(out, "<circle cx=\"%.1f\" cy=\"55\" r=\"3.5\" fill=\"#fff\" stroke=\"#333\"/>\n",
                    report_scale_at(&s, x));
    }
    for (int k = 0; k < 2; k++) {
        const known x = known_of(r->summary, speeds[k].position, speeds[k].position_interval);
        strip_mark(out, &s, &x, k ? 24.0 : 4.0, k ? "gouges" : "scratches", report_colour(speeds[k].outcome));
    }
    const int n = report_scale_ticks(&s, 6, tick, &step);
    for (int k = 0; k < n; k++) {
        char text[32];
        report_scale_label(tick[k], step, text);
        report_svg_segment(out, report_scale_at(&s, tick[k]), 66.0, report_scale_at(&s, tick[k]), 71.0, "#777", 1.0);
        report_svg_text(out, report_scale_at(&s, tick[k]), 84.0, "middle", "", text);
    }
    report_svg_text(out, 0.5 * STRIP_WIDTH, 100.0, "middle", "", "from breech (left) to muzzle (right) [m]");
    report_svg_end(out);
}

static void strip(const page *p)
{
    char *text = NULL;
    size_t size;
    const double end = barrel_end(p->source);
    if (!(end > 0.0)) return;
    FILE *out = open_memstream(&text, &size);
    if (!out) return;
    draw_strip(out, p->source, end);
    fclose(out);
    report_page_svg(p, "strip",
                    "Green: no groove grows. Yellow: scratches. Red: gouges. Colours fade over what is not known, "
                    "grey is not known at all. "
                    "Circles: the grains of the case.",
                    text);
}

/* ---- how sure ---- */

static void item_begin(const page *p)
{
    fputs("<li>", p->out);
}

static void item_end(const page *p)
{
    fputs("</li>\n", p->out);
}

static void say_probability(const page *p)
{
    const cJSON *s = p->source->summary;
    const known gouges = known_of(s, "expected_gouges", "expected_gouges_interval");
    const double chance = report_number(s, "probability_gouge");
    if (!isfinite(chance)) return;
    item_begin(p);
    fprintf(p->out, "A shot like this gouges with a probability of %s%.0f %%",
            chance > 0.99   ? "more than "
            : chance < 0.01 ? "less than "
                            : "",
            fmin(fmax(100.0 * chance, 1.0), 99.0));
    if (isfinite(gouges.at)) {
        fputs(" and leaves ", p->out);
        write_known(p->out, &gouges, gouges.at > 0.0 ? "gouges" : "gouges at all");
    }
    fputs(".", p->out);
    item_end(p);
}

/* How far an interval reaches on either side, and what of that it owes to the scatter with the grid. */
static void say_scatter(const page *p, const speed *k, const char *deviation_key)
{
    const cJSON *s = p->source->summary;
    const known v = known_of(s, k->velocity, k->interval);
    const double deviation = report_number(s, deviation_key), below = v.at - v.lo, above = v.hi - v.at;
    if (!isfinite(deviation) || !isfinite(below) || !isfinite(above)) return;
    char down[REPORT_VALUE_SIZE], up[REPORT_VALUE_SIZE], share[REPORT_VALUE_SIZE];
    report_value_known(below, 0.6 * below, 1.4 * below, down);
    report_value_known(above, 0.6 * above, 1.4 * above, up);
    report_value_known(deviation, 0.6 * deviation, 1.4 * deviation, share);
    item_begin(p);
    fprintf(p->out,
            "%s: down by %s and up by %s&nbsp;m/s, of which the same scenes on shifted grids scatter by %s&nbsp;m/s.",
            k->what, down, up, share);
    item_end(p);
}

/* The range of thresholds of the simplest rules. */
static void say_null_models(const page *p)
{
    double lo = INFINITY, hi = -INFINITY;
    const cJSON *model;
    cJSON_ArrayForEach(model, report_page_list(p, "null_models"))
    {
        const double v = report_number(model, "threshold_velocity");
        if (isfinite(v)) lo = fmin(lo, v), hi = fmax(hi, v);
    }
    if (!(lo <= hi)) return;
    char from[REPORT_VALUE_SIZE], to[REPORT_VALUE_SIZE];
    report_value_known(lo, lo - 25.0, lo + 25.0, from);
    report_value_known(hi, hi - 25.0, hi + 25.0, to);
    item_begin(p);
    fprintf(p->out,
            "Rules of thumb that know one number of the two metals, fitted to what is reported for 7075 on copper, say "
            "%s to %s&nbsp;m/s for gouges.",
            from, to);
    item_end(p);
}

static void say_warnings(const page *p)
{
    const int n = cJSON_GetArraySize(report_page_list(p, "warnings"));
    if (n == 0) return;
    item_begin(p);
    fprintf(p->out, "The run gave %d warning%s; <a href=\"#warnings\">%s at the end</a>.", n, n > 1 ? "s" : "",
            n > 1 ? "they stand" : "it stands");
    item_end(p);
}

static void how_sure(const page *p)
{
    fputs(
        "<section><h2>How sure is that?</h2>\n<ul>\n<li>The intervals hold what the search left open, the cells' size, "
        "the scatter with the grid where it was asked for, and the stated uncertainty of the inputs: a table below "
        "lists each. They do not hold "
        "what the model itself leaves out. A place's interval ends where the armature passes the ends of the speed's, "
        "whether a grain is there or not.</li>\n",
        p->out);
    say_scatter(p, &speeds[0], "scratch_deviation");
    say_scatter(p, &speeds[1], "threshold_deviation");
    say_probability(p);
    say_null_models(p);
    say_warnings(p);
    fputs("</ul></section>\n", p->out);
}

/* ---- what to do ---- */

/* What is said of the case's own grains is said only where the search had a resolution at which the interval is one;
 * whole craters, which may have finer cells, say nothing of it. */
static bool is_resolved(const cJSON *scenes)
{
    static const double TRUSTED_CELLS = 3.0; /* a radius; the limit of the run's own warning (onset_judge.c) */
    const bool by_growth = are_judged_by_growth(scenes);
    double finest = NAN;
    const cJSON *scene;
    cJSON_ArrayForEach(scene, scenes)
    {
        const bool searched = is_gauged(scene) || !by_growth;
        if (searched) finest = fmax(finest, report_number(scene, "cells_per_radius"));
    }
    return finest >= TRUSTED_CELLS;
}

/* The rail that has to be looked after: from the early end of the interval on. */
static void say_where(const page *p)
{
    const known x = known_of(p->source->summary, "threshold_position", "threshold_position_interval");
    const double from = isfinite(x.lo) ? x.lo : x.at, end = barrel_end(p->source);
    char start[REPORT_VALUE_SIZE];
    if (!isfinite(from) || !(end > from)) return;
    report_value_known(from, 2.0 * x.lo - x.at, x.at, start);
    item_begin(p);
    fprintf(p->out,
            "Protect the rail from %s&nbsp;m on, the early end of the interval: that is %.0f %% of the barrel. By the "
            "grains and the cells of this case no gouge is expected before it.",
            start, 100.0 * (end - from) / end);
    item_end(p);
}

static void say_slower(const page *p)
{
    const cJSON *s = p->source->summary;
    const known v = known_of(s, "threshold_velocity", "threshold_interval");
    const double muzzle = report_number(cJSON_GetObjectItemCaseSensitive(s, "shot"), "muzzle_velocity");
    char slow[REPORT_VALUE_SIZE];
    if (!isfinite(v.lo) || !(muzzle > v.lo)) return;
    report_value_known(v.lo, 2.0 * v.lo - v.at, v.at, slow);
    item_begin(p);
    fprintf(p->out,
            "By the grains and the cells of this case a shot that stays below %s&nbsp;m/s, the lower end of the "
            "interval, is not expected to gouge; this one leaves with ",
            slow);
    report_page_number(p->out, muzzle, 1.0, "m/s");
    fputs(".", p->out);
    item_end(p);
}

/* What a changed input does to the place: differences are known better than the place itself. */
static void say_effect(const page *p, const cJSON *change)
{
    const cJSON *s = p->source->summary;
    const double moved = report_number(change, "threshold_position") - report_number(s, "threshold_position"),
                 more = report_number(change, "expected_gouges") - report_number(s, "expected_gouges"),
                 by = report_number(change, "change");
    char text[REPORT_VALUE_SIZE];
    const bool counts = isfinite(more) && fabs(more) >= 0.005;
    if (!isfinite(by) || (!isfinite(moved) && !counts)) return; /* nothing gouges, before as after */
    item_begin(p);
    fprintf(p->out, "%+.0f %% ", 100.0 * by);
    report_svg_escaped(p->out, report_text(change, "input"));
    fputs(": ", p->out);
    if (isfinite(moved) && fabs(moved) >= 5e-4) {
        report_value_known(1e3 * fabs(moved), 0.8e3 * fabs(moved), 1.2e3 * fabs(moved), text);
        fprintf(p->out, "gouging begins %s&nbsp;mm %s", text, moved > 0.0 ? "later" : "earlier");
    } else if (isfinite(moved)) {
        fputs("gouging begins at the same place", p->out);
    }
    if (counts) fprintf(p->out, "%s%+.2f gouges a shot", isfinite(moved) ? ", " : "", more);
    fputs(".", p->out);
    item_end(p);
}

static void what_to_do(const page *p)
{
    const cJSON *change;
    fputs("<section><h2>What can be done about it?</h2>\n<ul>\n", p->out);
    if (is_resolved(report_page_list(p, "scenes"))) {
        say_where(p);
        say_slower(p);
    }
    cJSON_ArrayForEach(change, report_page_list(p, "sensitivities")) say_effect(p, change);
    fputs(
        "<li>Coatings, hardening, polish, another lead angle: list them under <code>treatments</code> in the case and "
        "run <code>breech compare</code>; it ranks them at this shot.</li>\n"
        "<li>For narrower intervals: a smaller <code>study.velocity_interval</code> with more "
        "<code>study.max_scenes</code>, and finer cells.</li>\n</ul></section>\n",
        p->out);
}

/* ---- the head ---- */

void report_onset_head(const page *p)
{
    static const page_column cards[] = { { "muzzle_velocity", "muzzle velocity", 1.0, "m/s", NULL },
                                         { "peak_current", "peak current", 1e3, "kA", NULL },
                                         { "muzzle_energy", "muzzle energy", 1e3, "kJ", NULL },
                                         { "muzzle_time", "leaves after", 1e-3, "ms", NULL } };
    if (report_page_is_done(p)) {
        verdict_sentence(p);
        fputs("<div class=\"speeds\">\n", p->out);
        for (int k = 0; k < 2; k++) speed_box(p, &speeds[k]);
        fputs("</div>\n", p->out);
        strip(p);
        fputs("<div class=\"columns\">\n", p->out);
        how_sure(p);
        what_to_do(p);
        fputs("</div>\n", p->out);
    }
    report_page_cards(p, report_page_list(p, "shot"), cards, PAGE_COUNT(cards));
}

/* ---- along the barrel ---- */

/* clang-format off */
static const page_column site_columns[] = { { "position", "position", 1.0, "m", NULL },
                                      { "velocity", "velocity", 1.0, "m/s", NULL },
                                      { "radius", "radius", 1e-3, "mm", NULL },
                                      { "outcome", "outcome", 1.0, "", NULL },
                                      { "current", "current", 1e3, "kA", NULL },
                                      { "contact_pressure", "contact pressure", 1e6, "MPa", NULL },
                                      { "lead_face_temperature", "lead face", 1.0, "K", NULL },
                                      { "impact_pressure", "impact pressure", 1e9, "GPa", NULL },
                                      { "screen", "p/H", 1.0, "", NULL },
                                      { "scene", "by scene", 1.0, "", NULL } };
/* clang-format on */

static const char *const outcomes[] = { "gouge", "scratch", "none", "undecided", "skipped", "not_reached" };
enum { OUTCOMES = sizeof outcomes / sizeof *outcomes };

/* "t3-g1-v800" begins with "t3-"; with "" what begins with no such prefix. */
static bool has_prefix(const char *name, const char *prefix)
{
    const size_t n = strlen(prefix);
    if (n > 0) return strncmp(name, prefix, n) == 0;
    const size_t digits = name[0] == 't' ? strspn(name + 1, "0123456789") : 0;
    return !(digits > 0 && name[1 + digits] == '-');
}

/* Numbers of a list's objects as points; prefix: of their names, NULL: all. */
typedef struct {
    const char *outcome, *x, *y, *prefix;
    double x_unit, y_unit;
} points;

/* One series a kind of outcome, in its colour. */
static void draw_dots(report_chart *c, const cJSON *list, const points *of)
{
    const int most = cJSON_GetArraySize(list);
    double *x = malloc(((size_t)most + 1) * sizeof *x), *y = malloc(((size_t)most + 1) * sizeof *y);
    for (int o = 0; x && y && o < OUTCOMES; o++) {
        size_t n = 0;
        const cJSON *item;
        cJSON_ArrayForEach(item, list)
        {
            const char *name = report_text(item, "name");
            if (of->prefix && !has_prefix(name, of->prefix)) continue;
            x[n] = report_number(item, of->x) / of->x_unit;
            y[n] = report_number(item, of->y) / of->y_unit;
            n += strcmp(report_text(item, of->outcome), outcomes[o]) == 0 && isfinite(x[n]) && isfinite(y[n]);
        }
        if (n > 0) report_chart_dots(c, outcomes[o], report_colour(outcomes[o]), x, y, n);
    }
    free(x);
    free(y);
}

static void draw_barrel(const page *p, double end)
{
    const report_source *r = p->source;
    const cJSON *sites = report_page_list(p, "sites");
    report_curve c = report_curve_read(r, "/shot/position", "/shot/velocity");
    report_chart *chart = report_chart_create(
        (report_axis){ .label = "position along the barrel", .unit = "m", .from_zero = true, .fixed = true },
        (report_axis){ .label = "velocity", .unit = "m/s", .from_zero = true });
    for (int k = 0; k < 2; k++)
        report_chart_band(chart, k ? "gouges from" : "scratches from", k ? report_gouge_band : report_scratch_band, 'y',
                          report_element(r->summary, speeds[k].interval, 0),
                          report_element(r->summary, speeds[k].interval, 1));
    report_chart_line(chart, "armature", report_blue, c.x, c.y, isfinite(end) ? report_curve_until(&c, end) : c.n);
    draw_dots(chart, sites, &(points){ "outcome", "position", "velocity", NULL, 1.0, 1.0 });
    report_page_chart(p, "barrel",
                      cJSON_GetArraySize(sites) > 0
                          ? "The armature's velocity, the grains by outcome, and the intervals of both speeds."
                          : "The armature's velocity and the intervals of both speeds.",
                      chart);
    report_curve_free(&c);
}

static void draw_probability(const page *p)
{
    const cJSON *s = p->source->summary;
    const int n = cJSON_GetArraySize(report_page_list(p, "along"));
    double *x = malloc(((size_t)n + 1) * sizeof *x), *y = malloc(((size_t)n + 1) * sizeof *y);
    if (x && y && n > 1) {
        for (int i = 0; i < n; i++) {
            x[i] = report_element(s, "along", i);
            y[i] = 100.0 * report_element(s, "probability_along", i);
        }
        report_chart *c = report_chart_create(
            (report_axis){ .label = "position along the barrel", .unit = "m", .from_zero = true, .fixed = true },
            (report_axis){ .label = "a gouge lies before it", .unit = "%", .from_zero = true });
        report_chart_line(c, "", report_red, x, y, (size_t)n);
        report_page_chart(p, "probability", "How probable it is that the shot has gouged by then.", c);
    }
    free(x);
    free(y);
}

static void section_barrel(const page *p)
{
    const cJSON *sites = report_page_list(p, "sites");
    const double end = barrel_end(p->source);
    const bool listed = cJSON_GetArraySize(sites) > 0;
    if (!listed && !(end > 0.0) && cJSON_GetArraySize(report_page_list(p, "along")) < 2) return;
    report_page_heading(p, "Along the barrel");
    report_page_plots_begin(p);
    draw_barrel(p, end);
    draw_probability(p);
    report_page_plots_end(p);
    report_page_list_table(p, sites, site_columns, PAGE_COUNT(site_columns));
    if (listed)
        report_page_paragraph(p, "reason", "p/H: pressure of the impact over the hardness of the harder partner.");
}

/* ---- the threshold ---- */

/* clang-format off */
static const page_column scene_columns[] = { { "name", "scene", 1.0, "", NULL },
                                       { "velocity", "velocity", 1.0, "m/s", NULL },
                                       { "class", "class", 1.0, "", NULL },
                                       { "radius", "radius", 1e-3, "mm", NULL },
                                       { "contact_pressure", "pressed on with", 1e6, "MPa", NULL },
                                       { "lead_face_temperature", "lead face", 1.0, "K", NULL },
                                       { "cells_per_radius", "cells a radius", 1.0, "", NULL },
                                       { "groove_growth", "growth", 1e6, "1/\302\265s", NULL },
                                       { "growth_per_way", "growth", 1e3, "1/mm", NULL },
                                       { "front_speed_ratio", "front over armature", 1.0, "", NULL },
                                       { "gauged", "until its growth was known", 1.0, "", NULL },
                                       { "wall_seconds", "time", 1.0, "s", NULL } };
static const page_column crater_columns[] = { { "name", "scene", 1.0, "", NULL },
                                       { "velocity", "velocity", 1.0, "m/s", NULL },
                                       { "class", "class", 1.0, "", NULL },
                                       { "crater_class", "by its shape alone", 1.0, "", NULL },
                                       { "crater_length", "length", 1e-3, "mm", NULL },
                                       { "crater_width", "width", 1e-3, "mm", NULL },
                                       { "crater_depth", "depth", 1e-3, "mm", NULL },
                                       { "rim_height", "rim", 1e-3, "mm", NULL },
                                       { "crater_volume", "volume", 1e-9, "mm\302\263", NULL },
                                       { "widening", "widening", 1.0, "", NULL },
                                       { "length_over_width", "length over width", 1.0, "", NULL },
                                       { "severity", "severity", 1.0, "", NULL } };
static const page_column size_columns[] = {
    { "radius", "radius", 1e-3, "mm", NULL },
    { "threshold_velocity", "gouges from", 1.0, "m/s", "threshold_interval" },
    { "scratch_velocity", "scratches from", 1.0, "m/s", "scratch_interval" },
    { "grains", "grains", 1.0, "", NULL },        { "shape", "shape", 1.0, "", NULL },
    { "material", "material", 1.0, "", NULL },    { "family", "kind", 1.0, "", NULL },
    { "scenes", "scenes of this size", 1.0, "", NULL } };
static const page_column skip_columns[] = { { "rests_on", "why no scene was needed", 1.0, "", NULL },
                                            { "scenes", "scenes", 1.0, "", NULL } };
static const page_column part_columns[] = {
    { "part", "in the interval", 1.0, "", NULL },
    { "threshold_below", "below the gouge's velocity", 1.0, "m/s", NULL },
    { "threshold_above", "above it", 1.0, "m/s", NULL },
    { "scratch_below", "below the scratch's velocity", 1.0, "m/s", NULL },
    { "scratch_above", "above it", 1.0, "m/s", NULL } };
static const page_column null_model_columns[] = {
    { "name", "rule", 1.0, "", NULL },                          { "says", "the cause it takes", 1.0, "", NULL },
    { "threshold_velocity", "gouges from", 1.0, "m/s", "threshold_interval" },
    { "threshold_position", "passed at", 1.0, "m", NULL } };
static const page_column repeated_columns[] = {
    { "shot", "shot", 1.0, "", NULL },                          { "probability_gouge", "gouges with", 0.01, "%", NULL },
    { "onset_position", "first gouge", 1.0, "m", "onset_interval" },
    { "expected_gouges", "gouges", 1.0, "", NULL },
    { "expected_gouged_volume", "gouged volume", 1e-9, "mm\302\263", NULL },
    { "rail_rise", "rail warmer by", 1.0, "K", NULL },
    { "layer_worn", "layers worn by", 1e-6, "\302\265m", NULL },
    { "deposit", "armature metal on it", 1e-6, "\302\265m", NULL },
    { "muzzle_velocity", "muzzle velocity", 1.0, "m/s", NULL } };
/* clang-format on */

void report_onset_threshold_chart(const page *p, const char *name, const char *caption, const cJSON *bounds,
                                  const char *prefix)
{
    const cJSON *scenes = report_page_list(p, "scenes");
    const bool gauged = are_judged_by_growth(scenes); /* which whole scenes have too */
    report_chart *c = report_chart_create(
        (report_axis){ .label = "velocity", .unit = "m/s" },
        (report_axis){ .label = gauged ? "growth of the groove" : "severity", .unit = gauged ? "1/\302\265s" : "1" });
    report_chart_band(c, "scratches from", report_scratch_band, 'x', report_element(bounds, "scratch_interval", 0),
                      report_element(bounds, "scratch_interval", 1));
    report_chart_band(c, "gouges from", report_gouge_band, 'x', report_element(bounds, "threshold_interval", 0),
                      report_element(bounds, "threshold_interval", 1));
    report_chart_rule(c, gauged ? "grows above, dies below" : "gouges above", "#777777", 'y', 0.0);
    draw_dots(c, scenes,
              &(points){ "class", "velocity", gauged ? "groove_growth" : "severity", prefix, 1.0, gauged ? 1e6 : 1.0 });
    report_page_chart(p, name, caption, c);
}

/* Families are numbered from 1 or 0 without gaps. */
static void add_family(report_chart *c, const cJSON *surface, int family)
{
    double x[200], y[200];
    size_t n = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, surface)
    {
        const double v = report_number(item, "threshold_velocity"), radius = report_number(item, "radius");
        if ((int)report_number(item, "family") != family || !isfinite(v) || n == 200) continue;
        x[n] = radius;
        y[n++] = v;
        report_chart_whisker(c, "#555555", radius, report_element(item, "threshold_interval", 0),
                             report_element(item, "threshold_interval", 1));
    }
    if (n > 0) report_chart_line(c, family > 1 ? "" : "gouges from", "#555555", x, y, n);
}

static void draw_sizes(const page *p)
{
    const cJSON *surface = report_page_list(p, "surface"), *item;
    int last = 0;
    if (cJSON_GetArraySize(surface) < 2) return;
    report_chart *c = report_chart_create((report_axis){ .label = "radius of the grain", .unit = "m", .log = true },
                                          (report_axis){ .label = "velocity", .unit = "m/s" });
    cJSON_ArrayForEach(item, surface) last = (int)fmax(last, report_number(item, "family"));
    for (int f = 0; f <= last; f++) add_family(c, surface, f);
    draw_dots(c, report_page_list(p, "scenes"), &(points){ "class", "radius", "velocity", NULL, 1.0, 1.0 });
    report_page_chart(p, "surface",
                      "One point a scene. Line: from which speed on grains of a size gouge, with its interval.", c);
}

/* Scenes that ran to their end: of the others the crater is that of the moment at which their growth was known. */
void report_onset_scene_tables(const page *p)
{
    const cJSON *scenes = report_page_list(p, "scenes"), *item;
    cJSON *whole = cJSON_CreateArray();
    report_page_list_table(p, scenes, scene_columns, PAGE_COUNT(scene_columns));
    cJSON_ArrayForEach(item, scenes)
    {
        if (!is_gauged(item)) cJSON_AddItemReferenceToArray(whole, (cJSON *)item);
    }
    if (cJSON_GetArraySize(whole) > 0) {
        fputs("<h3>Craters of the scenes that ran to their end</h3>\n", p->out);
        report_page_list_table(p, whole, crater_columns, PAGE_COUNT(crater_columns));
    }
    cJSON_Delete(whole);
}

static void section_threshold(const page *p)
{
    if (cJSON_GetArraySize(report_page_list(p, "scenes")) == 0) return;
    report_page_heading(p, "The scenes that decide");
    report_page_plots_begin(p);
    draw_sizes(p);
    report_onset_threshold_chart(p, "threshold", "One point a scene; shaded: the intervals of both speeds.",
                                 p->source->summary, NULL);
    report_page_plots_end(p);
    if (cJSON_GetArraySize(report_page_list(p, "surface")) > 1)
        report_page_list_table(p, report_page_list(p, "surface"), size_columns, PAGE_COUNT(size_columns));
    report_onset_scene_tables(p);
}

/* Inputs changed one by one: by how much the answer moves, which is known better than the answer. */
static void section_sensitivities(const page *p)
{
    static const struct {
        const char *key, *title, *unit;
    } moved[] = { { "muzzle_velocity", "muzzle velocity", "m/s" },
                  { "threshold_velocity", "gouges from", "m/s" },
                  { "threshold_position", "that is passed at", "m" },
                  { "expected_gouges", "gouges a shot", "" } };
    const cJSON *s = p->source->summary, *item, *shot = report_page_list(p, "shot");
    report_table t;
    if (cJSON_GetArraySize(report_page_list(p, "sensitivities")) == 0) return;
    report_page_heading(p, "What moves the answer");
    report_table_begin(&t, p->out);
    report_table_text_title(&t, "changed");
    report_table_title(&t, "by", "%");
    for (int k = 0; k < PAGE_COUNT(moved); k++) report_table_title(&t, moved[k].title, moved[k].unit);
    cJSON_ArrayForEach(item, report_page_list(p, "sensitivities"))
    {
        report_table_row(&t);
        report_table_text(&t, report_text(item, "input"));
        report_table_number(&t, report_number(item, "change"), 0.01);
        for (int k = 0; k < PAGE_COUNT(moved); k++) {
            char text[REPORT_VALUE_SIZE + 8], value[REPORT_VALUE_SIZE];
            const double before = report_number(k == 0 ? shot : s, moved[k].key),
                         by = report_number(item, moved[k].key) - before;
            const bool none = fabs(by) < 1e-3 * fabs(before);
            report_value_known(none ? 0.0 : by, by - 0.2 * fabs(by), by + 0.2 * fabs(by), value);
            snprintf(text, sizeof text, "%s%s", by > 0.0 && !none ? "+" : "", none ? "0" : value);
            report_table_html(&t, text);
        }
    }
    report_table_end(&t);
}

void report_onset_section(const page *p)
{
    section_barrel(p);
    section_threshold(p);
    report_page_listed(p, "interval_parts", "What the intervals hold, and what was not asked for", part_columns,
                       PAGE_COUNT(part_columns));
    report_page_listed(p, "null_models", "What one number of the two metals alone would say (7075 on copper: 1325 m/s)",
                       null_model_columns, PAGE_COUNT(null_model_columns));
    report_page_listed(p, "skips", "Scenes that were not needed", skip_columns, PAGE_COUNT(skip_columns));
    section_sensitivities(p);
    report_page_listed(p, "shots", "Shot after shot on the same rail", repeated_columns, PAGE_COUNT(repeated_columns));
}
