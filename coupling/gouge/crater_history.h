/* SPDX-License-Identifier: BSD-3-Clause */
/* A crater as a map of its scene in the history: /scene/<name>/crater/{x, z, depth}, its numbers as attributes. */
#ifndef BREECH_COUPLING_CRATER_HISTORY_H
#define BREECH_COUPLING_CRATER_HISTORY_H

#include "coupling/gouge/crater.h"
#include "coupling/output/history.h"
#include "coupling/run/scene_result.h"

/* With the classes of its scene and why.  A former one is replaced. */
status gouge_crater_record(const crater *c, const scene_result *r, history *h, const char *scene);

#endif
