/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/reread.h"

#include "coupling/case/case_place.h"
#include "coupling/case/material_file.h"

#include <stdlib.h>
#include <string.h>

enum { SET_SIZE = BASE_PARAM_TEXT_SIZE + CASE_VALUE_SIZE + 2, PLACE_SIZE = 400 };

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
    TRY(case_material_places_find(&at));
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n, .needs = y->needs };
    status s = case_inputs_read(of->in->path, set, n, &how, out, &errors);
    free(errors);
    if (s.code == STATUS_OK) s = study_prepare(*out);
    const study_case one = { *out, .one_of_several = true, "", .sets = set, .n_sets = n, .largest = of->largest };
    if (s.code == STATUS_OK) s = study_possible_all(&one, y->needs);
    return s;
}

/* The change that the error is about, by the --set that the reader names or that has a key of its text; -1: none. */
static int change_of(const case_inputs *in, status *error, int n, char (*own)[SET_SIZE])
{
    char place[PLACE_SIZE] = "", set[PLACE_SIZE];
    const bool told = strncmp(error->text, "--set ", 6) == 0;
    if (!told && in) case_inputs_place(in, error->text, place, sizeof place);
    for (int k = 0; k < n; k++) {
        snprintf(set, sizeof set, CASE_SET_PLACE, own[k]);
        const size_t length = strlen(set);
        if (strncmp(told ? error->text : place, set, length) != 0) continue;
        if (told) memmove(error->text, error->text + length, strlen(error->text + length) + 1);
        return k;
    }
    return n == 1 ? 0 : -1;
}

bool study_reread_key(const status *s)
{
    return strncmp(s->text, "unknown key `", 13) == 0;
}

status study_reread(const study_case *of, const study *y, int n, const case_change *change, case_inputs **out,
                    int *about)
{
    char(*own)[SET_SIZE];
    const char **set;
    *out = NULL;
    *about = -1;
    status s = join_sets(of, n, change, &own, &set);
    if (s.code == STATUS_OK) s = read_with(of, y, of->n_sets + n, set, out);
    if (s.code == STATUS_BAD_INPUT) *about = change_of(*out, &s, n, own);
    free(own);
    free(set);
    return s;
}
