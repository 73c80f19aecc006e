/* SPDX-License-Identifier: BSD-3-Clause */
/* Parallel filaments of quadrangular section, in the solved half of one rail (circuit/rails/section.h).  The vector
 * potential of filament j and its images at i, averaged over both sections, is
 *   A_i = - mu0/(2 pi) sum_j sum_images +-I_j <ln r_ij>                                              (C-8) [Wb/m]
 * The mesh is a grid of nx columns from face to back and ny rows from the edge (y = h/2) to the middle: cell i ny + j.
 * Cells are finest at the surface and grow inwards by a constant ratio. */
#ifndef BREECH_CIRCUIT_FILAMENTS_H
#define BREECH_CIRCUIT_FILAMENTS_H

#include "circuit/rails/section.h"

typedef struct {
    circuit_section_point corner[4]; /* anticlockwise; may coincide */
    circuit_section_point centre;
    circuit_section_point axis[2]; /* centre +- axis[0] +- axis[1] have the quadrangle's mean and second moments */
    double area, reach;            /* [m^2]; greatest distance of a corner from the centre [m] */
} filament;

typedef struct {
    int n, nx, ny;
    filament *cell;
    double *R; /* of each, times circuit_section_weight [ohm/m] */
} filaments;

/* First cells of depth/fineness or a side/(4 fineness), growing by 1 + 1.5/fineness.  depth [m], fineness >= 1. */
status circuit_filaments_create(const circuit_rail_section *s, double depth, double fineness, filaments *out);
void circuit_filaments_free(filaments *f);

/* n x n inductances, images and circuit_section_weight included [H/m]; the caller frees *L. */
status circuit_filaments_inductance(const circuit_rail_section *s, const filaments *f, double **L);

/* Cell sizes over `length`, growing from `first` by `growth` at most away from one end, or from both (ends = 2).
 * Returns their number; `size` must hold them. */
int circuit_filaments_graded(double length, double first, double growth, int ends, double *size);

#endif
