/* SPDX-License-Identifier: BSD-3-Clause */
/* Another armature.  Grains of the former armature's metal (debris) are of the new one; the shot keeps its mass. */
#include "coupling/case/treatment.h"

#include <stdio.h>

const base_param case_treatment_armature_metal_params[] = {
    PARAM_STRING(treatment_settings, material, NULL, "the armature's material"),
    PARAMS_END,
};

status case_treatment_armature_metal_apply(const treatment_settings *t, case_onset *c)
{
    snprintf(c->impact.armature.material, sizeof c->impact.armature.material, "%s", t->material);
    c->impact.armature.yield_scale = 1.0;
    return status_ok();
}
