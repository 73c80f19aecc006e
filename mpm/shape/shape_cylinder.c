/* Cylinder: axis along y, centre of its lower face at (x, y, z).  Signed distance exact. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double r = hypot(x[0] - s->value[CYLINDER_X], x[2] - s->value[CYLINDER_Z]);
    const double y = x[1] - s->value[CYLINDER_Y];
    return mpm_shape_prism(s->value[CYLINDER_RADIUS] - r, fmin(y, s->value[CYLINDER_HEIGHT] - y));
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[CYLINDER_X + k] - (k == 1 ? 0.0 : s->value[CYLINDER_RADIUS]);
        hi[k] = s->value[CYLINDER_X + k] + s->value[k == 1 ? CYLINDER_HEIGHT : CYLINDER_RADIUS];
    }
}

status mpm_shape_cylinder_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_cylinder, s, CYLINDER_RADIUS));
    return mpm_shape_positive(&mpm_shape_cylinder, s, CYLINDER_HEIGHT);
}

const shape_kind mpm_shape_cylinder = { "cylinder", "cylinder along y on its lower face [m]", names, inside, bounds };
