/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_window.h"

#include "coupling/scene/probe_place.h"
#include "mpm/grid/grid.h"

#include <math.h>
#include <stdio.h>

static const double ROUND = 1e-6;         /* of a cell: what lengths may be off by */
static const double MOST_CELLS = 20000.0; /* along an axis, as mpm/grid/axis.c has it */

/* The first key of a text that the file gives is where the error is shown: those at fault stand first. */
static status check_ends(const mpm_axis *a, const char *x)
{
    CHECK(a->hi > a->lo, STATUS_BAD_INPUT,
          "scene.window.%s.lo = %.4g m: must lie below the other end, scene.window.%s.hi = %.4g m", x, a->lo, x, a->hi);
    return status_ok();
}

static bool holds_a_cell(const mpm_axis *a)
{
    return a->hi - a->lo >= a->fine * (1.0 - ROUND);
}

/* Where no axis holds one, the cells are at fault. */
static status check_lengths(const mpm_scene *s)
{
    const mpm_axis *a = s->axis;
    CHECK(holds_a_cell(&a[0]) || holds_a_cell(&a[1]) || holds_a_cell(&a[2]), STATUS_BAD_INPUT,
          "scene.cell = %.4g m: the window, %.4g x %.4g x %.4g m, is shorter than a cell along each axis", a[0].fine,
          a[0].hi - a[0].lo, a[1].hi - a[1].lo, a[2].hi - a[2].lo);
    for (int k = 0; k < 3; k++) {
        const char *x = mpm_axis_names[k];
        CHECK(holds_a_cell(&a[k]), STATUS_BAD_INPUT,
              "scene.window.%s.lo = %.4g m, scene.window.%s.hi = %.4g m: the window is shorter than a cell of %.4g m: "
              "widen it, or give smaller cells: scene.window.%s.cell, of all axes scene.cell",
              x, a[k].lo, x, a[k].hi, a[k].fine, x);
    }
    return status_ok();
}

static status check_cells(const mpm_axis *a, const char *x)
{
    CHECK(
        a->coarse >= a->fine * (1.0 - ROUND), STATUS_BAD_INPUT,
        "scene.window.%s.coarse_cell, of all axes scene.coarse_cell = %.4g m: the largest cells, but the smallest are "
        "%.4g m",
        x, a->coarse, a->fine);
    CHECK((a->hi - a->lo) / a->fine < MOST_CELLS, STATUS_BAD_INPUT,
          "scene.window.%s.cell, of all axes scene.cell = %.4g m: too small for a window of %.4g m: at most %g cells",
          x, a->fine, a->hi - a->lo, MOST_CELLS);
    CHECK(a->fine_hi > a->fine_lo && a->fine_lo >= a->lo - ROUND * a->fine && a->fine_hi <= a->hi + ROUND * a->fine,
          STATUS_BAD_INPUT,
          "scene.window.%s.fine_lo = %.4g m, scene.window.%s.fine_hi = %.4g m: the zone of fine cells must lie inside "
          "the window, %.4g .. %.4g m",
          x, a->fine_lo, x, a->fine_hi, a->lo, a->hi);
    return status_ok();
}

static status check_levels(const mpm_scene *s, int k)
{
    const mpm_axis *a = &s->axis[k];
    const double largest = a->fine * (1 << (s->levels - 1));
    CHECK(s->levels == 1 || s->basis == MPM_BASIS_GIMP, STATUS_BAD_INPUT,
          "scene.levels = %d: several need scene.basis = gimp", s->levels);
    CHECK(s->levels == 1 || a->hi - a->lo >= 2.0 * largest * (1.0 - ROUND), STATUS_BAD_INPUT,
          "scene.levels = %d: the largest cells, %.4g m, must fit into the window along %s, %.4g .. %.4g m, at least "
          "twice: fewer levels, a smaller scene.coarse_cell, or a wider window",
          s->levels, largest, mpm_axis_names[k], a->lo, a->hi);
    return status_ok();
}

/* Where the window was given, a body may lie beside it. */
static status check_body(const mpm_scene *s, int i)
{
    double lo[3], hi[3];
    mpm_solid_bounds(&s->solid[s->body[i].solid], lo, hi);
    for (int k = 0; k < 3; k++)
        CHECK(hi[k] > s->axis[k].lo && lo[k] < s->axis[k].hi, STATUS_BAD_INPUT,
              "scene.bodies[%d]: %s lies at %s = %.4g .. %.4g m, out of the window, scene.window.%s = %.4g .. %.4g m: "
              "move it, or widen the window",
              i, s->body[i].name, mpm_axis_names[k], lo[k], hi[k], mpm_axis_names[k], s->axis[k].lo, s->axis[k].hi);
    return status_ok();
}

status scene_window_check(const mpm_scene *s)
{
    for (int k = 0; k < 3; k++) TRY(check_ends(&s->axis[k], mpm_axis_names[k]));
    TRY(check_lengths(s));
    for (int i = 0; i < s->bodies; i++) TRY(check_body(s, i));
    for (int k = 0; k < 3; k++) TRY(check_cells(&s->axis[k], mpm_axis_names[k]));
    for (int k = 0; k < 3; k++) TRY(check_levels(s, k));
    for (int i = 0; i < s->probes; i++) TRY(scene_probe_place_check(s, i));
    return status_ok();
}

static bool moves(const mpm_body *b)
{
    bool any = false;
    for (int k = 0; k < 3; k++) any = any || b->velocity[k] != 0.0 || b->spin[k] != 0.0;
    return any && !b->held;
}

bool scene_window_cuts(const mpm_scene *s, int body, char text[400])
{
    double lo[3], hi[3];
    const mpm_body *b = &s->body[body];
    mpm_solid_bounds(&s->solid[b->solid], lo, hi);
    for (int k = 0; moves(b) && k < 3; k++)
        for (int end = 0; end < 2; end++) {
            const mpm_axis *a = &s->axis[k];
            const double beyond = end ? hi[k] - a->hi : a->lo - lo[k];
            if (a->boundary[end] != MPM_BOUNDARY_FREE || !(beyond > ROUND * (hi[k] - lo[k]))) continue;
            snprintf(text, 400,
                     "body %.60s reaches %.3g mm beyond scene.window.%s.%s, a free end: what lies there is cut off; a "
                     "mirror needs scene.boundary.%s = symmetry",
                     b->name, 1e3 * beyond, mpm_axis_names[k], end ? "hi" : "lo", mpm_axis_names[k]);
            return true;
        }
    return false;
}

void scene_window_limit_shift(mpm_scene *s, const double own[3])
{
    for (int k = 0; k < 3; k++)
        if (!mpm_grids_hold_shift(s, k)) s->grid_shift[k] = own[k];
}
