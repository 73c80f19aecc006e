/* SPDX-License-Identifier: BSD-3-Clause */
/* The bordered block-diagonal matrix against a dense one, and the circuit's Jacobian against differences of its
 * residual. */
#include "circuit/shot_internal.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "random_common.h"
#include "status_common.h"

/* All entries of the arrow as one dense matrix, n x n. */
static double *dense_of(const arrow *a, int n)
{
    double *A = calloc((size_t)n * (size_t)n, sizeof *A);
    const int tail = n - a->border;
    assert_non_null(A);
    for (int k = 0, row = 0; k < a->blocks; row += a->size[k++]) {
        for (int i = 0; i < a->size[k]; i++) {
            for (int j = 0; j < a->size[k]; j++)
                A[(row + i) * n + row + j] = circuit_arrow_block(a, k)[i * ARROW_BLOCK + j];
            if (!a->idle[k]) A[(row + i) * n + tail + a->column[k]] = a->b[k * ARROW_BLOCK + i];
        }
        for (int j = 0; j < a->size[k] && !a->idle[k]; j++)
            for (int r = 0; r < a->border; r++) A[(tail + r) * n + row + j] = circuit_arrow_column(a, k, j)[r];
    }
    for (int i = 0; i < a->border; i++)
        for (int j = 0; j < a->border; j++) A[(tail + i) * n + tail + j] = a->E[i * a->border + j];
    return A;
}

static void solves_as_a_dense_matrix(void **state)
{
    (void)state;
    enum { BLOCKS = 7, BORDER = 6, SUMS = 2 };
    uint64_t seed = 4;
    for (int trial = 0; trial < 50; trial++) {
        arrow *a = NULL;
        OK(circuit_arrow_create(BLOCKS, BORDER, SUMS, &a));
        circuit_arrow_clear(a);
        int n = BORDER;
        for (int k = 0; k < BLOCKS; k++) {
            n += a->size[k] = 1 + (k + trial) % ARROW_BLOCK;
            a->column[k] = SUMS + (k * 3) % (BORDER - SUMS);
            a->idle[k] = (k + trial) % 6 == 0;
            for (int i = 0; i < a->size[k]; i++) {
                for (int j = 0; j < a->size[k]; j++)
                    circuit_arrow_block(a, k)[i * ARROW_BLOCK + j] =
                        random_between(&seed, -1.0, 1.0) + (i == j ? 3.0 : 0.0);
                a->b[k * ARROW_BLOCK + i] = random_between(&seed, -1.0, 1.0);
                for (int r = 0; r < BORDER; r++) circuit_arrow_column(a, k, i)[r] = random_between(&seed, -1.0, 1.0);
            }
        }
        for (int i = 0; i < BORDER * BORDER; i++)
            a->E[i] = random_between(&seed, -1.0, 1.0) + (i % (BORDER + 1) == 0 ? 6.0 : 0.0);
        for (int s = 0; s < SUMS; s++) {
            for (int i = 0; i < BORDER; i++)
                if (i != s) a->E[i * BORDER + s] = 0.0;
        }
        double x[40], y[40];
        int pivot[40];
        for (int i = 0; i < n; i++) x[i] = y[i] = random_between(&seed, -1.0, 1.0);
        double *A = dense_of(a, n);
        assert_int_equal(circuit_lu_factor(A, n, n, pivot), 0);
        circuit_lu_solve(A, n, n, pivot, y);
        assert_int_equal(circuit_arrow_factor(a), 0);
        circuit_arrow_solve(a, x);
        for (int i = 0; i < n; i++)
            assert_true(fabs(x[i] - y[i]) < 1e-11 * (1.0 + fabs(y[i]))); /* condition below 1e4 */
        free(A);
        circuit_arrow_free(a);
    }
}

static void singular_is_said(void **state)
{
    (void)state;
    arrow *a = NULL;
    OK(circuit_arrow_create(2, 1, 0, &a));
    circuit_arrow_clear(a);
    a->size[0] = 1;
    a->size[1] = 2;
    circuit_arrow_block(a, 0)[0] = 1.0;
    circuit_arrow_block(a, 1)[0] = 1.0;
    a->E[0] = 1.0;
    assert_int_equal(circuit_arrow_factor(a), 3); /* third row: the second of block 1 */
    circuit_arrow_free(a);
}

/* A shot half way down a barrel with three feeds, a shunt, diffusing rails, wear and two kinds of supply; on a film of
 * melt, its current crowded, where asked. */
static circuit_shot *busy_shot(bool film)
{
    circuit_shot_module m[4] = { unit_200kJ(9, 0.0), unit_200kJ(2, 2e-4), unit_200kJ(2, 0.0), unit_200kJ(1, NAN) };
    circuit_supply_homopolar h;
    base_params_default(circuit_supply_homopolar_params, &h);
    h.flux = 0.2;
    h.inertia = 50.0;
    h.speed = 20e3;
    h.windage = 0.01;
    h.inductance = 4e-6;
    m[1].damping_resistance = 0.5;
    m[1].cable_inductance = 1e-6;
    m[1].position = 0.3;
    m[2].position = 0.6;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 4, m };
    c.supplies[CIRCUIT_SUPPLY_homopolar] = (circuit_supply_list){ 1, &h };
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    c.barrel.shunt_resistance = 1e-3;
    c.armature.wear_fraction = 0.05;
    c.armature.friction_law = film ? CIRCUIT_SHOT_FRICTION_FILM : CIRCUIT_SHOT_FRICTION_SPEED;
    c.armature.velocity_skin = film;
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    for (double t = 1e-4; circuit_shot_now(s).x < 1.0; t += 1e-4) OK(circuit_shot_advance(s, t, NULL));
    assert_int_equal(s->model.reached, 3);
    return s;
}

/* Differences of the whole residual in one unknown, central, against the column: both are differences of functions that
 * are smooth over the step, good to 1e-5 of the column's largest entry in the units of each row. */
static void check_jacobian(circuit_shot *s)
{
    const shot_model *m = &s->model;
    const int n = circuit_shot_unknowns(m);
    const double cj = 1e6;
    double *y = circuit_shot_y(s), *yp = circuit_dae_yp(s->solver), *up = malloc((size_t)n * sizeof *up),
           *down = malloc((size_t)n * sizeof *down);
    assert_true(up && down);
    circuit_arrow_clear(s->matrix);
    circuit_shot_jacobian(m, s->t, cj, y, s->matrix);
    double *J = dense_of(s->matrix, n), worst = 0.0;
    for (int j = 0; j < n; j++) {
        const double y0 = y[j], yp0 = yp[j], h = 1e-6 * fmax(fabs(y0), 1e-2 * s->scale[j]);
        y[j] = y0 + h;
        yp[j] = yp0 + cj * h;
        circuit_shot_residual(m, s->t, y, yp, up);
        y[j] = y0 - h;
        yp[j] = yp0 - cj * h;
        circuit_shot_residual(m, s->t, y, yp, down);
        y[j] = y0;
        yp[j] = yp0;
        for (int i = 0; i < n; i++) {
            const double want = (up[i] - down[i]) / (2.0 * h), row = cj * s->scale[i], column = s->scale[j];
            const double off = fabs(J[i * n + j] - want) * column / row;
            worst = fmax(worst, off);
            if (!(off < 1e-5))
                fail_msg("row %d, column %d of %d: %g, differences give %g", i, j, n, J[i * n + j], want);
        }
    }
    print_message("worst entry off by %.1e of its row\n", worst);
    free(J);
    free(up);
    free(down);
    circuit_shot_free(s);
}

static void jacobian_is_the_residuals(void **state)
{
    (void)state;
    check_jacobian(busy_shot(false));
    circuit_shot *s = busy_shot(true);
    assert_true(s->model.melted);
    check_jacobian(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_as_a_dense_matrix),
        cmocka_unit_test(singular_is_said),
        cmocka_unit_test(jacobian_is_the_residuals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
