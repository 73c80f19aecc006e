/* SPDX-License-Identifier: BSD-3-Clause */
/* From the first cut to a crack: the rail under a load that comes again and again, while its directions are cut.
 *
 *   1  the strain of the intact rail, on a grid about the patch; its sides and bottom have the displacement of the
 *      half space (contact.h, L-3); points are the cells' middles, in the top row the middles of their faces
 *   2  range of every direction of every point in a cycle, cycles to the next cut, cuts (mpm/fatigue.h)
 *   3  the elasticity of the points that lost a direction, the strain again, back to 2
 *   until at one point the share of its directions that are cut, its index, reaches the limit: a crack.
 *
 * On the face pressure and traction are known, so that its strain follows from the strain along it alone; middles of
 * cells would miss what changes most within the first cell.  What the grid misses of the strain along the face of the
 * intact rail, at the patch's ends, is known from the closed field and added.
 *
 * The elasticity of a point is a sum over its directions n, with the strain e = n . strain . n of each,
 *   stress = sum_k c_k e_k n n + rest,    sum_k c_k = 8 b,  b = min(lambda, G)                                   (L-6)
 * and a rest of what an isotropic solid has beside: of nu > 1/4 an even pressure (lambda - b) tr(strain).  A direction
 * that is cut carries no tension, but for a thousandth; compression goes through it as before.  The rest loses the
 * share of the index in tension.  nu = 1/4 has no rest: it is the bond-based body of peridynamics.
 *
 * In a passage all places of a depth are alike: a direction is cut at all of them, and the point is the row. */
#ifndef BREECH_COUPLING_LIFE_CRACK_H
#define BREECH_COUPLING_LIFE_CRACK_H

#include "coupling/life/first.h"

typedef struct {
    const contact_load *load;
    life_first_how how;
    fatigue_law law;
    fatigue_fan fan;
    int cells;         /* of the grid, in a half length of the patch */
    double wide, deep; /* the grid: half its width, its depth [half lengths of the patch] */
    double limit;      /* index of a crack [1] */
    double batch;      /* cuts within this fraction of the cycles are one step [1] */
    int most_cuts;     /* 0: the intact rail alone */
    int threads;
    void (*step)(void *user,
                 double fraction); /* of the limit that the largest index has reached; NULL: nobody is told */
    bool (*stop)(void);            /* NULL: never */
    void *user;
} life_crack_how;

typedef struct {
    double life;            /* cycles to a crack; NAN: none within most_cuts */
    double position, depth; /* where; position NAN of a passage [m] */
    double angle;           /* mean of its cut directions [rad] */
    double first;           /* cycles to the first cut on the grid */
    double alone;           /* cycles to a crack if no cut changed a strain */
    double field_error;     /* rms of stress against the closed field, over the peak pressure, from a tenth of a
                                   half length down [1] */
    double face_error;      /* largest of the strain along the face within the patch, over the peak's [1] */
    int cuts, solves, iterations;
    int unsettled;              /* solutions after which directions still opened and closed */
    int nx, nz;                 /* points along the rail and in depth; of a passage too, all alike along the rail */
    double cell;                /* [m] */
    double *least_life, *index; /* of point (i, j) at i nz + j; owned */
} life_crack;

life_crack life_crack_none(void); /* nothing is known */
/* *out needs life_crack_free, also after an error.  STATUS_STOPPED: `stop` said so. */
status life_crack_find(const life_crack_how *c, life_crack *out);
void life_crack_free(life_crack *c);

#endif
