/* SPDX-License-Identifier: BSD-3-Clause */
/* Which cells of the map are the crater, and their outline (rules in crater.h). */
#include "coupling/gouge/crater_parts.h"

#include <math.h>
#include <stdlib.h>

static const double PATCH_SHARE = 0.1; /* of the main patch's volume: a smaller patch is no part of the crater */

/* ---- what belongs to the crater ---- */

/* d > d_m; a layer of points exactly d_m thick is not above it by rounding. */
static bool is_deep(const crater *c, size_t at)
{
    return c->depth_map[at] > c->measuring_depth * (1.0 + 1e-6);
}

/* Labels the patch that holds `seed`; returns its volume above nothing [m3].  stack has room for every cell. */
static double flood(const crater *c, int *label, int mark, size_t seed, size_t *stack)
{
    double volume = 0.0;
    size_t n = 0;
    stack[n++] = seed;
    label[seed] = mark;
    while (n) {
        const size_t at = stack[--n];
        const int i = (int)(at / (size_t)c->nz), j = (int)(at % (size_t)c->nz);
        volume += c->depth_map[at] * c->dx * c->dz;
        for (int k = 0; k < 9; k++) {
            const int u = i + k / 3 - 1, v = j + k % 3 - 1;
            if (u < 0 || u >= c->nx || v < 0 || v >= c->nz) continue;
            const size_t next = (size_t)u * (size_t)c->nz + (size_t)v;
            if (label[next] || !is_deep(c, next)) continue;
            label[next] = mark;
            stack[n++] = next;
        }
    }
    return volume;
}

/* label: patch of each cell, 0 = none; volume[mark] its volume; both with room for every cell + 1.  Returns their
 * count. */
static int label_patches(const crater *c, int *label, double *volume, size_t *stack)
{
    const size_t cells = (size_t)c->nx * (size_t)c->nz;
    int patches = 0;
    for (size_t at = 0; at < cells; at++) label[at] = 0;
    for (size_t at = 0; at < cells; at++)
        if (!label[at] && is_deep(c, at)) {
            patches++;
            volume[patches] = flood(c, label, patches, at, stack);
        }
    return patches;
}

/* *mask (malloc'ed) is true where a cell is part of the crater. */
static status find_crater(const crater *c, bool **mask)
{
    const size_t cells = (size_t)c->nx * (size_t)c->nz;
    int *label = malloc(cells * sizeof *label);
    double *volume = malloc((cells + 1) * sizeof *volume);
    size_t *stack = malloc(cells * sizeof *stack);
    bool *in = malloc(cells * sizeof *in);
    const bool enough = label && volume && stack && in;
    if (enough) {
        const int patches = label_patches(c, label, volume, stack);
        double largest = 0.0;
        for (int k = 1; k <= patches; k++) largest = fmax(largest, volume[k]);
        for (size_t at = 0; at < cells; at++) in[at] = label[at] && volume[label[at]] >= PATCH_SHARE * largest;
    } else
        free(in);
    free(label);
    free(volume);
    free(stack);
    CHECK(enough, STATUS_MEMORY, "crater: no memory for a map of %d x %d cells", c->nx, c->nz);
    *mask = in;
    return status_ok();
}

/* ---- its outline ---- */

/* Share of the spacing from a cell at depth `in` > d_m towards one at `out` <= d_m at which the depth is d_m. */
static double crossing(double in, double out, double d_m)
{
    return fmin(fmax((in - d_m) / (in - fmin(out, d_m)), 0.0), 1.0);
}

static crater_section section_of(const crater *c, const bool *mask, int i)
{
    const double *depth = c->depth_map + (size_t)i * (size_t)c->nz;
    const bool *in = mask + (size_t)i * (size_t)c->nz;
    crater_section s = { .lo = 0.0, .hi = -1.0, .first = -1, .last = -1 };
    for (int j = 0; j < c->nz; j++) {
        if (!in[j]) continue;
        if (s.first < 0) s.first = j;
        s.last = j;
        s.deepest = fmax(s.deepest, depth[j]);
    }
    if (s.first < 0) return s;
    const int f = s.first, l = s.last;
    const double before = f > 0 ? crossing(depth[f], depth[f - 1], c->measuring_depth) : 0.5;
    const double after = l < c->nz - 1 ? crossing(depth[l], depth[l + 1], c->measuring_depth) : 0.5;
    s.lo = c->z0 + c->dz * (f - before);
    s.hi = c->z0 + c->dz * (l + after);
    return s;
}

/* Share of the spacing by which the crater reaches beyond its row `from` towards the row `to`. */
static double row_crossing(const crater *c, const crater_section *from, int to)
{
    if (to < 0 || to >= c->nx) return 0.5;
    double deepest = -INFINITY;
    const int first = from->first > 0 ? from->first - 1 : 0, last = from->last < c->nz - 1 ? from->last + 1 : c->nz - 1;
    for (int j = first; j <= last; j++) deepest = fmax(deepest, c->depth_map[(size_t)to * (size_t)c->nz + (size_t)j]);
    return crossing(from->deepest, deepest, c->measuring_depth);
}

static void trace(const crater *c, const bool *mask, crater_outline *o)
{
    o->first = o->last = -1;
    o->z_lo = INFINITY, o->z_hi = -INFINITY;
    for (int i = 0; i < c->nx; i++) {
        o->row[i] = section_of(c, mask, i);
        if (o->row[i].hi < o->row[i].lo) continue;
        if (o->first < 0) o->first = i;
        o->last = i;
        o->z_lo = fmin(o->z_lo, o->row[i].lo);
        o->z_hi = fmax(o->z_hi, o->row[i].hi);
    }
    if (o->first < 0) return;
    o->x_lo = c->x0 + c->dx * (o->first - row_crossing(c, &o->row[o->first], o->first - 1));
    o->x_hi = c->x0 + c->dx * (o->last + row_crossing(c, &o->row[o->last], o->last + 1));
}

status gouge_crater_trace(const crater *c, crater_outline *o)
{
    bool *mask = NULL;
    TRY(find_crater(c, &mask));
    o->row = malloc((size_t)c->nx * sizeof *o->row);
    if (o->row) trace(c, mask, o);
    free(mask);
    CHECK(o->row, STATUS_MEMORY, "crater: no memory for a map of %d rows", c->nx);
    return status_ok();
}
