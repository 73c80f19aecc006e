/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/grid/axis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NODES = 20000 };

/* Of a cell: the longest domain of a point in it that is not split.  In the fine zone a stretched point is halved
 * before it spans its cell; outside it may: one or two points a cell and axis, so that eight lanes of a block hold a
 * cell. */
static const double LONGEST_FINE = 0.8, LONGEST_COARSE = 1.0;

static const double LEAST = 0.7; /* the shortest element between a shifted zone and the window's end, of its cells */

/* Spacings from the fine zone outwards until they cover `length`, then scaled to end on it.  Returns their number. */
static int grade(const mpm_axis *s, double length, double *spacing)
{
    if (length < 1e-9 * s->fine) return 0;
    double sum = 0, h = s->fine;
    int n = 0;
    while (sum < length * (1 - 1e-9) && n < MAX_NODES) {
        h = fmin(h * s->growth, fmax(s->coarse, s->fine));
        spacing[n++] = h;
        sum += h;
    }
    for (int i = 0; i < n; i++) spacing[i] *= length / sum;
    return n;
}

static status check(const mpm_axis *s, char letter)
{
    CHECK(s->hi > s->lo, STATUS_BAD_INPUT, "window along %c: hi = %g m must lie above lo = %g m", letter, s->hi, s->lo);
    CHECK(s->fine > 0 && s->coarse >= s->fine, STATUS_BAD_INPUT,
          "cells along %c: fine = %g m must be positive and at most coarse = %g m", letter, s->fine, s->coarse);
    CHECK(s->fine_lo >= s->lo - 1e-12 && s->fine_hi <= s->hi + 1e-12 && s->fine_hi > s->fine_lo, STATUS_BAD_INPUT,
          "fine zone along %c: %g .. %g m must lie inside the window %g .. %g m", letter, s->fine_lo, s->fine_hi, s->lo,
          s->hi);
    CHECK(s->growth >= 1 && s->growth <= 2, STATUS_BAD_INPUT, "growth along %c = %g: must be 1 .. 2", letter,
          s->growth);
    CHECK((s->hi - s->lo) / s->fine < MAX_NODES, STATUS_BAD_INPUT,
          "cells along %c: %g m is too fine for %g m of window", letter, s->fine, s->hi - s->lo);
    return status_ok();
}

static status allocate(axis *a)
{
    a->bricks = (a->last + 2 + 3) / 4;
    a->node = calloc((size_t)(4 * a->bricks), sizeof(double));
    a->edge = calloc((size_t)(4 * a->bricks + 1), sizeof(double));
    a->longest = calloc((size_t)(4 * a->bricks), sizeof(double));
    CHECK(a->node && a->edge && a->longest, STATUS_MEMORY, "no memory for a grid axis of %d nodes", a->last);
    return status_ok();
}

static void place_nodes(axis *a, const mpm_axis *s, const double *below, int n_below, int n_fine)
{
    const double fine = (s->fine_hi - s->fine_lo) / n_fine;
    a->node[1] = s->lo;
    for (int i = 0; i < n_below; i++) a->node[2 + i] = a->node[1 + i] + below[n_below - 1 - i];
    for (int i = 0; i <= n_fine; i++) a->node[1 + n_below + i] = s->fine_lo + i * fine;
}

/* From the nodes up to the last: those beyond it, edges, smallest spacing. */
static void finish(axis *a)
{
    a->node[0] = 2 * a->node[1] - a->node[2];
    for (int i = a->last + 1; i < 4 * a->bricks; i++) a->node[i] = 2 * a->node[i - 1] - a->node[i - 2];
    a->smallest = HUGE_VAL;
    for (int i = 1; i < 4 * a->bricks; i++) {
        a->edge[i] = 0.5 * (a->node[i - 1] + a->node[i]);
        a->smallest = fmin(a->smallest, a->node[i] - a->node[i - 1]);
    }
    a->edge[0] = 2 * a->node[0] - a->edge[1];
    a->edge[4 * a->bricks] = 2 * a->node[4 * a->bricks - 1] - a->edge[4 * a->bricks - 1];
}

/* Cells up to `fine` are those of a fine zone. */
static void set_longest(axis *a, double fine)
{
    for (int i = 0; i < 4 * a->bricks; i++) {
        const bool whole = i > 0 && i + 1 < 4 * a->bricks; /* of a cell that is cut, what it was */
        const double cell = whole ? 0.5 * (a->node[i + 1] - a->node[i - 1]) : a->edge[i + 1] - a->edge[i];
        a->longest[i] = (cell > 1.1 * fine ? LONGEST_COARSE : LONGEST_FINE) * cell;
    }
}

void mpm_axis_allow_long(axis *a)
{
    set_longest(a, 0);
}

/* As grade, of a zone that may be shifted: what lies between it and an end that it reached is one element. */
static int grade_to_end(const mpm_axis *s, bool shifted, double length, double *spacing)
{
    if (!shifted || length >= (1 + LEAST) * s->fine) return grade(s, length, spacing);
    spacing[0] = length;
    return 1;
}

static int fine_cells(const mpm_axis *s)
{
    return (int)fmax(1, round((s->fine_hi - s->fine_lo) / s->fine));
}

static status make(const mpm_axis *spec, bool shifted, axis *out)
{
    double *below = malloc(2 * MAX_NODES * sizeof *below);
    CHECK(below, STATUS_MEMORY, "no memory for a grid axis");
    double *above = below + MAX_NODES;
    const int n_below = grade_to_end(spec, shifted, spec->fine_lo - spec->lo, below);
    const int n_above = grade_to_end(spec, shifted, spec->hi - spec->fine_hi, above);
    const int n_fine = fine_cells(spec);
    out->last = 1 + n_below + n_fine + n_above;
    const status s = allocate(out);
    if (s.code == STATUS_OK) {
        place_nodes(out, spec, below, n_below, n_fine);
        for (int i = 0; i < n_above; i++) {
            const int k = 1 + n_below + n_fine + i;
            out->node[k + 1] = out->node[k] + above[i];
        }
        out->node[out->last] = spec->hi;
        finish(out);
        set_longest(out, spec->fine);
    } else {
        mpm_axis_free(out);
    }
    free(below);
    return s;
}

status mpm_axis_make(const mpm_axis *spec, char letter, axis *out)
{
    memset(out, 0, sizeof *out);
    TRY(check(spec, letter));
    return make(spec, false, out);
}

status mpm_axis_make_shifted(const mpm_axis *spec, double shift, char letter, axis *out)
{
    TRY(mpm_axis_make(spec, letter, out)); /* the errors of the case's own zone come first */
    shift -= floor(shift);                 /* whole cells move no plane */
    if (!(shift > 0)) return status_ok();
    mpm_axis_free(out);
    mpm_axis moved = *spec;
    moved.fine = (spec->fine_hi - spec->fine_lo) / fine_cells(spec);
    moved.coarse = fmax(spec->coarse, moved.fine);
    moved.fine_lo += shift * moved.fine, moved.fine_hi += shift * moved.fine;
    while (moved.fine_lo - spec->lo < LEAST * moved.fine) moved.fine_lo += moved.fine;
    while (spec->hi - moved.fine_hi < LEAST * moved.fine) moved.fine_hi -= moved.fine;
    CHECK(moved.fine_hi - moved.fine_lo > 0.5 * moved.fine, STATUS_BAD_INPUT,
          "cells along %c: %g m of window are too few of %g m for a grid that is shifted", letter, spec->hi - spec->lo,
          moved.fine);
    return make(&moved, true, out);
}

status mpm_axis_bisect(const axis *coarse, axis *out)
{
    memset(out, 0, sizeof *out);
    out->last = 2 * coarse->last - 1;
    const status s = allocate(out);
    if (s.code != STATUS_OK) {
        mpm_axis_free(out);
        return s;
    }
    for (int i = 1; i <= coarse->last; i++) out->node[2 * i - 1] = coarse->node[i];
    for (int i = 2; i < out->last; i += 2) out->node[i] = 0.5 * (out->node[i - 1] + out->node[i + 1]);
    finish(out);
    set_longest(out, HUGE_VAL);
    return s;
}

void mpm_axis_free(axis *a)
{
    free(a->node);
    free(a->edge);
    free(a->longest);
    a->node = a->edge = a->longest = NULL;
}

int mpm_axis_locate(const axis *a, double x)
{
    if (!(x >= a->edge[1])) return 0;
    if (x >= a->edge[a->last + 1]) return a->last + 1;
    int lo = 1, hi = a->last + 1; /* edge[lo] <= x < edge[hi] */
    const double cells = (x - a->edge[1]) / a->smallest;
    const int guess = cells < a->last ? lo + (int)cells : a->last; /* right where all are of one size */
    if (x >= a->edge[guess])
        lo = guess;
    else
        hi = guess;
    if (x < a->edge[lo + 1]) return lo;
    while (hi - lo > 1) {
        const int mid = (lo + hi) / 2;
        if (x >= a->edge[mid])
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

double mpm_axis_spacing(const axis *a, double x)
{
    int i = mpm_axis_locate(a, x);
    if (i < 1) i = 1;
    if (i > a->last) i = a->last;
    return x >= a->node[i] ? axis_right(a, i < a->last ? i : a->last - 1) : axis_left(a, i > 1 ? i : 2);
}

/* The weights of kernels.h for one point, but for least_domain: by how much the kernels widen a short domain depends on
 * the step and on the cells around, which are not known here. */
static void gimp_weights(const axis *a, int i, double x, double half, double w[3], double d[3])
{
    const double left = axis_left(a, i), right = axis_right(a, i), widest = 0.5 * fmin(left, right);
    const double l = fmax(fmin(half, widest), 0.05 * widest), from = x - a->node[i] - l, to = x - a->node[i] + l;
    const double below[2] = { fmin(from, 0), fmin(to, 0) }, above[2] = { fmax(from, 0), fmax(to, 0) };
    w[0] = (below[0] * below[0] - below[1] * below[1]) / (4 * l * left);
    w[2] = (above[1] * above[1] - above[0] * above[0]) / (4 * l * right);
    for (int k = 0; k < 3; k++) d[k] = a->node[i - 1 + k] - x;
}

static void bspline_weights(const axis *a, int i, double x, double w[3], double d[3])
{
    const double *e = &a->edge[i - 1], h = e[2] - e[1];
    w[0] = (e[2] - x) * (e[2] - x) / (h * (e[2] - e[0]));
    w[2] = (x - e[1]) * (x - e[1]) / (h * (e[3] - e[1]));
    for (int k = 0; k < 3; k++) d[k] = 0.5 * (e[k] + e[k + 1]) - x;
}

double mpm_axis_spread(const axis *a, double x, double half, mpm_basis_kind basis)
{
    const int at = mpm_axis_locate(a, x), i = at < 1 ? 1 : at > a->last ? a->last : at;
    double w[3], d[3];
    if (basis == MPM_BASIS_BSPLINE)
        bspline_weights(a, i, x, w, d);
    else
        gimp_weights(a, i, x, half, w, d);
    return w[0] * d[0] * d[0] + (1 - w[0] - w[2]) * d[1] * d[1] + w[2] * d[2] * d[2];
}
