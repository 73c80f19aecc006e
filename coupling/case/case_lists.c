/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case.h"

#include <stdlib.h>
#include <string.h>

double case_layers_thickness(const case_layers *layers)
{
    double sum = 0.0;
    for (int i = 0; i < layers->n; i++) sum += layers->item[i].thickness;
    return sum;
}

const mpm_material *case_material(const case_materials *list, const char *name)
{
    for (int k = 0; k < list->n; k++)
        if (strcmp(list->item[k].name, name) == 0) return &list->item[k];
    return NULL;
}

status case_layers_add(case_layers *l, int at, const case_layer *layer)
{
    case_layer *more = realloc(l->item, ((size_t)l->n + 1) * sizeof *more);
    CHECK(more, STATUS_MEMORY, "no memory for a layer");
    l->item = more;
    memmove(more + at + 1, more + at, (size_t)(l->n - at) * sizeof *more);
    more[at] = *layer;
    l->n++;
    return status_ok();
}
