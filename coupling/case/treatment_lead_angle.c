/* SPDX-License-Identifier: BSD-3-Clause */
/* The lead face at another angle to the rail; its height stays, so its length changes. */
#include "coupling/case/treatment.h"
#include "base/constants.h"

enum { ANGLE };

const base_param case_treatment_lead_angle_params[] = {
    TREATMENT_VALUE(ANGLE, "angle", "rad", REQUIRED, 0.01, 1.5707963267948966, "between lead face and rail surface"),
    PARAMS_END,
};

status case_treatment_lead_angle_apply(const treatment_settings *t, case_onset *c)
{
    case_projectile *p = &c->impact.armature;
    const double run = p->chamfer_height / tan(t->value[ANGLE]);
    CHECK(run < p->length, STATUS_BAD_INPUT,
          "lead_angle.angle = %g deg: the lead face would be %g m long, the armature is %g m: a larger angle, or a "
          "smaller armature.chamfer_height",
          t->value[ANGLE] * 180.0 / PI, run, p->length);
    p->lead_angle = t->value[ANGLE];
    return status_ok();
}
