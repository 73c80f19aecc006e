/* SPDX-License-Identifier: BSD-3-Clause */
/* A surface z(x, y) over a regular grid, drawn: in colours from above, and shaded, as seen from above and aside.
 * Internal to the report.
 *
 *     from above                         aside
 *      +--------------------+               ________________
 *      |    .--------.      |  across      /   .------.     /|
 *      |   (   deep   )     |             /   (  deep  )   / /    the near side and the end are walls
 *      |    '--------'      |            /_____'------'___/ /
 *      +--------------------+            |________________|/
 *       along, launch to the right
 *
 * Seen from above every level's area is one path, whose edge lies between the grid's points where the value is the
 * level's (marching squares), so it is smooth and small.  Aside, the far strips are drawn first and the near ones over
 * them (painter's algorithm). */
#ifndef BREECH_COUPLING_REPORT_RELIEF_H
#define BREECH_COUPLING_REPORT_RELIEF_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const double *height;  /* nx x ny, [i * ny + j], all finite; borrowed */
    size_t nx, ny;         /* at least 2 each */
    double x0, dx, y0, dy; /* first point and step [m] */
    double colour_range;   /* height and depth at which the darkest colours stand, > 0 */
    double unit;           /* of the legend's numbers; negative: they are depths */
    const char *legend;    /* what they are */
    const char *above;     /* text over the picture */
    bool marked;           /* a ring at mark[], its x and y [m] */
    double mark[2];
} report_relief;

/* The part of the grid in which |height| is at least `least`, with some room around it and not too narrow: a relief of
 * its own in the same memory where it takes all of y, else of the memory that is returned (owned by the caller, NULL:
 * no memory). */
double *report_relief_crop(report_relief *s, double least);

/* Pictures, owned by the caller; NULL: no memory.  Aside, heights are smoothed over neighbouring points. */
char *report_relief_map(const report_relief *s, const char *name);
char *report_relief_aside(const report_relief *s, const char *name, double *exaggeration);

#endif
