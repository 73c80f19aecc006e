/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/ladder.h"

#include <complex.h>
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where the real frequencies lie: from 10 over the slowest mode's time (T_11 is several of them) to twice the band's
 * top. Of the pairs tried (2, 5, 10; 1/2, 1, 2) this one needs the fewest rungs for every error from 0.1 to 1e-6. */
static const double LOWEST = 10.0, HIGHEST = 2.0;

enum { MAX_BASIS = CIRCUIT_LADDER_MAX_RUNGS + 1, GRID = 96 };

/* The projection grows: an orthonormal basis U of a space of Lanczos' coordinates, first vector e_1. */
typedef struct {
    const circuit_impedance *z;
    int n;                          /* vectors */
    double *U;                      /* rows of m */
    double T[MAX_BASIS][MAX_BASIS]; /* U T U^T */
} projection;

double complex circuit_ladder_at(const circuit_ladder *l, double complex s)
{
    double complex z = l->R_dc + s * l->L_inf;
    for (int k = 0; k < l->n; k++) z += s * l->L[k] * l->R[k] / (l->R[k] + s * l->L[k]);
    return z;
}

double circuit_ladder_slow_inductance(const circuit_ladder *l)
{
    double L = l->L_inf;
    for (int k = 0; k < l->n; k++) L += l->L[k];
    return L;
}

/* (c + s T) y = e_1, all real and positive definite; y(0) = e_1 and y(infinity) are c = 1, s = 0 and c = 0, s = 1. */
static void solve(const circuit_impedance *z, double c, double s, double *y)
{
    const int m = z->m;
    y[m - 1] = c + s * z->diagonal[m - 1]; /* pivots from below, then the solution from above in their places */
    for (int k = m - 2; k >= 0; k--) y[k] = c + s * z->diagonal[k] - s * s * z->coupling[k] * z->coupling[k] / y[k + 1];
    y[0] = 1.0 / y[0];
    for (int k = 1; k < m; k++) y[k] = -s * z->coupling[k - 1] * y[k - 1] / y[k];
}

static double product(const circuit_impedance *z, const double *a, const double *b) /* a T b */
{
    double sum = 0.0;
    for (int k = 0; k < z->m; k++) {
        double Tb = z->diagonal[k] * b[k];
        if (k > 0) Tb += z->coupling[k - 1] * b[k - 1];
        if (k + 1 < z->m) Tb += z->coupling[k] * b[k + 1];
        sum += a[k] * Tb;
    }
    return sum;
}

static double length_of(int m, const double *a)
{
    double sum = 0.0;
    for (int k = 0; k < m; k++) sum += a[k] * a[k];
    return sqrt(sum);
}

/* Adds the distribution at the real frequency s/c, unless the space holds it already. */
static void enrich(projection *p, double c, double s)
{
    const int m = p->z->m;
    double *u = p->U + (size_t)p->n * (size_t)m;
    solve(p->z, c, s, u);
    const double whole = length_of(m, u);
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < p->n; j++) {
            const double *q = p->U + (size_t)j * (size_t)m;
            double share = 0.0;
            for (int k = 0; k < m; k++) share += q[k] * u[k];
            for (int k = 0; k < m; k++) u[k] -= share * q[k];
        }
    }
    const double rest = length_of(m, u);
    if (rest <= 1e-9 * whole) return;
    for (int k = 0; k < m; k++) u[k] /= rest;
    for (int j = 0; j <= p->n; j++) p->T[p->n][j] = p->T[j][p->n] = product(p->z, p->U + (size_t)j * (size_t)m, u);
    p->n++;
}

/* With T = [t c; c C] and C = G tau G^T, w = G^T c:  Z'/R_dc = 1 + s (t - sum w^2/tau) + sum (w^2/tau) s/(1 + s tau).
 */
static void rungs_of(const projection *p, circuit_ladder *out)
{
    const size_t n = (size_t)p->n - 1;
    *out = (circuit_ladder){ .R_dc = p->z->R_dc, .L_inf = p->z->R_dc * p->T[0][0] };
    if (n == 0) return;
    double C[MAX_BASIS * MAX_BASIS], G[MAX_BASIS * MAX_BASIS], tau[MAX_BASIS];
    double d[MAX_BASIS], sd[MAX_BASIS], gc[MAX_BASIS], gs[MAX_BASIS]; /* GSL's work space, with nothing to run out of */
    gsl_eigen_symmv_workspace w = { .size = n, .d = d, .sd = sd, .gc = gc, .gs = gs };
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) C[i * n + j] = p->T[i + 1][j + 1];
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(C, n, n), vectors = gsl_matrix_view_array(G, n, n);
    gsl_vector_view values = gsl_vector_view_array(tau, n);
    gsl_eigen_symmv(&matrix.matrix, &values.vector, &vectors.matrix, &w);
    gsl_eigen_symmv_sort(&values.vector, &vectors.matrix, GSL_EIGEN_SORT_VAL_DESC);
    for (size_t k = 0; k < n; k++) {
        double share = 0.0;
        for (size_t i = 0; i < n; i++) share += G[i * n + k] * p->T[i + 1][0];
        const double L = p->z->R_dc * share * share / tau[k];
        out->L_inf -= L;
        if (!(L > 0.0)) continue; /* a mode that no current drives */
        out->L[out->n] = L;
        out->R[out->n++] = L / tau[k];
    }
}

/* Largest error over the band; the grid is even in log frequency from the slowest mode's own. */
static double worst(const projection *p, double omega_top, circuit_ladder *l)
{
    const double low = fmin(0.01 / p->T[0][0], 0.1 * omega_top), ratio = pow(omega_top / low, 1.0 / (GRID - 1));
    l->error = 0.0;
    double omega = low;
    for (int k = 0; k < GRID; k++, omega *= ratio) {
        const double complex s = _Complex_I * omega, whole = circuit_impedance_at(p->z, s);
        const double error = cabs(whole - circuit_ladder_at(l, s)) / cabs(whole - s * l->L_inf);
        if (!(error <= l->error)) l->error = error;
    }
    return l->error;
}

/* Direct current, perfect conductor, and n real frequencies evenly between the slowest mode's and the band's top. */
static void project(projection *p, int n, double omega_top)
{
    p->n = 0;
    enrich(p, 1.0, 0.0);
    enrich(p, 0.0, 1.0);
    const double low = LOWEST / p->T[0][0], top = fmax(HIGHEST * omega_top, low);
    for (int j = 0; j < n; j++) enrich(p, 1.0, low * pow(top / low, (j + 0.5) / n));
}

status circuit_ladder_fit(const circuit_impedance *z, double omega_top, double error, circuit_ladder *out)
{
    projection p = { .z = z, .U = malloc((size_t)(MAX_BASIS + 1) * (size_t)z->m * sizeof *p.U) };
    CHECK(p.U, STATUS_MEMORY, "out of memory for the rails' ladder");
    for (int n = 0; n <= MAX_BASIS - 2; n++) {
        project(&p, n, omega_top);
        rungs_of(&p, out);
        if (worst(&p, omega_top, out) <= error) break;
    }
    free(p.U);
    CHECK(out->error <= error, STATUS_NUMERICAL,
          "the rails' ladder is off by %.2g with %d rungs: allow a larger rail.ladder_error than %g", out->error,
          out->n, error);
    return status_ok();
}
