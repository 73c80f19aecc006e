/* SPDX-License-Identifier: BSD-3-Clause */
/* Homopolar generator (flux k, inertia J, speed w, windage b w):
 *   L di/dt = k w - R i - V,   J dw/dt = -k i - b w
 * Without windage it is a capacitor J/k^2 charged to k w_0.  y = i, w. */
#include "circuit/supply/supply_kind.h"

#include <math.h>

#define MACHINE(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_supply_homopolar, member, unit, fallback, min, max, doc)
const base_param circuit_supply_homopolar_params[] = {
    PARAM_INT(circuit_supply_homopolar, count, 1, 1, 1e6, "identical machines in this group"),
    MACHINE(flux, "V s/rad", REQUIRED, 1e-6, 1e4, "voltage over speed, torque over current"),
    MACHINE(inertia, "kg m^2", REQUIRED, 1e-6, 1e7, "moment of inertia of the rotor"),
    MACHINE(speed, "rad/s", REQUIRED, 0.0, 1e5, "speed of the rotor at t = 0"),
    MACHINE(windage, "N m s/rad", 0.0, 0.0, 1e6, "braking torque of brushes and gas over speed"),
    MACHINE(inductance, "H", REQUIRED, 1e-12, 1.0, "inductance of machine and leads"),
    MACHINE(resistance, "ohm", 0.0, 0.0, 1e3, "resistance of machine and leads"),
    MACHINE(fire_at, "s", 0.0, 0.0, INFINITY, "instant at which it is switched on; beyond options.max_time = never"),
    SUPPLY_POSITION(circuit_supply_homopolar),
    PARAMS_END
};

static int unknowns(const void *p)
{
    (void)p;
    return 2;
}

static double rise(const void *params)
{
    const circuit_supply_homopolar *p = params;
    return 1.5707963267948966 * sqrt(p->inductance * p->inertia) / p->flux;
}

static void start(const void *params, double *y, supply_scale *scale)
{
    const circuit_supply_homopolar *p = params;
    y[1] = p->speed;
    *scale = (supply_scale){ .y = { fmax(p->speed * sqrt(p->inertia / p->inductance), 1.0), fmax(p->speed, 1.0) },
                             .voltage = p->flux * p->speed,
                             .energy = 0.5 * p->inertia * p->speed * p->speed };
}

static double voltage(const supply_group *g, const double *y)
{
    return ((const circuit_supply_homopolar *)g->p)->flux * y[1];
}

static void flow(const supply_group *g, double t, const double *y, supply_flow *f)
{
    const circuit_supply_homopolar *p = g->p;
    (void)t;
    const double i = y[0], w = y[1];
    f->push = (p->flux * w - p->resistance * i) / p->inductance;
    f->pull = 1.0 / p->inductance;
    f->rate[1] = -(p->flux * i + p->windage * w) / p->inertia;
    f->heat[HEAT_COIL] = p->resistance * i * i;
    f->heat[HEAT_MACHINE] = p->windage * w * w;
}

static void stored(const supply_group *g, const double *y, double *e)
{
    const circuit_supply_homopolar *p = g->p;
    e[STORE_COIL] += 0.5 * p->inductance * y[0] * y[0];
    e[STORE_ROTOR] += 0.5 * p->inertia * y[1] * y[1];
}

const supply_kind circuit_kind_homopolar = {
    .name = "homopolar",
    .params = circuit_supply_homopolar_params,
    .size = sizeof(circuit_supply_homopolar),
    .charge = offsetof(circuit_supply_homopolar, speed),
    .unknowns = unknowns,
    .rise = rise,
    .start = start,
    .flow = flow,
    .stored = stored,
    .voltage = voltage,
};
