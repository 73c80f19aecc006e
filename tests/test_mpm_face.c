/* SPDX-License-Identifier: BSD-3-Clause */
/* Depth of a node below a plane face, from the volume and the face that belong to the node (mpm/grid/face_depth.h). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "mpm/grid/face_depth.h"
#include "near_common.h"
#include "random_common.h"

static face_depths table;
static uint64_t seed = 1;

static double between(double lo, double hi)
{
    return random_between(&seed, lo, hi);
}

/* Some normals lie along a plane or an axis of the grid, some nearly. */
static void draw_normal(int i, double n[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = k == i % 3 ? 1 : between(0, 1) * (i % 5 == 0 ? 0.1 : 1) * (i % 7 != 0);
        square += n[k] * n[k];
    }
    for (int k = 0; k < 3; k++) n[k] /= sqrt(square);
}

/* The weight's integral is the whole at one end and a half in the middle, and w is its slope. */
static void test_weight(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        double n[3], F[3], w[3];
        draw_normal(i, n);
        const double d = between(-1, 1), step = 1e-4;
        for (int k = 0; k < 3; k++) mpm_face_weight(n, d + (k - 1) * step, &F[k], &w[k]);
        assert_near(F[2] - F[0], 2 * step * w[1], 1e-4 * step); /* 1e-4: rounding of the narrowest hats */
        mpm_face_weight(n, 0, &F[0], &w[0]);
        assert_near(F[0], 0.5, 1e-9);
        mpm_face_weight(n, 1.8, &F[0], &w[0]);
        assert_near(F[0], 1, 1e-9);
    }
}

/* Two bodies that touch along a plane have depths of opposite sign: within two hundredths of a cell, less where the
 * weight is so small that little hangs on it; exactly along an axis of the grid. */
static void test_depth(void **state)
{
    (void)state;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        double n[3], F[2], w[2];
        draw_normal(i, n);
        const double d = between(-0.95, 0.95);
        mpm_face_weight(n, d, &F[0], &w[0]);
        mpm_face_weight(n, -d, &F[1], &w[1]);
        const double depth = face_depth(&table, n, F[0] / w[0]), other = face_depth(&table, n, F[1] / w[1]);
        worst = fmax(worst, fmax(fabs(depth - d), fabs(depth + other)) * fmin(w[0], 0.2) / 0.2);
    }
    print_message("largest error of a depth %.4f cells\n", worst);
    assert_true(worst < 0.02);
    for (double d = -1 + 1e-6; d < 1; d += 0.01) {
        const double F = d < 0 ? 0.5 * (1 + d) * (1 + d) : 0.5 + d - 0.5 * d * d, n[3] = { 0, 1, 0 };
        assert_near(face_depth(&table, n, F / (1 - fabs(d))), d, 1e-9);
    }
}

static int make_table(void **state)
{
    (void)state;
    mpm_face_depths_make(&table);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_weight), cmocka_unit_test(test_depth) };
    return cmocka_run_group_tests(tests, make_table, NULL);
}
