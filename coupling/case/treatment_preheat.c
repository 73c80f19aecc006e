/* SPDX-License-Identifier: BSD-3-Clause */
/* A rail that is warm when the armature comes: softer, by the strength law of its metal. */
#include "coupling/case/treatment.h"

enum { TEMPERATURE };

const base_param case_treatment_preheat_params[] = {
    TREATMENT_VALUE(TEMPERATURE, "temperature", "K", REQUIRED, 4.0, 2000.0, "of rail, layers and grains"),
    PARAMS_END,
};

status case_treatment_preheat_apply(const treatment_settings *t, case_onset *c)
{
    const mpm_material *rail = case_material(&c->impact.materials, c->impact.rail.material);
    CHECK(!rail || !(t->value[TEMPERATURE] >= rail->melting_temperature), STATUS_BAD_INPUT,
          "preheat.temperature = %g K: %s melts at %g K", t->value[TEMPERATURE], rail->name, rail->melting_temperature);
    c->impact.rail.temperature = t->value[TEMPERATURE];
    return status_ok();
}
