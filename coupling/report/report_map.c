/* SPDX-License-Identifier: BSD-3-Clause */
/* The crater's map as a light SVG: depth in colour levels, neighbours of one level joined into one rectangle. */
#include "coupling/report/report_plots.h"

#include "coupling/host/outdir.h"

#include <math.h>
#include <stdlib.h>

enum { LEVELS = 12, MAX_X = 240, MAX_Z = 120, WIDTH = 640, LEFT = 56, RIGHT = 14, TOP = 12, BAR = 46 };

typedef struct {
    double *depth; /* nx x nz, owned [m] */
    size_t nx, nz;
    double x0, x1, z0, z1;   /* middles of the outer cells [m] */
    double deepest, highest; /* [m], >= 0 */
} map;

/* Level -LEVELS .. LEVELS: 0 is the surface, positive is depth. */
static int level_of(const map *m, double depth)
{
    const double range = depth > 0.0 ? m->deepest : m->highest;
    return range > 0.0 && isfinite(depth) ? (int)lround(LEVELS * depth / range) : 0;
}

/* Crater from pale to dark red-brown, rim from pale to dark blue; the surface is nearly white. */
static void level_colour(int level, int rgb[3])
{
    static const int crater[3] = { 118, 30, 20 }, rim[3] = { 22, 74, 140 }, flat[3] = { 246, 244, 240 };
    const int *end = level > 0 ? crater : rim;
    const double t = sqrt(fabs((double)level) / LEVELS);
    for (int i = 0; i < 3; i++) rgb[i] = (int)lround(flat[i] + t * (end[i] - flat[i]));
}

/* Deepest or highest of the map cells that fall on one picture cell, whichever is larger: nothing is averaged away. */
static double picture_cell(const map *m, size_t i0, size_t i1, size_t k0, size_t k1)
{
    double chosen = 0.0;
    for (size_t i = i0; i < i1; i++)
        for (size_t k = k0; k < k1; k++) {
            const double d = m->depth[i * m->nz + k];
            if (fabs(d) > fabs(chosen)) chosen = d;
        }
    return chosen;
}

static void rectangle(FILE *out, double x, double y, double w, double h, int level)
{
    int rgb[3];
    level_colour(level, rgb);
    fprintf(out, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"#%02x%02x%02x\"/>\n", x, y, w, h,
            rgb[0], rgb[1], rgb[2]);
}

static void draw_cells(const map *m, FILE *out, double width, double height)
{
    const size_t cx = m->nx < MAX_X ? m->nx : MAX_X, cz = m->nz < MAX_Z ? m->nz : MAX_Z;
    const double w = width / (double)cx, h = height / (double)cz;
    fprintf(out, "<g shape-rendering=\"crispEdges\">\n");
    rectangle(out, LEFT, TOP, width, height, 0);
    for (size_t k = 0; k < cz; k++) {
        size_t start = 0;
        int run = 0;
        for (size_t i = 0; i <= cx; i++) {
            const int level = i == cx ? LEVELS + 1
                                      : level_of(m, picture_cell(m, i * m->nx / cx, (i + 1) * m->nx / cx,
                                                                 k * m->nz / cz, (k + 1) * m->nz / cz));
            if (level == run) continue;
            if (run != 0 && i > start)
                rectangle(out, LEFT + w * (double)start, TOP + height - h * (double)(k + 1), w * (double)(i - start), h,
                          run);
            start = i;
            run = level;
        }
    }
    fputs("</g>\n", out);
}

static void label(FILE *out, double x, double y, const char *anchor, const char *format, double value)
{
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
    fprintf(out, format, value);
    fputs("</text>\n", out);
}

static void draw_frame(const map *m, FILE *out, double width, double height)
{
    fprintf(out, "<rect x=\"%d\" y=\"%d\" width=\"%.2f\" height=\"%.2f\" fill=\"none\" stroke=\"#666\"/>\n", LEFT, TOP,
            width, height);
    const double bottom = TOP + height + 16.0;
    for (int t = 0; t <= 4; t++)
        label(out, LEFT + 0.25 * t * width, bottom,
              t == 0   ? "start"
              : t == 4 ? "end"
                       : "middle",
              t == 4 ? "%.2f mm" : "%.2f", 1e3 * (m->x0 + 0.25 * t * (m->x1 - m->x0)));
    label(out, LEFT - 6.0, TOP + height, "end", "%.2f", 1e3 * m->z0);
    label(out, LEFT - 6.0, TOP + 10.0, "end", "%.2f", 1e3 * m->z1);
    const double y = bottom + 12.0, w = 200.0 / (2 * LEVELS + 1);
    for (int l = -LEVELS; l <= LEVELS; l++) rectangle(out, LEFT + w * (l + LEVELS), y, w + 0.3, 10.0, l);
    label(out, LEFT + 208.0, y + 9.0, "start", "rim %.3f mm (left)", 1e3 * m->highest);
    label(out, LEFT + 340.0, y + 9.0, "start", "depth %.3f mm (right)", 1e3 * m->deepest);
}

static status draw(const report_source *r, const char *scene, const map *m)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%.850s/plot-map-%.120s.svg", r->dir, scene);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", r->dir);
    const double width = WIDTH - LEFT - RIGHT, cell_x = (m->x1 - m->x0) / (double)(m->nx - 1);
    const double aspect = (m->z1 - m->z0 + cell_x) / (m->x1 - m->x0 + cell_x);
    const double height = fmin(fmax(width * aspect, 30.0), 2.0 * width); /* true to scale but for the narrowest */
    file_writer w;
    TRY(host_file_begin(&w, path));
    fprintf(w.stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %.0f\" width=\"%d\" font-family=\"sans-serif\" "
            "font-size=\"12\" fill=\"#333\">\n",
            WIDTH, TOP + height + BAR, WIDTH);
    draw_cells(m, w.stream, width, height);
    draw_frame(m, w.stream, width, height);
    fputs("</svg>\n", w.stream);
    return host_file_end(&w, true);
}

static bool read_part(const report_source *r, const char *scene, const char *part, double **data,
                      size_t dims[H5_MAX_RANK])
{
    char path[300];
    snprintf(path, sizeof path, "/scene/%.150s/crater/%s", scene, part);
    return host_h5_read(r->history, path, data, dims).code == STATUS_OK;
}

static bool read_map(const report_source *r, const char *scene, map *m)
{
    double *x = NULL, *z = NULL;
    size_t nx[H5_MAX_RANK], nz[H5_MAX_RANK], dims[H5_MAX_RANK];
    const bool there = read_part(r, scene, "depth", &m->depth, dims) && read_part(r, scene, "x", &x, nx) &&
                       read_part(r, scene, "z", &z, nz) && dims[0] == nx[0] && dims[1] == nz[0] && dims[0] > 1 &&
                       dims[1] > 1;
    if (there) {
        m->nx = dims[0];
        m->nz = dims[1];
        m->x0 = x[0];
        m->x1 = x[m->nx - 1];
        m->z0 = z[0];
        m->z1 = z[m->nz - 1];
        for (size_t i = 0; i < m->nx * m->nz; i++) {
            m->deepest = fmax(m->deepest, m->depth[i]);
            m->highest = fmax(m->highest, -m->depth[i]);
        }
    }
    free(x);
    free(z);
    return there;
}

status report_plot_crater_map(const report_source *r, const char *scene, bool *drawn)
{
    map m = { .depth = NULL };
    *drawn = r->history && read_map(r, scene, &m);
    const status s = *drawn ? draw(r, scene, &m) : status_ok();
    free(m.depth);
    if (s.code != STATUS_OK) *drawn = false;
    return s;
}
