/* SPDX-License-Identifier: BSD-3-Clause */
/* The program killed at the instants that count: before and after each file is put in place.  --resume then gives what
 * a run in one go gives: the same numbers, the same history row by row, the same files, and nothing besides.
 *
 * The program may not be built with sanitizers, which do not let another library come first. */
#include "program_common.h"

#include <signal.h>

#define SCENE "scene " TINY " --set output.snapshots=2 --set scene.end_time='1.5 us' --quiet --threads 1 "

/* Its exit code; 1000: by a signal. */
static int killed(const char *arguments, const char *at, int count, int after)
{
    char command[2000];
    snprintf(command, sizeof command,
             "KILLED_AT='%s' KILLED_COUNT=%d KILLED_AFTER=%d LD_PRELOAD='" BREECH_KILLED_AT
             "' BREECH_MATERIALS= exec " BREECH_PROGRAM " %s >out.txt 2>err.txt",
             at, count, after, arguments);
    const int state = system(command);
    return WIFSIGNALED(state) || WEXITSTATUS(state) > 128 ? 1000 : WEXITSTATUS(state);
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
    run_script("same_history.py", "killed/whole/history.h5 killed/part/history.h5");
    cJSON_Delete(whole), cJSON_Delete(part);
    free(want), free(have);
}

/* Killed there, then resumed to its end; false: there is no such instant. */
static bool try_kill(const char *arguments, const char *at, int count, int after)
{
    char what[200];
    snprintf(what, sizeof what, "killed %s file %d `%s`", after ? "behind" : "before", count, at);
    fresh_folder("killed/part");
    if (killed(arguments, at, count, after) != 1000) return false;
    const int code = run(SCENE "-o killed/part --resume");
    if (code != 0) fail_msg("%s: --resume ends with %d", what, code);
    assert_as_whole(what);
    return true;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stopping),
        cmocka_unit_test(test_ending),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
