/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading the solver's state: balance, report, point fields. */
#include "mpm/read/visit.h"

#include "mpm/memory/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const mpm_field_info mpm_field_table[MPM_FIELD_COUNT] = {
#define INFO(name, width, unit, doc) { #name, width, unit, doc },
    PARTICLE_FIELDS(INFO)
#undef INFO
};

static void visit_bricks(const mpm *m, int from, int to, mpm_block_visitor *each, void *user)
{
    for (int i = from; i < to; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) each(user, m, &m->bricks[i], q);
}

static void visit(const mpm *m, mpm_block_visitor *each, void *user)
{
    visit_bricks(m, 0, m->bricks_used, each, user);
}

void mpm_visit_shares(const mpm *m, mpm_block_visitor *each, void *sums, size_t bytes)
{
#pragma omp parallel for schedule(dynamic) num_threads(m->threads)
    for (int i = 0; i < SHARES; i++)
        visit_bricks(m, share_begin(m->bricks_used, i), share_begin(m->bricks_used, i + 1), each,
                     (char *)sums + (size_t)i * bytes);
}

/* Sums of the ledger.  Millions of equal terms have equal rounding errors, which add up: compensated summation
 * (Neumaier 1974). */
enum { SUM_MASS, SUM_KINETIC, SUM_INTERNAL, SUM_AHEAD, SUM_MOMENTUM, SUMS = SUM_MOMENTUM + 3 };

typedef struct {
    double sum[SUMS], rest[SUMS];
} ledger_sums;

static double lane_work_ahead(const block *q, int lane, double dt)
{
    double s[6], L[9];
    for (int i = 0; i < 6; i++) s[i] = q->s[i][lane];
    for (int i = 0; i < 9; i++) L[i] = q->L[i][lane];
    return work_ahead(s, q->p[0][lane], L, q->rho[0][lane], dt);
}

static void ledger_sums_add(ledger_sums *b, const double add[SUMS])
{
    for (int i = 0; i < SUMS; i++) {
        const double old = b->sum[i], now = old + add[i];
        b->rest[i] += fabs(old) >= fabs(add[i]) ? (old - now) + add[i] : (add[i] - now) + old;
        b->sum[i] = now;
    }
}

/* Of all lanes side by side, then added up one after the other. */
static void balance_block(void *user, const mpm *m, const brick *b, int index)
{
    const block *q = &m->blocks[index];
    const double dt = level_dt_last(m, b->level);
    double of_lane[SUMS][LANES], add[SUMS] = { 0 };
    for (int i = 0; i < LANES; i++) {
        const double M = q->mass[0][i];
        double square = 0;
        for (int k = 0; k < 3; k++) {
            const double v = q->v[k][i];
            square += v * v;
            of_lane[SUM_MOMENTUM + k][i] = M * v;
        }
        of_lane[SUM_MASS][i] = M;
        of_lane[SUM_KINETIC][i] = M * (0.5 * square + q->ka[0][i]);
        of_lane[SUM_INTERNAL][i] = M * q->e[0][i];
        of_lane[SUM_AHEAD][i] = M * lane_work_ahead(q, i, dt);
    }
    for (int k = 0; k < SUMS; k++)
        for (int i = 0; i < LANES; i++) add[k] += of_lane[k][i];
    ledger_sums_add(user, add);
}

static ledger_sums ledger_summed(const mpm *m)
{
    ledger_sums share[SHARES] = { { .sum = { 0 } } }, all = { .sum = { 0 } };
    mpm_visit_shares(m, balance_block, share, sizeof *share);
    for (int i = 0; i < SHARES; i++) ledger_sums_add(&all, share[i].sum), ledger_sums_add(&all, share[i].rest);
    return all;
}

static double norm(const double *a)
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double start_speed(const mpm *m)
{
    double largest = 0;
    for (int i = 0; i < m->scene.bodies; i++)
        largest = fmax(largest, norm(m->scene.body[i].velocity) + mpm_build_spin_speed(&m->scene, i));
    return largest;
}

mpm_ledger mpm_balance(const mpm *m)
{
    mpm_ledger l = m->ledger;
    ledger_sums b = ledger_summed(m);
    for (int i = 0; i < SUMS; i++) b.sum[i] += b.rest[i];
    l.mass = b.sum[SUM_MASS], l.kinetic = b.sum[SUM_KINETIC], l.internal = b.sum[SUM_INTERNAL];
    l.work_ahead = b.sum[SUM_AHEAD];
    memcpy(l.momentum, b.sum + SUM_MOMENTUM, sizeof l.momentum);
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

static void failed_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    double *volume = user;
    const block *q = &m->blocks[index];
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0 && q->damage[0][l] >= 1) volume[m->links[index].body] += q->mass[0][l] / q->rho[0][l];
}

/* Into m->failed, where shares come after the sums. */
static const double *find_failed(const mpm *m)
{
    const size_t bodies = (size_t)m->scene.bodies;
    double *all = m->failed, *share = all + bodies;
    memset(all, 0, (1 + SHARES) * bodies * sizeof *all);
    mpm_visit_shares(m, failed_block, share, bodies * sizeof *share);
    for (size_t i = 0; i < SHARES * bodies; i++) all[i % bodies] += share[i];
    return all;
}

void mpm_failed_volumes(const mpm *m, double *volume)
{
    memcpy(volume, find_failed(m), (size_t)m->scene.bodies * sizeof *volume);
}

mpm_body_report mpm_body_state(const mpm *m, int body)
{
    return m->body_report[body];
}

const double *mpm_contact_force(const mpm *m, int group)
{
    return m->force[group].last;
}

const double *mpm_peak_contact_force(const mpm *m, int group)
{
    return m->force[group].peak;
}

mpm_report mpm_glance(const mpm *m)
{
    mpm_report r = m->report;
    r.time = m->time;
    r.dt = m->dt;
    r.steps = m->steps;
    r.particle_steps_dense = (uint64_t)m->dense_steps;
    return r;
}

mpm_report mpm_state(const mpm *m)
{
    mpm_report r = mpm_glance(m);
    const double *volume = find_failed(m);
    for (int body = 0; body < m->scene.bodies; body++) r.failed_volume += volume[body];
    return r;
}

const mpm_scene *mpm_scene_of(const mpm *m)
{
    return &m->scene;
}

size_t mpm_points(const mpm *m)
{
    size_t n = 0;
    for (int i = 0; i < m->bricks_used; i++) n += (size_t)m->bricks[i].particles;
    return n;
}

/* ---- percentiles ---- */

static const double TOP = 1e-3;        /* fraction of a body's mass above its 99.9th percentile [1] */
static const double BIN_LOWEST = 1e3;  /* [Pa] */
enum { BINS = 2400, BINS_AN_E = 100 }; /* bins of 1 % */

/* Quantities with percentiles: Mises stress, pressure [Pa]. */
enum { MISES, PRESSURE, STRESSES };

/* Bins of a body [kg]; STRESSES x bodies of them. */
static double *histogram_of(const mpm *m, int stress, int body)
{
    return m->histogram + ((size_t)stress * (size_t)m->scene.bodies + (size_t)body) * BINS;
}

/* Mass of a body, and of its points above the largest percentiles so far, lane by lane [kg]. */
struct body_tops {
    double passed[STRESSES]; /* ends of the bins that hold those percentiles [Pa] */
    double mass[LANES], above[STRESSES][LANES];
};

status mpm_reading_make(mpm *m)
{
    const size_t bodies = (size_t)m->scene.bodies;
    m->histogram = malloc(STRESSES * bodies * BINS * sizeof *m->histogram);
    m->tops = malloc((1 + SHARES) * bodies * sizeof *m->tops);
    m->failed = malloc((1 + SHARES) * bodies * sizeof *m->failed);
    CHECK(m->histogram && m->tops && m->failed, STATUS_MEMORY, "no memory for the percentiles of %zu bodies", bodies);
    return status_ok();
}

void mpm_reading_free(mpm *m)
{
    free(m->histogram);
    free(m->tops);
    free(m->failed);
}

static int bin_of(double pascal)
{
    const int i = pascal > BIN_LOWEST ? (int)(log(pascal / BIN_LOWEST) * BINS_AN_E) : 0;
    return i < BINS ? i : BINS - 1;
}

static double lane_mises_square(const block *q, int l)
{
    const double n = q->s[0][l] * q->s[0][l] + q->s[1][l] * q->s[1][l] + q->s[2][l] * q->s[2][l] +
                     2 * (q->s[3][l] * q->s[3][l] + q->s[4][l] * q->s[4][l] + q->s[5][l] * q->s[5][l]);
    return 1.5 * n;
}

static double lane_mises(const block *q, int l)
{
    return sqrt(lane_mises_square(q, l));
}

static bool is_intact(const block *q, int l)
{
    return q->damage[0][l] < 1;
}

static void tops_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    body_tops *t = (body_tops *)user + m->links[index].body;
    const block *q = &m->blocks[index];
    const double mises2 = t->passed[MISES] * t->passed[MISES], pressure = t->passed[PRESSURE];
    for (int l = 0; l < LANES; l++) {
        const double mass = q->mass[0][l];
        t->mass[l] += mass;
        t->above[MISES][l] += lane_mises_square(q, l) > mises2 ? mass : 0;
        t->above[PRESSURE][l] += q->p[0][l] > pressure && is_intact(q, l) ? mass : 0;
    }
}

static void add_tops(body_tops *a, const body_tops *b)
{
    for (int l = 0; l < LANES; l++) {
        a->mass[l] += b->mass[l];
        for (int k = 0; k < STRESSES; k++) a->above[k][l] += b->above[k][l];
    }
}

/* Into m->tops, where shares come after the sums. */
static void find_tops(mpm *m)
{
    const size_t bodies = (size_t)m->scene.bodies;
    body_tops *all = m->tops, *share = all + bodies;
    for (size_t i = 0; i < bodies; i++)
        all[i] = (body_tops){ .passed = { [MISES] = m->body_report[i].peak_mises_999 * exp(0.5 / BINS_AN_E),
                                          [PRESSURE] = m->body_report[i].peak_pressure_999 * exp(0.5 / BINS_AN_E) } };
    for (size_t i = 0; i < SHARES; i++) memcpy(share + i * bodies, all, bodies * sizeof *all);
    mpm_visit_shares(m, tops_block, share, bodies * sizeof *share);
    for (size_t i = 0; i < SHARES * bodies; i++) add_tops(&all[i % bodies], &share[i]);
}

static double lanes_sum(const double a[LANES])
{
    double sum = 0;
    for (int l = 0; l < LANES; l++) sum += a[l];
    return sum;
}

static bool percentiles_rise(const mpm *m, int stress)
{
    bool rise = false;
    for (int body = 0; body < m->scene.bodies; body++)
        rise = rise || lanes_sum(m->tops[body].above[stress]) > TOP * lanes_sum(m->tops[body].mass);
    return rise;
}

/* Points above the percentile so far of the stress *user; only these can raise it. */
static void histogram_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    const int kind = *(const int *)user, body = m->links[index].body;
    const block *q = &m->blocks[index];
    const double passed = m->tops[body].passed[kind];
    double *bins = histogram_of(m, kind, body);
    for (int l = 0; l < LANES; l++) {
        const double stress = kind == MISES ? lane_mises(q, l) : q->p[0][l];
        if (stress > passed && (kind == MISES || is_intact(q, l))) bins[bin_of(stress)] += q->mass[0][l];
    }
}

static double percentile_999(const double *bins, const double mass[LANES])
{
    const double top = TOP * lanes_sum(mass);
    double above = 0;
    int i = BINS - 1;
    for (; i > 0; i--) {
        above += bins[i];
        if (above > top) break;
    }
    return i > 0 ? BIN_LOWEST * exp((i + 0.5) / BINS_AN_E) : 0;
}

void mpm_sample_percentiles(mpm *m)
{
    find_tops(m);
    memset(m->histogram, 0, STRESSES * (size_t)m->scene.bodies * BINS * sizeof *m->histogram);
#pragma omp parallel for num_threads(m->threads)
    for (int k = 0; k < STRESSES; k++)
        if (percentiles_rise(m, k)) visit(m, histogram_block, &k);
    for (int i = 0; i < m->scene.bodies; i++) {
        mpm_body_report *b = &m->body_report[i];
        const double *mass = m->tops[i].mass;
        b->peak_mises_999 = fmax(b->peak_mises_999, percentile_999(histogram_of(m, MISES, i), mass));
        b->peak_pressure_999 = fmax(b->peak_pressure_999, percentile_999(histogram_of(m, PRESSURE, i), mass));
    }
}

/* ---- point fields ---- */

enum { WIDEST = 6 }; /* values of a point in one field */

typedef double row[LANES]; /* a value a lane */

/* In the order that ParaView reads a symmetric tensor in: the last two of a block's are the other way round. */
static void stress_rows(const block *q, row *out)
{
    static const int from[6] = { 0, 1, 2, 3, 5, 4 };
    for (int i = 0; i < 6; i++)
        for (int l = 0; l < LANES; l++) out[i][l] = q->s[from[i]][l] - (i < 3 ? q->p[0][l] : 0);
}

/* A field's rows in a block: its own, or made in `made`. */
static const row *field_rows(const mpm *m, int index, mpm_field field, row made[WIDEST])
{
    const block *q = &m->blocks[index];
    switch (field) {
    case MPM_position: return q->x;
    case MPM_velocity: return q->v;
    case MPM_stress: stress_rows(q, made); break;
    case MPM_pressure: return q->p;
    case MPM_mises:
        for (int l = 0; l < LANES; l++) made[0][l] = lane_mises(q, l);
        break;
    case MPM_plastic_strain: return q->ep;
    case MPM_damage: return q->damage;
    case MPM_temperature: return q->T;
    case MPM_density: return q->rho;
    case MPM_energy: return q->e;
    case MPM_mass: return q->mass;
    case MPM_size: return q->half;
    case MPM_body:
        for (int l = 0; l < LANES; l++) made[0][l] = m->links[index].body;
        break;
    case MPM_start: return q->start;
    case MPM_FIELD_COUNT: break;
    }
    return (const row *)made;
}

/* Points in front of each share of the bricks: where its values begin. */
static void count_before(const mpm *m, size_t before[SHARES])
{
    size_t n = 0;
    for (int i = 0, at = 0; i < SHARES; i++) {
        before[i] = n;
        for (; at < share_begin(m->bricks_used, i + 1); at++) n += (size_t)m->bricks[at].particles;
    }
}

typedef struct {
    mpm_field field;
    double *to;
} reading;

static void read_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    row made[WIDEST];
    reading *r = user;
    const row *from = field_rows(m, index, r->field, made);
    for (int l = 0; l < LANES; l++)
        for (int k = 0; m->links[index].mask >> l & 1 && k < mpm_field_table[r->field].width; k++)
            *r->to++ = from[k][l];
}

void mpm_read(const mpm *m, mpm_field field, double *out)
{
    reading share[SHARES];
    size_t before[SHARES];
    count_before(m, before);
    for (int i = 0; i < SHARES; i++)
        share[i] = (reading){ field, out + before[i] * (size_t)mpm_field_table[field].width };
    mpm_visit_shares(m, read_block, share, sizeof *share);
}

typedef struct {
    float *to[MPM_FIELD_COUNT];
} reading_all;

static float *put_rows(const row *from, int width, uint8_t mask, float *to)
{
    for (int l = 0; l < LANES; l++)
        for (int k = 0; mask >> l & 1 && k < width; k++) *to++ = (float)from[k][l];
    return to;
}

static void read_all_of_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    row made[WIDEST];
    reading_all *r = user;
#define PUT(name, width, unit, doc) \
    r->to[MPM_##name] =             \
        put_rows(field_rows(m, index, MPM_##name, made), width, m->links[index].mask, r->to[MPM_##name]);
    PARTICLE_FIELDS(PUT)
#undef PUT
}

void mpm_read_all(const mpm *m, float *const out[MPM_FIELD_COUNT])
{
    reading_all share[SHARES];
    size_t before[SHARES];
    count_before(m, before);
    for (int i = 0; i < SHARES; i++)
        for (int f = 0; f < MPM_FIELD_COUNT; f++)
            share[i].to[f] = out[f] + before[i] * (size_t)mpm_field_table[f].width;
    mpm_visit_shares(m, read_all_of_block, share, sizeof *share);
}
