/* SPDX-License-Identifier: BSD-3-Clause */
/* The rail's surface along sample lines, and the map of its depth (rules in crater.h). */
#include "coupling/gouge/crater_parts.h"

#include <math.h>
#include <stdlib.h>

enum { SAMPLES = 2 /* sample lines a map cell and axis */, MAP_LIMIT = 20000000 /* cells of a map */ };
static const double GAUSS =
    0.21132486540518712;       /* (1 - 1/sqrt 3)/2: a cell's mean from its lines is exact for a cubic */
static const double GAP = 1.2; /* of the touching distance: a wider gap ends the rail */
static const double FOOTPRINT_SLACK =
    0.1; /* of a half length: slits between points that have moved apart a little are closed */

/* What has been met on a sample line so far. */
typedef struct {
    double top;   /* of the points on it [m] */
    double sound; /* as far up as sound metal goes on, merged points beside the line too [m] */
    double reach; /* of the point that ends there (reach_of); < 0: no point yet [m] */
} sample;

/* Sample lines. */
typedef struct {
    int nx, nz;
    double x_axis[2], z_axis[2]; /* lowest edge of the map, its cell [m] */
    sample *line;                /* nx x nz */
} sampling;

typedef struct {
    double bottom; /* [m] */
    size_t point;
} layer;

static int by_bottom(const void *a, const void *b)
{
    const layer *p = a, *q = b;
    if (p->bottom != q->bottom) return p->bottom < q->bottom ? -1 : 1;
    return (p->point > q->point) - (p->point < q->point);
}

/* Position of line i of an axis {lowest edge of the map, cell}. */
static double line_at(const double axis[2], int i)
{
    return axis[0] + axis[1] * (i / SAMPLES + (i % SAMPLES ? 1.0 - GAUSS : GAUSS));
}

/* First and last of n lines of one axis within half of the middle; first > last if none. */
static void lines_of(double middle, double half, const double axis[2], int n, int range[2])
{
    const double lo = middle - half * (1.0 + FOOTPRINT_SLACK), hi = middle + half * (1.0 + FOOTPRINT_SLACK);
    const double first_cell = floor((lo - axis[0]) / axis[1]), last_cell = floor((hi - axis[0]) / axis[1]);
    range[0] = (int)fmin(fmax(SAMPLES * first_cell, 0.0), n);
    range[1] = (int)fmax(fmin(SAMPLES * last_cell + SAMPLES - 1.0, n - 1.0), -1.0);
    while (range[0] <= range[1] && line_at(axis, range[0]) < lo) range[0]++;
    while (range[0] <= range[1] && line_at(axis, range[1]) > hi) range[1]--;
}

/* Lines that a footprint `wide` times as wide meets. */
typedef struct {
    int x[2], z[2];
} lines;

static lines footprint(const crater_points *p, size_t i, const sampling *s, double wide)
{
    lines met;
    lines_of(p->position[3 * i], wide * p->size[3 * i], s->x_axis, s->nx, met.x);
    lines_of(p->position[3 * i + 2], wide * p->size[3 * i + 2], s->z_axis, s->nz, met.z);
    return met;
}

static bool is_met(const lines *l, int ix, int iz)
{
    return ix >= l->x[0] && ix <= l->x[1] && iz >= l->z[0] && iz <= l->z[1];
}

/* A point coarser than the map was merged out of finer ones far from the groove, or lies where nothing has happened.
 * Merged ones keep the volume of those, not their places, and leave slits that are as wide and as high as they. */
static bool is_coarse(const crater_points *p, size_t i, double cell)
{
    const double *half = p->size + 3 * i;
    return fmin(half[0], fmin(half[1], half[2])) > 0.5 * cell;
}

/* How far to the sides a point may close a slit, in half lengths. */
static double width_of(const crater_points *p, size_t i, double cell)
{
    return is_coarse(p, i, cell) ? 2.0 : 1.0;
}

static bool is_finite_point(const crater_points *p, size_t i)
{
    double sum = 0.0;
    for (size_t k = 3 * i; k < 3 * i + 3; k++) sum += p->position[k] + p->size[k];
    return isfinite(sum);
}

/* The points that meet any line, lowest first; *layers is malloc'ed. */
static status sort_points(const crater_points *p, const sampling *s, double cell, layer **layers, size_t *count)
{
    layer *list = malloc((p->n ? p->n : 1) * sizeof *list);
    CHECK(list, STATUS_MEMORY, "crater: no memory to sort %zu material points", p->n);
    size_t n = 0, i = 0;
    for (; i < p->n && is_finite_point(p, i); i++) {
        const lines met = footprint(p, i, s, width_of(p, i, cell));
        const double bottom = p->position[3 * i + 1] - p->size[3 * i + 1];
        if (met.x[0] > met.x[1] || met.z[0] > met.z[1]) continue;
        list[n++] = (layer){ bottom, i };
    }
    if (i < p->n) free(list);
    CHECK(i == p->n, STATUS_NUMERICAL, "crater: material point %zu of the rail has no finite position or size", i);
    qsort(list, n, sizeof *list, by_bottom);
    *layers = list;
    *count = n;
    return status_ok();
}

/* How far up and down a point's metal may be: its half length, but of a coarse one the largest of the three. */
static double reach_of(const crater_points *p, size_t i, double cell)
{
    const double *half = p->size + 3 * i;
    return is_coarse(p, i, cell) ? fmax(half[0], fmax(half[1], half[2])) : half[1];
}

/* One point, the next from below, on a line or beside it. */
static void pile_up(sample *l, double bottom, double point_half, double point_reach, bool failed, bool beside)
{
    const double top = bottom + 2.0 * point_half;
    if (l->reach < 0.0) { /* the floor of the line: stands even where all above has failed */
        if (beside) return;
        *l = (sample){ bottom, bottom, point_reach };
    }
    if (failed || bottom - l->sound > GAP * (l->reach + point_reach)) return;
    if (!beside) l->top = fmax(l->top, top);
    if (top > l->sound) l->sound = top, l->reach = point_reach;
}

static sample *line_of(const sampling *s, int ix, int iz)
{
    return &s->line[(size_t)ix * (size_t)s->nz + (size_t)iz];
}

/* Lines whose lowest point lies in the upper half of the model are outside the rail and stay empty. */
static status pile_points(const crater_points *p, const crater_spec *spec, sampling *s)
{
    layer *list = NULL;
    size_t n = 0;
    TRY(sort_points(p, s, spec->cell, &list, &n));
    const double floor_limit = n ? spec->surface - 0.5 * (spec->surface - list[0].bottom) : 0.0;
    for (size_t k = 0; k < n; k++) {
        const size_t i = list[k].point;
        const double reach = reach_of(p, i, spec->cell);
        const lines own = footprint(p, i, s, 1.0), wide = footprint(p, i, s, width_of(p, i, spec->cell));
        for (int ix = wide.x[0]; ix <= wide.x[1]; ix++)
            for (int iz = wide.z[0]; iz <= wide.z[1]; iz++) {
                sample *line = line_of(s, ix, iz);
                if (line->reach < 0.0 && list[k].bottom > floor_limit) continue;
                pile_up(line, list[k].bottom, p->size[3 * i + 1], reach, !(p->damage[i] < 1.0), !is_met(&own, ix, iz));
            }
    }
    const bool any = n && list[0].bottom < spec->surface;
    free(list);
    CHECK(any, STATUS_BAD_INPUT, "crater: no material point of the rail below y = %g m in the region to map",
          spec->surface);
    return status_ok();
}

/* Top of a neighbouring line; none where there is none, or no point on it. */
static double top_at(const sampling *s, int ix, int iz, bool mirrored, double none)
{
    const int kz = mirrored && iz < 0 ? 0 : iz;
    if (ix < 0 || ix >= s->nx || kz < 0 || kz >= s->nz) return none;
    const sample *line = line_of(s, ix, kz);
    return line->reach < 0.0 ? none : line->top;
}

/* Height of a line, but no higher than the highest of its eight neighbours, and no lower than both along an axis (those
 * there are, itself at a mirror): what is one line wide is a splinter, or a slit between points. */
static double without_spike(const sampling *s, int ix, int iz, bool mirrored)
{
    double lowest = -INFINITY, highest = -INFINITY;
    for (int jx = -1; jx <= 1; jx++)
        for (int jz = -1; jz <= 1; jz++)
            if (jx || jz) highest = fmax(highest, top_at(s, ix + jx, iz + jz, mirrored, -INFINITY));
    for (int k = 0; k < 2; k++) {
        double lower = INFINITY;
        for (int side = -1; side <= 1; side += 2)
            lower = fmin(lower, top_at(s, ix + (k ? 0 : side), iz + (k ? side : 0), mirrored, INFINITY));
        if (isfinite(lower)) lowest = fmax(lowest, lower);
    }
    const double top = line_of(s, ix, iz)->top;
    return isfinite(highest) ? fmin(fmax(top, lowest), highest) : top;
}

static double cell_depth(const sampling *s, int i, int j, const crater_spec *spec)
{
    double sum = 0.0;
    int n = 0;
    for (int ix = SAMPLES * i; ix < SAMPLES * (i + 1); ix++)
        for (int iz = SAMPLES * j; iz < SAMPLES * (j + 1); iz++) {
            if (line_of(s, ix, iz)->reach < 0.0) continue;
            sum += spec->surface - without_spike(s, ix, iz, spec->mirrored);
            n++;
        }
    return n ? sum / n : 0.0;
}

static void fill_map(const sampling *s, const crater_spec *spec, crater *c)
{
    const int nz = s->nz / SAMPLES;
    for (int i = 0; i < c->nx; i++)
        for (int j = 0; j < nz; j++) {
            const double d = cell_depth(s, i, j, spec);
            double *row = c->depth_map + (size_t)i * (size_t)c->nz;
            row[spec->mirrored ? nz + j : j] = d;
            if (spec->mirrored) row[nz - 1 - j] = d;
        }
}

status gouge_crater_map(const crater_points *p, const crater_spec *spec, crater *c)
{
    const double z_lo = spec->mirrored ? 0.0 : -spec->z_hi;
    const double wide_x = ceil((spec->x_hi - spec->x_lo) / spec->cell * (1.0 - 1e-9));
    const double wide_z = ceil((spec->z_hi - z_lo) / spec->cell * (1.0 - 1e-9));
    CHECK(wide_x * wide_z <= MAP_LIMIT, STATUS_BAD_INPUT, "crater: a map of %g x %g cells is too large, cell = %g m",
          wide_x, wide_z, spec->cell);
    const int nz = (int)wide_z;
    c->nx = (int)wide_x;
    c->nz = spec->mirrored ? 2 * nz : nz;
    c->dx = (spec->x_hi - spec->x_lo) / wide_x;
    c->dz = (spec->z_hi - z_lo) / wide_z;
    c->x0 = spec->x_lo + 0.5 * c->dx;
    c->z0 = -spec->z_hi + 0.5 * c->dz;
    sampling s = {
        .nx = SAMPLES * c->nx, .nz = SAMPLES * nz, .x_axis = { spec->x_lo, c->dx }, .z_axis = { z_lo, c->dz }
    };
    const size_t count = (size_t)s.nx * (size_t)s.nz;
    s.line = malloc(count * sizeof *s.line);
    c->depth_map = malloc((size_t)c->nx * (size_t)c->nz * sizeof *c->depth_map);
    status done = status_ok();
    if (!s.line || !c->depth_map)
        done = base_status_error(STATUS_MEMORY, "crater: no memory for a map of %d x %d cells", c->nx, c->nz);
    for (size_t k = 0; done.code == STATUS_OK && k < count; k++) s.line[k].reach = -1.0;
    if (done.code == STATUS_OK) done = pile_points(p, spec, &s);
    if (done.code == STATUS_OK) fill_map(&s, spec, c);
    free(s.line);
    return done;
}
