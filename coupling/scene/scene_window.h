/* SPDX-License-Identifier: BSD-3-Clause */
/* Is a scene's window one that cells and bodies fit into?  Said in the case's own keys, so that the file's line can be
 * named; what an axis does not give itself is looked for at the key for all axes. */
#ifndef BREECH_COUPLING_SCENE_WINDOW_H
#define BREECH_COUPLING_SCENE_WINDOW_H

#include "mpm/scene.h"

/* STATUS_BAD_INPUT: ends the wrong way round, a window shorter than a cell, cells that contradict each other, a fine
 * zone beside the window, levels that do not fit, a body or a probe beside the window.  s: filled (scene_fill). */
status scene_window_check(const mpm_scene *s);

/* Does the window cut a body that moves, at an end where nothing stands for the rest of it?  Then `text` says so. */
bool scene_window_cuts(const mpm_scene *s, int body, char text[400]);

/* Along an axis of too few cells for its shift, as in plane strain, the grid of a filled scene has its own one. */
void scene_window_limit_shift(mpm_scene *s, const double own[3]);

#endif
