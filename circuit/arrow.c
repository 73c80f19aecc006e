/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/arrow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int circuit_lu_factor(double *A, int n, int stride, int *pivot)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++) {
            if (fabs(A[i * stride + k]) > fabs(A[best * stride + k])) best = i;
        }
        pivot[k] = best;
        if (!(fabs(A[best * stride + k]) > 0.0)) return k + 1; /* zero, or not a number */
        for (int j = 0; j < n && best != k; j++) {
            const double swap = A[k * stride + j];
            A[k * stride + j] = A[best * stride + j];
            A[best * stride + j] = swap;
        }
        const double inverse = 1.0 / A[k * stride + k];
        for (int i = k + 1; i < n; i++) {
            const double f = A[i * stride + k] *= inverse;
            if (f == 0.0) continue;
            for (int j = k + 1; j < n; j++) A[i * stride + j] -= f * A[k * stride + j];
        }
    }
    return 0;
}

void circuit_lu_solve(const double *A, int n, int stride, const int *pivot, double *x)
{
    for (int k = 0; k < n; k++) {
        const double swap = x[pivot[k]];
        x[pivot[k]] = x[k];
        x[k] = swap;
    }
    for (int i = 1; i < n; i++) {
        for (int j = 0; j < i; j++) x[i] -= A[i * stride + j] * x[j];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) x[i] -= A[i * stride + j] * x[j];
        x[i] /= A[i * stride + i];
    }
}

status circuit_arrow_create(int blocks, int border, int sums, arrow **out)
{
    const size_t n = (size_t)blocks * ARROW_BLOCK, m = (size_t)border;
    arrow *a = calloc(1, sizeof *a);
    *out = a;
    CHECK(a, STATUS_MEMORY, "out of memory for the circuit's matrix");
    a->blocks = blocks;
    a->border = border;
    a->sums = sums;
    a->size = calloc(n + 1, sizeof *a->size);
    a->column = calloc(n + 1, sizeof *a->column);
    a->idle = calloc(n + 1, sizeof *a->idle);
    a->D = calloc(n * ARROW_BLOCK + 1, sizeof *a->D);
    a->b = calloc(n + 1, sizeof *a->b);
    a->X = calloc(n + 1, sizeof *a->X);
    a->C = calloc(n * m + 1, sizeof *a->C);
    a->E = calloc(m * m + 1, sizeof *a->E);
    a->pivot = calloc(m + 1, sizeof *a->pivot);
    a->block_pivot = calloc(n + 1, sizeof *a->block_pivot);
    if (a->size && a->column && a->idle && a->D && a->b && a->X && a->C && a->E && a->pivot && a->block_pivot)
        return status_ok();
    circuit_arrow_free(a);
    *out = NULL;
    return base_status_error(STATUS_MEMORY, "out of memory for a circuit of %d groups", blocks);
}

void circuit_arrow_free(arrow *a)
{
    if (!a) return;
    free(a->size);
    free(a->column);
    free(a->idle);
    free(a->D);
    free(a->b);
    free(a->X);
    free(a->C);
    free(a->E);
    free(a->pivot);
    free(a->block_pivot);
    free(a);
}

void circuit_arrow_clear(arrow *a)
{
    const size_t n = (size_t)a->blocks * ARROW_BLOCK, m = (size_t)a->border;
    memset(a->D, 0, n * ARROW_BLOCK * sizeof *a->D);
    memset(a->b, 0, n * sizeof *a->b);
    memset(a->C, 0, n * m * sizeof *a->C);
    memset(a->E, 0, m * m * sizeof *a->E);
    memset(a->idle, 0, (size_t)a->blocks * sizeof *a->idle);
}

double *circuit_arrow_block(const arrow *a, int k)
{
    return a->D + (size_t)k * ARROW_BLOCK * ARROW_BLOCK;
}

double *circuit_arrow_column(const arrow *a, int k, int j)
{
    return a->C + ((size_t)k * ARROW_BLOCK + (size_t)j) * (size_t)a->border;
}

/* E without the sums. */
static double *arrow_core(const arrow *a)
{
    return a->E + a->sums * (a->border + 1);
}

int circuit_arrow_factor(arrow *a)
{
    int row = 0;
    for (int k = 0; k < a->blocks; row += a->size[k++]) {
        const int n = a->size[k];
        double *X = a->X + k * ARROW_BLOCK;
        const int bad = circuit_lu_factor(circuit_arrow_block(a, k), n, ARROW_BLOCK, a->block_pivot + k * ARROW_BLOCK);
        if (bad) return row + bad;
        if (a->idle[k]) continue;
        memcpy(X, a->b + k * ARROW_BLOCK, sizeof(double) * ARROW_BLOCK);
        circuit_lu_solve(circuit_arrow_block(a, k), n, ARROW_BLOCK, a->block_pivot + k * ARROW_BLOCK, X);
        for (int j = 0; j < n; j++) {
            const double *C = circuit_arrow_column(a, k, j);
            for (int r = 0; r < a->border; r++) a->E[r * a->border + a->column[k]] -= C[r] * X[j];
        }
    }
    for (int r = 0; r < a->sums; r++) {
        if (!(fabs(a->E[r * a->border + r]) > 0.0)) return row + r + 1;
    }
    const int bad = circuit_lu_factor(arrow_core(a), a->border - a->sums, a->border, a->pivot);
    return bad ? row + a->sums + bad : 0;
}

void circuit_arrow_solve(const arrow *a, double *x)
{
    double *z = x;
    for (int k = 0; k < a->blocks; k++) z += a->size[k];
    double *y = x;
    for (int k = 0; k < a->blocks; y += a->size[k++]) {
        circuit_lu_solve(circuit_arrow_block(a, k), a->size[k], ARROW_BLOCK, a->block_pivot + k * ARROW_BLOCK, y);
        for (int j = 0; j < a->size[k] && !a->idle[k]; j++) {
            const double *C = circuit_arrow_column(a, k, j);
            for (int r = 0; r < a->border; r++) z[r] -= C[r] * y[j];
        }
    }
    circuit_lu_solve(arrow_core(a), a->border - a->sums, a->border, a->pivot, z + a->sums);
    for (int r = 0; r < a->sums; r++) {
        const double *E = a->E + r * a->border;
        for (int j = a->sums; j < a->border; j++) z[r] -= E[j] * z[j];
        z[r] /= E[r];
    }
    y = x;
    for (int k = 0; k < a->blocks; y += a->size[k++]) {
        for (int j = 0; j < a->size[k] && !a->idle[k]; j++) y[j] -= a->X[k * ARROW_BLOCK + j] * z[a->column[k]];
    }
}
