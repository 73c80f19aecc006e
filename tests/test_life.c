/* SPDX-License-Identifier: BSD-3-Clause */
/* Life by direction: the law against its closed answers, the field of a contact against integrals and published closed
 * forms, where the first direction goes under a wheel (the states of Ma et al. 2020), what a case is refused for. */
#include "base/constants.h"
#include "mpm/rest.h"
#include "program_common.h"

#include <float.h>

#define PAPER CASES "/rail_fatigue"

static const fatigue_law paper = { 426.0, 2.77, 0.0 };

/* ---- the law ---- */

/* (L-1) to the four digits of the reference. */
static void test_law(void **state)
{
    (void)state;
    static const double life[][2] = { { 5e-4, 3.269e6 }, { 1e-3, 4.793e5 }, { 2e-3, 7.026e4 }, { 4e-3, 1.030e4 },
                                      { 1e-2, 813.9 },   { 4.043e-3, 1e4 }, { 1.761e-3, 1e5 }, { 7.668e-4, 1e6 } };
    for (size_t i = 0; i < sizeof life / sizeof *life; i++)
        assert_true(fabs(mpm_fatigue_cycles(&paper, life[i][0]) / life[i][1] - 1.0) < 1e-3);
    const fatigue_law limited = { 426.0, 2.77, 1e-3 };
    assert_true(mpm_fatigue_rate(&limited, 1e-3) == 0.0 && isinf(mpm_fatigue_cycles(&limited, 1e-3)));
    assert_true(mpm_fatigue_rate(&limited, 1.1e-3) == mpm_fatigue_rate(&paper, 1.1e-3));
    assert_true(mpm_fatigue_range(FATIGUE_BOND, -3.0, -1.0) == 3.0); /* the cycle holds no load */
    assert_true(mpm_fatigue_range(FATIGUE_BOND, -3.0, 2.0) == 5.0 && mpm_fatigue_range(FATIGUE_SHEAR, 1.0, 2.0) == 2.0);
    assert_true(mpm_fatigue_range(FATIGUE_TENSION, -3.0, 2.0) == 2.0);
    assert_true(mpm_fatigue_range(FATIGUE_TENSION, -3.0, -1.0) == 0.0);
}

/* 28 bonds in 8 directions; shares and stiffness of every fan add up to 1, and sums of stiffness times cos 2a, sin 2a,
 * cos 4a, sin 4a vanish: the four conditions of isotropy in a plane. */
static void test_fans(void **state)
{
    (void)state;
    const fatigue_fan fans[] = { mpm_fatigue_fan_even(3), mpm_fatigue_fan_even(8), mpm_fatigue_fan_even(36),
                                 mpm_fatigue_fan_lattice() };
    for (size_t f = 0; f < sizeof fans / sizeof *fans; f++) {
        double sums[6] = { 0.0 };
        for (int k = 0; k < fans[f].n; k++) {
            const double a = fans[f].angle[k], w = fans[f].stiffness[k];
            sums[0] += fans[f].share[k] - 1.0 / fans[f].n, sums[1] += w - 1.0 / fans[f].n;
            sums[2] += w * cos(2 * a), sums[3] += w * sin(2 * a), sums[4] += w * cos(4 * a), sums[5] += w * sin(4 * a);
        }
        for (int i = 0; i < 6; i++) assert_true(fabs(sums[i]) < 1e-14);
    }
    const fatigue_fan *bonds = &fans[3];
    assert_int_equal(bonds->n, 8);
    for (int k = 0; k < bonds->n; k++) {
        const double turned = fmod(bonds->angle[k] + 1e-12, 0.5 * PI), count = 28.0 * bonds->share[k];
        const double want = turned < 1e-9 ? 6.0 : fabs(turned - 0.25 * PI) < 1e-9 ? 4.0 : 2.0;
        assert_true(fabs(count - want) < 1e-12);
    }
    /* a bar: the strain along it by both measures, none of shear at 45 degrees in equal tension both ways */
    const double bar[3] = { 1e-3, -0.25e-3, 0.0 }, both[3] = { 1e-3, 1e-3, 0.0 };
    const fatigue_fan *even = &fans[1];
    assert_true(mpm_fatigue_strain(even, 0, FATIGUE_BOND, 0.25, bar) == 1e-3);
    assert_true(fabs(fabs(mpm_fatigue_strain(even, 2, FATIGUE_SHEAR, 0.25, bar)) - 1e-3) < 1e-15);
    assert_true(fabs(mpm_fatigue_strain(even, 2, FATIGUE_SHEAR, 0.25, both)) < 1e-15);
    assert_true(fabs(mpm_fatigue_strain(even, 3, FATIGUE_TENSION, 0.25, both) - 1e-3) < 1e-15);
}

/* ---- the field ---- */

static const case_life wheel = { .profile = LIFE_HERTZ,
                                 .wheel_load = NAN,
                                 .pressure = 1.0,
                                 .half_length = 1.0,
                                 .half_width = NAN,
                                 .state = LIFE_FULL_SLIP,
                                 .friction = 0.3,
                                 .traction_share = 0.5 };

static contact_load load_of(case_life c)
{
    contact_load l;
    OK(life_contact_load(&c, &l));
    return l;
}

static case_life points_case(void)
{
    static case_life_point at[] = {
        { -1.0, 0.0, 0.0 }, { -0.6, 1.0, 0.1 }, { -0.1, 0.7, -0.2 }, { 0.4, 0.7, NAN }, { 1.0, 0.2, 0.0 }
    };
    case_life c = wheel;
    c.profile = LIFE_POINTS;
    c.points = (case_life_points){ 5, at };
    return c;
}

/* Flamant's and Cerruti's stress of a line force, summed over the face by Simpson's rule: in s = sin t on every piece,
 * so that an ellipse's ends are smooth.  With 2000 steps a piece the rule's error is below 1e-9 at this depth. */
static void summed(const contact_load *l, double x, double z, double stress[3])
{
    const int n = 2000;
    memset(stress, 0, 3 * sizeof *stress);
    for (int k = 0; k < l->n; k++) {
        contact_load one = { .n = 1, .half_length = l->half_length };
        one.piece[0] = l->piece[k];
        const double half = 0.5 * (one.piece[0].to - one.piece[0].from), middle = one.piece[0].from + half;
        for (int i = 0; i <= n; i++) {
            const double t = PI * ((double)i / n - 0.5), s = middle + half * (1.0 - 1e-15) * sin(t);
            const double weight = (i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0) * PI / (3.0 * n) * half * cos(t);
            const double u = x - s, r4 = (u * u + z * z) * (u * u + z * z);
            const double P = 2.0 * weight / PI * life_contact_pressure(&one, s) / r4;
            const double Q = 2.0 * weight / PI * life_contact_traction(&one, s) / r4;
            stress[0] -= P * u * u * z + Q * u * u * u;
            stress[1] -= P * z * z * z + Q * u * z * z;
            stress[2] -= P * u * z * z + Q * u * u * z;
        }
    }
}

static void test_stress_is_the_integral(void **state)
{
    (void)state;
    case_life carter = wheel, uniform = wheel;
    carter.state = LIFE_STICK_SLIP;
    uniform.profile = LIFE_UNIFORM;
    const contact_load loads[] = { load_of(wheel), load_of(carter), load_of(uniform), load_of(points_case()) };
    for (size_t i = 0; i < sizeof loads / sizeof *loads; i++)
        for (double x = -2.3; x < 2.4; x += 0.46)
            for (double z = 0.15; z < 3.0; z *= 2.0) {
                double got[3], want[3];
                life_contact_stress(&loads[i], x, z, got);
                summed(&loads[i], x, z, want);
                for (int q = 0; q < 3; q++)
                    if (!(fabs(got[q] - want[q]) < 1e-7))
                        fail_msg("load %zu at %g, %g: %g, not %g", i, x, z, got[q], want[q]);
            }
}

/* Its derivatives are the strain: central differences of 1e-4, whose error is of their square. */
static void test_displacement(void **state)
{
    (void)state;
    case_life carter = wheel;
    carter.state = LIFE_STICK_SLIP;
    const contact_load loads[] = { load_of(carter), load_of(points_case()) };
    const double h = 1e-4, E = 2.0, nu = 0.3;
    for (size_t i = 0; i < 2; i++)
        for (double x = -1.7; x < 1.8; x += 0.34)
            for (double z = 0.2; z < 3.0; z *= 2.0) {
                double stress[3], strain[3], u[4][2];
                life_contact_stress(&loads[i], x, z, stress);
                life_contact_strain(stress, E, nu, strain);
                for (int k = 0; k < 4; k++)
                    life_contact_displacement(&loads[i], x + (k == 0) * h - (k == 1) * h,
                                              z + (k == 2) * h - (k == 3) * h, E, nu, u[k]);
                assert_true(fabs((u[0][0] - u[1][0]) / (2 * h) - strain[0]) < 1e-6);
                assert_true(fabs((u[2][1] - u[3][1]) / (2 * h) - strain[1]) < 1e-6);
                assert_true(fabs((u[2][0] - u[3][0] + u[0][1] - u[1][1]) / (2 * h) - strain[2]) < 1e-6);
            }
}

/* F4 .. F7: forces; Johnson's figures of Hertz's contact; the face carries what is put on it. */
static void test_contact(void **state)
{
    (void)state;
    case_life c = wheel;
    double normal, tangential, s[3], most = 0.0, at = 0.0;
    c.wheel_load = 85e3, c.pressure = NAN, c.half_length = c.half_width = 6e-3;
    contact_load l = load_of(c);
    life_contact_forces(&l, &normal, &tangential);
    assert_true(fabs(l.peak / (3.0 * 85e3 / (2.0 * PI * 36e-6)) - 1.0) < 1e-12);
    assert_true(fabs(normal / (3.0 * 85e3 / (4.0 * 6e-3)) - 1.0) < 1e-12 &&
                fabs(tangential / (0.3 * normal) - 1) < 1e-12);
    c = wheel, c.state = LIFE_STICK_SLIP, c.traction_share = 0.64;
    l = load_of(c);
    life_contact_forces(&l, &normal, &tangential);
    assert_true(fabs(tangential / (0.64 * 0.3 * normal) - 1.0) < 1e-12);
    assert_true(life_contact_traction(&l, 0.3) == 0.3 * life_contact_pressure(&l, 0.3)); /* slip from x = 0.2 on */
    assert_true(life_contact_traction(&l, 0.1) < 0.29 * life_contact_pressure(&l, 0.1)); /* stick */
    for (double x = -0.95; x < 1.0; x += 0.19) {
        life_contact_stress(&l, x, 0.0, s);
        assert_true(fabs(s[1] + life_contact_pressure(&l, x)) < 1e-5); /* that deep it is taken: 1e-12 */
        assert_true(fabs(s[2] + life_contact_traction(&l, x)) < 1e-5);
    }
    c = wheel, c.state = LIFE_FRICTIONLESS;
    l = load_of(c);
    for (double z = 0.0; z < 2.0; z += 1e-3) {
        life_contact_stress(&l, 0.0, z, s);
        if (0.5 * (s[0] - s[1]) > most) most = 0.5 * (s[0] - s[1]), at = z;
        const double root = sqrt(1.0 + z * z); /* McEwen on the axis */
        assert_true(fabs(s[1] + 1.0 / root) < 1e-9 && fabs(s[0] + (1.0 + 2.0 * z * z) / root - 2.0 * z) < 1e-9);
    }
    assert_true(fabs(most - 0.300) < 5e-4 && fabs(at - 0.786) < 2e-3);
    life_contact_stress(&l, 0.87, 0.50, s);
    assert_true(fabs(fabs(s[2]) - 0.250) < 5e-4);
    l = load_of(wheel);
    life_contact_stress(&l, -1.0, 0.0, s);
    assert_true(fabs(s[0] / (2.0 * 0.3) - 1.0) < 1e-5);
}

/* A load that runs: nearly at rest it is the load at rest; K by its formula, which the strains on the face obey; the
 * speeds at which K is that of the reference (copper, and 0.5, 0.8, 0.9 of its Rayleigh waves). */
static void test_moving(void **state)
{
    (void)state;
    const double E = 124e9, nu = 0.34, rho = 8960.0, limit = life_contact_rayleigh(E, nu, rho);
    static const double K[][2] = { { 500.0, 1.04 }, { 1000.0, 1.18 }, { 1500.0, 1.62 }, { 1930.0, 3.94 } },
                        part[][2] = { { 0.5, 1.20 }, { 0.8, 2.10 }, { 0.9, 3.61 } };
    assert_true(fabs(limit - 2121.0) < 1.0 && fabs(life_contact_rayleigh(210e9, 0.3, 7850.0) - 2975.0) < 30.0);
    for (int i = 0; i < 7; i++) {
        const double v = i < 4 ? K[i][0] : part[i - 4][0] * limit, want = i < 4 ? K[i][1] : part[i - 4][1];
        const contact_speed s = life_contact_speed(E, nu, rho, v);
        if (!(fabs(life_contact_factor(&s) - want) < 0.006)) fail_msg("K(%g) = %g", v, life_contact_factor(&s));
    }
    case_life c = wheel;
    c.state = LIFE_STICK_SLIP, c.pressure = 1e9;
    const contact_load carter = load_of(c);
    const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), G = 0.5 * E / (1.0 + nu);
    const contact_speed slow = life_contact_speed(E, nu, rho, 10.0), fast = life_contact_speed(E, nu, rho, 1500.0);
    for (double x = -1.9; x < 2.0; x += 0.38)
        for (double z = 0.0; z < 3.0; z = 2.0 * z + 0.2) {
            double stress[3], at_rest[3], e[3];
            life_contact_stress(&carter, x, z, stress);
            life_contact_strain(stress, E, nu, at_rest);
            life_contact_moving(&carter, &slow, x, z, e);
            for (int q = 0; q < 3; q++) assert_true(fabs(e[q] - at_rest[q]) < 1e-3 * 1e9 / E);
            if (z > 0.0) continue;
            life_contact_moving(&carter, &fast, x, z, e); /* the face carries what is put on it */
            const double zz = lambda * (e[0] + e[1]) + 2.0 * G * e[1];
            assert_true(fabs(zz + life_contact_pressure(&carter, x)) < 1e-4 * 1e9);
            assert_true(fabs(G * e[2] + life_contact_traction(&carter, x)) < 1e-4 * 1e9);
        }
    double e[3];
    c = wheel, c.state = LIFE_FRICTIONLESS;
    const contact_load l = load_of(c);
    life_contact_moving(&l, &fast, 0.0, 0.0, e);
    assert_true(fabs((lambda * (e[0] + e[1]) + 2.0 * G * e[0]) + life_contact_factor(&fast)) < 1e-5);
    const life_first_how rest = { E, nu, FATIGUE_BOND, LIFE_PASSAGE, 0.0, rho },
                         run = { E, nu, FATIGUE_BOND, LIFE_PASSAGE, 1500.0, rho };
    assert_true(life_first_cut(&l, &run).range > 1.3 * life_first_cut(&l, &rest).range);
}

/* ---- the first cut ---- */

static life_first first_of(int contact, double mu, double share, double nu, int cycle, fatigue_measure measure)
{
    case_life c = wheel;
    c.state = contact, c.friction = mu, c.traction_share = share;
    const contact_load l = load_of(c);
    const life_first_how how = { 1.0, nu, measure, cycle, 0.0, NAN };
    return life_first_cut(&l, &how);
}

/* F8, F9: strain 3 %, place 0.1 a, direction 10 degrees; the two halves of a symmetric answer are one. */
static void test_first_rows(void **state)
{
    (void)state;
    static const struct {
        int contact;
        double mu, share, pulse[4], passage[3]; /* range, x, z, direction; range, z, direction */
    } rows[] = {
        { LIFE_FRICTIONLESS, 0.0, 0.0, { 0.737, 0.0, 0.39, 90 }, { 0.790, 0.35, 75 } },
        { LIFE_FULL_SLIP, 0.1, 0.0, { 0.753, 0.10, 0.0, 42 }, { 0.881, 0.0, 20 } },
        { LIFE_FULL_SLIP, 0.2, 0.0, { 0.887, 0.20, 0.0, 39 }, { 1.166, 0.0, 15 } },
        { LIFE_FULL_SLIP, 0.3, 0.0, { 1.028, 0.29, 0.0, 37 }, { 1.473, 0.0, 15 } },
        { LIFE_FULL_SLIP, 0.4, 0.0, { 1.173, 0.38, 0.0, 34 }, { 1.793, 0.0, 10 } },
        { LIFE_FULL_SLIP, 0.5, 0.0, { 1.324, 0.45, 0.0, 32 }, { 2.130, 0.0, 10 } },
        { LIFE_STICK_SLIP, 0.3, 0.5, { 0.882, 0.45, 0.0, 47 }, { 0.966, 0.0, 30 } },
        { LIFE_STICK_SLIP, 0.3, 0.9, { 1.012, 0.29, 0.0, 38 }, { 1.292, 0.0, 20 } },
        { LIFE_STICK_SLIP, 0.5, 0.5, { 1.106, 0.54, 0.0, 40 }, { 1.287, 0.0, 25 } },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double mu = rows[i].mu, *p = rows[i].pulse, *q = rows[i].passage;
        const life_first one = first_of(rows[i].contact, mu, rows[i].share, 0.25, LIFE_PULSE, FATIGUE_BOND);
        const life_first run = first_of(rows[i].contact, mu, rows[i].share, 0.25, LIFE_PASSAGE, FATIGUE_BOND);
        const double along = run.angle > 0.5 * PI && mu == 0.0 ? PI - run.angle : run.angle;
        if (!(fabs(one.range / p[0] - 1.0) < 0.002 && fabs(one.position - p[1]) < 0.02 &&
              fabs(one.depth - p[2]) < 0.02 && fabs(one.angle * 180.0 / PI - p[3]) < 1.5))
            fail_msg("pulse, row %zu: %g at %g, %g, %g", i, one.range, one.position, one.depth, one.angle);
        if (!(fabs(run.range / q[0] - 1.0) < 0.002 && fabs(run.depth - q[1]) < 0.02 &&
              fabs(along * 180.0 / PI - q[2]) < 3.5 && isnan(run.position)))
            fail_msg("passage, row %zu: %g at %g, %g", i, run.range, run.depth, run.angle);
    }
    const life_first nought = first_of(LIFE_FRICTIONLESS, 0.0, 0.0, 0.3, LIFE_PULSE, FATIGUE_BOND);
    assert_true(fabs(nought.range - 0.681) < 0.001 && fabs(nought.depth - 0.46) < 0.01);
}

/* F10: the friction at which the first cut comes to the face. */
static double crossing(double nu, int cycle, fatigue_measure measure)
{
    double lo = 0.0, hi = 0.6;
    for (int k = 0; k < 8; k++) {
        const double mu = 0.5 * (lo + hi);
        if (first_of(LIFE_FULL_SLIP, mu, 0.0, nu, cycle, measure).depth < 0.02)
            hi = mu;
        else
            lo = mu;
    }
    return 0.5 * (lo + hi);
}

static void test_crossing(void **state)
{
    (void)state;
    assert_true(fabs(crossing(0.25, LIFE_PULSE, FATIGUE_BOND) - 0.095) < 0.005);
    assert_true(fabs(crossing(0.30, LIFE_PULSE, FATIGUE_BOND) - 0.133) < 0.005);
    assert_true(fabs(crossing(0.25, LIFE_PASSAGE, FATIGUE_BOND) - 0.07) < 0.01);
    assert_true(fabs(crossing(0.30, LIFE_PASSAGE, FATIGUE_BOND) - 0.10) < 0.01);
    assert_true(fabs(crossing(0.25, LIFE_PULSE, FATIGUE_TENSION) - 0.07) < 0.01);
    assert_true(fabs(crossing(0.30, LIFE_PULSE, FATIGUE_SHEAR) - 0.375) < 0.01);
}

/* F12 .. F14: life over friction, load, modulus and size, from the ranges. */
static void test_scaling(void **state)
{
    (void)state;
    static const double pulse[2] = { 0.40, 0.20 }, passage[2] = { 0.18, 0.064 };
    for (int cycle = LIFE_PULSE; cycle <= LIFE_PASSAGE; cycle++) {
        const double *want = cycle == LIFE_PULSE ? pulse : passage;
        double last = INFINITY, first = NAN;
        for (int k = 0; k <= 5; k++) {
            const int contact = k ? LIFE_FULL_SLIP : LIFE_FRICTIONLESS;
            const life_first cut = first_of(contact, 0.1 * k, 0.0, 0.25, cycle, FATIGUE_BOND);
            const double N = mpm_fatigue_cycles(&paper, 1e-3 * cut.range);
            assert_true(N < last);
            last = N;
            if (k == 0) first = N;
            if (k == 3) assert_true(fabs(N / first / want[0] - 1.0) < 0.03);
        }
        assert_true(fabs(last / first / want[1] - 1.0) < 0.03);
    }
    case_life c = wheel;
    c.pressure = NAN, c.wheel_load = 85e3, c.half_length = c.half_width = 6e-3;
    const life_first_how how = { 210e9, 0.25, FATIGUE_BOND, LIFE_PULSE, 0.0, NAN },
                         soft = { 105e9, 0.25, FATIGUE_BOND, LIFE_PULSE, 0.0, NAN };
    contact_load l = load_of(c);
    const life_first one = life_first_cut(&l, &how), yielding = life_first_cut(&l, &soft);
    const double N = mpm_fatigue_cycles(&paper, one.range);
    assert_true(fabs(mpm_fatigue_cycles(&paper, yielding.range) / N * pow(2.0, 2.77) - 1.0) < 1e-6);
    c.wheel_load *= 1.1;
    l = load_of(c);
    assert_true(fabs(mpm_fatigue_cycles(&paper, life_first_cut(&l, &how).range) / N - 0.768) < 5e-4);
    c.wheel_load = 4.0 * 85e3, c.half_length = c.half_width = 12e-3; /* the same pressure on twice the lengths */
    l = load_of(c);
    const life_first twice = life_first_cut(&l, &how);
    assert_true(fabs(twice.range / one.range - 1.0) < 1e-9 && fabs(twice.position / one.position - 2.0) < 1e-3);
}

/* ---- many points ---- */

static fatigue_points points_of(int n, int directions)
{
    const fatigue_fan fan = mpm_fatigue_fan_even(directions);
    fatigue_points f;
    OK(mpm_fatigue_create(n, &fan, &paper, &f));
    return f;
}

/* F2: two ranges in any order: the parts of a life that they take add up to 1. */
static void test_no_order(void **state)
{
    (void)state;
    static const double ranges[2] = { 1.5e-3, 4e-3 };
    for (int order = 0; order < 2; order++) {
        fatigue_points f = points_of(1, 3);
        const double n = 0.37 * mpm_fatigue_cycles(&paper, ranges[order]);
        mpm_fatigue_set_range(&f, 0, 0, ranges[order]);
        mpm_fatigue_set_range(&f, 0, 1, pow(1.0 / (n * paper.A), 1.0 / paper.m)); /* is cut after n: a change there */
        OK(mpm_fatigue_jump(&f, 0.0));
        assert_true(f.n_cuts == 1 && f.cut[0].direction == 1 && fabs(f.cycles / n - 1.0) < 1e-12);
        mpm_fatigue_set_range(&f, 0, 0, ranges[1 - order]);
        OK(mpm_fatigue_jump(&f, 0.0));
        const double spent = n / mpm_fatigue_cycles(&paper, ranges[order]) +
                             (f.cycles - n) / mpm_fatigue_cycles(&paper, ranges[1 - order]);
        assert_true(f.n_cuts == 2 && f.cut[1].direction == 0 && fabs(spent - 1.0) < 1e-12);
        mpm_fatigue_free(&f);
    }
}

/* A coarse model with redistribution: every cut of a point raises the ranges of its own other directions by half and of
 * its neighbours' by a fifth. */
enum { CHAIN = 5, SPOKES = 4 };
static void chain_ranges(const bool *cut, double *range)
{
    for (int p = 0; p < CHAIN; p++)
        for (int d = 0; d < SPOKES; d++) {
            double r = 3e-3 * (1.0 + 0.13 * p + 0.07 * d * d);
            for (int q = 0; q < CHAIN; q++)
                for (int e = 0; e < SPOKES; e++)
                    if (cut[q * SPOKES + e]) r *= q == p ? 1.5 : abs(q - p) == 1 ? 1.2 : 1.0;
            range[p * SPOKES + d] = r;
        }
}

/* F3, F20: jumps give the order of cuts and the cycles that counting cycle by cycle gives (the last of them in part);
 * in between every life is 1 less what the ranges before each cut have taken. */
static void test_jumps_count_cycles(void **state)
{
    (void)state;
    enum { ALL = CHAIN * SPOKES };
    fatigue_points f = points_of(CHAIN, SPOKES);
    double range[ALL], life[ALL], cycles = 0.0;
    for (int k = 0; k < ALL; k++) life[k] = 1.0;
    for (int n = 0; n < ALL; n++) {
        const double before = f.cycles;
        chain_ranges(f.is_cut, range);
        for (int k = 0; k < ALL; k++) mpm_fatigue_set_range(&f, k / SPOKES, k % SPOKES, range[k]);
        const double wait = mpm_fatigue_wait(&f);
        OK(mpm_fatigue_jump(&f, 0.0));
        assert_int_equal(f.n_cuts, n + 1);
        assert_true(fabs(f.cycles - before - wait) <= 1e-12 * f.cycles && f.cut[n].cycles == f.cycles);
        int next = -1;
        for (double part = 1.0; next < 0; cycles += part) { /* a cycle at a time */
            part = 1.0;
            for (int k = 0; k < ALL; k++)
                if (life[k] > 0.0 && life[k] / mpm_fatigue_rate(&paper, range[k]) <= part)
                    next = k, part = life[k] / mpm_fatigue_rate(&paper, range[k]);
            for (int k = 0; k < ALL; k++)
                if (life[k] > 0.0) life[k] -= part * mpm_fatigue_rate(&paper, range[k]);
            if (next >= 0) life[next] = 0.0;
        }
        assert_int_equal(f.cut[n].point * SPOKES + f.cut[n].direction, next);
        assert_true(fabs(f.cycles / cycles - 1.0) < 1e-9);
        for (int k = 0; k < ALL; k++) {
            assert_true(f.life[k] >= 0.0 && f.is_cut[k] == (life[k] == 0.0));
            assert_true(fabs(f.life[k] - life[k]) < 1e-9);
        }
    }
    for (int p = 0; p < CHAIN; p++) assert_true(fabs(f.index[p] - 1.0) < 1e-12);
    assert_int_equal(mpm_fatigue_jump(&f, 0.0).code, STATUS_BAD_INPUT);
    mpm_fatigue_free(&f);
}

/* A batch takes what follows within its share of the cycles, in the order of time, and no more; `alone` is the time at
 * which the share of cut directions comes to the limit with these ranges. */
static void test_batch(void **state)
{
    (void)state;
    fatigue_points f = points_of(2, 4);
    const double at[8] = { 1000.0, 1004.0, 1009.9, 1010.2, 1000.0 * (1.0 + 1e-10), 3000.0, 1018.0, 5000.0 };
    for (int k = 0; k < 8; k++) mpm_fatigue_set_range(&f, k / 4, k % 4, pow(1.0 / (at[k] * paper.A), 1.0 / paper.m));
    assert_true(fabs(mpm_fatigue_alone(&f, 0, 0.5) / 1004.0 - 1.0) < 1e-12);
    assert_true(fabs(mpm_fatigue_alone(&f, 1, 0.75) / 3000.0 - 1.0) < 1e-12);
    OK(mpm_fatigue_jump(&f, 0.0)); /* those that are one but for rounding */
    assert_true(f.n_cuts == 2 && f.cut[0].point == 0 && f.cut[1].point == 1 && fabs(f.cycles - 1000.0) < 1e-6);
    assert_true(fabs(mpm_fatigue_alone(&f, 0, 0.5) / 1004.0 - 1.0) < 1e-12); /* what is cut counts */
    assert_true(fabs(mpm_fatigue_alone(&f, 1, 0.75) / 3000.0 - 1.0) < 1e-12);
    assert_true(mpm_fatigue_alone(&f, 1, 0.25) == f.cycles);
    OK(mpm_fatigue_jump(&f, 0.01));
    assert_true(f.n_cuts == 5 && fabs(f.cut[2].cycles - 1004.0) < 1e-6 && fabs(f.cut[4].cycles - 1010.2) < 1e-6);
    assert_true(fabs(f.index[0] - 1.0) < 1e-12 && fabs(f.index[1] - 0.25) < 1e-12);
    mpm_fatigue_free(&f);
}

/* ---- equilibrium ---- */

/* A field that is linear in x and z is in equilibrium on any grid: of an anisotropic solid too, and a cell's size drops
 * out.  The load is the traction of its stress on the face. */
static void test_patch(void **state)
{
    (void)state;
    enum { NX = 24, NZ = 16 };
    const rest_elastic solid = { 3.0, 2.0, 0.9, 0.8, 0.2, -0.1 };
    const double h = 0.25, e[3] = { 1e-3, -4e-4, 7e-4 };
    const double zz = solid.xx_zz * e[0] + solid.zz * e[1] + solid.zz_shear * e[2];
    const double xz = solid.xx_shear * e[0] + solid.zz_shear * e[1] + solid.shear * e[2];
    mpm_rest *r;
    int iterations = 0;
    OK(mpm_rest_create(NX, NZ, h, &solid, 1, &r));
    double *u = mpm_rest_displacement(r), *f = mpm_rest_forces(r);
    for (int j = 0; j <= NZ; j++)
        for (int i = 0; i <= NX; i++) {
            const bool held = i == 0 || i == NX || j == NZ;
            u[2 * (j * (NX + 1) + i)] = held ? e[0] * i * h + 0.5 * e[2] * j * h : 0.0;
            u[2 * (j * (NX + 1) + i) + 1] = held ? e[1] * j * h + 0.5 * e[2] * i * h : 0.0;
        }
    for (int i = 0; i <= NX; i++) f[2 * i] = -h * xz, f[2 * i + 1] = -h * zz;
    OK(mpm_rest_solve(r, 1e-11, 200, &iterations));
    for (int j = 0; j < NZ; j++)
        for (int i = 0; i < NX; i++) {
            double strain[3];
            mpm_rest_strain(r, i, j, strain);
            for (int q = 0; q < 3; q++) assert_true(fabs(strain[q] - e[q]) < 1e-11);
            assert_true(fabs(mpm_rest_face_strain(r, i) - e[0]) < 1e-11);
        }
    mpm_rest_free(r);
}

static life_crack_how crack_how(const contact_load *l, int cycle, int cells, int most_cuts)
{
    return (life_crack_how){ .load = l,
                             .how = { 210e9, 0.25, FATIGUE_BOND, cycle, 0.0, NAN },
                             .law = paper,
                             .fan = mpm_fatigue_fan_even(36),
                             .cells = cells,
                             .wide = 3.2,
                             .deep = 3.2,
                             .limit = 0.5,
                             .batch = 0.01,
                             .most_cuts = most_cuts,
                             .threads = 1 };
}

static life_crack crack_of(int contact, double mu, int cycle, int cells, int most_cuts)
{
    case_life c = wheel;
    life_crack out;
    c.pressure = 1e9, c.half_length = 6e-3, c.state = contact, c.friction = mu;
    const contact_load l = load_of(c);
    const life_crack_how how = crack_how(&l, cycle, cells, most_cuts);
    OK(life_crack_find(&how, &out));
    return out;
}

/* F6, F18: the stress of the grid is that of the half space, to 2 % of the peak pressure at a / cell = 20, falling with
 * the cell; the first cut is that of the closed field. */
static void test_field(void **state)
{
    (void)state;
    for (int contact = LIFE_FRICTIONLESS; contact <= LIFE_FULL_SLIP; contact++) {
        life_crack coarse = crack_of(contact, 0.3, LIFE_PULSE, 10, 0), fine = crack_of(contact, 0.3, LIFE_PULSE, 20, 0);
        assert_true(coarse.field_error < 0.02 && fine.field_error < 0.5 * coarse.field_error);
        assert_true(fine.iterations <= 6 && fine.solves == 1 && fine.cuts == 0 && isnan(fine.life));
        assert_true(fabs(coarse.first / fine.first - 1.0) < 0.05 && fine.alone > fine.first);
        life_crack_free(&coarse), life_crack_free(&fine);
    }
    life_crack passage = crack_of(LIFE_FULL_SLIP, 0.5, LIFE_PASSAGE, 20, 0);
    const life_first closed = first_of(LIFE_FULL_SLIP, 0.5, 0.0, 0.25, LIFE_PASSAGE, FATIGUE_BOND);
    assert_true(fabs(passage.first / mpm_fatigue_cycles(&paper, closed.range * 1e9 / 210e9) - 1.0) < 0.02);
    life_crack_free(&passage);
}

/* ---- to a crack ---- */

/* A passage without friction cracks below the face, between the first cut and the life without redistribution; with
 * a high one at the face.  Cuts of a pulse under the patch are closed by its pressure, and nothing is redistributed. */
static void test_crack(void **state)
{
    (void)state;
    life_crack deep = crack_of(LIFE_FRICTIONLESS, 0.0, LIFE_PASSAGE, 8, 1000000);
    assert_true(deep.life > deep.first && deep.life < 0.99 * deep.alone && isnan(deep.position));
    assert_true(deep.depth > 0.2 * 6e-3 && deep.depth < 0.6 * 6e-3 && deep.cuts > 18);
    life_crack face = crack_of(LIFE_FULL_SLIP, 0.5, LIFE_PASSAGE, 8, 1000000);
    assert_true(face.depth == 0.0 && face.life > face.first && face.life < 0.9 * face.alone && face.life < deep.life);
    life_crack pulse = crack_of(LIFE_FRICTIONLESS, 0.0, LIFE_PULSE, 6, 1000000);
    assert_true(fabs(pulse.life / pulse.alone - 1.0) < 1e-9 && pulse.depth == 0.0);
    assert_true(pulse.cuts > 10 * pulse.solves);
    for (int i = 0; i < pulse.nx; i++) /* F16: symmetric about the middle */
        for (int j = 0; j < pulse.nz; j++) {
            const int here = i * pulse.nz + j, mirror = (pulse.nx - 1 - i) * pulse.nz + j;
            assert_true(fabs(pulse.index[here] - pulse.index[mirror]) < 1e-9);
            assert_true(fabs(pulse.least_life[here] - pulse.least_life[mirror]) < 1e-6);
        }
    life_crack_free(&deep), life_crack_free(&face), life_crack_free(&pulse);
}

/* Steps of 1 % and of 5 % of the cycles change the life by less than 2 %; those of a pulse take ten times fewer
 * solutions than cuts, those of a passage, whose cuts open, in steps of 5 % six times fewer than cut by cut (ten times
 * on the case's cells, docs/validation/fatigue.md).  Cuts that open redistribute: measure tension, at the trailing
 * edge. */
static void test_batches(void **state)
{
    (void)state;
    case_life c = wheel;
    life_crack one, several;
    c.pressure = 1e9, c.half_length = 6e-3;
    const contact_load l = load_of(c);
    life_crack_how how = crack_how(&l, LIFE_PULSE, 6, 1000000);
    OK(life_crack_find(&how, &several));
    how.batch = 0.0;
    OK(life_crack_find(&how, &one));
    assert_true(fabs(several.life / one.life - 1.0) < 0.02 && 10 * several.solves <= one.cuts);
    life_crack_free(&one), life_crack_free(&several);
    how.batch = 0.1; /* several cuts of a point in one step, in their order: nothing is redistributed */
    OK(life_crack_find(&how, &several));
    assert_true(fabs(several.life / several.alone - 1.0) < 1e-9);
    life_crack_free(&several);
    how.batch = 0.0;
    how.how.cycle = LIFE_PASSAGE;
    OK(life_crack_find(&how, &one));
    how.batch = 0.01;
    OK(life_crack_find(&how, &several));
    assert_true(fabs(several.life / one.life - 1.0) < 0.02 && several.solves < one.solves);
    life_crack_free(&one), life_crack_free(&several);
    c.friction = 0.1;
    const contact_load smooth = load_of(c);
    how = crack_how(&smooth, LIFE_PASSAGE, 8, 1000000);
    how.batch = 0.0;
    OK(life_crack_find(&how, &one));
    how.batch = 0.05;
    OK(life_crack_find(&how, &several));
    print_message("passage: %d solutions for %d cuts, cut by cut %d for %d; life %.4f of that\n", several.solves,
                  several.cuts, one.solves, one.cuts, several.life / one.life);
    assert_true(fabs(several.life / one.life - 1.0) < 0.02 && 6 * several.solves <= one.solves);
    life_crack_free(&one), life_crack_free(&several);
    how = crack_how(&l, LIFE_PULSE, 6, 1000000);
    how.how.measure = FATIGUE_TENSION;
    OK(life_crack_find(&how, &several));
    assert_true(several.life < 0.5 * several.alone && several.depth == 0.0);
    assert_true(several.position < -0.9 * 6e-3 && several.position > -1.2 * 6e-3);
    life_crack_free(&several);
}

/* The same bits on one thread, two and three: with cuts that open. */
static void test_threads(void **state)
{
    (void)state;
    case_life c = wheel;
    life_crack of[3];
    c.pressure = 1e9, c.half_length = 6e-3;
    const contact_load l = load_of(c);
    for (int k = 0; k < 3; k++) {
        life_crack_how how = crack_how(&l, LIFE_PASSAGE, 6, 1000000);
        how.threads = k + 1, how.how.poisson = 0.3;
        OK(life_crack_find(&how, &of[k]));
        assert_true(of[0].life == of[k].life && of[0].iterations == of[k].iterations && of[0].cuts == of[k].cuts);
        assert_true(of[k].cuts > 10 && of[k].iterations > 20 && of[0].field_error == of[k].field_error);
        assert_memory_equal(of[0].least_life, of[k].least_life,
                            2 * (size_t)of[0].nx * (size_t)of[0].nz * sizeof *of[0].least_life);
    }
    for (int k = 0; k < 3; k++) life_crack_free(&of[k]);
}

/* ---- the program ---- */

static void refused(const char *set, const char *words)
{
    char command[600];
    snprintf(command, sizeof command, "life " PAPER " -o bad --quiet %s", set);
    assert_refused(command, "bad", words);
}

static void test_refused(void **state)
{
    (void)state;
    assert_int_equal(system("rm -rf bad"), 0); /* of a former run of this test */
    refused("--set life.wheel_load=none", "how large is the load?");
    refused("--set life.pressure='1 GPa'", "exclude each other");
    refused("--set life.half_width=none", "wheel_load needs half_width");
    refused("--set life.profile=uniform", "wheel_load is that of profile: hertz");
    refused("--set life.wheel_load=none --set life.pressure='1 GPa' --set life.profile=uniform --set "
            "life.state=stick_slip",
            "stick_slip is Carter's");
    refused("--set life.wheel_load=none --set life.pressure='1 GPa' --set life.profile=uniform",
            "makes the strain there infinite");
    refused("--set life.wheel_load=none --set life.pressure='1 GPa' --set life.profile=points", "needs the list");
    refused("--set life.wheel_load=none --set life.pressure='1 GPa' --set life.profile=points --set "
            "'life.points=[{at: -1, pressure: 0}, {at: 0.5, pressure: 1}, {at: 0.5, pressure: 0}]'",
            "life.points[2].at = 0.5: must lie beyond");
    refused("--set 'life.points=[{at: -1, pressure: 0}, {at: 1, pressure: 0}]'", "profile: points alone");
    refused("--set life.material=steel_4340", "fatigue_A");
    refused("--set life.speed='100 m/s'", "speed is that of cycle: passage");
    refused("--set life.speed='3.1 km/s' --set life.cycle=passage --set life.until=first", "speed of Rayleigh waves");
    refused("--set life.half_length=none", "life.half_length");
}

/* What a contact does not read is said where it is given, and used.yaml has the value of no effect: read back, it is
 * silent. */
static void test_idle_friction(void **state)
{
    (void)state;
    static const struct {
        const char *set, *says;
    } idle[] = {
        { "--set life.state=frictionless",
          "/case.yaml:10:13: life.friction = 0.3 has no effect with life.state = fric" },
        { "--set life.state=frictionless --set life.friction=0.1", "--set life.friction=0.1: life.friction = 0.1 has" },
        { "--set life.traction_share=0.2", "life.traction_share = 0.2 has no effect with life.state = full_slip" },
    };
    for (size_t k = 0; k < sizeof idle / sizeof idle[0]; k++) {
        char command[300];
        snprintf(command, sizeof command, "check " PAPER " %s", idle[k].set);
        assert_int_equal(run(command), 0);
        if (!contains("out.txt", idle[k].says)) fail_msg("not said: %s", idle[k].says);
    }
    assert_int_equal(run("check " PAPER " --set life.state=stick_slip --set life.traction_share=0.2"), 0);
    assert_false(contains("out.txt", "no effect"));
    assert_int_equal(run("life " PAPER " -o idle --force --quiet --set life.state=frictionless --set life.until=first"),
                     0);
    assert_int_equal(run("check idle/used.yaml"), 0);
    assert_false(contains("out.txt", "no effect"));
}

/* A pressure that no metal carries warns at its key; what it may carry is its hardness, three times its flow stress, or
 * 0.04 of Young's modulus, 8.4 GPa of this steel. */
static void test_too_much_pressure(void **state)
{
    (void)state;
#define OWN                                                                                                         \
    " --set 'materials=[{name: own, density: 7850 kg/m^3, youngs_modulus: 210 GPa, poisson: 0.25, fatigue_A: 426, " \
    "fatigue_m: 2.77, %s}]' --set life.material=own "
    static const struct {
        const char *constants, *load;
        double least; /* wheel_load that warns; 75.4 kN is 1 GPa [kN] */
    } own[] = { { "hardness: 2 GPa", "--set life.wheel_load='%g kN'", 2.0 * 75.398 },
                { "yield_A: 400 MPa, hardening_B: 0 Pa, hardening_n: 1", "--set life.wheel_load='%g kN'",
                  1.2 * 75.398 },
                { "expansion: 1e-5 1/K", "--set life.wheel_load='%g kN'", 8.4 * 75.398 } };
    for (size_t k = 0; k < sizeof own / sizeof own[0]; k++)
        for (int above = 0; above < 2; above++) {
            char command[700], load[60], material[400];
            snprintf(load, sizeof load, own[k].load, own[k].least * (above ? 1.01 : 0.99));
            snprintf(material, sizeof material, OWN, own[k].constants);
            snprintf(command, sizeof command, "check " PAPER "%s%s", material, load);
            assert_int_equal(run(command), 0);
            assert_int_equal(contains("out.txt", "is the unit right?"), above);
        }
#undef OWN
    assert_int_equal(run("check " PAPER " --set life.wheel_load='75.4 MN'"), 0);
    assert_true(contains("out.txt", "--set life.wheel_load=75.4 MN: life.wheel_load: 1e+03 GPa at the middle"));
    assert_int_equal(run("check " PAPER), 0);
    assert_false(contains("out.txt", "is the unit right?"));
    assert_int_equal(run("check " PAPER " --set life.wheel_load=none --set life.pressure='1000 GPa'"), 0);
    assert_true(contains("out.txt", "--set life.pressure=1000 GPa: life.pressure: 1e+03 GPa"));
}

static void test_program(void **state)
{
    (void)state;
    fresh_folder("paper");
    assert_int_equal(run("life " PAPER " -o paper/out --quiet --threads 1 --set output.report=yes"), 0);
    cJSON *s = summary_of("paper/out");
    assert_text(s, "kind", "life");
    assert_true(fabs(number(s, "life_first") / 5890.0 - 1.0) < 0.01);
    assert_true(fabs(number(s, "tangential_force") / number(s, "normal_force") - 0.3) < 1e-12);
    assert_true(number(s, "life") > number(s, "grid_first") && number(s, "life_depth") == 0.0);
    assert_true(contains("paper/out/report.html", "The first damage is done after 5900 loads"));
    cJSON_Delete(s);
    assert_int_equal(run("check " PAPER " --expect paper/out"), 0);
    assert_int_equal(
        run("life " PAPER
            " -o paper/table --quiet --set output.report=no --set life.until=first --set life.wheel_load=none --set "
            "life.pressure='1 GPa' --set life.profile=points --set 'life.points=[{at: -1, pressure: 0}, "
            "{at: 0, pressure: 1}, {at: 1, pressure: 0}]'"),
        0);
    s = summary_of("paper/table");
    assert_true(isnan(number(s, "life")));
    assert_true(fabs(number(s, "normal_force") / 6e6 - 1.0) < 1e-12); /* a triangle of 1 GPa over 12 mm */
    cJSON_Delete(s);
}

/* The last was stopped before it had a crack. */
static void test_same_bits(void **state)
{
    (void)state;
    static const char *const cycle[2] = { "pulse", "passage" };
    fresh_folder("bits");
    for (int c = 0; c < 2; c++) {
        char folder[40], arguments[400];
        snprintf(folder, sizeof folder, "bits/%s", cycle[c]);
        snprintf(arguments, sizeof arguments,
                 "life " PAPER
                 " --set output.report=no --set life.friction=0.5 --set life.cells_per_half_length=8 --set "
                 "life.cycle=%s",
                 cycle[c]);
        cJSON *s = same_on_threads(arguments, folder);
        assert_true(number(s, "life") > number(s, "life_first") && number(s, "solves") > 1.0);
        cJSON_Delete(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_law),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_stress_is_the_integral),
        cmocka_unit_test(test_displacement),
        cmocka_unit_test(test_contact),
        cmocka_unit_test(test_moving),
        cmocka_unit_test(test_first_rows),
        cmocka_unit_test(test_crossing),
        cmocka_unit_test(test_scaling),
        cmocka_unit_test(test_no_order),
        cmocka_unit_test(test_jumps_count_cycles),
        cmocka_unit_test(test_batch),
        cmocka_unit_test(test_patch),
        cmocka_unit_test(test_field),
        cmocka_unit_test(test_crack),
        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_idle_friction),
        cmocka_unit_test(test_too_much_pressure),
        cmocka_unit_test(test_program),
        cmocka_unit_test(test_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
