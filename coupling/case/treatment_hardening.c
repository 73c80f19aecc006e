/* SPDX-License-Identifier: BSD-3-Clause */
/* A skin of the rail's metal whose flow stress is raised: shot peening, laser hardening, cold rolling.  Uniform over
 * its depth; it lies below the rail's own layers and coatings. */
#include "coupling/case/treatment.h"

#include <math.h>
#include <string.h>

enum { DEPTH, FACTOR };

const base_param case_treatment_hardening_params[] = {
    TREATMENT_VALUE(DEPTH, "depth", "m", REQUIRED, 1e-6, 0.1, "of the skin"),
    TREATMENT_VALUE(FACTOR, "factor", "1", REQUIRED, 0.01, 100.0, "on the rail's flow stress and hardness"),
    PARAMS_END,
};

status case_treatment_hardening_apply(const treatment_settings *t, case_onset *c)
{
    case_layer skin = { .thickness = t->value[DEPTH],
                        .bond_strength = NAN,
                        .yield_scale = c->impact.rail.yield_scale * t->value[FACTOR],
                        .cold_work = c->impact.rail.cold_work,
                        .wear_rate = NAN };
    memcpy(skin.material, c->impact.rail.material, sizeof skin.material);
    return case_layers_add(&c->impact.rail.layers, 0, &skin);
}
