/* SPDX-License-Identifier: BSD-3-Clause */
/* breech scene --ensemble N: the same scene on shifted grids; its table against the scenes themselves, each of which is
 * the same as one of its own with that shift. */
#include "full_common.h"
#include "program_common.h"

#include "body_scenes.h"
#include "coupling/study/sampling/shifts.h"

#define ENSEMBLE TINY " --set output.snapshots=0 --set scene.end_time='2 us'"

/* ---- shifts and spreads ---- */

/* The first is the case's own; of 64 some eight lie in each eighth of the cube (at random 3 to 13 would). */
static void test_shifts(void **state)
{
    (void)state;
    const double own[3] = { 0.0, 0.25, 1.0 };
    double at[3];
    int in[8] = { 0 };
    study_shift_of(0, own, at);
    assert_memory_equal(at, own, sizeof own);
    for (int i = 1; i <= 64; i++) {
        study_shift_of(i, own, at);
        for (int k = 0; k < 3; k++) assert_true(at[k] >= 0.0 && at[k] < 1.0);
        in[(at[0] >= 0.5) + 2 * (at[1] >= 0.5) + 4 * (at[2] >= 0.5)]++;
    }
    for (int i = 0; i < 8; i++) {
        if (in[i] < 6 || in[i] > 10) fail_msg("%d of 64 shifts in an eighth of the cube", in[i]);
    }
}

static void test_spread(void **state)
{
    (void)state;
    const double value[] = { 3.0, NAN, 5.0, 10.0 }, none[] = { NAN, NAN };
    const shift_spread s = study_shift_spread(value, 4), one = study_shift_spread(value, 2),
                       no = study_shift_spread(none, 2);
    assert_int_equal(s.scenes, 3);
    assert_true(s.mean == 6.0 && s.least == 3.0 && s.largest == 10.0);
    assert_true(fabs(s.deviation - sqrt((9.0 + 1.0 + 16.0) / 2.0)) < 1e-15);
    assert_true(one.scenes == 1 && one.mean == 3.0 && isnan(one.deviation));
    assert_true(no.scenes == 0 && isnan(no.mean) && isnan(no.least) && isnan(no.largest));
}

/* ---- the program ---- */

static const cJSON *member(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    if (!item) fail_msg("no key %s", key);
    return item;
}

/* By hand from the values that its scenes have. */
static void assert_number(const cJSON *summary, const char *name)
{
    const cJSON *n = member(member(summary, "numbers"), name), *scene;
    double sum = 0.0, squares = 0.0, least = INFINITY, largest = -INFINITY;
    int k = 0;
    cJSON_ArrayForEach(scene, member(summary, "scenes"))
    {
        const double x = number(member(scene, "values"), name);
        if (isnan(x)) continue;
        k++;
        sum += x, squares += x * x;
        least = fmin(least, x), largest = fmax(largest, x);
    }
    assert_true(k > 1 && number(n, "scenes") == k);
    assert_true(fabs(number(n, "mean") - sum / k) <= 1e-12 * fabs(sum));
    const double variance = (squares - sum * sum / k) / (k - 1);
    if (fabs(pow(number(n, "deviation"), 2.0) - variance) > 1e-12 * squares)
        fail_msg("%s: deviation %g, want the root of %g", name, number(n, "deviation"), variance);
    assert_true(number(n, "least") == least && number(n, "largest") == largest);
}

/* The i-th scene is the one with its shift, to the last bit. */
static void assert_own(const cJSON *summary, int i)
{
    const cJSON *scene = cJSON_GetArrayItem(member(summary, "scenes"), i), *shift = member(scene, "grid_shift"), *value;
    char arguments[1500];
    int compared = 0;
    snprintf(arguments, sizeof arguments,
             "scene " ENSEMBLE " -o one --force --quiet --no-store --set 'scene.grid_shift=[%.17g, %.17g, %.17g]'",
             cJSON_GetArrayItem(shift, 0)->valuedouble, cJSON_GetArrayItem(shift, 1)->valuedouble,
             cJSON_GetArrayItem(shift, 2)->valuedouble);
    assert_int_equal(run(arguments), 0);
    cJSON *one = summary_of("one");
    assert_string_equal(cJSON_GetStringValue(member(one, "class")), cJSON_GetStringValue(member(scene, "class")));
    cJSON_ArrayForEach(value, member(scene, "values"))
    {
        const cJSON *own = cJSON_GetObjectItemCaseSensitive(one, value->string);
        if (!cJSON_IsNumber(own)) continue;
        if (own->valuedouble != value->valuedouble) fail_msg("scene %d: %s differs", i, value->string);
        compared++;
    }
    assert_true(compared > 12);
    cJSON_Delete(one);
}

static void test_table(void **state)
{
    (void)state;
    fresh_folder("store");
    fresh_folder("three");
    assert_int_equal(run("scene " ENSEMBLE " -o three --force --store store --ensemble 3 --set output.report=yes"), 0);
    cJSON *s = summary_of("three");
    assert_text(s, "kind", "ensemble");
    assert_text(s, "of", "scene");
    assert_int_equal(cJSON_GetArraySize(member(s, "scenes")), 3);
    static const char *const names[] = { "crater_length", "crater_width",  "crater_depth",  "crater_volume",
                                         "severity",      "peak_pressure", "peak_force[1]", "failed_volume.armature" };
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) assert_number(s, names[k]);
    assert_text(member(member(s, "numbers"), "crater_volume"), "unit", "m3");
    assert_true(number(member(member(s, "numbers"), "crater_volume"), "deviation") > 0.0);
    assert_own(s, 2);
    const cJSON *class;
    int classes = 0;
    cJSON_ArrayForEach(class, member(s, "classes")) classes += (int)class->valuedouble;
    assert_int_equal(classes, 3);
    assert_true(contains("three/report.html", "The ensemble"));
    assert_true(contains("three/report.html", "crater_volume"));
    /* a smaller one and a larger one take up its scenes */
    assert_int_equal(files_in("store", ".h5"), 3);
    assert_int_equal(run("scene " ENSEMBLE " -o two --force --store store --ensemble 2"), 0);
    assert_int_equal(files_in("store", ".h5"), 3);
    assert_true(contains("out.txt", "crater_volume"));
    cJSON *two = summary_of("two");
    assert_true(cJSON_Compare(member(cJSON_GetArrayItem(member(two, "scenes"), 1), "values"),
                              member(cJSON_GetArrayItem(member(s, "scenes"), 1), "values"), true));
    cJSON_Delete(two);
    cJSON_Delete(s);
}

/* Probes and bodies by their names, with their units. */
static void test_bodies(void **state)
{
    (void)state;
    fresh_folder("ball");
    OK(host_file_write("ball/case.yaml", body_scene_text, strlen(body_scene_text)));
    assert_int_equal(run("scene ball -o balls --force --quiet --no-store --ensemble 2 --set output.snapshots=0 --set "
                         "'scene.cell=0.25 mm'"),
                     0);
    cJSON *s = summary_of("balls");
    assert_text(s, "of", "bodies");
    static const char *const names[] = { "probes.push.peak", "probes.push.impulse[0]", "bodies.ball.velocity[0]",
                                         "probes.gauge.last.pressure" };
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) assert_number(s, names[k]);
    assert_text(member(member(s, "numbers"), "probes.push.peak"), "unit", "N");
    assert_text(member(member(s, "numbers"), "probes.push.impulse[0]"), "unit", "N s");
    assert_text(member(member(s, "numbers"), "bodies.ball.velocity[0]"), "unit", "m/s");
    assert_text(member(member(s, "numbers"), "probes.gauge.impulse[0]"), "unit", "Pa s");
    assert_true(number(member(member(s, "numbers"), "probes.push.peak"), "deviation") > 0.0);
    assert_int_equal(cJSON_GetArraySize(member(s, "classes")), 0);
    cJSON_Delete(s);
}

/* In plane strain the grid stays along y, on one level and on several. */
static void test_thin(void **state)
{
    (void)state;
    static const char *const cells[] = { "--set 'scene.window={y: {lo: 2 mm, hi: 2.25 mm}}'",
                                         "--set scene.levels=2 --set 'scene.window={y: {lo: 2 mm, hi: 3 mm}}'" };
    fresh_folder("thin");
    OK(host_file_write("thin/case.yaml", body_scene_text, strlen(body_scene_text)));
    for (int i = 0; i < 2; i++) {
        char command[1000];
        snprintf(command, sizeof command,
                 "scene thin -o thins --force --quiet --no-store --ensemble 2 --set output.snapshots=0 --set "
                 "'scene.cell=0.25 mm' --set 'scene.end_time=0.2 us' --set 'scene.probes=[]' --set "
                 "'scene.boundary={y: [symmetry, symmetry]}' %s",
                 cells[i]);
        if (run(command) != 0) {
            char *said = NULL;
            OK(host_file_read("err.txt", &said, NULL));
            fail_msg("%s", said);
        }
        cJSON *s = summary_of("thins");
        const cJSON *shift = member(cJSON_GetArrayItem(member(s, "scenes"), 1), "grid_shift");
        for (int k = 0; k < 3; k++) assert_true((cJSON_GetArrayItem(shift, k)->valuedouble == 0.0) == (k == 1));
        cJSON_Delete(s);
    }
}

/* Stopped as often as it takes and resumed: the same numbers as those of test_table. */
static void test_stop_and_resume(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    int code = 75, stops = 0;
    double seconds = 0.05; /* more every time: slow machines come to the end, fast ones are stopped */
    char command[1000];
    fresh_folder("parts");
    for (; code == 75 && stops < 30; stops += code == 75, seconds *= 1.4) {
        snprintf(command, sizeof command,
                 "scene " ENSEMBLE " -o parts/out --quiet --no-store --ensemble 2 --processes 1 --resume "
                 "--max-walltime %.3f",
                 seconds);
        code = run(command);
    }
    assert_int_equal(code, 0);
    print_message("stopped %d times\n", stops);
    assert_true(stops >= 1);
    cJSON *whole = summary_of("three"), *parts = summary_of("parts/out");
    for (int i = 0; i < 2; i++)
        assert_true(cJSON_Compare(member(cJSON_GetArrayItem(member(whole, "scenes"), i), "values"),
                                  member(cJSON_GetArrayItem(member(parts, "scenes"), i), "values"), true));
    cJSON_Delete(whole);
    cJSON_Delete(parts);
}

static void test_refused(void **state)
{
    (void)state;
    assert_int_equal(run("scene " ENSEMBLE " -o none --ensemble 1"), 2);
    assert_int_equal(run("scene " ENSEMBLE " -o none --set study.ensemble=1"), 2);
    assert_true(contains("err.txt", "no scatter"));
    assert_int_equal(run("shot " ENSEMBLE " -o none --ensemble 3"), 2);
    assert_int_equal(run("sweep " CASES "/sweep -o none --set study.ensemble=3"), 2);
    assert_true(contains("err.txt", "scene.grid_shift"));
    assert_false(exists("none"));
    assert_int_equal(run("check " SHOT " --set study.ensemble=3"), 0);
    assert_true(contains("out.txt", "on 3 grids"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shifts),  cmocka_unit_test(test_spread), cmocka_unit_test(test_table),
        cmocka_unit_test(test_bodies),  cmocka_unit_test(test_thin),   cmocka_unit_test(test_stop_and_resume),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
