/* SPDX-License-Identifier: BSD-3-Clause */
/* A shelf of scenes that their watch ended early, to go on from: where the whole scene is wanted too, its beginning
 * need not be computed twice.  To the same bits as from the start; what is not on the shelf is computed. */
#ifndef BREECH_COUPLING_SCENE_SHELF_H
#define BREECH_COUPLING_SCENE_SHELF_H

#include "coupling/output/history.h"

enum { SCENE_SHELF_ROOM = 4 }; /* each takes the memory of its material points */

typedef struct {
    uint64_t twin;       /* hash of what makes the scene, but for where it ends (scene_run.h); 0: an empty place */
    double time, before; /* reached, and a step earlier [s] */
    double wall;         /* spent [s] */
    void *image;         /* scene_image's; owned */
    size_t bytes;
    h5_file *rows; /* its series, as in a stored scene; owned; NULL: none */
} shelved_scene;

typedef struct {
    shelved_scene item[SCENE_SHELF_ROOM]; /* all zero: an empty shelf */
    int oldest;
} scene_shelf;

/* Takes it over, in place of the oldest. */
void scene_shelf_put(scene_shelf *s, const shelved_scene *item);
/* NULL: it is not there.  The shelf's. */
const shelved_scene *scene_shelf_find(const scene_shelf *s, uint64_t twin);
void scene_shelf_clear(scene_shelf *s);

#endif
