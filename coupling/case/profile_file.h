/* SPDX-License-Identifier: BSD-3-Clause */
/* A current profile from a table file: time [s] and current [A] a row, parted by commas or blanks; # begins a comment;
 * lines before the first row that are no numbers are its heading. */
#ifndef BREECH_COUPLING_PROFILE_FILE_H
#define BREECH_COUPLING_PROFILE_FILE_H

#include "base/status.h"
#include "circuit/supply/supply.h"

enum { PROFILE_MAX_BYTES = 1 << 20 };

/* *points is malloc'ed, *n long; the caller frees it.  STATUS_BAD_INPUT names the file's line. */
status case_profile_read(const char *path, circuit_supply_point **points, int *n);

#endif
