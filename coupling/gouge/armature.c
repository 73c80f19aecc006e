/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/armature.h"

#include <math.h>
#include <string.h>

/* Of the section, from the back of the contact face round by the nose. */
enum { BACK, FRONT, NOSE, NOSE_TOP, HEAD_TOP, HEAD_INNER, LEG_TOP, CORNERS };

static double chamfer_run(const gouge_armature *a)
{
    return a->chamfer_height / tan(a->lead_angle);
}

double gouge_armature_section(const gouge_armature *a)
{
    return a->length * a->leg_thickness + a->head_thickness * (a->half_bore - a->leg_thickness) -
           0.5 * a->chamfer_height * a->chamfer_height / tan(a->lead_angle);
}

void gouge_armature_fill(const gouge_armature *a, mpm_solid *prism)
{
    const double nose = a->front + chamfer_run(a), back = nose - a->length, inner = nose - a->head_thickness;
    const double leg = a->leg_thickness, top = a->half_bore, rise = a->chamfer_height;
    const double corners[CORNERS][2] = {
        [BACK] = { back, 0.0 },     [FRONT] = { a->front, 0.0 }, [NOSE] = { nose, rise },
        [NOSE_TOP] = { nose, top }, [HEAD_TOP] = { inner, top }, [HEAD_INNER] = { inner, leg },
        [LEG_TOP] = { back, leg }
    };
    memcpy(mpm_solid_value(prism, "corners"), corners, sizeof corners);
    *mpm_solid_value(prism, "lo") = -a->half_width;
    *mpm_solid_value(prism, "hi") = a->half_width;
}

static status check_positive(const char *name, double value)
{
    CHECK(value > 0.0, STATUS_BAD_INPUT, "armature.%s = %g m: must be positive", name, value);
    return status_ok();
}

/* The lead face must leave the leg on the head. */
static status check_lead_face(const gouge_armature *a)
{
    const double run = chamfer_run(a);
    CHECK(run < a->length, STATUS_BAD_INPUT,
          "armature: a chamfer of height %g m at lead_angle %g rad runs %g m, beyond the length of %g m",
          a->chamfer_height, a->lead_angle, run, a->length);
    const double under_inner_face = (run - a->head_thickness) * tan(a->lead_angle);
    CHECK(run <= a->head_thickness || under_inner_face < a->leg_thickness, STATUS_BAD_INPUT,
          "armature: the lead face cuts the leg of %g m off the head: chamfer_height, lead_angle and head_thickness = "
          "%g m",
          a->leg_thickness, a->head_thickness);
    return status_ok();
}

status gouge_armature_check(const gouge_armature *a)
{
    CHECK(isfinite(a->front), STATUS_BAD_INPUT, "armature.front = %g m: must be finite", a->front);
    TRY(check_positive("length", a->length));
    TRY(check_positive("leg_thickness", a->leg_thickness));
    TRY(check_positive("head_thickness", a->head_thickness));
    TRY(check_positive("half_bore", a->half_bore));
    TRY(check_positive("half_width", a->half_width));
    CHECK(a->lead_angle > 0.0 && a->lead_angle <= acos(0.0) * (1.0 + 1e-12), STATUS_BAD_INPUT,
          "armature.lead_angle = %g rad: must be above 0 and at most pi/2", a->lead_angle);
    CHECK(a->leg_thickness <= a->half_bore, STATUS_BAD_INPUT, "armature.leg_thickness = %g m: at most half_bore = %g m",
          a->leg_thickness, a->half_bore);
    CHECK(a->head_thickness <= a->length, STATUS_BAD_INPUT, "armature.head_thickness = %g m: at most length = %g m",
          a->head_thickness, a->length);
    CHECK(a->chamfer_height >= 0.0 && a->chamfer_height <= a->half_bore, STATUS_BAD_INPUT,
          "armature.chamfer_height = %g m: must be 0 .. half_bore = %g m", a->chamfer_height, a->half_bore);
    return check_lead_face(a);
}
