/* SPDX-License-Identifier: BSD-3-Clause */
/* Can a scene be made?  Said in the case's own keys, so that the file's line can be named. */
#ifndef BREECH_COUPLING_SCENE_POSSIBLE_H
#define BREECH_COUPLING_SCENE_POSSIBLE_H

#include "mpm/mpm.h"

/* STATUS_BAD_INPUT: all that mpm_create would refuse, that of a filled scene of bodies (scene_fill).  Its points are
 * made and freed where it has cavities. */
status scene_possible(const mpm_scene *s);

#endif
