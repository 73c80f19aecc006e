/* SPDX-License-Identifier: BSD-3-Clause */
/* Supplies: the law of the table for every kind, closed forms of each, several of them on one barrel. */
#include "base/constants.h"
#include "circuit/supply/supply_kind.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "near_common.h"
#include "status_common.h"

/* ---- one of each ---- */

typedef struct {
    circuit_shot_module capacitor;
    circuit_supply_inductor inductor;
    circuit_supply_homopolar homopolar;
    circuit_supply_alternator alternator;
    circuit_supply_profile profile;
} one_of_each;

static circuit_supply_point hump[9];

static one_of_each samples(void)
{
    one_of_each s;
    s.capacitor = unit_200kJ(1, 0.0);
    s.capacitor.cable_inductance = 1e-6;
    s.capacitor.cable_resistance = 1e-3;
    base_params_default(circuit_supply_inductor_params, &s.inductor);
    s.inductor.inductance = 20e-6;
    s.inductor.resistance = 1e-3;
    s.inductor.current = 3e5;
    s.inductor.battery_voltage = 20.0;
    s.inductor.opening_voltage = 4e3;
    s.inductor.cable_inductance = 0.3e-6;
    s.inductor.cable_resistance = 1e-4;
    base_params_default(circuit_supply_homopolar_params, &s.homopolar);
    s.homopolar.flux = 0.2;
    s.homopolar.inertia = 50.0;
    s.homopolar.speed = 700.0;
    s.homopolar.windage = 0.01;
    s.homopolar.inductance = 4e-6;
    s.homopolar.resistance = 50e-6;
    base_params_default(circuit_supply_alternator_params, &s.alternator);
    s.alternator.flux = 3.0;
    s.alternator.pole_pairs = 2;
    s.alternator.inertia = 20.0;
    s.alternator.speed = 800.0;
    s.alternator.windage = 0.01;
    s.alternator.inductance = 2e-6;
    s.alternator.resistance = 300e-6;
    base_params_default(circuit_supply_profile_params, &s.profile);
    for (int k = 0; k < 9; k++) hump[k] = (circuit_supply_point){ k * 5e-4, 4e5 * sin(PI * k / 8) };
    hump[8].current = 0.0;
    s.profile.points.n = 9;
    s.profile.points.item = hump;
    return s;
}

static const void *sample_of(const one_of_each *s, int kind)
{
    const void *const all[CIRCUIT_SUPPLY_KINDS] = { [CIRCUIT_SUPPLY_capacitor] = &s->capacitor,
                                                    [CIRCUIT_SUPPLY_inductor] = &s->inductor,
                                                    [CIRCUIT_SUPPLY_homopolar] = &s->homopolar,
                                                    [CIRCUIT_SUPPLY_alternator] = &s->alternator,
                                                    [CIRCUIT_SUPPLY_profile] = &s->profile };
    if (!all[kind])
        fail_msg("supply `%s` has no sample: give one_of_each of tests/test_circuit_supplies.c one, and name it here",
                 circuit_supply_kinds[kind]->name);
    return all[kind];
}

/* ---- the law (S-2) ---- */

static double stored_energy(const supply_group *g, const double *y)
{
    double e[STORE_PLACES] = { 0.0 };
    g->kind->stored(g, y, e);
    double sum = 0.0;
    for (int p = 0; p < STORE_PLACES; p++) sum += e[p];
    return sum;
}

/* Power booked against the stored energy's rate of change, by central differences along the rates: quadratic forms and
 * sines of small steps, so good to round-off over the step, 1e-7 of the powers. */
static void balance(const supply_group *g, const double *y0, double V)
{
    double y[SUPPLY_UNKNOWNS], d[SUPPLY_UNKNOWNS], ahead[SUPPLY_UNKNOWNS], behind[SUPPLY_UNKNOWNS];
    supply_flow f;
    memcpy(y, y0, sizeof y);
    const double t = 1e-3, h = 1e-7;
    for (int pass = 0; pass < 2; pass++) { /* algebraic unknowns get the value they must have */
        circuit_supply_rates(g, t, y, V, d, &f);
        for (int j = 0; j < g->unknowns; j++)
            if (circuit_supply_algebraic(g, j)) y[j] = d[j];
    }
    for (int j = 0; j < g->unknowns; j++) { /* and move with the current they follow */
        const double rate = circuit_supply_algebraic(g, j) ? (j == 0 ? f.push : d[0]) : d[j];
        ahead[j] = y[j] + h * rate;
        behind[j] = y[j] - h * rate;
    }
    const double i = circuit_supply_conducts(g) ? y[0] : 0.0;
    double lost = 0.0;
    for (int p = 0; p < HEAT_PLACES; p++) {
        assert_true(f.heat[p] >= 0.0);
        lost += f.heat[p];
    }
    const double given = f.supplied + (g->kind->source ? V * i : 0.0) - V * i;
    const double rate = (stored_energy(g, ahead) - stored_energy(g, behind)) / (2.0 * h);
    assert_near(given - lost, rate,
                1e-7 * (fabs(given) + lost + fabs(rate)) + 4e-16 * stored_energy(g, y) / h); /* and its own round-off */
}

/* Of every kind, charged by a tenth more: a fifth and a hundredth more energy, all of them being quadratic.  A coil's
 * battery goes with it, a given current is a tenth larger. */
static void recharged(void **state)
{
    (void)state;
    const one_of_each s = samples();
    for (int kind = 0; kind < CIRCUIT_SUPPLY_KINDS; kind++) {
        const size_t size = circuit_supply_size((circuit_supply_kind_index)kind);
        _Alignas(max_align_t) char units[2 * SUPPLY_BYTES];
        double e[2];
        assert_true(2 * size <= sizeof units);
        for (int i = 0; i < 2; i++) memcpy(units + (size_t)i * size, sample_of(&s, kind), size);
        circuit_supply_recharge((circuit_supply_kind_index)kind, units, 2, 1.1);
        assert_memory_equal(units, units + size, size);
        for (int i = 0; i < 2; i++) {
            supply_group g = { .kind = circuit_supply_kinds[kind], .p = i ? units : sample_of(&s, kind), .n = 1.0 };
            double y[SUPPLY_UNKNOWNS] = { 0.0 };
            supply_scale scale;
            g.at = circuit_supply_common_of(g.p);
            g.kind->start(g.p, y, &scale);
            e[i] = g.kind->source ? scale.y[0] * scale.y[0] : stored_energy(&g, y);
        }
        assert_near(e[1], 1.21 * e[0], 1e-12 * e[0]);
        if (kind == CIRCUIT_SUPPLY_inductor)
            assert_near(((const circuit_supply_inductor *)(const void *)units)->battery_voltage,
                        1.1 * s.inductor.battery_voltage, 1e-9);
    }
}

static void law_of_the_table(void **state)
{
    (void)state;
    const one_of_each s = samples();
    for (int kind = 0; kind < CIRCUIT_SUPPLY_KINDS; kind++) {
        for (int variant = 0; variant < 2; variant++) {
            supply_group g = { .kind = circuit_supply_kinds[kind], .p = sample_of(&s, kind), .n = 1.0 };
            circuit_shot_module damped = s.capacitor;
            damped.damping_resistance = 0.3;
            damped.crowbar_resistance = 0.0;
            if (variant && kind == CIRCUIT_SUPPLY_capacitor) g.p = &damped;
            g.at = circuit_supply_common_of(g.p);
            g.unknowns = g.kind->unknowns(g.p);
            if (g.kind->prepare) OK(g.kind->prepare(&g));
            for (int gate = GATE_UNFIRED; gate <= GATE_ON; gate++) {
                for (int stage = 0; stage < (g.kind->next && kind != CIRCUIT_SUPPLY_profile ? 2 : 1); stage++) {
                    const double i = gate == GATE_ON ? 1.2e5 : 0.0;
                    const double y[SUPPLY_UNKNOWNS] = { i, kind == CIRCUIT_SUPPLY_inductor ? 2e5 : 650.0, 0.3, 0.0 };
                    g.gate = (supply_gate)gate;
                    g.stage = stage;
                    if (stage && gate != GATE_ON && kind == CIRCUIT_SUPPLY_inductor)
                        continue; /* open, and carrying nothing */
                    balance(&g, y, 800.0);
                    balance(&g, y, -90.0);
                }
            }
            if (g.kind->release) g.kind->release(&g);
        }
    }
}

/* ---- shots ---- */

static shot_notes notes;

static circuit_shot *run(const circuit_shot_config *c)
{
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notes_sink(&notes);
    OK(circuit_shot_create(c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    /* default tolerances: docs/validation/circuit.md's 1000 random banks stay below 3e-7 */
    if (!(notes.worst_error < 1e-6)) fail_msg("energy error %.2e", notes.worst_error);
    return s;
}

static void every_kind_shoots(void **state)
{
    (void)state;
    const one_of_each s = samples();
    for (int kind = 0; kind < CIRCUIT_SUPPLY_KINDS; kind++) {
        circuit_shot_config c = plain_barrel();
        c.supplies[kind] = (circuit_supply_list){ 1, sample_of(&s, kind) };
        circuit_shot *one = run(&c);
        const circuit_shot_summary r = circuit_shot_result(one);
        print_message("%-10s peak %.0f kA, %.0f m/s, worst energy error %.1e, %llu steps\n",
                      circuit_supply_kinds[kind]->name, 1e-3 * r.peak_current, r.muzzle_velocity, notes.worst_error,
                      (unsigned long long)r.steps);
        assert_int_equal(notes.count[CIRCUIT_SHOT_FIRED], 1);
        assert_int_equal(circuit_shot_module_count(one), 1);
        assert_true(r.peak_current > 1e4 &&
                    (r.muzzle_velocity > 10.0 || circuit_shot_now(one).phase != CIRCUIT_SHOT_LEFT));
        circuit_shot_free(one);
    }
}

static void all_kinds_together(void **state)
{
    (void)state;
    const one_of_each s = samples();
    circuit_shot_config c = plain_barrel();
    for (int kind = 0; kind < CIRCUIT_SUPPLY_KINDS; kind++)
        c.supplies[kind] = (circuit_supply_list){ 1, sample_of(&s, kind) };
    circuit_shot *one = run(&c);
    assert_int_equal(circuit_shot_module_count(one), CIRCUIT_SUPPLY_KINDS);
    assert_int_equal(notes.count[CIRCUIT_SHOT_MUZZLE], 1);
    print_message("together: %.0f m/s, worst energy error %.1e\n", circuit_shot_result(one).muzzle_velocity,
                  notes.worst_error);
    circuit_shot_free(one);
}

/* Without windage a homopolar machine is a capacitor J/k^2 charged to k w_0. */
static void homopolar_is_a_capacitor(void **state)
{
    (void)state;
    circuit_supply_homopolar h = samples().homopolar;
    h.windage = 0.0;
    h.inertia = 2e-3;
    circuit_shot_module m;
    base_params_default(circuit_supply_capacitor_params, &m);
    m.capacitance = h.inertia / (h.flux * h.flux);
    m.charge = h.flux * h.speed * 10.0;
    h.speed *= 10.0;
    m.inductance = h.inductance;
    m.resistance = h.resistance;
    m.crowbar = false;
    circuit_shot_config a = plain_barrel(), b = plain_barrel();
    a.supplies[CIRCUIT_SUPPLY_homopolar] = (circuit_supply_list){ 1, &h };
    b.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot *one = run(&a), *other = run(&b);
    const double peak = circuit_shot_result(other).peak_current;
    assert_near(circuit_shot_result(one).peak_current, peak, 1e-7 * peak); /* both within 100 rtol of the truth */
    assert_near(circuit_shot_now(one).x, circuit_shot_now(other).x, 1e-6);
    assert_near(circuit_shot_now(one).ledger.rotors, circuit_shot_now(other).ledger.capacitors,
                1e-6 * circuit_shot_now(one).ledger.start);
    circuit_shot_free(one);
    circuit_shot_free(other);
}

/* Charged by its battery, i_0 = V_b/R (1 - exp(-R t/L)); then, lossless for the few us it takes, i* = i_0 L_s/(L_s +
 * L_c) and the switch burns 1/2 i_0^2 L_s L_c/(L_s + L_c). */
static void opening_switch(void **state)
{
    (void)state;
    circuit_supply_inductor p = samples().inductor;
    p.current = 0.0;
    p.battery_voltage = 400.0;
    p.fire_at = 0.02;
    p.cable_resistance = 0.0;
    p.opening_voltage = 1e6;
    const double i0 = p.battery_voltage / p.resistance * -expm1(-p.fire_at * p.resistance / p.inductance);
    const double share = p.inductance / (p.inductance + p.cable_inductance),
                 took = i0 * share * p.cable_inductance / 1e6;
    circuit_shot_config c = short_circuit();
    c.supplies[CIRCUIT_SUPPLY_inductor] = (circuit_supply_list){ 1, &p };
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notes_sink(&notes);
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, 0.020001, &sink));
    assert_int_equal(notes.count[CIRCUIT_SHOT_COMMUTATED], 1);
    /* R i_0/U = 2.6e-4 of the current is lost or gained on the way */
    assert_near(notes.time[CIRCUIT_SHOT_COMMUTATED] - p.fire_at, took, 1e-3 * took);
    assert_near(circuit_shot_result(s).peak_current, i0 * share, 1e-3 * i0);
    assert_near(circuit_shot_now(s).ledger.switch_heat, 0.5 * i0 * i0 * share * p.cable_inductance,
                1e-3 * circuit_shot_now(s).ledger.switch_heat);
    /* after 0.02 s the store holds half of what the battery gave; that is in `supplied` */
    assert_true(circuit_shot_now(s).ledger.start == 0.0 &&
                circuit_shot_now(s).ledger.supplied > 0.5 * p.inductance * i0 * i0);
    assert_true(notes.worst_error < 1e-6);
    circuit_shot_free(s);
}

/* A bank drives the rails above the opening voltage before the current has gone over, and the store's back to zero: the
 * arc goes on.  It takes L_s di_s/dt = -U - R i_s, until it is over or the rails let the store conduct again. */
static void arc_goes_on(void **state)
{
    (void)state;
    circuit_supply_inductor p = samples().inductor;
    p.battery_voltage = 0.0;
    p.resistance = 0.0;
    p.opening_voltage = 300.0;
    circuit_shot_module m = unit_200kJ(8, 1e-4);
    m.inductance = 3e-6;
    circuit_shot_config c = plain_barrel();
    c.barrel.start = 0.5;
    c.supplies[CIRCUIT_SUPPLY_inductor] = (circuit_supply_list){ 1, &p };
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notes_sink(&notes);
    OK(circuit_shot_create(&c, &s));
    double heat[2];
    for (int k = 0; k < 2; k++) {
        OK(circuit_shot_advance(s, 2e-4 + 1e-4 * k, &sink));
        assert_int_equal(notes.count[CIRCUIT_SHOT_WAITING], 1);
        assert_int_equal(notes.count[CIRCUIT_SHOT_BLOCKED] + notes.count[CIRCUIT_SHOT_COMMUTATED], 0);
        heat[k] = circuit_shot_now(s).ledger.switch_heat;
    }
    const double U = p.opening_voltage, between = U * (p.current * 1e-4 - 0.5 * U / p.inductance * (9e-8 - 4e-8));
    assert_near(heat[1] - heat[0], between, 1e-5 * between);
    OK(circuit_shot_advance(s, INFINITY, &sink));
    assert_true(notes.count[CIRCUIT_SHOT_FIRED] == 3); /* the store, the bank, and the store once more */
    assert_int_equal(notes.count[CIRCUIT_SHOT_COMMUTATED], 1);
    assert_true(notes.worst_error < 1e-6);
    circuit_shot_free(s);
}

/* A store without current or battery asks for no frequency of its pulse: it rests. */
static void empty_store(void **state)
{
    (void)state;
    circuit_supply_inductor p = samples().inductor;
    p.current = p.battery_voltage = 0.0;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_inductor] = (circuit_supply_list){ 1, &p };
    assert_true(isnan(circuit_shot_effective_frequency(&c)));
    circuit_shot *s = run(&c);
    assert_near(circuit_shot_result(s).peak_current, 0.0, 1e-6);
    assert_true(isnan(circuit_shot_result(s).muzzle_velocity));
    circuit_shot_free(s);
}

/* A current the other way round pushes as much, and its peak is as high. */
static void current_of_either_sign(void **state)
{
    (void)state;
    one_of_each all = samples();
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_profile] = (circuit_supply_list){ 1, &all.profile };
    circuit_shot *s = run(&c);
    const circuit_shot_summary plain = circuit_shot_result(s);
    circuit_shot_free(s);
    for (int k = 0; k < 9; k++) hump[k].current = -hump[k].current;
    s = run(&c);
    const circuit_shot_summary turned = circuit_shot_result(s);
    circuit_shot_free(s);
    for (int k = 0; k < 9; k++) hump[k].current = -hump[k].current;
    assert_true(plain.peak_current > 1e5);
    assert_near(turned.peak_current, plain.peak_current, 1e-6 * plain.peak_current);
    assert_near(turned.muzzle_velocity, plain.muzzle_velocity, 1e-6 * plain.muzzle_velocity);
}

/* Lossless and of endless inertia, switched on at the electrical angle f: i = k/(p L) (cos f - cos a), zero again at
 * the angle 2 pi - f; it comes on again where its voltage turns positive, at 2 pi. */
static void alternator_pulses(void **state)
{
    (void)state;
    circuit_supply_alternator p = samples().alternator;
    p.resistance = p.windage = 0.0;
    p.inertia = 1e7;
    p.phase = 0.5;
    p.pulses = 2;
    circuit_shot_config c = short_circuit();
    c.supplies[CIRCUIT_SUPPLY_alternator] = (circuit_supply_list){ 1, &p };
    const double w = p.pole_pairs * p.speed, unit = p.flux / (p.pole_pairs * p.inductance);
    circuit_shot *s = NULL;
    const circuit_shot_sink sink = notes_sink(&notes);
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, (2.0 * PI - 0.6) / w, &sink));
    assert_near(circuit_shot_result(s).peak_current, unit * (1.0 + cos(0.5)),
                2e-5 * unit); /* the rotor's share: 1e-6 */
    assert_int_equal(notes.count[CIRCUIT_SHOT_WAITING], 1);
    assert_near(notes.time[CIRCUIT_SHOT_WAITING], (2.0 * PI - 1.0) / w, 1e-5 / w);
    OK(circuit_shot_advance(s, 3.0 * PI / w, &sink));
    assert_int_equal(notes.count[CIRCUIT_SHOT_FIRED], 2);
    assert_near(notes.time[CIRCUIT_SHOT_FIRED], (2.0 * PI - 0.5) / w, 1e-5 / w);
    assert_int_equal(notes.count[CIRCUIT_SHOT_BLOCKED], 0);
    assert_true(notes.worst_error < 1e-6);
    circuit_shot_free(s);
    p.resistance = 3e-4; /* with losses the second pulse ends too, for good */
    s = run(&c);
    assert_int_equal(notes.count[CIRCUIT_SHOT_BLOCKED], 1);
    assert_true(circuit_shot_done(s));
    circuit_shot_free(s);
}

static void profile_is_followed(void **state)
{
    (void)state;
    const one_of_each all = samples();
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_profile] = (circuit_supply_list){ 1, &all.profile };
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    for (int k = 1; k < 8; k++) {
        OK(circuit_shot_advance(s, hump[k].time, NULL));
        assert_near(circuit_shot_now(s).current, hump[k].current,
                    1e-9 * 4e5); /* algebraic: met to the Newton iteration */
    }
    OK(circuit_shot_advance(s, INFINITY, NULL));
    assert_near(circuit_shot_now(s).ledger.energy_error, 0.0, 1e-6);
    assert_true(circuit_shot_now(s).current == 0.0 && circuit_shot_now(s).ledger.supplied > 1e4);
    circuit_shot_free(s);
    hump[8].current = 700.0; /* a measured one does not end at exactly 0: it falls to 0 in one interval more */
    OK(circuit_shot_create(&c, &s));
    OK(circuit_shot_advance(s, hump[8].time, NULL));
    assert_near(circuit_shot_now(s).current, 700.0, 1e-9 * 4e5);
    OK(circuit_shot_advance(s, INFINITY, NULL));
    assert_true(circuit_shot_now(s).current == 0.0 && circuit_shot_now(s).t >= 2 * hump[8].time - hump[7].time);
    circuit_shot_free(s);
    circuit_supply_profile bad = all.profile;
    hump[8].current = 0.1 * 4e5;
    c.supplies[CIRCUIT_SUPPLY_profile].item = &bad;
    const status st = circuit_shot_create(&c, &s);
    assert_int_equal(st.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(st.text, "current_profiles[0]"));
}

/* Two pulses with a rest between: a given current goes on after a zero. */
static void profile_comes_back(void **state)
{
    (void)state;
    for (int rest = 0; rest < 2; rest++) {
        circuit_supply_point points[] = { { 0.0, 0.0 },    { 4e-4, 3e5 },   { 8e-4, 0.0 },
                                          { 1.2e-3, 3e5 }, { 1.6e-3, 0.0 }, { 1.6e-3, 0.0 } };
        int n = 5;
        if (rest) {
            for (int k = 5; k > 3; k--) points[k] = points[k - 1], points[k].time += 4e-4;
            points[3] = (circuit_supply_point){ 1.2e-3, 0.0 }, n = 6;
        }
        circuit_supply_profile p;
        base_params_default(circuit_supply_profile_params, &p);
        p.points.n = n, p.points.item = points;
        circuit_shot_config c = plain_barrel();
        c.supplies[CIRCUIT_SUPPLY_profile] = (circuit_supply_list){ 1, &p };
        circuit_shot *s = NULL;
        OK(circuit_shot_create(&c, &s));
        OK(circuit_shot_advance(s, points[1].time, NULL));
        const double once = circuit_shot_now(s).v;
        OK(circuit_shot_advance(s, points[n - 2].time, NULL));
        assert_near(circuit_shot_now(s).current, 3e5, 1e-9 * 3e5);
        assert_true(circuit_shot_now(s).v > 2.0 * once);
        OK(circuit_shot_advance(s, INFINITY, NULL));
        assert_near(circuit_shot_now(s).ledger.energy_error, 0.0, 1e-6);
        circuit_shot_free(s);
    }
}

/* A pulse much shorter than what came before is not stepped over. */
static void late_spike(void **state)
{
    (void)state;
    circuit_supply_point points[] = { { 0.0, 0.0 }, { 0.05, 0.0 }, { 0.05001, 5e5 }, { 0.05002, 0.0 } };
    circuit_supply_profile p;
    base_params_default(circuit_supply_profile_params, &p);
    p.points.n = 4;
    p.points.item = points;
    circuit_shot_config c = short_circuit();
    c.supplies[CIRCUIT_SUPPLY_profile] = (circuit_supply_list){ 1, &p };
    circuit_shot *s = run(&c);
    assert_near(circuit_shot_result(s).peak_current, 5e5, 1.0);
    circuit_shot_free(s);
}

/* ---- the module's options ---- */

/* No diode at all: i = V_0/(w L) e^(-at) sin wt for as long as one likes. */
static void ringing(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(1, 0.0);
    m.crowbar = m.series_diode = false;
    circuit_shot_config c = short_circuit();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    c.options.rtol = 1e-11;
    c.options.atol = 1e-13;
    circuit_shot *s = NULL;
    OK(circuit_shot_create(&c, &s));
    const double a = 0.5 * m.resistance / m.inductance, w = sqrt(1.0 / (m.inductance * m.capacitance) - a * a);
    const double peak = m.charge / (w * m.inductance);
    double worst = 0.0, least = 0.0;
    for (int k = 1; k <= 100; k++) {
        const double t = 5e-5 * k, i = peak * exp(-a * t) * sin(w * t);
        OK(circuit_shot_advance(s, t, NULL));
        worst = fmax(worst, fabs(circuit_shot_now(s).current - i));
        least = fmin(least, circuit_shot_now(s).current);
    }
    print_message("ringing: worst %.1e of peak\n", worst / peak);
    assert_true(worst < 1e-8 * peak && least < -0.3 * peak);
    circuit_shot_free(s);
}

/* Crowbar but no series diode: the current reverses through the diode's end, and the capacitor charges again. */
static void reversal_through_a_crowbar(void **state)
{
    (void)state;
    circuit_shot_module m[2] = { unit_200kJ(1, 0.0), unit_200kJ(6, 2e-4) };
    m[0].series_diode = false;
    m[0].charge = 3e3;
    m[0].cable_inductance = m[1].cable_inductance = 1e-6;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 2, m };
    c.options.max_time = 0.02;
    circuit_shot *s = run(&c);
    assert_true(notes.count[CIRCUIT_SHOT_RECHARGED] >= 1);
    circuit_shot_free(s);
}

static double muzzle_velocity(const circuit_shot_module *m, int n)
{
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ n, m };
    circuit_shot *s = run(&c);
    const double v = circuit_shot_result(s).muzzle_velocity;
    circuit_shot_free(s);
    return v;
}

/* An endless damping resistor is none; a small one takes the coil out of the circuit and its heat is booked. */
static void damping(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    m.cable_inductance = 1e-6;
    const double bare = muzzle_velocity(&m, 1);
    m.damping_resistance = 1e6;
    assert_near(muzzle_velocity(&m, 1), bare, 1e-5 * bare); /* wL/R_p = 3e-8 of the current */
    m.damping_resistance = 0.2;
    const double damped = muzzle_velocity(&m, 1);
    print_message("muzzle velocity %.3f, damped %.3f m/s\n", bare, damped);
    assert_true(fabs(damped / bare - 1.0) > 1e-3);
    m.cable_inductance = 0.0;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot *s = NULL;
    assert_int_equal(circuit_shot_create(&c, &s).code, STATUS_BAD_INPUT);
}

/* Where the module's current ends, its coil still carries one through the resistor beside it: that is heat, not stored
 * for ever. */
static void damped_coil_ends_empty(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    m.cable_inductance = 1e-6;
    m.damping_resistance = 1e-3; /* L_p / R_p is many times the shot */
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot *s = run(&c);
    const circuit_shot_state end = circuit_shot_now(s);
    print_message("coils %g J, their heat %g J, energy error %.1e\n", end.ledger.coils, end.ledger.coil_heat,
                  end.ledger.energy_error);
    assert_true(end.ledger.coils == 0.0);
    assert_true(fabs(end.ledger.energy_error) < 1e-6);
    circuit_shot_free(s);
}

/* ---- feeds along the barrel, muzzle shunt ---- */

static void feed_at_the_breech_is_the_breech(void **state)
{
    (void)state;
    circuit_shot_module m[2] = { unit_200kJ(6, 0.0), unit_200kJ(6, 3e-4) };
    m[0].cable_inductance = m[1].cable_inductance = 1e-6;
    const double together = muzzle_velocity(m, 2);
    m[1].position = 1e-9;
    assert_near(muzzle_velocity(m, 2), together, 1e-7 * together);
    m[1].position = 0.09; /* less rail in its way: 0.045 uH of 1.5 */
    assert_true(muzzle_velocity(m, 2) > together);
}

/* Two feeds of ideal sources behind inductances, by Runge-Kutta: y = u_0, i_0, u_1, i_1, x, v.  Level constant, no
 * losses. */
typedef struct {
    const circuit_shot_module *m;
    double Lr, mass, join;
} two_feeds;

static void two_feeds_slope(const two_feeds *c, const double *y, double *d)
{
    const double L0 = c->m[0].inductance, L1 = c->m[1].inductance, x = y[4], v = y[5];
    const double I = y[1] + y[3], e = c->Lr * v * I;
    const bool passed = x >= c->join;
    const double A = c->Lr * (passed ? c->join : x), B = passed ? c->Lr * (x - c->join) : 0.0;
    /* L0 i0' + A i0' + B (i0' + i1') = u0 - e,  L1 i1' + B (i0' + i1') = u1 - e */
    const double det = (L0 + A + B) * (L1 + B) - B * B;
    d[1] = passed ? ((L1 + B) * (y[0] - e) - B * (y[2] - e)) / det : (y[0] - e) / (L0 + A);
    d[3] = passed ? ((L0 + A + B) * (y[2] - e) - B * (y[0] - e)) / det : 0.0;
    d[0] = -y[1] / c->m[0].capacitance;
    d[2] = -y[3] / c->m[1].capacitance;
    d[4] = v;
    d[5] = 0.5 * c->Lr * I * I / c->mass;
}

static void two_feeds_step(const two_feeds *c, double h, double *y)
{
    double k[4][6], z[6];
    static const double at[4] = { 0.0, 0.5, 0.5, 1.0 };
    for (int stage = 0; stage < 4; stage++) {
        for (int j = 0; j < 6; j++) z[j] = y[j] + (stage ? at[stage] * h * k[stage - 1][j] : 0.0);
        two_feeds_slope(c, z, k[stage]);
    }
    for (int j = 0; j < 6; j++) y[j] += h / 6.0 * (k[0][j] + 2.0 * k[1][j] + 2.0 * k[2][j] + k[3][j]);
}

/* Up to `end` of the armature's way, to 1e-16 s. */
static void two_feeds_until(const two_feeds *c, double end, double *y)
{
    for (double h = 1e-6; h > 1e-16;) {
        double z[6];
        memcpy(z, y, sizeof z);
        two_feeds_step(c, h, z);
        if (z[4] > end) {
            h *= 0.5;
        } else {
            memcpy(y, z, sizeof z);
        }
    }
}

static void joining_on_the_way(void **state)
{
    (void)state;
    circuit_shot_module m[2] = { unit_200kJ(1, 0.0), unit_200kJ(1, 0.0) };
    for (int k = 0; k < 2; k++) {
        m[k].capacitance = 1.0; /* far from empty at the muzzle: no crowbar to model twice */
        m[k].resistance = 0.0;
        m[k].charge = 3e3;
    }
    m[1].position = 0.8;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 2, m };
    c.rails.resistance_gradient = 0.0;
    c.armature.resistance = c.armature.contact_voltage = c.armature.preload = c.armature.friction_dry = 0.0;
    c.armature.friction_melted = c.armature.spreading = c.armature.gas_density = 0.0;
    c.armature.velocity = 10.0;
    c.barrel.length = 2.0;
    c.options.rtol = 1e-10;
    c.options.atol = 1e-12;
    const two_feeds own = { m, c.rails.inductance_gradient, c.armature.mass, m[1].position };
    double y[6] = { m[0].charge, 0.0, m[1].charge, 0.0, c.barrel.start, 10.0 };
    two_feeds_until(&own, m[1].position, y);
    y[4] = m[1].position;
    two_feeds_until(&own, c.barrel.length, y);
    circuit_shot *s = run(&c);
    const circuit_shot_summary r = circuit_shot_result(s);
    print_message("two feeds: %.4f m/s, differs by %.1e\n", r.muzzle_velocity, r.muzzle_velocity / y[5] - 1.0);
    assert_near(r.muzzle_velocity, y[5], 1e-8 * y[5]); /* Runge-Kutta at 1 us is good to 1e-10, rtol 1e-10 to 1e-9 */
    assert_near(r.exit_current, y[1] + y[3], 1e-8 * r.exit_current);
    assert_int_equal(notes.count[CIRCUIT_SHOT_FIRED], 2);
    assert_true(notes.time[CIRCUIT_SHOT_FIRED] > 1e-4); /* the second one on the way, not at the start */
    circuit_shot_free(s);
}

static void a_barrel_of_feeds(void **state)
{
    (void)state;
    circuit_shot_module m[12];
    for (int k = 0; k < 12; k++) {
        m[k] = unit_200kJ(2, 0.0);
        m[k].position = k * 0.4;
        m[k].charge = 6e3;
    }
    m[0].count = 10;
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 12, m };
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    circuit_shot *s = run(&c);
    print_message("12 feeds: %.1f m/s, peak %.0f kA, worst energy error %.1e, %llu steps\n",
                  circuit_shot_result(s).muzzle_velocity, 1e-3 * circuit_shot_result(s).peak_current, notes.worst_error,
                  (unsigned long long)circuit_shot_result(s).steps);
    assert_int_equal(notes.count[CIRCUIT_SHOT_FIRED], 12);
    m[3].position = 5.0;
    circuit_shot *none = NULL;
    assert_int_equal(circuit_shot_create(&c, &none).code, STATUS_BAD_INPUT);
    circuit_shot_free(s);
}

static bool few_steps(void *user, const circuit_shot *s, const circuit_shot_state *st)
{
    (void)st;
    return circuit_shot_result(s).steps < *(const uint64_t *)user;
}

/* The ring of a small laboratory bank past a contact of 2 V and a shunt, 220 A at most, and its copy of 1.1 MA:
 * impedances over 100, voltages times 50.  Both take about as many steps. */
static void small_currents_ring_alike(void **state)
{
    (void)state;
    uint64_t steps[2], most = 20000;
    for (int k = 0; k < 2; k++) {
        const double Z = k ? 0.01 : 1.0, V = k ? 50.0 : 1.0;
        circuit_shot_module m = unit_200kJ(1, 0.0);
        m.capacitance = 20e-6 / Z;
        m.charge = 200.0 * V;
        m.inductance = 16e-6 * Z;
        m.resistance = 4e-3 * Z;
        m.crowbar = m.series_diode = false;
        circuit_shot_config c = plain_barrel();
        c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
        c.rails.inductance_gradient *= Z;
        c.rails.resistance_gradient *= Z;
        c.barrel.length = 0.3;
        c.barrel.shunt_resistance = 0.05 * Z;
        c.barrel.shunt_inductance = 1e-7 * Z;
        c.armature.mass = 1e3;
        c.armature.resistance *= Z;
        c.armature.contact_voltage = 2.0 * V;
        c.options.max_time = 3e-4;
        circuit_shot *s = NULL;
        OK(circuit_shot_create(&c, &s));
        OK(circuit_shot_advance(s, INFINITY, &(circuit_shot_sink){ NULL, few_steps, &most }));
        steps[k] = circuit_shot_result(s).steps;
        print_message("%.4g A: %d steps\n", circuit_shot_result(s).peak_current, (int)steps[k]);
        circuit_shot_free(s);
    }
    assert_true(steps[0] < 2 * steps[1] && steps[1] < 2 * steps[0]);
}

/* A shunt of great resistance is none; one of little takes current from the armature and slows it; what it burns is
 * booked. */
static void muzzle_shunt(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    c.barrel.length = 2.0;
    circuit_shot *bare = run(&c);
    c.barrel.shunt_resistance = 1e3;
    circuit_shot *open = run(&c);
    const double v = circuit_shot_result(bare).muzzle_velocity;
    assert_near(circuit_shot_result(open).muzzle_velocity, v,
                1e-5 * v); /* 30 V over 1 kohm of 1 MA, and the contact's knee */
    c.barrel.shunt_resistance = 1e-4;
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    circuit_shot *shunted = run(&c);
    const circuit_shot_state now = circuit_shot_now(shunted);
    print_message("muzzle velocity %.2f m/s, with a shunt of 0.1 mohm %.2f; worst energy error %.1e\n", v,
                  circuit_shot_result(shunted).muzzle_velocity, notes.worst_error);
    assert_true(circuit_shot_result(shunted).muzzle_velocity < v);
    assert_true(now.ledger.muzzle > 0.0);
    circuit_shot_free(bare);
    circuit_shot_free(open);
    circuit_shot_free(shunted);
}

/* ---- limits and temperatures ---- */

/* Each limit by hand from its formula; a case that gives nothing is told nothing. */
static void limits(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot *s = run(&c);
    circuit_shot_limits l = circuit_shot_limits_of(s);
    assert_true(isnan(l.leg_action) && isnan(l.wear_share) && isnan(l.critical_velocity) &&
                isnan(l.transition_position));
    assert_true(l.contact_ratio > 1.0); /* 5 kN + 3e-8 I^2 against 9.81e-3 I: least 2.5 at 408 kA */
    assert_near(l.contact_ratio, 2.0 * sqrt(5e3 * 3e-8) / 9.80665e-3, 1e-3);
    circuit_shot_free(s);

    c.armature.preload = 10.0;
    c.armature.spreading = 1e-9;
    c.armature.leg_area = 3e-4;
    c.armature.throat_area = 6e-4;
    c.armature.wear_fraction = 0.3;
    c.armature.wear_thickness = 1e-4;
    c.rails.backing_stiffness = 1e9;
    s = run(&c);
    l = circuit_shot_limits_of(s);
    const double melting = 2804.0 * 848.0 / (5.15e-8 * 2e-3) * log1p(2e-3 * (750.0 - 293.15));
    const double worn = (c.armature.mass - circuit_shot_now(s).mass) / (2.0 * 2804.0 * 0.02 * 0.025);
    const double bending = 124e9 * 0.025 * 8e-6 / 12.0,
                 speed = sqrt(2.0 * sqrt(1e9 * bending) / (8960.0 * 0.025 * 0.020));
    print_message("contact ratio %.3f, leg %.3f, wear %.2f, bending waves %.0f m/s, from x = %.2f m\n", l.contact_ratio,
                  l.leg_action, l.wear_share, l.critical_velocity, l.critical_position);
    assert_near(l.leg_action, circuit_shot_result(s).action / (melting * 9e-8), 1e-9);
    assert_near(l.throat_action, 0.25 * l.leg_action, 1e-9);
    assert_near(l.wear_share, worn / 1e-4, 1e-6 * l.wear_share);
    assert_near(l.critical_velocity, speed, 1e-6 * speed);
    assert_true(l.contact_ratio < 1.0 && l.transition_position <= l.contact_position);
    assert_true(l.critical_position > c.barrel.start && l.critical_position < c.barrel.length);
    circuit_shot_free(s);
}

/* The surface current of a rail just exposed goes with the section: (C-17)'s table. */
static void surface_current_by_section(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(1, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    for (int k = 0; k < 2; k++) {
        c.rails.height = k ? 0.1 : 0.025;
        c.options.max_time = 1e-4;
        circuit_shot *s = run(&c);
        const circuit_shot_state now = circuit_shot_now(s);
        assert_near(now.rail_sheet * c.rails.height / now.current, k ? 0.665 : 0.400, 1e-3);
        circuit_shot_free(s);
    }
}

static bool temperatures_in_order(void *user, const circuit_shot *s, const circuit_shot_state *st)
{
    (void)s;
    if (st->phase != CIRCUIT_SHOT_MOVING || st->v < 1.0) return true;
    assert_true(st->film_temperature >= st->armature_temperature);
    assert_true(st->rail_behind_temperature > st->rail_temperature);
    *(double *)user = fmax(*(double *)user, st->film_temperature);
    return true;
}

/* The rail behind is hotter than the one ahead, melt no colder than what it came from; no wear, no film. */
static void temperatures(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    double hottest[2] = { 0.0, 0.0 };
    for (int k = 0; k < 2; k++) {
        circuit_shot *s = NULL;
        const circuit_shot_sink sink = { .sample = temperatures_in_order, .user = &hottest[k] };
        c.armature.wear_fraction = 0.3 * k;
        OK(circuit_shot_create(&c, &s));
        OK(circuit_shot_advance(s, INFINITY, &sink));
        circuit_shot_free(s);
    }
    assert_near(hottest[0], c.armature.melting_temperature, 1e-9);
    assert_true(hottest[1] > hottest[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(law_of_the_table),
        cmocka_unit_test(recharged),
        cmocka_unit_test(every_kind_shoots),
        cmocka_unit_test(all_kinds_together),
        cmocka_unit_test(homopolar_is_a_capacitor),
        cmocka_unit_test(opening_switch),
        cmocka_unit_test(arc_goes_on),
        cmocka_unit_test(empty_store),
        cmocka_unit_test(current_of_either_sign),
        cmocka_unit_test(alternator_pulses),
        cmocka_unit_test(profile_is_followed),
        cmocka_unit_test(profile_comes_back),
        cmocka_unit_test(late_spike),
        cmocka_unit_test(ringing),
        cmocka_unit_test(reversal_through_a_crowbar),
        cmocka_unit_test(damping),
        cmocka_unit_test(damped_coil_ends_empty),
        cmocka_unit_test(feed_at_the_breech_is_the_breech),
        cmocka_unit_test(joining_on_the_way),
        cmocka_unit_test(a_barrel_of_feeds),
        cmocka_unit_test(muzzle_shunt),
        cmocka_unit_test(small_currents_ring_alike),
        cmocka_unit_test(limits),
        cmocka_unit_test(surface_current_by_section),
        cmocka_unit_test(temperatures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
