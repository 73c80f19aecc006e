/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/read/probe_kinds.h"

#include <stdio.h>
#include <string.h>

static const mpm_probe_kind *const kinds[] = {
#define PROBE(name) &mpm_probe_##name,
#include "mpm/read/probe.def"
#undef PROBE
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

const mpm_probe_kind *mpm_probe_kind_at(int i)
{
    return i >= 0 && i < (int)KINDS ? kinds[i] : NULL;
}

const mpm_probe_kind *mpm_probe_kind_find(const char *name)
{
    for (int i = 0; i < (int)KINDS; i++)
        if (strcmp(kinds[i]->name, name) == 0) return kinds[i];
    return NULL;
}

mpm_probe mpm_probe_make(const mpm_probe_kind *kind, const char *name)
{
    mpm_probe p;
    memset(&p, 0, sizeof p);
    snprintf(p.name, sizeof p.name, "%s", name);
    p.kind = kind;
    p.body = -1;
    base_params_default(kind->params, p.value);
    return p;
}

double *mpm_probe_value(mpm_probe *p, const char *name)
{
    for (const base_param *q = p->kind->params; q->key; q++)
        if (strcmp(q->key, name) == 0) return p->value + q->offset / sizeof *p->value;
    return NULL;
}

status mpm_probe_check(const mpm_probe *p, int bodies)
{
    CHECK(p->kind, STATUS_BAD_INPUT, "probe `%s` is of no kind", p->name);
    CHECK(p->body >= (p->kind->of_body ? 0 : -1) && p->body < bodies, STATUS_BAD_INPUT,
          "probe `%s`: body %d, the scene has %d", p->name, p->body, bodies);
    TRY(base_params_check(p->kind->params, p->value, p->name));
    return p->kind->check ? p->kind->check(p, p->name) : status_ok();
}

int mpm_probe_rows(const mpm_probe *p)
{
    return p->kind->rows ? p->kind->rows(p) : 1;
}

int mpm_probe_columns(const mpm_probe *p)
{
    int n = 0;
    while (p->kind->columns[n].name) n++;
    return n;
}

status mpm_probe_read(const mpm *m, const mpm_probe *p, double *out)
{
    return p->kind->read(m, p, out);
}

/* ---- the mean over a box ---- */

typedef struct {
    const double *lo, *hi;
    int body;
    double sum[PROBE_BOX_COLUMNS]; /* volume-weighted; the volume itself; mass */
} box_sum;

/* Part of a point's domain that lies in the box [1]. */
static double part_inside(const block *q, int l, const double lo[3], const double hi[3])
{
    double part = 1;
    for (int k = 0; k < 3; k++) {
        const double from = fmax(q->x[k][l] - q->half[k][l], lo[k]), to = fmin(q->x[k][l] + q->half[k][l], hi[k]);
        if (!(from < to)) return 0;
        part *= (to - from) / (2 * q->half[k][l]);
    }
    return part;
}

/* Is the box farther from the brick than the brick is wide?  Then no domain of its points reaches the box. */
static bool is_far(const mpm *m, const brick *b, const double lo[3], const double hi[3])
{
    for (int k = 0; k < 3; k++) {
        const double *edge = &axes_of(m, b)[k].edge[BRICK * b->at[k]], width = edge[BRICK] - edge[0];
        if (hi[k] < edge[0] - width || lo[k] > edge[BRICK] + width) return true;
    }
    return false;
}

static void add_box(void *user, const mpm *m, const brick *b, int index)
{
    box_sum *s = user;
    const block *q = &m->blocks[index];
    if (!visit_wants(m, index, s->body) || is_far(m, b, s->lo, s->hi)) return;
    for (int l = 0; l < LANES; l++) {
        if (!(q->mass[0][l] > 0)) continue;
        const double volume = part_inside(q, l, s->lo, s->hi) * q->mass[0][l] / q->rho[0][l], p = q->p[0][l];
        const double add[PROBE_BOX_COLUMNS] = { p, q->s[0][l] - p, q->s[1][l] - p, q->s[2][l] - p, 1, q->rho[0][l] };
        for (int i = 0; i < PROBE_BOX_COLUMNS; i++) s->sum[i] += volume * add[i];
    }
}

void mpm_probe_box_mean(const mpm *m, int body, const double lo[3], const double hi[3], double out[PROBE_BOX_COLUMNS])
{
    box_sum share[SHARES];
    const box_sum none = { .lo = lo, .hi = hi, .body = body };
    for (int i = 0; i < SHARES; i++) share[i] = none;
    mpm_visit_shares(m, add_box, share, sizeof *share);
    const double *volume = &out[PROBE_BOX_VOLUME];
    for (int k = 0; k < PROBE_BOX_COLUMNS; k++) {
        out[k] = 0;
        for (int i = 0; i < SHARES; i++) out[k] += share[i].sum[k];
    }
    for (int k = 0; k < PROBE_BOX_COLUMNS; k++)
        if (k != PROBE_BOX_VOLUME) out[k] = *volume > 0 ? out[k] / *volume : NAN;
}

const mpm_column mpm_probe_box_columns[PROBE_BOX_COLUMNS + 1] = {
    { "pressure", "Pa", "mean pressure, with viscosity" },
    { "stress_xx", "Pa", "mean normal stress along x, tension positive" },
    { "stress_yy", "Pa", "the same along y" },
    { "stress_zz", "Pa", "the same along z" },
    { "volume", "m^3", "of the points there" },
    { "density", "kg/m^3", "mean density of the points there" },
    { NULL, NULL, NULL },
};

/* ---- an axis by its direction ---- */

status mpm_probe_check_axis(const double along[3], const char *name)
{
    const double squares = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    const double sum = fabs(along[0]) + fabs(along[1]) + fabs(along[2]);
    CHECK(squares == 1 && sum == 1, STATUS_BAD_INPUT, "%s.along = [%g, %g, %g]: must be an axis, such as [0, 1, 0]",
          name, along[0], along[1], along[2]);
    return status_ok();
}
