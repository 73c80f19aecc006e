/* SPDX-License-Identifier: BSD-3-Clause */
/* The tube of water in one dimension against closed answers: what a piston sends, how that wears off, what a wall and a
 * free plate make of it.  Rows U6 - U11 of the published device. */
#include "mpm_scenes.h"

#include "mpm/tube.h"

static const double RHO0 = 1000, C0 = 1482, SLOPE = 8.415 / 4;
static const double MASS = 73.98; /* 0.238 kg on 64 mm [kg/m2] */

/* Tait with gamma 7.415: that of the published computations, s = 2.104. */
static mpm_material water(void)
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    strcpy(m.name, "water");
    m.strength = MPM_STRENGTH_none, m.eos = MPM_EOS_tait, m.tait_exponent = 7.415;
    m.density = RHO0, m.specific_heat = 4186, m.reference_temperature = 293;
    m.sound_speed = C0, m.cavitation_pressure = 0;
    return m;
}

static mpm_tube *tube(const mpm_material *m, double v0, double length, tube_end end, double plate, int cells)
{
    const mpm_tube_setup setup = { m, MASS, v0, length, end, plate, cells };
    mpm_tube *t;
    assert_ok(mpm_tube_create(&setup, &t));
    return t;
}

static void assert_books(const mpm_tube *t)
{
    const mpm_tube_state s = mpm_tube_now(t);
    assert_near(s.momentum_error, 0, 1e-10);
    assert_near(s.energy_error, 0, 1e-9);
}

/* U6: at the piston's face rho (c0 + s v0) v0 at first, 2 %, then exp(-t/theta), theta = M/(rho c), 3 %.  The first
 * pressure is that of 2 us later, when the front has left the piston, carried back. */
static void test_piston(void **state)
{
    (void)state;
    const mpm_material m = water();
    const double theta = MASS / (RHO0 * C0), speeds[] = { 22.94, 43.18 }, later = 2e-6;
    for (int k = 0; k < 2; k++) {
        const double v0 = speeds[k], first = RHO0 * (C0 + SLOPE * v0) * v0;
        mpm_tube *t = tube(&m, v0, 0.3, TUBE_GOES_ON, 0, 750);
        double at[2];
        mpm_tube_advance(t, later);
        const double p = mpm_tube_now(t).piston_pressure * exp(later / theta);
        for (int i = 0; i < 2; i++) {
            mpm_tube_advance(t, (1 + 2 * i) * theta);
            at[i] = log(mpm_tube_now(t).piston_velocity);
        }
        const double decay = 2 * theta / (at[0] - at[1]);
        print_message("piston at %g m/s: %.2f MPa (%.2f), theta %.2f us (%.2f)\n", v0, 1e-6 * p, 1e-6 * first,
                      1e6 * decay, 1e6 * theta);
        assert_near(p / first, 1, 0.02);
        assert_near(decay / theta, 1, 0.03);
        assert_books(t);
        mpm_tube_free(t);
    }
}

/* Largest pressure at a place until `until`, and when half of it was first there. */
static double peak_at(mpm_tube *t, double x, double until)
{
    double peak = 0;
    while (mpm_tube_now(t).time < until) {
        mpm_tube_step(t);
        peak = fmax(peak, mpm_tube_pressure(t, x));
    }
    return peak;
}

/* U8: the rarefaction behind the front overtakes it: p(x)/p0 = 2/(1 + sqrt(1 + 2 S)), S = beta p0 x/(rho c^3 theta),
 * beta = (gamma + 1)/2, 5 % of this at 22.94 m/s.  U7: the whole momentum of the piston goes by. */
static void test_wears_off(void **state)
{
    (void)state;
    const mpm_material m = water();
    const double v0 = 22.94, theta = MASS / (RHO0 * C0), p0 = RHO0 * (C0 + SLOPE * v0) * v0;
    for (int k = 0; k < (full_tests() ? 3 : 1); k++) {
        const double x = k == 0 ? 0.5 : k == 1 ? 1.0 : 1.3;
        const double S = 2 * SLOPE * p0 * x / (RHO0 * C0 * C0 * C0 * theta), want = p0 * 2 / (1 + sqrt(1 + 2 * S));
        mpm_tube *t = tube(&m, v0, x + 0.1, TUBE_GOES_ON, 0, (int)(1000 * (x + 0.1)));
        const double peak = peak_at(t, x, (x + 0.1) / C0 + 10e-6);
        mpm_tube_advance(t, (x + 0.1) / C0 + 10 * theta);
        const mpm_tube_state s = mpm_tube_now(t);
        print_message("front after %.1f m: %.2f MPa (%.2f), momentum left %.1e, books %.0e %.0e\n", x, 1e-6 * peak,
                      1e-6 * want, s.piston_velocity / v0, s.momentum_error, s.energy_error);
        assert_near(peak / want, 1, 0.05);
        assert_near(s.piston_velocity / v0, 0, 2e-3);
        assert_books(t);
        mpm_tube_free(t);
    }
}

/* U9: a rigid wall doubles the pressure, for a wave of 25 MPa 2.03 fold by us = c0 + s up of the reflected shock, which
 * meets the falling flank: 2 %. */
static void test_wall(void **state)
{
    (void)state;
    const mpm_material m = water();
    const double v0 = 22.94, length = 0.5;
    mpm_tube *through = tube(&m, v0, length, TUBE_GOES_ON, 0, 600), *against = tube(&m, v0, length, TUBE_WALL, 0, 600);
    const double incident = peak_at(through, length, 0.36e-3), wall = peak_at(against, length, 0.36e-3);
    print_message("wall: %.2f MPa for %.2f, %.3f fold\n", 1e-6 * wall, 1e-6 * incident, wall / incident);
    assert_near(wall / incident, 2.03, 0.04);
    assert_books(against);
    mpm_tube_free(through), mpm_tube_free(against);
}

/* U17: of a gauge 0.1 m before a wall at 1.3 m: when half its first peak is there, how much later the pressure rises
 * again, and both peaks.  The front's way at us = c0 + s u with u of U8's formula: time 1 %.  What comes back meets
 * water that moves on at u: c + s u - u, 2 %. */
static void test_gauge(void **state)
{
    (void)state;
    if (!full_tests()) return;
    const mpm_material m = water();
    const double v0 = 22.94, length = 1.3, gauge = 1.2, theta = MASS / (RHO0 * C0), p0 = RHO0 * (C0 + SLOPE * v0) * v0;
    double front = 0, between = 0, before = 0, peak[2] = { 0, 0 }, at[2] = { 0, 0 };
    for (int i = 0; i < 1300; i++) {
        const double x = 1e-3 * (i + 0.5), S = 2 * SLOPE * p0 * x / (RHO0 * C0 * C0 * C0 * theta);
        const double u = v0 * 2 / (1 + sqrt(1 + 2 * S)), us = C0 + SLOPE * u;
        if (x < gauge) front += 1e-3 / us;
        if (x > gauge) between += 1e-3 / us + 1e-3 / (us - u);
    }
    mpm_tube *t = tube(&m, v0, length, TUBE_WALL, 0, 1300);
    while (mpm_tube_now(t).time < front + between + 20e-6) {
        mpm_tube_step(t);
        const double p = mpm_tube_pressure(t, gauge), now = mpm_tube_now(t).time;
        const int k = now > front + 0.5 * between;
        if (at[k] == 0 && p > (k ? before + 0.5 * peak[0] : 0.35 * p0)) at[k] = now;
        peak[k] = fmax(peak[k], p);
        before = k ? before : p;
        if (k && at[1] == 0) before = fmin(before, p);
    }
    const double S = 2 * SLOPE * p0 * gauge / (RHO0 * C0 * C0 * C0 * theta), want = p0 * 2 / (1 + sqrt(1 + 2 * S));
    print_message(
        "gauge: front after %.1f us (%.1f), %.2f MPa (%.2f); back %.1f us later (%.1f), %.2f MPa, %.3f fold\n",
        1e6 * at[0], 1e6 * front, 1e-6 * peak[0], 1e-6 * want, 1e6 * (at[1] - at[0]), 1e6 * between, 1e-6 * peak[1],
        peak[1] / peak[0]);
    assert_near(at[0] / front, 1, 0.01);
    assert_near(peak[0] / want, 1, 0.03);
    assert_near((at[1] - at[0]) / between, 1, 0.02);
    assert_books(t);
    mpm_tube_free(t);
}

typedef struct {
    double v0, plate;           /* [m/s, kg/m2] */
    double incident, way, from; /* [Pa], way of the plate [m] so long after the arrival [s] */
    double velocity;            /* [m/s] */
} plate_row;

/* Of a plate at the end of the column: its largest velocity, the first time without pressure after the wave has come,
 * its way `from` after that. */
typedef struct {
    double velocity, parted, way;
} plate_answer;

static plate_answer drive_plate(const plate_row *r, double length, int cells)
{
    const mpm_material m = water();
    mpm_tube *t = tube(&m, r->v0, length, TUBE_PLATE, r->plate, cells);
    plate_answer a = { 0, 0, 0 };
    double arrival = 0, most = 0;
    while (arrival == 0 || mpm_tube_now(t).time < arrival + r->from) {
        mpm_tube_step(t);
        const mpm_tube_state s = mpm_tube_now(t);
        most = fmax(most, s.end_pressure);
        if (arrival == 0 && s.end_pressure > 0.05 * r->incident) arrival = s.time;
        if (arrival > 0 && a.parted == 0 && s.end_pressure <= 0 && most > 0.3 * r->incident)
            a.parted = s.time - arrival;
        a.velocity = fmax(a.velocity, s.end_velocity);
        a.way = s.end_way;
    }
    assert_books(t);
    mpm_tube_free(t);
    return a;
}

/* U10: Taylor (1941): psi = rho c theta/m, v_max = (2 p0/rho c) psi^(1/(1 - psi)), parted at theta ln psi/(psi - 1); at
 * 1 m/s and 0.1 m from the piston, p0 that of U8.  3 % of v; the time to 2 us and the rise of the front, 3 us here. */
static void test_taylor(void **state)
{
    (void)state;
    const double plates[] = { 2.24, 8.10, 39.25 }, theta = MASS / (RHO0 * C0), v0 = 1, length = 0.1;
    for (int k = 0; k < 3; k++) {
        const double psi = MASS / plates[k], S = 2 * SLOPE * v0 * length / (C0 * C0 * theta);
        const double p0 = RHO0 * (C0 + SLOPE * v0) * v0 * 2 / (1 + sqrt(1 + 2 * S));
        const double want = 2 * p0 / (RHO0 * C0) * pow(psi, 1 / (1 - psi)), when = theta * log(psi) / (psi - 1);
        const plate_row r = { v0, plates[k], p0, 0, 60e-6, 0 };
        const plate_answer a = drive_plate(&r, length, 500);
        print_message("plate of %.2f kg/m2: %.4f m/s (%.4f), parted after %.2f us (%.2f), way %.3f mm\n", plates[k],
                      a.velocity, want, 1e6 * a.parted, 1e6 * when, 1e3 * a.way);
        assert_near(a.velocity / want, 1, 0.03);
        assert_near(a.parted, when, 5e-6);
    }
}

/* U11: the same beyond acoustics, against an independent program in one dimension (Tait, cut at 0, 600 - 800 cells):
 * speed 3 %, way 5 %. */
static void test_plates(void **state)
{
    (void)state;
    const plate_row rows[] = {
        { 22.94, 2.24, 29.5e6, 7.8e-3, 225e-6, 35.4 },  { 22.94, 8.10, 29.5e6, 6.8e-3, 225e-6, 31.1 },
        { 22.94, 39.25, 29.5e6, 4.5e-3, 225e-6, 21.0 }, { 43.18, 2.24, 51.1e6, 14.1e-3, 225e-6, 61.6 },
        { 43.18, 8.10, 51.1e6, 12.3e-3, 225e-6, 54.4 }, { 43.18, 39.25, 51.1e6, 8.3e-3, 225e-6, 37.7 },
        { 22.94, 3.24, 31.0e6, 5.2e-3, 154e-6, 34.5 },  { 43.18, 3.24, 56.9e6, 9.5e-3, 161e-6, 59.8 },
        { 70, 3.24, 88.3e6, 14.9e-3, 169e-6, 89.3 },    { 100, 3.24, 121e6, 20.7e-3, 177e-6, 118 },
    };
    for (int k = 0; k < (full_tests() ? 10 : 7); k += full_tests() ? 1 : 6) {
        const plate_answer a = drive_plate(&rows[k], 0.5, full_tests() ? 1000 : 500);
        print_message("%g m/s, %.2f kg/m2: %.2f m/s (%.2f), parted after %.1f us, way %.2f mm (%.2f)\n", rows[k].v0,
                      rows[k].plate, a.velocity, rows[k].velocity, 1e6 * a.parted, 1e3 * a.way, 1e3 * rows[k].way);
        assert_near(a.velocity / rows[k].velocity, 1, 0.03);
        assert_near(a.way / rows[k].way, 1, 0.05);
    }
}

static void assert_refused(mpm_tube_setup s, const char *word)
{
    mpm_tube *t;
    const status refused = mpm_tube_create(&s, &t);
    assert_int_equal(refused.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(refused.text, word));
    assert_null(t);
}

static void test_refused(void **state)
{
    (void)state;
    const mpm_material m = water(), metal = scene_copper();
    const mpm_tube_setup good = { &m, MASS, 10, 0.1, TUBE_PLATE, 1, 10 };
    mpm_tube_setup bad[5] = { good, good, good, good, good };
    bad[0].length = 0, bad[1].piston_mass = -1, bad[2].cells = 1, bad[3].plate_mass = 0, bad[4].fluid = &metal;
    const char *words[] = { "length", "piston_mass", "cells", "plate_mass", "no fluid" };
    for (int i = 0; i < 5; i++) assert_refused(bad[i], words[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_piston),  cmocka_unit_test(test_wears_off), cmocka_unit_test(test_wall),
        cmocka_unit_test(test_gauge),   cmocka_unit_test(test_taylor),    cmocka_unit_test(test_plates),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
