/* SPDX-License-Identifier: BSD-3-Clause */
/* What the sections of report.html are written with.  Internal to the report. */
#ifndef BREECH_COUPLING_REPORT_PAGE_H
#define BREECH_COUPLING_REPORT_PAGE_H

#include "coupling/report/report_plots.h"

typedef struct page {
    const report_source *source;
    FILE *out;
} page;

/* A key of the summary as people read it: value / unit, called name. */
typedef struct {
    const char *key, *title;
    double unit;
    const char *name;
} page_column;
#define PAGE_COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

void report_page_escaped(FILE *out, const char *text);
void report_page_heading(const page *p, const char *text);
void report_page_paragraph(const page *p, const char *class, const char *text);
/* Four digits and the unit's name; a dash where there is no number. */
void report_page_number(FILE *out, double x, double unit, const char *name);
/* One box a key. */
void report_page_cards(const page *p, const cJSON *object, const page_column *list, int n);
/* One row an object; a vector of two is shown as an interval, outcomes in their colours.  Nothing for an empty list. */
void report_page_list_table(const page *p, const cJSON *list, const page_column *columns, int n);

/* The plot that was drawn into DIR/plot-<name>.svg; caption may be "". */
void report_page_plot(const page *p, const char *name, const char *caption);
/* Draws it and takes it in; says so where it cannot be drawn, nothing where there is nothing to draw. */
void report_page_draw(const page *p, status (*draw)(const report_source *, bool *), const char *name,
                      const char *caption);

/* A heading and a table of a list of the summary; nothing where the list is empty. */
void report_page_listed(const page *p, const char *key, const char *title, const page_column *columns, int n);
bool report_page_is_done(const page *p); /* the run is, by its summary */

/* ---- parts of the studies (report.h) ---- */

void report_shot_verdict(const page *p);
void report_scene_verdict(const page *p);
void report_bodies_verdict(const page *p);
void report_section_bodies(const page *p);
void report_section_probes(const page *p); /* of a scene of bodies; nothing where it has none */
void report_onset_verdict(const page *p);
void report_section_onset(const page *p);
void report_section_compare(const page *p);
void report_section_inductance(const page *p);

#endif
