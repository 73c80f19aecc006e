/* One or several layers on what the rail has already. */
#include "coupling/case/treatment.h"

status case_treatment_coating_apply(const treatment_settings *t, breech_case *c)
{
    for (int i = 0; i < t->layers.n; i++) TRY(case_treatment_add_layer(c, c->rail.layers.n, &t->layers.item[i]));
    return status_ok();
}
