/* SPDX-License-Identifier: BSD-3-Clause */
/* Switchings: gates and stages of the supplies, the armature's phases, feeds and sites on its way. */
#include "circuit/shot_internal.h"

#include <assert.h>
#include <math.h>

static void announce(circuit_shot *s, circuit_shot_event_kind kind, int index)
{
    assert(s->tail < s->capacity);
    s->queue[s->tail++] = (pending){ kind, index };
}

static void switched(circuit_shot *s, circuit_shot_event_kind kind, int index)
{
    s->switchings++;
    s->restart = true;
    announce(s, kind, index);
}

bool circuit_shot_any_current(const circuit_shot *s)
{
    for (int k = 0; k < s->model.n; k++) {
        if (circuit_supply_conducts(&s->model.groups[k])) return true;
    }
    return false;
}

static bool may_fire(const shot_model *m, const supply_group *g)
{
    return g->gate == GATE_UNFIRED && g->feed < m->reached && !isnan(g->at.fire_at);
}

double circuit_shot_next_firing(const circuit_shot *s)
{
    double t = INFINITY;
    for (int k = 0; k < s->model.n; k++) {
        const supply_group *g = &s->model.groups[k];
        if (may_fire(&s->model, g)) t = fmin(t, g->at.fire_at);
    }
    return t;
}

/* ---- supplies ---- */

static void group_block(circuit_shot *s, int k)
{
    supply_group *g = &s->model.groups[k];
    double *y = circuit_shot_y(s) + g->first, heat[HEAT_PLACES] = { 0.0 };
    y[0] = 0.0;
    const bool stays = g->kind->stays && g->kind->stays(g), again = stays || g->pulses-- > 0;
    if (!again && g->kind->ended) g->kind->ended(g, y, heat);
    for (int h = 0; h < HEAT_PLACES; h++) circuit_shot_z(s)[Y_COIL + h] += g->n * heat[h];
    g->gate = again ? GATE_WAITING : GATE_BLOCKED;
    switched(s, again ? CIRCUIT_SHOT_WAITING : CIRCUIT_SHOT_BLOCKED, k);
}

/* Groups that are due try to conduct together; whichever would carry a negative current then waits.  Taking one away
 * only raises the rails' voltage, so the loop ends after at most n rounds with the one solution. */
static void groups_try(circuit_shot *s, const bool *before)
{
    shot_model *m = &s->model;
    double *z = circuit_shot_z(s), rates[SUPPLY_UNKNOWNS];
    for (bool changed = true; changed;) {
        changed = false;
        const shot_drive d = circuit_shot_drive_now(s);
        circuit_shot_voltages(m, &d, z);
        for (int k = 0; k < m->n; k++) {
            supply_group *g = &m->groups[k];
            const bool fresh = g->gate == GATE_ON && !before[k];
            if (!fresh || s->forced[k] || g->reverses || g->kind->source) continue;
            supply_flow f;
            circuit_supply_rates(g, s->t, circuit_shot_y(s) + g->first, 0.0, rates, &f);
            if (f.push - f.pull * z[circuit_shot_feed_unknown(g->feed)] > 1e-9 * fabs(f.push)) continue;
            g->gate = GATE_WAITING;
            changed = true;
        }
    }
}

static void groups_fire(circuit_shot *s)
{
    shot_model *m = &s->model;
    bool *before = s->forced + m->n, *waiting = s->forced + 2 * m->n, some = false;
    for (int k = 0; k < m->n; k++) {
        supply_group *g = &m->groups[k];
        before[k] = g->gate == GATE_ON;
        waiting[k] = g->gate == GATE_WAITING;
        const bool due = may_fire(m, g) && g->at.fire_at <= s->t + SHOT_INSTANT;
        if (due || waiting[k]) g->gate = GATE_ON;
        some = some || due || waiting[k];
    }
    if (some) groups_try(s, before);
    for (int k = 0; k < m->n; k++) {
        const supply_gate now = m->groups[k].gate;
        if (now == GATE_ON && !before[k]) switched(s, CIRCUIT_SHOT_FIRED, k);
        if (now == GATE_WAITING && !waiting[k]) switched(s, CIRCUIT_SHOT_WAITING, k);
        s->forced[k] = false;
    }
}

/* Ends of stages and of currents that are due now, whether a root was reported for them or for a twin at the same
 * instant.  idle, NULL: not asked for, is set for those that came to their next stage without current. */
static void groups_settle(circuit_shot *s, const int *found, bool *idle)
{
    for (int k = 0; k < s->model.n; k++) {
        const int *root = found ? found + ROOT_GROUPS + 2 * k : NULL;
        supply_group *g = &s->model.groups[k];
        double *y = circuit_shot_y(s) + g->first;
        if (g->gate == GATE_WAITING && root && root[1]) s->forced[k] = true;
        const bool ends = y[0] <= 1e-12 * s->scale[g->first] && circuit_dae_yp(s->solver)[g->first] < 0.0;
        if (circuit_supply_blocks(g) && ((root && root[1]) || ends)) group_block(s, k);
        if (g->gate == GATE_BLOCKED || !g->kind->next) continue;
        const bool over = circuit_supply_stage_root(g, s->t, y) <= 1e-12;
        if (!(root && root[0]) && !over) continue;
        switched(s, g->kind->next(g, y), k);
        if (idle) idle[k] = y[0] <= 1e-12 * s->scale[g->first];
    }
}

/* What follows a firing at the same instant.  A group that comes to its next stage there without current, as the switch
 * of an empty coil does, conducts only if its current would be positive. */
static void groups_settle_fired(circuit_shot *s)
{
    const int n = s->model.n;
    bool *before = s->forced + n, *idle = s->forced + 2 * n, some = false;
    for (int k = 0; k < n; k++) idle[k] = false;
    groups_settle(s, NULL, idle);
    for (int k = 0; k < n; k++) {
        idle[k] = idle[k] && s->model.groups[k].gate == GATE_ON;
        before[k] = !idle[k];
        some = some || idle[k];
    }
    if (some) groups_try(s, before);
    for (int k = 0; k < n; k++)
        if (idle[k] && s->model.groups[k].gate == GATE_WAITING) switched(s, CIRCUIT_SHOT_WAITING, k);
}

/* ---- the armature ---- */

static void sites_pass(circuit_shot *s, bool root)
{
    shot_model *m = &s->model;
    const double x = circuit_shot_z(s)[Y_X];
    while (s->passed < s->n_sites &&
           (s->sites[s->passed].position <= x || (root && m->next_site == s->sites[s->passed].position)))
        announce(s, CIRCUIT_SHOT_SITE, s->sites[s->passed++].index);
    m->next_site = s->passed < s->n_sites ? s->sites[s->passed].position : INFINITY;
}

static void armature_leave(circuit_shot *s)
{
    double *z = circuit_shot_z(s);
    const shot_forces f = circuit_shot_forces_now(s);
    z[Y_X] = s->model.barrel.length;
    sites_pass(s, false); /* one at the very end */
    s->at_exit = circuit_shot_now(s);
    s->exit_kinetic = 0.5 * z[Y_MASS] * z[Y_V] * z[Y_V];
    s->exit_action = z[Y_ACTION];
    const double spent = s->start_energy + z[Y_SUPPLIED];
    s->result.muzzle_velocity = z[Y_V];
    s->result.muzzle_time = s->t;
    s->result.muzzle_energy = s->exit_kinetic;
    s->result.efficiency = spent > 0.0 ? s->exit_kinetic / spent : 0.0;
    s->result.exit_current = f.I;
    s->model.phase = CIRCUIT_SHOT_LEFT;
    switched(s, CIRCUIT_SHOT_MUZZLE, -1);
}

static void feeds_pass(circuit_shot *s, bool root)
{
    shot_model *m = &s->model;
    double *x = &circuit_shot_z(s)[Y_X];
    for (; m->reached < m->feeds && (root || m->feed[m->reached] <= *x); root = false) {
        *x = fmax(*x, m->feed[m->reached++]);
        s->restart = true;
    }
}

void circuit_shot_come_to_rest(circuit_shot *s)
{
    shot_model *m = &s->model;
    circuit_shot_z(s)[Y_V] = 0.0;
    s->restart = true;
    const shot_forces f = circuit_shot_forces_now(s);
    if (f.force > circuit_shot_hold_force(m, f.I - f.shunt)) return;
    m->melted = false;
    m->phase = CIRCUIT_SHOT_HELD;
    switched(s, CIRCUIT_SHOT_STOPPED, -1);
}

static void face_melts(circuit_shot *s, bool root)
{
    shot_model *m = &s->model;
    if (m->armature.friction_law != CIRCUIT_SHOT_FRICTION_FILM || m->melted) return;
    const shot_forces f = circuit_shot_forces_now(s);
    if (!root && circuit_shot_melting(m, &f, circuit_shot_z(s)) < 0.0) return;
    m->melted = true;
    if (isnan(s->limits.melt_position)) s->limits.melt_position = circuit_shot_z(s)[Y_X];
    switched(s, CIRCUIT_SHOT_MELTED, -1);
}

static void armature_settle(circuit_shot *s, const int *found)
{
    shot_model *m = &s->model;
    const double *z = circuit_shot_z(s), end = m->barrel.length * (1.0 - 1e-14);
    if (m->phase == CIRCUIT_SHOT_HELD && found && found[ROOT_MOTION]) {
        m->phase = CIRCUIT_SHOT_MOVING;
        s->worn_until = s->t;
        s->wear_rate = 0.0;
        switched(s, CIRCUIT_SHOT_RELEASED, -1);
    }
    if (m->phase != CIRCUIT_SHOT_MOVING) return;
    face_melts(s, found && found[ROOT_MELT]);
    sites_pass(s, found && found[ROOT_SITE]);
    feeds_pass(s, found && found[ROOT_FEED]);
    if ((found && found[ROOT_MUZZLE]) || z[Y_X] >= end) {
        armature_leave(s);
    } else if ((found && found[ROOT_MOTION]) || z[Y_V] < 0.0) {
        s->switchings++;
        circuit_shot_come_to_rest(s);
    }
}

void circuit_shot_settle(circuit_shot *s, const int *found)
{
    groups_settle(s, found, NULL);
    armature_settle(s, found);
    groups_fire(s);
    if (s->restart) groups_settle_fired(s);
}
