/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_shelf.h"

#include <stdlib.h>

static void clear(shelved_scene *item)
{
    free(item->image);
    host_h5_close(item->rows);
    *item = (shelved_scene){ .twin = 0 };
}

void scene_shelf_put(scene_shelf *s, const shelved_scene *item)
{
    clear(&s->item[s->oldest]);
    s->item[s->oldest] = *item;
    s->oldest = (s->oldest + 1) % SCENE_SHELF_ROOM;
}

const shelved_scene *scene_shelf_find(const scene_shelf *s, uint64_t twin)
{
    for (int i = 0; i < SCENE_SHELF_ROOM; i++)
        if (twin && s->item[i].twin == twin) return &s->item[i];
    return NULL;
}

void scene_shelf_clear(scene_shelf *s)
{
    for (int i = 0; i < SCENE_SHELF_ROOM; i++) clear(&s->item[i]);
}
