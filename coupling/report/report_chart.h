/* SPDX-License-Identifier: BSD-3-Clause */
/* A chart of curves and points over one quantity, with axes, intervals and a legend, as SVG.  Internal to the report.
 *
 * Make one, add what it shows in any order, and turn it into text; the axes are chosen then from all that was added.
 * Values are in SI units: the chart chooses the prefix of units that take one, so 1.2e9 Pa is drawn as 1.2 GPa.  What
 * is added is copied.  A chart without room, or to which nothing was added, becomes NULL. */
#ifndef BREECH_COUPLING_REPORT_CHART_H
#define BREECH_COUPLING_REPORT_CHART_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *label, *unit; /* of the values; "" or "1": none */
    bool log, from_zero;
    bool fixed; /* no prefix */
} report_axis;

typedef struct report_chart report_chart;

report_chart *report_chart_create(report_axis x, report_axis y);

/* title: for the legend; "" for none. */
void report_chart_line(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                       size_t n);
void report_chart_thin_line(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                            size_t n);
void report_chart_dashed(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                         size_t n);
void report_chart_dots(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                       size_t n);
void report_chart_rings(report_chart *c, const char *title, const char *colour, const double *x, const double *y,
                        size_t n);
/* From lo to hi along y at x. */
void report_chart_whisker(report_chart *c, const char *colour, double x, double lo, double hi);
/* A shaded interval across the whole chart, along 'x' or 'y'; ends that are not finite: to the chart's edge. */
void report_chart_band(report_chart *c, const char *title, const char *colour, char along, double lo, double hi);
/* A line across the whole chart at a value of 'x' or 'y', named beside it. */
void report_chart_rule(report_chart *c, const char *text, const char *colour, char along, double at);

/* The picture; frees the chart.  Owned by the caller, NULL: nothing to draw. */
char *report_chart_svg(report_chart *c, const char *name);

/* The prefix with which the largest value of a unit reads well: "M" and 1e6 for 1.2e6 N; "" and 1 where the unit takes
 * none. */
const char *report_chart_prefix(double largest, const char *unit, double *factor);

#endif
