/* SPDX-License-Identifier: BSD-3-Clause */
/* Capacitor module (C voltage u, crowbar diode V_d + R_d i_D across it, coil L_p with damping R_p across it, cable
 * L_c):
 *   L di/dt = u - R i - V,  L = L_p + L_c,  C du/dt = -i
 *   crowbar conducting:  R_d C di_D/dt = i - i_D,  u = -V_d - R_d i_D   (R_d = 0: i_D = i, algebraic)
 *   damped:  L_c di/dt = u - R i - R_p (i - i_p) - V,  L_p di_p/dt = R_p (i - i_p)
 * y = i, u (i_D once the crowbar conducts), i_p where damped. */
#include "circuit/supply/supply_kind.h"

#include <math.h>

enum { CHARGED, CROWBARRED };

/* The diode goes on and off this far apart, in units of what voltage and current can reach: it must leave its knee to
 * come back to it.  Far above round-off, far below any tolerance. */
static const double KNEE = 4e-12;

/* The diode's current goes from 0 to the module's in R_d C, a microsecond, and moves the capacitor by its drop alone:
 * its scale is that of the capacitor's voltage over R_d, and no more than so many of the module's current. */
static const double LOOSE = 100.0;

#define MODULE(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_shot_module, member, unit, fallback, min, max, doc)
const base_param circuit_supply_capacitor_params[] = {
    PARAM_INT(circuit_shot_module, count, 1, 1, 1e6, "identical modules in this group"),
    MODULE(capacitance, "F", REQUIRED, 1e-12, 1e3, "capacitance of one module"),
    MODULE(charge, "V", REQUIRED, 0.0, 1e6, "charging voltage at t = 0"),
    MODULE(inductance, "H", REQUIRED, 0.0, 1.0, "inductance of the pulse-forming coil"),
    MODULE(resistance, "ohm", 0.0, 0.0, 1e3, "resistance of coil, capacitor and switch in series"),
    MODULE(cable_inductance, "H", 0.0, 0.0, 1.0, "inductance of the cable to the rails"),
    MODULE(cable_resistance, "ohm", 0.0, 0.0, 1e3, "resistance of the cable to the rails"),
    PARAM_BOOL(circuit_shot_module, crowbar, 1, "there is a crowbar diode across the capacitor"),
    MODULE(crowbar_drop, "V", 0.0, 0.0, 1e3, "forward drop of the crowbar diode"),
    MODULE(crowbar_resistance, "ohm", 0.0, 0.0, 1e3, "slope resistance of the crowbar diode"),
    PARAM_BOOL(circuit_shot_module, series_diode, 1, "thyristor or diode in series: the current cannot reverse"),
    MODULE(damping_resistance, "ohm", OPTIONAL, 1e-9, 1e9, "damping resistor across the coil; none if not given"),
    MODULE(fire_at, "s", 0.0, 0.0, INFINITY,
           "instant at which the thyristor is fired; beyond options.max_time = never"),
    SUPPLY_POSITION(circuit_shot_module),
    PARAMS_END
};

static bool damped(const circuit_shot_module *p)
{
    return !isnan(p->damping_resistance);
}

static status check(const void *params, const char *where)
{
    const circuit_shot_module *p = params;
    CHECK(p->inductance + p->cable_inductance > 0.0, STATUS_BAD_INPUT,
          "%s: inductance + cable_inductance = 0 H: must be positive", where);
    CHECK(!damped(p) || (p->inductance > 0.0 && p->cable_inductance > 0.0), STATUS_BAD_INPUT,
          "%s: damping_resistance = %g ohm across the coil needs inductance and cable_inductance above 0 H", where,
          p->damping_resistance);
    return status_ok();
}

static int unknowns(const void *p)
{
    return damped(p) ? 3 : 2;
}

static bool reverses(const void *p)
{
    return !((const circuit_shot_module *)p)->series_diode;
}

static double rise(const void *params)
{
    const circuit_shot_module *p = params;
    return 1.5707963267948966 * sqrt((p->inductance + p->cable_inductance) * p->capacitance);
}

static double current_scale(const circuit_shot_module *p)
{
    return fmax(p->charge * sqrt(p->capacitance / (p->inductance + p->cable_inductance)), 1.0);
}

static void start(const void *params, double *y, supply_scale *to)
{
    const circuit_shot_module *p = params;
    const double i = current_scale(p);
    y[1] = p->charge;
    *to = (supply_scale){ .y = { i, fmax(p->charge, 1.0), i, 0.0 },
                          .voltage = p->charge,
                          .energy = 0.5 * p->capacitance * p->charge * p->charge };
}

static double capacitor_voltage(const supply_group *g, const double *y)
{
    const circuit_shot_module *p = g->p;
    return g->stage == CROWBARRED ? -p->crowbar_drop - p->crowbar_resistance * y[1] : y[1];
}

static bool algebraic(const supply_group *g, int j)
{
    return j == 1 && g->gate == GATE_ON && g->stage == CROWBARRED &&
           ((const circuit_shot_module *)g->p)->crowbar_resistance == 0.0;
}

static double scale(const supply_group *g, int j)
{
    const circuit_shot_module *p = g->p;
    const double i = current_scale(p), u = fmax(p->charge, 1.0);
    if (j != 1) return i;
    return g->stage == CROWBARRED ? fmin(fmax(i, u / p->crowbar_resistance), LOOSE * i) : u;
}

static void flow(const supply_group *g, double t, const double *y, supply_flow *f)
{
    const circuit_shot_module *p = g->p;
    (void)t;
    const double i = y[0], u = capacitor_voltage(g, y), R = p->resistance + p->cable_resistance;
    const double over_coil = damped(p) ? p->damping_resistance * (i - y[2]) : 0.0;
    const double L = damped(p) ? p->cable_inductance : p->inductance + p->cable_inductance;
    f->push = (u - R * i - over_coil) / L;
    f->pull = 1.0 / L;
    if (g->gate != GATE_ON) return;
    f->heat[HEAT_COIL] = p->resistance * i * i;
    f->heat[HEAT_CABLE] = p->cable_resistance * i * i;
    if (damped(p)) {
        f->heat[HEAT_COIL] += over_coil * (i - y[2]);
        f->rate[2] = over_coil / p->inductance;
    }
    if (g->stage == CHARGED) {
        f->rate[1] = -i / p->capacitance;
    } else {
        const double tau = p->crowbar_resistance * p->capacitance;
        f->rate[1] = tau > 0.0 ? (i - y[1]) / tau : i;
        f->heat[HEAT_CROWBAR] = y[1] * (p->crowbar_drop + p->crowbar_resistance * y[1]);
    }
}

/* Charged until the diode's drop is reached; without a series diode the crowbar ends with its own current. */
static double root(const supply_group *g, double t, const double *y)
{
    const circuit_shot_module *p = g->p;
    (void)t;
    if (g->gate != GATE_ON || !p->crowbar) return 1.0;
    if (g->stage == CHARGED) return (y[1] + p->crowbar_drop) / fmax(p->charge, 1.0);
    return p->series_diode ? 1.0 : y[1] / current_scale(p) + KNEE;
}

static circuit_shot_event_kind next(supply_group *g, double *y)
{
    const circuit_shot_module *p = g->p;
    if (g->stage == CROWBARRED) {
        y[1] = -p->crowbar_drop + KNEE * fmax(p->charge, 1.0);
        g->stage = CHARGED;
        return CIRCUIT_SHOT_RECHARGED;
    }
    const double R_d = p->crowbar_resistance;
    y[1] = R_d > 0.0 ? fmin(fmax(-(y[1] + p->crowbar_drop) / R_d, 0.0), y[0]) : y[0];
    g->stage = CROWBARRED;
    return CIRCUIT_SHOT_CROWBAR;
}

/* The current left in the coil goes round through R_p, in L_p / R_p: all of it is heat at once here. */
static void ended(const supply_group *g, double *y, double *heat)
{
    const circuit_shot_module *p = g->p;
    if (!damped(p)) return;
    heat[HEAT_COIL] += 0.5 * p->inductance * y[2] * y[2];
    y[2] = 0.0;
}

static void stored(const supply_group *g, const double *y, double *e)
{
    const circuit_shot_module *p = g->p;
    const double u = capacitor_voltage(g, y), coil = damped(p) ? y[2] : y[0];
    e[STORE_CAPACITOR] += 0.5 * p->capacitance * u * u;
    e[STORE_COIL] += 0.5 * p->inductance * coil * coil;
    e[STORE_CABLE] += 0.5 * p->cable_inductance * y[0] * y[0];
}

const supply_kind circuit_kind_capacitor = {
    .name = "capacitor",
    .params = circuit_supply_capacitor_params,
    .size = sizeof(circuit_shot_module),
    .charge = offsetof(circuit_shot_module, charge),
    .check = check,
    .unknowns = unknowns,
    .reverses = reverses,
    .rise = rise,
    .start = start,
    .flow = flow,
    .algebraic = algebraic,
    .scale = scale,
    .root = root,
    .next = next,
    .ended = ended,
    .stored = stored,
    .voltage = capacitor_voltage,
};
