/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/reread.h"

#include "coupling/case/material_file.h"

#include <stdlib.h>

enum { SET_SIZE = BASE_PARAM_TEXT_SIZE + CASE_VALUE_SIZE + 2 };

/* The texts of --set that are there, and those of the changes; *own holds the latter. */
static status join_sets(const study_case *of, int n, const case_change *change, char (**own)[SET_SIZE],
                        const char ***set)
{
    *own = calloc((size_t)n + 1, sizeof **own);
    *set = calloc((size_t)(of->n_sets + n) + 1, sizeof **set);
    CHECK(*own && *set, STATUS_MEMORY, "no memory for %d values", n);
    for (int k = 0; k < of->n_sets; k++) (*set)[k] = of->sets[k];
    for (int k = 0; k < n; k++) {
        snprintf((*own)[k], SET_SIZE, "%s=%s", change[k].key, change[k].value);
        (*set)[of->n_sets + k] = (*own)[k];
    }
    return status_ok();
}

static status read_with(const study_case *of, const study *y, int n, const char *const *set, case_inputs **out)
{
    char *errors = NULL;
    material_places at;
    case_material_places_find(&at);
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n, .needs = y->needs };
    status s = case_inputs_read(of->in->path, set, n, &how, out, &errors);
    free(errors);
    if (s.code == STATUS_OK) s = study_prepare(*out);
    if (s.code == STATUS_OK) s = study_possible(*out, y->needs, of->largest);
    return s;
}

status study_reread(const study_case *of, const study *y, int n, const case_change *change, case_inputs **out)
{
    char(*own)[SET_SIZE];
    const char **set;
    *out = NULL;
    status s = join_sets(of, n, change, &own, &set);
    if (s.code == STATUS_OK) s = read_with(of, y, of->n_sets + n, set, out);
    free(own);
    free(set);
    return s;
}
