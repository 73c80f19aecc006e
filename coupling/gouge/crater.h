/* SPDX-License-Identifier: BSD-3-Clause */
/* The crater: what the rail's surface looks like after the pass, and what class of damage that is.
 *
 * Surface.  Over the map lies a lattice of sample lines, two a cell and axis, at its Gauss points (irrational, so that
 * lines keep off the borders between points).  Along each line the points whose footprint
 * (position +- half lengths) it meets are walked up from below; failed points (damage >= 1) are left out.  The walk
 * ends at the first gap wider than 1.2 times the distance at which the two points beside it would touch: one missing
 * point is bridged, what floats higher is debris, and so is a flap over a deeper cavity.  Points coarser than the map
 * (no half length below cell / 2) may touch as far as their largest half length reaches, and those beside a line,
 * within twice their half lengths of it, close its gaps: merged ones leave slits.
 * The height is position + half length of the last point.  A sample above all of its eight neighbours, or below both
 * of those along x or along z, is set to the nearest of them: spikes of one sample and slits one sample wide, however
 * long, are the lattice's.  A map cell is the mean of its samples, so an undisturbed rail has depth 0 to rounding
 * whatever the sizes of its points; a line that meets nothing of the rail's lower half is left out (the rail ends
 * there), depth 0.  Choose `cell` about the fine grid's cell.
 *
 * Measures, at the measuring depth d_m, unless given max(particle_radius / 6, cell / 2), the same for three cells a
 * radius and all finer ones, d the depth, downstream = +x:
 *   the crater is the cells with d > d_m that hang together (by edge or corner), with every other such patch that has a
 *   tenth of its volume; its outline is where d = d_m between cell centres, linearly;
 *   length, width     extents of the outline along x, and across z at its widest
 *   depth, deepest_x  largest d and where
 *   volume     V = sum of d w(d) over all cells, w rising smoothly from 0 at d_m to 1 at 1.5 d_m              (M-20)
 *   [m3]
 *   lean       6 <x - x_middle> / length, the mean over V: 0 for a groove of constant section, 1 for a wedge that
 *   begins at
 *              a point, negative for a groove that dies out
 *   severity   (lean V - A h) / V_p, A, h, V_p plan area, height and volume of the particle                   (M-21)
 *   [1]
 *   widening   mean width of the downstream third of the length over that of the upstream third
 *   rim_height largest height above the surface within max(width, 4 particle_radius) of the crater, rim_x where
 * Because w is smooth, V and severity are continuous in the surface: a shallow scratch does not jump in as a whole when
 * it passes d_m, and springback or noise below d_m counts nothing.  Severity is - A h / V_p (-1.5 for a hemisphere)
 * without a crater; below that where the groove dies out, however long it is; it passes 0 where what grows downstream
 * exceeds the grain's cylinder A h.  V alone would not do: at 1.0 km/s the groove of a 0.5 mm grain holds 2.1 mm3,
 * five times A h, and dies out after 6 mm; at 1.5 km/s it grows until the armature has passed.
 *
 * Class, by the shape alone.  none: no cell above d_m.  gouge: severity and widening at or above their limits and a
 * rim higher than d_m downstream of the crater's middle.  scratch: severity below its limit, and not both widening and
 * rim.  Else undecided. */
#ifndef BREECH_MPM_CRATER_H
#define BREECH_MPM_CRATER_H

#include "base/status.h"
#include "coupling/run/damage_class.h"

#include <stdbool.h>
#include <stddef.h>

/* The material points of the rail (and welded layers) down to well below the crater; arrays of n, borrowed. */
typedef struct {
    size_t n;
    const double *position; /* n x 3 [m] */
    const double *size;     /* n x 3 half lengths [m] */
    const double *damage;   /* n, failed at 1 */
} crater_points;

typedef struct {
    double surface;                          /* y of the undamaged rail surface [m] */
    double x_lo, x_hi, z_hi;                 /* region to map: x_lo..x_hi, z 0..z_hi (mirrored) or -z_hi..z_hi [m] */
    bool mirrored;                           /* the scene is the half z >= 0: the map is doubled */
    double cell;                             /* size of a map cell [m] */
    double measuring_depth;                  /* d_m; 0: as it comes [m] */
    double particle_radius, particle_height; /* of the grain, which sat at z = 0 [m] */
    double particle_volume, particle_area;   /* of the whole grain [m3, m2] */
    double limit_widening;                   /* 1.5 */
    double limit_severity;                   /* 0 */
} crater_spec;

typedef struct {
    damage_class class;
    char reason[200];                                /* the numbers behind the class, in words */
    double severity, widening, lean;                 /* [1]; without a crater all but severity is 0 */
    double length, width, depth, volume, rim_height; /* [m, m3] */
    double rim_x, deepest_x;                         /* [m] */
    double measuring_depth;                          /* d_m [m] */
    bool truncated;        /* the crater reaches the map's edge: length and volume are lower bounds */
    int nx, nz;            /* the map, full width */
    double x0, z0, dx, dz; /* first map cell's centre and spacing [m] */
    double *depth_map;     /* nx x nz, depth below the surface, rim negative [m]; owned */
} crater;

/* STATUS_BAD_INPUT when the spec makes no sense or the region holds no rail; `out` then needs no gouge_crater_free. */
status gouge_crater_measure(const crater_points *points, const crater_spec *spec, crater *out);
void gouge_crater_free(crater *c);

/* d_m of a crater that is measured so [m]. */
double gouge_crater_measuring_depth(const crater_spec *spec);

/* NAN where there is no crater [1]. */
double gouge_crater_length_over_width(const crater *c);

#endif
