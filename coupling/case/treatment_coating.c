/* SPDX-License-Identifier: BSD-3-Clause */
/* One or several layers on what the rail has already. */
#include "coupling/case/treatment.h"

status case_treatment_coating_apply(const treatment_settings *t, case_onset *c)
{
    for (int i = 0; i < t->layers.n; i++)
        TRY(case_layers_add(&c->impact.rail.layers, c->impact.rail.layers.n, &t->layers.item[i]));
    return status_ok();
}
