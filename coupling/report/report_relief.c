/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_relief.h"

#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { WIDTH = 440, MARGIN = 8 };

/* ---- colours ---- */

/* Depth from pale to dark red-brown, height from pale to dark blue; the surface is nearly white.  shade: 0 .. 1. */
static void colour_of(double part, double shade, int rgb[3])
{
    static const int deep[3] = { 118, 30, 20 }, high[3] = { 22, 74, 140 }, flat[3] = { 246, 242, 234 };
    const int *end = part < 0.0 ? deep : high;
    const double t = pow(fmin(fabs(part), 1.0), 0.7);
    for (int i = 0; i < 3; i++) rgb[i] = (int)lround(shade * (flat[i] + t * (end[i] - flat[i])));
}

/* ---- the part that shows something ---- */

static double height_at(const report_relief *s, size_t i, size_t j)
{
    return s->height[i * s->ny + j];
}

/* First and last index along one direction with a value that counts, widened by a tenth, and to `least` points. */
static void crop_range(const size_t found[2], size_t n, size_t least, size_t range[2])
{
    const size_t size = found[1] - found[0] + 1, more = size / 10 + 2;
    range[0] = found[0] > more ? found[0] - more : 0;
    range[1] = found[1] + more < n ? found[1] + more : n - 1;
    while (range[1] - range[0] + 1 < least && (range[0] > 0 || range[1] + 1 < n)) {
        if (range[0] > 0) range[0]--;
        if (range[1] + 1 < n) range[1]++;
    }
}

double *report_relief_crop(report_relief *s, double least)
{
    size_t x[2] = { s->nx, 0 }, y[2] = { s->ny, 0 }, rx[2], ry[2];
    for (size_t i = 0; i < s->nx; i++)
        for (size_t j = 0; j < s->ny; j++) {
            if (fabs(height_at(s, i, j)) < least) continue;
            if (i < x[0]) x[0] = i;
            if (i > x[1]) x[1] = i;
            if (j < y[0]) y[0] = j;
            if (j > y[1]) y[1] = j;
        }
    if (x[0] > x[1]) x[0] = 0, x[1] = s->nx - 1, y[0] = 0, y[1] = s->ny - 1;
    crop_range(x, s->nx, 8, rx);
    crop_range(y, s->ny, (size_t)(0.3 * s->dx / s->dy * (double)(rx[1] - rx[0])), ry);
    const size_t nx = rx[1] - rx[0] + 1, ny = ry[1] - ry[0] + 1;
    double *part = malloc(nx * ny * sizeof *part);
    if (!part) return NULL;
    for (size_t i = 0; i < nx; i++)
        for (size_t j = 0; j < ny; j++) part[i * ny + j] = height_at(s, rx[0] + i, ry[0] + j);
    s->height = part;
    s->nx = nx;
    s->ny = ny;
    s->x0 += s->dx * (double)rx[0];
    s->y0 += s->dy * (double)ry[0];
    return part;
}

/* ---- the area above a level ---- */

/* The grid with a frame around it that lies below every level, so that every outline closes. */
typedef struct {
    const report_relief *s;
    double sign, level; /* the area: sign * height >= level */
    size_t w, h;        /* points, frame included */
    int32_t *next;      /* by edge: the edge to which the outline goes on, -1: none */
} outline;

static double above(const outline *o, size_t i, size_t j)
{
    if (i == 0 || j == 0 || i + 1 == o->w || j + 1 == o->h) return -INFINITY;
    return o->sign * height_at(o->s, i - 1, j - 1) - o->level;
}

/* Edges along x come first, those along y after them. */
static int32_t edge_x(const outline *o, size_t i, size_t j)
{
    return (int32_t)(j * o->w + i);
}

static int32_t edge_y(const outline *o, size_t i, size_t j)
{
    return (int32_t)(o->w * o->h + j * o->w + i);
}

/* Inside lies to the left of the outline.  Corners of a cell: 1 at (i, j), 2 at (i + 1, j), 4 across, 8 above 1. */
static void link_cell(outline *o, size_t i, size_t j)
{
    enum { B, R, T, L, NONE };
    static const unsigned char ways[16][4] = { { NONE },       { B, L, NONE }, { R, B, NONE }, { R, L, NONE },
                                               { T, R, NONE }, { B, L, T, R }, { T, B, NONE }, { T, L, NONE },
                                               { L, T, NONE }, { B, T, NONE }, { R, B, L, T }, { R, T, NONE },
                                               { L, R, NONE }, { B, R, NONE }, { L, B, NONE }, { NONE } };
    const int32_t edge[4] = { edge_x(o, i, j), edge_y(o, i + 1, j), edge_x(o, i, j + 1), edge_y(o, i, j) };
    const int corners = (above(o, i, j) >= 0.0) + 2 * (above(o, i + 1, j) >= 0.0) +
                        4 * (above(o, i + 1, j + 1) >= 0.0) + 8 * (above(o, i, j + 1) >= 0.0);
    const unsigned char *way = ways[corners];
    for (int k = 0; k < 4 && way[k] != NONE; k += 2) o->next[edge[way[k]]] = edge[way[k + 1]];
}

/* Where the outline crosses an edge, in points of the grid without its frame. */
static void crossing(const outline *o, int32_t edge, double at[2])
{
    const size_t all = o->w * o->h, e = (size_t)edge % all, i = e % o->w, j = e / o->w;
    const bool along_x = (size_t)edge < all;
    const double a = above(o, i, j), b = along_x ? above(o, i + 1, j) : above(o, i, j + 1);
    const double part = !isfinite(a) ? 1.0 : !isfinite(b) ? 0.0 : a == b ? 0.5 : a / (a - b);
    at[0] = (double)i - 1.0 + (along_x ? part : 0.0);
    at[1] = (double)j - 1.0 + (along_x ? 0.0 : part);
}

typedef struct {
    double left, bottom, along, across; /* the picture's units a point of the grid */
} placing;

static void write_outline(FILE *out, outline *o, const placing *at, const int rgb[3])
{
    bool some = false;
    const size_t edges = 2 * o->w * o->h;
    for (size_t e = 0; e < edges; e++) {
        bool first = true;
        for (int32_t edge = (int32_t)e; o->next[edge] >= 0;) {
            double p[2];
            const int32_t then = o->next[edge];
            crossing(o, edge, p);
            if (!some) fprintf(out, "<path fill=\"#%02x%02x%02x\" d=\"", rgb[0], rgb[1], rgb[2]);
            some = true;
            fprintf(out, "%c%.1f %.1f", first ? 'M' : 'L', at->left + at->along * p[0], at->bottom - at->across * p[1]);
            first = false;
            o->next[edge] = -1;
            edge = then;
        }
        if (!first) fputc('Z', out);
    }
    if (some) fputs("\"/>\n", out);
}

static void draw_level(FILE *out, outline *o, const placing *at, double part)
{
    int rgb[3];
    for (size_t e = 0; e < 2 * o->w * o->h; e++) o->next[e] = -1;
    for (size_t j = 0; j + 1 < o->h; j++)
        for (size_t i = 0; i + 1 < o->w; i++) link_cell(o, i, j);
    colour_of(part, 1.0, rgb);
    write_outline(out, o, at, rgb);
}

/* ---- from above ---- */

static const int LEVELS = 10;

/* The step between levels: round, so that the legend's numbers are. */
static double level_step(const report_relief *s)
{
    return report_scale_round(2.0 * s->colour_range / LEVELS);
}

static void draw_levels(FILE *out, const report_relief *s, const placing *at, int32_t *room)
{
    const double step = level_step(s);
    outline o = { .s = s, .w = s->nx + 2, .h = s->ny + 2, .next = room };
    for (int side = -1; side <= 1; side += 2)
        for (double level = 0.5 * step; level < s->colour_range + 0.5 * step; level += step) {
            o.sign = side;
            o.level = level;
            draw_level(out, &o, at, side * (level + 0.5 * step) / s->colour_range);
        }
}

/* A box a level from the deepest to the highest that there is, each with its height. */
static void draw_colours(FILE *out, const report_relief *s, double y)
{
    const double step = level_step(s);
    double lo = 0.0, hi = 0.0, x = MARGIN;
    for (size_t k = 0; k < s->nx * s->ny; k++) lo = fmin(lo, s->height[k]), hi = fmax(hi, s->height[k]);
    const double most = s->colour_range + 0.5 * step;
    const int first = (int)lround(fmax(lo, -most) / step), last = (int)lround(fmin(hi, most) / step);
    const double width =
        fmin(34.0, (WIDTH - 2.0 * MARGIN - 7.0 - report_svg_text_width(s->legend)) / (last - first + 1));
    const int every = width < 30.0 ? (int)ceil(30.0 / width) : 1;
    for (int k = first; k <= last; k++, x += width) {
        int rgb[3];
        char text[32];
        colour_of(k * step / s->colour_range, 1.0, rgb);
        fprintf(out,
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"12\" fill=\"#%02x%02x%02x\" stroke=\"#bbb\" "
                "stroke-width=\"0.5\"/>\n",
                x, y, width, rgb[0], rgb[1], rgb[2]);
        report_scale_label(k * step / s->unit, step / fabs(s->unit), text);
        if (k % every == 0) report_svg_text(out, x + 0.5 * width, y + 25.0, "middle", "font-size=\"11\"", text);
    }
    report_svg_text(out, x + 6.0, y + 11.0, "start", "font-size=\"12\"", s->legend);
}

/* A fifth of the picture or so. */
static void draw_length(FILE *out, double metres_wide, double units_wide, double x, double y)
{
    char text[48];
    const double length = report_scale_round(0.25 * metres_wide);
    snprintf(text, sizeof text, "%g mm", 1e3 * length);
    report_svg_length_bar(out, x, y, length / metres_wide * units_wide, text);
}

static void draw_map(FILE *out, const report_relief *s, int32_t *room, const char *name)
{
    const double width = WIDTH - 2.0 * MARGIN, wide = s->dx * (double)(s->nx - 1), high = s->dy * (double)(s->ny - 1);
    const double height = width * high / wide;
    const placing at = { MARGIN, 22.0 + height, width / (double)(s->nx - 1), height / (double)(s->ny - 1) };
    int rgb[3];
    colour_of(0.0, 1.0, rgb);
    report_svg_begin(out, WIDTH, height + 80.0, name);
    report_svg_text(out, WIDTH - MARGIN, 14.0, "end", "font-size=\"12\"", s->above);
    fprintf(out, "<rect x=\"%d\" y=\"22\" width=\"%.1f\" height=\"%.1f\" fill=\"#%02x%02x%02x\"/>\n", MARGIN, width,
            height, rgb[0], rgb[1], rgb[2]);
    draw_levels(out, s, &at, room);
    fprintf(out, "<rect x=\"%d\" y=\"22\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#777\"/>\n", MARGIN,
            width, height);
    if (s->marked)
        fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7\" fill=\"none\" stroke=\"#111\" stroke-width=\"2\"/>\n",
                at.left + at.along * (s->mark[0] - s->x0) / s->dx,
                at.bottom - at.across * (s->mark[1] - s->y0) / s->dy);
    draw_length(out, wide, width, MARGIN, 10.0);
    draw_colours(out, s, height + 38.0);
    report_svg_end(out);
}

char *report_relief_map(const report_relief *s, const char *name)
{
    char *text = NULL;
    size_t size;
    int32_t *room = malloc(2 * (s->nx + 2) * (s->ny + 2) * sizeof *room);
    FILE *out = room ? open_memstream(&text, &size) : NULL;
    if (out) {
        draw_map(out, s, room, name);
        fclose(out);
    }
    free(room);
    return text;
}

/* ---- aside ---- */

enum { MOST_X = 72, MOST_Y = 40 };
static const double TURN = 0.42, TILT = 0.62; /* of the view, about the height and from above [rad] */

typedef struct {
    const report_relief *s;
    size_t nx, ny;
    double up;               /* heights are drawn so many times as large as lengths */
    double units, left, top; /* of the picture */
} view;

/* Between the points of the grid, at a part of its extent. */
static double sampled(const report_relief *s, double along, double across)
{
    const double x = along * (double)(s->nx - 1), y = across * (double)(s->ny - 1);
    const size_t i = (size_t)fmin(floor(x), (double)(s->nx - 2)), j = (size_t)fmin(floor(y), (double)(s->ny - 2));
    const double p = x - (double)i, q = y - (double)j;
    return (1.0 - p) * ((1.0 - q) * height_at(s, i, j) + q * height_at(s, i, j + 1)) +
           p * ((1.0 - q) * height_at(s, i + 1, j) + q * height_at(s, i + 1, j + 1));
}

/* Lengths from the middle; the far side has the larger y. */
static void project(const view *v, double x, double y, double h, double at[2])
{
    at[0] = v->left + v->units * (x * cos(TURN) + y * sin(TURN));
    at[1] = v->top - v->units * ((y * cos(TURN) - x * sin(TURN)) * sin(TILT) + v->up * h * cos(TILT));
}

/* The mean of each point and its neighbours, those across counted half and those at corners a quarter. */
static double *smoothed(const report_relief *s)
{
    double *out = malloc(s->nx * s->ny * sizeof *out);
    for (size_t i = 0; out && i < s->nx; i++)
        for (size_t j = 0; j < s->ny; j++) {
            double sum = 0.0, weights = 0.0;
            for (size_t k = i > 0 ? i - 1 : 0; k <= i + 1 && k < s->nx; k++)
                for (size_t l = j > 0 ? j - 1 : 0; l <= j + 1 && l < s->ny; l++) {
                    const double weight = (k == i ? 1.0 : 0.5) * (l == j ? 1.0 : 0.5);
                    sum += weight * height_at(s, k, l);
                    weights += weight;
                }
            out[i * s->ny + j] = sum / weights;
        }
    return out;
}

static double extent_x(const view *v)
{
    return v->s->dx * (double)(v->s->nx - 1);
}

static double extent_y(const view *v)
{
    return v->s->dy * (double)(v->s->ny - 1);
}

static void corner(const view *v, size_t i, size_t j, double at[2])
{
    const double p = (double)i / (double)v->nx, q = (double)j / (double)v->ny;
    project(v, (p - 0.5) * extent_x(v), (q - 0.5) * extent_y(v), sampled(v->s, p, q), at);
}

/* Light from the upper left; a slope that faces it is light.  Few colours, so that neighbours share one. */
static unsigned facet_colour(const view *v, size_t i, size_t j)
{
    const double p0 = (double)i / (double)v->nx, p1 = (double)(i + 1) / (double)v->nx, q0 = (double)j / (double)v->ny,
                 q1 = (double)(j + 1) / (double)v->ny;
    const double a = sampled(v->s, p0, q0), b = sampled(v->s, p1, q0), c = sampled(v->s, p1, q1),
                 d = sampled(v->s, p0, q1);
    const double sx = v->up * 0.5 * (b + c - a - d) * (double)v->nx / extent_x(v),
                 sy = v->up * 0.5 * (c + d - a - b) * (double)v->ny / extent_y(v);
    const double facing = (0.55 * sx - 0.25 * sy + 0.80) / sqrt(1.0 + sx * sx + sy * sy);
    int rgb[3];
    const double part = 0.25 * (a + b + c + d) / v->s->colour_range, shade = fmin(fmax(0.3 + 0.85 * facing, 0.25), 1.0);
    colour_of(round(16.0 * part) / 16.0, round(20.0 * shade) / 20.0, rgb);
    return (unsigned)(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
}

/* Half units of the picture, each from the last one written: short numbers. */
static void write_point(FILE *out, const double at[2], bool first, long last[2])
{
    const long x = lround(2.0 * at[0]), y = lround(2.0 * at[1]);
    fprintf(out, first ? "M%ld %ldl" : "%ld %ld ", first ? x : x - last[0], first ? y : y - last[1]);
    last[0] = x;
    last[1] = y;
}

/* One strip across the view, from the far end of x: neighbours of one colour become one polygon. */
static void draw_strip(FILE *out, const view *v, size_t j)
{
    for (size_t i = 0, end; i < v->nx; i = end) {
        const unsigned colour = facet_colour(v, i, j);
        for (end = i + 1; end < v->nx && facet_colour(v, end, j) == colour;) end++;
        double at[2];
        long last[2] = { 0, 0 };
        fprintf(out, "<path color=\"#%06x\" d=\"", colour);
        for (size_t k = i; k <= end; k++) {
            corner(v, k, j, at);
            write_point(out, at, k == i, last);
        }
        for (size_t k = end + 1; k-- > i;) {
            corner(v, k, j + 1, at);
            write_point(out, at, false, last);
        }
        fputs("\"/>\n", out);
    }
}

/* The near side (all of x at the least y) and the end (all of y at the largest x), down to `base`. */
static void draw_wall(FILE *out, const view *v, bool near, double base)
{
    double at[2];
    const size_t n = near ? v->nx : v->ny;
    fprintf(out, "<path color=\"%s\" d=\"", near ? "#b9b3a6" : "#938d80");
    for (size_t k = 0; k <= n; k++) {
        corner(v, near ? k : v->nx, near ? 0 : k, at);
        fprintf(out, "%c%.0f %.0f", k == 0 ? 'M' : 'L', 2.0 * at[0], 2.0 * at[1]);
    }
    for (int side = 1; side >= 0; side--) {
        const double x = near ? (side - 0.5) * extent_x(v) : 0.5 * extent_x(v),
                     y = near ? -0.5 * extent_y(v) : (side - 0.5) * extent_y(v);
        project(v, x, y, base, at);
        fprintf(out, "L%.0f %.0f", 2.0 * at[0], 2.0 * at[1]);
    }
    fputs("Z\"/>\n", out);
}

/* How large the picture is, and heights so many times as large that they reach a sixth of the length. */
static view view_of(const report_relief *s, double *lowest, double *highest)
{
    view v = { .s = s, .nx = s->nx - 1 < MOST_X ? s->nx - 1 : MOST_X, .ny = s->ny - 1 < MOST_Y ? s->ny - 1 : MOST_Y };
    *lowest = *highest = 0.0;
    for (size_t k = 0; k < s->nx * s->ny; k++) {
        *lowest = fmin(*lowest, s->height[k]);
        *highest = fmax(*highest, s->height[k]);
    }
    const double relief = fmax(*highest - *lowest, 1e-9 * extent_x(&v));
    v.up = fmax(1.0, report_scale_round(extent_x(&v) / 6.0 / relief));
    v.units = (WIDTH - 2.0 * MARGIN) / (extent_x(&v) * cos(TURN) + extent_y(&v) * sin(TURN));
    v.left = 0.5 * WIDTH;
    v.top = 24.0 + v.units * (0.5 * (extent_y(&v) * cos(TURN) + extent_x(&v) * sin(TURN)) * sin(TILT) +
                              v.up * *highest * cos(TILT));
    return v;
}

/* A length along the near side. */
static void draw_length_aside(FILE *out, const view *v, double base)
{
    const double length = report_scale_round(0.25 * extent_x(v));
    double a[2], b[2];
    char text[48];
    project(v, -0.5 * extent_x(v), -0.5 * extent_y(v), base, a);
    project(v, -0.5 * extent_x(v) + length, -0.5 * extent_y(v), base, b);
    fprintf(out,
            "<path d=\"M%.1f %.1fv8m0 -4L%.1f %.1fm0 -4v8\" stroke=\"#333\" stroke-width=\"1.5\" fill=\"none\"/>\n",
            a[0], a[1] + 6.0, b[0], b[1] + 10.0);
    snprintf(text, sizeof text, "%g mm", 1e3 * length);
    report_svg_text(out, b[0] + 6.0, b[1] + 22.0, "start", "", text);
}

static void draw_aside(FILE *out, const report_relief *s, const char *name, double *exaggeration)
{
    double lowest, highest, at[2];
    const view v = view_of(s, &lowest, &highest);
    const double base = lowest - 0.02 * extent_x(&v) / v.up;
    *exaggeration = v.up;
    project(&v, 0.5 * extent_x(&v), -0.5 * extent_y(&v), base, at);
    report_svg_begin(out, WIDTH, at[1] + 24.0, name);
    fputs("<g transform=\"scale(.5)\" fill=\"currentColor\" stroke=\"currentColor\" stroke-width=\"1\" "
          "stroke-linejoin=\"round\">\n",
          out);
    for (size_t j = v.ny; j-- > 0;) draw_strip(out, &v, j);
    draw_wall(out, &v, true, base);
    draw_wall(out, &v, false, base);
    fputs("</g>\n", out);
    draw_length_aside(out, &v, base);
    report_svg_text(out, WIDTH - MARGIN, 14.0, "end", "font-size=\"12\"", s->above);
    report_svg_end(out);
}

char *report_relief_aside(const report_relief *s, const char *name, double *exaggeration)
{
    char *text = NULL;
    size_t size;
    report_relief smooth = *s;
    double *heights = smoothed(s);
    FILE *out = heights ? open_memstream(&text, &size) : NULL;
    if (out) {
        smooth.height = heights;
        draw_aside(out, &smooth, name, exaggeration);
        fclose(out);
    }
    free(heights);
    return text;
}
