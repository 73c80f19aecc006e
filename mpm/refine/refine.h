/* SPDX-License-Identifier: BSD-3-Clause */
/* Rules of refinement: where a scene wants small cells (mpm_scene.refine), asked again and again while it runs.
 *
 * A rule says of every point how large a cell may be there.  The finest level that any rule asks for at a place is made
 * active in the granules around it (grid/grid.h), and stays so for some looks after the last rule asked (adapt.c).
 * To add a kind: write mpm/refine/refine_<name>.c with `const mpm_refine_kind mpm_refine_<name>`, and one line in
 * refine.def.  Case files, keys and tests take it from there.  Every kind satisfies
 *   what it asks for depends on the scene's state now, and on no grid but by the values of points;
 *   half of its tolerance asks for cells at most half as large. */
#ifndef BREECH_MPM_REFINE_H
#define BREECH_MPM_REFINE_H

#include "base/param.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct mpm; /* mpm.h */

enum {
    MPM_REFINE_VALUES = 8,
    MPM_REFINE_EVERY = 16 /* steps of the finest level between two looks, where no rule says more */
};

typedef struct mpm_refine mpm_refine;

typedef struct {
    const char *name, *doc;
    const base_param *params; /* of the values, offsets from mpm_refine.value */
    bool of_body;             /* looks at one body, which must be given; else at all bodies where none is */
    bool mean;                /* a cell's points are heard by their mean (adapt.c), else the one that asks for most */
    int buffer;               /* cells around one that asks, of the level it asks for, that are as small */
    int every;                /* steps of the finest level between two looks that it bears */
    base_status (*check)(const mpm_refine *r, const char *name); /* what the table cannot say; NULL: nothing */
    double (*reach)(const mpm_refine *r); /* how far around a point its cell is asked for [m]; NULL: 0 */
    /* Largest cell that each of a block's points bears [m]: [LANES], infinite where any will do. */
    void (*cells)(const struct mpm *m, const mpm_refine *r, int index, double *cell);
} mpm_refine_kind;

struct mpm_refine {
    const mpm_refine_kind *kind;
    int body;    /* index; -1: all */
    double cell; /* the smallest that it asks for, 0: that of the finest level [m] */
    double value[MPM_REFINE_VALUES];
};

/* Kind by name, NULL if there is none.  mpm_refine_kind_at(i) walks the table, NULL at its end. */
const mpm_refine_kind *mpm_refine_kind_find(const char *name);
const mpm_refine_kind *mpm_refine_kind_at(int i);

/* A rule with its values at their defaults, of no body.  A value by its name, NULL: this kind has none of it. */
mpm_refine mpm_refine_make(const mpm_refine_kind *kind);
double *mpm_refine_value(mpm_refine *r, const char *name);

/* Steps of the finest level between two looks that all the rules bear. */
int mpm_refine_every(const mpm_refine *rules, int n);

/* BASE_STATUS_BAD_INPUT names the rule, the value and what it must be, unless a scene of so many bodies can have it. */
base_status mpm_refine_check(const mpm_refine *r, int bodies);

#ifdef __cplusplus
}
#endif

#endif
