/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/rest.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 12, LEAST_CELLS = 4, SMOOTH = 2, COARSEST = 24 };
static const double SMOOTHED = 5.0; /* a smoother takes down eigenvalues above the largest over this */
static const double SOLVED = 200.0; /* the same on the coarsest grid */
static const double MARGIN = 1.01;  /* of the largest eigenvalue, found by iteration from below */

typedef struct {
    double k[8][8]; /* nodes (0,0), (1,0), (0,1), (1,1), x and z of each */
} stiffness;

typedef struct {
    int nx, nz;      /* cells */
    double *u;       /* of all vectors: 2 (nx + 1)(nz + 1), node by node; owns them all */
    double *f;       /* residual */
    double *d, *y;   /* of the smoother: step; A times it */
    double *inverse; /* of the diagonal; 0 at held nodes */
} level;

struct mpm_rest {
    double cell, largest; /* eigenvalue of D^-1 K of any cell, at most */
    int threads, levels;
    level level[LEVELS];
    double *solution, *force, *p, *z, *residual; /* as the vectors of level 0 */
    double *row;                                 /* nz + 1, for sums */
    double unit;                                 /* force that the residual is measured by */
    int n_matrix, matrix_room;
    stiffness *matrix; /* [0] of the intact solid */
    int *matrix_of;    /* nx nz */
};

rest_elastic mpm_rest_isotropic(double youngs, double poisson)
{
    const double lambda = youngs * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    const double shear = 0.5 * youngs / (1.0 + poisson);
    return (rest_elastic){ lambda + 2.0 * shear, lambda + 2.0 * shear, shear, lambda, 0.0, 0.0 };
}

/* ---- the stiffness of a cell ---- */

/* Slopes of the four bilinear functions at (s, t) of a unit cell. */
static void slopes(double s, double t, double g[4][2])
{
    g[0][0] = -(1.0 - t), g[1][0] = 1.0 - t, g[2][0] = -t, g[3][0] = t;
    g[0][1] = -(1.0 - s), g[1][1] = -s, g[2][1] = 1.0 - s, g[3][1] = s;
}

static void stress_of(const rest_elastic *c, const double e[3], double s[3])
{
    s[0] = c->xx * e[0] + c->xx_zz * e[1] + c->xx_shear * e[2];
    s[1] = c->xx_zz * e[0] + c->zz * e[1] + c->zz_shear * e[2];
    s[2] = c->xx_shear * e[0] + c->zz_shear * e[1] + c->shear * e[2];
}

/* (L-5); the cell's size drops out. */
static stiffness stiffness_of(const rest_elastic *c)
{
    stiffness K;
    memset(&K, 0, sizeof K);
    for (int point = 0; point < 4; point++) {
        double g[4][2];
        slopes(point % 2 ? 0.75 : 0.25, point / 2 ? 0.75 : 0.25, g);
        for (int b = 0; b < 8; b++) {
            const double *n = g[b / 2], e[3] = { b % 2 ? 0.0 : n[0], b % 2 ? n[1] : 0.0, b % 2 ? n[0] : n[1] };
            double s[3];
            stress_of(c, e, s);
            for (int a = 0; a < 8; a++)
                K.k[a][b] +=
                    0.25 * (a % 2 ? g[a / 2][1] * s[1] + g[a / 2][0] * s[2] : g[a / 2][0] * s[0] + g[a / 2][1] * s[2]);
        }
    }
    return K;
}

/* Largest eigenvalue of D^-1 K of one cell, which bounds that of all cells together. */
static double largest_eigenvalue(const stiffness *K)
{
    double x[8] = { 1.0, -0.3, -0.7, 0.9, 0.2, -1.0, -0.4, 0.5 }, value = 0.0;
    for (int k = 0; k < 60; k++) {
        double y[8], most = 0.0;
        for (int a = 0; a < 8; a++) {
            y[a] = 0.0;
            for (int b = 0; b < 8; b++) y[a] += K->k[a][b] * x[b];
            y[a] /= K->k[a][a];
            if (fabs(y[a]) > fabs(most)) most = y[a];
        }
        for (int a = 0; a < 8; a++) x[a] = y[a] / most;
        value = fabs(most);
    }
    return MARGIN * value;
}

/* ---- a level ---- */

static size_t length_of(const level *l)
{
    return 2 * (size_t)(l->nx + 1) * (size_t)(l->nz + 1);
}

static bool is_held(const level *l, int i, int j)
{
    return i == 0 || i == l->nx || j == l->nz;
}

/* The solid of cell (i, j); of a coarser level the intact one. */
static const stiffness *matrix_at(const mpm_rest *r, const level *l, int i, int j)
{
    return &r->matrix[l == &r->level[0] ? r->matrix_of[j * l->nx + i] : 0];
}

/* What the cells (i - 1 .. i, j - 1 .. j) put on the node that they share. */
static void node_force(const mpm_rest *r, const level *l, const double *u, int i, int j, double f[2])
{
    f[0] = f[1] = 0.0;
    for (int dj = j > 0 ? -1 : 0; dj < 1; dj++)
        for (int di = -1; di < 1; di++) {
            const stiffness *K = matrix_at(r, l, i + di, j + dj);
            const int row = 2 * (-2 * dj - di);
            const double *near = u + 2 * ((size_t)(j + dj) * (size_t)(l->nx + 1) + (size_t)(i + di));
            const double *far = near + 2 * (l->nx + 1);
            for (int q = 0; q < 2; q++) {
                const double *k = K->k[row + q];
                f[q] += k[0] * near[0] + k[1] * near[1] + k[2] * near[2] + k[3] * near[3] + k[4] * far[0] +
                        k[5] * far[1] + k[6] * far[2] + k[7] * far[3];
            }
        }
}

/* out = A u at nodes that are free, zero at held ones. */
static void apply(const mpm_rest *r, const level *l, const double *u, double *out)
{
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (int j = 0; j <= l->nz; j++) {
        double *to = out + 2 * (size_t)j * (size_t)(l->nx + 1);
        memset(to, 0, 2 * (size_t)(l->nx + 1) * sizeof *to);
        for (int i = 1; i < l->nx && j < l->nz; i++) node_force(r, l, u, i, j, to + 2 * i);
    }
}

static void set_diagonal(const mpm_rest *r, level *l, int i, int j)
{
    double *to = l->inverse + 2 * ((size_t)j * (size_t)(l->nx + 1) + (size_t)i);
    to[0] = to[1] = 0.0;
    if (is_held(l, i, j)) return;
    for (int dj = j > 0 ? -1 : 0; dj < 1; dj++)
        for (int di = -1; di < 1; di++) {
            const stiffness *K = matrix_at(r, l, i + di, j + dj);
            const int row = 2 * (-2 * dj - di);
            for (int q = 0; q < 2; q++) to[q] += K->k[row + q][row + q];
        }
    for (int q = 0; q < 2; q++) to[q] = 1.0 / to[q];
}

/* ---- the preconditioner ---- */

/* Chebyshev's iteration between largest / range and largest: f, the residual of u, comes down; `last`: nobody asks for
 * it any more. */
static void smooth(const mpm_rest *r, level *l, int steps, double range, bool last)
{
    const double high = r->largest, low = high / range, middle = 0.5 * (high + low), half = 0.5 * (high - low);
    const long n = (long)length_of(l);
    double rho = half / middle, keep = 0.0, add = 1.0 / middle;
    for (int step = 0; step < steps; step++) {
#pragma omp parallel for schedule(static) num_threads(r->threads)
        for (long k = 0; k < n; k++) {
            l->d[k] = keep * l->d[k] + add * l->inverse[k] * l->f[k];
            l->u[k] += l->d[k];
        }
        if (last && step == steps - 1) return;
        apply(r, l, l->d, l->y);
#pragma omp parallel for schedule(static) num_threads(r->threads)
        for (long k = 0; k < n; k++) l->f[k] -= l->y[k];
        const double next = 1.0 / (2.0 * middle / half - rho);
        keep = next * rho, add = 2.0 * next / half;
        rho = next;
    }
}

/* Coarse right side: the transpose of `prolong`. */
static void restrict_to(const mpm_rest *r, const level *fine, level *coarse)
{
    const int wide = fine->nx + 1;
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (int j = 0; j <= coarse->nz; j++)
        for (int i = 0; i <= coarse->nx; i++)
            for (int q = 0; q < 2; q++) {
                double sum = 0.0;
                for (int dj = -1; dj <= 1; dj++)
                    for (int di = -1; di <= 1; di++) {
                        const int a = 2 * i + di, b = 2 * j + dj;
                        if (a < 0 || a > fine->nx || b < 0 || b > fine->nz) continue;
                        sum += (di ? 0.5 : 1.0) * (dj ? 0.5 : 1.0) *
                               fine->f[2 * ((size_t)b * (size_t)wide + (size_t)a) + (size_t)q];
                    }
                coarse->f[2 * ((size_t)j * (size_t)(coarse->nx + 1) + (size_t)i) + (size_t)q] =
                    is_held(coarse, i, j) ? 0.0 : sum;
            }
}

static void prolong(const mpm_rest *r, const level *coarse, level *fine)
{
    const size_t wide = (size_t)coarse->nx + 1;
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (int j = 0; j < fine->nz; j++)
        for (int i = 1; i < fine->nx; i++)
            for (size_t q = 0; q < 2; q++) {
                const size_t a = (size_t)i / 2, b = (size_t)j / 2, a1 = a + (size_t)(i % 2), b1 = b + (size_t)(j % 2);
                const double *u = coarse->u;
                fine->d[2 * ((size_t)j * ((size_t)fine->nx + 1) + (size_t)i) + q] =
                    0.25 * (u[2 * (b * wide + a) + q] + u[2 * (b * wide + a1) + q] + u[2 * (b1 * wide + a) + q] +
                            u[2 * (b1 * wide + a1) + q]);
            }
}

/* level k: u = about A^-1 f; f is used up.  The same polynomial before and after, so that it is symmetric. */
static void cycle(mpm_rest *r, int k)
{
    level *l = &r->level[k];
    const long n = (long)length_of(l);
    memset(l->u, 0, (size_t)n * sizeof *l->u);
    memset(l->d, 0, (size_t)n * sizeof *l->d);
    if (k == r->levels - 1) {
        smooth(r, l, COARSEST, SOLVED, true);
        return;
    }
    smooth(r, l, SMOOTH, SMOOTHED, false);
    restrict_to(r, l, &r->level[k + 1]);
    cycle(r, k + 1);
    memset(l->d, 0, (size_t)n * sizeof *l->d);
    prolong(r, &r->level[k + 1], l);
    apply(r, l, l->d, l->y);
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (long i = 0; i < n; i++) {
        l->u[i] += l->d[i];
        l->f[i] -= l->y[i];
    }
    smooth(r, l, SMOOTH, SMOOTHED, true);
}

/* ---- making one ---- */

static status level_create(level *l, int nx, int nz)
{
    *l = (level){ .nx = nx, .nz = nz };
    const size_t n = length_of(l);
    double *all = calloc(5 * n, sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory for a grid of %d x %d cells", nx, nz);
    l->u = all, l->f = all + n, l->d = all + 2 * n, l->y = all + 3 * n, l->inverse = all + 4 * n;
    return status_ok();
}

static void set_diagonals(const mpm_rest *r, level *l)
{
    for (int j = 0; j <= l->nz; j++)
        for (int i = 0; i <= l->nx; i++) set_diagonal(r, l, i, j);
}

static status fill(mpm_rest *r, int nx, int nz, const rest_elastic *solid)
{
    const size_t cells = (size_t)nx * (size_t)nz, n = 2 * (size_t)(nx + 1) * (size_t)(nz + 1);
    r->matrix_of = calloc(cells, sizeof *r->matrix_of);
    r->matrix = malloc(sizeof *r->matrix);
    r->solution = calloc(5 * n, sizeof *r->solution);
    r->row = calloc((size_t)nz + 1, sizeof *r->row);
    CHECK(r->matrix_of && r->matrix && r->solution && r->row, STATUS_MEMORY, "no memory for a grid of %d x %d cells",
          nx, nz);
    r->force = r->solution + n, r->p = r->solution + 2 * n, r->z = r->solution + 3 * n;
    r->residual = r->solution + 4 * n;
    r->n_matrix = r->matrix_room = 1;
    r->matrix[0] = stiffness_of(solid);
    r->largest = largest_eigenvalue(&r->matrix[0]);
    for (;; nx /= 2, nz /= 2) {
        TRY(level_create(&r->level[r->levels], nx, nz));
        set_diagonals(r, &r->level[r->levels++]);
        if (nx % 2 || nz % 2 || nx < 2 * LEAST_CELLS || nz < 2 * LEAST_CELLS || r->levels == LEVELS) return status_ok();
    }
}

status mpm_rest_create(int nx, int nz, double cell, const rest_elastic *solid, int threads, mpm_rest **out)
{
    mpm_rest *r = *out = calloc(1, sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for a solid at rest");
    r->cell = cell;
    r->threads = threads;
    const status done = fill(r, nx, nz, solid);
    if (done.code == STATUS_OK) return done;
    mpm_rest_free(r);
    *out = NULL;
    return done;
}

void mpm_rest_free(mpm_rest *r)
{
    if (!r) return;
    for (int k = 0; k < r->levels; k++) free(r->level[k].u);
    free(r->matrix_of);
    free(r->matrix);
    free(r->solution);
    free(r->row);
    free(r);
}

double *mpm_rest_displacement(mpm_rest *r)
{
    return r->solution;
}

double *mpm_rest_forces(mpm_rest *r)
{
    return r->force;
}

status mpm_rest_change(mpm_rest *r, int i, int j, const rest_elastic *solid)
{
    level *l = &r->level[0];
    int *at = &r->matrix_of[j * l->nx + i];
    if (*at == 0) {
        if (r->n_matrix == r->matrix_room) {
            const int room = 2 * r->matrix_room;
            stiffness *more = realloc(r->matrix, (size_t)room * sizeof *more);
            CHECK(more, STATUS_MEMORY, "no memory for %d changed cells", room);
            r->matrix = more, r->matrix_room = room;
        }
        *at = r->n_matrix++;
    }
    r->matrix[*at] = stiffness_of(solid);
    r->largest = fmax(r->largest, largest_eigenvalue(&r->matrix[*at]));
    for (int dj = 0; dj < 2; dj++)
        for (int di = 0; di < 2; di++) set_diagonal(r, l, i + di, j + dj);
    return status_ok();
}

/* ---- the solution ---- */

/* Row by row, then row after row: the same sum on any number of threads. */
static double product(const mpm_rest *r, const double *a, const double *b)
{
    const level *l = &r->level[0];
    const long wide = 2 * (l->nx + 1);
    double sum = 0.0;
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (int j = 0; j <= l->nz; j++) {
        double row = 0.0;
        for (long k = j * wide; k < (j + 1) * wide; k++) row += a[k] * b[k];
        r->row[j] = row;
    }
    for (int j = 0; j <= l->nz; j++) sum += r->row[j];
    return sum;
}

/* residual = force - A u; what it is measured by: all forces that cells put on nodes of the face and below. */
static void first_residual(mpm_rest *r)
{
    level *l = &r->level[0];
    const long n = (long)length_of(l);
    apply(r, l, r->solution, l->y);
#pragma omp parallel for schedule(static) num_threads(r->threads)
    for (long k = 0; k < n; k++) r->residual[k] = l->inverse[k] == 0.0 ? 0.0 : r->force[k] - l->y[k];
    if (r->unit == 0.0) r->unit = sqrt(product(r, r->force, r->force));
}

static void precondition(mpm_rest *r)
{
    level *l = &r->level[0];
    memcpy(l->f, r->residual, length_of(l) * sizeof *l->f);
    cycle(r, 0);
    memcpy(r->z, l->u, length_of(l) * sizeof *l->u);
}

status mpm_rest_solve(mpm_rest *r, double tolerance, int most, int *iterations)
{
    level *l = &r->level[0];
    const long n = (long)length_of(l);
    double old = 0.0, left = 0.0;
    first_residual(r);
    for (int it = 0; it <= most; it++) {
        left = sqrt(product(r, r->residual, r->residual));
        if (left <= tolerance * r->unit) return status_ok();
        ++*iterations;
        precondition(r);
        const double now = product(r, r->residual, r->z), beta = it ? now / old : 0.0;
        old = now;
#pragma omp parallel for schedule(static) num_threads(r->threads)
        for (long k = 0; k < n; k++) r->p[k] = r->z[k] + beta * r->p[k];
        apply(r, l, r->p, l->y);
        const double step = now / product(r, r->p, l->y);
#pragma omp parallel for schedule(static) num_threads(r->threads)
        for (long k = 0; k < n; k++) {
            r->solution[k] += step * r->p[k];
            r->residual[k] -= step * l->y[k];
        }
    }
    return base_status_error(STATUS_NUMERICAL, "no equilibrium within %d iterations: residual %.3g of the load", most,
                             left / r->unit);
}

/* ---- strain ---- */

void mpm_rest_strain(const mpm_rest *r, int i, int j, double strain[3])
{
    const size_t wide = 2 * (size_t)(r->level[0].nx + 1);
    const double *near = r->solution + (size_t)j * wide + 2 * (size_t)i, *far = near + wide, h = 0.5 / r->cell;
    strain[0] = h * (near[2] - near[0] + far[2] - far[0]);
    strain[1] = h * (far[1] - near[1] + far[3] - near[3]);
    strain[2] = h * (far[0] - near[0] + far[2] - near[2] + near[3] - near[1] + far[3] - far[1]);
}

double mpm_rest_face_strain(const mpm_rest *r, int i)
{
    return (r->solution[2 * i + 2] - r->solution[2 * i]) / r->cell;
}
