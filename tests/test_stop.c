/* SPDX-License-Identifier: BSD-3-Clause */
/* The program stopped and resumed: SIGTERM, SIGINT, --max-walltime. */
#include "full_common.h"
#include "program_common.h"

#include "coupling/host/hdf5_file.h"

#include <signal.h>
#include <time.h>

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
static void assert_same_history(const char *one, const char *other, const char *dataset)
{
    const char *const files[2] = { one, other };
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
    assert_same_history("stop/whole/history.h5", "stop/part/history.h5", "/scene/scene/time");
    assert_same_history("stop/whole/history.h5", "stop/part/history.h5", "/scene/scene/internal");
    assert_same_history("stop/whole/history.h5", "stop/part/history.h5", "/scene/scene/crater/depth");
    cJSON_Delete(whole);
    cJSON_Delete(part);
}

/* A stopped run whose history is gone is not gone on with: the end would lack what was in it. */
static void test_without_history(void **state)
{
    (void)state;
    fresh_folder("no_history");
    assert_int_equal(run("scene " TINY " -o no_history/a --max-walltime 0.05"), 75);
    assert_int_equal(rename("no_history/a/history.h5", "no_history/kept.h5"), 0);
    assert_int_equal(run("scene " TINY " -o no_history/a --resume"), 2);
    assert_true(contains("err.txt", "history.h5: is missing, and the checkpoint beside it goes on from it"));
    assert_true(exists("no_history/a/checkpoint.bin"));
    assert_int_equal(rename("no_history/kept.h5", "no_history/a/history.h5"), 0);
    assert_int_equal(run("scene " TINY " -o no_history/a --resume"), 0);
}

/* The shipped lattice on cells of twice the size, for three microseconds. */
#define STRIKE                                                                                            \
    "strike " CASES "/lattice_target --quiet --set strike.travel='6 mm' --set scene.cell='0.8 mm' --set " \
    "scene.coarse_cell='1.6 mm' --set output.report=no --set output.snapshots=12 "

/* A strike: the same summary, the same series of force and way, on 1, 2, 3 threads and over stops. */
static void test_strike(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    static const char *const series[] = { "/scene/scene/probes/projectile_force/force_x",
                                          "/scene/scene/probes/projectile_way/speed", "/scene/scene/internal",
                                          "/scene/scene/bodies/core/failed_volume" };
    static const char *const others[] = { "struck/two", "struck/three", "struck/part" };
    int code = 75, stops = 0;
    fresh_folder("struck");
    assert_int_equal(run(STRIKE "-o struck/whole --threads 1"), 0);
    assert_int_equal(run(STRIKE "-o struck/two --threads 2"), 0);
    assert_int_equal(run(STRIKE "-o struck/three --threads 3"), 0);
    for (; code == 75 && stops < 20; stops += code == 75)
        code = signalled(STRIKE "-o struck/part --threads 2 --resume", SIGTERM, "struck/part/scenes/scene");
    assert_int_equal(code, 0);
    assert_true(stops >= 2);
    cJSON *whole = summary_of("struck/whole");
    assert_true(number(whole, "failed_volume") > 0.0);
    for (int k = 0; k < 3; k++) {
        char path[60];
        cJSON *other = summary_of(others[k]);
        assert_same(whole, other);
        snprintf(path, sizeof path, "%s/history.h5", others[k]);
        for (size_t i = 0; i < sizeof series / sizeof series[0]; i++)
            assert_same_history("struck/whole/history.h5", path, series[i]);
        cJSON_Delete(other);
    }
    cJSON_Delete(whole);
}

static void test_max_walltime(void **state)
{
    (void)state;
    fresh_folder("walltime");
    assert_int_equal(run("scene " TINY " -o walltime/a --max-walltime 0.05 --set output.snapshots=0"), 75);
    assert_true(contains("err.txt", "--max-walltime"));
    assert_int_equal(run("scene " TINY " -o walltime/a --max-walltime 1h --resume --set output.snapshots=0"), 0);
    assert_int_equal(run("scene " TINY " -o walltime/a --resume --set output.snapshots=0"), 0); /* nothing to do */
    assert_true(contains("out.txt", "finished already"));
}

/* Searches for firing times that give up early and say so. */
#define SEARCHES                                                                                                  \
    "sweep " CASES "/flat_current --quiet --set output.report=no --set optimise.evaluations=5 --set sweep='{of: " \
    "shot, vary: [{key: armature.mass, values: [240 g, 250 g, 260 g, 270 g, 280 g, 290 g]}], read: "              \
    "[muzzle_velocity, melt_position, optimise_after]}' "

static const cJSON *runs_of(const cJSON *summary)
{
    return cJSON_GetObjectItemCaseSensitive(summary, "sweep");
}

/* A sweep stopped again and again: what it has come to stays, down to the time it took, and the end is that of a sweep
 * in one go. */
static void test_sweep(void **state)
{
    (void)state;
    char arguments[1000];
    double seconds[6] = { 0.0 }, time = 0.1;
    int code = 75, known = 0, stops = 0;
    fresh_folder("swept");
    assert_int_equal(run(SEARCHES "-o swept/whole"), 0);
    cJSON *whole = summary_of("swept/whole"), *part = NULL;
    for (; code == 75; time *= 1.4) {
        snprintf(arguments, sizeof arguments, SEARCHES "-o swept/part --resume --max-walltime %g", time);
        code = run(arguments);
        cJSON_Delete(part);
        part = summary_of("swept/part");
        const int n = cJSON_GetArraySize(runs_of(part));
        assert_true(n >= known && (code == 75 || (code == 0 && n == 6)));
        for (int i = 0; i < n; i++) {
            const double now = number(cJSON_GetArrayItem(runs_of(part), i), "wall_seconds");
            if (i < known && now != seconds[i]) fail_msg("run %d was run again", i + 1);
            seconds[i] = now;
        }
        stops += n > known && code == 75;
        known = n;
    }
    print_message("stopped %d times between runs\n", stops);
    assert_true(stops > 0);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(whole, "warnings")), 6);
    assert_same(whole, part);
    cJSON_Delete(whole);
    cJSON_Delete(part);
}

/* A search that is stopped has left its trials, once it has made one. */
static void test_search(void **state)
{
    (void)state;
    char arguments[1000];
    fresh_folder("searched");
#define SEARCH "shot " CASES "/flat_current --quiet --set output.report=no --set optimise.evaluations=30 "
    assert_int_equal(run(SEARCH "-o searched/whole"), 0);
    for (double time = 0.1; !exists("searched/part/checkpoint.bin"); time *= 1.4) {
        snprintf(arguments, sizeof arguments, SEARCH "-o searched/part --resume --max-walltime %g", time);
        assert_int_equal(run(arguments), 75);
    }
    assert_int_equal(run(SEARCH "-o searched/part --resume"), 0);
    assert_false(exists("searched/part/checkpoint.bin"));
#undef SEARCH
    cJSON *whole = summary_of("searched/whole"), *part = summary_of("searched/part");
    assert_same(whole, part);
    cJSON_Delete(whole);
    cJSON_Delete(part);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stop_and_resume), cmocka_unit_test(test_strike), cmocka_unit_test(test_max_walltime),
        cmocka_unit_test(test_without_history), cmocka_unit_test(test_sweep),  cmocka_unit_test(test_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
