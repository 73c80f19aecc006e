/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps of levels.  Cells of a level are twice as wide as those of the next finer one, and so its steps are twice as
 * long: points give to the grid at the start of their level's step and take from it at the end.  Nodes that two
 * levels share (interface.c) make the finer one's steps d, and in each have what the finer points give anew, and
 * what the coarser ones gave at the start of theirs, D: m, p, f, K.  Of that, mass and force stay; momentum and energy
 * go with the node,
 *   p <- m u,   K <- m [E - (v^2 - u^2)/2],   u = v - b,   b = d (u . grad) v,
 * v and E the node's after its step.  b: the coarser points' nodes have gone on by d v since, the finer ones' are
 * made anew at their places, and a motion that is linear in space must look the same to both.  At the end the coarser
 * points take w = v + sum b.
 *
 * Energy.  In a node's steps f does the work d/2 f . (u + v) each; what the points have booked of it, and will, is
 * D/2 f . (u_0 + w), u_0 = p/m as they gave it (what more they have booked is the smoothing of their transfer, p2g.c).
 * The difference, and that of the motion above, is owed to them alone and goes into the energies that only they read:
 *   D/2 f . (u_0 + w) - sum d/2 f . (u + v) + sum m/2 (v^2 - u^2). */
#include "mpm/memory/store.h"

#include <string.h>

uint64_t mpm_substep_due(const mpm *m, const brick *b)
{
    if (b->level <= m->ends) return ~0ull;
    if (b->level == m->ends + 1) return interface_shared(&b->interface);
    return b->level == m->ends + 2 ? b->interface.twice_finer : 0;
}

double mpm_substep_dt(const mpm *m, const brick *b, int cell)
{
    const int finer = (interface_shared(&b->interface) >> cell & 1) + (b->interface.twice_finer >> cell & 1);
    return level_dt(m, b->level - finer);
}

static double power(const double line[LINE], const double v[3])
{
    return line[4] * v[0] + line[5] * v[1] + line[6] * v[2];
}

static double square(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* ---- at the start of the points' step ---- */

static void hold_node(const mpm *m, brick *b, int cell)
{
    double *line = b->held->line[cell];
    if (!(line[0] > 0)) return;
    const double v[3] = { line[1] / line[0], line[2] / line[0], line[3] / line[0] };
    /* of D/2 f . u_0 what the node's first step does not take (nodes.c) */
    const double rest = 0.5 * (level_dt(m, b->level) - mpm_substep_dt(m, b, cell)) * power(line, v);
    line[7] -= rest;
    b->held->owed[cell] = rest;
}

static void hold(const mpm *m, brick *b)
{
    memcpy(b->held->line, b->line, sizeof b->held->line);
    if (!b->across) memset(b->held->line[BRICK_CELLS], 0, BRICK_CELLS * sizeof b->held->line[0]);
    memset(b->held->drift, 0, sizeof b->held->drift);
    memset(b->held->owed, 0, sizeof b->held->owed);
    for (uint64_t set = interface_shared(&b->interface); set; set &= set - 1) hold_node(m, b, __builtin_ctzll(set));
}

void mpm_substep_restore(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        brick *b = i >= 0 ? &m->bricks[i] : NULL;
        if (!b || !b->held) continue;
        if (b->level <= m->begins) hold(m, b);
        memcpy(b->line, b->held->line, sizeof b->held->line);
    }
}

/* ---- after a step of a node ---- */

/* b, by the motion before the forces.  Nodes of next to no mass are left out: their motion is rounding, and its square
 * would count. */
static void drift_of(const mpm *m, const brick *b, int cell, double dt, double drift[3])
{
    static const double THIN = 1e-6; /* of a full cell's mass */
    double v[3], h[3], slope[3][3];
    const double *line = b->line[cell];
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes_of(m, b)[k];
        const int n = BRICK * b->at[k] + (cell >> 2 * k) % BRICK;
        h[k] = n > 0 ? axis_left(a, n) : axis_right(a, n);
        v[k] = line[1 + k] / line[0], drift[k] = 0;
    }
    const double least = THIN * group_law(m, b->group)->rho0 * h[0] * h[1] * h[2];
    if (!(line[0] > least)) return;
    for (int k = 0; k < 3; k++) mpm_interface_slope(m, b, cell, k, least, slope[k]);
    for (int pass = 0; pass < 3; pass++) {
        const double u[3] = { v[0] - drift[0], v[1] - drift[1], v[2] - drift[2] };
        for (int i = 0; i < 3; i++) {
            drift[i] = 0;
            for (int k = 0; k < 3; k++) drift[i] += dt * u[k] * slope[k][i] / h[k];
        }
    }
}

/* Into the node's next step. */
static void keep_node(const mpm *m, brick *b, int cell)
{
    double *line = b->held->line[cell], drift[3], u[3];
    const double *v = brick_nodes(m, b)[cell], mass = line[0], dt = mpm_substep_dt(m, b, cell);
    drift_of(m, b, cell, dt, drift);
    for (int k = 0; k < 3; k++) {
        u[k] = v[k] - drift[k];
        line[1 + k] = mass * u[k];
        b->held->drift[cell][k] += drift[k];
    }
    const double slower = 0.5 * mass * (square(v) - square(u)), before = 0.5 * dt * power(line, u);
    line[7] = mass * v[3] - slower + before; /* which the node's step takes (nodes.c) */
    b->held->owed[cell] += slower - before - 0.5 * dt * power(line, v);
}

/* To the points, at the end of their step. */
static void pay_node(const mpm *m, brick *b, int cell)
{
    const double *line = b->held->line[cell];
    double *v = brick_nodes(m, b)[cell];
    const double owed = b->held->owed[cell] - 0.5 * mpm_substep_dt(m, b, cell) * power(line, v);
    for (int k = 0; k < 3; k++) v[k] += b->held->drift[cell][k];
    v[3] += (owed + 0.5 * level_dt(m, b->level) * power(line, v)) / line[0];
}

void mpm_substep_store(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        brick *b = i >= 0 ? &m->bricks[i] : NULL;
        if (!b || !b->held) continue;
        for (uint64_t set = interface_shared(&b->interface) & mpm_substep_due(m, b); set; set &= set - 1) {
            const int cell = __builtin_ctzll(set);
            if (!(b->held->line[cell][0] > 0)) continue;
            if (b->level <= m->ends)
                pay_node(m, b, cell);
            else
                keep_node(m, b, cell);
        }
    }
}
