/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_svg.h"

#include "coupling/host/utf8.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const GRID = "#e6e6e6"; /* colour */

/* ---- texts ---- */

void report_svg_escaped(FILE *out, const char *text)
{
    while (*text) {
        const int n = host_utf8_length(text);
        switch (*text) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        default:
            if (n == 0 || ((unsigned char)*text < ' ' && !strchr("\t\n", *text)) || *text == 0x7f)
                fputc('?', out);
            else
                fwrite(text, 1, (size_t)n, out);
        }
        text += n ? n : 1;
    }
}

void report_svg_text(FILE *out, double x, double y, const char *anchor, const char *more, const char *text)
{
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s%s>", x, y, anchor, more[0] ? " " : "", more);
    report_svg_escaped(out, text);
    fputs("</text>\n", out);
}

double report_svg_text_width(const char *text)
{
    int letters = 0;
    for (; *text; text++) letters += ((unsigned char)*text & 0xc0) != 0x80;
    return 6.9 * letters;
}

/* ---- the picture ---- */

void report_svg_begin(FILE *out, double width, double height, const char *name)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" role=\"img\" "
            "font-family=\"system-ui,sans-serif\" font-size=\"13\" fill=\"#333\"><title>",
            width, height, width);
    report_svg_escaped(out, name);
    fputs("</title>\n", out);
}

void report_svg_end(FILE *out)
{
    fputs("</svg>\n", out);
}

void report_svg_segment(FILE *out, double x0, double y0, double x1, double y1, const char *colour, double width)
{
    fprintf(out, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%g\"/>\n", x0, y0, x1, y1, colour,
            width);
}

/* Do all points between a and b lie within a third of a unit of the line from a to b? */
static bool is_straight(const double *x, const double *y, size_t a, size_t b)
{
    const double dx = x[b] - x[a], dy = y[b] - y[a], length = hypot(dx, dy);
    for (size_t i = a + 1; i < b; i++) {
        const double ex = x[i] - x[a], ey = y[i] - y[a], along = length > 0.0 ? (ex * dx + ey * dy) / length : 0.0;
        const double off = length > 0.0 ? fabs(ex * dy - ey * dx) / length : hypot(ex, ey);
        if (off > 0.33 || along < -0.33 || along > length + 0.33) return false;
    }
    return true;
}

/* The last point that a straight line from point a reaches without leaving the curve. */
static size_t straight_until(const double *x, const double *y, size_t n, size_t a)
{
    enum { MOST = 150 };
    size_t b = a + 1;
    while (b + 1 < n && b - a < MOST && isfinite(x[b + 1]) && isfinite(y[b + 1]) && is_straight(x, y, a, b + 1)) b++;
    return b;
}

void report_svg_line(FILE *out, const double *x, const double *y, size_t n, const char *colour, double width,
                     bool dashed)
{
    bool down = false;
    fputs("<path d=\"", out);
    for (size_t i = 0; i < n;) {
        const bool there = isfinite(x[i]) && isfinite(y[i]);
        if (there) fprintf(out, "%c%.1f %.1f", down ? 'L' : 'M', x[i], y[i]);
        down = there && i + 1 < n && isfinite(x[i + 1]) && isfinite(y[i + 1]);
        i = down ? straight_until(x, y, n, i) : i + 1;
    }
    fprintf(out, "\" fill=\"none\" stroke=\"%s\" stroke-width=\"%g\"%s/>\n", colour, width,
            dashed ? " stroke-dasharray=\"5 4\"" : "");
}

void report_svg_length_bar(FILE *out, double x, double y, double length, const char *text)
{
    fprintf(out, "<path d=\"M%.1f %.1fv8m0 -4h%.1fm0 -4v8\" stroke=\"#333\" stroke-width=\"1.5\" fill=\"none\"/>\n", x,
            y - 4.0, length);
    report_svg_text(out, x + length + 7.0, y + 4.5, "start", "", text);
}

/* ---- scales ---- */

double report_scale_at(const report_scale *s, double value)
{
    const double part = s->log ? log(value / s->lo) / log(s->hi / s->lo) : (value - s->lo) / (s->hi - s->lo);
    return s->from + part * (s->to - s->from);
}

double report_scale_round(double x)
{
    const double power = pow(10.0, floor(log10(x) + 1e-9)), first = x / power * (1.0 + 1e-9);
    return power * (first >= 5.0 ? 5.0 : first >= 2.0 ? 2.0 : 1.0);
}

static int linear_ticks(const report_scale *s, int about, double tick[REPORT_TICKS], double *step)
{
    const double range = s->hi - s->lo;
    int n = 0;
    *step = report_scale_round(range / about * 1.5);
    const double first = ceil(s->lo / *step - 1e-6);
    for (double k = first; n < REPORT_TICKS && k * *step <= s->hi + 1e-6 * range; k++) tick[n++] = k * *step;
    return n;
}

/* Within one decade even steps, within few 1, 2, 5, 10 ..., else powers of ten. */
static int log_ticks(const report_scale *s, double tick[REPORT_TICKS], double *step)
{
    static const double firsts[] = { 1.0, 2.0, 5.0 };
    const bool fine = s->hi / s->lo < 300.0;
    int n = 0;
    if (s->hi / s->lo < 8.0) return linear_ticks(s, 4, tick, step);
    for (double power = pow(10.0, floor(log10(s->lo))); power <= s->hi; power *= 10.0)
        for (int k = 0; k < (fine ? 3 : 1); k++) {
            const double value = power * firsts[k];
            if (value >= s->lo * 0.999 && value <= s->hi * 1.001 && n < REPORT_TICKS) tick[n++] = value;
        }
    return n;
}

int report_scale_ticks(const report_scale *s, int about, double tick[REPORT_TICKS], double *step)
{
    *step = 0.0;
    return s->log ? log_ticks(s, tick, step) : linear_ticks(s, about, tick, step);
}

/* 10 to a power, 2 of them: 2 and a dot before it; in characters that are raised, since a plot's text has no others. */
static void power_label(double tick, char out[32])
{
    static const char *const raised[] = { "\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                          "\u2075", "\u2076", "\u2077", "\u2078", "\u2079" };
    const int power = (int)floor(log10(tick) + 1e-9), n = abs(power) % 100;
    const double front = round(tick / pow(10.0, power));
    char first[8] = "";
    if (front > 1.0) snprintf(first, sizeof first, "%.0f\u00b7", front);
    snprintf(out, 32, "%s10%s%s%s", first, power < 0 ? "\u207b" : "", n > 9 ? raised[n / 10] : "", raised[n % 10]);
}

void report_scale_label(double tick, double step, char out[32])
{
    if (step <= 0.0 && tick > 0.0 && (tick > 9999.0 || tick < 1e-3)) {
        power_label(tick, out);
        return;
    }
    const int decimals = step > 0.0 ? (int)fmax(0.0, ceil(-log10(step) - 1e-9)) : 0;
    const double value = fabs(tick) < 1e-9 * step ? 0.0 : tick;
    if (step > 0.0 && decimals <= 6)
        snprintf(out, 32, "%.*f", decimals, value);
    else
        snprintf(out, 32, "%g", value);
}

void report_svg_grid_across(FILE *out, const report_scale *x, int about, double top, double bottom, double below)
{
    double tick[REPORT_TICKS], step;
    const int n = report_scale_ticks(x, about, tick, &step);
    for (int k = 0; k < n; k++) {
        const double at = report_scale_at(x, tick[k]);
        char text[32];
        report_scale_label(tick[k], step, text);
        report_svg_segment(out, at, top, at, bottom, GRID, 1.0);
        report_svg_text(out, at, bottom + below, "middle", "", text);
    }
}

void report_svg_grid_up(FILE *out, const report_scale *y, int about, double left, double right)
{
    double tick[REPORT_TICKS], step;
    const int n = report_scale_ticks(y, about, tick, &step);
    for (int k = 0; k < n; k++) {
        const double at = report_scale_at(y, tick[k]);
        char text[32];
        report_scale_label(tick[k], step, text);
        report_svg_segment(out, left, at, right, at, GRID, 1.0);
        report_svg_text(out, left - 6.0, at + 4.5, "end", "", text);
    }
}

void report_svg_upward_title(FILE *out, double y, const char *text)
{
    char turned[80];
    snprintf(turned, sizeof turned, "transform=\"rotate(-90 14 %.1f)\"", y);
    report_svg_text(out, 14.0, y, "middle", turned, text);
}
