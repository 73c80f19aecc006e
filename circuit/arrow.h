/* SPDX-License-Identifier: BSD-3-Clause */
/* Bordered block-diagonal matrix, the shape of a circuit of many branches on a few common nodes (internal to circuit/).
 * The border begins with `sums` rows on which nothing else depends: their columns are zero but for the diagonal.
 *
 *   [ D_1            b_1 ]     D_k  size[k] square, at most ARROW_BLOCK
 *   [      D_2       b_2 ]     b_k  one column of the border, number column[k]; all others are zero
 *   [           ...      ]     C_k  border rows of the block's columns
 *   [ C_1  C_2  ...   E  ]     E    border square
 *
 * Factored by eliminating the blocks (Schur complement of the border): work grows as blocks x border, not as its cube.
 */
#ifndef BREECH_CIRCUIT_ARROW_H
#define BREECH_CIRCUIT_ARROW_H

#include "base/status.h"

#include <stdbool.h>

enum { ARROW_BLOCK = 4 };

typedef struct {
    int blocks, border, sums;
    int *size;   /* of the blocks; to be filled before use */
    int *column; /* of the border, that block k couples to */
    bool *idle;  /* block k is coupled to nothing: its C_k and b_k count as zero */
    double *D;   /* block k, row i, column j: D[(k * ARROW_BLOCK + i) * ARROW_BLOCK + j] */
    double *b;   /* block k, row i: b[k * ARROW_BLOCK + i] */
    double *C;   /* block k, its column j, border row r: C[(k * ARROW_BLOCK + j) * border + r] */
    double *E;   /* row i, column j: E[i * border + j] */
    double *X;   /* D_k^-1 b_k, after circuit_arrow_factor */
    int *pivot, *block_pivot;
} arrow;

status circuit_arrow_create(int blocks, int border, int sums, arrow **out); /* caller frees with circuit_arrow_free */
void circuit_arrow_free(arrow *a);                                          /* NULL allowed */
void circuit_arrow_clear(arrow *a);                                         /* all entries zero, no block idle */

double *circuit_arrow_block(const arrow *a, int k);         /* D_k */
double *circuit_arrow_column(const arrow *a, int k, int j); /* column j of C_k */

/* In place.  0, or 1 + the row of the first zero pivot. */
int circuit_arrow_factor(arrow *a);
/* x: right-hand side in, solution out; after circuit_arrow_factor. */
void circuit_arrow_solve(const arrow *a, double *x);

/* Dense LU with partial pivoting of an n x n matrix of row stride `stride`; the border's, and of use elsewhere. */
int circuit_lu_factor(double *A, int n, int stride, int *pivot);
void circuit_lu_solve(const double *A, int n, int stride, const int *pivot, double *x);

#endif
