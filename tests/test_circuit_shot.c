/* SPDX-License-Identifier: BSD-3-Clause */
/* The shot: closed forms, a measured-like pulse, an independent integration, and everything a bank can be asked to do.
 */
#include "base/constants.h"
#include "circuit/shot.h"
#include "tests/circuit_common.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "full_common.h"
#include "near_common.h"
#include "random_common.h"
#include "status_common.h"

enum { MAX_EVENTS = 4096 };

typedef struct {
    circuit_shot_event events[MAX_EVENTS];
    int n, samples;
    int count[CIRCUIT_SHOT_EVENT_COUNT];
    double worst_energy;
    int stop_at;               /* stop when this many events have come; 0 = never */
    double impulse, mass_loss; /* handed back at every site */
} record;

static record rec; /* the tests' own notebook */

static bool on_event(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    record *r = user;
    assert_true(r->n < MAX_EVENTS);
    r->events[r->n++] = *e;
    r->count[e->kind]++;
    if (e->kind == CIRCUIT_SHOT_SITE && r->impulse > 0.0) OK(circuit_shot_jump(s, r->impulse, r->mass_loss));
    return r->n != r->stop_at;
}

static bool on_sample(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    record *r = user;
    (void)s;
    r->samples++;
    r->worst_energy = fmax(r->worst_energy, fabs(state->ledger.energy_error));
    return true;
}

static circuit_shot_sink notebook(void)
{
    memset(&rec, 0, sizeof rec);
    return (circuit_shot_sink){ on_event, on_sample, &rec };
}

/* 25 x 20 x 25 mm rails at level constant, a 0.25 kg armature, 5 m. */
static circuit_shot_config plain(const circuit_shot_module *modules, int n)
{
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ n, modules };
    return c;
}

/* Rails of no length and an armature that nothing moves: a short circuit. */
static circuit_shot_config shorted(const circuit_shot_module *modules, int n)
{
    circuit_shot_config c = plain(modules, n);
    c.barrel.start = 0.0;
    c.armature.preload = 1e9;
    c.armature.resistance = 0.0;
    c.armature.contact_voltage = 0.0;
    return c;
}

/* Runs to the end and checks the laws that hold for every shot. */
static circuit_shot *run(const circuit_shot_config *c)
{
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notebook();
    OK(circuit_shot_create(c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    assert_true(rec.worst_energy < 1e-6); /* README's bound at the default tolerances */
    assert_true(rec.n <= 4 * c->supplies[CIRCUIT_SUPPLY_capacitor].n + c->n_sites + 16); /* no chatter */
    for (int k = 1; k < rec.n; k++) assert_true(rec.events[k].state.t >= rec.events[k - 1].state.t);
    return s;
}

/* ---- closed forms ---- */

/* u = V0 e^(-at) (cos wt + a/w sin wt), i = V0/(wL) e^(-at) sin wt until u = -V_d; then, R_d = 0, L i' = -R i - V_d. */
typedef struct {
    double V0, L, R, C, drop, a, w, crowbar, i_crowbar;
} rlc;

static rlc rlc_of(const circuit_shot_module *p, double L_load, double R_load)
{
    rlc c = { .V0 = p->charge, .L = p->inductance + L_load, .R = p->resistance + R_load, .C = p->capacitance };
    c.drop = p->crowbar_drop;
    c.a = 0.5 * c.R / c.L;
    c.w = sqrt(1.0 / (c.L * c.C) - c.a * c.a);
    double lo = 0.0, hi = PI / c.w;
    for (int k = 0; k < 200; k++) {
        const double t = 0.5 * (lo + hi), u = c.V0 * exp(-c.a * t) * (cos(c.w * t) + c.a / c.w * sin(c.w * t));
        if (u > -c.drop) {
            lo = t;
        } else {
            hi = t;
        }
    }
    c.crowbar = 0.5 * (lo + hi);
    c.i_crowbar = c.V0 / (c.w * c.L) * exp(-c.a * c.crowbar) * sin(c.w * c.crowbar);
    return c;
}

static double rlc_current(const rlc *c, double t)
{
    if (t <= c->crowbar) return c->V0 / (c->w * c->L) * exp(-c->a * t) * sin(c->w * t);
    return (c->i_crowbar + c->drop / c->R) * exp(-(t - c->crowbar) * c->R / c->L) - c->drop / c->R;
}

/* 1e-8 of the peak is wanted; at rtol 1e-11 the integration's own error is below it (docs/validation/circuit.md). */
static void closed_form(double drop)
{
    circuit_shot_module m = unit_200kJ(1, 0.0);
    m.crowbar_drop = drop;
    m.crowbar_resistance = 0.0;
    circuit_shot_config c = shorted(&m, 1);
    c.barrel.start = 2.0; /* the rails' 1 uH and 0.2 mohm and the armature's 0.3 mohm belong to the loop */
    c.armature.resistance = 3e-4;
    c.options.rtol = 1e-11;
    c.options.atol = 1e-13;
    const rlc exact = rlc_of(&m, 1e-6, 5e-4);
    const double peak = rlc_current(&exact, atan(exact.w / exact.a) / exact.w);
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notebook();
    OK(circuit_shot_create(&c, &s));
    double worst = 0.0;
    for (int k = 1; k <= 200; k++) {
        const double t = k * 2e-5;
        OK(circuit_shot_advance(s, t, &sink));
        worst = fmax(worst, fabs(circuit_shot_now(s).current - rlc_current(&exact, t)) / peak);
    }
    print_message("worst current error %.2e of peak, peak %.2e\n", worst,
                  circuit_shot_result(s).peak_current / peak - 1.0);
    assert_true(worst < 1e-8);
    assert_near(circuit_shot_result(s).peak_current, peak, 1e-8 * peak);
    assert_int_equal(rec.count[CIRCUIT_SHOT_CROWBAR], 1);
    assert_near(rec.events[1].state.t, exact.crowbar, 1e-11); /* right to 1e-12 s at rtol 1e-8 for one loop */
    if (drop > 0.0) {                                         /* zero current at t_c + L/R ln(1 + R i_c/V_d) */
        const double end = exact.crowbar + exact.L / exact.R * log1p(exact.R * exact.i_crowbar / drop);
        OK(circuit_shot_advance(s, INFINITY, &sink));
        assert_true(circuit_shot_done(s));
        assert_int_equal(rec.count[CIRCUIT_SHOT_BLOCKED], 1);
        assert_near(rec.events[rec.n - 1].state.t, end, 1e-8 * end);
    }
    circuit_shot_free(s);
}

static void rlc_with_ideal_crowbar(void **state)
{
    (void)state;
    closed_form(0.0);
    closed_form(25.0);
}

/* ---- the published pulse ---- */

/* 0.6 % of peak everywhere: the figure; the fitted values' own distance is 0.55 %. */
static void published_pulse(void **state)
{
    (void)state;
    const circuit_shot_module m = unit_200kJ(1, 0.0);
    const circuit_shot_config c = shorted(&m, 1);
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    int rows;
    const double misfit = pulse_misfit(s, BREECH_TESTS "/../cases/pulse_unit_200kJ/pulse_unit_200kJ.csv", &rows);
    print_message("worst difference %.3f %% of peak over %d rows\n", 100.0 * misfit, rows);
    assert_int_equal(rows, 54);
    assert_true(misfit < 0.006);
    circuit_shot_free(s);
}

/* ---- an integration of its own ---- */

/* y = u, i, x, v, m: one module, held by nothing, all of (C-1), (C-3), (C-4), (C-5), written from PHYSICS and not from
 * the code; classical Runge-Kutta. */
static void slope(const circuit_shot_config *c, bool crowbar, const double *y, double *d)
{
    const circuit_shot_module *p = c->supplies[CIRCUIT_SUPPLY_capacitor].item;
    const circuit_shot_armature *a = &c->armature;
    const double Lr = c->rails.inductance_gradient, i = y[1], I = p->count * i, x = y[2], v = y[3];
    const double u = crowbar ? -p->crowbar_drop : y[0];
    const double L = p->inductance + p->cable_inductance, R = p->resistance + p->cable_resistance;
    const double rails = (c->rails.resistance_gradient * x + Lr * v + a->resistance) * I + a->contact_voltage;
    const double N = a->preload + a->spreading * I * I;
    const double mu = a->friction_melted + (a->friction_dry - a->friction_melted) * exp(-v / a->friction_speed);
    const double q = 0.25 * (a->gas_gamma + 1.0) * v;
    const double p_gas = a->gas_density * v * (q + sqrt(q * q + a->gas_gamma * a->gas_pressure / a->gas_density));
    d[0] = crowbar ? 0.0 : -i / p->capacitance;
    d[1] = (u - R * i - rails) / (L + p->count * Lr * x);
    d[2] = v;
    d[3] = (0.5 * Lr * I * I - 2.0 * mu * N - p_gas * c->rails.height * c->rails.separation) / y[4];
    d[4] = -a->wear_fraction * (2.0 * mu * N * v + a->contact_voltage * I) /
           (a->specific_heat * (a->melting_temperature - a->initial_temperature) + a->latent_heat);
}

static void runge_kutta(const circuit_shot_config *c, bool crowbar, double h, double *y)
{
    double k[4][5], z[5];
    static const double at[4] = { 0.0, 0.5, 0.5, 1.0 };
    for (int stage = 0; stage < 4; stage++) {
        for (int j = 0; j < 5; j++) z[j] = y[j] + (stage ? at[stage] * h * k[stage - 1][j] : 0.0);
        slope(c, crowbar, z, k[stage]);
    }
    for (int j = 0; j < 5; j++) y[j] += h / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
}

/* Halves the step until `done` of the state is met to 1e-15 s; returns the time. */
static double integrate(const circuit_shot_config *c, bool crowbar, double t, double *y)
{
    double h = 2e-7;
    while (h > 1e-16) {
        double z[5];
        memcpy(z, y, sizeof z);
        runge_kutta(c, crowbar, h, z);
        const bool over =
            z[2] > c->barrel.length ||
            (!crowbar &&
             z[0] < -((const circuit_shot_module *)c->supplies[CIRCUIT_SUPPLY_capacitor].item)->crowbar_drop);
        if (over) {
            h *= 0.5;
        } else {
            memcpy(y, z, sizeof z);
            t += h;
        }
    }
    return t;
}

/* The Runge-Kutta error at 0.2 us is below 1e-10 (halving the step moves it less); rtol 1e-10 leaves some 1e-9. */
static void independent_integration(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    m.cable_inductance = 1e-6;
    m.cable_resistance = 1e-3;
    m.crowbar_resistance = 0.0;
    circuit_shot_config c = plain(&m, 1);
    c.armature.velocity = 10.0; /* moving from the start: no release to model twice */
    c.armature.wear_fraction = 0.3;
    c.barrel.length = 2.0;
    c.options.rtol = 1e-10;
    c.options.atol = 1e-12;
    double y[5] = { m.charge, 0.0, c.barrel.start, 10.0, c.armature.mass };
    const double crowbar = integrate(&c, false, 0.0, y), t = integrate(&c, true, crowbar, y);
    assert_near(y[2], c.barrel.length, 1e-9);
    circuit_shot *s = run(&c);
    const circuit_shot_summary r = circuit_shot_result(s);
    print_message("muzzle velocity %.6f m/s, differs by %.1e; time by %.1e; wear %.3f g\n", r.muzzle_velocity,
                  r.muzzle_velocity / y[3] - 1.0, r.muzzle_time / t - 1.0,
                  1e3 * (c.armature.mass - circuit_shot_now(s).mass));
    assert_near(r.muzzle_velocity, y[3], 1e-8 * y[3]);
    assert_near(r.muzzle_time, t, 1e-8 * t);
    assert_near(r.exit_current, m.count * y[1], 1e-8 * r.peak_current);
    assert_near(circuit_shot_now(s).mass, y[4], 1e-8 * y[4]);
    assert_true(c.armature.mass - y[4] > 1e-4); /* the wear is there to be compared */
    circuit_shot_free(s);
}

/* 13 groups, 15 units: the bank of the default shot. */
static int default_bank(circuit_shot_module *modules)
{
    for (int k = 0; k < 13; k++) {
        modules[k] = unit_200kJ(k ? 1 : 3, k * 2.2e-4);
        modules[k].cable_inductance = 1e-6;
        modules[k].cable_resistance = 1e-3;
    }
    return 13;
}

static double muzzle_velocity_at(double rtol)
{
    circuit_shot_module modules[13];
    circuit_shot_config c = plain(modules, default_bank(modules));
    c.options.rtol = rtol;
    c.options.atol = 0.01 * rtol;
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, INFINITY, NULL));
    const double v = circuit_shot_result(s).muzzle_velocity;
    circuit_shot_free(s);
    return v;
}

/* A variable-order method promises errors proportional to rtol: within 100 rtol here (39 switchings add up), and each
 * hundredth of rtol gains at least a factor 10. */
static void tolerance_converges(void **state)
{
    (void)state;
    const double exact = muzzle_velocity_at(1e-12);
    double error[7];
    for (int k = 0; k < 7; k++) {
        const double rtol = pow(10.0, -4 - k);
        error[k] = fabs(muzzle_velocity_at(rtol) / exact - 1.0);
        print_message("rtol %.0e: %.1e\n", rtol, error[k]);
        assert_true(error[k] < 100.0 * rtol);
    }
    for (int k = 0; k + 2 < 7; k++) assert_true(error[k + 2] < fmax(0.1 * error[k], 100.0 * 1e-12));
}

/* ---- banks of all kinds ---- */

static void many_at_once(void **state)
{
    (void)state;
    circuit_shot_module together = unit_200kJ(48, 1e-4), apart[48];
    together.charge = 4e3;
    for (int k = 0; k < 48; k++) {
        apart[k] = together;
        apart[k].count = 1;
        apart[k].charge *= 1.0 + (k % 7) * 2.3e-16 * (k < 24 ? 1 : 40); /* twins but for round-off */
    }
    circuit_shot_config c = plain(&together, 1);
    circuit_shot *one = run(&c);
    c = plain(apart, 48);
    circuit_shot *all = run(&c);
    assert_int_equal(rec.count[CIRCUIT_SHOT_FIRED], 48);
    assert_int_equal(rec.count[CIRCUIT_SHOT_CROWBAR], 48);
    assert_int_equal(rec.count[CIRCUIT_SHOT_BLOCKED], 48);
    assert_int_equal(rec.count[CIRCUIT_SHOT_WAITING], 0);
    assert_int_equal(rec.count[CIRCUIT_SHOT_MUZZLE], 1);
    /* the same circuit, integrated with other error norms: both within 100 rtol of the truth (see above) */
    const double v = circuit_shot_result(one).muzzle_velocity;
    assert_near(circuit_shot_result(all).muzzle_velocity, v, 2e-6 * v);
    circuit_shot_free(one);
    circuit_shot_free(all);
}

static void modules_that_never_fire(void **state)
{
    (void)state;
    circuit_shot_module modules[3] = { unit_200kJ(4, 0.0), unit_200kJ(2, NAN), unit_200kJ(3, INFINITY) };
    modules[0].fire_at = 1e3;
    circuit_shot_config c = plain(modules, 3);
    circuit_shot *s = run(&c);
    assert_true(circuit_shot_done(s));
    assert_int_equal(rec.n, 0);
    assert_true(circuit_shot_now(s).v == 0.0 && circuit_shot_result(s).peak_current == 0.0);
    circuit_shot_free(s);

    modules[0].fire_at = 0.0; /* beside one that does, they keep their charge */
    c = plain(modules, 3);
    s = run(&c);
    assert_int_equal(rec.count[CIRCUIT_SHOT_FIRED], 1);
    assert_int_equal(rec.count[CIRCUIT_SHOT_MUZZLE], 1);
    assert_true(circuit_shot_module_voltage(s, 1) == modules[1].charge && circuit_shot_module_current(s, 2) == 0.0);
    circuit_shot_free(s);
}

static void zero_charge(void **state)
{
    (void)state;
    circuit_shot_module modules[2] = { unit_200kJ(4, 1e-4), unit_200kJ(4, 1e-4) };
    modules[0].charge = 0.0;
    circuit_shot_config c = plain(modules, 1);
    circuit_shot *s = run(&c);
    assert_true(circuit_shot_done(s) && circuit_shot_now(s).v == 0.0 && circuit_shot_result(s).energy_error == 0.0);
    assert_int_equal(rec.count[CIRCUIT_SHOT_FIRED], 0);
    circuit_shot_free(s);
    c = plain(modules, 1); /* nothing that would hold the armature: still no motion, and an end */
    c.armature.preload = 0.0;
    s = run(&c);
    assert_true(circuit_shot_done(s) && circuit_shot_now(s).v == 0.0);
    circuit_shot_free(s);
    c = plain(modules, 2); /* beside a charged group it waits for a breech voltage below zero, which never comes */
    s = run(&c);
    assert_int_equal(rec.count[CIRCUIT_SHOT_WAITING], 1);
    assert_int_equal(rec.count[CIRCUIT_SHOT_FIRED], 1);
    assert_int_equal(rec.count[CIRCUIT_SHOT_MUZZLE], 1);
    circuit_shot_free(s);
}

/* Fired into a breech above its own voltage, a weak group waits, and conducts when the breech has fallen to it. */
static void weak_group_waits(void **state)
{
    (void)state;
    circuit_shot_module modules[2] = { unit_200kJ(10, 0.0), unit_200kJ(1, 6e-4) };
    modules[1].charge = 500.0;
    const circuit_shot_config c = plain(modules, 2);
    circuit_shot *s = run(&c);
    const circuit_shot_event *waits = NULL, *fires = NULL;
    for (int k = 0; k < rec.n; k++) {
        if (rec.events[k].index != 1) continue;
        if (rec.events[k].kind == CIRCUIT_SHOT_WAITING) waits = &rec.events[k];
        if (rec.events[k].kind == CIRCUIT_SHOT_FIRED) fires = &rec.events[k];
    }
    assert_non_null(waits);
    assert_non_null(fires);
    assert_near(waits->state.t, 6e-4, 1e-12);
    assert_true(waits->state.breech_voltage > 500.0 && fires->state.t > waits->state.t);
    circuit_shot_free(s);
}

static void stuck_armature(void **state)
{
    (void)state;
    const circuit_shot_module m = unit_200kJ(10, 0.0);
    circuit_shot_config c = plain(&m, 1);
    c.armature.preload = 1e7;
    c.armature.leg_area = 1e-4;
    circuit_shot *s = run(&c);
    assert_true(circuit_shot_done(s));
    assert_true(circuit_shot_limits_of(s).leg_action > 1.0); /* at rest the current melts it all the same */
    assert_true(circuit_shot_limits_of(s).transition_position == c.barrel.start);
    assert_true(isnan(circuit_shot_limits_of(s).contact_ratio) && isnan(circuit_shot_limits_of(s).wear_share));
    assert_true(circuit_shot_now(s).x == c.barrel.start && circuit_shot_now(s).phase == CIRCUIT_SHOT_HELD);
    assert_true(isnan(circuit_shot_result(s).muzzle_velocity) && circuit_shot_result(s).peak_current > 1e6);
    assert_int_equal(rec.count[CIRCUIT_SHOT_RELEASED] + rec.count[CIRCUIT_SHOT_MUZZLE], 0);
    circuit_shot_free(s);
    c = plain(&m, 1); /* spreading alone can hold it at any current: 2 mu k > L'/2 */
    c.armature.preload = 0.0;
    c.armature.spreading = 1e-6;
    s = run(&c);
    assert_true(circuit_shot_done(s) && circuit_shot_now(s).phase == CIRCUIT_SHOT_HELD);
    circuit_shot_free(s);
}

/* Friction that the force exceeds only around the peak: released once, stopped once, at the right instants. */
static void armature_that_stops_again(void **state)
{
    (void)state;
    const circuit_shot_module m = unit_200kJ(10, 0.0);
    circuit_shot_config c = plain(&m, 1);
    c.armature.friction_dry = 0.5;
    c.armature.friction_melted = 0.5;
    c.armature.spreading = 0.0;
    c.armature.preload = 3e5;
    c.armature.mass = 5.0;
    circuit_shot *s = run(&c);
    assert_true(circuit_shot_done(s));
    assert_int_equal(rec.count[CIRCUIT_SHOT_RELEASED], 1);
    assert_int_equal(rec.count[CIRCUIT_SHOT_STOPPED], 1);
    for (int k = 0; k < rec.n; k++) { /* (C-3): 1/2 L' I^2 = 2 mu N, to the release margin of 1e-3 N and round-off */
        const circuit_shot_state *e = &rec.events[k].state;
        if (rec.events[k].kind == CIRCUIT_SHOT_RELEASED) assert_near(0.25e-6 * e->current * e->current, 3e5, 0.01);
        if (rec.events[k].kind == CIRCUIT_SHOT_STOPPED) assert_true(e->v == 0.0 && e->x > 0.1 && e->x < 5.0);
    }
    circuit_shot_free(s);
}

/* The muzzle arc's current is none of the armature's: what belongs to its contact stays as it left. */
static void contact_kept_at_exit(void **state)
{
    (void)state;
    static const double sites[] = { 5.0 };
    circuit_shot_module modules[13];
    circuit_shot_config c = plain(modules, default_bank(modules));
    c.armature.velocity_skin = true;
    c.armature.wear_fraction = 0.03;
    c.barrel.muzzle_voltage = 200.0;
    c.sites = sites;
    c.n_sites = 1;
    circuit_shot *s = run(&c);
    const circuit_shot_state now = circuit_shot_now(s);
    assert_true(now.phase == CIRCUIT_SHOT_LEFT && now.current == 0.0);
    for (int k = 0; k < rec.n; k++) {
        const circuit_shot_state *e = &rec.events[k].state;
        if (rec.events[k].kind != CIRCUIT_SHOT_SITE && rec.events[k].kind != CIRCUIT_SHOT_MUZZLE) continue;
        assert_true(e->armature_temperature > 1.5 * c.armature.initial_temperature && e->film_thickness > 0.0);
        assert_true(e->contact_spread < c.armature.contact_length);
        assert_true(e->armature_temperature == now.armature_temperature && e->contact_spread == now.contact_spread);
        assert_true(e->film_thickness == now.film_thickness && e->film_temperature == now.film_temperature);
    }
    circuit_shot_free(s);
}

static void leaves_before_the_last_firing(void **state)
{
    (void)state;
    circuit_shot_module modules[2] = { unit_200kJ(10, 0.0), unit_200kJ(10, 5e-3) };
    circuit_shot_config c = plain(modules, 2);
    c.barrel.length = 0.5;
    c.barrel.muzzle_voltage = 200.0;
    circuit_shot *s = run(&c);
    const circuit_shot_summary result = circuit_shot_result(s);
    assert_true(circuit_shot_done(s) && result.muzzle_time < 5e-3);
    assert_int_equal(rec.count[CIRCUIT_SHOT_FIRED], 2);
    assert_int_equal(rec.count[CIRCUIT_SHOT_BLOCKED], 2);
    assert_near(circuit_shot_now(s).ledger.kinetic, result.muzzle_energy, 0.0);
    assert_true(circuit_shot_now(s).ledger.muzzle >
                0.5 * 0.5 * circuit_shot_now(s).ledger.start); /* the late half goes mostly there */
    circuit_shot_free(s);
}

/* ---- sites and jumps ---- */

static void sites_are_located(void **state)
{
    (void)state;
    static const double sites[] = { 4.2, 0.5, 0.5, 0.500001, 1.7, 2.9999999, 3.0, 4.9999 };
    static const int order[] = { 1, 2, 3, 4, 5, 6, 0, 7 };
    circuit_shot_module modules[13];
    circuit_shot_config c = plain(modules, default_bank(modules));
    circuit_shot *bare = run(&c);
    c.sites = sites;
    c.n_sites = 8;
    circuit_shot *s = run(&c);
    int n = 0;
    for (int k = 0; k < rec.n; k++) {
        if (rec.events[k].kind != CIRCUIT_SHOT_SITE) continue;
        const circuit_shot_state *e = &rec.events[k].state;
        assert_int_equal(rec.events[k].index, order[n]);
        assert_near(e->x, sites[order[n]], 1e-9); /* IDA locates roots to about 100 roundings of t: 1e-15 s x 2 km/s */
        assert_true(e->contact_pressure > 1e7 && e->rail_temperature == c.rails.initial_temperature);
        assert_true(e->armature_temperature > e->rail_temperature &&
                    e->armature_temperature <= c.armature.melting_temperature);
        n++;
    }
    assert_int_equal(n, 8);
    assert_near(circuit_shot_result(s).muzzle_velocity, circuit_shot_result(bare).muzzle_velocity,
                1e-9 * 2e3); /* looking changes nothing */
    circuit_shot_free(s);
    circuit_shot_free(bare);
}

static void gouges_hand_back(void **state)
{
    (void)state;
    static const double sites[] = { 1.0, 2.0 };
    circuit_shot_module modules[13];
    circuit_shot_config c = plain(modules, default_bank(modules));
    c.sites = sites;
    c.n_sites = 2;
    circuit_shot *free_run = run(&c);
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notebook();
    rec.impulse = 5.0;
    rec.mass_loss = 1e-4;
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    const circuit_shot_ledger l = circuit_shot_now(s).ledger;
    assert_true(rec.worst_energy < 1e-6);
    assert_near(l.momentum_jumps, 10.0, 1e-12);
    assert_near(l.mass_jumps, 2e-4, 1e-16);
    assert_true(l.jumps > 0.0 && circuit_shot_now(s).mass < c.armature.mass);
    const double loss = circuit_shot_result(free_run).muzzle_velocity - circuit_shot_result(s).muzzle_velocity;
    assert_true(loss > 5.0 && loss < 10.0 / 0.249); /* less than both jumps: a slower armature gains more afterwards */
    circuit_shot_free(s);
    circuit_shot_free(free_run);

    const circuit_shot_sink again =
        notebook(); /* more than the momentum: it stops there, and the current starts it again or not */
    rec.impulse = 1e6;
    OK(circuit_shot_create(&c, &s));
    assert_int_equal(circuit_shot_jump(s, 1.0, 0.0).code, STATUS_BAD_INPUT); /* held: no motion to take from */
    OK(circuit_shot_advance(s, INFINITY, &again));
    assert_true(rec.worst_energy < 1e-6 && circuit_shot_done(s));
    assert_int_equal(circuit_shot_jump(s, -1.0, 0.0).code, STATUS_BAD_INPUT);
    assert_int_equal(circuit_shot_jump(s, 0.0, 1.0).code, STATUS_BAD_INPUT);
    circuit_shot_free(s);
}

/* Stopped at any event and taken up again, the shot gives the same bits and the same events. */
static void stop_and_go_on(void **state)
{
    (void)state;
    circuit_shot_module modules[13];
    const circuit_shot_config c = plain(modules, default_bank(modules));
    circuit_shot *whole = run(&c);
    const int n = rec.n;
    for (int stop = 1; stop <= n; stop += 5) {
        circuit_shot *s = NULL;
        const circuit_shot_sink sink = notebook();
        rec.stop_at = stop;
        OK(circuit_shot_create(&c, &s));
        assert_int_equal(circuit_shot_advance(s, INFINITY, &sink).code, STATUS_STOPPED);
        OK(circuit_shot_advance(s, INFINITY, &sink));
        assert_int_equal(rec.n, n);
        assert_true(circuit_shot_result(s).muzzle_velocity == circuit_shot_result(whole).muzzle_velocity);
        circuit_shot_free(s);
    }
    circuit_shot_free(whole);
}

static status creation(const circuit_shot_config *c)
{
    circuit_shot *s = NULL;
    const status st = circuit_shot_create(c, &s);
    if (st.code != STATUS_OK) assert_null(s);
    circuit_shot_free(s);
    return st;
}

static void bad_input_is_named(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(1, 0.0);
    const double outside[1] = { 7.0 };
    circuit_shot_config c = plain(&m, 1);
    m.capacitance = -5e-3;
    status st = creation(&c);
    assert_int_equal(st.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(st.text, "bank[0].capacitance"));
    m = unit_200kJ(1, 0.0);
    m.inductance = 0.0;
    assert_non_null(strstr(creation(&c).text, "inductance"));
    m = unit_200kJ(1, 0.0);
    c.barrel.start = 6.0;
    assert_non_null(strstr(creation(&c).text, "barrel.start"));
    c = plain(&m, 1);
    c.sites = outside;
    c.n_sites = 1;
    assert_non_null(strstr(creation(&c).text, "sites[0]"));
    c = plain(&m, 0);
    c.supplies[CIRCUIT_SUPPLY_capacitor].n = 0;
    assert_int_equal(creation(&c).code, STATUS_BAD_INPUT);
}

/* ---- any bank at all ---- */

static circuit_shot_module dice_module(uint64_t *seed)
{
    circuit_shot_module m =
        unit_200kJ(1 + (int)(5.0 * random_between(seed, 0.0, 1.0)), floor(6.0 * random_between(seed, 0.0, 1.0)) * 3e-4);
    m.capacitance = random_log_between(seed, 1e-4, 1e-2);
    m.charge = random_between(seed, 0.0, 1.0) < 0.1 ? 0.0 : random_log_between(seed, 1e2, 2e4);
    m.inductance = random_log_between(seed, 1e-6, 1e-4);
    m.resistance = random_between(seed, 0.0, 1.0) < 0.1 ? 0.0 : random_log_between(seed, 1e-4, 1e-1);
    m.cable_inductance = random_between(seed, 0.0, 1.0) < 0.5 ? 0.0 : 1e-6;
    m.crowbar_drop = random_between(seed, 0.0, 1.0) < 0.3 ? 0.0 : random_log_between(seed, 0.1, 50.0);
    m.crowbar_resistance = random_between(seed, 0.0, 1.0) < 0.3 ? 0.0 : random_log_between(seed, 1e-9, 1e-2);
    if (random_between(seed, 0.0, 1.0) < 0.1) m.fire_at = NAN;
    return m;
}

/* Laws of run() over banks, armatures and barrels drawn at random, the same ones each time. */
static void random_banks(void **state)
{
    (void)state;
    const int n_shots = full_tests() ? 1000 : 60;
    uint64_t seed = 20170707;
    double worst = 0.0;
    uint64_t most = 0;
    int left = 0, stopped = 0;
    for (int k = 0; k < n_shots; k++) {
        circuit_shot_module modules[12];
        const int n = 1 + (int)(12.0 * random_between(&seed, 0.0, 1.0));
        for (int j = 0; j < n; j++) modules[j] = dice_module(&seed);
        circuit_shot_config c = plain(modules, n);
        c.armature.mass = random_log_between(&seed, 0.01, 10.0);
        c.armature.preload = random_between(&seed, 0.0, 1.0) < 0.2 ? 0.0 : random_log_between(&seed, 1.0, 1e6);
        c.armature.spreading = random_between(&seed, 0.0, 1.0) < 0.3 ? 0.0 : random_log_between(&seed, 1e-9, 1e-6);
        c.armature.friction_melted = 0.3 * random_between(&seed, 0.0, 1.0);
        c.armature.contact_voltage = random_between(&seed, 0.0, 1.0) < 0.3 ? 0.0 : 40.0;
        c.armature.wear_fraction = random_between(&seed, 0.0, 1.0) < 0.5 ? 0.0 : 0.02;
        c.barrel.length = random_log_between(&seed, 0.2, 20.0);
        c.barrel.muzzle_voltage = random_between(&seed, 0.0, 1.0) < 0.5 ? 0.0 : 300.0;
        circuit_shot *s = run(&c);
        worst = fmax(worst, rec.worst_energy);
        most = circuit_shot_result(s).steps > most ? circuit_shot_result(s).steps : most;
        left += rec.count[CIRCUIT_SHOT_MUZZLE];
        stopped += rec.count[CIRCUIT_SHOT_STOPPED];
        circuit_shot_free(s);
    }
    print_message("%d shots: %d leave, %d stop, worst energy error %.1e, at most %llu steps\n", n_shots, left, stopped,
                  worst, (unsigned long long)most);
    assert_true(left > n_shots / 4 && stopped > 0); /* the draw covers both ends */
}

/* The default bank at level skin; the figures of docs/validation/circuit.md come from here. */
static void shot_of_default_case(void **state)
{
    (void)state;
    circuit_shot_module modules[13];
    circuit_shot_config c = plain(modules, default_bank(modules));
    c.rails.level = CIRCUIT_SHOT_RAILS_SKIN;
    circuit_shot *s = run(&c);
    const circuit_shot_summary r = circuit_shot_result(s);
    const circuit_shot_state now = circuit_shot_now(s);
    const double frequency = circuit_shot_effective_frequency(&c);
    const double last = modules[12].fire_at;
    modules[12].fire_at = 1.01 * c.options.max_time; /* both mean never */
    const double by_time = circuit_shot_effective_frequency(&c);
    modules[12].fire_at = INFINITY;
    assert_true(by_time == circuit_shot_effective_frequency(&c) && by_time > frequency);
    modules[12].fire_at = last;
    print_message("f %.1f Hz\n", frequency);
    print_message(
        "peak %.1f kA, muzzle %.1f m/s at %.3f ms, efficiency %.3f, energy error %.1e, worst %.1e, %llu steps\n",
        1e-3 * r.peak_current, r.muzzle_velocity, 1e3 * r.muzzle_time, r.efficiency, r.energy_error, rec.worst_energy,
        (unsigned long long)r.steps);
    assert_true(r.muzzle_velocity > 2000.0 &&
                r.muzzle_velocity < 3000.0); /* the issue: passes through 1.0 to 2.0 km/s */
    assert_near(r.muzzle_energy, 0.5 * c.armature.mass * r.muzzle_velocity * r.muzzle_velocity, 1e-9 * r.muzzle_energy);
    assert_near(r.efficiency, r.muzzle_energy / now.ledger.start, 1e-12);
    assert_true(r.action > 0.0 && r.action < r.peak_current * r.peak_current * r.muzzle_time);
    circuit_shot_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rlc_with_ideal_crowbar),
        cmocka_unit_test(published_pulse),
        cmocka_unit_test(independent_integration),
        cmocka_unit_test(tolerance_converges),
        cmocka_unit_test(many_at_once),
        cmocka_unit_test(modules_that_never_fire),
        cmocka_unit_test(zero_charge),
        cmocka_unit_test(weak_group_waits),
        cmocka_unit_test(stuck_armature),
        cmocka_unit_test(armature_that_stops_again),
        cmocka_unit_test(contact_kept_at_exit),
        cmocka_unit_test(leaves_before_the_last_firing),
        cmocka_unit_test(sites_are_located),
        cmocka_unit_test(gouges_hand_back),
        cmocka_unit_test(stop_and_go_on),
        cmocka_unit_test(bad_input_is_named),
        cmocka_unit_test(random_banks),
        cmocka_unit_test(shot_of_default_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
