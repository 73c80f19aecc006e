/* SPDX-License-Identifier: BSD-3-Clause */
/* Energy: what a body holds, and how much of it has failed. */
#include "mpm/read/probe_kinds.h"

static const base_param params[] = { PARAMS_END };

enum { KINETIC, INTERNAL, FAILED, COLUMNS };

static const mpm_column columns[COLUMNS + 1] = {
    { "kinetic", "J", "kinetic energy, that of the points' velocity gradients included" },
    { "internal", "J", "work of the stress and heat" },
    { "failed_volume", "m^3", "of points whose damage has reached 1" },
    { NULL, NULL, NULL },
};

typedef struct {
    int body;
    double sum[COLUMNS];
} energies;

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    energies *s = user;
    const block *q = &m->blocks[index];
    if (!visit_wants(m, index, s->body)) return;
    for (int l = 0; l < LANES; l++) {
        const double M = q->mass[0][l];
        if (!(M > 0)) continue;
        double square = 0;
        for (int k = 0; k < 3; k++) square += q->v[k][l] * q->v[k][l];
        s->sum[KINETIC] += M * (0.5 * square + q->ka[0][l]);
        s->sum[INTERNAL] += M * q->e[0][l];
        s->sum[FAILED] += q->damage[0][l] >= 1 ? M / q->rho[0][l] : 0;
    }
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    energies share[SHARES];
    for (int i = 0; i < SHARES; i++) share[i] = (energies){ .body = p->body };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    for (int k = 0; k < COLUMNS; k++) {
        out[k] = 0;
        for (int i = 0; i < SHARES; i++) out[k] += share[i].sum[k];
    }
    return status_ok();
}

const mpm_probe_kind mpm_probe_energy = { .name = "energy",
                                          .doc = "kinetic and internal energy and failed volume of a body",
                                          .params = params,
                                          .columns = columns,
                                          .mains = 1,
                                          .read = read };
