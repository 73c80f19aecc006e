/* The screen: can this site gouge at all?
 *
 * Planar impact pressure of the armature on the rail's surface (impedance match, M-22) over the hardness of the harder
 * partner.  It knows nothing of size, shape and lead angle, so it only skips: below study.screen_low no scene is
 * needed, above it nothing is said without one.  Stefani and Parker (1999): 7075 on copper gouges from 1.4 km/s,
 * 17.7 GPa, a ratio of about 10. */
#ifndef BREECH_COUPLING_SCREEN_H
#define BREECH_COUPLING_SCREEN_H

#include "coupling/case/case_plain.h"

typedef struct {
    double impact_pressure; /* [Pa] */
    double ratio;           /* over the hardness of the harder partner [1] */
    bool skip;              /* below study.screen_low */
} screen;

/* STATUS_BAD_INPUT names a material that lacks what it needs. */
status gouge_screen_impact(case_surface s, double velocity, screen *out);

/* The velocity at which the ratio is `ratio` [m/s]; INFINITY if not below 20 km/s. */
status gouge_screen_velocity(case_surface s, double ratio, double *velocity);

#endif
