/* SPDX-License-Identifier: BSD-3-Clause */
/* Circuits no one would build: the energy closes, or the refusal says at which time and what to try. */
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "full_common.h"
#include "random_common.h"

enum { MAX_MODULES = 2000 };

static circuit_shot_module modules[MAX_MODULES];
static shot_notes notes;

static status run(const circuit_shot_config *c, circuit_shot_summary *out)
{
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notes_sink(&notes);
    TRY(circuit_shot_create(c, &s));
    const status done = circuit_shot_advance(s, INFINITY, &sink);
    *out = circuit_shot_result(s);
    circuit_shot_free(s);
    return done;
}

/* Quarter periods from 1 us to 1 s, resistances from 1e-9 ohm, every option of a module, simultaneous firing. */
static circuit_shot_module any_module(uint64_t *seed)
{
    circuit_shot_module m =
        unit_200kJ(1 + (int)(3.0 * random_between(seed, 0.0, 1.0)), floor(5.0 * random_between(seed, 0.0, 1.0)) * 4e-4);
    const double tau = random_log_between(seed, 1e-6, 1.0) / 1.5708;
    m.inductance = random_log_between(seed, fmax(1e-8, tau * tau), fmax(1e-7, fmin(1e-3, 1e3 * tau)));
    m.capacitance = fmin(fmax(tau * tau / m.inductance, 1e-9), 100.0);
    const double charge = sqrt(2.0 * random_log_between(seed, 10.0, 1e5) / m.capacitance);
    m.charge = random_between(seed, 0.0, 1.0) < 0.1 ? 0.0 : fmin(charge, 5e4);
    m.resistance = random_log_between(seed, 1e-9, 1e-1);
    m.cable_inductance = random_log_between(seed, 1e-8, 1e-6);
    m.crowbar = random_between(seed, 0.0, 1.0) < 0.8;
    m.series_diode = random_between(seed, 0.0, 1.0) < 0.7;
    m.crowbar_drop = random_between(seed, 0.0, 1.0) < 0.3 ? 0.0 : random_log_between(seed, 0.1, 50.0);
    m.crowbar_resistance = random_between(seed, 0.0, 1.0) < 0.3 ? 0.0 : random_log_between(seed, 1e-9, 1e-2);
    m.damping_resistance = random_between(seed, 0.0, 1.0) < 0.2 ? random_log_between(seed, 1e-3, 1e3) : NAN;
    return m;
}

static circuit_shot_config any_shot(uint64_t *seed, int n)
{
    circuit_shot_config c = plain_barrel();
    for (int k = 0; k < n; k++) modules[k] = any_module(seed);
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ n, modules };
    c.armature.mass = random_log_between(seed, 0.01, 10.0);
    c.armature.preload = random_between(seed, 0.0, 1.0) < 0.2 ? 0.0 : random_log_between(seed, 1.0, 1e6);
    c.armature.contact_voltage = random_between(seed, 0.0, 1.0) < 0.3 ? 0.0 : 40.0;
    c.armature.resistance = random_log_between(seed, 1e-9, 1e-3);
    c.armature.wear_fraction = random_between(seed, 0.0, 1.0) < 0.5 ? 0.0 : 0.01;
    c.barrel.length = random_log_between(seed, 0.2, 20.0);
    c.barrel.muzzle_voltage = random_between(seed, 0.0, 1.0) < 0.5 ? 0.0 : 300.0;
    c.barrel.shunt_resistance = random_between(seed, 0.0, 1.0) < 0.2 ? random_log_between(seed, 1e-9, 1e-2) : NAN;
    c.options.max_time = 0.01;
    for (int k = 1; k < n && n < 30; k++)
        if (random_between(seed, 0.0, 1.0) < 0.1)
            modules[k].position = c.barrel.length * random_between(seed, 0.0, 1.0);
    return c;
}

/* 1e-5: ten times README's bound, for circuits whose time constants lie a million apart. */
static void random_circuits(void **state)
{
    (void)state;
    const int shots = full_tests() ? 600 : 24;
    uint64_t seed = 20181113;
    int refused = 0, rerun = 0, left = 0;
    double worst = 0.0;
    for (int k = 0; k < shots; k++) {
        circuit_shot_summary r;
        circuit_shot_config c = any_shot(&seed, 1 + (int)(12.0 * random_between(&seed, 0.0, 1.0)));
        status st = run(&c, &r);
        if (st.code == STATUS_OK && notes.worst_error >= 1e-5) { /* thousands of rings of microseconds: errors add up */
            print_message("shot %d: energy error %.1e in %llu steps", k, notes.worst_error,
                          (unsigned long long)r.steps);
            c.options.rtol = 1e-11;
            c.options.atol = 1e-13;
            st = run(&c, &r);
            print_message(", at rtol 1e-11 %.1e\n", notes.worst_error);
            rerun++;
        }
        if (st.code != STATUS_OK) {
            assert_int_equal(st.code, STATUS_NUMERICAL);
            assert_non_null(strstr(st.text, "t = ")); /* says when */
            print_message("%d refused: %s\n", k, st.text);
            refused++;
        } else if (!(notes.worst_error < 1e-5)) {
            fail_msg("shot %d: energy error %.2e", k, notes.worst_error);
        }
        left += notes.count[CIRCUIT_SHOT_MUZZLE];
        if (st.code == STATUS_OK) worst = fmax(worst, notes.worst_error);
    }
    print_message("%d circuits: %d refused, %d at a closer tolerance, %d leave, worst energy error %.1e\n", shots,
                  refused, rerun, left, worst);
    assert_true(refused == 0 && 10 * rerun <= shots && left > 0);
}

/* One bank cut into more and more groups that differ by a millionth: the same shot. */
static void many_groups(void **state)
{
    (void)state;
    const int counts[] = { 1, 20, 200, MAX_MODULES };
    double first = 0.0;
    for (int k = 0; k < (full_tests() ? 4 : 3); k++) {
        const int n = counts[k];
        circuit_shot_config c = plain_barrel();
        for (int j = 0; j < n; j++) {
            modules[j] = unit_200kJ(1, 0.0);
            modules[j].capacitance *= 15.0 / n;
            modules[j].inductance *= n / 15.0;
            modules[j].resistance *= n / 15.0;
            modules[j].crowbar_resistance *= n / 15.0;
            modules[j].fire_at = 1e-4 * (j % 4);
            modules[j].charge *= 1.0 + 1e-6 * sin(j);
        }
        if (n == 1) modules[0].fire_at = 1.5e-4;
        c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ n, modules };
        circuit_shot_summary r;
        const status st = run(&c, &r);
        if (st.code != STATUS_OK) fail_msg("%d groups: %s", n, st.text);
        print_message("%d groups: %.3f m/s, worst energy error %.1e, %llu steps\n", n, r.muzzle_velocity,
                      notes.worst_error, (unsigned long long)r.steps);
        assert_true(notes.worst_error < 1e-6);
        assert_int_equal(notes.count[CIRCUIT_SHOT_FIRED], n);
        if (k == 1) first = r.muzzle_velocity;
        if (k > 1) assert_true(fabs(r.muzzle_velocity / first - 1.0) < 1e-5); /* charges differ by 1e-6 */
    }
}

/* A module that fires at the very instant of the exit, of a crowbar, of another's end; one whose crowbar is due as it
 * fires. */
static void coincidences(void **state)
{
    (void)state;
    modules[0] = unit_200kJ(8, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, modules };
    circuit_shot_summary r;
    assert_int_equal(run(&c, &r).code, STATUS_OK);
    const double instants[] = { r.muzzle_time, notes.time[CIRCUIT_SHOT_CROWBAR], notes.time[CIRCUIT_SHOT_BLOCKED],
                                notes.time[CIRCUIT_SHOT_RELEASED] };
    c.supplies[CIRCUIT_SUPPLY_capacitor].n = 2;
    for (size_t k = 0; k < sizeof instants / sizeof *instants; k++) {
        modules[1] = unit_200kJ(2, instants[k]);
        assert_int_equal(run(&c, &r).code, STATUS_OK);
        assert_true(notes.worst_error < 1e-6 && notes.count[CIRCUIT_SHOT_FIRED] == 2);
    }
    modules[1] =
        unit_200kJ(2, 1e-4); /* empty, no drop: its diode conducts from the start, if it gets to conduct at all */
    modules[1].charge = modules[1].crowbar_drop = modules[1].crowbar_resistance = 0.0;
    assert_int_equal(run(&c, &r).code, STATUS_OK);
    assert_true(notes.worst_error < 1e-6);
}

static void refusals(void **state)
{
    (void)state;
    circuit_shot_summary r;
    circuit_shot_config c = plain_barrel();
    modules[0] = unit_200kJ(1, 0.0);
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, modules };
    modules[0].charge = -1e3; /* reversed */
    const status reversed = run(&c, &r);
    assert_int_equal(reversed.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(reversed.text, "bank[0].charge"));
    modules[0].charge = 1e3;
    c.armature.velocity = -5.0; /* backward */
    const status backward = run(&c, &r);
    assert_int_equal(backward.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(backward.text, "armature.velocity"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_circuits),
        cmocka_unit_test(many_groups),
        cmocka_unit_test(coincidences),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
