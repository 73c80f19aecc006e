/* Sphere about (x, y, z).  Signed distance exact. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double dx = x[0] - s->value[SPHERE_X], dy = x[1] - s->value[SPHERE_Y], dz = x[2] - s->value[SPHERE_Z];
    return s->value[SPHERE_RADIUS] - sqrt(dx * dx + dy * dy + dz * dz);
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[SPHERE_X + k] - s->value[SPHERE_RADIUS];
        hi[k] = s->value[SPHERE_X + k] + s->value[SPHERE_RADIUS];
    }
}

status mpm_shape_sphere_check(const shape_values *s)
{
    return mpm_shape_positive(&mpm_shape_sphere, s, SPHERE_RADIUS);
}

const shape_kind mpm_shape_sphere = { "sphere", "sphere about a centre [m]", names, inside, bounds };
