/* Reading the solver's state: balance, report, particle fields. */
#include "mpm/store.h"

#include <math.h>
#include <string.h>

const mpm_field_info mpm_field_table[MPM_FIELD_COUNT] = {
#define INFO(name, width, unit, doc) { #name, width, unit, doc },
    PARTICLE_FIELDS(INFO)
#undef INFO
};

/* Calls `each` for every block in the fixed order of bricks, cells and chains. */
typedef void block_visitor(void *user, const mpm *m, int index);

static void visit(const mpm *m, block_visitor *each, void *user)
{
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) each(user, m, q);
}

/* Sums of the books.  Millions of equal terms round the same way each time: what is lost is carried along (Neumaier 1974). */
enum { BOOK_MASS, BOOK_KINETIC, BOOK_INTERNAL, BOOK_AHEAD, BOOK_MOMENTUM, BOOKS = BOOK_MOMENTUM + 3 };

typedef struct {
    double sum[BOOKS], rest[BOOKS];
} books;

static double lane_work_ahead(const block *q, int lane, double dt)
{
    double s[6], L[9];
    for (int i = 0; i < 6; i++) s[i] = q->s[i][lane];
    for (int i = 0; i < 9; i++) L[i] = q->L[i][lane];
    return work_ahead(s, q->p[0][lane], L, q->rho[0][lane], dt);
}

static void balance_block(void *user, const mpm *m, int index)
{
    books *b = user;
    const block *q = &m->blocks[index];
    double add[BOOKS] = { 0 };
    for (int i = 0; i < LANES; i++) {
        const double M = q->mass[0][i];
        double square = 0;
        for (int k = 0; k < 3; k++) {
            const double v = q->v[k][i];
            square += v * v;
            add[BOOK_MOMENTUM + k] += M * v;
        }
        add[BOOK_MASS] += M;
        add[BOOK_KINETIC] += M * (0.5 * square + q->ka[0][i]);
        add[BOOK_INTERNAL] += M * q->e[0][i];
        add[BOOK_AHEAD] += M * lane_work_ahead(q, i, m->dt_last);
    }
    for (int i = 0; i < BOOKS; i++) {
        const double old = b->sum[i], now = old + add[i];
        b->rest[i] += fabs(old) >= fabs(add[i]) ? (old - now) + add[i] : (add[i] - now) + old;
        b->sum[i] = now;
    }
}

static double norm(const double *a)
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double start_speed(const mpm *m)
{
    double largest = 0;
    for (int i = 0; i < m->scene.bodies; i++) largest = fmax(largest, norm(m->scene.body[i].velocity));
    return largest;
}

mpm_ledger mpm_balance(const mpm *m)
{
    mpm_ledger l = m->ledger;
    books b = { .sum = { 0 } };
    visit(m, balance_block, &b);
    for (int i = 0; i < BOOKS; i++) b.sum[i] += b.rest[i];
    l.mass = b.sum[BOOK_MASS], l.kinetic = b.sum[BOOK_KINETIC], l.internal = b.sum[BOOK_INTERNAL];
    l.work_ahead = b.sum[BOOK_AHEAD];
    memcpy(l.momentum, b.sum + BOOK_MOMENTUM, sizeof l.momentum);
    double left[3];
    for (int k = 0; k < 3; k++)
        left[k] =
            l.momentum[k] + l.ejected_momentum[k] - l.momentum_start[k] - l.impulse_boundary[k] - l.impulse_external[k];
    const double scale = l.mass_start * start_speed(m);
    l.momentum_error = norm(left) / (scale > 0 ? scale : 1);
    l.energy_error = (l.kinetic + l.internal - l.work_ahead + l.ejected_energy - l.work_boundary - l.work_external -
                      l.energy_start) /
                     (l.kinetic_start > 0 ? l.kinetic_start : 1);
    return l;
}

static void failed_block(void *user, const mpm *m, int index)
{
    mpm_report *r = user;
    const block *q = &m->blocks[index];
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0 && q->damage[0][l] >= 1)
            r->failed_volume[m->links[index].body] += q->mass[0][l] / q->rho[0][l];
}

mpm_report mpm_glance(const mpm *m)
{
    mpm_report r = m->report;
    r.time = m->time;
    r.dt = m->dt;
    r.steps = m->steps;
    r.particle_steps_dense = (uint64_t)m->dense_steps;
    memset(r.failed_volume, 0, sizeof r.failed_volume);
    return r;
}

mpm_report mpm_state(const mpm *m)
{
    mpm_report r = mpm_glance(m);
    visit(m, failed_block, &r);
    return r;
}

const mpm_scene *mpm_scene_of(const mpm *m)
{
    return &m->scene;
}

const mpm_wake *mpm_wake_of(const mpm *m)
{
    return &m->wake;
}

const char *mpm_instruction_set(void)
{
    return kernels_choose(NULL)->name;
}

size_t mpm_particles(const mpm *m)
{
    size_t n = 0;
    for (int i = 0; i < m->bricks_used; i++) n += (size_t)m->bricks[i].particles;
    return n;
}

/* ---- percentiles ---- */

enum { BINS = 2400 }; /* of 1 %, from 1 kPa */

typedef struct {
    double mises[MPM_MAX_BODIES][BINS], pressure[MPM_MAX_BODIES][BINS], mass[MPM_MAX_BODIES];
} histogram;

static int bin_of(double pascal)
{
    const int i = pascal > 1e3 ? (int)(log(pascal / 1e3) * 100) : 0;
    return i < BINS ? i : BINS - 1;
}

static double lane_mises(const block *q, int l)
{
    const double n = q->s[0][l] * q->s[0][l] + q->s[1][l] * q->s[1][l] + q->s[2][l] * q->s[2][l] +
                     2 * (q->s[3][l] * q->s[3][l] + q->s[4][l] * q->s[4][l] + q->s[5][l] * q->s[5][l]);
    return sqrt(1.5 * n);
}

static void histogram_block(void *user, const mpm *m, int index)
{
    histogram *h = user;
    const block *q = &m->blocks[index];
    const int body = m->links[index].body;
    for (int l = 0; l < LANES; l++) {
        const double mass = q->mass[0][l];
        if (!(mass > 0)) continue;
        h->mass[body] += mass;
        h->mises[body][bin_of(lane_mises(q, l))] += mass;
        h->pressure[body][bin_of(q->p[0][l])] += mass;
    }
}

static double percentile_999(const double *bins, double mass)
{
    double above = 0;
    int i = BINS - 1;
    for (; i > 0; i--) {
        above += bins[i];
        if (above >= 1e-3 * mass) break;
    }
    return i > 0 ? 1e3 * exp((i + 0.5) / 100) : 0;
}

void mpm_sample_percentiles(mpm *m)
{
    histogram *h = m->histogram;
    memset(h, 0, sizeof *h);
    visit(m, histogram_block, h);
    for (int i = 0; i < m->scene.bodies; i++) {
        m->report.peak_mises_999[i] = fmax(m->report.peak_mises_999[i], percentile_999(h->mises[i], h->mass[i]));
        m->report.peak_pressure_999[i] =
            fmax(m->report.peak_pressure_999[i], percentile_999(h->pressure[i], h->mass[i]));
    }
}

size_t mpm_histogram_bytes(void)
{
    return sizeof(histogram);
}

/* ---- particle fields ---- */

static void get_stress(const block *q, int l, double *out)
{
    for (int i = 0; i < 6; i++) out[i] = q->s[i][l] - (i < 3 ? q->p[0][l] : 0);
}

static void get_lane(const mpm *m, int index, int l, mpm_field field, double *out)
{
    const block *q = &m->blocks[index];
    switch (field) {
    case MPM_position:
        for (int k = 0; k < 3; k++) out[k] = q->x[k][l];
        break;
    case MPM_velocity:
        for (int k = 0; k < 3; k++) out[k] = q->v[k][l];
        break;
    case MPM_stress: get_stress(q, l, out); break;
    case MPM_pressure: out[0] = q->p[0][l]; break;
    case MPM_mises: out[0] = lane_mises(q, l); break;
    case MPM_plastic_strain: out[0] = q->ep[0][l]; break;
    case MPM_damage: out[0] = q->damage[0][l]; break;
    case MPM_temperature: out[0] = q->T[0][l]; break;
    case MPM_density: out[0] = q->rho[0][l]; break;
    case MPM_energy: out[0] = q->e[0][l]; break;
    case MPM_mass: out[0] = q->mass[0][l]; break;
    case MPM_size:
        for (int k = 0; k < 3; k++) out[k] = q->half[k][l];
        break;
    case MPM_body: out[0] = m->links[index].body; break;
    case MPM_start:
        for (int k = 0; k < 3; k++) out[k] = q->start[k][l];
        break;
    case MPM_FIELD_COUNT: break;
    }
}

typedef struct {
    mpm_field field;
    double *to;
} reading;

static void read_block(void *user, const mpm *m, int index)
{
    reading *r = user;
    for (int l = 0; l < LANES; l++)
        if (m->links[index].mask >> l & 1) {
            get_lane(m, index, l, r->field, r->to);
            r->to += mpm_field_table[r->field].width;
        }
}

void mpm_read(const mpm *m, mpm_field field, double *out)
{
    reading r = { field, out };
    visit(m, read_block, &r);
}
