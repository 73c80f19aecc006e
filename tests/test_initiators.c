/* SPDX-License-Identifier: BSD-3-Clause */
/* What begins a gouge (cases/initiators): each grain makes its scene, as high as its file says, and a slider that comes
 * down on a smooth rail marks it more if it is tilted. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/case/case.h"
#include "coupling/gouge/impact_scene.h"
#include "program_common.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define INITIATORS CASES "/initiators"

typedef struct {
    const char *file;
    double lowest, highest; /* of what is stated, above the rail; a pit's depth below it [m] */
    bool pit;
} initiator;

static const initiator all[] = {
    { "ridge", 3e-6, 15e-6, false }, { "deposit", 10e-6, 60e-6, false }, { "grit", 63e-6, 200e-6, false },
    { "pit", 50e-6, 50e-6, true },   { "rim", 0.27e-3, 0.31e-3, false },
};

/* The grain's box lies within what its file says of such grains; a pit is a hole in the rail. */
static void test_grains(void **state)
{
    (void)state;
    static const char *const dirs[] = { CASES "/materials" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET | CASE_FOR_SCENE };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        char path[300];
        breech_case *c = NULL;
        char *errors = NULL;
        gouge_scene s;
        double lo[3], hi[3];
        snprintf(path, sizeof path, INITIATORS "/%s.yaml", all[k].file);
        if (case_read(path, NULL, 0, &how, &c, &errors).code != STATUS_OK) fail_msg("%s", errors ? errors : path);
        const case_impact given = case_inputs_of(c).onset.impact;
        OK(gouge_scene_bodies(&given, &s));
        assert_true((s.grain == GOUGE_PIT) == all[k].pit);
        if (!all[k].pit) {
            mpm_solid_bounds(&s.scene.solid[s.scene.body[s.grain].solid], lo, hi);
            assert_true(hi[1] >= all[k].lowest * (1.0 - 1e-9) && hi[1] <= all[k].highest * (1.0 + 1e-9));
        } else {
            assert_true(given.particle.height >= all[k].lowest && given.particle.height <= all[k].highest);
        }
        assert_true(given.scene.contact_pressure == 23e6 && s.gauged);
        gouge_scene_free(&s);
        case_free(c);
    }
}

/* [J] in the rail, of a slice of coarse cells, 3 us. */
static double plastic_work(const char *file)
{
    char command[400];
    snprintf(command, sizeof command,
             "scene " INITIATORS "/%s.yaml -o %s --force --quiet --threads 1 --set scene.cell='0.25 mm' --set "
             "scene.window.z.hi='0.25 mm' --set scene.end_time='3 us' --set output.snapshots=0 --set output.report=no",
             file, file);
    assert_int_equal(run(command), 0);
    cJSON *s = summary_of(file);
    const cJSON *flow = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(s, "probes"), "flow");
    const double work = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(flow, "impulse"), 0)->valuedouble;
    cJSON_Delete(s);
    return work;
}

/* A slider that closes on a smooth rail marks it; one that comes down on its front edge more: here 29 times. */
static void test_smooth_rail(void **state)
{
    (void)state;
    const double level = plastic_work("closing"), tilted = plastic_work("tilted");
    print_message("level %.3g J, tilted %.3g J\n", level, tilted);
    assert_true(level > 1e-6 && tilted > 2.0 * level);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_grains), cmocka_unit_test(test_smooth_rail) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
