/* The program from outside: exit codes, refusals that write nothing, --set, summaries, stop and resume. */
#include "output_common.h"

#include "coupling/host/hdf5_file.h"
#include "coupling/host/outdir.h"
#include "coupling/host/progress.h"

#include <cJSON.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

#define CASES BREECH_TESTS "/../cases"
#define SHOT CASES "/default_shot"

/* A scene of a second or two: a stub of an armature over a short rail, one or two cells a radius. */
#define TINY                                                                                                  \
    SHOT " --set scene.cells_per_radius=1.5 --set scene.levels=2 --set scene.coarse_cell='0.8 mm' --set "     \
         "scene.growth=1.3 --set output.report=no"                                                            \
         " --set scene.fine_ahead='3 mm' --set scene.fine_width='3 mm' --set scene.rail_ahead='8 mm' --set "  \
         "armature.length='10 mm' --set armature.half_bore='6 mm' --set armature.width='10 mm' --set "        \
         "armature.head_thickness='6 mm' --set scene.rail_behind='1 mm' --set scene.rail_depth='4 mm' --set " \
         "scene.end_time='4 us'"

static int run(const char *arguments)
{
    char command[2000];
    snprintf(command, sizeof command, "BREECH_MATERIALS= %s %s >out.txt 2>err.txt", BREECH_PROGRAM, arguments);
    const int state = system(command);
    return WIFEXITED(state) ? WEXITSTATUS(state) : 1000;
}

static bool contains(const char *file, const char *text)
{
    char *all = NULL;
    OK(host_file_read(file, &all, NULL));
    const bool found = strstr(all, text) != NULL;
    free(all);
    return found;
}

static bool exists(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0;
}

static cJSON *summary_of(const char *dir)
{
    char path[200], *text = NULL;
    snprintf(path, sizeof path, "%s/summary.json", dir);
    OK(host_file_read(path, &text, NULL));
    cJSON *s = cJSON_Parse(text);
    free(text);
    assert_non_null(s);
    return s;
}

static void assert_text(const cJSON *s, const char *key, const char *want)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(s, key);
    assert_true(cJSON_IsString(item));
    assert_string_equal(item->valuestring, want);
}

static double number(const cJSON *s, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(s, key);
    if (!item) fail_msg("no key %s", key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* ---- usage ---- */

static void test_usage(void **state)
{
    (void)state;
    assert_int_equal(run("--help"), 0);
    assert_true(contains("out.txt", "breech onset"));
    assert_int_equal(run("--help scene"), 0);
    assert_int_equal(run("scene --help"), 0);
    assert_int_equal(run("--version"), 0);
    assert_true(contains("out.txt", "x86-64") || contains("out.txt", "portable"));
    assert_int_equal(run("--keys"), 0);
    assert_true(contains("out.txt", "cells_per_radius"));
    static const char *const wrong[] = { "",
                                         "fire " SHOT,
                                         "shot",
                                         "shot " SHOT " " SHOT,
                                         "shot " SHOT " --threads 0",
                                         "shot " SHOT " --threads two",
                                         "shot " SHOT " --max-walltime soon",
                                         "shot " SHOT " --max-walltime -1",
                                         "shot " SHOT " --frobnicate",
                                         "shot " SHOT " -o",
                                         "shot " SHOT " --force=yes",
                                         "shot " SHOT " --force --resume -o both",
                                         "compare " SHOT,
                                         "--help fire",
                                         "materials unobtainium",
                                         "report nowhere_at_all" };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        if (run(wrong[i]) != 2) fail_msg("breech %s: not refused with 2", wrong[i]);
        assert_false(contains("err.txt", "Sanitizer"));
    }
    assert_int_equal(run("compare " SHOT), 2);
    assert_true(contains("err.txt", "section `treatments` is missing"));
}

/* Every error of the case at once, with its place; nothing is written. */
static void test_bad_case(void **state)
{
    (void)state;
    fresh_folder("bad");
    FILE *f = fopen("bad/case.yaml", "w");
    fputs("name: bad\nrails: {height: 25 mm, thickness: 20 kg, separation: 25 mm}\nbarrel: {lenght: 3 m}\n"
          "armature: {mass: -1 kg}\nbank:\n  - {capacitance: 3 mF, charge: 10, inductance: 12 uH}\n",
          f);
    fclose(f);
    assert_int_equal(run("shot bad -o bad_out"), 2);
    assert_true(contains("err.txt", "bad/case.yaml:2:"));
    assert_true(contains("err.txt", "did you mean `length`"));
    assert_true(contains("err.txt", "armature.mass"));
    assert_true(contains("err.txt", "bank[0].charge"));
    assert_false(exists("bad_out"));
    assert_int_equal(run("shot nowhere.yaml -o bad_out"), 2);
    assert_int_equal(run("check bad"), 2);
    assert_int_equal(run("check " SHOT " --set armature.friction_law=film"), 2); /* without wear no film */
    assert_true(contains("err.txt", "armature.wear_fraction"));
    assert_int_equal(run("shot " SHOT " --set bank.charge=9 -o bad_out"), 2);
    assert_false(exists("bad_out"));
}

static void test_check_and_materials(void **state)
{
    (void)state;
    assert_int_equal(run("check " SHOT), 0);
    assert_true(contains("out.txt", "12 sites"));
    assert_int_equal(run("check " CASES "/wu2017"), 0);
    assert_true(contains("out.txt", "cells a radius"));
    assert_int_equal(run("check " CASES "/wu2017/coarse.yaml"), 0);
    assert_int_equal(run("materials"), 0);
    assert_true(contains("out.txt", "ofhc_copper"));
    assert_int_equal(run("materials ofhc_copper"), 0);
    assert_true(contains("out.txt", "yield_A"));
}

/* ---- runs ---- */

static void test_shot(void **state)
{
    (void)state;
    fresh_folder("shot");
    assert_int_equal(run("shot " SHOT " -o shot/a --set output.report=no"), 0);
    cJSON *a = summary_of("shot/a");
    assert_text(a, "kind", "shot");
    assert_text(a, "status", "done");
    assert_text(a, "case", "default_shot");
    assert_true(fabs(number(a, "energy_error")) < 1e-6);
    assert_true(exists("shot/a/history.h5") && exists("shot/a/used.yaml"));
    assert_int_equal(run("shot " SHOT " -o shot/a"), 2); /* finished results stay */
    assert_int_equal(run("shot " SHOT " -o shot/a --resume"), 0);
    assert_int_equal(run("shot " SHOT " -o shot/b --quiet --set output.report=no --set bank.charge='9 kV'"), 0);
    cJSON *b = summary_of("shot/b");
    assert_true(number(b, "muzzle_velocity") < number(a, "muzzle_velocity"));
    assert_int_equal(run("shot shot/a/used.yaml -o shot/c --set output.report=no"),
                     0); /* the same case, the same bits */
    cJSON *c = summary_of("shot/c");
    assert_true(number(c, "muzzle_velocity") == number(a, "muzzle_velocity"));
    cJSON_Delete(a);
    cJSON_Delete(b);
    cJSON_Delete(c);
}

static void test_inductance(void **state)
{
    (void)state;
    fresh_folder("inductance");
    assert_int_equal(run("inductance " SHOT " -o inductance/a --set output.report=no"), 0);
    cJSON *s = summary_of("inductance/a");
    const cJSON *L = cJSON_GetObjectItemCaseSensitive(s, "L_gradient"),
                *R = cJSON_GetObjectItemCaseSensitive(s, "R_gradient");
    const int n = cJSON_GetArraySize(L);
    assert_true(n > 5 && n == cJSON_GetArraySize(R));
    for (int i = 1; i < n; i++) { /* skin effect: L' falls, R' rises with the frequency */
        assert_true(cJSON_GetArrayItem(L, i)->valuedouble <= cJSON_GetArrayItem(L, i - 1)->valuedouble);
        assert_true(cJSON_GetArrayItem(R, i)->valuedouble >= cJSON_GetArrayItem(R, i - 1)->valuedouble);
    }
    assert_true(number(s, "L_gradient_high_frequency") < cJSON_GetArrayItem(L, n - 1)->valuedouble);
    assert_true(number(s, "L_gradient_direct_current") >= cJSON_GetArrayItem(L, 0)->valuedouble);
    assert_true(fabs(number(s, "kerrisk_error")) < 0.015); /* the formula's own error for s/h >= 0.5 */
    const int places = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(s, "perimeter"));
    assert_true(places > 10 && places == cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(s, "perimeter_heat")));
    cJSON_Delete(s);
    assert_int_equal(run("inductance " SHOT " -o inductance/b --set rail.cladding=\"30 mm\""),
                     2); /* thicker than the rail */
}

/* The same results whatever took them: all numbers but the times. */
static void assert_same(const cJSON *a, const cJSON *b)
{
    for (const cJSON *item = a->child; item; item = item->next) {
        if (!item->string || strcmp(item->string, "wall_seconds") == 0 || strcmp(item->string, "threads") == 0)
            continue;
        const cJSON *other = cJSON_GetObjectItemCaseSensitive(b, item->string);
        if (!cJSON_Compare(item, other, true)) fail_msg("%s differs", item->string);
        if (cJSON_IsNumber(item) && item->valuedouble != other->valuedouble) fail_msg("%s differs", item->string);
    }
}

static void test_scene(void **state)
{
    (void)state;
    fresh_folder("scene");
    assert_int_equal(run("scene " TINY " -o scene/a --threads 2 --set output.snapshots=3"), 0);
    assert_int_equal(run("scene " TINY " -o scene/b --threads 1 --set output.snapshots=3"), 0);
    cJSON *a = summary_of("scene/a"), *b = summary_of("scene/b");
    assert_text(a, "kind", "scene");
    assert_text(a, "status", "done");
    assert_same(a, b);                             /* any number of threads gives the same bits */
    assert_true(number(a, "peak_pressure") > 1e9); /* 7075 on copper at 1.5 km/s: of the order of the planar 19 GPa */
    assert_true(fabs(number(a, "energy_error")) < 0.01);
    assert_int_equal(files_in("scene/a/scenes/scene", ".hdf"), 3);
    assert_true(exists("scene/a/scenes/scene/scene.hdf.series"));
    assert_false(exists("scene/a/checkpoint.bin"));
    cJSON_Delete(a);
    cJSON_Delete(b);
}

/* A scene that ends at its second gauge, 28 radii of way: the class is that of the growth, beyond its scatter or not.
 */
static void test_gauged(void **state)
{
    (void)state;
    const double gauge = 28 * 0.2e-3 / 2000.0;
    const char *const scatter[] = { "0", "10" };
    for (int i = 0; i < 2; i++) {
        char command[1500];
        snprintf(command, sizeof command,
                 "scene " TINY " -o scene/gauged%d --set output.snapshots=0 --set particle.radius='0.2 mm' --set "
                 "scene.velocity='2 km/s' --set scene.stop_when_gauged=yes --set scene.growth_scatter=%s",
                 i, scatter[i]);
        assert_int_equal(run(command), 0);
        char dir[40];
        snprintf(dir, sizeof dir, "scene/gauged%d", i);
        cJSON *a = summary_of(dir);
        const double growth = number(a, "groove_growth");
        assert_true(number(a, "end_time") >= gauge && number(a, "end_time") < 1.1 * gauge);
        assert_text(a, "class", i ? "undecided" : growth > 0.0 ? "gouge" : "scratch");
        cJSON_Delete(a);
    }
    /* the whole scene, whatever it writes on the way, has the same growth, and goes on */
    assert_int_equal(run("scene " TINY " -o scene/whole --set output.snapshots=3 --set particle.radius='0.2 mm' --set "
                         "scene.velocity='2 km/s'"),
                     0);
    cJSON *whole = summary_of("scene/whole"), *gauged = summary_of("scene/gauged0");
    assert_true(number(whole, "groove_growth") == number(gauged, "groove_growth"));
    assert_true(number(whole, "steps") > number(gauged, "steps"));
    cJSON_Delete(whole);
    cJSON_Delete(gauged);
    run_script("read_gauged.py", BREECH_TESTS "/../coupling/tools scene/gauged0");
}

/* The Python reader and the ParaView script of coupling/tools, on what test_scene left. */
static void test_reader(void **state)
{
    (void)state;
    run_script("read_run.py", BREECH_TESTS "/../coupling/tools scene/a scene");
}

static void test_paraview_crater(void **state)
{
    (void)state;
    if (!full_tests()) skip();
    if (system("command -v pvbatch xvfb-run > /dev/null") != 0) {
        print_message("paraview or xvfb is not installed\n");
        skip();
    }
    assert_int_equal(system("xvfb-run -a pvbatch '" BREECH_TESTS "/../coupling/tools/paraview_crater.py' "
                            "scene/a/scenes/scene/scene.hdf.series scene/crater.png damage >out.txt 2>err.txt"),
                     0);
    int points = 0;
    FILE *f = fopen("out.txt", "r");
    assert_non_null(f);
    while (!feof(f) && fscanf(f, "points of the rail: %d", &points) != 1) fgetc(f);
    fclose(f);
    assert_true(points > 1000);
    assert_true(exists("scene/crater.png"));
}

/* Starts it and ends it with the signal once the folder holds a snapshot more; its exit code.  Snapshots come at fixed
 * times of the scene: how far it has come does not depend on how busy the machine is. */
static int signalled(const char *arguments, int number_of_signal, const char *snapshot_folder)
{
    char command[2000];
    snprintf(command, sizeof command, "exec %s %s >out.txt 2>err.txt", BREECH_PROGRAM, arguments);
    const int before = exists(snapshot_folder) ? files_in(snapshot_folder, ".hdf") : 0;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    int result;
    pid_t ended = 0;
    while (ended == 0 && !(exists(snapshot_folder) && files_in(snapshot_folder, ".hdf") > before)) {
        const struct timespec wait = { 0, 1000000 };
        nanosleep(&wait, NULL);
        ended = waitpid(child, &result, WNOHANG);
    }
    if (ended == 0) {
        kill(child, number_of_signal);
        ended = waitpid(child, &result, 0);
    }
    assert_int_equal(ended, child);
    return WIFEXITED(result) ? WEXITSTATUS(result) : 1000;
}

/* Every row once, to the bit. */
static void assert_same_history(const char *dataset)
{
    static const char *const files[2] = { "stop/whole/history.h5", "stop/part/history.h5" };
    double *data[2];
    size_t dims[2][H5_MAX_RANK];
    for (int k = 0; k < 2; k++) {
        h5_file *f = NULL;
        OK(host_h5_open(files[k], &f));
        OK(host_h5_read(f, dataset, &data[k], dims[k]));
        host_h5_close(f);
    }
    const size_t n = dims[0][0] * (strstr(dataset, "depth") ? dims[0][1] : 1);
    assert_int_equal(dims[0][0], dims[1][0]);
    assert_memory_equal(data[0], data[1], n * sizeof *data[0]);
    free(data[0]);
    free(data[1]);
}

/* SIGTERM, SIGINT and --max-walltime: checkpoint, 75; resumed as often as it takes, the same bits as in one go. */
static void test_stop_and_resume(void **state)
{
    (void)state;
    fresh_folder("stop");
    assert_int_equal(run("scene " TINY " -o stop/whole --quiet --set output.snapshots=6"), 0);
    const char *const arguments = "scene " TINY " -o stop/part --quiet --resume --set output.snapshots=6";
    int code = 75, stops = 0;
    while (code == 75 && stops < 20) {
        /* a snapshot at a time: only a run that goes on from its checkpoint gets to the end */
        code = signalled(arguments, stops % 2 ? SIGINT : SIGTERM, "stop/part/scenes/scene");
        if (code != 75) break;
        stops++;
        assert_true(exists("stop/part/checkpoint.bin"));
        cJSON *s = summary_of("stop/part");
        assert_text(s, "status", "stopped");
        cJSON_Delete(s);
        assert_int_equal(run("scene " TINY " -o stop/part --set output.snapshots=6"),
                         2); /* neither resumed nor forced */
    }
    assert_int_equal(code, 0);
    print_message("stopped %d times\n", stops);
    assert_true(stops >= 2);
    cJSON *whole = summary_of("stop/whole"), *part = summary_of("stop/part");
    assert_text(part, "status", "done");
    assert_same(whole, part);
    assert_int_equal(files_in("stop/part/scenes/scene", ".hdf"), files_in("stop/whole/scenes/scene", ".hdf"));
    assert_same_history("/scene/scene/time");
    assert_same_history("/scene/scene/internal");
    assert_same_history("/scene/scene/crater/depth");
    cJSON_Delete(whole);
    cJSON_Delete(part);
}

static void test_max_walltime(void **state)
{
    (void)state;
    fresh_folder("walltime");
    assert_int_equal(run("scene " TINY " -o walltime/a --max-walltime 0.3 --set output.snapshots=0"), 75);
    assert_true(contains("err.txt", "--max-walltime"));
    assert_int_equal(run("scene " TINY " -o walltime/a --max-walltime 1h --resume --set output.snapshots=0"), 0);
    assert_int_equal(run("scene " TINY " -o walltime/a --resume --set output.snapshots=0"), 0); /* nothing to do */
    assert_true(contains("out.txt", "finished already"));
}

/* A run that fails says so in its summary and with 1. */
static void test_failed(void **state)
{
    (void)state;
    fresh_folder("failed");
    assert_int_equal(
        run("scene " TINY " -o failed/a --set scene.fine_depth='0.0001 mm' --set scene.rail_depth='2.1 mm'"), 2);
    assert_int_equal(run("scene " TINY " -o /proc/nowhere/a"), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_usage),
        cmocka_unit_test(test_bad_case),
        cmocka_unit_test(test_check_and_materials),
        cmocka_unit_test(test_shot),
        cmocka_unit_test(test_inductance),
        cmocka_unit_test(test_scene),
        cmocka_unit_test(test_gauged),
        cmocka_unit_test(test_reader),
        cmocka_unit_test(test_paraview_crater),
        cmocka_unit_test(test_stop_and_resume),
        cmocka_unit_test(test_max_walltime),
        cmocka_unit_test(test_failed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
