/* SPDX-License-Identifier: BSD-3-Clause */
/* breech sweep: every combination of the varied keys, each the same as a run of its own; errors before anything is
 * written; the error against the finest run. */
#include "coupling/host/outdir.h"
#include "coupling/study/study.h"
#include "tests/full_common.h"
#include "tests/output_common.h"

#include "tests/body_scenes.h"

#include <cJSON.h>
#include <sys/wait.h>

#define SHOT_CASE BREECH_TESTS "/../cases/pulse_unit_200kJ"
#define SCENE_CASE BREECH_TESTS "/../cases/sweep"
/* The shipped case made as short as it can be: what is tested is the sweep, not the scene. */
#define SHORT "--set scene.end_time='0.2 us' --set 'sweep.vary[0].values=[1, 1.2]' "

static int run(const char *arguments)
{
    char command[2000];
    snprintf(command, sizeof command, "%s %s >out.txt 2>err.txt", BREECH_PROGRAM, arguments);
    const int code = system(command);
    return WIFEXITED(code) ? WEXITSTATUS(code) : -1;
}

static cJSON *summary_of(const char *dir)
{
    char path[300], *text;
    snprintf(path, sizeof path, "%s/summary.json", dir);
    OK(host_file_read(path, &text, NULL));
    cJSON *root = cJSON_Parse(text);
    assert_non_null(root);
    free(text);
    return root;
}

static double number_in(const cJSON *object, const char *key)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, key);
    if (!cJSON_IsNumber(value)) fail_msg("no number `%s`", key);
    return value->valuedouble;
}

static const cJSON *run_at(const cJSON *summary, int i, const char *object)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(summary, "sweep");
    return cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(list, i), object);
}

/* Each output is, to the last bit, that of a run of its own. */
static void test_as_runs_of_their_own(void **state)
{
    (void)state;
    static const char *const charge[] = { "8 kV", "9.5 kV" }, *const mass[] = { "1 kg", "2000 g", "3 kg" };
    assert_int_equal(
        run("sweep " SHOT_CASE " -o sweep --force --quiet --set sweep=\"{of: shot, vary: ["
            "{key: bank.charge, values: [8 kV, 9.5 kV]}, {key: armature.mass, values: [1 kg, 2000 g, 3 kg]}],"
            " read: [peak_current, action, steps]}\""),
        0);
    cJSON *all = summary_of("sweep");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(all, "sweep")), 6);
    for (int i = 0; i < 6; i++) {
        char arguments[400];
        snprintf(arguments, sizeof arguments,
                 "shot " SHOT_CASE " -o one --force --quiet --set bank.charge='%s' --set armature.mass='%s'",
                 charge[i / 3], mass[i % 3]); /* the last key changes fastest */
        assert_int_equal(run(arguments), 0);
        cJSON *one = summary_of("one");
        const cJSON *output;
        assert_int_equal(cJSON_GetArraySize(run_at(all, i, "outputs")), 3);
        cJSON_ArrayForEach(output, run_at(all, i, "outputs"))
            assert_true(output->valuedouble == number_in(one, output->string));
        assert_true(number_in(run_at(all, i, "inputs"), "bank.charge") == (i < 3 ? 8000.0 : 9500.0));
        assert_true(number_in(run_at(all, i, "inputs"), "armature.mass") == 1.0 + i % 3); /* in SI: 2000 g too */
        assert_int_equal(cJSON_GetArraySize(run_at(all, i, "errors")), 0);                /* no resolution is varied */
        cJSON_Delete(one);
    }
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(cJSON_GetObjectItem(all, "units"), "bank.charge")),
                        "V");
    cJSON_Delete(all);
}

/* The lists side by side; a text stays a text; without `read` the first numbers of the study. */
static void test_together(void **state)
{
    (void)state;
    assert_int_equal(run("sweep " SHOT_CASE " -o sweep --force --quiet --set sweep=\"{of: shot, together: yes, vary: ["
                         "{key: bank.charge, values: [8 kV, 9 kV]}, {key: name, values: [low, high]}]}\""),
                     0);
    cJSON *all = summary_of("sweep");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(all, "sweep")), 2);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(run_at(all, 1, "inputs"), "name")), "high");
    assert_true(number_in(run_at(all, 1, "inputs"), "bank.charge") == 9000.0);
    assert_int_equal(cJSON_GetArraySize(run_at(all, 0, "outputs")), 6);
    assert_non_null(cJSON_GetObjectItem(run_at(all, 0, "outputs"), "peak_current"));
    cJSON_Delete(all);
}

/* Twenty numbers are all printed, each under its title, and so is a text that holds a bar. */
static void test_many_columns(void **state)
{
    (void)state;
    enum { COLUMNS = 20 };
    const summary_key *key[COLUMNS];
    const study *shot = study_find("shot");
    char *text, arguments[1600] = "sweep " SHOT_CASE " -o wide --force --set sweep=\"{of: shot, vary: [{key: title, "
                                  "values: ['low|8', 'the 9\\\" gun']}], read: [";
    int n = 0;
    for (const summary_key *k = shot->keys; k->name && n < COLUMNS; k++)
        if (k->kind == KEY_NUMBER && k->n == 1) key[n++] = k;
    assert_int_equal(n, COLUMNS);
    for (int k = 0; k < n; k++) {
        strcat(arguments, k > 0 ? ", " : "");
        strcat(arguments, key[k]->name);
    }
    strcat(arguments, "]}\"");
    assert_int_equal(run(arguments), 0);
    OK(host_file_read("out.txt", &text, NULL));
    for (int k = 0; k < n; k++)
        if (!strstr(text, key[k]->name)) fail_msg("no `%s` in\n%s", key[k]->name, text);
    if (!strstr(text, "\nlow|8 ") || !strstr(text, "time [s]")) fail_msg("%s", text);
    free(text);
    OK(host_file_read("wide/sweep.csv", &text, NULL)); /* quotes inside a text are doubled */
    if (!strstr(text, "\n\"the 9\"\" gun\",")) fail_msg("%s", text);
    free(text);
}

/* Many values take a while to read: the end of the time is seen there too. */
static void test_stopped(void **state)
{
    (void)state;
    assert_int_equal(run("sweep " SHOT_CASE
                         " -o stopped --force --quiet --max-walltime 1e-6 --set sweep=\"{of: shot, vary: "
                         "[{key: bank.charge, values: [8 kV]}]}\""),
                     75);
    char *text;
    OK(host_file_read("stopped/summary.json", &text, NULL));
    assert_non_null(strstr(text, "--max-walltime reached: before run 1 was read"));
    free(text);
    /* the time counts from the program's start: it is over when two thousand runs have been read to be checked */
    char volts[500] = "", masses[500] = "", arguments[1600];
    for (int k = 0; k < 44; k++) {
        snprintf(volts + strlen(volts), 12, "%s%d kV", k ? ", " : "", k + 1);
        snprintf(masses + strlen(masses), 12, "%s%d kg", k ? ", " : "", k + 1);
    }
    snprintf(arguments, sizeof arguments,
             "sweep " SHOT_CASE " -o stopped --force --quiet --max-walltime 0.03 --set sweep=\"{of: shot, vary: "
             "[{key: bank.charge, values: [%s]}, {key: armature.mass, values: [%s]}]}\"",
             volts, masses);
    assert_int_equal(run(arguments), 75);
    OK(host_file_read("stopped/summary.json", &text, NULL));
    assert_non_null(strstr(text, "--max-walltime reached: before run 1 was read"));
    free(text);
}

/* Bad input, exit code 2, and says so. */
static void refuses(const char *arguments, const char *says)
{
    char *text;
    const int code = run(arguments);
    OK(host_file_read("err.txt", &text, NULL));
    if (code != 2 || !strstr(text, says)) fail_msg("%s: exit code %d, %s", arguments, code, text);
    free(text);
}

/* What is wrong is said, with its value, before there is a folder. */
static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *sweep, *says;
    } wrong[] = {
        { "{of: shot, vary: [{key: bank.charge, values: [8 kV, -1 kV]}]}", "run 2 (bank.charge = -1 kV)" },
        { "{of: shot, vary: [{key: bank.charge, values: [8 kg]}]}", "is not a unit of V" },
        { "{of: shot, vary: [{key: bank.charg, values: [8 kV]}]}", "did you mean `charge`?" },
        { "{of: shot, vary: [{key: bank.charge, values: [8 kV]}], read: [peak_curent]}",
          "did you mean `peak_current`?" },
        { "{of: onset, vary: [{key: bank.charge, values: [8 kV]}]}",
          "must be one of shot, scene, strike, life, vessel, inductance" },
        { "{of: shot, together: yes, vary: [{key: bank.charge, values: [1 kV, 2 kV]}, {key: armature.mass, values: "
          "[1 kg]}]}",
          "1 values, vary[0] has 2" },
        { "{of: shot, vary: [{key: bank.charge, values: []}]}", "values is empty" },
        { "{of: shot}", "sweep.vary is empty" },
        { "{of: shot, vary: [{key: sweep.of, values: [scene]}]}", "cannot vary itself" },
        { "{of: shot, vary: [{key: bank.charge, values: [8 kV]}, {key: bank.charge, values: [9 kV]}]}",
          "sweep.vary[1].key = bank.charge: sets what vary[0] sets" },
        { "{of: shot, vary: [{key: bank.charge, values: [8 kV]}, {key: 'bank[0].charge', values: [9 kV]}]}",
          "sets what vary[0] sets, bank.charge" },
        { "{of: shot, vary: [{key: 'bank[0].charge', values: [8 kV]}, {key: bank, values: ['{charge: 9 kV}']}]}",
          "sweep.vary[1].key = bank: sets what vary[0] sets, bank[0].charge" },
        { "{of: shot, vary: [{key: 'bank[0].charge', values: [8 kV]}, {key: 'bank[1].charge', values: [-9 kV]}]}",
          "bank has one entry: bank[0]" }, /* two groups are not the same */
        { "{of: shot, vary: [{values: [1]}]}", "sweep.vary[0].key is missing" },
        { "{of: scene, vary: [{key: bank.charge, values: [8 kV]}]}", "`breech scene` needs it" },
    };
    assert_string_equal(study_command(&study_bodies), "scene"); /* what takes a place has no command of its own */
    assert_string_equal(study_command(&study_strike), "strike");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char arguments[600];
        snprintf(arguments, sizeof arguments, "sweep " SHOT_CASE " -o nothing --set sweep=\"%s\"", wrong[i].sweep);
        refuses(arguments, wrong[i].says);
        assert_int_equal(access("nothing", F_OK), -1);
        snprintf(arguments, sizeof arguments, "check " SHOT_CASE " --set sweep=\"%s\"", wrong[i].sweep);
        refuses(arguments, wrong[i].says);
    }
    refuses("sweep " SHOT_CASE " -o nothing", "section `sweep` is missing");
    for (int k = 0; k < STUDIES; k++) /* what is read unless told is there */
        for (const char *const *u = study_list[k]->usual; u && *u; u++)
            assert_true(output_number_exists(study_list[k]->keys, *u));
}

/* The place of an error is the value in the sweep's own file, not the key in the case that it builds on; and a run that
 * only the study itself knows to be impossible is told before the first one starts. */
static void test_places(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        { "base: " SHOT_CASE "\nsweep:\n  of: shot\n  vary:\n    - {key: armature.mass, values: [1 kg, 2 kg]}\n"
          "    - {key: bank.charge, values: [8 kV, -1 kV]}\n",
          "places/case.yaml:6:41: sweep.vary[1].values[1]: run 2 (armature.mass = 1 kg, bank.charge = -1 kV): "
          "bank.charge = -1 kV: must" },
        { "base: " BREECH_TESTS "/../cases/gel_droplet\n"
          "sweep: {of: vessel, vary: [{key: vessel.radius, values: [0.5 mm, 0.09 mm]}], read: [rupture_time]}\n",
          "places/case.yaml:2:66: sweep.vary[0].values[1]: run 2 (vessel.radius = 0.09 mm): vessel.bubbles fill more" },
        { "base: " BREECH_TESTS "/../cases/gel_droplet\n"
          "sweep: {of: vessel, vary: [{key: vessel.raduis, values: [0.5 mm]}], read: [rupture_time]}\n",
          "places/case.yaml:2:34: sweep.vary[0].key: run 1 (vessel.raduis = 0.5 mm): unknown key `raduis` in vessel" },
        { "base: " BREECH_TESTS "/../cases/rail_fatigue\nlife: {until: first, cycle: passage}\n"
          "sweep: {of: life, vary: [{key: life.speed, values: [0 m/s, 9 km/s]}, {key: life.friction, values: "
          "[0.2]}]}\n",
          "places/case.yaml:3:60: sweep.vary[0].values[1]: run 2 (life.speed = 9 km/s, life.friction = 0.2): "
          "life.speed = 9000 m/s: must lie below" },
        { "base: " SHOT_CASE "\nsweep: {of: shot, vary: [{key: bank.charge}]}\n",
          "places/case.yaml:2:26: sweep.vary[0].values is empty" },
    };
    fresh_folder("places");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char *text;
        OK(host_file_write("places/case.yaml", wrong[i].text, strlen(wrong[i].text)));
        assert_int_equal(run("sweep places -o nothing --quiet"), 2);
        OK(host_file_read("err.txt", &text, NULL));
        if (strncmp(text, wrong[i].says, strlen(wrong[i].says)) != 0) fail_msg("not %s but %s", wrong[i].says, text);
        free(text);
        assert_int_equal(access("nothing", F_OK), -1);
    }
}

/* The varied key is a resolution: errors are those against the finest run of the same other inputs. */
static void test_resolution(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    fresh_folder("cells_store");
    assert_int_equal(run("sweep " SCENE_CASE " " SHORT "-o cells --force --store cells_store"), 0);
    cJSON *all = summary_of("cells");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(all, "resolution")), "scene.cells_per_radius");
    for (int i = 0; i < 4; i++) {
        const int finest = i % 2 + 2; /* the speed changes fastest */
        const double y = number_in(run_at(all, i, "outputs"), "peak_temperature"),
                     exact = number_in(run_at(all, finest, "outputs"), "peak_temperature");
        assert_true(number_in(run_at(all, i, "errors"), "peak_temperature") == fabs(y - exact) / fabs(exact));
        assert_true((number_in(run_at(all, i, "errors"), "peak_temperature") == 0.0) == (i >= 2));
    }
    char *text;
    OK(host_file_read("out.txt", &text, NULL));
    assert_non_null(strstr(text, "error against the finest scene.cells_per_radius"));
    free(text);
    OK(host_file_read("cells/report.html", &text, NULL));
    assert_non_null(strstr(text, "Error against run time"));
    assert_non_null(strstr(text, "scene.&#8203;velocity [m/s]"));
    free(text);
    OK(host_file_read("cells/sweep.csv", &text, NULL));
    assert_int_equal(strncmp(text, "scene.cells_per_radius,scene.velocity [m/s],peak_pressure [Pa],", 63), 0);
    int lines = 0;
    for (const char *c = text; *c; c++) lines += *c == '\n';
    assert_int_equal(lines, 1 + 4);
    free(text);
    /* again, from the store: the same numbers, and no scene is computed */
    assert_int_equal(files_in("cells_store", ".h5"), 4);
    assert_int_equal(run("sweep " SCENE_CASE " " SHORT "-o again --force --store cells_store"), 0);
    OK(host_file_read("out.txt", &text, NULL));
    assert_null(strstr(text, "scene steps"));
    free(text);
    cJSON *again = summary_of("again");
    assert_true(cJSON_Compare(cJSON_GetObjectItem(all, "sweep"), cJSON_GetObjectItem(again, "sweep"), true));
    cJSON_Delete(all);
    cJSON_Delete(again);
}

/* Numbers of probes and bodies by their names, with the units that only a run tells: those of a run of its own. */
static void test_probes(void **state)
{
    (void)state;
    static const char *const paths[] = { "probes.push.peak", "probes.push.impulse[0]", "probes.gauge.last.pressure",
                                         "bodies.ball.velocity[0]", "steps" };
    char *text;
    fresh_folder("body");
    OK(host_file_write("body/case.yaml", body_scene_text, strlen(body_scene_text)));
#define SMALL "body --force --quiet --no-store --set output.snapshots=0 --set scene.end_time='0.3 us' "
#define SWEEP "--set sweep=\"{of: scene, vary: [{key: scene.cell, values: [0.6 mm, 0.5 mm]}], read: [%s]}\""
    assert_int_equal(run("sweep " SMALL "-o cells --set sweep=\"{of: scene, vary: [{key: scene.cell, values: [0.6 mm, "
                         "0.5 mm]}], read: [probes.push.peak, 'probes.push.impulse[0]', probes.gauge.last.pressure, "
                         "'bodies.ball.velocity[0]', steps]}\""),
                     0);
    assert_int_equal(run("scene " SMALL "-o one --set scene.cell='0.5 mm'"), 0);
    cJSON *all = summary_of("cells"), *one = summary_of("one");
    const cJSON *out = run_at(all, 1, "outputs"), *probes = cJSON_GetObjectItem(one, "probes"),
                *push = cJSON_GetObjectItem(probes, "push"), *gauge = cJSON_GetObjectItem(probes, "gauge"),
                *ball = cJSON_GetObjectItem(cJSON_GetObjectItem(one, "bodies"), "ball");
    const double expected[] = { number_in(push, "peak"),
                                cJSON_GetArrayItem(cJSON_GetObjectItem(push, "impulse"), 0)->valuedouble,
                                number_in(cJSON_GetObjectItem(gauge, "last"), "pressure"),
                                cJSON_GetArrayItem(cJSON_GetObjectItem(ball, "velocity"), 0)->valuedouble,
                                number_in(one, "steps") };
    assert_true(expected[0] > 0.0 && expected[3] > 0.0);
    for (int k = 0; k < 5; k++) assert_true(number_in(out, paths[k]) == expected[k]);
    OK(host_file_read("cells/sweep.csv", &text, NULL));
    assert_non_null(strstr(text, "probes.push.peak [N],probes.push.impulse[0] [N s],"));
    free(text);
    cJSON_Delete(all);
    cJSON_Delete(one);
    static const char *const wrong[][2] = { { "probes.gage.peak", "no such probe; it has push, gauge, dent" },
                                            { "probes.gauge.last.presure", "kind pressure has no such column" },
                                            { "bodies.bal.mass", "sweep.read[0]: run 1" },
                                            { "bodies.bal.mass", "no such body; it has wall, ball" },
                                            { "probes.gauge.peek", "no number of the summary of `breech scene`" } };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char arguments[600];
        snprintf(arguments, sizeof arguments, "sweep " SMALL "-o nothing " SWEEP, wrong[i][0]);
        assert_int_equal(run(arguments), 2);
        OK(host_file_read("err.txt", &text, NULL));
        if (!strstr(text, wrong[i][1])) fail_msg("%s: %s", wrong[i][0], text);
        free(text);
    }
#undef SMALL
#undef SWEEP
}

/* A text is no axis: outputs are drawn over the first key that is a number, a curve for each text. */
static void test_drawn_over(void **state)
{
    (void)state;
    char *text;
    assert_int_equal(run("sweep " SHOT_CASE " -o drawn --force --quiet --set sweep=\"{of: shot, vary: ["
                         "{key: title, values: [one, other]}, {key: bank.charge, values: [8 kV, 9.5 kV]}],"
                         " read: [peak_current]}\""),
                     0);
    OK(host_file_read("drawn/plot-sweep-1.svg", &text, NULL));
    assert_non_null(strstr(text, ">bank.charge [kV]<"));
    assert_non_null(strstr(text, ">title one<"));
    assert_non_null(strstr(text, ">title other<"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_as_runs_of_their_own), cmocka_unit_test(test_together), cmocka_unit_test(test_stopped),
        cmocka_unit_test(test_many_columns),         cmocka_unit_test(test_refused),  cmocka_unit_test(test_places),
        cmocka_unit_test(test_resolution),           cmocka_unit_test(test_probes),   cmocka_unit_test(test_drawn_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
