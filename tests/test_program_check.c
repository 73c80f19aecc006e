/* SPDX-License-Identifier: BSD-3-Clause */
/* The program from outside: what `breech check` says and refuses, and that a run refuses the same before it begins. */
#include "full_common.h"
#include "program_common.h"

/* Is each of these commands, a blank between two, among those that `breech check` has just said the case is ready for?
 */
static void assert_ready(bool want, const char *commands)
{
    char *out = NULL, name[20];
    OK(host_file_read("out.txt", &out, NULL));
    char *line = strstr(out, "\nready for: breech ");
    assert_non_null(line);
    line[strcspn(line + 1, "\n") + 1] = '\0';
    for (int n = 0; sscanf(commands, " %18[a-z]%n", name + 1, &n) == 1; commands += n) {
        name[0] = ' ';
        const char *at = strstr(line, name);
        if ((at && strchr(",", at[strlen(name)])) != want) fail_msg("%s:%s", name, line);
    }
    free(out);
}

/* Taken before: what makes no sense. */
static void test_senseless(void **state)
{
    (void)state;
    const struct {
        const char *yaml, *says;
    } wrong[] = {
        { "rail: {temperature: 1500 K}", ":3:21: rail.temperature = 1500 K: ofhc_copper_half_hard melts at 1356 K" },
        { "armature: {initial_temperature: 1500 K}",
          ":3:33: armature.initial_temperature = 1500 K: al7075_t651_limited melts" },
        { "treatments: [{name: a, preheat: {temperature: 400 K}}, {name: a}]",
          ":3:63: treatments[1].name = a: the same as treatments[0]" },
        { "treatments: [{name: untreated, preheat: {temperature: 400 K}}]", ":3:21: treatments[0].name = untreated" },
        { "treatments: [{name: hot, preheat: {temperature: 1400 K}}]",
          "preheat.temperature = 1400 K: ofhc_copper_half_hard melts" },
        { "treatments: [{name: none, polish: {size: 1}}]", "treatment `none`: changes nothing of the rail" },
        { "title: \"caf\xe9\"", ":3:13: not valid YAML" },
        { "populations: [{density: 4 1/m, radius_median: 0.5 mm, radius_spread: 3}]",
          ":3:15: populations[0], its largest grains, of 20 mm" },
        { "name: ..", ":3:7: name = ..: must have a letter" },
        { "current_profiles: [{file: huge.csv}]", "huge.csv:2.current = 1e+12 A: must be" },
        { "study: {max_scenes: 1}", ":3:21: study.max_scenes = 1: for 1 kinds" },
        { "study: {shots: 1000}", "study.shots: shot " },
        { "output: {snapshots: 1.5}", ":3:21: output.snapshots = 1.5: must be a whole number" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fresh_folder("senseless");
        FILE *f = fopen("senseless/case.yaml", "w");
        fprintf(f, "base: %s\n%s\n%s\n", SHOT, strstr(wrong[i].yaml, "name: ..") ? "" : "name: senseless",
                wrong[i].yaml);
        fclose(f);
        OK(host_file_write("senseless/huge.csv", "0,0\n1e-3,1e12\n2e-3,0\n", 22));
        const bool runs = strncmp(wrong[i].yaml, "study", 5) == 0; /* what a run found after its shot */
        if (runs) assert_int_equal(run("onset senseless -o senseless/out"), 2);
        assert_false(exists("senseless/out"));
        assert_int_equal(run("check senseless"), 2);
        if (!contains("err.txt", wrong[i].says)) fail_msg("%s: not `%s`", wrong[i].yaml, wrong[i].says);
    }
    assert_int_equal(run("check " SHOT " --set output.snapshots=1e1"), 0);
    assert_int_equal(run("check " CASES "/rail_life"), 0);
    assert_ready(true, "shot scene life inductance");
    assert_ready(false, "strike vessel onset compare sweep");
    assert_int_equal(run("check " SHOT " --set study.shots=3"), 0);
    assert_ready(true, "shot scene onset inductance");
    assert_ready(false, "strike life vessel compare sweep");
    assert_int_equal(run("check " CASES "/shot_target --set 'optimise={goal: velocity}' "
                         "--set 'strike.velocity=1 km/s'"), /* of the arrival, not of the muzzle */
                     0);
    assert_ready(true, "strike inductance");
    assert_ready(false, "shot");
    assert_int_equal(run("check " SHOT " --set study.shots=3"), 0);
    assert_false(contains("out.txt", "warning: study.max_scenes"));
    assert_true(contains("out.txt", " ns a point and step") && contains("out.txt", ", as just measured"));
    assert_true(contains("out.txt", "likely: 1.8 times that") && contains("out.txt", "\n  likely some "));
    /* one grain: what one whole crater leaves of three is enough for a bracket, of two it is not */
    assert_int_equal(run("check " SHOT " --set study.craters=1 --set study.max_scenes=2"), 0);
    assert_true(contains("out.txt", "study.max_scenes = 2: less 1 for whole craters it leaves 1"));
    assert_int_equal(run("check " SHOT " --set study.craters=1 --set study.max_scenes=3"), 0);
    assert_false(contains("out.txt", "warning: study.max_scenes"));
}

/* What this command does not read is no error of it; what has no effect on it is a warning. */
static void test_read_by_others(void **state)
{
    (void)state;
#define FAST SHOT " --set armature.velocity='2.5 km/s' -o fast --force --quiet"
    assert_int_equal(run("shot " FAST), 0);
    assert_int_equal(run("onset " FAST), 2);
    assert_true(contains("err.txt", "armature.velocity = 2.5 km/s: the search would end below it: raise "));
#undef FAST
#define GRADIENT " --set rail.resistance_gradient='0.2 mohm/m'"
    assert_int_equal(run("check " SHOT GRADIENT), 0);
    assert_true(contains("out.txt", "rail.resistance_gradient has no effect with rail.level = diffusing"));
    assert_int_equal(run("check " SHOT " --set rail.level=constant --set rail.inductance_gradient='0.5 uH/m'" GRADIENT),
                     0);
    assert_false(contains("out.txt", "no effect"));
#undef GRADIENT
}

static void test_check(void **state)
{
    (void)state;
    assert_int_equal(run("check " SHOT), 0);
    assert_true(contains("out.txt", "12 sites"));
    assert_true(contains("out.txt", "at most 12 scenes, of which 2 are kept for whole craters"));
    assert_int_equal(run("check cases/pulse_unit_200kJ"), 0); /* shipped, and not here */
    assert_true(contains("out.txt", "/cases/pulse_unit_200kJ/case.yaml"));
    assert_int_equal(run("check cases/../cases/pulse_unit_200kJ"), 2);
    assert_int_equal(system("echo '{base: pulse_unit_200kJ, name: own, title: my own unit}' > own.yaml"), 0);
    assert_int_equal(run("check own.yaml"), 0);
    assert_true(contains("out.txt", "own.yaml: my own unit"));
    assert_int_equal(system("echo '{base: pulse_unit_300kJ, name: own}' > own.yaml"), 0);
    assert_int_equal(run("check own.yaml"), 2);
    assert_int_equal(run("check " CASES "/wu2017"), 0);
    assert_true(contains("out.txt", "cells a radius"));
    assert_int_equal(run("check " CASES "/wu2017/coarse.yaml"), 0);
    assert_int_equal(run("check " TINY), 2);            /* ends before its grooves could be gauged */
    assert_int_equal(run("check " TINY " --scene"), 0); /* which `breech scene` does not ask for */
    assert_true(contains("out.txt", "bodies:") && contains("out.txt", "armature"));
}

/* What a comparison and its random shots take: time, scenes, memory; what of it is too fine. */
static void test_check_says_what_a_study_takes(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    assert_int_equal(run("check " CASES "/treatments"), 0);
    assert_true(contains("out.txt", "onset, 500 m/s") && contains("out.txt", "1 population, at most"));
    assert_true(contains("out.txt", "\nwarm rail, 500 m/s, "));
    assert_true(contains("out.txt", "compare: 6 surfaces, at most 12 scenes each"));
    assert_false(contains("out.txt", "thinner than a cell"));
    assert_true(contains("out.txt", "random shots: 100000 histories, at most 1.2e+06 grains, 0 s\n"));
    assert_int_equal(run("check " CASES "/treatments --set 'populations[0].density=1e6 1/m'"), 0);
    assert_true(contains("out.txt", "at most 2.9e+11 grains, 12 h "));
    assert_int_equal(run("check " CASES "/treatments --processes 2"), 0); /* what they take together */
    assert_true(contains("out.txt", "\nmemory: 2 scenes side by side take 0."));
    assert_int_equal(run("check " CASES "/treatments --processes 1"), 0);
    assert_false(contains("out.txt", "\nmemory: "));
    /* 512 of 3 GB fit nowhere where tests run */
    assert_int_equal(run("check " CASES "/treatments --processes 256 --set study.fine_cells_per_radius=16"), 0);
    assert_true(contains("out.txt", "\nwarning: for 256 processes there is no memory: "));
    assert_int_equal(run("check " CASES "/treatments --set 'treatments[1].coating[0].thickness=50 um'"), 0);
    assert_true(contains("out.txt", "warning: steel overlay: 50 um of steel_4340 has 0.3 cells across: "));
    assert_true(contains("out.txt", "scene.cells_per_layer = 2 gives it cells of its own, for some 52 times the time"));
    assert_int_equal(run("check " CASES "/treatments --set 'treatments[1].coating[0].thickness=5 um'"), 0);
    assert_true(contains("out.txt", "steel_4340 has 0.03 cells across: "));
    assert_false(contains("out.txt", "scene.cells_per_layer = 2 gives")); /* too many levels */
    assert_int_equal(run("check " CASES "/treatments --set 'treatments[1].coating[0].thickness=50 um' "
                         "--set scene.cells_per_layer=2"),
                     0);
    assert_false(contains("out.txt", "cells across: "));
    assert_true(contains("out.txt", ", a layer's own cells where it flows (scene.cells_per_layer)"));
}

static void test_check_refuses_what_fits_nowhere(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    assert_int_equal(run("check " CASES "/sphere_plate --set scene.cell='0.005 mm'"), 2); /* 30 TB */
    assert_true(contains("err.txt", "take larger cells"));
    assert_int_equal(run("scene " CASES "/sphere_plate --set scene.cell='0.005 mm' -o too_large"), 2);
    assert_false(exists("too_large"));
    assert_int_equal(run("check " SHOT " --set study.fine_cells_per_radius=100"), 2);
    assert_true(contains("err.txt", "100 cells a radius") && contains("err.txt", " GB"));
}

/* What shows only when the scene is made, and nothing is written before. */
static void test_check_refuses_what_cannot_be_made(void **state)
{
    (void)state;
    static const struct {
        const char *more, *says;
    } wrong[] = {
        { "cavities: [{name: gas, place: 1 1 1 mm}]",
          "made/case.yaml:7:33: scene.cavities[0].place: cavity `gas`: there is no void at (0.001, 0.001, 0.001) m" },
        { "cavities: [{name: gas, place: -1 1 1 mm}]",
          "made/case.yaml:7:33: scene.cavities[0].place: cavity `gas` is open" },
        { "cavities: [{name: gas, place: 1 1 1 m}]", "made/case.yaml:7:33: scene.cavities[0].place: cavity `gas`: " },
        { "refine: [{around: wall, within: 1 mm}]\n  cavities: [{name: gas, place: 1 1 1 m}]",
          "made/case.yaml:7:11: scene.refine: a scene with cavities has cells of one size" },
        { "bodies: [{name: sea, material: water, piston_mass: 0.01 kg/m2, piston_velocity: 1 m/s, tube_length: 1 m,\n"
          "    shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}}]",
          "made/case.yaml:7:103: scene.bodies[0].tube_length: body `sea`: a tube_length of 1 m would take" },
    };
    fresh_folder("made");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[1000];
        const bool own = strncmp(wrong[i].more, "bodies", 6) == 0;
        snprintf(text, sizeof text, "name: made\nscene:\n  end_time: 1 us\n  cell: 0.5 mm\n%s%s\n  %s\n",
                 own ? "  # its own\n  # bodies" : "  bodies:\n",
                 own ? "" : "    - {name: wall, material: ofhc_copper, shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}}",
                 wrong[i].more);
        OK(host_file_write("made/case.yaml", text, strlen(text)));
        assert_int_equal(run("check made"), 2);
        if (!contains("err.txt", wrong[i].says)) fail_msg("check does not say %s", wrong[i].says);
        assert_int_equal(run("scene made -o made/out"), 2);
        if (!contains("err.txt", wrong[i].says)) fail_msg("scene does not say %s", wrong[i].says);
        assert_false(exists("made/out"));
    }
    /* of a study's scenes too */
    assert_int_equal(run("check " SHOT " --set scene.transfer=pic --set scene.courant=0.55"), 2);
    assert_true(contains("err.txt", "--set scene.courant=0.55: scene.courant = 0.55: must be in (0, 0.5]"));
    assert_int_equal(run("onset " SHOT " --set scene.transfer=pic --set scene.courant=0.55 -o made/out"), 2);
    assert_false(exists("made/out"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_senseless),
        cmocka_unit_test(test_read_by_others),
        cmocka_unit_test(test_check),
        cmocka_unit_test(test_check_says_what_a_study_takes),
        cmocka_unit_test(test_check_refuses_what_fits_nowhere),
        cmocka_unit_test(test_check_refuses_what_cannot_be_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
