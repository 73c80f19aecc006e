/* SPDX-License-Identifier: BSD-3-Clause */
/* Plastic power: sum V s : D over a body's intact points that yield, those whose Mises stress has reached 0.9 of their
 * flow stress. */
#include "mpm/read/probe_kinds.h"

static const base_param params[] = { PARAMS_END };

static const mpm_column columns[] = { { "power", "W", "plastic power" }, { NULL, NULL, NULL } };

typedef struct {
    int body;
    double sum;
} power;

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    power *s = user;
    const block *q = &m->blocks[index];
    if (!visit_wants(m, index, s->body)) return;
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0) s->sum += lane_plastic_power(q, l);
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    power share[SHARES];
    for (int i = 0; i < SHARES; i++) share[i] = (power){ .body = p->body };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    *out = 0;
    for (int i = 0; i < SHARES; i++) *out += share[i].sum;
    return status_ok();
}

const mpm_probe_kind mpm_probe_plastic = {
    .name = "plastic", .doc = "plastic power of a body", .params = params, .columns = columns, .mains = 1, .read = read
};
