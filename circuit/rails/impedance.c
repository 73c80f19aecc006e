/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/impedance.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const double SETTLED = 1e-7; /* of Z' over CHECK_EVERY terms */
enum { CHECK_EVERY = 8 };

void circuit_impedance_free(circuit_impedance *z)
{
    free(z->diagonal);
    free(z->coupling);
    free(z->conductance);
    free(z->vectors);
    *z = (circuit_impedance){ 0 };
}

static double complex fraction(const circuit_impedance *z, int m, double complex s)
{
    double complex d = 1.0 + s * z->diagonal[m - 1];
    for (int k = m - 2; k >= 0; k--) d = 1.0 + s * z->diagonal[k] - s * s * z->coupling[k] * z->coupling[k] / d;
    return z->R_dc * d;
}

double complex circuit_impedance_at(const circuit_impedance *z, double complex s)
{
    return fraction(z, z->m, s);
}

/* The same fraction over s, in the limit. */
/* L' as s -> infinity, on these filaments [H/m]. */
static double fast_inductance(const circuit_impedance *z)
{
    double d = z->diagonal[z->m - 1];
    for (int k = z->m - 2; k >= 0; k--) d = z->diagonal[k] - z->coupling[k] * z->coupling[k] / d;
    return z->R_dc * d;
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void add(int n, double factor, const double *restrict a, double *restrict to)
{
    for (int i = 0; i < n; i++) to[i] += factor * a[i];
}

static void multiply(int n, const double *restrict K, const double *x, double *restrict y)
{
    memset(y, 0, (size_t)n * sizeof *y);
    for (int j = 0; j < n; j++) add(n, x[j], K + (size_t)j * (size_t)n, y);
}

/* Twice is enough: what the first pass leaves by round-off, the second takes. */
static void orthogonalise(int n, int rows, const double *V, double *x)
{
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < rows; k++) {
            const double *v = V + (size_t)k * (size_t)n;
            add(n, -dot(n, v, x), v, x);
        }
    }
}

static bool settled(const circuit_impedance *z, int m, double complex *before)
{
    if (m % CHECK_EVERY != 0) return false;
    const double complex now = fraction(z, m, _Complex_I * z->omega_top);
    const bool same = cabs(now - *before) <= SETTLED * cabs(now);
    *before = now;
    return same;
}

/* K v_k = T_k-1,k v_k-1 + T_kk v_k + T_k,k+1 v_k+1; row n of `vectors` is spare. */
static void lanczos(circuit_impedance *z, const double *K)
{
    const int n = z->n;
    double complex before = 0.0;
    for (int i = 0; i < n; i++) z->vectors[i] = z->conductance[i] * sqrt(z->R_dc);
    for (z->m = 1;; z->m++) {
        const int k = z->m - 1;
        const double *v = z->vectors + (size_t)k * (size_t)n;
        double *next = z->vectors + (size_t)z->m * (size_t)n;
        multiply(n, K, v, next);
        z->diagonal[k] = dot(n, v, next);
        z->coupling[k] = 0.0;
        if (z->m == n || settled(z, z->m, &before)) return;
        orthogonalise(n, z->m, z->vectors, next);
        const double length = sqrt(dot(n, next, next));
        if (length <= 1e-14 * z->diagonal[0]) return; /* nothing else takes part */
        z->coupling[k] = length;
        for (int i = 0; i < n; i++) next[i] /= length;
    }
}

status circuit_impedance_create(int n, double *L, const double *R, double omega_top, circuit_impedance *out)
{
    const size_t size = (size_t)n;
    *out = (circuit_impedance){ .n = n, .omega_top = omega_top };
    out->diagonal = malloc(size * sizeof *out->diagonal);
    out->coupling = malloc(size * sizeof *out->coupling);
    out->conductance = malloc(size * sizeof *out->conductance);
    out->vectors = malloc((size + 1) * size * sizeof *out->vectors);
    CHECK(out->diagonal && out->coupling && out->conductance && out->vectors, STATUS_MEMORY,
          "out of memory for %d rail filaments", n);
    for (int i = 0; i < n; i++) out->conductance[i] = 1.0 / sqrt(R[i]);
    out->R_dc = 1.0 / dot(n, out->conductance, out->conductance);
    for (size_t i = 0; i < size; i++) {
        for (size_t j = 0; j < size; j++) L[i * size + j] *= out->conductance[i] * out->conductance[j];
    }
    lanczos(out, L);
    CHECK(isfinite(creal(circuit_impedance_at(out, omega_top))) && fast_inductance(out) > 0.0, STATUS_NUMERICAL,
          "the rail section's inductances are not positive definite: the filament mesh of %d is too fine", n);
    return status_ok();
}

/* share = R^(-1/2) V (1 + s T)^-1 e_1 Z'; the tridiagonal system by forward and backward substitution. */
status circuit_impedance_currents(const circuit_impedance *z, double complex s, double complex *share)
{
    const int m = z->m;
    double complex *d = malloc(2 * (size_t)m * sizeof *d), *y = d ? d + m : NULL;
    CHECK(d, STATUS_MEMORY, "out of memory for %d terms", m);
    d[m - 1] = 1.0 + s * z->diagonal[m - 1];
    for (int k = m - 2; k >= 0; k--)
        d[k] = 1.0 + s * z->diagonal[k] - s * s * z->coupling[k] * z->coupling[k] / d[k + 1];
    y[0] = sqrt(z->R_dc); /* 1/|b| (1 + sT)^-1 e_1 d_1: the total is then 1 */
    for (int k = 1; k < m; k++) y[k] = -s * z->coupling[k - 1] * y[k - 1] / d[k];
    for (int i = 0; i < z->n; i++) {
        share[i] = 0.0;
        for (int k = 0; k < m; k++) share[i] += y[k] * z->vectors[(size_t)k * (size_t)z->n + (size_t)i];
        share[i] *= z->conductance[i];
    }
    free(d);
    return status_ok();
}
