/* SPDX-License-Identifier: BSD-3-Clause */
/* The search for firing times: it keeps its word on peak and velocity, and what it finds is better than what it was
 * given. */
#include "circuit/firing.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "status_common.h"

enum { GROUPS = 3 };

static circuit_shot_config three_groups(circuit_shot_module *m)
{
    for (int k = 0; k < GROUPS; k++) {
        m[k] = unit_200kJ(3, 3e-4 * k);
        m[k].cable_inductance = 1e-6;
    }
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ GROUPS, m };
    c.barrel.length = 2.0;
    return c;
}

static circuit_firing_wish wish_of(circuit_firing_goal goal)
{
    circuit_firing_wish w;
    base_params_default(circuit_firing_wish_params, &w);
    w.goal = goal;
    w.evaluations = 60;
    return w;
}

static circuit_firing_wish wish_of_flat(void)
{
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_FLAT);
    w.peak_current = 500e3;
    return w;
}

static circuit_shot_summary shoot(circuit_shot_config c, const circuit_shot_module *m)
{
    circuit_shot *s = NULL;
    c.supplies[CIRCUIT_SUPPLY_capacitor].item = m;
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, INFINITY, NULL));
    const circuit_shot_summary r = circuit_shot_result(s);
    circuit_shot_free(s);
    return r;
}

static void flat_below_a_peak(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    const circuit_shot_config c = three_groups(m);
    circuit_firing_wish w = wish_of_flat();
    OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
    const circuit_shot_summary got = shoot(c, found);
    print_message("unevenness %.4f -> %.4f, peak %.1f kA, %d trials\n", r.before, r.after, 1e-3 * got.peak_current,
                  r.evaluations);
    assert_true(r.after < 0.5 * r.before);
    assert_true(got.peak_current < 1.01 * w.peak_current);
    assert_true(found[0].fire_at == 0.0 && found[0].charge == m[0].charge && r.evaluations <= w.evaluations);
}

/* So few trials that the search ends in its first simplex, then in a step of it: no more than were allowed, and what is
 * found is no worse than what was given. */
static void keeps_its_budget(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    const circuit_shot_config c = three_groups(m);
    circuit_firing_wish w = wish_of_flat();
    for (w.evaluations = 2; w.evaluations < 12; w.evaluations++) {
        OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
        assert_int_equal(r.evaluations, w.evaluations);
        assert_true(r.after <= r.before);
    }
    w.evaluations = 1;
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_BAD_INPUT);
}

static void velocity_at_least_energy(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    const circuit_shot_config c = three_groups(m);
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_VELOCITY);
    w.muzzle_velocity = 900.0;
    w.evaluations = 30;
    OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
    const circuit_shot_summary got = shoot(c, found);
    print_message("%.1f -> %.1f kJ, %.3f m/s, %d trials, %d shots\n", 1e-3 * r.before, 1e-3 * r.after,
                  got.muzzle_velocity, r.evaluations, r.shots);
    assert_true(fabs(got.muzzle_velocity / 900.0 - 1.0) < 2e-5); /* the search's own closeness and its shots' rtol */
    assert_true(r.after < r.before && r.stored_energy == r.after);
}

/* At level skin without a frequency the rails' gradients go with the firing times: the search's shots
 * have those too. */
static void gradients_by_firing_times(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    circuit_shot_config c = three_groups(m);
    c.rails.level = CIRCUIT_SHOT_RAILS_SKIN;
    c.rails.fineness = 2.0;
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_VELOCITY);
    w.muzzle_velocity = 900.0;
    w.evaluations = 10;
    OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
    const double v = shoot(c, found).muzzle_velocity, before = circuit_shot_effective_frequency(&c);
    c.supplies[CIRCUIT_SUPPLY_capacitor].item = found;
    const double after = circuit_shot_effective_frequency(&c);
    print_message("skin: %.1f -> %.1f Hz, %.3f m/s\n", before, after, v);
    assert_true(fabs(after / before - 1.0) > 0.01 && fabs(v / 900.0 - 1.0) < 2e-5);
    c.supplies[CIRCUIT_SUPPLY_capacitor].item = m;
    c.rails.frequency = 300.0; /* one for all trials */
    OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
    assert_true(fabs(shoot(c, found).muzzle_velocity / 900.0 - 1.0) < 2e-5);
}

/* One group has no time to move: its charge alone is found, and the same from twice the charge. */
static void charge_of_one_group(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    circuit_shot_config c = three_groups(m);
    c.supplies[CIRCUIT_SUPPLY_capacitor].n = 1;
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_VELOCITY);
    w.muzzle_velocity = 500.0;
    double charge[2];
    for (int k = 0; k < 2; k++) {
        OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
        charge[k] = found[0].charge;
        assert_true(fabs(shoot(c, found).muzzle_velocity / 500.0 - 1.0) < 2e-5);
        assert_true(r.stored_energy == r.after && fabs(r.charge_scale * m[0].charge / charge[k] - 1.0) < 1e-12);
        assert_true(fabs(r.after / r.before / (r.charge_scale * r.charge_scale) - 1.0) < 1e-12);
        m[0].charge *= 2.0;
    }
    print_message("500 m/s: %.2f V, from twice the charge %.2f V\n", charge[0], charge[1]);
    assert_true(fabs(charge[1] / charge[0] - 1.0) < 2e-5);
    w.goal = CIRCUIT_FIRING_FLAT, w.peak_current = 5e5;
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_BAD_INPUT);
    m[0].charge = 0.0, w.goal = CIRCUIT_FIRING_VELOCITY;
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_BAD_INPUT);
}

static bool at_once(void)
{
    return true;
}

static int asked, asked_at_most; /* of stop_later: so often the search may go on */

static bool stop_later(void)
{
    return ++asked > asked_at_most;
}

/* Stopped at any trial, at those of the first simplex too, it says so. */
static void stopped_at_any_trial(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    const circuit_shot_config c = three_groups(m);
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_FLAT);
    w.peak_current = 5e5, w.evaluations = 8;
    for (asked_at_most = 0; asked_at_most < 8; asked_at_most++) {
        asked = 0;
        assert_int_equal(circuit_firing_optimise(&c, &w, stop_later, found, &r).code, STATUS_STOPPED);
    }
}

enum { MOST_TRIALS = 40 };

typedef struct {
    circuit_firing_trial trial[MOST_TRIALS];
    int n;
} trial_list;

static status keep(void *user, const circuit_firing_trial *t)
{
    trial_list *l = user;
    assert_true(l->n < MOST_TRIALS);
    l->trial[l->n++] = *t;
    return status_ok();
}

/* One that goes on from any of its trials finds what one in one go finds, to the bit, and runs no trial twice. */
static void resumed_at_any_trial(void **state)
{
    (void)state;
    for (int goal = CIRCUIT_FIRING_FLAT; goal <= CIRCUIT_FIRING_VELOCITY; goal++) {
        circuit_shot_module m[GROUPS], found[GROUPS], again[GROUPS];
        circuit_firing_result r, other;
        const circuit_shot_config c = three_groups(m);
        circuit_firing_wish w = wish_of((circuit_firing_goal)goal);
        w.peak_current = 5e5, w.muzzle_velocity = 900.0, w.evaluations = 9;
        trial_list all = { .n = 0 };
        OK(circuit_firing_resume(&c, &w, &(circuit_firing_host){ .keep = keep, .user = &all }, found, &r));
        assert_int_equal(all.n, r.evaluations);
        for (int known = 0; known <= all.n; known++) {
            trial_list rest = { .n = 0 };
            OK(circuit_firing_resume(
                &c, &w, &(circuit_firing_host){ .n_known = known, .known = all.trial, .keep = keep, .user = &rest },
                again, &other));
            assert_int_equal(rest.n, all.n - known);
            assert_memory_equal(rest.trial, all.trial + known, (size_t)rest.n * sizeof rest.trial[0]);
            assert_true(other.before == r.before && other.after == r.after && other.charge_scale == r.charge_scale &&
                        other.stored_energy == r.stored_energy && other.evaluations == r.evaluations &&
                        other.shots == r.shots);
            for (int k = 0; k < GROUPS; k++)
                assert_true(again[k].fire_at == found[k].fire_at && again[k].charge == found[k].charge);
        }
    }
}

/* A trial that leaves nothing of the armature had too much charge: the search goes on below it. */
static void worn_away(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    circuit_shot_config c = three_groups(m);
    c.supplies[CIRCUIT_SUPPLY_capacitor].n = 1;
    c.armature.wear_fraction = c.armature.heat_share = 1.0;
    c.armature.mass = 0.02;
    m[0].charge *= 3.0;
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    assert_int_equal(circuit_shot_advance(s, INFINITY, NULL).code, STATUS_NUMERICAL);
    assert_true(circuit_shot_result(s).worn_away);
    circuit_shot_free(s);
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_VELOCITY);
    w.muzzle_velocity = 600.0;
    OK(circuit_firing_optimise(&c, &w, NULL, found, &r));
    assert_true(fabs(shoot(c, found).muzzle_velocity / 600.0 - 1.0) < 2e-5 && r.charge_scale < 1.0);
}

static void refusals(void **state)
{
    (void)state;
    circuit_shot_module m[GROUPS], found[GROUPS];
    circuit_firing_result r;
    circuit_shot_config c = three_groups(m);
    circuit_firing_wish w = wish_of(CIRCUIT_FIRING_FLAT);
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_BAD_INPUT); /* no peak */
    w.peak_current = 5e5;
    assert_int_equal(circuit_firing_optimise(&c, &w, at_once, found, &r).code, STATUS_STOPPED);
    w = wish_of(CIRCUIT_FIRING_VELOCITY);
    w.muzzle_velocity = 5e4;
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_NUMERICAL);
    c.supplies[CIRCUIT_SUPPLY_capacitor].n = 1;
    assert_int_equal(circuit_firing_optimise(&c, &w, NULL, found, &r).code, STATUS_NUMERICAL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_below_a_peak),
        cmocka_unit_test(velocity_at_least_energy),
        cmocka_unit_test(gradients_by_firing_times),
        cmocka_unit_test(charge_of_one_group),
        cmocka_unit_test(keeps_its_budget),
        cmocka_unit_test(stopped_at_any_trial),
        cmocka_unit_test(resumed_at_any_trial),
        cmocka_unit_test(worn_away),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
