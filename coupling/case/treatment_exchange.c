/* SPDX-License-Identifier: BSD-3-Clause */
/* Grains of an exchanged metal; rail_metal and armature_metal share it. */
#include "coupling/case/treatment.h"

#include <stdio.h>
#include <string.h>

static void exchange(char material[BASE_PARAM_TEXT_SIZE], const char *former, const char *now)
{
    if (strcmp(material, former) == 0) snprintf(material, BASE_PARAM_TEXT_SIZE, "%s", now);
}

void case_treatment_exchange(case_onset *c, const char *former, const char *now)
{
    for (int i = 0; i < c->sites.n; i++) exchange(c->sites.item[i].material, former, now);
    for (int i = 0; i < c->populations.n; i++) exchange(c->populations.item[i].material, former, now);
    exchange(c->impact.particle.material, former, now);
}
