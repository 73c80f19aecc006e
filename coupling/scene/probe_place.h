/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a scene's probes are: in its window, and where something is to be read. */
#ifndef BREECH_COUPLING_SCENE_PROBE_PLACE_H
#define BREECH_COUPLING_SCENE_PROBE_PLACE_H

#include "mpm/scene.h"

/* STATUS_BAD_INPUT: the point or the box of a probe lies beside the window, where there will never be anything to
 * read; said at the key that gives it.  Probes without a place pass.  s: filled. */
status scene_probe_place_check(const mpm_scene *s, int probe);

/* Has the probe a box that none of what it reads reaches into at the start?  Then `text` says so.  Thin parts of
 * lattices may be missed. */
bool scene_probe_is_empty(const mpm_scene *s, int probe, char text[400]);

#endif
