/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts of crater.c: what the surface looks like, and what of it is the crater (rules in crater.h). */
#ifndef BREECH_MPM_CRATER_PARTS_H
#define BREECH_MPM_CRATER_PARTS_H

#include "coupling/gouge/crater.h"

/* crater_map.c: lays out the map of `c` and fills depth_map (malloc'ed; gouge_crater_free). */
status gouge_crater_map(const crater_points *points, const crater_spec *spec, crater *c);

/* crater_outline.c */

/* Outline of the crater in a row of cells across the rail; lo, hi [m]; hi < lo if the row has none. */
typedef struct {
    double lo, hi;
    double deepest; /* [m] */
    int first, last;
} crater_section;

typedef struct {
    crater_section *row;           /* nx; owned */
    int first, last;               /* rows of the crater; -1: there is none */
    double x_lo, x_hi, z_lo, z_hi; /* outline [m] */
} crater_outline;

/* The map's cells that belong to the crater and their outline; the caller frees o->row. */
status gouge_crater_trace(const crater *c, crater_outline *o);

#endif
