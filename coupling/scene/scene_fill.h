/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene's author leaves to the program: window, cells, fine zone. */
#ifndef BREECH_COUPLING_SCENE_FILL_H
#define BREECH_COUPLING_SCENE_FILL_H

#include "mpm/scene.h"

/* Fills the members of the axes that are NAN, from the bodies:
 *   fine         a twentieth of the smallest extent of any body's bounding box
 *   coarse       4 x fine;  growth 1.2
 *   lo, hi       ends of the box round all bodies; where that end of the window is free, a quarter of the box's length
 *                beyond it and at least four coarse cells
 *   fine_lo, _hi the smallest body's box, by its volume, and half of its length on either side; cut off at the
 *                window's ends, and laid to them where no whole coarse cell would be left between
 * A fine zone is made a whole number of cells long, in multiples of what nested grids want. */
status scene_fill(mpm_scene *s); /* STATUS_BAD_INPUT: as scene_window_check */

/* Boxes that what is filled must hold too [m]; NAN: nothing more at that end. */
typedef struct {
    double lo[3], hi[3];           /* of the window, at its free ends, with a coarse cell beyond */
    double fine_lo[3], fine_hi[3]; /* of the fine zone */
} scene_room;
extern const scene_room scene_no_room; /* nothing more */
status scene_fill_with(mpm_scene *s, const scene_room *also);

#endif
