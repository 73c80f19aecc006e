/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech check` says that a case will take. */
#include "coupling/study/check.h"

#include "coupling/study/search/family.h"
#include "coupling/study/study.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Grains of one kind are searched together, whatever their sizes and whether a site or a population has them: what is
 * kept for whole craters goes by the kind. */
static void test_kinds(void **state)
{
    (void)state;
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const char *const sets[] = {
        "sites=[{position: 1 m, radius: 0.3 mm}, {position: 1.2 m, radius: 0.4 mm}, {position: 1.4 m, radius: 0.4 mm,"
        " height: 0.2 mm}, {position: 1.6 m, radius: 0.4 mm, material: steel_4340}]",
        "populations=[{density: 3 1/m, radius_median: 0.2 mm, radius_spread: 0.3},"
        " {density: 1 1/m, radius_median: 0.2 mm, radius_spread: 0.3, bond_strength: 50 MPa}]",
        "study.max_scenes=6",
    };
    static const struct {
        int sets, kinds;
        const char *warns; /* NULL: not at all */
    } of[] = { { 3, 4, "less 8 for whole craters it leaves 0 to the searches of 4 kinds of grain" }, { 0, 1, NULL } };
    for (int i = 0; i < 2; i++) {
        const case_options how = { dirs, 1, CASE_FOR_ONSET };
        case_inputs *in = NULL;
        char *errors = NULL, *said = NULL;
        size_t size = 0;
        if (case_inputs_read(BREECH_TESTS "/../cases/default_shot", sets, of[i].sets, &how, &in, &errors).code !=
            STATUS_OK)
            fail_msg("%s", errors);
        assert_int_equal(study_family_kinds(&in->onset), of[i].kinds);
        FILE *out = open_memstream(&said, &size);
        study_check_searches(in, out);
        fclose(out);
        if (of[i].warns ? !strstr(said, of[i].warns) : said[0] != '\0') fail_msg("%s", said);
        free(said);
        case_inputs_free(in);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_pace), cmocka_unit_test(test_kinds) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
