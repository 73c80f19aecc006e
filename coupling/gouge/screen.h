/* SPDX-License-Identifier: BSD-3-Clause */
/* The screen: can this grain gouge at all?
 *
 * Planar impact pressure of the armature on the rail (impedance match, M-22) over the hardness of the harder
 * partner.
 * The load of a grain is carried by as much rail as the grain is high: pressure, hardness and density of the rail are
 * means over that depth, each layer by its part of it, so a film of a micrometre hardly counts under a grain of half a
 * millimetre, and counts alone where it is thicker than the grain is high.
 * The screen knows nothing of shape and lead angle, so it only skips: below study.screen_low no scene is run, above it
 * nothing is said without one.  What it skips is not impossible but improbable (`probability`), by the width of what it
 * was calibrated with, 7075 on copper: scenes with a welded grain of 0.5 mm begin to gouge at 0.608 km/s at the lowest
 * (where the default shot's interval ends), a ratio of 4.05; Stefani and Parker (1999) report gouging from 1.4 km/s,
 * 17.7 GPa, a ratio of 10.4. */
#ifndef BREECH_COUPLING_SCREEN_H
#define BREECH_COUPLING_SCREEN_H

#include "coupling/case/case_plain.h"

typedef struct {
    double impact_pressure; /* [Pa] */
    double hardness;        /* of the rail under that grain [Pa] */
    double density;         /* the same [kg/m3] */
    double ratio;           /* impact pressure over the hardness of the harder partner [1] */
    double probability;     /* that it gouges, by the ratio alone; never less than 0.01 [1] */
    bool skip;              /* below study.screen_low */
} screen;

/* A grain of that height.  STATUS_BAD_INPUT names a material that lacks what it needs. */
status gouge_screen_impact(const case_surface *s, double height, double velocity, screen *out);

/* The velocity at which the ratio is `ratio` [m/s]; INFINITY if not below 20 km/s. */
status gouge_screen_velocity(const case_surface *s, double height, double ratio, double *velocity);

/* That a grain of this ratio gouges: log-normal, 5 % and 95 % at the two ratios above [1]. */
double gouge_screen_probability(double ratio);

#endif
