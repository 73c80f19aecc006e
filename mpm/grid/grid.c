#include "mpm/grid/grid.h"

#include <math.h>
#include <string.h>

/* Cells of a level between the next finer box and its own faces, or where its cells begin to grow. */
static const int PAD = 2;
static const char axis_letters[3] = { 'x', 'y', 'z' };

/* ---- boxes along one axis ---- */

typedef struct {
    double lo, hi;
} span;

/* The box of cells `cell` around the one inside it, its ends on every `pitch` of that lattice: PAD cells or more beyond
 * each end, but no further than the window. */
static span around(span inner, double cell, double pitch, double origin, const mpm_axis *s)
{
    static const double ROUND = 1e-6;
    const double below = floor((inner.lo - PAD * cell - origin) / pitch + ROUND),
                 above = ceil((inner.hi + PAD * cell - origin) / pitch - ROUND);
    double first = ceil((s->lo - origin) / pitch - ROUND), last = floor((s->hi - origin) / pitch + ROUND);
    /* no sliver of a cell at the window's end */
    const double left = first - (s->lo - origin) / pitch, right = (s->hi - origin) / pitch - last;
    if (left > ROUND && left < 0.5) first++;
    if (right > ROUND && right < 0.5) last--;
    const span r = { origin + fmax(below, first) * pitch, origin + fmin(above, last) * pitch };
    const double tiny = ROUND * cell; /* an end of the window is exact */
    return (span){ r.lo < s->lo + tiny ? s->lo : fmin(r.lo, inner.lo),
                   r.hi > s->hi - tiny ? s->hi : fmax(r.hi, inner.hi) };
}

double mpm_grids_margin(int levels, double fine)
{
    double margin = levels > 1 ? (1 << (levels - 1)) * fine : 0; /* one cell of the window's */
    for (int i = 1; i < levels - 1; i++)
        margin += (PAD + 1) * (1 << i) * fine; /* one more: ends lie on the next level's nodes */
    return margin;
}

/* Is there an end of the box between the one inside it and the window's, too near to the one inside? */
static bool is_crowded(span box, span inner, double cell, const mpm_axis *s)
{
    const double room = PAD * cell * (1 - 1e-6), end = 1e-6 * cell;
    return (box.lo > s->lo + end && inner.lo - box.lo < room) || (box.hi < s->hi - end && box.hi - inner.hi < room);
}

static int node_at(const axis *a, double x)
{
    int best = 1;
    for (int i = 2; i <= a->last; i++)
        if (fabs(a->node[i] - x) < fabs(a->node[best] - x)) best = i;
    return best;
}

/* Bisects the coarse grid along axis k over the span. */
static status add_box(grid_level *fine, const grid_level *coarse, int k, span box, const mpm_axis *s)
{
    const axis *from = &coarse->axes[k];
    fine->lo[k] = node_at(from, box.lo), fine->hi[k] = node_at(from, box.hi);
    const double off = fmax(fabs(from->node[fine->lo[k]] - box.lo), fabs(from->node[fine->hi[k]] - box.hi)) / s->fine;
    CHECK(fine->hi[k] - fine->lo[k] >= 2 && off < 0.25, STATUS_BAD_INPUT,
          "levels along %c: a fine zone from %g to %g m, cells of %g m: at least four of them, an even number, with "
          "three levels a multiple of four where it fills the window",
          axis_letters[k], s->fine_lo, s->fine_hi, s->fine);
    fine->seam[k][0] = fine->lo[k] > 1, fine->seam[k][1] = fine->hi[k] < from->last;
    return mpm_axis_bisect(from, fine->lo[k], fine->hi[k], fine->seam[k], &fine->axes[k]);
}

/* A node of all levels: an end of the window that the fine zone reaches, else zero if that fits, else the zone's lower
 * end. */
static double origin_of(const mpm_axis *s)
{
    const double pair = 2 * s->fine, tiny = 1e-6 * s->fine, off = s->fine_lo / pair;
    if (s->fine_lo <= s->lo + tiny) return s->fine_lo;
    if (s->fine_hi >= s->hi - tiny) return s->fine_hi;
    return fabs(off - round(off)) < 1e-6 ? 0 : s->fine_lo;
}

static status make_axis(const mpm_scene *s, int k, grids *g)
{
    const mpm_axis *spec = &s->axis[k];
    mpm_axis window = *spec;
    span box[MPM_MAX_LEVELS] = { { spec->fine_lo, spec->fine_hi } };
    const double origin = origin_of(spec);
    for (int i = 1; i < g->levels; i++) {
        window.fine *= 2;
        box[i] = around(box[i - 1], window.fine, (i < g->levels - 1 ? 2 : 1) * window.fine, origin, spec);
        CHECK(i == g->levels - 1 || !is_crowded(box[i], box[i - 1], window.fine, spec), STATUS_BAD_INPUT,
              "levels along %c: no room for %d levels between the fine zone, %g to %g m, and the window's ends, %g and "
              "%g m: at least %g m, or none",
              axis_letters[k], g->levels, spec->fine_lo, spec->fine_hi, spec->lo, spec->hi,
              mpm_grids_margin(g->levels, spec->fine));
    }
    window.fine_lo = box[g->levels - 1].lo, window.fine_hi = box[g->levels - 1].hi;
    window.coarse = fmax(window.coarse, window.fine);
    axis *coarsest = &g->level[g->levels - 1].axes[k];
    TRY(mpm_axis_make(&window, axis_letters[k], coarsest));
    if (g->levels > 1) mpm_axis_allow_long(coarsest);
    for (int i = g->levels - 2; i >= 0; i--) {
        TRY(add_box(&g->level[i], &g->level[i + 1], k, box[i], spec));
        if (i > 0) mpm_axis_allow_long(&g->level[i].axes[k]);
    }
    return status_ok();
}

status mpm_grids_make(const mpm_scene *s, grids *out)
{
    memset(out, 0, sizeof *out);
    CHECK(s->levels >= 1 && s->levels <= MPM_MAX_LEVELS, STATUS_BAD_INPUT, "levels = %d: must be 1 .. %d", s->levels,
          MPM_MAX_LEVELS);
    CHECK(s->levels == 1 || s->basis == BASIS_GIMP, STATUS_BAD_INPUT, "levels = %d: nested grids need the basis gimp",
          s->levels);
    out->levels = s->levels;
    status r = status_ok();
    for (int k = 0; k < 3 && r.code == STATUS_OK; k++) r = make_axis(s, k, out);
    for (int i = 0; i < out->levels && r.code == STATUS_OK; i++) {
        const axis *a = out->level[i].axes;
        out->level[i].first_site = out->sites;
        out->sites += a[0].bricks * a[1].bricks * a[2].bricks;
    }
    if (r.code != STATUS_OK) mpm_grids_free(out);
    return r;
}

void mpm_grids_free(grids *g)
{
    for (int i = 0; i < g->levels; i++)
        for (int k = 0; k < 3; k++) mpm_axis_free(&g->level[i].axes[k]);
}

int mpm_grids_level(const grids *g, const double x[3])
{
    int i = 0;
    while (i < g->levels - 1 && !grid_holds(&g->level[i], x)) i++;
    return i;
}
