/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of report.html that show every column at any width.  Internal to the report.
 *
 * Where a screen or a sheet is too narrow for the columns, each row becomes a box in which every number stands under
 * its title; nothing is cut off and nothing scrolls. */
#ifndef BREECH_COUPLING_REPORT_TABLE_H
#define BREECH_COUPLING_REPORT_TABLE_H

#include <stdbool.h>
#include <stdio.h>

enum { REPORT_COLUMNS = 40, REPORT_TITLE_SIZE = 120 };

typedef struct {
    FILE *out;
    int columns, at; /* at: the next cell's column */
    char title[REPORT_COLUMNS][REPORT_TITLE_SIZE];
    bool of_text[REPORT_COLUMNS];
} report_table;

/* Titles are text; of more than REPORT_COLUMNS the rest is left out, cells as well. */
void report_table_begin(report_table *t, FILE *out);
/* All of them before the first row; over a column of texts the second. */
void report_table_title(report_table *t, const char *title, const char *unit);
void report_table_text_title(report_table *t, const char *title);
void report_table_row(report_table *t);
void report_table_text(report_table *t, const char *text);
void report_table_coloured(report_table *t, const char *text, const char *colour);
void report_table_number(report_table *t, double x, double unit); /* x / unit, with the digits that are known */
void report_table_interval(report_table *t, double x, double lo, double hi, double unit);
void report_table_html(report_table *t, const char *html); /* as it stands */
void report_table_end(report_table *t);

#endif
