/* SPDX-License-Identifier: BSD-3-Clause */
/* Plots of report.html: curves by gnuplot, crater maps drawn here.  Internal to the report.
 *
 * Every plot is one file DIR/plot-<name>.svg, which the page takes in. */
#ifndef BREECH_COUPLING_REPORT_PLOTS_H
#define BREECH_COUPLING_REPORT_PLOTS_H

#include "base/status.h"
#include "coupling/host/hdf5_file.h"
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
    bool gnuplot;           /* there is one */
} report_source;

bool report_gnuplot_exists(void);

/* Colour of an outcome or class: "#c0392b" for a gouge. */
const char *report_colour(const char *outcome);

/* Each draws DIR/plot-<...>.svg; *drawn tells whether there was anything to draw. */
status report_plot_shot(const report_source *r, bool *drawn); /* one page of everything over time */
status report_plot_barrel(const report_source *r, bool *drawn);
status report_plot_threshold(const report_source *r, bool *drawn);
/* Threshold velocity over size, with the scenes; the ranking of surfaces with its intervals. */
status report_plot_surface(const report_source *r, bool *drawn);
status report_plot_ranking(const report_source *r, bool *drawn);
status report_plot_inductance(const report_source *r, bool *drawn);
status report_plot_perimeter(const report_source *r, bool *drawn);
status report_plot_crater_profile(const report_source *r, const char *scene, bool *drawn);
status report_plot_crater_map(const report_source *r, const char *scene, bool *drawn);

/* DIR/plot-<name>.svg without what stands before <svg, into the page. */
status report_plot_inline(const report_source *r, const char *name, FILE *page);

#endif
