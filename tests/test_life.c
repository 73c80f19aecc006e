/* SPDX-License-Identifier: BSD-3-Clause */
/* Life by direction: the law against its closed answers, the field of a contact against integrals and published closed
 * forms, where the first direction goes under a wheel (the states of Ma et al. 2020), what a case is refused for. */
#include "coupling/study/life.h"
#include "program_common.h"

#include <float.h>

#define PI 3.14159265358979323846
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

/* ---- the first cut ---- */

static life_first first_of(int contact, double mu, double share, double nu, int cycle, fatigue_measure measure)
{
    case_life c = wheel;
    c.state = contact, c.friction = mu, c.traction_share = share;
    const contact_load l = load_of(c);
    const life_first_how how = { 1.0, nu, measure, cycle };
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
    for (int k = 0; k < 9; k++) {
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
    const life_first_how how = { 210e9, 0.25, FATIGUE_BOND, LIFE_PULSE },
                         soft = { 105e9, 0.25, FATIGUE_BOND, LIFE_PULSE };
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

/* ---- the program ---- */

static void refused(const char *set, const char *words)
{
    char command[600];
    snprintf(command, sizeof command, "life " PAPER " -o bad --quiet %s", set);
    assert_int_equal(run(command), 2);
    if (!contains("err.txt", words)) {
        char *errors;
        OK(host_file_read("err.txt", &errors, NULL));
        fail_msg("%s: not `%s` but %s", set, words, errors);
    }
    assert_false(exists("bad"));
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
    refused("--set life.half_length=none", "life.half_length");
}

static void test_program(void **state)
{
    (void)state;
    fresh_folder("paper");
    assert_int_equal(run("life " PAPER " -o paper/out --quiet --set output.report=yes"), 0);
    cJSON *s = summary_of("paper/out");
    assert_text(s, "kind", "life");
    assert_true(fabs(number(s, "life_first") / 5890.0 - 1.0) < 0.01);
    assert_true(fabs(number(s, "tangential_force") / number(s, "normal_force") - 0.3) < 1e-12);
    assert_true(contains("paper/out/report.html", "cycles to the first cut"));
    cJSON_Delete(s);
    assert_int_equal(run("check " PAPER " --expect paper/out"), 0);
    assert_int_equal(run("life " PAPER
                         " -o paper/table --quiet --set output.report=no --set life.wheel_load=none --set "
                         "life.pressure='1 GPa' --set life.profile=points --set 'life.points=[{at: -1, pressure: 0}, "
                         "{at: 0, pressure: 1}, {at: 1, pressure: 0}]'"),
                     0);
    s = summary_of("paper/table");
    assert_true(fabs(number(s, "normal_force") / 6e6 - 1.0) < 1e-12); /* a triangle of 1 GPa over 12 mm */
    cJSON_Delete(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_law),
        cmocka_unit_test(test_fans),
        cmocka_unit_test(test_stress_is_the_integral),
        cmocka_unit_test(test_displacement),
        cmocka_unit_test(test_contact),
        cmocka_unit_test(test_first_rows),
        cmocka_unit_test(test_crossing),
        cmocka_unit_test(test_scaling),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_program),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
