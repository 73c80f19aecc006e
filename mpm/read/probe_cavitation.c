/* SPDX-License-Identifier: BSD-3-Clause */
/* Cavities of a fluid: its points that are thinner than it is at rest hold a void. */
#include "mpm/read/probe_kinds.h"

static const double THIN = 1e-3; /* of the density at rest: stretched by more counts as cavitated */

static const base_param params[] = { PARAMS_END };

enum { VOLUME, OPEN, COLUMNS };

static const mpm_column columns[COLUMNS + 1] = {
    { "volume", "m^3", "of points whose density is a thousandth or more below that at rest" },
    { "open", "m^3", "void in them: their volume beyond that of their mass at rest" },
    { NULL, NULL, NULL },
};

typedef struct {
    int body;
    double sum[COLUMNS];
} cavities;

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    cavities *s = user;
    const block *q = &m->blocks[index];
    const law *k = &m->laws[m->links[index].body];
    if (!visit_wants(m, index, s->body) || k->shear != MPM_SHEAR_NONE) return;
    for (int l = 0; l < LANES; l++) {
        if (!(q->mass[0][l] > 0) || q->rho[0][l] > (1 - THIN) * k->rho0) continue;
        const double volume = q->mass[0][l] / q->rho[0][l];
        s->sum[VOLUME] += volume;
        s->sum[OPEN] += volume - q->mass[0][l] / k->rho0;
    }
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    cavities share[SHARES];
    for (int i = 0; i < SHARES; i++) share[i] = (cavities){ .body = p->body };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    for (int k = 0; k < COLUMNS; k++) {
        out[k] = 0;
        for (int i = 0; i < SHARES; i++) out[k] += share[i].sum[k];
    }
    return status_ok();
}

const mpm_probe_kind mpm_probe_cavitation = { .name = "cavitation",
                                              .doc = "cavitated volume of a fluid",
                                              .params = params,
                                              .columns = columns,
                                              .mains = 1,
                                              .read = read };
