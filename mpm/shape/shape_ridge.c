/* Ridge across the rail: half a cylinder along z, flat face down in the plane y, centre of the face at (x, y, z);
 * radius is half its width along x.  With height != radius its section is half an ellipse.
 * Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", "half_length", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double r = fabs(x[0] - s->value[RIDGE_X]), y = x[1] - s->value[RIDGE_Y];
    const double profile = mpm_shape_dome(s->value[RIDGE_RADIUS], s->value[RIDGE_HEIGHT], r, y);
    return mpm_shape_prism(profile, s->value[RIDGE_HALF_LENGTH] - fabs(x[2] - s->value[RIDGE_Z]));
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    lo[0] = s->value[RIDGE_X] - s->value[RIDGE_RADIUS];
    hi[0] = s->value[RIDGE_X] + s->value[RIDGE_RADIUS];
    lo[1] = s->value[RIDGE_Y];
    hi[1] = s->value[RIDGE_Y] + s->value[RIDGE_HEIGHT];
    lo[2] = s->value[RIDGE_Z] - s->value[RIDGE_HALF_LENGTH];
    hi[2] = s->value[RIDGE_Z] + s->value[RIDGE_HALF_LENGTH];
}

status mpm_shape_ridge_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_ridge, s, RIDGE_RADIUS));
    TRY(mpm_shape_positive(&mpm_shape_ridge, s, RIDGE_HEIGHT));
    return mpm_shape_positive(&mpm_shape_ridge, s, RIDGE_HALF_LENGTH);
}

const shape_kind mpm_shape_ridge = { "ridge", "half a cylinder across the rail, flat face down [m]", names, inside,
                                     bounds };
