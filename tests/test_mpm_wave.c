/* SPDX-License-Identifier: BSD-3-Clause */
/* Waves that enter water through a face, in scenes of one dimension: what a metal, a rigid wall and a free face make of
 * them, the wave of a piston beside the tube that made it, Taylor's plate with the cavity that it leaves. */
#include "mpm_scenes.h"

#include "mpm/tube.h"
#include "mpm/wave.h"

static const double P0 = 1e6;

/* With a viscosity that lets fronts pass without ringing. */
static mpm_material water(void)
{
    mpm_material m = scene_water();
    m.viscosity_linear = 0.06, m.viscosity_quadratic = 2;
    return m;
}

static double pressure_at(const mpm *m, double lo, double hi)
{
    double *x = scene_read(m, MPM_position), *s = scene_read(m, MPM_stress), sum = 0, n = 0;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (x[3 * i] > lo && x[3 * i] < hi) sum -= s[6 * i], n++;
    free(x), free(s);
    assert_true(n > 0);
    return sum / n;
}

/* The same of the points that began between two places. */
static double pressure_at_start(const mpm *m, double lo, double hi)
{
    double *x = scene_read(m, MPM_start), *p = scene_read(m, MPM_pressure), sum = 0, n = 0;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (x[3 * i] > lo && x[3 * i] < hi) sum += p[i], n++;
    free(x), free(p);
    return sum / n;
}

/* Energy that the books cannot place [J]. */
static double energy_left(const mpm_ledger *l)
{
    return l->kinetic + l->internal - l->work_ahead + l->ejected_energy - l->work_boundary - l->work_external -
           l->energy_start;
}

/* At 1 atm at rest. */
static mpm_material stiffened_gas(double density, double specific_heat, double gamma, double stiffness)
{
    mpm_material m = water();
    m.eos = MPM_EOS_stiffened_gas, m.density = density, m.specific_heat = specific_heat;
    m.gas_gamma = gamma, m.gas_stiffness = stiffness, m.gas_pressure = 101325, m.cavitation_pressure = -101325;
    return m;
}

/* Water of `length` from x = 0 on, into which a wave comes at x = 0. */
static mpm_body *column(mpm_scene *s, const mpm_material *m, double length, double beyond, double h)
{
    scene_bar(s, -4 * h, length + beyond, h, 1);
    s->contact = mpm_contact_of(mpm_contact_find("frictionless"));
    return scene_box(s, 0, -1, -1, length, 1, 1, m);
}

/* U5: a step of 1 MPa meets another body: p/p0 = 2 Z2/(Z1 + Z2) with the longitudinal impedance, 2 at a held one; a
 * free face moves on with twice the water's velocity.  1 %. */
static void test_reflection(void **state)
{
    (void)state;
    const double h = 1e-3, length = 40e-3, beyond = 75e-3;
    const char *kinds[] = { "copper", "aluminium", "held", "nothing" };
    for (int k = 0; k < 4; k++) {
        const mpm_material m = water();
        mpm_material metal = k == 1 ? scene_aluminium() : scene_elastic();
        SCENE_LOCAL(s);
        column(&s, &m, length, beyond, h)->wave_pressure = P0;
        if (k < 3) scene_box(&s, length, -1, -1, length + beyond, 1, 1, &metal)->group = 1;
        if (k == 2) s.body[1].held = true;
        mpm *solver = scene_make(&s, 1);
        assert_ok(mpm_advance(solver, 1.8 * length / WATER_C0, NULL));
        const double Z1 = WATER_RHO0 * WATER_C0, Z2 = metal.density * mpm_material_longitudinal_speed(&metal);
        const double want = k < 2 ? 2 * Z2 / (Z1 + Z2) : k == 2 ? 2 : 0;
        const double p = pressure_at(solver, 0.8 * length, 0.95 * length) / P0,
                     v = scene_mean(solver, MPM_velocity, 0, 0);
        const mpm_ledger l = mpm_balance(solver);
        print_message("1 MPa on %s: %.4f fold (%.4f), mean velocity %.3f mm/s, energy %.0e, momentum %.0e\n", kinds[k],
                      p, want, 1e3 * v, l.energy_error * l.kinetic_start, l.momentum_error);
        assert_near(p, want, 0.01 * fmax(want, 1));
        if (k == 3) assert_near(v, 1.8 * P0 / Z1, 0.01 * P0 / Z1); /* 0.8 of it at 2 P0/Z1, the rest at P0/Z1 */
        if (k == 2) { /* what the wall has sent back has left through the face */
            assert_ok(mpm_advance(solver, 2.8 * length / WATER_C0, NULL));
            assert_near(pressure_at(solver, 0.3 * length, 0.5 * length) / P0, 2, 0.02);
        }
        mpm_free(solver);
    }
}

/* Water that rests under a pressure stays at rest where a wave of nothing comes in: the face gives what it rests
 * under. */
static void test_rest(void **state)
{
    (void)state;
    const mpm_material m = stiffened_gas(1000, 157.6, 7.415, 296.2e6);
    for (int k = 0; k < 2; k++) {
        SCENE_LOCAL(s);
        mpm_body *b = column(&s, &m, 10e-3, 0, 1e-3);
        b->wave_pressure = 0;
        if (k == 0) s.surroundings = 0;
        if (k == 1) b->pressure = 1e5;
        s.axis[0].boundary[1] = MPM_BOUNDARY_FIXED;
        mpm *solver = scene_make(&s, 1);
        assert_ok(mpm_advance(solver, 20e-6, NULL));
        assert_near(scene_mean(solver, MPM_velocity, 0, 0), 0, 1e-4); /* -0.02 m/s where the face gives nothing */
        mpm_free(solver);
    }
}

/* A wave into air gives it its motion whether pressures count from that of the air or from nothing. */
static void test_wave_in_air(void **state)
{
    (void)state;
    const mpm_material m = stiffened_gas(1.2041, 717.65, 1.4, 0);
    double v[2];
    for (int k = 0; k < 2; k++) {
        SCENE_LOCAL(s);
        mpm_body *b = column(&s, &m, 10e-3, 0, 1e-3);
        b->wave_pressure = 10e3;
        if (k == 1) s.surroundings = 0;
        s.axis[0].boundary[1] = MPM_BOUNDARY_FIXED;
        mpm *solver = scene_make(&s, 1);
        assert_ok(mpm_advance(solver, 20e-6, NULL));
        v[k] = scene_mean(solver, MPM_velocity, 0, 0);
        mpm_free(solver);
    }
    const double way = 7.15e-3, behind = 23.5; /* of the front, c + s u, after 20 us; p = rho (c + s u) u */
    print_message("air, a wave of 10 kPa: %.3f and %.3f m/s\n", v[0], v[1]);
    for (int k = 0; k < 2; k++) assert_near(v[k] / (behind * way / 10e-3), 1, 0.2); /* the face is a cell thick */
}

/* Water that runs away from the face is not pulled back. */
static void test_no_pull(void **state)
{
    (void)state;
    const mpm_material m = water();
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, 10e-3, 10e-3, 1e-3);
    b->wave_pressure = 0, b->velocity[0] = 10;
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 20e-6, NULL));
    assert_near(scene_mean(solver, MPM_velocity, 0, 0), 10, 1e-9);
    mpm_free(solver);
}

/* A piston's wave 40 mm into the water, beside the tube's own at that place: peak 3 %, for the solver's front is
 * wider by its cells, impulse 1 %. */
static void test_piston_wave(void **state)
{
    (void)state;
    const mpm_material m = water();
    const double h = 0.5e-3, length = 80e-3, gauge = 40e-3, tube_length = 0.2, end = 50e-6;
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, length, 4 * h, h);
    b->piston_mass = 73.98, b->piston_velocity = 22.94, b->tube_length = tube_length;
    mpm *solver = scene_make(&s, 1);
    const mpm_tube_setup setup = { &m, 73.98, 22.94, tube_length + gauge + 50e-3, TUBE_GOES_ON, 0, 580 };
    mpm_tube *t;
    assert_ok(mpm_tube_create(&setup, &t));
    double peak[2] = { 0, 0 }, impulse[2] = { 0, 0 }, start = NAN;
    while (isnan(start)) {
        mpm_tube_step(t);
        if (mpm_tube_pressure(t, tube_length) > 0.01 * WATER_RHO0 * WATER_C0 * 22.94) start = mpm_tube_now(t).time;
    }
    for (int i = 1; i <= 200; i++) {
        mpm_tube_advance(t, start + end * i / 200);
        assert_ok(mpm_advance(solver, end * i / 200, NULL));
        const double p[2] = { pressure_at_start(solver, gauge - h, gauge + h),
                              mpm_tube_pressure(t, tube_length + gauge) };
        for (int k = 0; k < 2; k++) peak[k] = fmax(peak[k], p[k]), impulse[k] += p[k] * end / 200;
    }
    const mpm_ledger l = mpm_balance(solver);
    print_message("piston: peak %.3f MPa (tube %.3f), impulse %.1f Pa s (%.1f), work %.3g J\n", 1e-6 * peak[0],
                  1e-6 * peak[1], impulse[0], impulse[1], l.work_external);
    assert_near(peak[0] / peak[1], 1, 0.03);
    assert_near(impulse[0] / impulse[1], 1, 0.01);
    assert_near(energy_left(&l) / l.work_external, 0, 1e-9);
    mpm_free(solver);
    mpm_tube_free(t);
}

/* U10, U11: an aluminium plate of 3 mm at the end of 60 mm of water, with nothing behind it: largest velocity and way
 * beside the tube's, 3 % and 5 %, and books to 1e-9 while the water behind it cavitates.  The same
 * bits on any number of threads and across a checkpoint. */
static void test_plate(void **state)
{
    (void)state;
    const double h = 1e-3, length = 60e-3, plate = 3e-3, tube_length = 0.1, end = 120e-6;
    const mpm_material m = water(), metal = scene_aluminium();
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, length, 14 * h, h);
    b->piston_mass = 73.98, b->piston_velocity = 22.94, b->tube_length = tube_length;
    scene_box(&s, length, -1, -1, length + plate, 1, 1, &metal)->group = 1;
    mpm *solver = scene_make(&s, 1);
    const mpm_tube_setup setup = { &m, 73.98, 22.94, tube_length + length, TUBE_PLATE, metal.density * plate, 400 };
    mpm_tube *t;
    assert_ok(mpm_tube_create(&setup, &t));
    while (!(mpm_tube_pressure(t, tube_length) > 0.01 * WATER_RHO0 * WATER_C0 * 22.94)) mpm_tube_step(t);
    mpm_tube_advance(t, mpm_tube_now(t).time + end);
    double fastest = 0, low = 0;
    for (int i = 1; i <= 40; i++) {
        assert_ok(mpm_advance(solver, end * i / 40, NULL));
        fastest = fmax(fastest, scene_mean(solver, MPM_velocity, 0, 1));
        double *p = scene_read(solver, MPM_pressure), *of = scene_read(solver, MPM_body);
        for (size_t q = 0; q < mpm_points(solver); q++)
            if (of[q] == 0) low = fmin(low, p[q]);
        free(p), free(of);
    }
    const mpm_tube_state want = mpm_tube_now(t);
    const double way = scene_mean(solver, MPM_position, 0, 1) - length - 0.5 * plate;
    const mpm_ledger l = mpm_balance(solver);
    print_message("plate: %.2f m/s (tube at the end %.2f), way %.3f mm (%.3f), least pressure %.0f Pa, energy %.0e\n",
                  fastest, want.end_velocity, 1e3 * way, 1e3 * want.end_way, low, energy_left(&l) / l.work_external);
    assert_near(way / want.end_way, 1, 0.05);
    assert_near(fastest / want.end_velocity, 1, 0.03);
    assert_true(low >= 0 && mpm_state(solver).clamps_pressure > 0);
    assert_near(energy_left(&l) / l.work_external, 0, 1e-9);
    mpm_free(solver);
    mpm_tube_free(t);
    mpm_free(scene_same_bits(&s, 30, 30));
}

/* Water far ahead of the front is at rest and not stepped. */
static void test_sleeps(void **state)
{
    (void)state;
    const mpm_material m = water();
    const double h = 1e-3, length = 60e-3;
    SCENE_LOCAL(s);
    column(&s, &m, length, 4 * h, h)->wave_pressure = P0;
    for (int k = 1; k < 3; k++) s.axis[k] = scene_axis(-6 * h, 6 * h, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_values(&s, 0)[1] = scene_values(&s, 0)[2] = -2 * h, scene_values(&s, 0)[4] = scene_values(&s, 0)[5] = 2 * h;
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 0.5 * length / WATER_C0, NULL));
    const mpm_report r = mpm_state(solver);
    const double asleep = (double)r.particle_steps_asleep / (double)(r.particle_steps + r.particle_steps_asleep);
    print_message("front half way: %.0f %% of the point-steps were left out\n", 100 * asleep);
    assert_true(asleep > 0.5);
    mpm_free(solver);
}

/* What is bonded to a held body stays where it is, whatever the window's end says, and the impulse that holds it is
 * booked. */
static void test_held(void **state)
{
    (void)state;
    const mpm_material metal = scene_elastic();
    const double h = 0.5e-3;
    SCENE_LOCAL(s);
    scene_bar(&s, -2 * h, 12 * h, h, 2);
    s.axis[0].boundary[0] = MPM_BOUNDARY_PRESCRIBED, s.axis[0].boundary_velocity[0][0] = 5;
    mpm_body *moving = scene_box(&s, 0, -1, -1, 4 * h, 1, 1, &metal);
    moving->velocity[0] = -1;
    mpm_body *wall = scene_box(&s, -2 * h, -1, -1, 0, 1, 1, &metal);
    wall->group = 1, wall->held = true;
    scene_pair(&s, 0, 1)[COULOMB_BOND_STRENGTH] = 1e12;
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 20e-6, NULL));
    const mpm_ledger l = mpm_balance(solver);
    const double at = scene_mean(solver, MPM_position, 0, 0), wall_at = scene_mean(solver, MPM_position, 0, 1);
    print_message(
        "bonded to a held body: %.2e mm from its place, held body moved %.1e mm, momentum %.0e, energy %.0e\n",
        1e3 * (at - 2 * h), 1e3 * (wall_at + h), l.momentum_error, l.energy_error);
    assert_near(wall_at, -h, 1e-15);
    assert_near(at, 2 * h, 1e-6);
    assert_below(l.momentum_error, 1e-12);
    assert_near(l.energy_error, 0, 1e-10);
    mpm_free(solver);
}

static void assert_refused(const mpm_scene *s, const char *word)
{
    mpm *m;
    const status refused = mpm_create(s, 1, &m);
    assert_int_equal(refused.code, STATUS_BAD_INPUT);
    if (!strstr(refused.text, word)) fail_msg("`%s` lacks `%s`", refused.text, word);
}

/* A heavy piston's wave lasts longer than any scene: the tube is computed as far as the scene goes, and as it was
 * asked for makes no difference. */
static void test_piston_on_demand(void **state)
{
    (void)state;
    const mpm_material m = water();
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, 4e-3, 2e-3, 1e-3);
    b->piston_mass = 1e6, b->piston_velocity = 1, b->tube_length = 0.05;
    mpm_free(scene_make(&s, 1)); /* at once, though the wave would take 14 s of 70 million rows */
    law k;
    assert_ok(mpm_law_make(b, &s, &k));
    for (int pass = 0; pass < 2; pass++) {
        mpm_wave w;
        assert_ok(mpm_wave_make(b, &k, &w));
        for (double t = 0; pass == 1 && t < 20e-6; t += 1e-6) assert_ok(mpm_wave_reach(&w, t));
        assert_ok(mpm_wave_reach(&w, 20e-6));
        const wave_load load = mpm_wave_load(&w, b, &k, 20e-6);
        print_message("piston of 1000 t/m2: %.4f of rho c v after 20 us, %d rows\n",
                      load.base / (2 * WATER_RHO0 * WATER_C0), w.n);
        assert_near(load.base / (2 * WATER_RHO0 * WATER_C0), 1, 0.01); /* p_i + Z u_i */
        assert_in_range(w.n, 20, 1000);
        mpm_wave_free(&w);
    }
}

/* A light piston's wave decays within a fraction of a millimetre: cells fine enough for that, or a refusal. */
static void test_light_piston(void **state)
{
    (void)state;
    const mpm_material m = water();
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, 4e-3, 2e-3, 1e-3);
    law k;
    assert_ok(mpm_law_make(b, &s, &k));
    b->piston_mass = 0.2, b->piston_velocity = 0.01, b->tube_length = 0.01; /* a decay of 0.2 mm, on sound */
    mpm_wave w;
    assert_ok(mpm_wave_make(b, &k, &w));
    const double theta = 0.2 / (WATER_RHO0 * WATER_C0);
    double impulse = 0;
    assert_ok(mpm_wave_reach(&w, 8 * theta));
    for (int i = 1; i < w.n; i++) impulse += 0.5 * (w.incident[i] + w.incident[i - 1]) * (w.time[i] - w.time[i - 1]);
    print_message("light piston: impulse %.4f of M v\n", impulse / (0.2 * 0.01));
    assert_near(impulse / (0.2 * 0.01), 1, 0.02);
    mpm_wave_free(&w);
    b->piston_mass = 1e-3;
    assert_refused(&s, "heavier piston");
    b->piston_mass = 70, b->tube_length = 100;
    assert_refused(&s, "at most 5 m");
}

static void test_refused(void **state)
{
    (void)state;
    const mpm_material m = water(), metal = scene_copper();
    SCENE_LOCAL(s);
    mpm_body *b = column(&s, &m, 4e-3, 2e-3, 1e-3);
    b->wave_decay = 1e-6;
    assert_refused(&s, "no wave_pressure");
    b->wave_pressure = P0, b->piston_mass = 1;
    assert_refused(&s, "one of them");
    b->wave_pressure = b->wave_decay = NAN;
    assert_refused(&s, "piston_velocity");
    b->piston_mass = NAN, b->wave_pressure = P0, b->material = &metal;
    assert_refused(&s, "fluids only");
    b->wave_pressure = NAN, b->held = true, b->velocity[0] = 1;
    assert_refused(&s, "held");
    b->velocity[0] = 0, b->wave_pressure = P0, b->material = &m;
    assert_refused(&s, "held");
    b->wave_pressure = NAN, b->pressure = P0;
    assert_refused(&s, "held: it can have no pressure at the start");
    b->pressure = 0;
    mpm_free(scene_make(&s, 1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflection),   cmocka_unit_test(test_no_pull),
        cmocka_unit_test(test_wave_in_air),  cmocka_unit_test(test_rest),
        cmocka_unit_test(test_piston_wave),  cmocka_unit_test(test_plate),
        cmocka_unit_test(test_sleeps),       cmocka_unit_test(test_held),
        cmocka_unit_test(test_refused),      cmocka_unit_test(test_piston_on_demand),
        cmocka_unit_test(test_light_piston),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
