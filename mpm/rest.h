/* SPDX-License-Identifier: BSD-3-Clause */
/* A slice of a linear elastic solid at rest, in plane strain: the solver's grid, without its time steps.
 *
 *        held   face: free, forces at its nodes   held            x ->
 *         |  +---+---+---+---+---+---+---+---+  |                 z v
 *         |  |   |   |   |   |   |   |   |   |  |
 *         |  +---+---+---+---+---+---+---+---+  |
 *         +------------ held -------------------+
 *
 * Cells are squares with 2 x 2 points each, whose domains are a quarter of the cell: the solver's points at the start
 * of a scene.  Such a domain crosses no cell face, so the weights of GIMP give the slope of bilinear functions at the
 * point, and the stiffness of a cell is
 *   K = sum over its points of  B^T C B (cell / 2)^2 per metre of slice,   strain = B u                          (L-5)
 * Equilibrium  sum K u = forces  is solved by conjugate gradients, cell by cell, without a matrix of the whole.  The
 * preconditioner is one V-cycle of multigrid with Chebyshev smoothing over Jacobi's; coarser grids have the stiffness
 * of the intact solid, which in two dimensions is the same for squares of any size.
 * Every sum has a fixed order: the same bits on any number of threads. */
#ifndef BREECH_MPM_REST_H
#define BREECH_MPM_REST_H

#include "base/status.h"

/* Stress of strain (xx, zz, gamma): a symmetric matrix [Pa]. */
typedef struct {
    double xx, zz, shear;             /* its diagonal */
    double xx_zz, xx_shear, zz_shear; /* beside it */
} rest_elastic;
rest_elastic mpm_rest_isotropic(double youngs, double poisson);

typedef struct mpm_rest mpm_rest; /* owns its vectors */

/* nx cells along the face, nz into the depth, all of this solid.  Many factors of two make it fast. */
status mpm_rest_create(int nx, int nz, double cell, const rest_elastic *solid, int threads, mpm_rest **out);
void mpm_rest_free(mpm_rest *r); /* NULL allowed */

/* Displacement x, z of all nodes, node (i, j) of face 0 .. nz at 2 (j (nx + 1) + i): to be filled with the held values
 * and, elsewhere, with where the solution is looked for first.  Borrowed [m]. */
double *mpm_rest_displacement(mpm_rest *r);
/* Forces x, z on the nx + 1 nodes of the face, on a metre of slice [N/m].  Borrowed, zero at first. */
double *mpm_rest_forces(mpm_rest *r);

/* Another solid in cell (i, j). */
status mpm_rest_change(mpm_rest *r, int i, int j, const rest_elastic *solid);

/* Until the residual is this part of what the intact solid's forces are; *iterations counts on.  STATUS_NUMERICAL: not
 * within `most`. */
status mpm_rest_solve(mpm_rest *r, double tolerance, int most, int *iterations);

/* Mean strain of a cell: xx, zz, gamma. */
void mpm_rest_strain(const mpm_rest *r, int i, int j, double strain[3]);
/* Strain xx of the face over cell i. */
double mpm_rest_face_strain(const mpm_rest *r, int i);

#endif
