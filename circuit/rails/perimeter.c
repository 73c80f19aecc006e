/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/perimeter.h"

#include "base/constants.h"
#include "circuit/rails/filaments.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* K grows as r^(-1/3) towards a square corner: panels from `finest` of the side there, an arc's within `step`. */
typedef struct {
    double finest, growth, step;
} grading;
static const grading FINE = { 1e-5, 1.16, 0.04 }, QUICK = { 1e-3, 1.5, 0.2 };
enum { MAX_PANELS = 600, MAX_SIDE = 200 };

/* QUICK's panels round the corners off about as a skin of a hundredth of the section does.  ROUNDED makes up for the
 * rest: rails of 25 x 20 mm, 25 mm apart, then have the 0.40 that filaments at 100 kHz give them. */
static const double ROUNDED = 1.00186338;

typedef struct {
    circuit_section_point middle, along; /* [m], unit vector */
    double length;                       /* [m] */
    double resistivity;                  /* of the metal behind it [ohm m] */
} panel;

typedef struct {
    int n;
    panel at[MAX_PANELS];
} outline;

static void outline_add(outline *o, circuit_section_point a, circuit_section_point b, double resistivity)
{
    const double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy);
    o->at[o->n++] =
        (panel){ { 0.5 * (a.x + b.x), 0.5 * (a.y + b.y) }, { dx / length, dy / length }, length, resistivity };
}

/* Bore face from the edge to the middle, back likewise, the side between them. */
static void outline_trace(const circuit_rail_section *s, const grading *g, outline *o)
{
    double d[MAX_SIDE], y[CIRCUIT_SECTION_MAX_ROWS + 1];
    const int rows = circuit_section_rows(s, g->finest * s->height, g->growth, g->step, y);
    const double half = 0.5 * s->height, top = circuit_section_face(s, half),
                 side = circuit_section_back(s, half) - top;
    const double face_metal = s->cladding > 0.0 ? s->cladding_resistivity : s->resistivity;
    o->n = 0;
    for (int back = 0; back < 2; back++) {
        double (*const x)(const circuit_rail_section *, double) = back ? circuit_section_back : circuit_section_face;
        for (int j = 0; j < rows; j++)
            outline_add(o, (circuit_section_point){ x(s, y[j]), y[j] },
                        (circuit_section_point){ x(s, y[j + 1]), y[j + 1] }, back ? s->resistivity : face_metal);
    }
    if (side < 1e-9 * s->thickness) return;
    const int n = circuit_filaments_graded(side, g->finest * side, g->growth, 2, d);
    double x = top;
    for (int j = 0; j < n; x += d[j++])
        outline_add(o, (circuit_section_point){ x, half }, (circuit_section_point){ x + d[j], half },
                    x + 0.5 * d[j] - top < s->cladding ? face_metal : s->resistivity);
}

/* Integral of ln r over a panel, seen from p. */
static double panel_log(const panel *q, circuit_section_point p)
{
    const double dx = p.x - q->middle.x, dy = p.y - q->middle.y;
    const double along = dx * q->along.x + dy * q->along.y, across = dx * q->along.y - dy * q->along.x;
    double sum = 0.0;
    for (int end = 0; end < 2; end++) {
        const double t = (end ? 0.5 : -0.5) * q->length - along, r2 = t * t + across * across;
        const double part =
            (r2 > 0.0 ? 0.5 * t * log(r2) : 0.0) - t + (across != 0.0 ? across * atan(t / across) : 0.0);
        sum += end ? part : -part;
    }
    return sum;
}

static double panel_potential(const circuit_rail_section *s, const panel *p, const panel *q)
{
    double sum = 0.0;
    for (int image = 0; image < circuit_section_images(s); image++)
        sum += circuit_section_image_sign(s, image) * panel_log(q, circuit_section_image(p->middle, image));
    return -MU0 / (2.0 * PI) * sum;
}

static status currents_solve(const circuit_rail_section *s, const outline *o, gsl_vector *K)
{
    const size_t n = (size_t)o->n;
    gsl_matrix *matrix = gsl_matrix_alloc(n, n);
    gsl_vector *right = gsl_vector_alloc(n);
    gsl_permutation *order = gsl_permutation_alloc(n);
    int sign = 0, bad = GSL_ENOMEM;
    if (matrix && right && order) {
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j < n; j++) gsl_matrix_set(matrix, i, j, panel_potential(s, &o->at[i], &o->at[j]));
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

/* The outline, and the current on its panels at A = 1 Wb/m; *K is the caller's to free, NULL after an error. */
static status outline_solve(const circuit_rail_section *s, const grading *g, outline *o, gsl_vector **K)
{
    outline_trace(s, g, o);
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    *K = gsl_vector_alloc((size_t)o->n);
    const status st =
        *K ? currents_solve(s, o, *K) : base_status_error(STATUS_MEMORY, "out of memory for %d rail panels", o->n);
    gsl_set_error_handler(handler);
    if (st.code == STATUS_OK || !*K) return st;
    gsl_vector_free(*K);
    *K = NULL;
    return st;
}

/* The current on the outline, and the sum of `weight` times its square: the skin's loss at 1 Hz, or 1. */
static double sum_of_squares(const outline *o, const gsl_vector *K, bool of_loss, double *I)
{
    double sum = 0.0;
    *I = 0.0;
    for (int j = 0; j < o->n; j++) {
        const double k = gsl_vector_get(K, (size_t)j), weight = of_loss ? sqrt(PI * MU0 * o->at[j].resistivity) : 1.0;
        *I += k * o->at[j].length;
        sum += weight * k * k * o->at[j].length;
    }
    return sum;
}

status circuit_perimeter_solve(const circuit_rail_section *s, double *L, double *skin)
{
    outline o;
    gsl_vector *K;
    double I;
    TRY(outline_solve(s, &FINE, &o, &K));
    const double loss = sum_of_squares(&o, K, true, &I);
    gsl_vector_free(K);
    *L = circuit_section_weight(s) / I;
    *skin = circuit_section_weight(s) * loss / (I * I);
    return status_ok();
}

/* Half of one rail has I: all of it, 2 I, is `rails`/2 times less than the whole current. */
status circuit_perimeter_sheet(const circuit_rail_section *s, double *sheet)
{
    outline o;
    gsl_vector *K;
    double I;
    TRY(outline_solve(s, &QUICK, &o, &K));
    const double squares = sum_of_squares(&o, K, false, &I);
    gsl_vector_free(K);
    *sheet = ROUNDED * s->height * squares / (I * I * s->rails);
    return status_ok();
}
