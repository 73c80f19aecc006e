/* 2-D current distribution in a pair of rails carrying +I and -I.
 *
 * The plane is cut in filaments.  The vector potential of filament j at i, averaged over both sections (Galerkin), is
 *   A_i = - mu0/(2 pi) sum_j I_j <ln r_ij>,                                                (C-8)
 * and each filament of a rail sees the same voltage gradient e = rho I_i/a_i + i omega A_i.  One quarter is solved: y = 0
 * mirrors the current, x = 0 mirrors and reverses it.  Z' = 2 e/I. */
#include "circuit/inductance.h"

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double MU0 = 1.25663706212e-6; /* [H/m] CODATA 2018 */

enum { MAX_CELLS = 64, MAX_FILAMENTS = MAX_CELLS * MAX_CELLS / 2, MAX_PANELS = 320 };

/* Thinner skins than the section's largest side over this are taken as a surface impedance on the perfect conductor. */
static const double THIN_SKIN = 150.0;

typedef struct {
    double x, y, a, b; /* centre and full sizes along x and y [m] */
} filament;

/* L' = [A + B ln F1] ln F2 uH/m */
double inductance_kerrisk(double h, double w, double s)
{
    const double F1 = 1.0 + 3.397143 * (w / h) - 0.06603002 * (w / h) * (s / h);
    const double F2 = 1.007719 + 2.743651 * (s / h) + 0.02209308 * (w / h) + 0.2637392 * (s / h) * (w / h);
    return 1e-6 * (0.4406411 - 0.07771617 * log(F1)) * log(F2);
}

/* d^4 G/dX^2 dY^2 = 1/2 ln(X^2 + Y^2) + 25/12 */
static double antiderivative(double X, double Y)
{
    const double x = fabs(X), y = fabs(Y), r2 = x * x + y * y;
    if (r2 == 0.0) return 0.0;
    const double x2 = x * x, y2 = y * y;
    const double log_part = (6.0 * x2 * y2 - x2 * x2 - y2 * y2) / 24.0 * log(r2);
    const double atan_part = (x2 * x * y * atan2(y, x) + x * y * y2 * atan2(x, y)) / 3.0;
    return 0.5 * (log_part + atan_part);
}

/* Mean of ln r between two rectangles whose centres lie dx, dy apart; exact when near, to (size/r)^4 when far. */
static double mean_log(const filament *p, const filament *q, double dx, double dy)
{
    const double r2 = dx * dx + dy * dy, size = fmax(fmax(p->a, p->b), fmax(q->a, q->b));
    if (r2 > 144.0 * size * size) {
        const double spread = p->a * p->a + q->a * q->a - p->b * p->b - q->b * q->b;
        return 0.5 * log(r2) + spread * (dy * dy - dx * dx) / (24.0 * r2 * r2);
    }
    const double X[4] = { 0.5 * (p->a + q->a), 0.5 * (p->a - q->a), -0.5 * (p->a - q->a), -0.5 * (p->a + q->a) };
    const double Y[4] = { 0.5 * (p->b + q->b), 0.5 * (p->b - q->b), -0.5 * (p->b - q->b), -0.5 * (p->b + q->b) };
    const double sign[4] = { 1.0, -1.0, -1.0, 1.0 };
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) sum += sign[i] * sign[j] * antiderivative((dx + X[i]) / size, (dy + Y[j]) / size);
    }
    const double size4 = size * size * size * size;
    return sum * size4 / (p->a * p->b * q->a * q->b) - 25.0 / 12.0 + log(size);
}

/* Cell sizes over `length`, growing from `first` by `growth` at most away from one end, or from both.  Returns their number. */
static int graded(double length, double first, double growth, int ends, double *size)
{
    const double span = length / ends;
    int n = 0;
    double sum = 0.0, d = first;
    while (sum < span) {
        size[n++] = d;
        sum += d;
        d *= growth;
    }
    for (int k = 0; k < n; k++) size[k] *= span / sum;
    if (ends == 2) {
        for (int k = 0; k < n; k++) size[2 * n - 1 - k] = size[k];
    }
    return ends * n;
}

static int section_mesh(const double section[3], double depth, filament *cells)
{
    const double h = section[0], w = section[1], s = section[2], growth = 1.25;
    double dx[MAX_CELLS], dy[MAX_CELLS];
    const int nx = graded(w, fmin(depth / 6.0, w / 40.0), growth, 2, dx);
    const int ny = graded(0.5 * h, fmin(depth / 6.0, h / 40.0), growth, 1, dy);
    int n = 0;
    double x = 0.5 * s;
    for (int i = 0; i < nx; i++, x += dx[i - 1]) {
        double y = 0.5 * h; /* finest at the edge, coarse at y = 0 */
        for (int j = 0; j < ny; j++) {
            cells[n++] = (filament){ x + 0.5 * dx[i], y - 0.5 * dy[j], dx[i], dy[j] };
            y -= dy[j];
        }
    }
    return n;
}

static double potential(const filament *p, const filament *q)
{
    return -MU0 / (2.0 * PI) *
           (mean_log(p, q, p->x - q->x, p->y - q->y) + mean_log(p, q, p->x - q->x, p->y + q->y) -
            mean_log(p, q, p->x + q->x, p->y - q->y) - mean_log(p, q, p->x + q->x, p->y + q->y));
}

typedef struct {
    gsl_matrix_complex *matrix;
    gsl_vector_complex *right, *current;
    gsl_permutation *order;
} filament_system;

static void system_free(filament_system *s)
{
    if (s->matrix) gsl_matrix_complex_free(s->matrix);
    if (s->right) gsl_vector_complex_free(s->right);
    if (s->current) gsl_vector_complex_free(s->current);
    if (s->order) gsl_permutation_free(s->order);
}

static status system_solve(const filament *cells, int n, double resistivity, double omega, gsl_complex *total)
{
    const size_t size = (size_t)n;
    filament_system s = { gsl_matrix_complex_alloc(size, size), gsl_vector_complex_alloc(size),
                          gsl_vector_complex_alloc(size), gsl_permutation_alloc(size) };
    if (!s.matrix || !s.right || !s.current || !s.order) {
        system_free(&s);
        return status_error(STATUS_MEMORY, "out of memory for %d rail filaments", n);
    }
    for (size_t i = 0; i < size; i++) {
        for (size_t j = i; j < size; j++) {
            const double R = i == j ? resistivity / (cells[i].a * cells[i].b) : 0.0;
            const gsl_complex z = gsl_complex_rect(R, omega * potential(&cells[i], &cells[j]));
            gsl_matrix_complex_set(s.matrix, i, j, z);
            gsl_matrix_complex_set(s.matrix, j, i, z);
        }
    }
    gsl_vector_complex_set_all(s.right, gsl_complex_rect(1.0, 0.0));
    int sign = 0;
    int bad = gsl_linalg_complex_LU_decomp(s.matrix, s.order, &sign);
    if (!bad) bad = gsl_linalg_complex_LU_solve(s.matrix, s.order, s.right, s.current);
    *total = gsl_complex_rect(0.0, 0.0);
    for (size_t i = 0; i < size; i++) *total = gsl_complex_add(*total, gsl_vector_complex_get(s.current, i));
    system_free(&s);
    CHECK(!bad, STATUS_NUMERICAL, "the rail section's filament system is singular (%s)", gsl_strerror(bad));
    return status_ok();
}

static status section_check(double h, double w, double s)
{
    CHECK(h > 0.0 && w > 0.0 && s > 0.0, STATUS_BAD_INPUT,
          "rails of height %g m, thickness %g m, separation %g m: all must be positive", h, w, s);
    return status_ok();
}

/* Panels along the quarter's outline, K [A/m] constant on each; graded to the corners, where K grows as r^(-1/3). */
typedef struct {
    double x, y, length; /* midpoint [m] */
    bool upright;        /* along y, else along x */
} panel;

static int outline(double h, double w, double s, panel *panels)
{
    double d[2 * MAX_PANELS];
    const double growth = 1.16;
    int n = 0;
    for (int face = 0; face < 2; face++) { /* inner and outer face, from the edge to y = 0 */
        const double x = 0.5 * s + face * w;
        const int k = graded(0.5 * h, 1e-5 * h, growth, 1, d);
        double y = 0.5 * h;
        for (int j = 0; j < k; y -= d[j++]) panels[n++] = (panel){ x, y - 0.5 * d[j], d[j], true };
    }
    const int k = graded(w, 1e-5 * w, growth, 2, d);
    double x = 0.5 * s;
    for (int j = 0; j < k; x += d[j++]) panels[n++] = (panel){ x + 0.5 * d[j], 0.5 * h, d[j], false };
    return n;
}

/* Integral of ln r over a panel centred at the origin, seen from `along` and `across`. */
static double panel_log(double along, double across, double length)
{
    double sum = 0.0;
    for (int end = 0; end < 2; end++) {
        const double t = (end ? 0.5 : -0.5) * length - along, r2 = t * t + across * across;
        const double part =
            (r2 > 0.0 ? 0.5 * t * log(r2) : 0.0) - t + (across != 0.0 ? across * atan(t / across) : 0.0);
        sum += end ? part : -part;
    }
    return sum;
}

static double panel_potential(const panel *p, const panel *q)
{
    double sum = 0.0;
    for (int image = 0; image < 4; image++) {
        const double dx = p->x - (image & 1 ? -q->x : q->x), dy = p->y - (image & 2 ? -q->y : q->y);
        const double part = q->upright ? panel_log(dy, dx, q->length) : panel_log(dx, dy, q->length);
        sum += image & 1 ? -part : part;
    }
    return -MU0 / (2.0 * PI) * sum;
}

static status panels_solve(const panel *panels, int n, gsl_vector *K)
{
    const size_t size = (size_t)n;
    gsl_matrix *matrix = gsl_matrix_alloc(size, size);
    gsl_vector *right = gsl_vector_alloc(size);
    gsl_permutation *order = gsl_permutation_alloc(size);
    int sign = 0, bad = GSL_ENOMEM;
    if (matrix && right && order) {
        for (size_t i = 0; i < size; i++) {
            for (size_t j = 0; j < size; j++) gsl_matrix_set(matrix, i, j, panel_potential(&panels[i], &panels[j]));
        }
        gsl_vector_set_all(right, 1.0); /* A = 1 Wb/m on the metal */
        bad = gsl_linalg_LU_decomp(matrix, order, &sign);
        if (!bad) bad = gsl_linalg_LU_solve(matrix, order, right, K);
    }
    if (matrix) gsl_matrix_free(matrix);
    if (right) gsl_vector_free(right);
    if (order) gsl_permutation_free(order);
    CHECK(!bad, STATUS_NUMERICAL, "the rail section's surface system has no solution (%s)", gsl_strerror(bad));
    return status_ok();
}

/* L = 2 A/I;  crowding = integral of K^2 over both rails' outlines over I^2 [1/m], so that a thin skin has
 * R' = rho/depth crowding                                                                 (C-9) */
static status perfect_conductor(const double section[3], double *L, double *crowding)
{
    panel panels[MAX_PANELS];
    const int n = outline(section[0], section[1], section[2], panels);
    gsl_vector *K = gsl_vector_alloc((size_t)n);
    CHECK(K, STATUS_MEMORY, "out of memory for %d rail panels", n);
    const status st = panels_solve(panels, n, K);
    double I = 0.0, K2 = 0.0;
    for (int j = 0; j < n && st.code == STATUS_OK; j++) {
        const double k = gsl_vector_get(K, (size_t)j);
        I += 2.0 * k * panels[j].length;
        K2 += 4.0 * k * k * panels[j].length;
    }
    gsl_vector_free(K);
    TRY(st);
    *L = 2.0 / I;
    *crowding = K2 / (I * I);
    return status_ok();
}

status inductance_limit(double h, double w, double s, double *L)
{
    TRY(section_check(h, w, s));
    const double section[3] = { h, w, s };
    double crowding = 0.0;
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const status st = perfect_conductor(section, L, &crowding);
    gsl_set_error_handler(handler);
    return st;
}

/* The skin is thin: surface impedance (1 + i) rho/depth on the perfect conductor's current. */
static status thin_skin(const double section[3], double resistivity, double omega, double *L, double *R)
{
    double crowding = 0.0;
    TRY(perfect_conductor(section, L, &crowding));
    *R = resistivity / sqrt(2.0 * resistivity / (omega * MU0)) * crowding;
    *L += *R / omega;
    return status_ok();
}

static status thick_skin(const double section[3], double resistivity, double omega, double *L, double *R)
{
    filament *cells = malloc(MAX_FILAMENTS * sizeof *cells);
    CHECK(cells, STATUS_MEMORY, "out of memory for the rail filaments");
    const int n = section_mesh(section, sqrt(2.0 * resistivity / (omega * MU0)), cells);
    gsl_complex total = { { 1.0, 0.0 } };
    const status st = system_solve(cells, n, resistivity, omega, &total);
    free(cells);
    TRY(st);
    const gsl_complex Z = gsl_complex_inverse(total); /* 2 e/(2 total), e = 1 */
    *L = GSL_IMAG(Z) / omega;
    *R = GSL_REAL(Z);
    return status_ok();
}

status inductance_at(const double section[3], double resistivity, double f, double *L, double *R)
{
    TRY(section_check(section[0], section[1], section[2]));
    CHECK(resistivity > 0.0 && isfinite(resistivity), STATUS_BAD_INPUT,
          "rails.resistivity = %g ohm m: must be positive and finite", resistivity);
    CHECK(f >= 0.0 && isfinite(f), STATUS_BAD_INPUT, "frequency %g Hz: must be 0 or positive and finite", f);
    const double largest = fmax(section[0], section[1]);
    /* Below the frequency whose skin depth is 100 sections nothing changes by 1e-7: that is direct current. */
    const double slow = resistivity / (PI * MU0 * 1e4 * largest * largest);
    const double omega = 2.0 * PI * fmax(f, slow);
    const double depth = sqrt(2.0 * resistivity / (omega * MU0));
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    const status st = depth < largest / THIN_SKIN ? thin_skin(section, resistivity, omega, L, R)
                                                  : thick_skin(section, resistivity, omega, L, R);
    gsl_set_error_handler(handler);
    return st;
}
