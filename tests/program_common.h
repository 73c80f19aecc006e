/* SPDX-License-Identifier: BSD-3-Clause */
/* Running the program from a test, and reading what it wrote. */
#ifndef BREECH_TESTS_PROGRAM_COMMON_H
#define BREECH_TESTS_PROGRAM_COMMON_H

#include "output_common.h"

#include "coupling/host/outdir.h"

#include <cJSON.h>
#include <sys/wait.h>

#define CASES BREECH_TESTS "/../cases"
#define SHOT CASES "/default_shot"

/* A scene of a second or two: a stub of an armature over a short rail, one or two cells a radius. */
#define TINY                                                                                                        \
    SHOT " --set scene.cells_per_radius=1.5 --set scene.levels=2 --set scene.coarse_cell='0.8 mm' --set "           \
         "scene.growth=1.3 --set output.report=no"                                                                  \
         " --set scene.rail_ahead='8 mm' --set "                                                                    \
         "armature.length='10 mm' --set armature.half_bore='6 mm' --set armature.width='10 mm' --set "              \
         "armature.head_thickness='6 mm' --set armature.leg_thickness='5 mm' --set scene.rail_behind='1 mm' --set " \
         "scene.rail_depth='4 mm' --set "                                                                           \
         "scene.end_time='4 us'"

static inline int run(const char *arguments)
{
    char command[2000];
    snprintf(command, sizeof command, "BREECH_MATERIALS= %s %s >out.txt 2>err.txt", BREECH_PROGRAM, arguments);
    const int state = system(command);
    return WIFEXITED(state) ? WEXITSTATUS(state) : 1000;
}

static inline bool contains(const char *file, const char *text)
{
    char *all = NULL;
    OK(host_file_read(file, &all, NULL));
    const bool found = strstr(all, text) != NULL;
    free(all);
    return found;
}

static inline bool exists(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0;
}

static inline cJSON *summary_of(const char *dir)
{
    char path[200], *text = NULL;
    snprintf(path, sizeof path, "%s/summary.json", dir);
    OK(host_file_read(path, &text, NULL));
    cJSON *s = cJSON_Parse(text);
    free(text);
    assert_non_null(s);
    return s;
}

static inline void assert_text(const cJSON *s, const char *key, const char *want)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(s, key);
    assert_true(cJSON_IsString(item));
    assert_string_equal(item->valuestring, want);
}

static inline double number(const cJSON *s, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(s, key);
    if (!item) fail_msg("no key %s", key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Bad input: the errors hold these words, and there is no output folder. */
static inline void assert_refused(const char *arguments, const char *folder, const char *words)
{
    assert_int_equal(run(arguments), 2);
    if (!contains("err.txt", words)) {
        char *errors;
        OK(host_file_read("err.txt", &errors, NULL));
        fail_msg("%s: not `%s` but %s", arguments, words, errors);
    }
    assert_false(exists(folder));
}

/* The same results whatever took them: all numbers but the times. */
static inline void assert_same(const cJSON *a, const cJSON *b)
{
    const cJSON *next = b->child; /* of a list */
    for (const cJSON *item = a->child; item; item = item->next) {
        const char *name = item->string ? item->string : "an entry of a list";
        const cJSON *other = item->string ? cJSON_GetObjectItemCaseSensitive(b, item->string) : next;
        if (next) next = next->next;
        if (strcmp(name, "wall_seconds") == 0 || strcmp(name, "threads") == 0) continue;
        if (cJSON_GetArraySize(item) != cJSON_GetArraySize(other)) fail_msg("%s is longer", name);
        if (other && item->type == other->type && item->child && other->child) {
            assert_same(item, other);
            continue;
        }
        if (!cJSON_Compare(item, other, true)) fail_msg("%s differs", name);
        if (cJSON_IsNumber(item) && item->valuedouble != other->valuedouble) fail_msg("%s differs", name);
    }
}

/* The same answers on one, two and three threads, in folder_1 and so on; the last is stopped at once, and resumed.
 * Their summary, the caller's. */
static inline cJSON *same_on_threads(const char *arguments, const char *folder)
{
    cJSON *of[3];
    for (int k = 0; k < 3; k++) {
        char dir[100], command[800];
        snprintf(dir, sizeof dir, "%s_%d", folder, k + 1);
        snprintf(command, sizeof command, "%s -o %s --quiet --threads %d%s", arguments, dir, k + 1,
                 k == 2 ? " --max-walltime 0.001" : "");
        assert_int_equal(run(command), k == 2 ? 75 : 0);
        if (k == 2) {
            *strstr(command, " --max-walltime") = '\0';
            strcat(command, " --resume");
            assert_int_equal(run(command), 0);
        }
        of[k] = summary_of(dir);
        assert_same(of[0], of[k]);
    }
    cJSON_Delete(of[1]), cJSON_Delete(of[2]);
    return of[0];
}

#endif
