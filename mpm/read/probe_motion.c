/* SPDX-License-Identifier: BSD-3-Clause */
/* Motion: mass, centre of mass, its velocity, and the angular momentum about it, that of the points' velocity gradients
 * included:  J = sum m (x - X) cross (v - V) + m D_k e_k cross (L e_k). */
#include "mpm/read/probe_kinds.h"

static const base_param params[] = { PARAMS_END };

enum { MASS, PLACE, SPEED = PLACE + 3, TURNING = SPEED + 3, COLUMNS = TURNING + 3 };

static const mpm_column columns[COLUMNS + 1] = {
    { "mass", "kg", "now in the window" },
    { "x", "m", "centre of mass" },
    { "y", "m", "the same along y" },
    { "z", "m", "the same along z" },
    { "velocity_x", "m/s", "of the centre of mass" },
    { "velocity_y", "m/s", "the same along y" },
    { "velocity_z", "m/s", "the same along z" },
    { "angular_momentum_x", "kg m^2/s", "about the centre of mass" },
    { "angular_momentum_y", "kg m^2/s", "the same about y" },
    { "angular_momentum_z", "kg m^2/s", "the same about z" },
    { NULL, NULL, NULL },
};

typedef struct {
    int body;
    double sum[COLUMNS]; /* of m times place, velocity and their product */
} moments;

static void add_lane(moments *s, const mpm *m, const axis *axes, const block *q, int l)
{
    const double M = q->mass[0][l];
    double D[3];
    for (int k = 0; k < 3; k++) {
        const bool affine = m->scene.transfer == MPM_TRANSFER_TPIC;
        D[k] = affine ? mpm_axis_spread(&axes[k], q->x[k][l], q->half[k][l], m->scene.basis) : 0;
        s->sum[PLACE + k] += M * q->x[k][l];
        s->sum[SPEED + k] += M * q->v[k][l];
    }
    s->sum[MASS] += M;
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        s->sum[TURNING + k] += M * (q->x[u][l] * q->v[v][l] - q->x[v][l] * q->v[u][l] + D[u] * q->L[3 * v + u][l] -
                                    D[v] * q->L[3 * u + v][l]);
    }
}

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    moments *s = user;
    if (!visit_wants(m, index, s->body)) return;
    for (int l = 0; l < LANES; l++)
        if (m->blocks[index].mass[0][l] > 0) add_lane(s, m, axes_of(m, b), &m->blocks[index], l);
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    moments share[SHARES];
    for (int i = 0; i < SHARES; i++) share[i] = (moments){ .body = p->body };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    for (int k = 0; k < COLUMNS; k++) {
        out[k] = 0;
        for (int i = 0; i < SHARES; i++) out[k] += share[i].sum[k];
    }
    for (int k = PLACE; k < TURNING; k++) out[k] = out[MASS] > 0 ? out[k] / out[MASS] : NAN;
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double of_middle = out[MASS] * (out[PLACE + u] * out[SPEED + v] - out[PLACE + v] * out[SPEED + u]);
        out[TURNING + k] -= of_middle;
    }
    return status_ok();
}

const mpm_probe_kind mpm_probe_motion = { .name = "motion",
                                          .doc = "mass, place, velocity and angular momentum of a body",
                                          .params = params,
                                          .columns = columns,
                                          .main = SPEED,
                                          .mains = 3,
                                          .read = read };
