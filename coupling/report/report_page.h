/* SPDX-License-Identifier: BSD-3-Clause */
/* What the pages of report.html are written with.  Internal to the report.
 *
 * A page of a kind of run has a head, which its user reads first, and sections; both are functions of a `page`.
 * Drawings are SVG (report_chart.h, report_svg.h), tables report_table.h, numbers report_value.h. */
#ifndef BREECH_COUPLING_REPORT_PAGE_H
#define BREECH_COUPLING_REPORT_PAGE_H

#include "coupling/host/hdf5_file.h"
#include "coupling/report/report_chart.h"
#include "coupling/report/report_table.h"
#include "coupling/report/report_value.h"

#include <cJSON.h>
#include <stdbool.h>
#include <stdio.h>

/* What the page is made from; all owned by report_write. */
typedef struct {
    const char *dir;
    const cJSON *summary;
    const h5_file *history; /* NULL: none */
    const char *used;       /* text of used.yaml, NULL: none */
} report_source;

typedef struct page {
    const report_source *source;
    FILE *out;
} page;

/* A key of the summary as people read it: value / unit, called name.  interval: the key of two that says how well the
 * value is known; NULL: none. */
typedef struct {
    const char *key, *title;
    double unit;
    const char *name, *interval;
} page_column;
#define PAGE_COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* ---- text ---- */

void report_page_heading(const page *p, const char *text);
void report_page_paragraph(const page *p, const char *class, const char *text); /* escaped; class "": none */
void report_page_number(FILE *out, double x, double unit, const char *name);    /* with its unit */
/* "950 (790 to 1160) m/s", by what the interval supports. */
void report_page_interval(FILE *out, double x, double lo, double hi, double unit, const char *name);
/* One box a key that the object has a number for. */
void report_page_cards(const page *p, const cJSON *object, const page_column *list, int n);
/* One row an object; outcomes in their colours.  A column without a value in any row is left out, and so is a table
 * without rows. */
void report_page_list_table(const page *p, const cJSON *list, const page_column *columns, int n);
/* The same of a list of the summary, under a heading. */
void report_page_listed(const page *p, const char *key, const char *title, const page_column *columns, int n);

/* Opens the page of a comparison from the list `ranking`: which entry is best, or how many cannot be told apart, then a
 * line each of the best and of the one that all are compared with.  Nothing where the run is not done. */
typedef struct {
    const char *name;                            /* key of an entry's name */
    const char *reference;                       /* name of what all are compared with */
    const char *best, *tied;                     /* "The best target is", "targets cannot be told apart" */
    void (*line)(FILE *out, const cJSON *entry); /* writes what follows the name */
} page_ranking;
void report_page_ranking(const page *p, const page_ranking *of);
bool report_page_is_done(const page *p); /* the run is, by its summary */
const cJSON *report_page_list(const page *p, const char *key);
/* Colour of an outcome or class: "#c0392b" for a gouge. */
const char *report_colour(const char *outcome);
const char *report_shade(int k); /* of the k-th curve of a chart, from 0 */
extern const char report_gouge_band[], report_scratch_band[], report_blue[], report_red[], report_grey[];

/* ---- drawings ---- */

/* Several charts between these stand beside each other where there is room. */
void report_page_plots_begin(const page *p);
void report_page_plots_end(const page *p);
/* A figure; the SVG also becomes DIR/plot-<name>.svg.  Takes svg over; NULL: nothing is drawn.  The caption is text. */
void report_page_svg(const page *p, const char *name, const char *caption, char *svg);
void report_page_chart(const page *p, const char *name, const char *caption, report_chart *c);

/* Two columns of the history over each other, of equal length; n = 0 where they are missing. */
typedef struct {
    double *x, *y;
    size_t n;
} report_curve;
report_curve report_curve_read(const report_source *r, const char *x, const char *y);
void report_curve_free(report_curve *c);
/* The size of the vector whose components are `y` with _x, _y, _z at its end. */
report_curve report_curve_size(const report_source *r, const char *x, const char *y);
double report_curve_at(const report_curve *c, double x); /* between the rows; NaN beyond them; x rises */
/* How many rows lie up to x: those before the armature has left, for one. */
size_t report_curve_until(const report_curve *c, double x);

/* A value of used.yaml as text, "" where it is not there: key in a section, both as in the case file. */
enum { REPORT_USED_SIZE = 200 };
void report_used_value(const report_source *r, const char *section, const char *key, char out[REPORT_USED_SIZE]);

/* ---- heads and sections by kind ---- */

void report_shot_head(const page *p);
void report_shot_section(const page *p);    /* curves over time; nothing where there is no shot */
void report_shot_ledger(const page *p);     /* where the energy went */
void report_scene_head(const page *p);      /* of one impact on a rail */
void report_crater_sections(const page *p); /* craters of the history */
void report_onset_head(const page *p);
void report_onset_section(const page *p);
void report_compare_head(const page *p);
void report_compare_section(const page *p);
void report_inductance_head(const page *p);
void report_inductance_section(const page *p);
void report_bodies_head(const page *p);
void report_bodies_part(const page *p);    /* bodies and energies */
void report_bodies_section(const page *p); /* those, the cut, the probes */
void report_probes_section(const page *p);
/* The bodies cut in their middle, by the first and the last snapshot; nothing without snapshots. */
void report_cut_section(const page *p);
void report_strike_head(const page *p);
void report_strike_section(const page *p);
void report_life_head(const page *p);
void report_life_section(const page *p);
void report_rail_life_head(const page *p);
void report_rail_life_section(const page *p); /* along the barrel */
void report_compare_life_head(const page *p);
void report_compare_life_section(const page *p); /* which surface lasts how long */
void report_compare_targets_head(const page *p);
void report_compare_targets_section(const page *p); /* which target takes more */
void report_vessel_head(const page *p);
void report_vessel_section(const page *p);
void report_sweep_head(const page *p);
void report_sweep_section(const page *p);
void report_ensemble_head(const page *p);
void report_ensemble_section(const page *p);

#endif
