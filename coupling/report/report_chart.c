/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_chart.h"

#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_SIZE = 96, WIDTH = 440, LEFT = 62, RIGHT = 16, INSIDE = 232, BELOW = 46, LEGEND_LINE = 19 };

typedef enum { LINE, THIN, DASHED, DOTS, RINGS, WHISKER, BAND, RULE } kind;

typedef struct {
    kind is;
    char title[TEXT_SIZE], colour[16], along;
    double *x, *y; /* n, owned; a band's ends and a rule's place are in x */
    size_t n;
} mark;

typedef struct {
    char label[TEXT_SIZE], unit[TEXT_SIZE];
    report_axis as;
} axis;

struct report_chart {
    axis x, y;
    mark *item; /* n, owned */
    size_t n, room;
    bool no_memory;
};

report_chart *report_chart_create(report_axis x, report_axis y)
{
    report_chart *c = calloc(1, sizeof *c);
    if (!c) return NULL;
    c->x.as = x;
    c->y.as = y;
    snprintf(c->x.label, TEXT_SIZE, "%s", x.label);
    snprintf(c->x.unit, TEXT_SIZE, "%s", strcmp(x.unit, "1") ? x.unit : "");
    snprintf(c->y.label, TEXT_SIZE, "%s", y.label);
    snprintf(c->y.unit, TEXT_SIZE, "%s", strcmp(y.unit, "1") ? y.unit : "");
    return c;
}

/* ---- what is added ---- */

static double *copy_of(const double *values, size_t n)
{
    double *copy = malloc((n ? n : 1) * sizeof *copy);
    if (copy && n > 0) memcpy(copy, values, n * sizeof *copy);
    return copy;
}

static void add(report_chart *c, kind is, const char *title, const char *colour, const double *x, const double *y,
                size_t n, char along)
{
    if (!c || c->no_memory) return;
    if (c->n == c->room) {
        const size_t room = 2 * c->room + 8;
        mark *more = realloc(c->item, room * sizeof *more);
        c->no_memory = !more;
        if (!more) return;
        c->item = more;
        c->room = room;
    }
    mark *m = &c->item[c->n++];
    *m = (mark){ .is = is, .along = along, .n = n, .x = copy_of(x, n), .y = copy_of(y, n) };
    snprintf(m->title, TEXT_SIZE, "%s", title);
    snprintf(m->colour, sizeof m->colour, "%s", colour);
    c->no_memory = !m->x || !m->y;
}

void report_chart_line(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                       size_t n)
{
    add(c, LINE, title, colour, x, y, n, 0);
}

void report_chart_thin_line(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                            size_t n)
{
    add(c, THIN, title, colour, x, y, n, 0);
}

void report_chart_dashed(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                         size_t n)
{
    add(c, DASHED, title, colour, x, y, n, 0);
}

void report_chart_dots(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                       size_t n)
{
    add(c, DOTS, title, colour, x, y, n, 0);
}

void report_chart_rings(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                        size_t n)
{
    add(c, RINGS, title, colour, x, y, n, 0);
}

void report_chart_whisker(report_chart *c, const char *colour, double x, double lo, double hi)
{
    const double at[2] = { x, x }, ends[2] = { lo, hi };
    if (isfinite(x) && isfinite(lo) && isfinite(hi)) add(c, WHISKER, "", colour, at, ends, 2, 0);
}

void report_chart_band(report_chart *c, const char *title, const char *colour, char along, double lo, double hi)
{
    const double ends[2] = { lo, hi };
    if (isfinite(lo) || isfinite(hi)) add(c, BAND, title, colour, ends, ends, 2, along);
}

void report_chart_rule(report_chart *c, const char *text, const char *colour, char along, double at)
{
    if (isfinite(at)) add(c, RULE, text, colour, &at, &at, 1, along);
}

/* ---- the axes ---- */

const char *report_chart_prefix(double largest, const char *unit, double *factor)
{
    static const char *const units[] = {
        "A", "V", "N", "J", "Pa", "W", "m", "s", "N s", "m/s^2", "N/m", "H/m", "ohm/m"
    };
    static const char *const prefixes[] = { "n", "\302\265", "m", "", "k", "M", "G", "T" };
    *factor = 1.0;
    if (strcmp(unit, "m3") == 0 && largest > 0.0 && largest < 1e-3) {
        *factor = 1e-9;
        return "m";
    }
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
        if (strcmp(unit, units[k]) != 0 || !(largest > 0.0)) continue;
        const int power = (int)fmin(fmax(floor(log10(largest) / 3.0 + 1e-9), -3.0), 4.0);
        *factor = pow(1000.0, power);
        return prefixes[power + 3];
    }
    return "";
}

/* The values that an axis has to show: least and largest; log: of the positive ones. */
static void widen(double value, bool log, double range[2])
{
    if (!isfinite(value) || (log && value <= 0.0)) return;
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static void axis_range(const report_chart *c, bool of_x, double range[2])
{
    const axis *a = of_x ? &c->x : &c->y;
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (size_t k = 0; k < c->n; k++) {
        const mark *m = &c->item[k];
        const bool across = m->is == BAND || m->is == RULE;
        if (across && (m->along == 'x') != of_x) continue;
        for (size_t i = 0; i < m->n; i++) widen(across || of_x ? m->x[i] : m->y[i], a->as.log, range);
    }
    if (a->as.from_zero && !a->as.log) widen(0.0, false, range);
}

/* A little room beyond the values, none beyond a zero at which they end. */
static report_scale axis_scale(const report_chart *c, bool of_x, double from, double to, double *factor, char *title)
{
    const axis *a = of_x ? &c->x : &c->y;
    double range[2];
    axis_range(c, of_x, range);
    const char *prefix = "";
    *factor = 1.0;
    if (!a->as.fixed) prefix = report_chart_prefix(fmax(fabs(range[0]), fabs(range[1])), a->unit, factor);
    if (a->unit[0])
        snprintf(title, 2 * TEXT_SIZE, "%s [%s%s]", a->label, prefix, a->unit);
    else
        snprintf(title, 2 * TEXT_SIZE, "%s", a->label);
    report_scale s = { range[0] / *factor, range[1] / *factor, from, to, a->as.log };
    if (s.log) {
        const double room = s.hi > s.lo ? pow(s.hi / s.lo, 0.05) : 1.5;
        s.lo /= room;
        s.hi *= room;
    } else {
        const double size = fmax(fabs(s.lo), fabs(s.hi));
        const double room = s.hi - s.lo > 1e-9 * size ? 0.05 * (s.hi - s.lo) : size > 0.0 ? 0.1 * size : 1.0;
        const bool starts_at_zero = s.lo == 0.0, ends_at_zero = s.hi == 0.0 && s.lo < 0.0;
        if (!starts_at_zero && !(of_x && !a->as.from_zero && s.lo > 0.0 && s.lo < room)) s.lo -= room;
        if (!ends_at_zero) s.hi += room;
    }
    return s;
}

static bool has_values(const report_chart *c)
{
    for (size_t k = 0; k < c->n; k++) {
        const mark *m = &c->item[k];
        for (size_t i = 0; m->is < BAND && i < m->n; i++) {
            const bool x = isfinite(m->x[i]) && (!c->x.as.log || m->x[i] > 0.0),
                       y = isfinite(m->y[i]) && (!c->y.as.log || m->y[i] > 0.0);
            if (x && y) return true;
        }
    }
    return false;
}

/* ---- drawing ---- */

typedef struct {
    FILE *out;
    report_scale x, y;
    double x_factor, y_factor, top;
} canvas;

static double px(const canvas *v, double x)
{
    return v->x.log && x <= 0.0 ? NAN : report_scale_at(&v->x, x / v->x_factor);
}

static double py(const canvas *v, double y)
{
    return v->y.log && y <= 0.0 ? NAN : report_scale_at(&v->y, y / v->y_factor);
}

static void draw_axes(const canvas *v, const char *x_title, const char *y_title)
{
    report_svg_grid_across(v->out, &v->x, 6, v->y.to, v->y.from, 17.0);
    report_svg_grid_up(v->out, &v->y, 5, v->x.from, v->x.to);
    fprintf(v->out, "<path d=\"M%.1f %.1fV%.1fH%.1f\" fill=\"none\" stroke=\"#777\"/>\n", v->x.from, v->y.to, v->y.from,
            v->x.to);
    report_svg_text(v->out, 0.5 * (v->x.from + v->x.to), v->y.from + 38.0, "middle", "", x_title);
    report_svg_upward_title(v->out, 0.5 * (v->y.from + v->y.to), y_title);
}

/* An end of a band in the picture; one that is not finite is an edge. */
static double band_end(const report_scale *s, double value, double factor, double edge)
{
    const double at = isfinite(value) && !(s->log && value <= 0.0) ? report_scale_at(s, value / factor) : edge;
    return fmin(fmax(at, fmin(s->from, s->to)), fmax(s->from, s->to));
}

static void draw_band(const canvas *v, const mark *m)
{
    const bool of_x = m->along == 'x';
    const report_scale *s = of_x ? &v->x : &v->y;
    const double factor = of_x ? v->x_factor : v->y_factor, a = band_end(s, m->x[0], factor, s->from),
                 b = band_end(s, m->x[1], factor, s->to), lo = fmin(a, b), size = fabs(b - a);
    const double width = v->x.to - v->x.from, height = v->y.from - v->y.to;
    fprintf(v->out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.25\"/>\n",
            of_x ? lo : v->x.from, of_x ? v->y.to : lo, of_x ? size : width, of_x ? height : size, m->colour);
}

static void draw_rule(const canvas *v, const mark *m)
{
    const bool of_x = m->along == 'x';
    const double at = of_x ? px(v, m->x[0]) : py(v, m->x[0]);
    if (!isfinite(at)) return;
    const double x[2] = { of_x ? at : v->x.from, of_x ? at : v->x.to },
                 y[2] = { of_x ? v->y.from : at, of_x ? v->y.to : at };
    report_svg_line(v->out, x, y, 2, m->colour, 1.3, true);
    const bool late = of_x && at > 0.5 * (v->x.from + v->x.to);
    report_svg_text(v->out, of_x ? at + (late ? -4.0 : 4.0) : v->x.to - 3.0, of_x ? v->y.to + 12.0 : at - 4.0,
                    late || !of_x ? "end" : "start", "font-size=\"12\" fill=\"#555\"", m->title);
}

static void draw_points(const canvas *v, const mark *m)
{
    for (size_t i = 0; i < m->n; i++) {
        const double x = px(v, m->x[i]), y = py(v, m->y[i]);
        if (!isfinite(x) || !isfinite(y)) continue;
        if (m->is == DOTS)
            fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\"/>\n", x, y, m->colour);
        else
            fprintf(v->out,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"#fff\" stroke=\"%s\" stroke-width=\"2\"/>\n", x,
                    y, m->colour);
    }
}

static void draw_whisker(const canvas *v, const mark *m)
{
    const double x = px(v, m->x[0]), lo = py(v, m->y[0]), hi = py(v, m->y[1]);
    if (isfinite(x) && isfinite(lo) && isfinite(hi))
        fprintf(v->out,
                "<path d=\"M%.1f %.1fh8m-4 0V%.1fm-4 0h8\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                x - 4.0, lo, hi, m->colour);
}

/* In place, so once alone. */
static void draw_curve(const canvas *v, const mark *m)
{
    for (size_t i = 0; i < m->n; i++) {
        m->x[i] = px(v, m->x[i]);
        m->y[i] = py(v, m->y[i]);
    }
    report_svg_line(v->out, m->x, m->y, m->n, m->colour, m->is == THIN ? 1.0 : 2.0, m->is == DASHED);
}

static void draw_mark(const canvas *v, const mark *m)
{
    switch (m->is) {
    case BAND: draw_band(v, m); break;
    case RULE: draw_rule(v, m); break;
    case WHISKER: draw_whisker(v, m); break;
    case DOTS:
    case RINGS: draw_points(v, m); break;
    default: draw_curve(v, m);
    }
}

/* ---- the legend ---- */

static bool in_legend(const mark *m)
{
    return m->title[0] && m->is != RULE;
}

static void draw_key(FILE *out, const mark *m, double x, double y)
{
    if (m->is == BAND)
        fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"18\" height=\"10\" fill=\"%s\" fill-opacity=\"0.35\"/>\n", x,
                y - 9.0, m->colour);
    else if (m->is == DOTS || m->is == RINGS)
        fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\" stroke=\"%s\" stroke-width=\"2\"/>\n",
                x + 9.0, y - 4.5, m->is == DOTS ? m->colour : "#fff", m->colour);
    else
        report_svg_line(out, (double[2]){ x, x + 18.0 }, (double[2]){ y - 4.5, y - 4.5 }, 2, m->colour,
                        m->is == THIN ? 1.0 : 2.5, m->is == DASHED);
}

/* Lines of keys from the left, as many as fit; out NULL: only counts the lines. */
static int legend(const report_chart *c, FILE *out)
{
    double x = 10.0;
    int lines = 0;
    for (size_t k = 0; k < c->n; k++) {
        const mark *m = &c->item[k];
        if (!in_legend(m)) continue;
        const double width = 24.0 + report_svg_text_width(m->title) + 14.0;
        if (lines == 0 || x + width > WIDTH) {
            x = 10.0;
            lines++;
        }
        if (out) {
            draw_key(out, m, x, LEGEND_LINE * lines - 4.0);
            report_svg_text(out, x + 24.0, LEGEND_LINE * lines - 4.0, "start", "", m->title);
        }
        x += width;
    }
    return lines;
}

/* ---- the whole ---- */

static void draw(const report_chart *c, FILE *out, const char *name)
{
    static const kind order[] = { BAND, RULE, THIN, LINE, DASHED, WHISKER, RINGS, DOTS };
    canvas v = { .out = out, .top = LEGEND_LINE * legend(c, NULL) + 10.0 };
    char x_title[2 * TEXT_SIZE], y_title[2 * TEXT_SIZE];
    v.x = axis_scale(c, true, LEFT, WIDTH - RIGHT, &v.x_factor, x_title);
    v.y = axis_scale(c, false, v.top + INSIDE, v.top, &v.y_factor, y_title);
    report_svg_begin(out, WIDTH, v.top + INSIDE + BELOW, name);
    legend(c, out);
    for (size_t k = 0; k < c->n; k++)
        if (c->item[k].is == BAND) draw_band(&v, &c->item[k]);
    draw_axes(&v, x_title, y_title);
    for (size_t o = 1; o < sizeof order / sizeof *order; o++)
        for (size_t k = 0; k < c->n; k++)
            if (c->item[k].is == order[o]) draw_mark(&v, &c->item[k]);
    report_svg_end(out);
}

static void chart_free(report_chart *c)
{
    for (size_t k = 0; k < c->n; k++) {
        free(c->item[k].x);
        free(c->item[k].y);
    }
    free(c->item);
    free(c);
}

char *report_chart_svg(report_chart *c, const char *name)
{
    char *text = NULL;
    size_t size = 0;
    if (!c) return NULL;
    FILE *out = !c->no_memory && has_values(c) ? open_memstream(&text, &size) : NULL;
    if (out) {
        draw(c, out, name);
        if (fclose(out) != 0) {
            free(text);
            text = NULL;
        }
    }
    chart_free(c);
    return text;
}
