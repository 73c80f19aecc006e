/* SPDX-License-Identifier: BSD-3-Clause */
/* Invalid operations, divisions by zero and overflows stop a scene that is run with the processor's traps on: nothing
 * in it may make a NaN or an infinity, not even where the result is thrown away (holes in blocks, empty nodes, bodies
 * that fail). */
#include "mpm_scenes.h"

#include <fenv.h>

int feenableexcept(int); /* of glibc */
int fedisableexcept(int);

enum { TRAPS = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW };

/* Split points, contact with friction, failure and a loose grain. */
static void run(const char *set, double speed, double cells)
{
    GOUGE_LOCAL(g);
    mpm *m;
    scene_gouge(&g, 0.5e-3 / cells, speed);
    strcpy(g.scene.instruction_set, set);
    g.scene.body[1].group = 2;
    if (mpm_create(&g.scene, 1, &m).code != STATUS_OK) return; /* a set that this machine lacks */
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(TRAPS);
    scene_steps(m, 150);
    fedisableexcept(TRAPS);
    const mpm_report r = mpm_state(m);
    assert_true(r.splits > 0 && mpm_body_state(m, 0).peak_plastic_strain > 0.1);
    mpm_free(m);
}

static void test_traps(void **state)
{
    (void)state;
    static const char *const sets[] = { "x86-64-v4", "x86-64-v3", "portable" };
    for (int i = 0; i < 3; i++) run(sets[i], 1500, full_tests() ? 2 : 1.25);
    run("", 3000, 1.25);
}

/* The traps are on: a division by zero does stop. */
static void test_caught(void **state)
{
    (void)state;
    volatile double zero = 0;
    feclearexcept(FE_ALL_EXCEPT);
    const volatile double gone = 1 / zero;
    (void)gone;
    assert_true(fetestexcept(FE_DIVBYZERO) != 0);
    feclearexcept(FE_ALL_EXCEPT);
    assert_true(feenableexcept(TRAPS) >= 0);
    assert_true((fedisableexcept(TRAPS) & TRAPS) == TRAPS);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_caught), cmocka_unit_test(test_traps) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
