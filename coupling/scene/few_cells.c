/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/few_cells.h"

#include <math.h>
#include <stdio.h>

static const double ROUND = 1e-6; /* of a cell: what lengths may be off by */

/* A body's ends along an axis, as the window leaves them. */
typedef struct {
    double lo, hi; /* [m] */
    bool endless;  /* from one end of the window to the other */
} span;

static span span_of(const mpm_axis *a, double lo, double hi)
{
    const double off = ROUND * a->fine;
    const bool below = lo <= a->lo + off, above = hi >= a->hi - off;
    span s = { fmax(lo, a->lo), fmin(hi, a->hi), below && above };
    if (below && !above && a->boundary[0] == MPM_BOUNDARY_SYMMETRY) s.lo -= s.hi - a->lo;
    if (above && !below && a->boundary[1] == MPM_BOUNDARY_SYMMETRY) s.hi += a->hi - s.lo;
    return s;
}

/* Of the cells between the fine zone and the body, each is `growth` times as large as the one before. */
static double cell_at(const mpm_scene *s, const mpm_axis *a, const span *b)
{
    const double off = fmax(fmax(b->lo - a->fine_hi, a->fine_lo - b->hi), 0.0);
    const bool ruled = s->refines > 0 || s->levels > 1;
    return ruled ? a->fine : fmin(a->coarse, a->fine + off * (a->growth - 1.0) / a->growth);
}

bool scene_few_cells(const mpm_scene *s, int body, char text[400])
{
    double lo[3], hi[3], fewest = INFINITY, extent = NAN, cell = NAN;
    const char *along = "";
    bool endless = false;
    mpm_solid_bounds(&s->solid[s->body[body].solid], lo, hi);
    for (int k = 0; k < 3; k++) {
        const span b = span_of(&s->axis[k], lo[k], hi[k]);
        const double h = cell_at(s, &s->axis[k], &b);
        endless = endless || b.endless;
        if (b.endless || (b.hi - b.lo) / h >= fewest) continue;
        fewest = (b.hi - b.lo) / h, extent = b.hi - b.lo, cell = h, along = mpm_axis_names[k];
    }
    const double enough = endless ? SCENE_FEW_CELLS_OF_LAYER : SCENE_FEW_CELLS;
    if (!(fewest < enough * (1.0 - ROUND))) return false;
    snprintf(text, 400,
             "body %.60s: %.2g cells of %.3g mm across it along %s, %.3g mm: with fewer than %g the scene does not "
             "resolve what becomes of it; cells of %.3g mm would (scene.cell)",
             s->body[body].name, fewest, 1e3 * cell, along, 1e3 * extent, enough, 1e3 * extent / enough);
    return true;
}
