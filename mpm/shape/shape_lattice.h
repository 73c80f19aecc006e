/* SPDX-License-Identifier: BSD-3-Clause */
/* Lattices of struts: what their shapes have in common.
 *
 * Round struts with round ends, the same in every cubic cell, cut off at a box.  Cells are counted from the box's lower
 * corner.  All nets are mirror symmetric about the faces and the middles of their cells, so that a point may be folded
 * into one octant of a cell by mirrors and measured against the struts there: no strut elsewhere is nearer.
 *
 *      corner +---------+ face's middle        places in an octant are in cells: 0 0 0 the cell's corner,
 *             |  octant |                      0.5 0.5 0.5 its middle
 *             |         |
 *             +---------+ edge's middle
 *
 * To add one: shape_lattice_<name>.c with its struts in the octant 0 .. 0.5 and LATTICE, one line in shape.def. */
#ifndef BREECH_MPM_SHAPE_LATTICE_H
#define BREECH_MPM_SHAPE_LATTICE_H

#include "mpm/shape/shape.h"

/* A strut in an octant, from middle to middle of its ends [cells]. */
typedef struct {
    double from[3], to[3];
} lattice_strut;

extern const base_param mpm_shape_lattice_params[];
double mpm_shape_lattice_inside(const mpm_solid *s, const double x[3], const lattice_strut *strut, int struts);
void mpm_shape_lattice_bounds(const mpm_solid *s, double lo[3], double hi[3]);
status mpm_shape_lattice_check(const mpm_solid *s, const char *name);

/* The kind `lattice_<net>` of the array `struts`. */
#define LATTICE(net, text)                                                                      \
    static double inside(const mpm_solid *s, const double x[3])                                 \
    {                                                                                           \
        return mpm_shape_lattice_inside(s, x, struts, (int)(sizeof struts / sizeof struts[0])); \
    }                                                                                           \
    const mpm_solid_kind mpm_shape_lattice_##net = { .name = "lattice_" #net,                   \
                                                     .doc = (text),                             \
                                                     .params = mpm_shape_lattice_params,        \
                                                     .inside = inside,                          \
                                                     .bounds = mpm_shape_lattice_bounds,        \
                                                     .check = mpm_shape_lattice_check }

#endif
