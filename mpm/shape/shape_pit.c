/* Pit: hemisphere upside down, its flat face up in the plane y, centre of the face at (x, y, z); height is its depth.
 * Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x", "y", "z", "radius", "height", NULL };

static double inside(const shape_values *s, const double x[3])
{
    const double r = hypot(x[0] - s->value[PIT_X], x[2] - s->value[PIT_Z]);
    return mpm_shape_dome(s->value[PIT_RADIUS], s->value[PIT_HEIGHT], r, s->value[PIT_Y] - x[1]);
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[PIT_X + k] - s->value[k == 1 ? PIT_HEIGHT : PIT_RADIUS];
        hi[k] = s->value[PIT_X + k] + (k == 1 ? 0.0 : s->value[PIT_RADIUS]);
    }
}

status mpm_shape_pit_check(const shape_values *s)
{
    TRY(mpm_shape_positive(&mpm_shape_pit, s, PIT_RADIUS));
    return mpm_shape_positive(&mpm_shape_pit, s, PIT_HEIGHT);
}

const shape_kind mpm_shape_pit = { "pit", "half an ellipsoid of revolution, flat face up [m]", names, inside, bounds };
