/* SPDX-License-Identifier: BSD-3-Clause */
/* Another rail.  Grains of the former rail's metal (burrs, welded grains) are of the new one. */
#include "coupling/case/treatment.h"

#include <string.h>

enum { YIELD_SCALE };

const base_param case_treatment_rail_metal_params[] = {
    PARAM_STRING(treatment_settings, material, NULL, "the rail's material"),
    TREATMENT_VALUE(YIELD_SCALE, "yield_scale", "1", 1.0, 0.01, 100.0, "factor on its flow stress and hardness"),
    PARAMS_END,
};

static void exchange(char *metal, const char *former, const char *now)
{
    if (strcmp(metal, former) == 0) snprintf(metal, BASE_PARAM_TEXT_SIZE, "%s", now);
}

status case_treatment_rail_metal_apply(const treatment_settings *t, case_onset *c)
{
    char former[BASE_PARAM_TEXT_SIZE];
    memcpy(former, c->impact.rail.material, sizeof former);
    for (int i = 0; i < c->sites.n; i++) exchange(c->sites.item[i].material, former, t->material);
    for (int i = 0; i < c->populations.n; i++) exchange(c->populations.item[i].material, former, t->material);
    exchange(c->impact.particle.material, former, t->material);
    exchange(c->impact.rail.material, former, t->material);
    c->impact.rail.yield_scale = t->value[YIELD_SCALE], c->impact.rail.cold_work = NAN;
    return status_ok();
}
