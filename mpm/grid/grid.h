/* SPDX-License-Identifier: BSD-3-Clause */
/* Levels of the grid: the same window in cells of h, 2h, 4h, ..., level 0 the finest.  Where which level rules is
 * decided granule by granule.
 *
 *   element   the box between eight nodes of a level; element e of an axis lies between nodes e + 1 and e + 2
 *   granule   2 x 2 x 2 elements of a level, the children of one of the next coarser one
 *
 * A granule of a level is active, or it is not: then its elements are left to the coarser levels.  The coarsest level
 * is active everywhere.  A point belongs to the finest level that is active where the point is.
 *
 *   +-------+---+---+-+-+     A row of elements of three levels.  Two elements beside an active granule, of the next
 *   |       |   |   +-+-+     coarser level, that level is active too (mpm_grids_nest): so two changes of level lie so
 *   +-------+---+---+-+-+     far apart that no point reaches both, and no node takes its motion from a node that
 *                             takes it from another (interface.c).
 */
#ifndef BREECH_MPM_GRID_H
#define BREECH_MPM_GRID_H

#include "mpm/grid/axis.h"

enum {
    GRANULE = 2,      /* elements an axis */
    GRANULE_LIFE = 2, /* looks after the last that asked for it (refine/adapt.c) */
    PAGE = 8,         /* bricks an axis */
    PAGE_PLACES = PAGE * PAGE * PAGE,
    PAGE_GRANULES = 2 * PAGE, /* granules an axis: brick (k) of nodes 4k .. 4k + 3 lies at granules 2k, 2k + 1 */
    PAGE_FLAGS = PAGE_GRANULES * PAGE_GRANULES * PAGE_GRANULES
};

typedef struct {
    axis axes[3];
    int granules[3];
    int pages[3]; /* along each axis */
    int *page;    /* [pages] owned: number of the page there plus one, 0: none so far */
} grid_level;

/* Which page: of a level, number in its table. */
typedef struct {
    int level, index;
} grid_page;

/* What is known of a granule or of a brick's place is kept in pages that are made where they are needed, so an empty
 * window of any size costs next to nothing.  A place: PAGE_PLACES page + the brick's number in it; a granule's flags
 * likewise: PAGE_FLAGS page + its number. */
typedef struct {
    int levels;
    grid_level level[MPM_MAX_LEVELS];
    int pages, room;
    grid_page *page; /* [pages] owned */
    uint8_t
        *active; /* [flags] owned: looks that the granule stays active, 0: it is not.  Of the coarsest level: all are */
    uint8_t *before; /* [flags] owned: was it active before the last look? */
} grids;

/* For the scene's axes as they are now, the finer levels active where the fine zones of all three axes meet. */
status mpm_grids_make(const mpm_scene *s, grids *out);
void mpm_grids_free(grids *g);

/* Is the window of a scene whose levels are filled long enough along axis k for the shift of its grid? */
bool mpm_grids_hold_shift(const mpm_scene *s, int k);

/* Makes every level active that those finer than it need around them. */
status mpm_grids_nest(grids *g);

/* Makes a level active in all granules that hold a part of the box [m]. */
status mpm_grids_activate(grids *g, int level, const double lo[3], const double hi[3]);
/* The finest level where the fine zones of all three axes meet, moved with the grid. */
status mpm_grids_activate_zone(grids *g, const mpm_scene *s);

/* The pages of another grid of the same axes, with their numbers; nothing is active.  STATUS_IO: not of these axes. */
status mpm_grids_take_pages(grids *g, const grid_page *page, int pages);

/* The place of a brick, with its page. */
status mpm_grids_add_place(grids *g, int level, const int at[3], int *place);

static inline const grid_level *grids_window(const grids *g)
{
    return &g->level[g->levels - 1];
}

static inline int grids_places(const grids *g)
{
    return g->pages * PAGE_PLACES;
}

static inline int grids_flags(const grids *g)
{
    return g->pages * PAGE_FLAGS;
}

/* The coarsest level whose cells are no larger along any axis; the finest where there is none. */
int mpm_grids_level_for(const mpm_scene *s, double cell);

/* Finest level that is active at x; beyond the window as at its end. */
int mpm_grids_level(const grids *g, const double x[3]);

static inline int grid_elements(const grid_level *g, int k)
{
    return g->axes[k].last - 1;
}

static inline int grid_clamp(int i, int n)
{
    return i < 0 ? 0 : i < n ? i : n - 1;
}

/* Which entry of a level's table a page has, from where something lies in pages of n an axis. */
static inline int grid_page_index(const grid_level *l, const int at[3], int n)
{
    return (at[2] / n * l->pages[1] + at[1] / n) * l->pages[0] + at[0] / n;
}

/* Where something is kept that has n an axis of a page; -1 where no page has been made. */
static inline int grids_slot(const grids *g, int level, const int at[3], int n)
{
    const int page = g->level[level].page[grid_page_index(&g->level[level], at, n)];
    const int in = (at[2] % n * n + at[1] % n) * n + at[0] % n;
    return page ? (page - 1) * n * n * n + in : -1;
}

static inline int grids_place(const grids *g, int level, const int at[3])
{
    return grids_slot(g, level, at, PAGE);
}

/* Beyond the window that of the granule at its end. */
static inline int grids_flag(const grids *g, int level, int x, int y, int z)
{
    const grid_level *l = &g->level[level];
    const int at[3] = { grid_clamp(x, l->granules[0]), grid_clamp(y, l->granules[1]), grid_clamp(z, l->granules[2]) };
    return grids_slot(g, level, at, PAGE_GRANULES);
}

static inline bool granule_is_active(const grids *g, int level, int x, int y, int z)
{
    if (level == g->levels - 1) return true;
    const int flag = grids_flag(g, level, x, y, z);
    return flag >= 0 && g->active[flag] > 0;
}

/* Has the last look made it active or ended that? */
static inline bool granule_has_changed(const grids *g, int level, int x, int y, int z)
{
    const int flag = level < g->levels - 1 ? grids_flag(g, level, x, y, z) : -1;
    return flag >= 0 && g->before[flag] != (g->active[flag] > 0);
}

#endif
