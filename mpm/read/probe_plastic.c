/* Plastic power: sum V s : D over a body's intact points that yield, those whose Mises stress has reached 0.9 of their
 * flow stress. */
#include "mpm/read/probe_kinds.h"

static const param params[] = { PARAMS_END };

static const double YIELDS = 0.9;

static const mpm_column columns[] = { { "power", "W", "plastic power" }, { NULL, NULL, NULL } };

typedef struct {
    int body;
    double sum;
} power;

/* s : D, s in the order xx yy zz xy xz yz [W/m3] */
static double lane_power(const block *q, int l)
{
    double square = 0, sum = 0;
    if (q->damage[0][l] >= 1) return 0;
    for (int i = 0; i < 6; i++) square += (i < 3 ? 1 : 2) * q->s[i][l] * q->s[i][l];
    const double limit = YIELDS * q->flow[0][l];
    if (1.5 * square < limit * limit) return 0;
    for (int i = 0; i < 3; i++) sum += q->s[i][l] * q->L[4 * i][l];
    sum += q->s[3][l] * (q->L[1][l] + q->L[3][l]) + q->s[4][l] * (q->L[2][l] + q->L[6][l]) +
           q->s[5][l] * (q->L[5][l] + q->L[7][l]);
    return fmax(sum, 0);
}

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    power *s = user;
    const block *q = &m->blocks[index];
    if (!visit_wants(m, index, s->body)) return;
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0) s->sum += lane_power(q, l) * q->mass[0][l] / q->rho[0][l];
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
    .name = "plastic", .doc = "plastic power of a body", .params = params, .columns = columns, .read = read
};
