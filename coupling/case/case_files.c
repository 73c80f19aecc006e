/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of the files that cases and materials are read from. */
#include "coupling/case/case_reader.h"

#include "coupling/case/material_file.h"
#include "coupling/host/file_text.h"

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
