/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies that only fly: nothing may happen to them, wherever they cross cells, bricks and gradings, and what leaves the
 * window is booked.  Tolerances are rounding: a step rounds each sum once, about 2e-16, and a thousand steps add up to
 * some 1e-14 at random and 2e-13 at worst, unless said. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

static const double ROUNDING = 1e-12;

static void cube(mpm_scene *s, const mpm_material *m, double h, bool graded)
{
    mpm_scene_default(s);
    for (int k = 0; k < 3; k++) s->axis[k] = scene_axis(0, k ? 18e-3 : 40e-3, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    if (graded) {
        s->axis[0] = scene_graded(s->axis[0], 15e-3, 22e-3, 2.5 * h, 1.2);
        s->axis[1] = scene_graded(s->axis[1], 6e-3, 12e-3, 2.5 * h, 1.2);
    }
    mpm_body *b = scene_box(s, 3.3e-3, 3.3e-3, 3.3e-3, 8.3e-3, 8.3e-3, 8.3e-3, m);
    b->velocity[0] = 300, b->velocity[1] = 100, b->velocity[2] = 50;
}

static void thousand_steps(mpm_basis_kind basis, bool graded, mpm_transfer_kind transfer)
{
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    cube(&s, &m, 1e-3, graded);
    s.basis = basis, s.transfer = transfer;
    mpm *solver = scene_make(&s, 1);
    const double x0 = scene_mean(solver, MPM_position, 0, -1);
    scene_steps(solver, 1000);
    const mpm_ledger l = mpm_balance(solver);
    const mpm_report r = mpm_state(solver);
    const double K0 = mpm_material_bulk_modulus(&m), speed2 = 300.0 * 300 + 100 * 100 + 50 * 50;
    print_message("%s %s %s: %.1f mm, stress / K0 %.2e, kinetic energy %.2e, momentum %.2e, energy %.2e, splits %llu\n",
                  basis == MPM_BASIS_GIMP ? "GIMP" : "B-spline", graded ? "graded" : "uniform",
                  transfer == MPM_TRANSFER_TPIC ? "TPIC" : "PIC", 1e3 * (scene_mean(solver, MPM_position, 0, -1) - x0),
                  scene_largest(solver, MPM_stress) / K0, l.kinetic / l.kinetic_start - 1, l.momentum_error,
                  l.energy_error, (unsigned long long)r.splits);
    assert_below(scene_largest(solver, MPM_stress) / K0, ROUNDING);
    assert_near(l.kinetic / l.kinetic_start, 1, ROUNDING);
    assert_near(l.kinetic / (0.5 * l.mass * speed2), 1, ROUNDING);
    assert_near(l.mass / l.mass_start, 1, ROUNDING);
    assert_below(l.momentum_error, ROUNDING);
    assert_near(l.energy_error, 0, ROUNDING);
    /* every point flew as far as it should: |x - x0 - v t| over the travel */
    assert_near((scene_mean(solver, MPM_position, 0, -1) - x0) / (300 * r.time), 1, ROUNDING);
    /* it did cross several bricks of four cells */
    assert_true(scene_mean(solver, MPM_position, 0, -1) - x0 > (graded ? 8e-3 : 16e-3));
    assert_int_equal(r.ejected, 0);
    mpm_free(solver);
}

static void test_uniform(void **state)
{
    (void)state;
    thousand_steps(MPM_BASIS_GIMP, false, MPM_TRANSFER_TPIC);
    thousand_steps(MPM_BASIS_BSPLINE, false, MPM_TRANSFER_TPIC);
    thousand_steps(MPM_BASIS_GIMP, false, MPM_TRANSFER_PIC);
}

/* A constant velocity needs only the partition of unity, which both bases have on any grading. */
static void test_graded(void **state)
{
    (void)state;
    thousand_steps(MPM_BASIS_GIMP, true, MPM_TRANSFER_TPIC);
    thousand_steps(MPM_BASIS_BSPLINE, true, MPM_TRANSFER_TPIC);
}

/* Out of the window on three sides: what is left plus what left is what was there. */
static void test_leaving(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    cube(&s, &m, 1e-3, false);
    s.axis[0] = scene_axis(0, 12e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.body[0].velocity[0] = 2000;
    mpm *solver = scene_make(&s, 1);
    const mpm_ledger start = mpm_balance(solver);
    scene_steps(solver, 60);
    const mpm_ledger l = mpm_balance(solver);
    const mpm_report r = mpm_state(solver);
    print_message("left the window: %.1f %% of the mass, %llu points; momentum %.2e, energy %.2e\n",
                  100 * l.ejected_mass / start.mass, (unsigned long long)r.ejected, l.momentum_error, l.energy_error);
    assert_true(l.ejected_mass > 0.2 * start.mass && l.mass > 0.2 * start.mass);
    assert_near((l.mass + l.ejected_mass) / start.mass, 1, ROUNDING);
    assert_below(l.momentum_error, ROUNDING);
    /* with no outer force the whole energy is still there, in or out of the window; the cut body stays unloaded */
    assert_near(l.energy_error, 0, ROUNDING);
    assert_int_equal(r.particles, mpm_points(solver));
    assert_int_equal(r.ejected + mpm_points(solver), 1000);
    mpm_free(solver);
}

/* Splitting one particle, whatever its state: mass, momentum, centre of mass, load and energy stay. */
static void test_halves(void **state)
{
    (void)state;
    srand(7);
    for (int trial = 0; trial < 300; trial++) {
        double whole[BLOCK_DOUBLES], a[BLOCK_DOUBLES], b[BLOCK_DOUBLES];
        for (int i = 0; i < BLOCK_DOUBLES; i++) whole[i] = (double)rand() / RAND_MAX;
        for (int i = 0; i < 3; i++) whole[FIRST_v + i] -= 0.5;
        if (trial % 3 == 0) whole[FIRST_ka] = 0; /* then the energy of the parted halves must come out of e */
        memcpy(a, whole, sizeof a);
        const int k = trial % 3;
        mpm_point_halve(a, b, k);
        assert_near(a[FIRST_mass] + b[FIRST_mass], whole[FIRST_mass], 1e-15);
        assert_near(a[FIRST_area] + b[FIRST_area], whole[FIRST_area], 1e-15);
        double before = whole[FIRST_ka] + whole[FIRST_e],
               after[2] = { a[FIRST_ka] + a[FIRST_e], b[FIRST_ka] + b[FIRST_e] };
        for (int i = 0; i < 3; i++) {
            assert_near(0.5 * (a[FIRST_v + i] + b[FIRST_v + i]), whole[FIRST_v + i], 1e-15);
            assert_near(0.5 * (a[FIRST_x + i] + b[FIRST_x + i]), whole[FIRST_x + i], 1e-15);
            before += 0.5 * whole[FIRST_v + i] * whole[FIRST_v + i];
            after[0] += 0.5 * a[FIRST_v + i] * a[FIRST_v + i], after[1] += 0.5 * b[FIRST_v + i] * b[FIRST_v + i];
            /* each half moves as the whole's velocity field does at its place */
            assert_near(b[FIRST_v + i] - a[FIRST_v + i], whole[FIRST_L + 3 * i + k] * (b[FIRST_x + k] - a[FIRST_x + k]),
                        1e-15);
        }
        assert_near(0.5 * (after[0] + after[1]), before, 1e-14);
        /* the two domains fill the whole's */
        assert_near(b[FIRST_x + k] - b[FIRST_half + k], a[FIRST_x + k] + a[FIRST_half + k], 1e-15);
        assert_near(4 * a[FIRST_half + k], 2 * whole[FIRST_half + k], 1e-15);
    }
}

/* Two halves of one body that shear past each other while they stream into finer cells: thousands of splits. */
static void test_splitting(void **state)
{
    (void)state;
    const mpm_material m = scene_dust();
    SCENE_LOCAL(s);
    cube(&s, &m, 0.5e-3, true);
    s.viscosity_linear = s.viscosity_quadratic = 0;
    mpm_body *second;
    assert_ok(mpm_scene_add_body(&s, &second));
    *second = s.body[0];
    mpm_solid *part;
    assert_ok(mpm_scene_add_solid(&s, "box", -1, -1, &part));
    *part = s.solid[0], second->solid = 1;
    scene_values(&s, 1)[0] = 5.8e-3;
    s.body[0].velocity[0] = 3000;
    second->velocity[0] = 3000, second->velocity[1] = -200;
    mpm *solver = scene_make(&s, 1);
    const size_t before = mpm_points(solver);
    assert_ok(mpm_advance(solver, 3e-6, NULL));
    const mpm_ledger l = mpm_balance(solver);
    const mpm_report r = mpm_state(solver);
    print_message(
        "splitting: %zu -> %zu points, heat of transfer %.3g of %.3g J; mass %.2e, momentum %.2e, energy %.2e\n",
        before, mpm_points(solver), l.heat_transfer, l.kinetic_start, l.mass / l.mass_start - 1, l.momentum_error,
        l.energy_error);
    assert_true(r.splits > 1000);
    assert_int_equal(before + r.splits - r.ejected, mpm_points(solver));
    assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
    assert_below(l.momentum_error, ROUNDING);
    assert_near(l.energy_error, 0, ROUNDING);
    assert_true(l.heat_transfer > 0);
    mpm_free(solver);
}

/* One failed point, drawn out along x and flattened along y: nothing resists.  Its gradient part may hold no more than
 * it began with, and its heat may not go below none, but for what its pressure gives back a step late; without the
 * bound it holds a hundred times as much after some hundred steps. */
static void test_debris(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 40e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 5e-3, 5e-3, 5e-3, 5.5e-3, 5.5e-3, 5.5e-3, &m);
    mpm *solver = scene_make(&s, 1);
    assert_int_equal(mpm_points(solver), 1);
    block *q = NULL;
    for (int i = 0; i < solver->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            if (solver->bricks[i].head[c] >= 0) q = &solver->blocks[solver->bricks[i].head[c]];
    assert_non_null(q);
    q->damage[0][0] = 1;
    q->v[0][0] = 900, q->v[1][0] = 700, q->v[2][0] = 300;
    q->L[0][0] = 3e5, q->L[4][0] = -3e5;
    q->ka[0][0] = 0.5 * 2 * 0.1e-6 * 9e10; /* a tenth of a cell squared an axis */
    const double ka = q->ka[0][0];
    double least = HUGE_VAL, most = 0;
    for (int i = 0; i < 300; i++) {
        scene_steps(solver, 1);
        double *e = scene_read(solver, MPM_energy);
        least = fmin(least, e[0]);
        free(e);
        const mpm_ledger l = mpm_balance(solver);
        most = fmax(most, l.kinetic / l.mass - 0.5 * (900.0 * 900 + 700 * 700 + 300 * 300));
    }
    print_message(
        "lone debris: energy of the gradient part %.3g -> at most %.3g J/kg, least internal energy %.3g J/kg\n", ka,
        most, least);
    assert_true(least > -1e-4 * ka);
    assert_true(most > 0);
    assert_below(most, 1.01 * ka);
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform), cmocka_unit_test(test_graded),    cmocka_unit_test(test_leaving),
        cmocka_unit_test(test_halves),  cmocka_unit_test(test_splitting), cmocka_unit_test(test_debris),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
