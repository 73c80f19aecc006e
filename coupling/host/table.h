/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of text with aligned columns: numbers to the right, the rest to the left.  One wider than a hundred columns
 * goes on below, with its first column again. */
#ifndef BREECH_COUPLING_TABLE_H
#define BREECH_COUPLING_TABLE_H

#include "base/status.h"

#include <stdio.h>

typedef struct table table; /* owns its cells */

/* titles: '|' between columns, "site|x [m]|v [m/s]|class". */
status host_table_create(const char *titles, table **out);
/* A row, cells split at '|' too; missing cells stay empty, cells past the last column are refused. */
status host_table_row(table *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
void host_table_print(const table *t, FILE *out);
void host_table_free(table *t); /* NULL allowed */

#endif
