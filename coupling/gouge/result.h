/* SPDX-License-Identifier: BSD-3-Clause */
/* A gouging scene's result, full model, from what the solver and the watch over it say. */
#ifndef BREECH_COUPLING_GOUGE_RESULT_H
#define BREECH_COUPLING_GOUGE_RESULT_H

#include "coupling/gouge/watch.h"
#include "coupling/run/scene_result.h"

/* w after its scene is over. */
scene_result gouge_result(const gouge_scene *s, const gouge_watch *w, const scene_outcome *o);

#endif
