/* SPDX-License-Identifier: BSD-3-Clause */
/* Grains of a fraction of their size, and fewer of them.  Shape and height over radius stay. */
#include "coupling/case/treatment.h"

enum { SIZE, NUMBER };

const base_param case_treatment_polish_params[] = {
    TREATMENT_VALUE(SIZE, "size", "1", REQUIRED, 0.01, 1.0, "factor on every grain's size"),
    TREATMENT_VALUE(NUMBER, "number", "1", 1.0, 0.0, 1.0, "fraction of a population's grains that is left"),
    PARAMS_END,
};

status case_treatment_polish_apply(const treatment_settings *t, case_onset *c)
{
    for (int i = 0; i < c->sites.n; i++) {
        c->sites.item[i].radius *= t->value[SIZE];
        c->sites.item[i].height *= t->value[SIZE];
    }
    for (int i = 0; i < c->populations.n; i++) {
        case_population *p = &c->populations.item[i];
        p->radius_median *= t->value[SIZE];
        p->density *= t->value[NUMBER];
        for (int k = 0; k < p->sizes.n; k++) p->sizes.item[k].radius *= t->value[SIZE];
    }
    return status_ok();
}
