/* SPDX-License-Identifier: BSD-3-Clause */
/* Heat left along the rails (circuit/rails/rails_heat.h): closed forms of one piece, and the ledger of whole shots. */
#include "circuit/rails/rails_heat.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near_common.h"
#include "status_common.h"

/* Two rungs, of 10 us and 1 ms. */
static circuit_rails_load two_rungs(void)
{
    return (circuit_rails_load){
        .ladder = { .n = 2, .R_dc = 1e-4, .L_inf = 4e-7, .L = { 1e-7, 5e-8 }, .R = { 1e-4, 5e-3 } },
        .contact = { .length = 0.02, .resistivity = 1.7e-8 }
    };
}

/* ---- one piece ---- */

/* A current that goes linearly, over a rail that is exposed all the time: j' = (I - j)/tau by many small steps of order
 * 4. */
static double heat_by_steps(const circuit_rails_load *r, double warm, double T, double I0, double I1)
{
    enum { STEPS = 20000 };
    const double h = T / STEPS, slope = (I1 - I0) / T;
    double heat = warm * r->ladder.R_dc * (I0 * I0 + I0 * I1 + I1 * I1) / 3.0 * T;
    for (int n = 0; n < r->ladder.n; n++) {
        const double R = warm * r->ladder.R[n], rate = R / r->ladder.L[n];
        double u = I0;
        for (int k = 0; k < STEPS; k++) { /* u' = slope - rate u */
            const double k1 = slope - rate * u, k2 = slope - rate * (u + 0.5 * h * k1);
            const double k3 = slope - rate * (u + 0.5 * h * k2), k4 = slope - rate * (u + h * k3);
            const double next = u + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4),
                         middle = 0.5 * (u + next) + h / 8.0 * (k1 - k4);
            heat += R * h / 6.0 * (u * u + 4.0 * middle * middle + next * next);
            u = next;
        }
    }
    return heat;
}

static void steady_and_changing_current(void **state)
{
    static const double currents[][2] = { { 1e5, 1e5 }, { 0.0, 3e5 }, { 2e5, -1e5 } };
    static circuit_rails_heat h;
    const circuit_rails_load r = two_rungs();
    (void)state;
    for (size_t k = 0; k < sizeof currents / sizeof *currents; k++)
        for (double warm = 1.0; warm < 2.0; warm += 0.4) {
            const double T = 4e-4, I0 = currents[k][0], I1 = currents[k][1];
            const double want = heat_by_steps(&r, warm, T, I0, I1);
            circuit_rails_heat_start(&h, 1.0);
            for (int j = 0; j < 8; j++) { /* in unequal parts: the memory goes on */
                const double t0 = T * j * j / 64.0, t1 = T * (j + 1) * (j + 1) / 64.0;
                const circuit_rails_instant a = { t0, 1.0, 0.0, I0 + (I1 - I0) * t0 / T },
                                            b = { t1, 1.0, 0.0, I0 + (I1 - I0) * t1 / T };
                circuit_rails_heat_carry(&h, &r, warm, 0.0, 1.0, &a, &b);
            }
            assert_near(h.heat[0], want, 1e-7 * want);
            assert_near(h.heat[CIRCUIT_RAILS_PIECES - 1], want, 1e-7 * want);
        }
}

/* Exposed on the way: nothing before, what exposing costs, then the rest of the step. */
static void exposed_on_the_way(void **state)
{
    static circuit_rails_heat h;
    const circuit_rails_load r = two_rungs();
    const double v = 1500.0, I = 3e5, T = 4e-4, length = 1.0;
    (void)state;
    circuit_rails_heat_start(&h, length);
    const circuit_rails_instant a = { 0.0, 0.0, v, I }, b = { T, v * T, v, I };
    circuit_rails_heat_carry(&h, &r, 1.0, 0.0, length, &a, &b);
    for (int k = 0; k < CIRCUIT_RAILS_PIECES; k += 5) {
        const double x = (k + 0.5) * length / CIRCUIT_RAILS_PIECES, t = T - x / v;
        double want = t > 0.0 ? r.ladder.R_dc * I * I * t : 0.0;
        for (int n = 0; n < r.ladder.n && t > 0.0; n++) {
            const double tau = r.ladder.L[n] / r.ladder.R[n], theta = v * tau / r.contact.length;
            const double born = circuit_rails_share_at_birth(theta), u = (1.0 - born) * I;
            want += r.ladder.R[n] * u * u * 0.5 * tau * (1.0 - exp(-2.0 * t / tau)) +
                    0.5 * r.ladder.L[n] * (born * (2.0 - born) - circuit_rails_share_of_force(theta)) * I * I;
        }
        assert_near(h.heat[k], want, 1e-12 * fabs(want));
    }
    assert_true(h.heat[0] > h.heat[20] && h.heat[CIRCUIT_RAILS_PIECES - 1] == 0.0);
}

static void only_its_own_stretch(void **state)
{
    static circuit_rails_heat h;
    const circuit_rails_load r = two_rungs();
    const circuit_rails_instant a = { 0.0, 1.0, 0.0, 1e5 }, b = { 1e-4, 1.0, 0.0, 1e5 };
    (void)state;
    circuit_rails_heat_start(&h, 1.0);
    circuit_rails_heat_carry(&h, &r, 1.0, 0.25, 0.5, &a, &b);
    assert_true(h.heat[15] == 0.0 && h.heat[16] > 0.0 && h.heat[31] > 0.0 && h.heat[32] == 0.0);
    circuit_rails_heat_start(&h, 1.0);
    circuit_rails_heat_ahead(&h, &r, 0.5, 1e-3, 1e5, 2e5);
    assert_near(h.heat[32], r.ladder.R_dc * 7e10 / 3.0 * 1e-3, 1e-6);
    assert_true(h.heat[31] == 0.0);
}

static double sum_of(const circuit_rails_heat *h)
{
    double sum = 0.0;
    for (int k = 0; k < CIRCUIT_RAILS_PIECES; k++) sum += h->heat[k] * h->piece;
    return sum;
}

static void contact_leaves_its_heat_where_it_slides(void **state)
{
    static circuit_rails_heat h;
    (void)state;
    circuit_rails_heat_start(&h, 2.0);
    circuit_rails_heat_slide(&h, 0.31, 0.77, 500.0);
    assert_near(sum_of(&h), 500.0, 1e-9);
    assert_near(h.heat[15], 500.0 / 0.46, 1e-9);   /* a piece in the middle of it */
    circuit_rails_heat_slide(&h, 0.5, 0.5, 100.0); /* at rest */
    circuit_rails_heat_slide(&h, 1.99, 2.0, 50.0); /* at the end */
    assert_near(sum_of(&h), 650.0, 1e-9);
    assert_near(h.heat[16] * h.piece, 500.0 / 0.46 * h.piece + 100.0, 1e-9);
}

/* ---- whole shots ---- */

/* The pieces add up to the ledger, but for half a piece at both ends; returns the largest rise. */
static double check_ledger(const char *name, const circuit_shot_config *c)
{
    circuit_shot *s = NULL;
    double rise[CIRCUIT_SHOT_PIECES], sum = 0.0, most = 0.0;
    OK(circuit_shot_create(c, &s));
    OK(circuit_shot_advance(s, INFINITY, NULL));
    circuit_shot_rail_rise(s, rise);
    const circuit_shot_ledger l = circuit_shot_now(s).ledger;
    const double capacity = c->rails.heat_capacity * 2.0 * c->rails.height * c->rails.thickness,
                 piece = c->barrel.length / CIRCUIT_SHOT_PIECES;
    const double want = l.rails_heat + (1.0 - c->armature.heat_share) * (l.friction + l.contact_heat);
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) {
        sum += rise[k] * capacity * piece;
        most = fmax(most, rise[k]);
        assert_true(rise[k] >= 0.0);
    }
    print_message("%-22s %7.1f kJ in the rails, pieces %+.3f %%, warmest piece %.1f K\n", name, 1e-3 * want,
                  100.0 * (sum / want - 1.0), most);
    assert_near(sum, want, 0.5 * most * capacity * piece + 2e-3 * want);
    circuit_shot_free(s);
    return most;
}

static void pieces_add_up(void **state)
{
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    (void)state;
    const double cold = check_ledger("default shot", &c);
    assert_true(cold > 20.0 && cold < 1000.0);
    c.armature.heat_share = 0.3;
    assert_true(check_ledger("heat_share 0.3", &c) > cold);
    c.armature.heat_share = 0.5;
    c.rails.slices = 8;
    const double warming = check_ledger("slices", &c);
    assert_true(warming > cold); /* resistance follows the temperature */
    c.rails.slices = 0;
    for (int k = 6; k < DEFAULT_SHOT_GROUPS; k++) modules[k].position = 0.2 * (k - 5);
    check_ledger("distributed", &c);
    c.barrel.shunt_resistance = 1e-4;
    check_ledger("shunt at the muzzle", &c);
    c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ DEFAULT_SHOT_GROUPS, modules };
    for (int k = 0; k < DEFAULT_SHOT_GROUPS; k++) modules[k].position = 0.0;
    check_ledger("constant gradients", &c);
    const double gradient = c.rails.resistance_gradient;
    double muzzle[2];
    c.rails.resistance_gradient = 0.0; /* nothing to warm by: the same shot, sliced or not */
    for (int k = 0; k < 2; k++) {
        c.rails.slices = 4 * k;
        circuit_shot *s = NULL;
        OK(circuit_shot_create(&c, &s));
        OK(circuit_shot_advance(s, INFINITY, NULL));
        muzzle[k] = circuit_shot_result(s).muzzle_velocity;
        circuit_shot_free(s);
    }
    assert_true(muzzle[0] > 100.0);
    assert_near(muzzle[1], muzzle[0], 1e-6 * muzzle[0]);
    c.rails.slices = 0, c.rails.resistance_gradient = gradient;
    c.armature.preload = 1e9;
    check_ledger("held", &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steady_and_changing_current),
        cmocka_unit_test(exposed_on_the_way),
        cmocka_unit_test(only_its_own_stretch),
        cmocka_unit_test(contact_leaves_its_heat_where_it_slides),
        cmocka_unit_test(pieces_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
