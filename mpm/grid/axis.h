/* SPDX-License-Identifier: BSD-3-Clause */
/* One axis of the rectilinear grid: node positions, graded outside a fine zone.
 *
 * Node 1 lies on the window's lower end, node `last` on its upper end; nodes 0 and last + 1 are ghosts beyond them.
 * The cell of a node reaches half-way to its neighbours: a point in the cell of node i sees nodes i-1, i, i+1. */
#ifndef BREECH_MPM_AXIS_H
#define BREECH_MPM_AXIS_H

#include "mpm/scene.h"

typedef struct {
    int last;        /* index of the node on the upper end */
    int bricks;      /* bricks of 4 nodes that hold nodes 0 .. last + 1 */
    double *node;    /* [4 bricks] positions [m], owned */
    double *edge;    /* [4 bricks + 1] edge[i] .. edge[i+1] is the cell of node i [m], owned */
    double *longest; /* [4 bricks] longest domain in the cell of a node: beyond it a point is split [m], owned */
    double smallest; /* smallest spacing [m] */
} axis;

status mpm_axis_make(const mpm_axis *spec, char letter, axis *out);
/* The same with the fine zone, and so all planes but the ends, moved up by `shift` (0 .. 1) of its cells.  An end that
 * the zone reaches stays where it is; the element beside it is 0.7 to 1.7 cells wide. */
status mpm_axis_make_shifted(const mpm_axis *spec, double shift, char letter, axis *out);
/* Cells half as wide: the nodes of `coarse` and the middles between them. */
status mpm_axis_bisect(const axis *coarse, axis *out);
void mpm_axis_allow_long(axis *a); /* no zone of fine cells: a point may be as long as its cell */
void mpm_axis_free(axis *a);

/* The node whose cell holds x (1 .. last), or 0 below and last + 1 above the window's cells. */
int mpm_axis_locate(const axis *a, double x);

/* Element sizes beside node i. */
static inline double axis_left(const axis *a, int i)
{
    return a->node[i] - a->node[i - 1];
}
static inline double axis_right(const axis *a, int i)
{
    return a->node[i + 1] - a->node[i];
}

/* D = sum_i S_i(x) (x_i - x)^2 of a point whose domain has this half length [m2].  A velocity gradient L along the axis
 * holds the kinetic energy D L^2 / 2 a mass.  Of a domain that the kernels widen for stability (least_domain in
 * mpm/kernel/kernels.h) it is that of the domain as it is, which is less. */
double mpm_axis_spread(const axis *a, double x, double half, mpm_basis_kind basis);

/* Grid spacing at x [m]. */
double mpm_axis_spacing(const axis *a, double x);

#endif
