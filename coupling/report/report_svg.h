/* SPDX-License-Identifier: BSD-3-Clause */
/* What every drawing of the report is made of: a picture, texts, polylines, scales and their ticks.  Internal to the
 * report.
 *
 * A picture has its own units, about as many across as a phone has pixels: its texts can be read at any width. */
#ifndef BREECH_COUPLING_REPORT_SVG_H
#define BREECH_COUPLING_REPORT_SVG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Opens a picture with a name for those who cannot see it; the writer closes it. */
void report_svg_begin(FILE *out, double width, double height, const char *name);
void report_svg_end(FILE *out);

/* Text as it stands in HTML and SVG: <, >, & and quotes escaped, what is not UTF-8 or not printable replaced. */
void report_svg_escaped(FILE *out, const char *text);
/* anchor: "start", "middle" or "end"; more: further attributes, "" for none. */
void report_svg_text(FILE *out, double x, double y, const char *anchor, const char *more, const char *text);
void report_svg_segment(FILE *out, double x0, double y0, double x1, double y1, const char *colour, double width);
double report_svg_text_width(const char *text); /* about, at the font of a picture */

/* A polyline of many points in few bytes: points that lie within a third of a unit of it are left out.  x[], y[] in the
 * picture's units; a point that is not finite breaks the line. */
void report_svg_line(FILE *out, const double *x, const double *y, size_t n, const char *colour, double width,
                     bool dashed);

/* A line between two bars, `length` long, with its text: a scale of lengths. */
void report_svg_length_bar(FILE *out, double x, double y, double length, const char *text);

/* From values to the picture's units. */
typedef struct {
    double lo, hi, from, to; /* lo is drawn at from, hi at to */
    bool log;
} report_scale;

double report_scale_at(const report_scale *s, double value);
/* Round numbers between lo and hi, about so many; *step is their distance, 0 for a logarithmic scale. */
enum { REPORT_TICKS = 24 };
int report_scale_ticks(const report_scale *s, int about, double tick[REPORT_TICKS], double *step);
/* Lines across a plot at the ticks, each labelled: of a scale to the right, from top to bottom, its labels so far
 * below; of one upwards, from left to right. */
void report_svg_grid_across(FILE *out, const report_scale *x, int about, double top, double bottom, double below);
void report_svg_grid_up(FILE *out, const report_scale *y, int about, double left, double right);
/* A title along the left edge, read upwards, its middle at y. */
void report_svg_upward_title(FILE *out, double y, const char *text);
/* As many decimals as the step needs. */
void report_scale_label(double tick, double step, char out[32]);
/* The largest of 1, 2, 5 times a power of ten that is at most x > 0. */
double report_scale_round(double x);

#endif
