/* SPDX-License-Identifier: BSD-3-Clause */
/* A table of text with aligned columns: numbers to the right, the rest to the left.  One wider than a hundred columns
 * goes on below, with its first columns again.  A text of the user's may stand in a cell whatever it is: of a long one
 * the start is shown, and control characters are shown as spaces. */
#ifndef BREECH_COUPLING_TABLE_H
#define BREECH_COUPLING_TABLE_H

#include "base/status.h"

#include <stdio.h>

typedef struct table table; /* owns its cells */

enum { TABLE_MAX_COLUMNS = 40 };
#define TABLE_NEXT "\x1f" /* ends a cell inside an argument of host_table_row */

/* titles: '|' or TABLE_NEXT between columns, "site|x [m]|v [m/s]|class". */
status host_table_create(const char *titles, table **out);
/* A row, cells split at the '|' of the format, not at those of its arguments; missing cells stay empty, cells past the
 * last column are refused. */
status host_table_row(table *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
void host_table_keep(table *t, int columns); /* that stand again where it goes on below; 1 unless set */
void host_table_print(const table *t, FILE *out);
void host_table_free(table *t); /* NULL allowed */

#endif
