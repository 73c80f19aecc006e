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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dies_early),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
