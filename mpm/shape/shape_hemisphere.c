/* Hemisphere: flat face down in the plane y, centre of the face at (x, y, z); with height != radius the upper half of
 * an ellipsoid of revolution about y.
 * Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double r = hypot(x[0] - s->value[HEMISPHERE_X], x[2] - s->value[HEMISPHERE_Z]);
    return mpm_shape_dome(s->value[HEMISPHERE_RADIUS], s->value[HEMISPHERE_HEIGHT], r, x[1] - s->value[HEMISPHERE_Y]);
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[HEMISPHERE_X + k] - (k == 1 ? 0.0 : s->value[HEMISPHERE_RADIUS]);
        hi[k] = s->value[HEMISPHERE_X + k] + s->value[k == 1 ? HEMISPHERE_HEIGHT : HEMISPHERE_RADIUS];
    }
}

status mpm_shape_hemisphere_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_hemisphere, s, HEMISPHERE_RADIUS));
    return mpm_shape_positive(&mpm_shape_hemisphere, s, HEMISPHERE_HEIGHT);
}

const shape_kind mpm_shape_hemisphere = { "hemisphere", "half an ellipsoid of revolution, flat face down [m]", names,
                                          inside, bounds };
