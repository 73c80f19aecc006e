/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of the files that cases and materials are read from. */
#include "coupling/case/case_reader.h"

#include "coupling/case/material_file.h"
#include "coupling/host/file_text.h"
#include "coupling/host/words.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void case_folder_of(const char *file, char folder[CASE_PATH_SIZE])
{
    snprintf(folder, CASE_PATH_SIZE, "%s", file);
    char *slash = strrchr(folder, '/');
    if (!slash)
        snprintf(folder, CASE_PATH_SIZE, ".");
    else
        slash[slash == folder ? 1 : 0] = '\0';
}

bool case_file_is_same(const char *a, const char *b)
{
    char *x = realpath(a, NULL), *y = realpath(b, NULL);
    const bool same = x && y && strcmp(x, y) == 0;
    free(x);
    free(y);
    return same;
}

status case_file_of(const char *path, char file[CASE_PATH_SIZE])
{
    const size_t end = strlen(path);
    const char *slash = end > 0 && path[end - 1] == '/' ? "" : "/";
    const int used = host_folder_exists(path) ? snprintf(file, CASE_PATH_SIZE, "%s%scase.yaml", path, slash)
                                              : snprintf(file, CASE_PATH_SIZE, "%s", path);
    CHECK(used < CASE_PATH_SIZE, STATUS_BAD_INPUT, "the case's path is longer than %d bytes", CASE_PATH_SIZE - 1);
    return status_ok();
}

bool case_file_shipped(const char *path, char file[CASE_PATH_SIZE])
{
    const char *name = strncmp(path, "cases/", 6) == 0 ? path + 6 : path;
    char folder[CASE_PATH_SIZE], found[CASE_PATH_SIZE];
    case_folders at;
    case_folders_find(&at);
    if (path[0] == '/' || path[0] == '.' || strstr(name, "..")) return false;
    for (int k = 0; k < at.n; k++) {
        const int n = snprintf(folder, sizeof folder, "%s/%s", at.dir[k], name);
        if (n >= (int)sizeof folder || case_file_of(folder, found).code != STATUS_OK) continue;
        if (!host_file_exists(found)) continue;
        memcpy(file, found, sizeof found);
        return true;
    }
    return false;
}

status case_file_find(const char *path, char file[CASE_PATH_SIZE])
{
    TRY(case_file_of(path, file));
    if (access(file, F_OK) != 0) (void)case_file_shipped(path, file);
    return status_ok();
}

static const char *alone(const void *name, int i)
{
    return i == 0 ? name : NULL;
}

/* Of the names in a folder the nearest to a mistyped one, if it is nearer than `near` already is. */
static void nearest_in(const char *folder, const char *name, char near[CASE_PATH_SIZE])
{
    DIR *d = opendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d));) {
        const char *found = host_nearest_name(name, alone, entry->d_name);
        if (!found || (near[0] && host_word_distance(name, near) <= host_word_distance(name, found))) continue;
        snprintf(near, CASE_PATH_SIZE, "%s", found);
    }
    if (d) closedir(d);
}

status case_file_missing(const char *path)
{
    const char *name = strncmp(path, "cases/", 6) == 0 ? path + 6 : path;
    char near[CASE_PATH_SIZE] = "", folders[2 * CASE_PATH_SIZE] = "";
    case_folders at;
    case_folders_find(&at);
    for (int k = 0; k < at.n; k++) {
        const size_t used = strlen(folders);
        snprintf(folders + used, sizeof folders - used, "%s%s", used ? ", " : "", at.dir[k]);
        nearest_in(at.dir[k], name, near);
    }
    CHECK(!near[0], STATUS_BAD_INPUT, "there is no such case; did you mean `%.100s`?", near);
    CHECK(at.n == 0, STATUS_BAD_INPUT, "there is no such case; those that came with the program are in %.300s",
          folders);
    return base_status_error(STATUS_BAD_INPUT, "there is no such case");
}
