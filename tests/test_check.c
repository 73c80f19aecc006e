/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech check` says that a case will take. */
#include "coupling/study/check.h"

#include "coupling/study/study.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "status_common.h"

/* A scene that is too large to be tried has the pace of the small one behind it, in both of its times. */
static void test_pace(void **state)
{
    (void)state;
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" }, *const fine[] = { "scene.cells_per_radius=9" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET };
    scene_estimate e[CHECK_MAX_ESTIMATES];
    case_inputs *in = NULL;
    char *errors = NULL;
    double rate;
    int n;
    if (case_inputs_read(BREECH_TESTS "/../cases/default_shot", fine, 1, &how, &in, &errors).code != STATUS_OK)
        fail_msg("%s", errors);
    OK(study_prepare(in));
    OK(study_check(in, 1, e, &n, &rate));
    assert_true(n > 1 && isfinite(rate) && e[0].needs.particles > 300000 && e[1].needs.particles < 300000);
    for (int i = 0; i < n; i++) {
        assert_true(fabs(e[i].seconds / (rate * e[i].steps * e[i].needs.work) - 1) < 1e-9);
        assert_true(fabs(e[i].likely / (CHECK_GROWTH * e[i].seconds) - 1) < 1e-9);
    }
    case_inputs_free(in);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_pace) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
