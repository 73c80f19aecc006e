/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/shape/shape.h"

#include <string.h>

static const mpm_solid_kind *const kinds[] = {
#define SHAPE(name) &mpm_shape_##name,
#include "mpm/shape/shape.def"
#undef SHAPE
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

const mpm_solid_kind *mpm_solid_kind_at(int i)
{
    return i >= 0 && i < (int)KINDS ? kinds[i] : NULL;
}

const mpm_solid_kind *mpm_solid_kind_find(const char *name)
{
    for (int i = 0; i < (int)KINDS; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

mpm_solid mpm_solid_make(const mpm_solid_kind *kind)
{
    mpm_solid s;
    memset(&s, 0, sizeof s);
    s.kind = kind;
    base_params_default(kind->params, s.value);
    return s;
}

/* Place of a value, -1: none. */
static int value_place(const mpm_solid_kind *kind, const char *name)
{
    for (const base_param *p = kind->params; p->key; p++)
        if (strcmp(p->key, name) == 0) return (int)(p->offset / sizeof(double));
    return -1;
}

double *mpm_solid_value(mpm_solid *s, const char *name)
{
    const int place = value_place(s->kind, name);
    return place >= 0 ? s->value + place : NULL;
}

const double *mpm_solid_get(const mpm_solid *s, const char *name)
{
    const int place = value_place(s->kind, name);
    return place >= 0 ? s->value + place : NULL;
}

const mpm_solid *mpm_solid_part(const mpm_solid *s, int i)
{
    return s - s->part[i];
}

double mpm_solid_inside(const mpm_solid *s, const double x[3])
{
    return s->kind->inside(s, x);
}

void mpm_solid_bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    s->kind->bounds(s, lo, hi);
}

double mpm_solid_looks(const mpm_solid *s)
{
    if (s->kind->looks) return s->kind->looks(s);
    double sum = s->kind->parts == 0;
    for (int i = 0; i < s->kind->parts; i++) sum += mpm_solid_looks(mpm_solid_part(s, i));
    return sum;
}

/* Its parts first: what a kind checks may look at them, where it has them. */
status mpm_solid_check(const mpm_solid *s, int place)
{
    CHECK(s->kind, STATUS_BAD_INPUT, "solid %d is of no kind", place);
    TRY(base_params_check(s->kind->params, s->value, s->kind->name));
    for (int i = 0; i < s->kind->parts && s->part[i] != 0; i++) {
        CHECK(s->part[i] > 0 && s->part[i] <= place, STATUS_BAD_INPUT,
              "%s: part %d must be one of the %d solids before it", s->kind->name, i + 1, place);
        TRY(mpm_solid_check(mpm_solid_part(s, i), place - s->part[i]));
    }
    if (s->kind->check) TRY(s->kind->check(s, s->kind->name));
    for (int i = 0; i < s->kind->parts; i++)
        CHECK(s->part[i] != 0, STATUS_BAD_INPUT, "%s: part %d must be one of the %d solids before it", s->kind->name,
              i + 1, place);
    return status_ok();
}
