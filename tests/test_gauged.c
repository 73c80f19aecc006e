/* SPDX-License-Identifier: BSD-3-Clause */
/* The program on scenes that end once the growth of their groove is known. */
#include "full_common.h"
#include "program_common.h"

/* A scene that ends at its second gauge, 28 radii of way: the class is that of the growth, beyond its scatter or not.
 */
#define GAUGED                                                                                                     \
    TINY " --set particle.radius='0.2 mm' --set scene.velocity='2.4 km/s' --set scene.cells_per_radius=1.2 --set " \
         "scene.coarse_cell='1.2 mm' --set scene.levels=3 --set "                                                  \
         "scene.end_time='3.4 us' "

static void test_gauged(void **state)
{
    (void)state;
    fresh_folder("scene");
    const double gauge = 28 * 0.2e-3 / 2400.0;
    const char *const scatter[] = { "0", "10" };
    for (int i = 0; i < 2; i++) {
        char command[1500];
        snprintf(command, sizeof command,
                 "scene " GAUGED "-o scene/gauged%d --set output.snapshots=0 --set scene.stop_when_gauged=yes --set "
                 "scene.growth_scatter=%s",
                 i, scatter[i]);
        assert_int_equal(run(command), 0);
        char dir[40];
        snprintf(dir, sizeof dir, "scene/gauged%d", i);
        cJSON *a = summary_of(dir);
        const double growth = number(a, "groove_growth");
        assert_true(number(a, "end_time") >= gauge && number(a, "end_time") < 1.1 * gauge);
        const bool tear_drop = growth > 0.0 && number(a, "length_over_width") < 4.0;
        assert_text(a, "class", i ? "undecided" : tear_drop ? "gouge" : "scratch");
        assert_true(number(a, "gauge_length_over_width") == number(a, "length_over_width"));
        /* what tells furrow from tear-drop, of the crater as it was then */
        assert_true(fabs(number(a, "growth_per_way") / (growth / 2400.0) - 1.0) < 1e-9);
        assert_true(number(a, "front_speed_ratio") > 0.1 && number(a, "front_speed_ratio") < 1.2);
        assert_true(
            fabs(number(a, "length_over_width") * number(a, "crater_width") / number(a, "crater_length") - 1.0) < 1e-9);
        cJSON_Delete(a);
    }
    /* the whole scene, whatever it writes on the way, has the same growth, and goes on */
    assert_int_equal(run("scene " GAUGED "-o scene/whole --set output.snapshots=3 --set scene.growth_scatter=0"), 0);
    cJSON *whole = summary_of("scene/whole"), *gauged = summary_of("scene/gauged0");
    assert_true(number(whole, "groove_growth") == number(gauged, "groove_growth"));
    assert_true(number(whole, "front_speed_ratio") == number(gauged, "front_speed_ratio"));
    /* and the class of its crater as it was then, not of what came of it */
    assert_true(number(whole, "gauge_length_over_width") == number(gauged, "length_over_width"));
    assert_true(number(whole, "length_over_width") != number(gauged, "length_over_width"));
    assert_text(whole, "class", cJSON_GetObjectItemCaseSensitive(gauged, "class")->valuestring);
    assert_true(number(whole, "steps") > number(gauged, "steps"));
    assert_text(whole, "reason", cJSON_GetObjectItemCaseSensitive(gauged, "reason")->valuestring);
    cJSON_Delete(whole);
    cJSON_Delete(gauged);
    /* one that ends before, its groove alive, has the class of its crater alone */
    assert_int_equal(run("scene " GAUGED "-o scene/early --set output.snapshots=0 --set scene.end_time='2 us'"), 0);
    cJSON *early = summary_of("scene/early");
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(early, "gauge_length_over_width")));
    assert_text(early, "class", cJSON_GetObjectItemCaseSensitive(early, "crater_class")->valuestring);
    assert_text(early, "reason", cJSON_GetObjectItemCaseSensitive(early, "crater_reason")->valuestring);
    cJSON_Delete(early);
    run_script("read_gauged.py", BREECH_TESTS "/../python scene/gauged0");
}

/* Under a contact face of 13 grain radii the groove loses its power because the face leaves it: nobody knows whether it
 * would grow.  Under a long one it does. */
static void test_short_face(void **state)
{
    (void)state;
    fresh_folder("face");
    for (int i = 0; i < 2; i++) {
        char command[1500], dir[40];
        snprintf(dir, sizeof dir, "face/%d", i);
        snprintf(command, sizeof command,
                 "scene " GAUGED "-o %s --set output.snapshots=0 --set scene.stop_when_gauged=yes --set "
                 "scene.contact_pressure='300 MPa' --set armature.head_thickness='2 mm' --set "
                 "armature.chamfer_height='0.5 mm' --set armature.length='%s mm'",
                 dir, i ? "3.4" : "8");
        assert_int_equal(run(command), 0);
        cJSON *s = summary_of(dir);
        const double growth = number(s, "groove_growth");
        print_message("growth %.3g a microsecond\n", 1e-6 * growth);
        assert_true(i ? growth < 0.0 : growth > 0.0);
        assert_text(s, "class", i ? "undecided" : "gouge");
        const char *reason = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(s, "reason"));
        if (i) assert_non_null(strstr(reason, "contact face's tail"));
        cJSON_Delete(s);
    }
}

/* Past its second gauge this groove takes more than four times the power it took at the first: it does without the
 * finest cells then, and everything before is the same. */
static void test_cells_grow(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    fresh_folder("grow");
    cJSON *s[2];
    for (int grow = 0; grow < 2; grow++) {
        char command[1500], dir[40];
        snprintf(command, sizeof command,
                 "scene " GAUGED "-o grow/%d --set output.snapshots=0 --set scene.end_time='7 us' "
                 "--set scene.contact_pressure='300 MPa' "
                 "--set armature.width='20 mm' --set scene.cells_grow=%s",
                 grow, grow ? "yes" : "no");
        assert_int_equal(run(command), 0);
        snprintf(dir, sizeof dir, "grow/%d", grow);
        s[grow] = summary_of(dir);
    }
    assert_true(number(s[0], "groove_growth") == number(s[1], "groove_growth"));
    assert_true(number(s[1], "particle_steps") < 0.95 * number(s[0], "particle_steps"));
    assert_true(fabs(number(s[1], "crater_length") / number(s[0], "crater_length") - 1.0) < 0.2);
    for (int i = 0; i < 2; i++) cJSON_Delete(s[i]);
    run_script("read_grown.py", BREECH_TESTS "/../python grow/0 grow/1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gauged),
        cmocka_unit_test(test_short_face),
        cmocka_unit_test(test_cells_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
