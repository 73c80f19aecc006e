/* SPDX-License-Identifier: BSD-3-Clause */
/* A small scene through the runner: a dying groove ends early. */
#include "shelf_common.h"

static const char *const SLOW[] = { "scene.velocity=0.6 km/s", "scene.end_time=11 us", "scene.contact_pressure=5 MPa",
                                    "scene.stop_when_settled=no" }; /* dead or not: that is another end */

/* A dying groove is not driven to its second gauge, and is no gouge. */
static void test_dies_early(void **state)
{
    (void)state;
    scene_shelf shelf = { .oldest = 0 };
    const run_counted slow = run_small(SLOW, true, "output.snapshots=0", &shelf);
    const double gauge = 28 * 0.2e-3 / 600.0, half = 22 * 0.2e-3 / 600.0;
    print_message("over at %.2f of the way to the second gauge: %s\n", slow.hit.result.end_time / gauge,
                  slow.hit.result.reason);
    assert_true(slow.hit.result.end_time >= half && slow.hit.result.end_time < 0.9 * gauge);
    assert_true(slow.hit.result.class == DAMAGE_SCRATCH || slow.hit.result.class == DAMAGE_NONE);
    assert_true(gouge_growth_folds(slow.hit.result.groove_growth, 0.2e-3, 600.0) < -0.5);
    OK(output_history_close(slow.rows));
}

/* It ends where it ends, however often it is shown; the last snapshot is that of its end. */
static void test_shown_or_not(void **state)
{
    (void)state;
    const char *const settles[] = { SLOW[0], SLOW[1], SLOW[2], "scene.stop_when_settled=yes" };
    scene_shelf none = { .oldest = 0 }, some = none;
    const run_counted plain = run_small(settles, false, "output.snapshots=0", &none),
                      shown = run_small(settles, false, "output.snapshots=20", &some);
    print_message("over at %.3f us of 11, %d snapshots\n", 1e6 * shown.hit.result.end_time, shown.snapshots);
    assert_true(plain.hit.result.end_time == shown.hit.result.end_time);
    assert_true(plain.hit.result.severity == shown.hit.result.severity);
    assert_int_equal(shown.snapshots, 1 + (int)(shown.hit.result.end_time / (11e-6 / 19.0)) + 1);
    const run_counted once = run_small(settles, false, "output.snapshots=1", &some),
                      twice = run_small(settles, false, "output.snapshots=2", &some);
    assert_int_equal(once.snapshots, 1);
    assert_int_equal(twice.snapshots, 2);
    OK(output_history_close(plain.rows));
    OK(output_history_close(shown.rows));
    OK(output_history_close(once.rows));
    OK(output_history_close(twice.rows));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dies_early),
        cmocka_unit_test(test_shown_or_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
