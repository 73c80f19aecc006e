/* SPDX-License-Identifier: BSD-3-Clause */
/* Another rail.  Grains of the former rail's metal (burrs, welded grains) are of the new one. */
#include "coupling/case/treatment.h"

#include <math.h>
#include <stdio.h>

enum { YIELD_SCALE };

const base_param case_treatment_rail_metal_params[] = {
    PARAM_STRING(treatment_settings, material, NULL, "the rail's material"),
    TREATMENT_VALUE(YIELD_SCALE, "yield_scale", "1", 1.0, 0.01, 100.0, "factor on its flow stress and hardness"),
    PARAMS_END,
};

status case_treatment_rail_metal_apply(const treatment_settings *t, case_onset *c)
{
    snprintf(c->impact.rail.material, sizeof c->impact.rail.material, "%s", t->material);
    c->impact.rail.yield_scale = t->value[YIELD_SCALE], c->impact.rail.cold_work = NAN;
    return status_ok();
}
