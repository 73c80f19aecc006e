/* Rail section: perfect conductor by panels on the outline, conductor by filaments (circuit/filaments.h). */
#include "circuit/inductance.h"

#include "circuit/filaments.h"

#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#undef I /* the current, here */

static const double PI = 3.14159265358979323846;
static const double MU0 = 1.25663706212e-6; /* [H/m] CODATA 2018 */

enum { MAX_PANELS = 320 };

/* Thinner skins than the section's largest side over this are taken as a surface impedance on the perfect conductor. */
static const double THIN_SKIN = 150.0;

/* L' = [A + B ln F1] ln F2 uH/m */
double inductance_kerrisk(double h, double w, double s)
{
    const double F1 = 1.0 + 3.397143 * (w / h) - 0.06603002 * (w / h) * (s / h);
    const double F2 = 1.007719 + 2.743651 * (s / h) + 0.02209308 * (w / h) + 0.2637392 * (s / h) * (w / h);
    return 1e-6 * (0.4406411 - 0.07771617 * log(F1)) * log(F2);
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
        const int k = filaments_graded(0.5 * h, 1e-5 * h, growth, 1, d);
        double y = 0.5 * h;
        for (int j = 0; j < k; y -= d[j++]) panels[n++] = (panel){ x, y - 0.5 * d[j], d[j], true };
    }
    const int k = filaments_graded(w, 1e-5 * w, growth, 2, d);
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

status inductance_response(const double section[3], double resistivity, double f_top, impedance *out)
{
    *out = (impedance){ 0 };
    TRY(section_check(section[0], section[1], section[2]));
    CHECK(resistivity > 0.0 && isfinite(resistivity), STATUS_BAD_INPUT,
          "rails.resistivity = %g ohm m: must be positive and finite", resistivity);
    CHECK(f_top > 0.0 && isfinite(f_top), STATUS_BAD_INPUT, "frequency %g Hz: must be positive and finite", f_top);
    filaments cells;
    double *L = NULL;
    const double omega = 2.0 * PI * f_top;
    status st = filaments_of_rectangle(section, resistivity, sqrt(2.0 * resistivity / (omega * MU0)), &cells);
    if (st.code == STATUS_OK) st = filaments_inductance(&cells, &L);
    if (st.code == STATUS_OK) st = impedance_create(cells.n, L, cells.R, omega, out);
    free(L);
    filaments_free(&cells);
    return st;
}

static status thick_skin(const double section[3], double resistivity, double omega, double *L, double *R)
{
    impedance z;
    const status st = inductance_response(section, resistivity, omega / (2.0 * PI), &z);
    if (st.code == STATUS_OK) {
        const double complex Z = impedance_at(&z, _Complex_I * omega);
        *L = cimag(Z) / omega;
        *R = creal(Z);
    }
    impedance_free(&z);
    return st;
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
