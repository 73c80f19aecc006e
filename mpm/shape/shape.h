/* Shapes: the volume a body fills at the start.
 *
 * To add one: write mpm/shape/shape_<name>.c with `const shape_kind mpm_shape_<name>` and `mpm_shape_<name>_check`, and
 * one line in shape.def.  Every shape satisfies, for values that its check accepts,
 *   inside > 0 in the shape, < 0 outside, and near the surface |inside| is the distance to it [m];
 *   bounds is the smallest box that holds the shape;
 *   the shape is one piece, and inside is continuous everywhere.
 * tests/test_shapes.c checks these and the volume for the whole table. */
#ifndef BREECH_MPM_SHAPE_H
#define BREECH_MPM_SHAPE_H

#include "mpm/scene.h"

/* STATUS_BAD_INPUT naming the value, its size and what it must be, unless the values make a shape of this kind. */
status mpm_shape_check(const shape_kind *kind, const shape_values *values);

#define SHAPE(name)                           \
    extern const shape_kind mpm_shape_##name; \
    status mpm_shape_##name##_check(const shape_values *s);
#include "mpm/shape/shape.def"
#undef SHAPE

/* Places of the values of those shapes that scenes are built from by name. */
enum { HEMISPHERE_X, HEMISPHERE_Y, HEMISPHERE_Z, HEMISPHERE_RADIUS, HEMISPHERE_HEIGHT };
enum { PIT_X, PIT_Y, PIT_Z, PIT_RADIUS, PIT_HEIGHT };
enum { CONE_X, CONE_Y, CONE_Z, CONE_RADIUS, CONE_HEIGHT };
enum { RIDGE_X, RIDGE_Y, RIDGE_Z, RIDGE_RADIUS, RIDGE_HEIGHT, RIDGE_HALF_LENGTH };
enum { CYLINDER_X, CYLINDER_Y, CYLINDER_Z, CYLINDER_RADIUS, CYLINDER_HEIGHT };
enum { SPHERE_X, SPHERE_Y, SPHERE_Z, SPHERE_RADIUS };
enum { BOX_LO, BOX_HI = 3 };
enum {
    ARMATURE_X_FRONT,
    ARMATURE_LENGTH,
    ARMATURE_LEG_THICKNESS,
    ARMATURE_HEAD_THICKNESS,
    ARMATURE_HALF_BORE,
    ARMATURE_CHAMFER_HEIGHT,
    ARMATURE_LEAD_ANGLE,
    ARMATURE_HALF_WIDTH,
    ARMATURE_Y0
};

/* ---- helpers for writing a shape ---- */

/* Signed distance to a simple polygon of n corners (x, y pairs, either sense), > 0 inside; exact. */
double mpm_shape_polygon(int n, const double *corner, double x, double y);

/* Of a prism: `profile` is the signed distance to its section, `slab` to the slab between its ends; exact if both are.
 */
double mpm_shape_prism(double profile, double slab);

/* Of half an ellipse with its flat side down on y = 0, r >= 0 from its middle: exact for height = radius, else right to
 * first order at the curved side. */
double mpm_shape_dome(double radius, double height, double r, double y);

/* Checks that value[i] > 0; the text names it. */
status mpm_shape_positive(const shape_kind *kind, const shape_values *s, int i);

#endif
