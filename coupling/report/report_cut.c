/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene's bodies cut through their middle, at the first and at the last snapshot.
 *
 * The cut holds the flight of the fastest body: its axis to the right, across it upwards.  In a mirrored scene it is
 * the plane of symmetry.  Points whose domains the plane cuts are spread over a raster of small squares, a row of one
 * body being one strip of the picture. */
#include "coupling/report/report_page.h"

#include "coupling/host/outdir.h"
#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 440, MARGIN = 8, COLUMNS = 220, MOST_ROWS = 300, MOST_BODIES = 10 };

/* ---- reading ---- */

typedef struct {
    double *at, *size, *velocity, *body, *damage; /* n x 3, n x 3, n x 3, n, n; owned */
    double time;                                  /* [s] */
    size_t n;
} snapshot;

static void snapshot_free(snapshot *s)
{
    free(s->at);
    free(s->size);
    free(s->velocity);
    free(s->body);
    free(s->damage);
}

static bool read_all(const h5_file *f, snapshot *s)
{
    const struct {
        const char *path;
        double **to;
    } parts[] = { { "/VTKHDF/Points", &s->at },
                  { "/VTKHDF/PointData/size", &s->size },
                  { "/VTKHDF/PointData/velocity", &s->velocity },
                  { "/VTKHDF/PointData/body", &s->body },
                  { "/VTKHDF/PointData/damage", &s->damage } };
    size_t dims[H5_MAX_RANK];
    double *time;
    for (int k = 0; k < PAGE_COUNT(parts); k++) {
        if (host_h5_read(f, parts[k].path, parts[k].to, dims).code != STATUS_OK) return false;
        if (k == 0) s->n = dims[0];
        if (dims[0] != s->n || s->n == 0) return false;
    }
    s->time = NAN;
    if (host_h5_read(f, "/VTKHDF/FieldData/time", &time, dims).code == STATUS_OK) {
        s->time = time[0];
        free(time);
    }
    return true;
}

static bool read_snapshot(const report_source *r, int number, snapshot *s)
{
    char path[OUTDIR_PATH_SIZE];
    h5_file *f;
    *s = (snapshot){ .at = NULL };
    snprintf(path, sizeof path, "%.900s/scenes/scene/scene-%06d.hdf", r->dir, number);
    if (!host_file_exists(path) || host_h5_open(path, &f).code != STATUS_OK) return false;
    const bool there = read_all(f, s);
    host_h5_close(f);
    return there;
}

static int last_snapshot(const report_source *r)
{
    char path[OUTDIR_PATH_SIZE];
    int n = -1;
    do {
        snprintf(path, sizeof path, "%.900s/scenes/scene/scene-%06d.hdf", r->dir, ++n);
    } while (host_file_exists(path));
    return n - 1;
}

/* ---- the plane ---- */

typedef struct {
    int along, across, normal; /* axes */
    double at;                 /* of the plane along its normal [m] */
    double lo[2], hi[2];       /* of the picture along and across [m] */
} plane;

/* The body that is fastest at the start, and its flight's axis. */
static int fastest_axis(const snapshot *s, double *body)
{
    double most = -1.0;
    int axis = 0;
    for (size_t i = 0; i < s->n; i++)
        for (int k = 0; k < 3; k++) {
            const double v = fabs(s->velocity[3 * i + (size_t)k]);
            if (v <= most) continue;
            most = v;
            axis = k;
            *body = s->body[i];
        }
    return axis;
}

/* Through the middle of the body; where no point lies on the other side of 0, through 0. */
static double plane_place(const snapshot *s, double body, int normal)
{
    double lo = INFINITY, hi = -INFINITY, all = INFINITY;
    for (size_t i = 0; i < s->n; i++) {
        const double at = s->at[3 * i + (size_t)normal], half = s->size[3 * i + (size_t)normal];
        all = fmin(all, at - half);
        if (s->body[i] != body) continue;
        lo = fmin(lo, at - half);
        hi = fmax(hi, at + half);
    }
    return all > -1e-3 * (hi - lo) ? 0.0 : 0.5 * (lo + hi);
}

static bool is_cut(const snapshot *s, const plane *p, size_t i)
{
    const size_t k = 3 * i + (size_t)p->normal;
    return fabs(s->at[k] - p->at) <= 1.05 * s->size[k];
}

static void widen(const snapshot *s, plane *p)
{
    for (size_t i = 0; i < s->n; i++) {
        if (!is_cut(s, p, i)) continue;
        const int axis[2] = { p->along, p->across };
        for (int k = 0; k < 2; k++) {
            p->lo[k] = fmin(p->lo[k], s->at[3 * i + (size_t)axis[k]] - s->size[3 * i + (size_t)axis[k]]);
            p->hi[k] = fmax(p->hi[k], s->at[3 * i + (size_t)axis[k]] + s->size[3 * i + (size_t)axis[k]]);
        }
    }
}

static plane plane_of(const snapshot *first, const snapshot *last)
{
    double body = 0.0;
    plane p = { .lo = { INFINITY, INFINITY }, .hi = { -INFINITY, -INFINITY } };
    p.along = fastest_axis(first, &body);
    p.normal = p.along == 2 ? 1 : 2;
    p.across = 3 - p.along - p.normal;
    p.at = plane_place(first, body, p.normal);
    widen(first, &p);
    widen(last, &p);
    return p;
}

/* ---- the raster ---- */

typedef struct {
    uint8_t *body; /* rows x columns: 0 nothing, 1 + body, + MOST_BODIES where failed; owned */
    int columns, rows;
    double cell; /* [m] */
} raster;

static const double ROOM = 1.2; /* domains of points that have moved apart leave gaps */

static void fill(const snapshot *s, const plane *p, raster *r)
{
    for (size_t i = 0; i < s->n; i++) {
        if (!is_cut(s, p, i)) continue;
        const double x = s->at[3 * i + (size_t)p->along] - p->lo[0], y = s->at[3 * i + (size_t)p->across] - p->lo[1],
                     a = ROOM * s->size[3 * i + (size_t)p->along], b = ROOM * s->size[3 * i + (size_t)p->across];
        const int body = (int)s->body[i] % MOST_BODIES, failed = s->damage[i] >= 1.0;
        const int from = (int)fmax(0.0, floor((x - a) / r->cell + 0.5)), to = (int)ceil((x + a) / r->cell - 0.5),
                  low = (int)fmax(0.0, floor((y - b) / r->cell + 0.5)), high = (int)ceil((y + b) / r->cell - 0.5);
        for (int j = low; j < r->rows && (j < high || j == low); j++)
            for (int k = from; k < r->columns && (k < to || k == from); k++)
                r->body[j * r->columns + k] = (uint8_t)(1 + body + MOST_BODIES * failed);
    }
}

/* All strips of one body, each a little into the next: no seams where a screen rounds. */
static void draw_body(FILE *out, const raster *r, int value, double unit, double bottom)
{
    bool some = false;
    for (int j = 0; j < r->rows; j++)
        for (int k = 0, end; k < r->columns; k = end) {
            for (end = k + 1; end < r->columns && r->body[j * r->columns + end] == r->body[j * r->columns + k];) end++;
            if (r->body[j * r->columns + k] != value) continue;
            if (!some)
                fprintf(out, "<path fill=\"%s\"%s d=\"", report_shade((value - 1) % MOST_BODIES),
                        value > MOST_BODIES ? " fill-opacity=\"0.45\"" : "");
            some = true;
            fprintf(out, "M%.5g %.5gh%.4gv-%.3gh-%.4gz", MARGIN + k * unit, bottom - j * unit, (end - k) * unit,
                    unit + 0.4, (end - k) * unit);
        }
    if (some) fputs("\"/>\n", out);
}

static void draw(FILE *out, const snapshot *s, const plane *p, raster *r, const char *name)
{
    const double unit = (WIDTH - 2.0 * MARGIN) / r->columns, height = unit * r->rows, wide = p->hi[0] - p->lo[0];
    char text[64];
    memset(r->body, 0, (size_t)r->rows * (size_t)r->columns);
    fill(s, p, r);
    report_svg_begin(out, WIDTH, height + 44.0, name);
    report_svg_text(out, MARGIN, 15.0, "start", "font-weight=\"600\"", name);
    fprintf(out, "<g shape-rendering=\"crispEdges\">\n");
    for (int value = 1; value <= 2 * MOST_BODIES; value++) draw_body(out, r, value, unit, 24.0 + height);
    fputs("</g>\n", out);
    fprintf(out, "<rect x=\"%d\" y=\"24\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#ccc\"/>\n", MARGIN,
            WIDTH - 2.0 * MARGIN, height);
    const double length = report_scale_round(0.25 * wide);
    snprintf(text, sizeof text, "%g mm", 1e3 * length);
    report_svg_length_bar(out, MARGIN, height + 35.0, length / wide * (WIDTH - 2.0 * MARGIN), text);
    report_svg_end(out);
}

static void figure(const page *p, const snapshot *s, const plane *cut, raster *r, const char *file, bool first)
{
    char name[80], *svg = NULL;
    size_t size;
    snprintf(name, sizeof name, isfinite(s->time) ? "%s, at %.3g \302\265s" : "%s", first ? "before" : "after",
             1e6 * s->time);
    FILE *out = open_memstream(&svg, &size);
    if (!out) return;
    draw(out, s, cut, r, name);
    fclose(out);
    report_page_svg(p, file, "", svg);
}

/* Bodies in their colours; names are of the summary, in the scene's order. */
static void legend(const page *p)
{
    const cJSON *body;
    int k = 0;
    fputs("<p class=\"legend\">", p->out);
    cJSON_ArrayForEach(body, report_page_list(p, "bodies"))
    {
        fprintf(p->out, "<span><i style=\"background:%s\"></i>", report_shade(k++ % MOST_BODIES));
        report_svg_escaped(p->out, body->string);
        fputs("</span> ", p->out);
    }
    fputs("<span>pale: failed</span></p>\n", p->out);
}

void report_cut_section(const page *p)
{
    snapshot first, last;
    const int n = last_snapshot(p->source);
    if (n < 1) return;
    const bool has_first = read_snapshot(p->source, 0, &first), has_last = read_snapshot(p->source, n, &last);
    if (has_first && has_last) {
        const plane cut = plane_of(&first, &last);
        raster r = { .columns = COLUMNS, .cell = (cut.hi[0] - cut.lo[0]) / COLUMNS };
        r.rows = (int)fmin(ceil((cut.hi[1] - cut.lo[1]) / r.cell), MOST_ROWS);
        r.body = malloc((size_t)r.rows * COLUMNS);
        if (r.body) {
            report_page_heading(p, "Cut through the middle");
            legend(p);
            report_page_plots_begin(p);
            figure(p, &first, &cut, &r, "before", true);
            figure(p, &last, &cut, &r, "after", false);
            report_page_plots_end(p);
        }
        free(r.body);
    }
    snapshot_free(&first);
    snapshot_free(&last);
}
