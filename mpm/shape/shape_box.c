/* Box: lo .. hi along each axis.  Signed distance exact. */
#include "mpm/shape/shape.h"

#include <math.h>

static const char *const names[] = { "x_lo", "y_lo", "z_lo", "x_hi", "y_hi", "z_hi", NULL };

static double inside(const shape_values *s, const double x[3])
{
    double least = INFINITY, outside2 = 0.0;
    for (int k = 0; k < 3; k++) {
        const double d = fmin(x[k] - s->value[BOX_LO + k], s->value[BOX_HI + k] - x[k]);
        least = fmin(least, d);
        if (d < 0.0) outside2 += d * d;
    }
    return least >= 0.0 ? least : -sqrt(outside2);
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = s->value[BOX_LO + k];
        hi[k] = s->value[BOX_HI + k];
    }
}

status mpm_shape_box_check(const shape_values *s)
{
    for (int k = 0; k < 3; k++)
        CHECK(s->value[BOX_LO + k] < s->value[BOX_HI + k], STATUS_BAD_INPUT, "box.%s = %g m must lie above %s = %g m",
              names[BOX_HI + k], s->value[BOX_HI + k], names[BOX_LO + k], s->value[BOX_LO + k]);
    return status_ok();
}

const shape_kind mpm_shape_box = { "box", "box between two corners [m]", names, inside, bounds };
