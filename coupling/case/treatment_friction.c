/* SPDX-License-Identifier: BSD-3-Clause */
/* A contact that slides more or less easily: a lubricant, a roughened face.  In the shot and in the scenes alike. */
#include "coupling/case/treatment.h"

enum { FACTOR };

const base_param case_treatment_friction_params[] = {
    TREATMENT_VALUE(FACTOR, "factor", "1", REQUIRED, 0.0, 10.0,
                    "on the coefficients of the shot, dry and melted (law film: film_viscosity), and of the scenes"),
    PARAMS_END,
};

status case_treatment_friction_apply(const treatment_settings *t, case_onset *c)
{
    circuit_shot_armature *a = &c->launcher.armature;
    a->friction_dry *= t->value[FACTOR];
    if (a->friction_law == CIRCUIT_SHOT_FRICTION_FILM)
        a->film_viscosity *= t->value[FACTOR];
    else
        a->friction_melted *= t->value[FACTOR];
    c->impact.scene.friction *= t->value[FACTOR];
    return status_ok();
}
