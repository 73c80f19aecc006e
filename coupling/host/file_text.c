/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/file_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool host_file_exists(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && !S_ISDIR(s.st_mode);
}

bool host_folder_exists(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

static status read_all(FILE *file, const char *path, size_t limit, char *bytes, size_t *length)
{
    *length = fread(bytes, 1, limit + 1, file);
    CHECK(!ferror(file), STATUS_IO, "%.300s cannot be read: %s", path, strerror(errno));
    CHECK(*length <= limit, STATUS_BAD_INPUT, "%.300s is longer than %zu bytes", path, limit);
    return status_ok();
}

status host_file_text(const char *path, size_t limit, char **bytes, size_t *length)
{
    *bytes = NULL;
    *length = 0;
    struct stat info; /* first: to open a named pipe waits for one who writes */
    CHECK(stat(path, &info) == 0, STATUS_BAD_INPUT, "%.300s cannot be opened: %s", path, strerror(errno));
    CHECK(S_ISREG(info.st_mode), STATUS_BAD_INPUT, "%.300s is not a file", path);
    FILE *file = fopen(path, "rb");
    CHECK(file, STATUS_IO, "%.300s cannot be opened: %s", path, strerror(errno));
    char *all = malloc(limit + 1);
    if (!all) {
        fclose(file);
        return base_status_error(STATUS_MEMORY, "out of memory while reading %.300s", path);
    }
    const status s = read_all(file, path, limit, all, length);
    fclose(file);
    if (s.code == STATUS_OK)
        *bytes = all;
    else
        free(all);
    return s;
}
