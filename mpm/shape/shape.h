/* SPDX-License-Identifier: BSD-3-Clause */
/* For writing shapes and operations on them (solid.h has the rules). */
#ifndef BREECH_MPM_SHAPE_H
#define BREECH_MPM_SHAPE_H

#include "mpm/shape/solid.h"

#include <math.h>
#include <stdbool.h>

#define SHAPE(name) extern const mpm_solid_kind mpm_shape_##name;
#include "mpm/shape/shape.def"
#undef SHAPE

/* Rows of a kind's parameter table: a point [m], 0 or required; a length above 0 [m]. */
#define SHAPE_FARTHEST 1e3
#define SHAPE_POINT(type, member, fallback, doc) \
    PARAM_VEC3(type, member, "m", fallback, -SHAPE_FARTHEST, SHAPE_FARTHEST, doc)
#define SHAPE_PLANE(type, member, doc) PARAM_DOUBLE(type, member, "m", REQUIRED, -SHAPE_FARTHEST, SHAPE_FARTHEST, doc)
#define SHAPE_LENGTH(type, member, doc) PARAM_DOUBLE(type, member, "m", REQUIRED, 1e-9, SHAPE_FARTHEST, doc)

/* The values of a node as the struct that its table is made of, which has no members but doubles. */
#define SHAPE_VALUES(type, s) ((const type *)(const void *)(s)->value)

/* Signed distance to a simple polygon of n corners (x, y pairs, either sense), > 0 inside; exact. */
double mpm_shape_polygon(int n, const double *corner, double x, double y);

/* Of a section extruded between two planes: `profile` is the signed distance to its outline, `slab` to the nearer of
 * the planes; exact if both are. */
double mpm_shape_extrude(double profile, double slab);

/* Of half an ellipse with its flat side down on y = 0, r >= 0 from its middle: exact for height = radius, else right to
 * first order at the curved side. */
double mpm_shape_dome(double radius, double height, double r, double y);

/* The box about a middle that reaches so far along each axis. */
void mpm_shape_box_about(const double middle[3], const double down[3], const double up[3], double lo[3], double hi[3]);

#endif
