/* SPDX-License-Identifier: BSD-3-Clause */
/* A whole file as bytes. */
#ifndef BREECH_COUPLING_FILE_TEXT_H
#define BREECH_COUPLING_FILE_TEXT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* *bytes is malloc'ed, the caller frees it.  STATUS_BAD_INPUT when it is not there, no file or longer than
 * `limit`, STATUS_IO when it cannot be read. */
status host_file_text(const char *path, size_t limit, char **bytes, size_t *length);

/* There is something of this name that is no folder. */
bool host_file_exists(const char *path);
bool host_folder_exists(const char *path);

#endif
