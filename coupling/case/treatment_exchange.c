/* SPDX-License-Identifier: BSD-3-Clause */
/* Grains of a metal that a treatment exchanges. */
#include "coupling/case/treatment.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    const char *former, *now;
} pair;

/* Once, by what the grain was before any treatment.  Where both metals were one, the part that is exchanged decides. */
static void exchange(char material[BASE_PARAM_TEXT_SIZE], const pair part[2])
{
    for (int i = 0; i < 2; i++)
        if (strcmp(part[i].former, part[i].now) != 0 && strcmp(material, part[i].former) == 0) {
            snprintf(material, BASE_PARAM_TEXT_SIZE, "%s", part[i].now);
            return;
        }
}

void case_treatment_exchange(const case_onset *given, case_onset *out)
{
    const pair part[2] = { { given->impact.rail.material, out->impact.rail.material },
                           { given->impact.armature.material, out->impact.armature.material } };
    for (int i = 0; i < out->sites.n; i++) exchange(out->sites.item[i].material, part);
    for (int i = 0; i < out->populations.n; i++) exchange(out->populations.item[i].material, part);
    exchange(out->impact.particle.material, part);
}
