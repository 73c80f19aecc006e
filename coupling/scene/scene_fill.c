/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_fill.h"

#include "coupling/host/numbers.h"
#include "coupling/scene/scene_window.h"

#include <math.h>

static const double CELLS_ACROSS = 20.0;                 /* of the smallest extent of any body */
static const double COARSE = 4.0, COARSE_BY_RULES = 8.0; /* largest cells over the fine ones */
static const double GROWTH = 1.2;
static const double MARGIN = 0.25; /* of the bodies' box, beyond them where the window ends freely */
static const double ROOM = 4.0;    /* and at least so many coarse cells */
static const double AROUND = 0.5;  /* of the smallest body, on either side of it, in fine cells too */

typedef struct {
    double lo[3], hi[3];
} box;

static box box_of(const mpm_scene *s, int body)
{
    box b;
    mpm_solid_bounds(&s->solid[s->body[body].solid], b.lo, b.hi);
    return b;
}

static double extent(const box *b)
{
    return fmin(b->hi[0] - b->lo[0], fmin(b->hi[1] - b->lo[1], b->hi[2] - b->lo[2]));
}

static double volume(const box *b)
{
    return (b->hi[0] - b->lo[0]) * (b->hi[1] - b->lo[1]) * (b->hi[2] - b->lo[2]);
}

/* Parts without anything in common have no box. */
static status check_box(const mpm_scene *s, int body)
{
    const box b = box_of(s, body);
    for (int k = 0; k < 3; k++)
        CHECK(b.hi[k] > b.lo[k], STATUS_BAD_INPUT, "scene.bodies[%d].shape: %s is empty, by its extent along %s", body,
              s->body[body].name, mpm_axis_names[k]);
    return status_ok();
}

/* What the bodies say of the window. */
typedef struct {
    box all, smallest;
    double extent; /* least of any body [m] */
} survey;

static survey look(const mpm_scene *s)
{
    survey r = { .all = box_of(s, 0), .smallest = box_of(s, 0) };
    box *all = &r.all;
    r.extent = extent(all);
    for (int i = 1; i < s->bodies; i++) {
        const box b = box_of(s, i);
        r.extent = fmin(r.extent, extent(&b));
        if (volume(&b) < volume(&r.smallest)) r.smallest = b;
        for (int k = 0; k < 3; k++) {
            all->lo[k] = fmin(all->lo[k], b.lo[k]);
            all->hi[k] = fmax(all->hi[k], b.hi[k]);
        }
    }
    return r;
}

static double margin_at(const mpm_axis *a, int end, double length)
{
    return a->boundary[end] == MPM_BOUNDARY_FREE ? fmax(MARGIN * length, ROOM * a->coarse) : 0.0;
}

/* Whole cells, in multiples of what the levels want; an end that comes near the window's is laid to it. */
static void lay_zone(mpm_axis *a, int levels)
{
    const double step = a->fine * (1 << (levels - 1)), room = levels > 1 ? step : a->coarse;
    a->fine_lo = fmax(a->fine_lo, a->lo), a->fine_hi = fmin(a->fine_hi, a->hi);
    if (a->fine_lo - a->lo < room) a->fine_lo = a->lo;
    const double cells = fmax(ceil((a->fine_hi - a->fine_lo) / step * (1.0 - 1e-9)), 2.0);
    a->fine_hi = a->fine_lo + cells * step;
    if (a->hi - a->fine_hi < room) a->fine_hi = a->hi;
}

static void fill_cells(const survey *bodies, bool rules, mpm_axis *a)
{
    a->fine = host_number_or(a->fine, bodies->extent / CELLS_ACROSS);
    a->coarse = host_number_or(a->coarse, (rules ? COARSE_BY_RULES : COARSE) * a->fine);
    a->growth = host_number_or(a->growth, GROWTH);
}

/* An end of the window that holds this place too; NAN: its own is enough. */
static double further(const mpm_axis *a, int end, double own, double at)
{
    if (a->boundary[end] != MPM_BOUNDARY_FREE) return own;
    return end ? fmax(own, at + a->coarse) : fmin(own, at - a->coarse);
}

static void fill_axis(const survey *bodies, const scene_room *also, int k, int levels, mpm_axis *a)
{
    const box *all = &bodies->all, *smallest = &bodies->smallest;
    const double length = all->hi[k] - all->lo[k], around = AROUND * (smallest->hi[k] - smallest->lo[k]);
    a->lo = host_number_or(a->lo, further(a, 0, all->lo[k] - margin_at(a, 0, length), also->lo[k]));
    a->hi = host_number_or(a->hi, further(a, 1, all->hi[k] + margin_at(a, 1, length), also->hi[k]));
    const bool given = !isnan(a->fine_lo) && !isnan(a->fine_hi);
    a->fine_lo = host_number_or(a->fine_lo, fmin(smallest->lo[k] - around, also->fine_lo[k]));
    a->fine_hi = host_number_or(a->fine_hi, fmax(smallest->hi[k] + around, also->fine_hi[k]));
    if (!given || a->fine_lo < a->lo || a->fine_hi > a->hi) lay_zone(a, levels);
}

const scene_room scene_no_room = {
    .lo = { NAN, NAN, NAN }, .hi = { NAN, NAN, NAN }, .fine_lo = { NAN, NAN, NAN }, .fine_hi = { NAN, NAN, NAN }
};

status scene_fill(mpm_scene *s)
{
    return scene_fill_with(s, &scene_no_room);
}

status scene_fill_with(mpm_scene *s, const scene_room *also)
{
    CHECK(s->bodies > 0, STATUS_BAD_INPUT, "scene.bodies: there are none");
    for (int i = 0; i < s->bodies; i++) TRY(check_box(s, i));
    const survey bodies = look(s);
    for (int k = 0; k < 3; k++) fill_cells(&bodies, s->refines > 0, &s->axis[k]);
    mpm_scene_levels_fill(s);
    for (int k = 0; k < 3; k++) fill_axis(&bodies, also, k, s->levels, &s->axis[k]);
    return scene_window_check(s);
}
