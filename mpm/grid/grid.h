/* Nested grids: the window's, graded along each axis, and inside it boxes of cells half as wide each, level 0 the
 * finest.
 *
 * A particle belongs to the finest level whose box holds it.  Nodes of a level that its neighbour level answers for
 * follow that neighbour (seams.c): those on and beyond the faces of its own box, and those inside the box of the next
 * finer level.  A face of a box that lies on the window's end is no seam: there the boundary acts. */
#ifndef BREECH_MPM_GRID_H
#define BREECH_MPM_GRID_H

#include "mpm/grid/axis.h"

typedef struct {
    axis axes[3];
    bool seam[3][2];  /* the box's face lies inside the next coarser level */
    int lo[3], hi[3]; /* nodes of that level which the box's first and last node lie on */
    int first_site;   /* of its bricks' places among those of all levels (store.h) */
} grid_level;

typedef struct {
    int levels, sites; /* brick places in all */
    grid_level level[MPM_MAX_LEVELS];
} grids;

/* For the scene's axes as they are now.  STATUS_BAD_INPUT where the levels do not fit into the window. */
status mpm_grids_make(const mpm_scene *s, grids *out);
void mpm_grids_free(grids *g);

static inline const grid_level *grids_window(const grids *g)
{
    return &g->level[g->levels - 1];
}

/* What the levels need between a fine zone of cells `fine` and an end of the window that it does not reach [m]. */
double mpm_grids_margin(int levels, double fine);

/* Finest level whose box holds x. */
int mpm_grids_level(const grids *g, const double x[3]);

static inline bool grid_holds(const grid_level *g, const double x[3])
{
    for (int k = 0; k < 3; k++) {
        const axis *a = &g->axes[k];
        if ((g->seam[k][0] && x[k] < a->node[1]) || (g->seam[k][1] && !(x[k] < a->node[a->last]))) return false;
    }
    return true;
}

/* Does a node of this grid follow the next coarser level? */
static inline bool grid_follows_coarser(const grid_level *g, const int node[3])
{
    for (int k = 0; k < 3; k++)
        if ((g->seam[k][0] && node[k] <= 1) || (g->seam[k][1] && node[k] >= g->axes[k].last)) return true;
    return false;
}

/* Does a node of the next coarser grid follow `finer`? */
static inline bool grid_follows_finer(const grid_level *finer, const int node[3])
{
    for (int k = 0; k < 3; k++)
        if (node[k] < finer->lo[k] + finer->seam[k][0] || node[k] > finer->hi[k] - finer->seam[k][1]) return false;
    return true;
}

#endif
