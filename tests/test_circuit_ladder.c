/* SPDX-License-Identifier: BSD-3-Clause */
/* Diffusing rails: the ladder against the section it stands for, the two equations a rung against slices summed one by
 * one, the closed formula of a half-space, and the power balance that must hold for any current and speed. */
#include "base/constants.h"
#include "circuit/rails/inductance.h"
#include "circuit/rails/rails.h"
#include "circuit/shot.h"
#include "tests/circuit_common.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near_common.h"
#include "status_common.h"

#undef I /* the current, here */

static const double COPPER = 1.72e-8; /* [ohm m] */
static const circuit_rail_section SECTION = {
    .height = 0.025, .thickness = 0.020, .separation = 0.025, .resistivity = 1.72e-8, .rails = 2
};

static circuit_ladder fitted(double f_top, double error)
{
    circuit_impedance z;
    circuit_ladder l;
    OK(circuit_inductance_response(&SECTION, f_top, 4.0, &z));
    OK(circuit_ladder_fit(&z, 2.0 * PI * f_top, error, &l));
    circuit_impedance_free(&z);
    return l;
}

/* ---- the ladder ---- */

/* Between the fit's own grid points too, on a grid of its own: the error promised, 5 % apart at most. */
static void error_as_asked(void **state)
{
    (void)state;
    circuit_impedance z;
    OK(circuit_inductance_response(&SECTION, 5e4, 4.0, &z));
    int rungs = 0;
    for (double error = 0.1; error > 1e-6; error *= 0.1) {
        circuit_ladder l;
        OK(circuit_ladder_fit(&z, 2.0 * PI * 5e4, error, &l));
        assert_true(l.n > rungs && l.error <= error);
        rungs = l.n;
        for (double f = 0.1; f < 5e4; f *= 1.037) {
            const double complex s = _Complex_I * 2.0 * PI * f, want = circuit_impedance_at(&z, s);
            assert_true(cabs(circuit_ladder_at(&l, s) - want) <= 1.05 * error * cabs(want - s * l.L_inf));
        }
    }
    assert_true(rungs <= 18); /* measured: 16 at 1e-6 */
    circuit_ladder l;
    assert_int_equal(circuit_ladder_fit(&z, 2.0 * PI * 5e4, 1e-15, &l).code, STATUS_NUMERICAL);
    circuit_impedance_free(&z);
}

/* R_dc is the section's; L' at direct current and at infinity are the filaments', L_inf above the perfect conductor's
 * by the finest cells (0.2 % at 50 kHz). */
static void ends_of_the_band(void **state)
{
    (void)state;
    double L = 0.0, R = 0.0, L_limit = 0.0;
    const circuit_ladder l = fitted(5e4, 1e-2);
    OK(circuit_inductance_at(&SECTION, 0.0, 4.0, &L, &R));
    OK(circuit_inductance_limit(&SECTION, &L_limit));
    assert_close(l.R_dc, 2.0 * COPPER / (0.020 * 0.025), 1e-9);
    assert_close(circuit_ladder_slow_inductance(&l), L, 1e-4);
    assert_close(l.L_inf, L_limit, 0.003);
    assert_true(l.L_inf > L_limit);
}

/* All parts positive for any section: passive. */
static void passive(void **state)
{
    (void)state;
    static const double sections[][3] = {
        { 0.025, 0.02, 0.025 }, { 0.025, 0.002, 0.025 }, { 0.04, 0.01, 0.002 }, { 0.005, 0.02, 0.05 }
    };
    for (size_t k = 0; k < sizeof sections / sizeof sections[0]; k++) {
        const circuit_rail_section s = { .height = sections[k][0],
                                         .thickness = sections[k][1],
                                         .separation = sections[k][2],
                                         .resistivity = COPPER,
                                         .rails = 2 };
        circuit_impedance z;
        circuit_ladder l;
        OK(circuit_inductance_response(&s, 2e4, 4.0, &z));
        OK(circuit_ladder_fit(&z, 2.0 * PI * 2e4, 1e-4, &l));
        assert_true(l.R_dc > 0.0 && l.L_inf > 0.0 && l.n >= 4);
        for (int r = 0; r < l.n; r++) assert_true(l.L[r] > 0.0 && l.R[r] > 0.0);
        for (int r = 1; r < l.n; r++) assert_true(l.L[r] / l.R[r] < l.L[r - 1] / l.R[r - 1]);
        circuit_impedance_free(&z);
    }
}

/* The currents at a frequency add up to one and carry the impedance: sum |i|^2 R = Re Z. */
static void currents_carry_the_impedance(void **state)
{
    (void)state;
    circuit_impedance z;
    OK(circuit_inductance_response(&SECTION, 1e4, 4.0, &z));
    double complex *share = malloc((size_t)z.n * sizeof *share), total = 0.0;
    const double complex s = _Complex_I * 2.0 * PI * 2e3;
    double heat = 0.0;
    OK(circuit_impedance_currents(&z, s, share));
    for (int i = 0; i < z.n; i++) {
        total += share[i];
        heat += creal(share[i] * conj(share[i])) / (z.conductance[i] * z.conductance[i]);
    }
    assert_true(cabs(total - 1.0) < 1e-9);
    assert_close(heat, creal(circuit_impedance_at(&z, s)), 1e-6);
    free(share);
    circuit_impedance_free(&z);
}

/* ---- under the contact ---- */

/* A slice passes under the contact, its current rising evenly: dj/du = (u - j)/theta, by Heun in 4000 steps. */
static void shares_under_the_contact(void **state)
{
    (void)state;
    enum { STEPS = 4000 };
    for (double theta = 0.02; theta < 2e3; theta *= 1.7) {
        double j = 0.0, force = 0.0, heat = 0.0;
        for (int k = 0; k < STEPS; k++) {
            const double du = 1.0 / STEPS, u = k * du, slope = (u - j) / theta;
            const double next = j + 0.5 * du * (slope + (u + du - j - du * slope) / theta);
            force += du * (j + next);
            heat += du * (0.5 * (u - j) * (u - j) + 0.5 * (u + du - next) * (u + du - next)) / theta;
            j = next;
        }
        const double a = circuit_rails_share_at_birth(theta), f = circuit_rails_share_of_force(theta);
        assert_close(a, j, 1e-5);
        assert_close(f, force, 1e-4);
        assert_close(a * (2.0 - a) - f, 2.0 * heat,
                     2e-4); /* what is neither field nor work is heat under the contact */
    }
    assert_true(circuit_rails_share_at_birth(0.0) == 1.0 && circuit_rails_share_of_force(0.0) == 1.0);
    assert_close(circuit_rails_share_at_birth(29.999), circuit_rails_share_at_birth(30.001),
                 1e-4); /* formula and series meet */
    assert_close(circuit_rails_share_of_force(29.999), circuit_rails_share_of_force(30.001), 1e-4);
}

static void force_between_its_limits(void **state)
{
    (void)state;
    const circuit_rails_load r = { .ladder = fitted(5e4, 1e-2), .contact = { .length = 0.0165 } };
    assert_close(circuit_rails_force_gradient(&r, 0.0, 1.0), circuit_ladder_slow_inductance(&r.ladder), 1e-12);
    assert_close(circuit_rails_force_gradient(&r, 1e9, 1.0), r.ladder.L_inf, 1e-5);
    for (double v = 1.0, last = 1.0; v < 1e5; v *= 2.0) {
        const double now = circuit_rails_force_gradient(&r, v, 1.0);
        assert_true(now < last);
        last = now;
    }
}

/* ---- the sum over all slices ---- */

/* A pulse and a travel, both given: I = I_1 (t/t_1) exp(1 - t/t_1), x = x_0 + 1/2 g t^2. */
static const double I_1 = 9e5, t_1 = 6e-4, x_0 = 0.1, g = 1.1e6;

static double pulse(double t)
{
    return I_1 * t / t_1 * exp(1.0 - t / t_1);
}

static void pulse_rates(const circuit_rails_load *r, double t, const double *y, double *d)
{
    circuit_rails_memory_rates(r, x_0 + 0.5 * g * t * t, g * t, pulse(t), y, d);
}

/* Runge-Kutta of order four; steps well below the fastest rung's time. */
static void pulse_memory(const circuit_rails_load *r, double end, int steps, double *y)
{
    const int n = 2 * r->ladder.n;
    double k[4][2 * CIRCUIT_LADDER_MAX_RUNGS], z[2 * CIRCUIT_LADDER_MAX_RUNGS];
    const double dt = end / steps;
    memset(y, 0, (size_t)n * sizeof *y);
    for (int i = 0; i < steps; i++) {
        const double t = i * dt, at[4] = { 0.0, 0.5, 0.5, 1.0 };
        for (int s = 0; s < 4; s++) {
            for (int j = 0; j < n; j++) z[j] = y[j] + (s ? at[s] * dt * k[s - 1][j] : 0.0);
            pulse_rates(r, t + at[s] * dt, z, k[s]);
        }
        for (int j = 0; j < n; j++) y[j] += dt / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
    }
}

/* Current in a rung's inductance at `end` in a slice born at `birth` with `j` there, by Simpson in the age over tau. */
static double slice_current(double birth, double j, double end, double tau)
{
    enum { STEPS = 400 };
    const double span = fmin(end - birth, 40.0 * tau), h = span / STEPS;
    double sum = 0.0;
    for (int i = 0; i <= STEPS; i++)
        sum += (i == 0 || i == STEPS ? 1.0 : i % 2 ? 4.0 : 2.0) * exp(-i * h / tau) * pulse(end - i * h);
    return sum * h / (3.0 * tau) + j * exp(-(end - birth) / tau);
}

/* Voltage of the rungs at `end`, slice by slice: those of the start, then 400 whose age grows from the armature on. */
static double slices_voltage(const circuit_rails_load *r, double end)
{
    enum { SLICES = 400 };
    const circuit_ladder *l = &r->ladder;
    double V = 0.0;
    for (int k = 0; k < l->n; k++) {
        const double tau = l->L[k] / l->R[k];
        V += x_0 * l->R[k] * (pulse(end) - slice_current(0.0, 0.0, end, tau));
        for (int i = 0; i < SLICES; i++) {
            const double young = end * pow((double)i / SLICES, 3.0), old = end * pow((i + 1.0) / SLICES, 3.0);
            const double t = end - 0.5 * (young + old),
                         length = 0.5 * g * (pow(end - young, 2.0) - pow(end - old, 2.0));
            const double a = circuit_rails_share_at_birth(g * t * tau / r->contact.length);
            V += length * l->R[k] * (pulse(end) - slice_current(t, a * pulse(t), end, tau));
        }
        V += l->L[k] * g * end * circuit_rails_share_at_birth(g * end * tau / r->contact.length) * pulse(end);
    }
    return V;
}

/* The shot's ladder (1e-2) summed by two equations a rung, against slices with a ladder a thousand times finer.  0.1 %
 * is asked for, of the rails' voltage beyond L_inf; measured 0.03 % and less. */
static void slices_one_by_one(void **state)
{
    (void)state;
    const circuit_rails_load coarse = { .ladder = fitted(5e4, 1e-2), .contact = { .length = 0.0165 } },
                             fine = { .ladder = fitted(5e4, 1e-5), .contact = { .length = 0.0165 } };
    double y[2 * CIRCUIT_LADDER_MAX_RUNGS];
    for (double end = 5e-4; end < 2.1e-3; end += 5e-4) {
        const double x = x_0 + 0.5 * g * end * end, v = g * end, I = pulse(end);
        pulse_memory(&coarse, end, 8000, y);
        const circuit_rails_flow flow = circuit_rails_flow_at(&coarse, x, v, I, y);
        const double rungs = flow.voltage - (coarse.ladder.L_inf * v + coarse.ladder.R_dc * x) * I;
        assert_true(fabs(rungs - slices_voltage(&fine, end)) <= 1e-3 * (flow.voltage - coarse.ladder.L_inf * v * I));
    }
}

/* Constant I and v, rail exposed at once: voltage over current 4 (P/h) sqrt(rho mu0 v x/pi), P 0.40 .. 0.41 for this
 * section (PHYSICS), for x/v up to 0.5 ms: within 5 %. */
static void half_space_formula(void **state)
{
    (void)state;
    const circuit_rails_load r = { .ladder = fitted(1e6, 1e-3), .contact = { .length = 1e-9 } };
    const double v = 1500.0, I = 1e6;
    double y[2 * CIRCUIT_LADDER_MAX_RUNGS] = { 0 };
    for (double time = 1e-4; time < 5.1e-4; time += 1e-4) {
        const double x = v * time;
        for (int k = 0; k < r.ladder.n; k++) { /* dQ/dt = (v t I - Q)/tau in closed form */
            const double tau = r.ladder.L[k] / r.ladder.R[k];
            y[2 * k] = I * v * (time + tau * expm1(-time / tau));
        }
        const circuit_rails_flow flow = circuit_rails_flow_at(&r, x, v, I, y);
        const double rest = flow.voltage / I - r.ladder.L_inf * v;
        assert_close(rest, 4.0 * 0.405 / SECTION.height * sqrt(COPPER * MU0 * v * x / PI), 0.05);
    }
}

/* ---- power ---- */

/* V I = d(field)/dt + heat + F v for any I, dI/dt, v, x and memory: no integration, round-off alone.  Heat and force
 * are never negative for any memory that slices can have (W x >= Q^2). */
static void power_balance(void **state)
{
    (void)state;
    circuit_rails_load r = { .ladder = fitted(5e4, 1e-3),
                             .contact = { .length = 0.0165, .resistivity = 1.72e-8 },
                             .coefficient = 4e-3 };
    srand(7);
    for (int trial = 0; trial < 2000; trial++) {
        r.heat_capacity = trial % 2 ? 3450.0 : 0.0; /* cold or warm, even or crowded: the balance is the same */
        r.contact.interface = trial % 3 ? 0.0 : 6e-3;
        const double U[4] = { rand() / (double)RAND_MAX, rand() / (double)RAND_MAX, rand() / (double)RAND_MAX,
                              rand() / (double)RAND_MAX };
        const double x = 0.1 + 5.0 * U[0], v = trial % 9 ? 3000.0 * U[1] * U[1] : 0.0;
        const double I = 2e6 * (U[2] - 0.3), slope = 1e10 * (U[3] - 0.5);
        double y[2 * CIRCUIT_LADDER_MAX_RUNGS + 3], d[2 * CIRCUIT_LADDER_MAX_RUNGS + 3];
        y[2 * r.ladder.n] = 1e5 * U[0];
        y[2 * r.ladder.n + 1] = 0.8e5 * U[0];
        y[2 * r.ladder.n + 2] = 1e9 * U[1];
        for (int k = 0; k < r.ladder.n; k++) {
            const double mean = 2e6 * (rand() / (double)RAND_MAX - 0.3);
            y[2 * k] = x * mean;
            y[2 * k + 1] = x * mean * mean * (1.0 + rand() / (double)RAND_MAX);
        }
        const circuit_rails_flow f = circuit_rails_flow_at(&r, x, v, I, y);
        circuit_rails_memory_rates(&r, x, v, I, y, d);
        double field = r.ladder.L_inf * (0.5 * v * I * I + x * I * slope);
        for (int k = 0; k < r.ladder.n; k++) field += 0.5 * r.ladder.L[k] * d[2 * k + 1];
        const double in = (f.inductance * slope + f.voltage) * I,
                     work = 0.5 * circuit_rails_force_gradient(&r, v, I) * I * I * v;
        assert_true(f.heat >= 0.0 && f.field >= 0.0 && work >= 0.0);
        const double scale = fabs(in) + fabs(field) + f.heat + work;
        assert_true(fabs(in - field - f.heat - work) <= 1e-12 * scale);
    }
}

/* ---- slices that warm ---- */

/* An armature at rest under constant current, for long: even current, rise = R_dc I^2 t/C (C-24) where R stays
 * (coefficient 0); the early crowding leaves a trace that dies as 1/t.  With a coefficient the heat is that of a
 * conductor in series: d(rise)/dt = R_dc I^2 (1 + c rise)/C. */
static void warming_of_even_current(void **state)
{
    (void)state;
    enum { STEPS = 40000 };
    const double I = 1e5, end = 1.0, dt = end / STEPS, x = 2.0;
    circuit_rails_load r = { .ladder = fitted(30.0, 1e-1), .contact = { .length = 0.02 }, .heat_capacity = 3450.0 };
    for (int k = 0; k < 2; k++) {
        double y[2 * CIRCUIT_LADDER_MAX_RUNGS + 3] = { 0.0 }, d[2 * CIRCUIT_LADDER_MAX_RUNGS + 3];
        r.coefficient = k ? 4e-3 : 0.0;
        const int n = circuit_rails_memory_size(&r);
        for (int i = 0; i < STEPS; i++) {
            circuit_rails_memory_rates(&r, x, 0.0, I, y, d);
            for (int j = 0; j < n; j++) y[j] += dt * d[j];
        }
        const double plain = r.ladder.R_dc * I * I * end / r.heat_capacity;
        const double want = k ? expm1(r.coefficient * plain) / r.coefficient : plain;
        assert_close(circuit_rails_memory_rise(&r, x, y), want, k ? 0.08 : 0.04);
    }
    r.heat_capacity = 0.0;
    assert_int_equal(circuit_rails_memory_size(&r), 2 * r.ladder.n); /* nothing is paid for what is not asked for */
}

/* The heat of a skin stays in it: with the even current's R_dc of a third the rise is three times as high. */
static void warming_of_a_skin(void **state)
{
    (void)state;
    const double memory[] = { 5e4, 5e4, 2e8 }, x = 2.0; /* E, E_c = R' G [J]; G [A^2 s m] */
    circuit_rails_load r = { .ladder = { .R_dc = 2.5e-4, .L_inf = 5e-7 }, .heat_capacity = 3450.0 };
    const double even = circuit_rails_memory_rise(&r, x, memory);
    assert_close(even, 5e4 / (3450.0 * x), 1e-6);
    r.even_resistance = 2.5e-4 / 3.0;
    assert_close(circuit_rails_memory_rise(&r, x, memory), 3.0 * even, 1e-12);
}

/* ---- whole shots ---- */

typedef struct {
    double energy, field, heat; /* worst error; least increments */
    double last_heat;
} watch;

static bool look(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    watch *w = user;
    (void)s;
    w->energy = fmax(w->energy, fabs(state->ledger.energy_error));
    w->field = fmin(w->field, state->ledger.rails_field);
    w->heat = fmin(w->heat, state->ledger.rails_heat - w->last_heat);
    w->last_heat = state->ledger.rails_heat;
    return true;
}

static circuit_shot_summary shoot(const circuit_shot_config *c, watch *w)
{
    circuit_shot *s = NULL;
    *w = (watch){ 0 };
    const circuit_shot_sink sink = { NULL, look, w };
    OK(circuit_shot_create(c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    const circuit_shot_summary r = circuit_shot_result(s);
    circuit_shot_free(s);
    return r;
}

/* Energy to 1e-8 of what was stored at every step, beyond the muzzle too; the rails only ever lose.  At the default
 * tolerances the muzzle velocity is right to 1e-6, and a ladder of a hundredth of the error moves it by 3e-6. */
static void diffusing_shot(void **state)
{
    (void)state;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    assert_int_equal(c.rails.level, CIRCUIT_SHOT_RAILS_DIFFUSING); /* the default */
    watch w;
    const circuit_shot_summary plain = shoot(&c, &w);
    assert_true(w.energy < 1e-7);
    c.options.rtol = 1e-11;
    c.options.atol = 1e-12;
    const circuit_shot_summary sharp = shoot(&c, &w);
    print_message("muzzle %.3f m/s, off by %.1e at the default tolerances; energy error %.1e\n", sharp.muzzle_velocity,
                  plain.muzzle_velocity / sharp.muzzle_velocity - 1.0, w.energy);
    assert_true(w.energy < 1e-8 && w.field >= 0.0 && w.heat >= 0.0);
    assert_close(plain.muzzle_velocity, sharp.muzzle_velocity, 1e-6);
    c.rails.ladder_error = 1e-4;
    assert_close(shoot(&c, &w).muzzle_velocity, sharp.muzzle_velocity, 1e-5);
    c.armature.contact_length = 0.1; /* the bench's figure: 1.3 % faster */
    assert_close(shoot(&c, &w).muzzle_velocity, 1.0132 * sharp.muzzle_velocity, 1e-3);
}

/* Faster exposed than diffused, the rail pushes with L_inf; an armature that hardly moves is pushed with direct
 * current's L'. A ladder fitted before gives the same shot bit for bit. */
static void levels_agree(void **state)
{
    (void)state;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    circuit_ladder l;
    watch w;
    c.rails.ladder_frequency = 5e4;
    const circuit_shot_summary own = shoot(&c, &w);
    OK(circuit_rails_ladder(&c.rails, 5e4, &l));
    c.fitted = &l;
    assert_true(shoot(&c, &w).muzzle_velocity == own.muzzle_velocity);
    circuit_ladder none = { .R_dc = l.R_dc, .L_inf = l.L_inf };
    c.fitted = &none;
    const double bare = shoot(&c, &w).muzzle_velocity;
    c.fitted = NULL;
    c.rails.level = CIRCUIT_SHOT_RAILS_CONSTANT;
    c.rails.inductance_gradient = l.L_inf;
    c.rails.resistance_gradient = l.R_dc;
    assert_true(shoot(&c, &w).muzzle_velocity == bare);
}

/* Level skin and the same gradients given are one shot, until slices warm: those of a skin warm more. */
static void skin_warms_more(void **state)
{
    (void)state;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    double v[2][2];
    for (int slices = 0; slices < 2; slices++) {
        circuit_shot_config c = default_shot(modules);
        watch w;
        c.rails.level = CIRCUIT_SHOT_RAILS_SKIN;
        c.rails.frequency = 300.0;
        c.rails.slices = slices;
        v[slices][0] = shoot(&c, &w).muzzle_velocity;
        OK(circuit_rails_impedance(&c.rails, 300.0, &c.rails.inductance_gradient, &c.rails.resistance_gradient));
        c.rails.level = CIRCUIT_SHOT_RAILS_CONSTANT;
        v[slices][1] = shoot(&c, &w).muzzle_velocity;
    }
    print_message("one slice: skin %.2f -> %.2f m/s, as given %.2f -> %.2f m/s\n", v[0][0], v[1][0], v[0][1], v[1][1]);
    assert_true(v[0][0] == v[0][1]);
    assert_true(v[0][0] - v[1][0] > 1.5 * (v[0][1] - v[1][1]) && v[1][1] < v[0][1]); /* R'/R_dc is 2 there */
}

/* Slices with their own temperature take 0.7 % of the muzzle velocity; one is as good as eight to 0.04 %. */
static circuit_shot_summary at_tolerance(circuit_shot_config c, double tolerance)
{
    shot_notes notes;
    const circuit_shot_sink sink = notes_sink(&notes);
    circuit_shot *s = NULL;
    c.options.rtol = c.options.atol = tolerance;
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    const circuit_shot_summary r = circuit_shot_result(s);
    circuit_shot_free(s);
    return r;
}

/* Thirteen firings and as many crowbars, each a new start: 0.01 % in few steps.  843 measured to the end of the
 * current, 1104 with IDA's own first steps. */
static void few_steps(void **state)
{
    (void)state;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    circuit_ladder l;
    OK(circuit_rails_ladder(&c.rails, 50e3, &l));
    c.fitted = &l;
    const circuit_shot_summary exact = at_tolerance(c, 1e-11), quick = at_tolerance(c, 1e-5);
    print_message("muzzle velocity off by %.1e in %d steps\n", quick.muzzle_velocity / exact.muzzle_velocity - 1.0,
                  (int)quick.steps);
    assert_close(quick.muzzle_velocity, exact.muzzle_velocity, 1e-4);
    assert_true(quick.steps < 950);
}

static void warm_slices(void **state)
{
    (void)state;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    watch w;
    double muzzle[3];
    for (int k = 0; k < 3; k++) {
        c.rails.slices = 4 * k;
        muzzle[k] = shoot(&c, &w).muzzle_velocity;
        assert_true(w.energy < 1e-7 && w.heat >= 0.0);
    }
    print_message("muzzle %.2f m/s cold, %.2f with 4 slices, %.2f with 8\n", muzzle[0], muzzle[1], muzzle[2]);
    assert_close(muzzle[2], 0.9934 * muzzle[0], 5e-4);
    assert_close(muzzle[1], muzzle[2], 5e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_as_asked),
        cmocka_unit_test(ends_of_the_band),
        cmocka_unit_test(passive),
        cmocka_unit_test(currents_carry_the_impedance),
        cmocka_unit_test(shares_under_the_contact),
        cmocka_unit_test(force_between_its_limits),
        cmocka_unit_test(slices_one_by_one),
        cmocka_unit_test(half_space_formula),
        cmocka_unit_test(power_balance),
        cmocka_unit_test(diffusing_shot),
        cmocka_unit_test(levels_agree),
        cmocka_unit_test(skin_warms_more),
        cmocka_unit_test(warming_of_even_current),
        cmocka_unit_test(warming_of_a_skin),
        cmocka_unit_test(warm_slices),
        cmocka_unit_test(few_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
