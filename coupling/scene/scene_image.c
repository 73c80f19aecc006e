/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_image.h"

#include <stdlib.h>
#include <string.h>

/* The size of the watch's state, that state, the solver's image. */

static size_t state_bytes(const scene_watch *w)
{
    return w ? w->state_bytes : 0;
}

status scene_image(const scene_now *now, void **image, size_t *bytes)
{
    const uint64_t own = state_bytes(now->watch);
    const size_t head = sizeof own + (size_t)own;
    void *solver;
    size_t solver_bytes;
    *image = NULL;
    TRY(mpm_save(now->m, &solver, &solver_bytes));
    char *all = realloc(solver, head + solver_bytes);
    if (!all) free(solver);
    CHECK(all, STATUS_MEMORY, "no memory for a checkpoint of %zu bytes", head + solver_bytes);
    memmove(all + head, all, solver_bytes);
    memcpy(all, &own, sizeof own);
    if (own) memcpy(all + sizeof own, now->watch->state, (size_t)own);
    *image = all;
    *bytes = head + solver_bytes;
    return status_ok();
}

status scene_image_take_up(const scene_resume *from, const scene_watch *watch, mpm *m)
{
    const char *data = from->image;
    uint64_t own;
    CHECK(from->bytes >= sizeof own, STATUS_BAD_INPUT, "checkpoint: %zu bytes are no scene", from->bytes);
    memcpy(&own, data, sizeof own);
    CHECK(own == state_bytes(watch) && own <= from->bytes - sizeof own, STATUS_BAD_INPUT,
          "checkpoint: is of another kind of scene; start over with --force");
    if (own) memcpy(watch->state, data + sizeof own, (size_t)own);
    const size_t head = sizeof own + (size_t)own;
    return mpm_restore(m, data + head, from->bytes - head);
}
