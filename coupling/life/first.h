/* SPDX-License-Identifier: BSD-3-Clause */
/* Where the first direction of the rail is cut, from the closed field alone: no grid, no solution.
 *
 * As long as nothing is cut the body is linear and its strain is known in closed form (contact.h).  The direction with
 * the largest range over a cycle is the first to go, after N = 1 / (A range^m) cycles (L-1).
 *   pulse    the load comes and goes at one place: the range at (x, z) is that of the strain there and of zero
 *   passage  the load runs along the rail: the range at depth z is that over all x, the same at every place */
#ifndef BREECH_COUPLING_LIFE_FIRST_H
#define BREECH_COUPLING_LIFE_FIRST_H

#include "coupling/life/contact.h"
#include "mpm/fatigue.h"

typedef struct {
    double range;          /* of the measure's strain over a cycle [1] */
    double least, largest; /* strains between which it runs [1] */
    double position;       /* along the rail, from the middle of the patch; NAN of a passage: all are alike [m] */
    double depth;          /* below the face [m] */
    double angle;          /* of the direction, from the rail towards the depth, 0 .. pi [rad] */
} life_first;

typedef struct {
    double youngs, poisson; /* [Pa, 1] */
    fatigue_measure measure;
    int cycle;             /* life_cycle */
    double speed, density; /* of the load, 0: at rest; of the solid, read where it moves [m/s, kg/m3] */
} life_first_how;

life_first life_first_cut(const contact_load *l, const life_first_how *how);

#endif
