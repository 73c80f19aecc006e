/* Armature: half of a U-shaped solid armature on one rail, a prism along z about z = 0.  It moves towards +x.
 *
 *      y0 + half_bore  . . . . . . . . . . . .+-----------------+   mid plane between the rails
 *                                             |                 |
 *                                             |      head       |
 *                       +---------------------+                 |
 *                       |   leg                                /    lead face, lead_angle to the rail's surface
 *      y0  -------------+-------------------------------------+---------------------  rail
 *                     x_back                                x_front   x_nose
 *
 * The leg trails, the head is in front; leg and head share the contact face y = y0, which ends at x_front.  There the
 * lead face rises to chamfer_height: x_nose = x_front + chamfer_height / tan(lead_angle).  length and head_thickness
 * count back from x_nose.  Lengths [m], lead_angle [rad], pi/2 or chamfer_height 0 for a square front.
 * Signed distance exact.
 *   volume = 2 half_width [length leg + head (half_bore - leg) - chamfer_height^2 / (2 tan lead_angle)]
 * while the chamfer stays below the leg's top or within the head. */
#include "mpm/shape/shape.h"

#include <math.h>

enum { CORNERS = 7 };

static const char *const names[] = {
    "x_front", "length", "leg_thickness", "head_thickness", "half_bore", "chamfer_height", "lead_angle", "half_width",
    "y0",      NULL
};

static double chamfer_run(const shape_values *s)
{
    return s->value[ARMATURE_CHAMFER_HEIGHT] / tan(s->value[ARMATURE_LEAD_ANGLE]);
}

/* Corners of the section, from the back of the contact face round by the nose; x, y pairs. */
static void section(const shape_values *s, double corner[2 * CORNERS])
{
    const double front = s->value[ARMATURE_X_FRONT], nose = front + chamfer_run(s);
    const double back = nose - s->value[ARMATURE_LENGTH], inner = nose - s->value[ARMATURE_HEAD_THICKNESS];
    const double y0 = s->value[ARMATURE_Y0], leg = y0 + s->value[ARMATURE_LEG_THICKNESS];
    const double top = y0 + s->value[ARMATURE_HALF_BORE], rise = y0 + s->value[ARMATURE_CHAMFER_HEIGHT];
    const double list[2 * CORNERS] = { back, y0, front, y0, nose, rise, nose, top, inner, top, inner, leg, back, leg };
    for (int i = 0; i < 2 * CORNERS; i++) corner[i] = list[i];
}

static double inside(const shape_values *s, const double x[3])
{
    double corner[2 * CORNERS];
    section(s, corner);
    return mpm_shape_prism(mpm_shape_polygon(CORNERS, corner, x[0], x[1]), s->value[ARMATURE_HALF_WIDTH] - fabs(x[2]));
}

static void bounds(const shape_values *s, double lo[3], double hi[3])
{
    hi[0] = s->value[ARMATURE_X_FRONT] + chamfer_run(s);
    lo[0] = hi[0] - s->value[ARMATURE_LENGTH];
    lo[1] = s->value[ARMATURE_Y0];
    hi[1] = s->value[ARMATURE_Y0] + s->value[ARMATURE_HALF_BORE];
    lo[2] = -s->value[ARMATURE_HALF_WIDTH];
    hi[2] = s->value[ARMATURE_HALF_WIDTH];
}

status mpm_shape_armature_check(const shape_values *s)
{
    const double *v = s->value;
    for (int i = ARMATURE_LENGTH; i <= ARMATURE_HALF_BORE; i++) TRY(mpm_shape_positive(&mpm_shape_armature, s, i));
    TRY(mpm_shape_positive(&mpm_shape_armature, s, ARMATURE_HALF_WIDTH));
    CHECK(v[ARMATURE_LEAD_ANGLE] > 0.0 && v[ARMATURE_LEAD_ANGLE] <= acos(0.0) * (1.0 + 1e-12), STATUS_BAD_INPUT,
          "armature.lead_angle = %g rad: must be above 0 and at most pi/2", v[ARMATURE_LEAD_ANGLE]);
    CHECK(v[ARMATURE_LEG_THICKNESS] <= v[ARMATURE_HALF_BORE], STATUS_BAD_INPUT,
          "armature.leg_thickness = %g m: at most half_bore = %g m", v[ARMATURE_LEG_THICKNESS], v[ARMATURE_HALF_BORE]);
    CHECK(v[ARMATURE_HEAD_THICKNESS] <= v[ARMATURE_LENGTH], STATUS_BAD_INPUT,
          "armature.head_thickness = %g m: at most length = %g m", v[ARMATURE_HEAD_THICKNESS], v[ARMATURE_LENGTH]);
    CHECK(v[ARMATURE_CHAMFER_HEIGHT] >= 0.0 && v[ARMATURE_CHAMFER_HEIGHT] <= v[ARMATURE_HALF_BORE], STATUS_BAD_INPUT,
          "armature.chamfer_height = %g m: must be 0 .. half_bore = %g m", v[ARMATURE_CHAMFER_HEIGHT],
          v[ARMATURE_HALF_BORE]);
    const double run = chamfer_run(s), head = v[ARMATURE_HEAD_THICKNESS];
    CHECK(run < v[ARMATURE_LENGTH], STATUS_BAD_INPUT,
          "armature: a chamfer of height %g m at lead_angle %g rad runs %g m, beyond the length of %g m",
          v[ARMATURE_CHAMFER_HEIGHT], v[ARMATURE_LEAD_ANGLE], run, v[ARMATURE_LENGTH]);
    const double under_inner_face = (run - head) * tan(v[ARMATURE_LEAD_ANGLE]);
    CHECK(run <= head || under_inner_face < v[ARMATURE_LEG_THICKNESS], STATUS_BAD_INPUT,
          "armature: the lead face cuts the leg of %g m off the head: chamfer_height, lead_angle and head_thickness = "
          "%g m",
          v[ARMATURE_LEG_THICKNESS], head);
    return status_ok();
}

const shape_kind mpm_shape_armature = { "armature", "half of a U-shaped solid armature on one rail, nose towards +x",
                                        names, inside, bounds };
