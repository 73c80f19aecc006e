/* SPDX-License-Identifier: BSD-3-Clause */
/* Inductive store (L_s, current i_s, battery V_b, R_s in all) with opening switch, cable (L_c, R_c) to the rails:
 *   switch closed, before firing:     L_s di_s/dt = V_b - R_s i_s
 *   opening, its arc holds U:         L_s di_s/dt = V_b - U - R_s i_s,   L_c di/dt = U - R_c i - V
 *   open, from i = i_s on:            (L_s + L_c) di/dt = V_b - (R_s + R_c) i - V
 * y = i, i_s.  The switch's heat U (i_s - i) is the price of commutation, at least 1/2 L_c i^2. */
#include "circuit/supply/supply_kind.h"

#include <math.h>

enum { SWITCH_CLOSED, SWITCH_OPEN };

#define STORE(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_supply_inductor, member, unit, fallback, min, max, doc)
const base_param circuit_supply_inductor_params[] = {
    PARAM_INT(circuit_supply_inductor, count, 1, 1, 1e6, "identical stores in this group"),
    STORE(inductance, "H", REQUIRED, 1e-9, 10.0, "inductance of the store"),
    STORE(resistance, "ohm", 0.0, 0.0, 1e3, "resistance of store, battery and leads in series"),
    STORE(current, "A", 0.0, 0.0, 1e8, "current in the store at t = 0"),
    STORE(battery_voltage, "V", 0.0, 0.0, 1e5, "voltage of the battery that charges it, in series throughout"),
    STORE(opening_voltage, "V", REQUIRED, 1.0, 1e6,
          "voltage across the opening switch until the current has gone over"),
    STORE(cable_inductance, "H", REQUIRED, 1e-12, 1.0, "inductance of the cable to the rails"),
    STORE(cable_resistance, "ohm", 0.0, 0.0, 1e3, "resistance of the cable to the rails"),
    STORE(fire_at, "s", 0.0, 0.0, INFINITY, "instant at which the switch opens; beyond options.max_time = never"),
    SUPPLY_POSITION(circuit_supply_inductor),
    PARAMS_END
};

static int unknowns(const void *p)
{
    (void)p;
    return 2;
}

/* Current in the store at time t with the switch closed. */
static double charged_current(const circuit_supply_inductor *p, double t)
{
    if (p->resistance == 0.0) return p->current + p->battery_voltage / p->inductance * t;
    const double full = p->battery_voltage / p->resistance;
    return full + (p->current - full) * exp(-t * p->resistance / p->inductance);
}

static double rise(const void *params)
{
    const circuit_supply_inductor *p = params;
    return charged_current(p, p->fire_at) * p->cable_inductance / p->opening_voltage;
}

static void start(const void *params, double *y, supply_scale *scale)
{
    const circuit_supply_inductor *p = params;
    const double i = fmax(isfinite(p->fire_at) ? charged_current(p, p->fire_at) : p->current, 1.0);
    y[1] = p->current;
    *scale = (supply_scale){ .y = { i, i }, .voltage = p->opening_voltage, .energy = 0.5 * p->inductance * i * i };
}

static bool algebraic(const supply_group *g, int j)
{
    return j == 1 && g->gate == GATE_ON && g->stage == SWITCH_OPEN;
}

static void flow(const supply_group *g, double t, const double *y, supply_flow *f)
{
    const circuit_supply_inductor *p = g->p;
    (void)t;
    const bool open = g->stage == SWITCH_OPEN, opening = !open && g->gate != GATE_UNFIRED;
    const double U = opening ? p->opening_voltage : 0.0, i = y[0], i_s = open ? i : y[1];
    const double L = p->cable_inductance + (open ? p->inductance : 0.0);
    f->push = ((open ? p->battery_voltage - p->resistance * i : U) - p->cable_resistance * i) / L;
    f->pull = 1.0 / L;
    f->rate[1] = open ? i : (p->battery_voltage - U - p->resistance * i_s) / p->inductance;
    f->heat[HEAT_COIL] = p->resistance * i_s * i_s;
    f->heat[HEAT_CABLE] = p->cable_resistance * i * i;
    f->heat[HEAT_SWITCH] = U * (i_s - i);
    f->supplied = p->battery_voltage * i_s;
}

static double root(const supply_group *g, double t, const double *y)
{
    const circuit_supply_inductor *p = g->p;
    (void)t;
    if (g->gate == GATE_UNFIRED || g->stage == SWITCH_OPEN) return 1.0;
    return (y[1] - y[0]) / fmax(charged_current(p, p->fire_at), 1.0);
}

static circuit_shot_event_kind next(supply_group *g, double *y)
{
    y[1] = y[0];
    g->stage = SWITCH_OPEN;
    return CIRCUIT_SHOT_COMMUTATED;
}

static void stored(const supply_group *g, const double *y, double *e)
{
    const circuit_supply_inductor *p = g->p;
    e[STORE_COIL] += 0.5 * p->inductance * y[1] * y[1];
    e[STORE_CABLE] += 0.5 * p->cable_inductance * y[0] * y[0];
}

/* Driven back to zero by the rails while the switch still opens: its arc goes on, fed by the store. */
static bool stays(const supply_group *g)
{
    return g->stage == SWITCH_CLOSED;
}

static double voltage(const supply_group *g, const double *y)
{
    (void)y;
    const circuit_supply_inductor *p = g->p;
    const bool opening = g->stage == SWITCH_CLOSED && (g->gate == GATE_ON || g->gate == GATE_WAITING);
    return opening ? p->opening_voltage : 0.0;
}

const supply_kind circuit_kind_inductor = {
    .name = "inductor",
    .params = circuit_supply_inductor_params,
    .size = sizeof(circuit_supply_inductor),
    .charge = offsetof(circuit_supply_inductor, current),
    .battery = offsetof(circuit_supply_inductor, battery_voltage),
    .unknowns = unknowns,
    .stays = stays,
    .rise = rise,
    .start = start,
    .flow = flow,
    .algebraic = algebraic,
    .root = root,
    .next = next,
    .stored = stored,
    .voltage = voltage,
};
