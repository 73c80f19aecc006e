/* SPDX-License-Identifier: BSD-3-Clause */
/* The plastic front: how far along the rail metal is ploughed, and with what power.
 *
 * The armature's edge, pressed on, ploughs the rail over the whole width, a groove does not: what counts is the power
 * beyond what the same metal takes at the window's sides, its outer quarter across the rail. */
#ifndef BREECH_COUPLING_FRONT_H
#define BREECH_COUPLING_FRONT_H

#include "coupling/gouge/impact_scene.h"

/* As of the last look; all zero before the first.  Plain bytes: part of a checkpoint. */
typedef struct {
    double time;        /* of that look [s] */
    double front;       /* 5 % of the power lies ahead of it [m] */
    double power, peak; /* of the model as computed, beyond that of the sides: then, and the largest of all looks [W] */
} gouge_front;

/* Is it time for a look, after this step?  Every few steps, whether they are large or small; false where the groove is
 * not followed, and once the look has been taken. */
bool gouge_front_is_due(const gouge_scene *s, const mpm_report *now, const gouge_front *f);

status gouge_front_look(const gouge_scene *s, const mpm *m, gouge_front *f);

#endif
