/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/shot_model.h"

#include <math.h>
#include <string.h>

/* Held armatures are released once the force exceeds static friction by this [N]: a located root needs a sign change.
 */
static const double RELEASE_MARGIN = 1e-3;

enum { TAIL_MAX = Y_COUNT + SHOT_MAX_FEEDS * (4 + 2 * CIRCUIT_LADDER_MAX_RUNGS) };

static int tail_size(const shot_model *m)
{
    return Y_COUNT + m->feeds - 1 + m->feeds * circuit_rails_memory_size(&m->rails);
}

int circuit_shot_unknowns(const shot_model *m)
{
    return m->start + tail_size(m);
}

int circuit_shot_feed_unknown(int feed)
{
    return feed == 0 ? Y_BREECH : Y_COUNT + feed - 1;
}

static int memory_unknown(const shot_model *m, int segment)
{
    return Y_COUNT + m->feeds - 1 + segment * circuit_rails_memory_size(&m->rails);
}

/* ---- the groups, summed ---- */

static void drive_add(shot_drive *d, const supply_group *g, const supply_flow *f, double i)
{
    for (int h = 0; h < HEAT_PLACES; h++) d->heat[h] += g->n * f->heat[h];
    d->supplied += g->n * f->supplied;
    if (!circuit_supply_conducts(g)) return;
    d->any = true;
    d->I[g->feed] += g->n * i;
    d->push[g->feed] += g->n * f->push;
    d->pull[g->feed] += g->n * f->pull;
    if (g->kind->source) d->source[g->feed] += g->n * i;
}

static void drive_clear(shot_drive *d, int feeds)
{
    const size_t bytes = (size_t)feeds * sizeof(double);
    d->any = false;
    d->supplied = 0.0;
    memset(d->heat, 0, sizeof d->heat);
    memset(d->I, 0, bytes);
    memset(d->push, 0, bytes);
    memset(d->pull, 0, bytes);
    memset(d->source, 0, bytes);
}

/* The groups' rates into `rates` at the voltages of the tail, their sums into d. */
static void groups_rates(const shot_model *m, double t, const double *y, double *rates, shot_drive *d)
{
    const double *z = y + m->start;
    drive_clear(d, m->feeds);
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        supply_flow f;
        circuit_supply_rates(g, t, y + g->first, z[circuit_shot_feed_unknown(g->feed)], rates + g->first, &f);
        drive_add(d, g, &f, y[g->first]);
    }
}

shot_drive circuit_shot_drive_at(const shot_model *m, double t, const double *y)
{
    shot_drive d;
    double rates[SUPPLY_UNKNOWNS];
    drive_clear(&d, m->feeds);
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        supply_flow f;
        circuit_supply_rates(g, t, y + g->first, 0.0, rates, &f);
        drive_add(&d, g, &f, y[g->first]);
    }
    return d;
}

double circuit_shot_current_slope(const shot_model *m, const shot_drive *d, const double *z)
{
    double slope = 0.0;
    for (int f = 0; f < m->reached; f++) slope += d->push[f] - d->pull[f] * z[circuit_shot_feed_unknown(f)];
    return slope;
}

/* ---- the rails ---- */

/* Where the loop ends: at the armature, or at the muzzle once it has left. */
static double loop_end(const shot_model *m, const double *z)
{
    return m->phase == CIRCUIT_SHOT_LEFT ? m->barrel.length : z[Y_X];
}

static double segment_length(const shot_model *m, int f, const double *z)
{
    return (f == m->reached - 1 ? loop_end(m, z) : m->feed[f + 1]) - m->feed[f];
}

/* Segment f behind the armature: its length, and the speed at which it grows. */
static circuit_rails_flow segment_flow(const shot_model *m, int f, double I, const double *z, double *len, double *v)
{
    *len = segment_length(m, f, z);
    *v = f == m->reached - 1 && m->phase == CIRCUIT_SHOT_MOVING ? fmax(z[Y_V], 0.0) : 0.0;
    return circuit_rails_flow_at(&m->rails, *len, *v, I, z + memory_unknown(m, f));
}

double circuit_shot_rails_warming(const shot_model *m, int f, const double *z)
{
    return circuit_rails_warming(&m->rails, segment_length(m, f, z), z + memory_unknown(m, f));
}

/* Loop ahead of the armature, through the shunt: its inductance. */
static double shunt_inductance(const shot_model *m, const double *z)
{
    return m->barrel.shunt_inductance + m->rails.ladder.L_inf * (m->barrel.length - loop_end(m, z));
}

double circuit_shot_rails_field(const shot_model *m, const shot_drive *d, const double *z)
{
    double field = m->shunt ? 0.5 * shunt_inductance(m, z) * z[Y_SHUNT] * z[Y_SHUNT] : 0.0, I = 0.0, len, v;
    for (int f = 0; f < m->reached; f++) field += segment_flow(m, f, I += d->I[f], z, &len, &v).field;
    return field;
}

/* Shunt L_s, R_s at the muzzle, U across the armature, L_m = L_s + L_inf (length - x), R_m alike:
 * L_m di_m/dt = U - R_m i_m + L_inf v i_m                                                 (C-15) */
static void shunt_rates(const shot_model *m, const double *z, const shot_forces *f, double *q)
{
    if (!m->shunt) return;
    const double i = z[Y_SHUNT], R = m->rails.ladder.R_dc * (m->barrel.length - loop_end(m, z));
    const double v = m->phase == CIRCUIT_SHOT_MOVING ? z[Y_V] : 0.0;
    q[Y_SHUNT] =
        (f->voltage - (R + m->barrel.shunt_resistance - m->rails.ladder.L_inf * v) * i) / shunt_inductance(m, z);
    q[Y_RAILS] += R * i * i;
    q[Y_MUZZLE] += m->barrel.shunt_resistance * i * i;
}

/* Currents add up from the breech on, I_f = sum over feeds g <= f; every segment but the last ends at the next feed,
 * the last at the armature (voltage U), with S_g - G_g V_g the slope of the current that joins at feed g:
 *   V_f = V_f+1 (or U) + L_f sum_g<=f (S_g - G_g V_g) + (the rest of segment f's voltage)   (C-14), (C-1)
 * value[f]: what V_f must be at these V; z's voltages are not touched. */
typedef struct {
    double inductance[SHOT_MAX_FEEDS], rest[SHOT_MAX_FEEDS];
} shot_line;

static void line_voltages(const shot_model *m, const shot_drive *d, const shot_line *line, double U, const double *V,
                          double *value)
{
    double slope = 0.0;
    for (int f = 0; f < m->reached; f++) {
        slope += d->push[f] - d->pull[f] * V[f];
        value[f] = (f + 1 < m->reached ? V[f + 1] : U) + line->inductance[f] * slope + line->rest[f];
    }
    for (int f = m->reached; f < m->feeds; f++) value[f] = 0.0;
}

/* The segments' part of the rates; the line for the voltages. */
static void line_rates(const shot_model *m, const shot_drive *d, const double *z, double *q, shot_line *line)
{
    double I = 0.0;
    for (int f = 0; f < m->reached; f++) {
        double len, v;
        I += d->I[f];
        const circuit_rails_flow flow = segment_flow(m, f, I, z, &len, &v);
        const int memory = memory_unknown(m, f);
        circuit_rails_memory_rates(&m->rails, len, v, I, z + memory, q + memory);
        q[Y_RAILS] += flow.heat;
        line->inductance[f] = flow.inductance;
        line->rest[f] = flow.voltage;
    }
}

static void feed_voltages(const shot_model *m, const double *z, double *V)
{
    for (int f = 0; f < m->feeds; f++) V[f] = z[circuit_shot_feed_unknown(f)];
}

/* All the tail's rates, from the sums over the groups. */
static void tail_rates(const shot_model *m, const shot_drive *d, const double *z, double *q)
{
    const shot_forces f = circuit_shot_forces_at(m, d, z);
    double V[SHOT_MAX_FEEDS], value[SHOT_MAX_FEEDS];
    shot_line line;
    memset(q, 0, (size_t)tail_size(m) * sizeof *q);
    line_rates(m, d, z, q, &line);
    feed_voltages(m, z, V);
    line_voltages(m, d, &line, f.voltage, V, value);
    for (int k = 0; k < m->feeds; k++) q[circuit_shot_feed_unknown(k)] = value[k];
    for (int h = 0; h < HEAT_PLACES; h++) q[Y_COIL + h] = d->heat[h];
    q[Y_SUPPLIED] = d->supplied;
    for (int k = 0; k < m->reached; k++) q[Y_SUPPLIED] += d->source[k] * V[k];
    q[Y_ACTION] = (f.I - f.shunt) * (f.I - f.shunt);
    if (m->phase == CIRCUIT_SHOT_LEFT) {
        q[Y_MUZZLE] = f.voltage * (f.I - f.shunt);
    } else {
        circuit_shot_armature_rates(m, z, &f, q);
    }
    shunt_rates(m, z, &f, q);
}

void circuit_shot_voltages(const shot_model *m, const shot_drive *d, double *z)
{
    const shot_forces f = circuit_shot_forces_at(m, d, z);
    double q[TAIL_MAX] = { 0.0 }, A[SHOT_MAX_FEEDS * SHOT_MAX_FEEDS], V[SHOT_MAX_FEEDS] = { 0.0 };
    double at_zero[SHOT_MAX_FEEDS], value[SHOT_MAX_FEEDS];
    int pivot[SHOT_MAX_FEEDS];
    const int n = m->reached;
    shot_line line;
    line_rates(m, d, z, q, &line);
    line_voltages(m, d, &line, f.voltage, V, at_zero);
    for (int j = 0; j < n; j++) { /* V - value(V) is linear: a column from each unit vector */
        V[j] = 1.0;
        line_voltages(m, d, &line, f.voltage, V, value);
        for (int i = 0; i < n; i++) A[i * n + j] = V[i] - (value[i] - at_zero[i]);
        V[j] = 0.0;
    }
    (void)circuit_lu_factor(A, n, n, pivot); /* diagonally dominant: inductances and pulls are positive */
    circuit_lu_solve(A, n, n, pivot, at_zero);
    for (int k = 0; k < m->feeds; k++) z[circuit_shot_feed_unknown(k)] = k < n ? at_zero[k] : 0.0;
}

/* ---- for the solver ---- */

void circuit_shot_rates(const shot_model *m, double t, const double *y, double *d)
{
    shot_drive drive;
    groups_rates(m, t, y, d, &drive);
    tail_rates(m, &drive, y + m->start, d + m->start);
}

static bool tail_is_algebraic(const shot_model *m, int j)
{
    return j == Y_BREECH || (j >= Y_COUNT && j < Y_COUNT + m->feeds - 1);
}

bool circuit_shot_is_algebraic(const shot_model *m, int j)
{
    if (j >= m->start) return tail_is_algebraic(m, j - m->start);
    int k = m->n - 1;
    while (m->groups[k].first > j) k--;
    return circuit_supply_algebraic(&m->groups[k], j - m->groups[k].first);
}

void circuit_shot_residual(const void *model, double t, const double *y, const double *yp, double *r)
{
    const shot_model *m = model;
    circuit_shot_rates(m, t, y, r);
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        for (int j = 0; j < g->unknowns; j++) {
            const int i = g->first + j;
            r[i] = (circuit_supply_algebraic(g, j) ? y[i] : yp[i]) - r[i];
        }
    }
    for (int j = 0, n = tail_size(m); j < n; j++) {
        const int i = m->start + j;
        r[i] = (tail_is_algebraic(m, j) ? y[i] : yp[i]) - r[i];
    }
}

static double difference(double y, double scale)
{
    return 1.5e-8 * fmax(fabs(y), 1e-3 * scale);
}

/* What of the tail's rates depends on the currents that join at a feed, and on the push there. */
typedef struct {
    double I[TAIL_MAX], push[TAIL_MAX];
} feed_columns;

/* Step of the currents' differences [A]: where the contact's voltage turns over with the current's sign, well within
 * the current over which it does. */
static double current_step(const shot_model *m, double I)
{
    static const double LEAST = 1e3; /* [A] */
    return 1e-6 * fmax(fabs(I), m->knee > 0.0 ? fmin(LEAST, 1e3 * m->knee) : LEAST);
}

static void feed_columns_at(const shot_model *m, const shot_drive *d, int feed, const double *z, const double *base,
                            feed_columns *c)
{
    const int n = tail_size(m);
    shot_drive moved = *d;
    const double hI = current_step(m, circuit_shot_total_current(d, m)), hp = fmax(fabs(d->push[feed]), 1e6);
    moved.I[feed] += hI;
    tail_rates(m, &moved, z, c->I);
    moved.I[feed] = d->I[feed];
    moved.push[feed] += hp; /* linear: any step will do */
    tail_rates(m, &moved, z, c->push);
    for (int r = 0; r < n; r++) {
        c->I[r] = (c->I[r] - base[r]) / hI;
        c->push[r] = (c->push[r] - base[r]) / hp;
    }
}

/* Block k and its border column and rows, by differences of the group's own flow. */
static void group_jacobian(const shot_model *m, int k, double t, double cj, const double *y, const feed_columns *c,
                           arrow *J)
{
    const supply_group *g = &m->groups[k];
    const double *own = y + g->first, V = y[m->start + J->column[k]];
    double base[SUPPLY_UNKNOWNS], moved[SUPPLY_UNKNOWNS], at[SUPPLY_UNKNOWNS], *D = circuit_arrow_block(J, k);
    supply_flow f0, f1;
    for (int j = 0; j < g->unknowns; j++) D[j * ARROW_BLOCK + j] = circuit_supply_algebraic(g, j) ? 1.0 : cj;
    J->idle[k] = g->gate == GATE_BLOCKED;
    if (J->idle[k]) return;
    circuit_supply_rates(g, t, own, V, base, &f0);
    memcpy(at, own, (size_t)g->unknowns * sizeof *at);
    for (int j = 0; j < g->unknowns; j++) {
        const double h = difference(own[j], m->scale[g->first + j]);
        double *C = circuit_arrow_column(J, k, j);
        at[j] = own[j] + h;
        circuit_supply_rates(g, t, at, V, moved, &f1);
        at[j] = own[j];
        for (int i = 0; i < g->unknowns; i++) D[i * ARROW_BLOCK + j] -= (moved[i] - base[i]) / h;
        for (int p = 0; p < HEAT_PLACES; p++) C[Y_COIL + p] -= g->n * (f1.heat[p] - f0.heat[p]) / h;
        C[Y_SUPPLIED] -= g->n * (f1.supplied - f0.supplied) / h;
        if (!circuit_supply_conducts(g)) continue;
        const double dI = j == 0 ? g->n : 0.0, dpush = g->n * (f1.push - f0.push) / h;
        for (int r = 0; r < J->border; r++) C[r] -= c->I[r] * dI + c->push[r] * dpush;
        if (g->kind->source) C[Y_SUPPLIED] -= dI * V;
    }
    J->b[k * ARROW_BLOCK] = circuit_supply_conducts(g) && !circuit_supply_algebraic(g, 0) ? f0.pull : 0.0;
}

/* The rails' memory enters linearly: its columns are known.  I: the segment's current.  A segment's own warming is
 * slow: only what it does to the resistances now is in the matrix, not how it changes. */
static void memory_jacobian(const shot_model *m, int segment, double cj, double I, const double *z, arrow *J)
{
    const circuit_ladder *l = &m->rails.ladder;
    const int n = J->border, V = circuit_shot_feed_unknown(segment), first = memory_unknown(m, segment);
    const int heat = first + 2 * l->n, end = first + circuit_rails_memory_size(&m->rails);
    const bool alive = segment < m->reached;
    const double warm = alive ? circuit_rails_warming(&m->rails, segment_length(m, segment, z), z + first) : 1.0;
    for (int j = heat; j < end; j++) J->E[j * n + j] = cj;
    for (int k = 0, Q = first; k < l->n; k++, Q += 2) {
        const int W = Q + 1;
        const double R = warm * l->R[k], frequency = R / l->L[k];
        J->E[Q * n + Q] = cj + (alive ? frequency : 0.0);
        J->E[W * n + W] = cj + (alive ? 2.0 * frequency : 0.0);
        if (!alive) continue;
        J->E[W * n + Q] = -2.0 * frequency * I;
        J->E[V * n + Q] = R;
        J->E[Y_RAILS * n + Q] = 2.0 * R * I;
        J->E[Y_RAILS * n + W] = -R;
        if (heat == end) continue;
        J->E[heat * n + Q] = 2.0 * R * I;
        J->E[heat * n + W] = -R;
        J->E[(heat + 1) * n + Q] = 2.0 * l->R[k] * I;
        J->E[(heat + 1) * n + W] = -l->R[k];
    }
}

/* Columns of the tail itself.  What is only summed up has none but the diagonal's. */
static void tail_jacobian(const shot_model *m, double cj, const shot_drive *d, const double *z, const double *base,
                          arrow *J)
{
    const int n = J->border;
    double at[TAIL_MAX], moved[TAIL_MAX], I = 0.0;
    memcpy(at, z, (size_t)n * sizeof *at);
    for (int j = 0; j < Y_SUMS; j++) J->E[j * n + j] = cj;
    for (int j = Y_SUMS; j < memory_unknown(m, 0); j++) {
        J->E[j * n + j] = tail_is_algebraic(m, j) ? 1.0 : cj;
        const double h = difference(z[j], m->scale[m->start + j]);
        at[j] = z[j] + h;
        tail_rates(m, d, at, moved);
        at[j] = z[j];
        for (int i = 0; i < n; i++) J->E[i * n + j] -= (moved[i] - base[i]) / h;
    }
    for (int f = 0; f < m->feeds; f++) memory_jacobian(m, f, cj, I += d->I[f], z, J);
}

void circuit_shot_jacobian(const void *model, double t, double cj, const double *y, arrow *J)
{
    const shot_model *m = model;
    const shot_drive d = circuit_shot_drive_at(m, t, y);
    const double *z = y + m->start;
    double base[TAIL_MAX];
    feed_columns c;
    tail_rates(m, &d, z, base);
    for (int f = 0; f < m->feeds; f++) {
        bool filled = false;
        for (int k = 0; k < m->n; k++) {
            if (m->groups[k].feed != f) continue;
            if (!filled) feed_columns_at(m, &d, f, z, base, &c);
            filled = true;
            J->column[k] = circuit_shot_feed_unknown(f);
            group_jacobian(m, k, t, cj, y, &c, J);
        }
    }
    tail_jacobian(m, cj, &d, z, base, J);
}

static void group_roots(const supply_group *g, double t, const double *y, double V, double *root)
{
    supply_flow f = { .push = 0.0 };
    root[0] = circuit_supply_stage_root(g, t, y);
    root[1] = 1.0;
    if (g->gate == GATE_WAITING) {
        g->kind->flow(g, t, y, &f);
        root[1] = f.push - f.pull * V;
    }
    if (circuit_supply_blocks(g)) root[1] = y[0];
}

void circuit_shot_roots(const void *model, double t, const double *y, double *g)
{
    const shot_model *m = model;
    const double *z = y + m->start;
    const bool moving = m->phase == CIRCUIT_SHOT_MOVING;
    g[ROOT_MOTION] = moving ? z[Y_V] : 1.0;
    g[ROOT_MELT] = 1.0;
    g[ROOT_SITE] = moving && isfinite(m->next_site) ? z[Y_X] - m->next_site : 1.0;
    g[ROOT_MUZZLE] = moving ? z[Y_X] - m->barrel.length : 1.0;
    g[ROOT_FEED] = moving && m->reached < m->feeds ? z[Y_X] - m->feed[m->reached] : 1.0;
    const bool melts = moving && m->armature.friction_law == CIRCUIT_SHOT_FRICTION_FILM && !m->melted;
    if (m->phase == CIRCUIT_SHOT_HELD || melts) {
        const shot_drive d = circuit_shot_drive_at(m, t, y);
        const shot_forces f = circuit_shot_forces_at(m, &d, z);
        if (melts) g[ROOT_MELT] = circuit_shot_melting(m, &f, z);
        if (m->phase == CIRCUIT_SHOT_HELD)
            g[ROOT_MOTION] = f.force - circuit_shot_hold_force(m, f.I - f.shunt) - RELEASE_MARGIN;
    }
    for (int k = 0; k < m->n; k++) {
        const supply_group *s = &m->groups[k];
        group_roots(s, t, y + s->first, z[circuit_shot_feed_unknown(s->feed)], g + ROOT_GROUPS + 2 * k);
    }
}
