/* Wedge across the rail: a triangular prism along z, its base down in the plane y, centre of the base at (x, y, z), its
 * edge at y + height; radius is half its width along x.  Values as those of the ridge.  Signed distance exact. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", "half_length", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double radius = s->value[RIDGE_RADIUS], height = s->value[RIDGE_HEIGHT];
    const double section[] = { -radius, 0.0, radius, 0.0, 0.0, height };
    const double profile = mpm_shape_polygon(3, section, x[0] - s->value[RIDGE_X], x[1] - s->value[RIDGE_Y]);
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

status mpm_shape_wedge_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_wedge, s, RIDGE_RADIUS));
    TRY(mpm_shape_positive(&mpm_shape_wedge, s, RIDGE_HEIGHT));
    return mpm_shape_positive(&mpm_shape_wedge, s, RIDGE_HALF_LENGTH);
}

const shape_kind mpm_shape_wedge = { "wedge", "triangular prism across the rail, base down [m]", names, inside,
                                     bounds };
