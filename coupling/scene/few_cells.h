/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies with too few cells across them for a scene to say what becomes of them. */
#ifndef BREECH_COUPLING_SCENE_FEW_CELLS_H
#define BREECH_COUPLING_SCENE_FEW_CELLS_H

#include "mpm/scene.h"

#define SCENE_FEW_CELLS 3.0 /* with fewer a body has no inside: one row of cells at each face, and none between */
#define SCENE_FEW_CELLS_OF_LAYER \
    2.0 /* of one that fills the window along an axis: cases/verification has such plates */

/* Has this body fewer cells than that across its smallest extent?  Then `text` says so.  The extent is that of its
 * bounding box: a hollow or a slanted body may be thinner.  An axis along which it fills the window from end to end
 * does not count; where it ends at a mirror it is twice as long.  Cells grow with the distance from the fine zone;
 * where rules or levels make them, they count as the smallest.  s: filled. */
bool scene_few_cells(const mpm_scene *s, int body, char text[400]);

#endif
