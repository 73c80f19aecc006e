/* SPDX-License-Identifier: BSD-3-Clause */
/* What a stopped scene goes on from: the watch's state and the solver's image as one row of bytes.  Writing it:
 * scene_image in scene_run.h. */
#ifndef BREECH_COUPLING_SCENE_IMAGE_H
#define BREECH_COUPLING_SCENE_IMAGE_H

#include "coupling/scene/scene_run.h"

/* Into a solver made from the same scene and the watch's state.  STATUS_BAD_INPUT: not of this kind of scene. */
status scene_image_take_up(const scene_resume *from, const scene_watch *watch, mpm *m);

#endif
