/* SPDX-License-Identifier: BSD-3-Clause */
/* The armature's volume: half of a U on one rail, a prism along z about z = 0 that moves towards +x.
 *
 *      half_bore  . . . . . . . . . . . . . . +-----------------+   mid plane between the rails
 *                                             |                 |
 *                                             |      head       |
 *                       +---------------------+                 |
 *                       |   leg                                /    lead face, lead_angle to the rail's surface
 *      y = 0  ----------+-------------------------------------+---------------------  rail
 *                     back                                  front   nose
 *
 * The leg trails, the head is in front; leg and head share the contact face y = 0, which ends at the front.  There the
 * lead face rises to chamfer_height: nose = front + chamfer_height / tan(lead_angle).  length and head_thickness count
 * back from the nose. */
#ifndef BREECH_COUPLING_ARMATURE_H
#define BREECH_COUPLING_ARMATURE_H

#include "mpm/shape/solid.h"

typedef struct {
    double front, length, leg_thickness, head_thickness, half_bore, chamfer_height; /* [m] */
    double lead_angle; /* [rad]; pi/2, or chamfer_height 0, for a square front */
    double half_width; /* [m] */
} gouge_armature;

/* STATUS_BAD_INPUT naming the value unless they make such a shape. */
status gouge_armature_check(const gouge_armature *a);

/* Area of the section [m2]:  length leg + head (half_bore - leg) - chamfer_height^2 / (2 tan lead_angle)
 * while the chamfer stays below the leg's top or within the head. */
double gouge_armature_section(const gouge_armature *a);

/* Fills the values of a node of kind `prism`. */
void gouge_armature_fill(const gouge_armature *a, mpm_solid *prism);

#endif
