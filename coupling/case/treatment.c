/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/treatment.h"

#include <stdlib.h>
#include <string.h>

const treatment_kind case_treatment_kinds[TREATMENT_KINDS] = {
#define TREATMENT_LAYERS(name, doc) { #name, doc, NULL, case_treatment_##name##_apply },
#define TREATMENT(name, doc) { #name, doc, case_treatment_##name##_params, case_treatment_##name##_apply },
#include "coupling/case/treatment.def"
#undef TREATMENT
};

bool case_treatment_given(const case_treatment *t, int kind)
{
    const treatment_settings *s = &t->kind[kind];
    const base_param *first = case_treatment_kinds[kind].params;
    if (!first) return s->layers.n > 0;
    const char *member = (const char *)s + first->offset;
    return first->kind == BASE_PARAM_TEXT ? member[0] != '\0' : !isnan(*(const double *)(const void *)member);
}

/* *list becomes a copy of its own. */
static status own(void **item, int n, size_t size)
{
    void *copy = malloc((size_t)n * size + 1);
    CHECK(copy, STATUS_MEMORY, "no memory for a treated case");
    if (n > 0) memcpy(copy, *item, (size_t)n * size);
    *item = copy;
    return status_ok();
}

static status own_sizes(case_populations *list)
{
    for (int i = 0; i < list->n; i++) {
        case_sizes *sizes = &list->item[i].sizes;
        const status s = own((void **)&sizes->item, sizes->n, sizeof *sizes->item);
        if (s.code == STATUS_OK) continue;
        for (; i < list->n; i++) list->item[i].sizes = (case_sizes){ 0, NULL };
        return s;
    }
    return status_ok();
}

status case_treat(const case_onset *c, const case_treatment *t, case_onset *out)
{
    *out = *c;
    out->impact.rail.layers = (case_layers){ 0, NULL };
    out->sites = (case_sites){ 0, NULL };
    out->populations = (case_populations){ 0, NULL };
    case_layers layers = c->impact.rail.layers;
    TRY(own((void **)&layers.item, layers.n, sizeof *layers.item));
    out->impact.rail.layers = layers;
    case_sites sites = c->sites;
    TRY(own((void **)&sites.item, sites.n, sizeof *sites.item));
    out->sites = sites;
    case_populations populations = c->populations;
    TRY(own((void **)&populations.item, populations.n, sizeof *populations.item));
    out->populations = populations;
    TRY(own_sizes(&out->populations));
    for (int k = 0; t && k < TREATMENT_KINDS; k++) {
        if (!case_treatment_given(t, k)) continue;
        const status s = case_treatment_kinds[k].apply(&t->kind[k], out);
        CHECK(s.code == STATUS_OK, s.code, "treatment `%s`: %.400s", t->name, s.text);
    }
    case_treatment_exchange(c, out);
    return status_ok();
}

void case_treated_free(case_onset *c)
{
    free(c->impact.rail.layers.item);
    free(c->sites.item);
    for (int i = 0; i < c->populations.n; i++) free(c->populations.item[i].sizes.item);
    free(c->populations.item);
    memset(c, 0, sizeof *c);
}

static bool same_bytes(const void *a, const void *b, int n, size_t size)
{
    return n == 0 || memcmp(a, b, (size_t)n * size) == 0;
}

static bool same_populations(const case_populations *a, const case_populations *b)
{
    if (a->n != b->n) return false;
    for (int i = 0; i < a->n; i++) {
        case_population x = a->item[i];
        const case_population *y = &b->item[i];
        if (x.sizes.n != y->sizes.n || !same_bytes(x.sizes.item, y->sizes.item, x.sizes.n, sizeof *x.sizes.item))
            return false;
        x.sizes.item = y->sizes.item;
        if (!same_bytes(&x, y, 1, sizeof x)) return false;
    }
    return true;
}

/* Lists are compared by what is in them; all else is a copy, byte by byte. */
bool case_treated_alike(const case_onset *c, const case_onset *treated)
{
    case_onset as = *treated;
    const case_layers *layers = &c->impact.rail.layers;
    if (layers->n != as.impact.rail.layers.n || c->sites.n != as.sites.n ||
        !same_bytes(layers->item, as.impact.rail.layers.item, layers->n, sizeof *layers->item) ||
        !same_bytes(c->sites.item, as.sites.item, c->sites.n, sizeof *c->sites.item) ||
        !same_populations(&c->populations, &as.populations))
        return false;
    as.impact.rail.layers.item = layers->item;
    as.sites.item = c->sites.item;
    as.populations.item = c->populations.item;
    return same_bytes(c, &as, 1, sizeof as);
}
