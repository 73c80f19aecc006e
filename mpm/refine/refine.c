/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/refine/refine_kinds.h"

#include <string.h>

static const mpm_refine_kind *const kinds[] = {
#define REFINE(name) &mpm_refine_##name,
#include "mpm/refine/refine.def"
#undef REFINE
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

const mpm_refine_kind *mpm_refine_kind_at(int i)
{
    return i >= 0 && i < (int)KINDS ? kinds[i] : NULL;
}

const mpm_refine_kind *mpm_refine_kind_find(const char *name)
{
    for (int i = 0; i < (int)KINDS; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

mpm_refine mpm_refine_make(const mpm_refine_kind *kind)
{
    mpm_refine r;
    memset(&r, 0, sizeof r);
    r.kind = kind;
    r.body = -1;
    base_params_default(kind->params, r.value);
    return r;
}

double *mpm_refine_value(mpm_refine *r, const char *name)
{
    for (const base_param *q = r->kind->params; q->key; q++)
        if (strcmp(q->key, name) == 0) return r->value + q->offset / sizeof *r->value;
    return NULL;
}

int mpm_refine_every(const mpm_refine *rules, int n)
{
    int every = n > 0 ? rules[0].kind->every : MPM_REFINE_EVERY;
    for (int i = 1; i < n; i++)
        if (rules[i].kind->every < every) every = rules[i].kind->every;
    return every;
}

status mpm_refine_check(const mpm_refine *r, int bodies)
{
    CHECK(r->kind, STATUS_BAD_INPUT, "a rule of refinement is of no kind");
    CHECK(r->body >= (r->kind->of_body ? 0 : -1) && r->body < bodies, STATUS_BAD_INPUT,
          "refine by `%s`: body %d, the scene has %d", r->kind->name, r->body, bodies);
    CHECK(r->cell >= 0 && isfinite(r->cell), STATUS_BAD_INPUT, "refine by `%s`: cells of %g m: 0 or more",
          r->kind->name, r->cell);
    TRY(base_params_check(r->kind->params, r->value, r->kind->name));
    return r->kind->check ? r->kind->check(r, r->kind->name) : status_ok();
}
