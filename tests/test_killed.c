/* SPDX-License-Identifier: BSD-3-Clause */
/* The program killed at the instants that count: before and after each file is put in place.  --resume then gives what
 * a run in one go gives: the same numbers, the same history row by row, the same files, and nothing besides.
 *
 * The program may not be built with sanitizers, which do not let another library come first. */
#include "program_common.h"

#include <signal.h>

#define SCENE "scene " TINY " --set output.snapshots=2 --set scene.end_time='1.5 us' --quiet --threads 1 "

/* Its exit code; 1000: by a signal.  `what` is for killed_at.c. */
static int run_with(const char *what, const char *arguments)
{
    char command[2000];
    snprintf(command, sizeof command,
             "%s LD_PRELOAD='" BREECH_KILLED_AT "' BREECH_MATERIALS= exec " BREECH_PROGRAM " %s >out.txt 2>err.txt",
             what, arguments);
    const int state = system(command);
    return WIFSIGNALED(state) || WEXITSTATUS(state) > 128 ? 1000 : WEXITSTATUS(state);
}

static int killed(const char *arguments, const char *at, int count, int after)
{
    char what[200];
    snprintf(what, sizeof what, "KILLED_AT='%s' KILLED_COUNT=%d KILLED_AFTER=%d", at, count, after);
    return run_with(what, arguments);
}

/* All files below a folder, a line each, sorted. */
static char *files_of(const char *folder)
{
    char command[400], *text = NULL;
    snprintf(command, sizeof command, "cd '%s' && find . -type f | sort > ../files.txt", folder);
    assert_int_equal(system(command), 0);
    OK(host_file_read("killed/files.txt", &text, NULL));
    return text;
}

/* Summary, history and the list of files. */
static void assert_as_whole(const char *what)
{
    cJSON *whole = summary_of("killed/whole"), *part = summary_of("killed/part");
    char *want = files_of("killed/whole"), *have = files_of("killed/part");
    if (strcmp(want, have) != 0) fail_msg("%s: files\n%snot\n%s", what, have, want);
    assert_text(part, "status", "done");
    assert_same(whole, part);
    const char *kind = cJSON_GetStringValue(cJSON_GetObjectItem(part, "kind"));
    if (strcmp(kind, "sweep") != 0) /* of which there is no history */
        run_script("same_history.py", "killed/whole/history.h5 killed/part/history.h5");
    cJSON_Delete(whole), cJSON_Delete(part);
    free(want), free(have);
}

#define SHOTS                                                                                               \
    "sweep " CASES "/pulse_unit_200kJ --quiet --set output.report=no --set sweep='{of: shot, vary: [{key: " \
    "bank.charge, values: [5 kV, 6 kV, 7 kV]}, {key: title, values: [one, two]}], read: [peak_current, action]}' "
#define SEARCH "shot " CASES "/flat_current --quiet --set output.report=no --set optimise.evaluations=6 "

/* Killed there, then resumed to its end; false: there is no such instant. */
static bool try_kill_of(const char *resumed, const char *arguments, const char *at, int count, int after)
{
    char what[200];
    snprintf(what, sizeof what, "killed %s file %d `%s`", after ? "behind" : "before", count, at);
    fresh_folder("killed/part");
    if (killed(arguments, at, count, after) != 1000) return false;
    const int code = run(resumed);
    if (code != 0) fail_msg("%s: --resume ends with %d", what, code);
    assert_as_whole(what);
    return true;
}

static bool try_kill(const char *arguments, const char *at, int count, int after)
{
    return try_kill_of(SCENE "-o killed/part --resume", arguments, at, count, after);
}

static void open_folder(void)
{
    fresh_folder("killed");
    assert_int_equal(run(SCENE "-o killed/whole"), 0);
}

/* A stop by the clock: history, checkpoint and summary in turn. */
static void test_stopping(void **state)
{
    (void)state;
    static const char *const files[] = { "part/history.h5", "part/checkpoint.bin", "part/summary.json" };
    open_folder();
    for (int i = 0; i < 3; i++)
        for (int after = 0; after < 2; after++)
            if (!try_kill(SCENE "-o killed/part --max-walltime 0.2", files[i], 1, after))
                fail_msg("%s was not written", files[i]);
}

/* The end: the store's file, the last of the history, the summary; with BREECH_FULL=1 every file of the whole run. */
static void test_ending(void **state)
{
    (void)state;
    static const char *const files[] = { "part/store/", "part/history.h5", "part/summary.json" };
    open_folder();
    for (int i = 0; i < 3; i++)
        for (int after = 0; after < 2; after++)
            if (!try_kill(SCENE "-o killed/part", files[i], 1, after)) fail_msg("%s was not written", files[i]);
    int n = 0;
    while (full_tests() && try_kill(SCENE "-o killed/part", "part/", n + 1, 0)) {
        assert_true(try_kill(SCENE "-o killed/part", "part/", n + 1, 1));
        n++;
    }
    assert_true(!full_tests() || n > 8);
}

/* A sweep of shots and a search for firing times keep what they have worked out as they go: the first run, the first
 * trial, later what the seconds between two checkpoints brought. */
static void test_without_scenes(void **state)
{
    (void)state;
    static const char *const files[] = { "part/checkpoint.bin", "part/summary.json" };
    static const char *const of[][3] = {
        { SHOTS "-o killed/whole", SHOTS "-o killed/part", SHOTS "-o killed/part --resume" },
        { SEARCH "-o killed/whole", SEARCH "-o killed/part", SEARCH "-o killed/part --resume" },
    };
    for (int k = 0; k < 2; k++) {
        fresh_folder("killed");
        assert_int_equal(run(of[k][0]), 0);
        for (int i = 0; i < 2; i++)
            for (int after = 0; after < 2; after++)
                if (!try_kill_of(of[k][2], of[k][1], files[i], 1, after)) fail_msg("%s was not written", files[i]);
    }
}

/* Snapshots are written in the background: a checkpoint waits for those before it, however slow the disk. */
static void test_checkpoint_waits(void **state)
{
    (void)state;
    open_folder();
    fresh_folder("killed/part");
    assert_int_equal(run_with("LATE_AT=0.hdf KILLED_AT=part/checkpoint.bin KILLED_COUNT=1 KILLED_AFTER=1",
                              SCENE "-o killed/part --max-walltime 0.2"),
                     1000);
    assert_int_equal(run(SCENE "-o killed/part --resume"), 0);
    assert_as_whole("killed behind its checkpoint, on a slow disk");
}

/* A disk that is full by the first snapshot, or by the last, behind which no other comes, ends the run and says so. */
static void test_full_disk(void **state)
{
    (void)state;
    static const char *const files[] = { "scene-000000.hdf", "scene-000001.hdf", "scene.hdf.series" };
    for (int i = 0; i < 3; i++) {
        char what[60], message[80];
        fresh_folder("killed");
        snprintf(what, sizeof what, "FULL_AT=%s", files[i]);
        snprintf(message, sizeof message, "%s: cannot be written: No space left on device", files[i]);
        assert_int_equal(run_with(what, SCENE "-o killed/part"), 1);
        assert_true(contains("err.txt", message));
        assert_int_equal(files_in("killed/part/scenes/scene", ".part"), 0);
        assert_int_equal(run(SCENE "-o killed/part --resume"), 0); /* room again */
        assert_int_equal(files_in("killed/part/scenes/scene", ".hdf"), 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_checkpoint_waits), cmocka_unit_test(test_full_disk),      cmocka_unit_test(test_stopping),
        cmocka_unit_test(test_ending),           cmocka_unit_test(test_without_scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
