/* SPDX-License-Identifier: BSD-3-Clause */
/* One phase of a pulse alternator at constant excitation (flux k, p pole pairs, inertia J, speed w, angle a, windage b
 * w):
 *   e = k sin(p a + phase),   L di/dt = e w - R i - V,   J dw/dt = -e i - b w,   da/dt = w
 * y = i, w, a. */
#include "circuit/supply/supply_kind.h"

#include <math.h>

#define MACHINE(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_supply_alternator, member, unit, fallback, min, max, doc)
const base_param circuit_supply_alternator_params[] = {
    PARAM_INT(circuit_supply_alternator, count, 1, 1, 1e6, "identical machines in this group, in step"),
    MACHINE(flux, "V s/rad", REQUIRED, 1e-6, 1e4, "peak voltage over speed, peak torque over current"),
    PARAM_INT(circuit_supply_alternator, pole_pairs, 1, 1, 100, "pole pairs"),
    MACHINE(phase, "rad", 0.0, -1e3, 1e3, "electrical angle of its voltage at t = 0"),
    PARAM_INT(circuit_supply_alternator, pulses, 1, 1, 1000, "half waves it is let through for"),
    MACHINE(inertia, "kg m^2", REQUIRED, 1e-6, 1e7, "moment of inertia of the rotor"),
    MACHINE(speed, "rad/s", REQUIRED, 0.0, 1e5, "speed of the rotor at t = 0"),
    MACHINE(windage, "N m s/rad", 0.0, 0.0, 1e6, "braking torque of bearings and gas over speed"),
    MACHINE(inductance, "H", REQUIRED, 1e-12, 1.0, "inductance of the compensated winding and leads"),
    MACHINE(resistance, "ohm", 0.0, 0.0, 1e3, "resistance of winding and leads"),
    MACHINE(fire_at, "s", 0.0, 0.0, INFINITY, "instant from which it is let through; beyond options.max_time = never"),
    SUPPLY_POSITION(circuit_supply_alternator),
    PARAMS_END
};

static int unknowns(const void *p)
{
    (void)p;
    return 3;
}

static int pulses(const void *p)
{
    return ((const circuit_supply_alternator *)p)->pulses;
}

static double rise(const void *params)
{
    const circuit_supply_alternator *p = params;
    return 1.5707963267948966 / (p->pole_pairs * fmax(p->speed, 1.0));
}

static void start(const void *params, double *y, supply_scale *scale)
{
    const circuit_supply_alternator *p = params;
    y[1] = p->speed;
    *scale = (supply_scale){ .y = { fmax(p->flux / (p->pole_pairs * p->inductance), 1.0), fmax(p->speed, 1.0), 1.0 },
                             .voltage = p->flux * p->speed,
                             .energy = 0.5 * p->inertia * p->speed * p->speed };
}

static double flux_at(const circuit_supply_alternator *p, double angle)
{
    return p->flux * sin(p->pole_pairs * angle + p->phase);
}

static double voltage(const supply_group *g, const double *y)
{
    return flux_at(g->p, y[2]) * y[1];
}

static void flow(const supply_group *g, double t, const double *y, supply_flow *f)
{
    const circuit_supply_alternator *p = g->p;
    (void)t;
    const double e = flux_at(p, y[2]), i = y[0], w = y[1];
    f->push = (e * w - p->resistance * i) / p->inductance;
    f->pull = 1.0 / p->inductance;
    f->rate[1] = -(e * i + p->windage * w) / p->inertia;
    f->rate[2] = w;
    f->heat[HEAT_COIL] = p->resistance * i * i;
    f->heat[HEAT_MACHINE] = p->windage * w * w;
}

static void stored(const supply_group *g, const double *y, double *e)
{
    const circuit_supply_alternator *p = g->p;
    e[STORE_COIL] += 0.5 * p->inductance * y[0] * y[0];
    e[STORE_ROTOR] += 0.5 * p->inertia * y[1] * y[1];
}

const supply_kind circuit_kind_alternator = {
    .name = "alternator",
    .params = circuit_supply_alternator_params,
    .size = sizeof(circuit_supply_alternator),
    .charge = offsetof(circuit_supply_alternator, speed),
    .unknowns = unknowns,
    .pulses = pulses,
    .rise = rise,
    .start = start,
    .flow = flow,
    .stored = stored,
    .voltage = voltage,
};
