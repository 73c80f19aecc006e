/* SPDX-License-Identifier: BSD-3-Clause */
/* SVG plots by gnuplot, a script file in, an SVG file out, no shell.  Internal to the report.
 *
 * report_plot_begin, then gnuplot's own words and data blocks into .script, then report_plot_end. */
#ifndef BREECH_COUPLING_REPORT_GNUPLOT_H
#define BREECH_COUPLING_REPORT_GNUPLOT_H

#include "coupling/host/outdir.h"
#include "coupling/report/report_plots.h"

typedef struct {
    FILE *script;
    char script_path[OUTDIR_PATH_SIZE], part[OUTDIR_PATH_SIZE], svg[OUTDIR_PATH_SIZE];
} plot;

/* DIR/plot-<name>.svg, width x height pixels; frame, grid and key are set.  After an error nothing is to be ended. */
status report_plot_begin(plot *p, const report_source *r, const char *name, int width, int height);
status report_plot_end(plot *p);

/* Data block $name of two columns, thinned to what a screen shows; the last point is kept. */
void report_plot_data(FILE *script, const char *name, const double *x, const double *y, size_t n);

/* The objects of a list of the summary as points, by outcome. */
enum { OUTCOMES = 6 };
typedef struct {
    const char *list, *outcome_key, *x, *y;
    double x_unit;
} point_source;
/* A data block an outcome; returns how many points there are.  used[i]: outcome i has some. */
int report_plot_outcome_data(FILE *script, const report_source *r, const point_source *from, bool used[OUTCOMES]);
/* The words that plot them; first: nothing stands before them in the plot command. */
void report_plot_outcomes(FILE *script, const bool used[OUTCOMES], bool first);
/* A shaded interval of the summary across the whole plot, along x or along y; none where there is no interval. */
void report_plot_band(FILE *script, int object, const cJSON *summary, const char *key, bool along_x,
                      const char *colour);
extern const char report_gouge_band[], report_scratch_band[]; /* colours */

#endif
