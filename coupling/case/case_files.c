/* SPDX-License-Identifier: BSD-3-Clause */
/* Paths of the files that cases and materials are read from. */
#include "coupling/case/case_reader.h"

#include <stdlib.h>
#include <string.h>

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
