/* Cone: base down in the plane y, centre of the base at (x, y, z), tip at y + height.  Signed distance exact. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double radius = s->value[CONE_RADIUS], height = s->value[CONE_HEIGHT];
    const double section[] = { -radius, 0.0, radius, 0.0, 0.0, height };
    const double r = hypot(x[0] - s->value[CONE_X], x[2] - s->value[CONE_Z]);
    return mpm_shape_polygon(3, section, r, x[1] - s->value[CONE_Y]);
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[CONE_X + k] - (k == 1 ? 0.0 : s->value[CONE_RADIUS]);
        hi[k] = s->value[CONE_X + k] + s->value[k == 1 ? CONE_HEIGHT : CONE_RADIUS];
    }
}

status mpm_shape_cone_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_cone, s, CONE_RADIUS));
    return mpm_shape_positive(&mpm_shape_cone, s, CONE_HEIGHT);
}

const shape_kind mpm_shape_cone = { "cone", "cone on its base, tip up [m]", names, inside, bounds };
