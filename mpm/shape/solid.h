/* SPDX-License-Identifier: BSD-3-Clause */
/* Solids: the volume that a body fills at the start.
 *
 * A solid is a shape (a box, a sphere) or an operation on other solids (minus, turn).  A tree of them lies in an array,
 * parts before what is made of them, so that its last node is its root:
 *
 *      [0] box   [1] sphere   [2] move [1]   [3] minus [0] [2]          a box with a moved ball cut out of it
 *
 * A node says how many places before it its parts stand: a tree may be copied to any other place as it is, and several
 * nodes may share a part.
 *
 * To add one: write mpm/shape/shape_<name>.c with `const mpm_solid_kind mpm_shape_<name>`, and one line in shape.def.
 * Case files, checks and tests take it from there.  Every kind satisfies, for values that its check accepts,
 *   inside > 0 in the solid, < 0 outside, continuous everywhere;
 *   |inside| is at most the distance to the surface [m] and, near the surface, equal to it;
 *   bounds is a box that holds the solid.
 * Of an operation, and of a lattice cut off at its box, the distance is right away from the edges that it makes; of any
 * other shape everywhere near the surface, and its bounds are the smallest box.  tests/test_shapes.c checks these and
 * the volume for the whole table. */
#ifndef BREECH_MPM_SOLID_H
#define BREECH_MPM_SOLID_H

#include "base/param.h"
#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { MPM_SOLID_VALUES = 40, MPM_SOLID_PARTS = 2 };

typedef struct mpm_solid mpm_solid;

typedef struct {
    const char *name, *doc;
    const base_param *params; /* of the values, offsets from mpm_solid.value; m, rad or 1 */
    int parts;                /* 0: a shape; else an operation on so many solids */
    double (*inside)(const mpm_solid *s, const double x[3]);        /* signed distance [m] */
    void (*bounds)(const mpm_solid *s, double lo[3], double hi[3]); /* [m] */
    base_status (*check)(const mpm_solid *s, const char *name);     /* checks beyond the table's ranges; NULL: none */
    double (*looks)(const mpm_solid *s); /* mpm_solid_looks; NULL: one at each of its parts, itself without any */
} mpm_solid_kind;

struct mpm_solid {
    const mpm_solid_kind *kind;
    double value[MPM_SOLID_VALUES]; /* by the kind's table; lengths [m], angles [rad] */
    int part[MPM_SOLID_PARTS];      /* how many places before this one its parts stand; 0: none */
};

/* Kind by name, NULL if there is none.  mpm_solid_kind_at(i) walks the table, NULL at its end. */
const mpm_solid_kind *mpm_solid_kind_find(const char *name);
const mpm_solid_kind *mpm_solid_kind_at(int i);

/* A node with its values at their defaults and no parts. */
mpm_solid mpm_solid_make(const mpm_solid_kind *kind);

/* A value by its name: one number, three of a vector, pairs of a list.  NULL: this kind has none of that name. */
double *mpm_solid_value(mpm_solid *s, const char *name);
const double *mpm_solid_get(const mpm_solid *s, const char *name);

/* Part number i of a node that stands in its array. */
const mpm_solid *mpm_solid_part(const mpm_solid *s, int i);

/* Of the whole tree under a node that stands in its array, at `place` of it.  BASE_STATUS_BAD_INPUT names the value,
 * its size and what it must be. */
double mpm_solid_inside(const mpm_solid *s, const double x[3]);
void mpm_solid_bounds(const mpm_solid *s, double lo[3], double hi[3]);
base_status mpm_solid_check(const mpm_solid *s, int place);
/* Shapes that mpm_solid_inside looks at for one place, at most. */
double mpm_solid_looks(const mpm_solid *s);

#ifdef __cplusplus
}
#endif

#endif
