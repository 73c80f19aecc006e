/* SPDX-License-Identifier: BSD-3-Clause */
/* (M-7): what a point's pressure has beyond its neighbours'.  The kernel's own code is compiled in, for the compiler's
 * default instruction set.  Tolerance 1e-13: rounding. */
#define BREECH_ISA relax_test
#include "mpm_scenes.h"

#include "mpm/kernel/g2p.c"

/* Twelve points of a body at rest in one cell: two blocks, the second half empty. */
enum { POINTS = 12 };

typedef struct {
    mpm *solver;
    int first, second;
} cell_of_points;

static int place_of(int i, const cell_of_points *c, int *lane)
{
    *lane = i % LANES;
    return i < LANES ? c->first : c->second;
}

/* Point i with the density rho0 d[i], the energy of a melt or of a solid, and the pressure of both. */
static cell_of_points points(const mpm_material *m, const double d[POINTS], bool molten)
{
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 4e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 1e-3, 1e-3, 1e-3, 3e-3, 3e-3, 3e-3, m);
    scene_box(&s, 3e-3, 1e-3, 1e-3, 4e-3, 3e-3, 3e-3, m);
    cell_of_points c = { scene_make(&s, 1), 0, 1 };
    const law *k = &c.solver->laws[0];
    const law_form f = law_form_of(k, k->kernel);
    for (int n = 0; n < 2; n++) {
        block *q = &c.solver->blocks[n];
        c.solver->links[n].body = 0, c.solver->links[n].next = n ? -1 : 1, c.solver->links[n].mask = 0;
        memset(q, 0, sizeof *q);
        for (int l = 0; l < LANES; l++) q->rho[0][l] = k->rho0;
    }
    for (int i = 0; i < POINTS; i++) {
        int l;
        block *q = &c.solver->blocks[place_of(i, &c, &l)];
        const double mu = d[i] - 1, e = reference_energy(k, f, vd_set(mu))[0] + (molten ? 1e6 : 0);
        c.solver->links[place_of(i, &c, &l)].mask |= (uint8_t)(1u << l);
        q->mass[0][l] = (1 + 0.1 * i) * 1e-6, q->rho[0][l] = k->rho0 * d[i], q->e[0][l] = e;
        q->p[0][l] = pressure(k, f, vd_set(mu), vd_set(k->rho0 * d[i]), vd_set(e), vd_set(0))[0];
        q->T[0][l] = temperature(k, vd_set(e), reference_energy(k, f, vd_set(mu)), vd_set(0))[0];
    }
    return c;
}

typedef struct {
    double volume, energy, P;
    double V[POINTS], E[POINTS], p[POINTS], x[POINTS]; /* x: (p - P)/K */
} state_of;

static state_of look(const cell_of_points *c)
{
    const law *k = &c->solver->laws[0];
    state_of r = { 0 };
    double room = 0, K[POINTS];
    for (int i = 0; i < POINTS; i++) {
        int l;
        const block *q = &c->solver->blocks[place_of(i, c, &l)];
        const double V = r.V[i] = q->mass[0][l] / q->rho[0][l];
        r.p[i] = q->p[0][l];
        K[i] = q->rho[0][l] *
               wave_speed_square(k, law_form_of(k, k->kernel), vd_set(1 / q->rho[0][l]), vd_set(r.p[i]), vd_set(0))[0];
        r.E[i] = q->mass[0][l] * q->e[0][l];
        r.volume += V, r.energy += r.E[i], r.P += V / K[i] * r.p[i], room += V / K[i];
    }
    r.P /= room;
    for (int i = 0; i < POINTS; i++) r.x[i] = (r.p[i] - r.P) / K[i];
    return r;
}

static void relax_once(cell_of_points *c, double share)
{
    const law *k = &c->solver->laws[0];
    step_of step = { .dt = share * 1e-3 / k->sound };
    for (int i = 0; i < 3; i++) step.h[i] = 1e-3, step.inv_h[i] = 1e3;
    brick b = { .head = { c->first } };
    relax_cell(c->solver, &b, 0, &step);
}

static const double apart[POINTS] = { 1, 1.01, 1, 1.02, 1, 1, 1.45, 1, 1.01, 1, 1.3, 1 };

/* Volume and energy of all stay; pressures are those of the law; temperatures follow; the excess falls by its share. */
static void test_relaxes(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    for (int molten = 0; molten < 2; molten++) {
        cell_of_points c = points(&m, apart, molten);
        const law *k = &c.solver->laws[0];
        const law_form f = law_form_of(k, k->kernel);
        const state_of before = look(&c);
        relax_once(&c, 0.25);
        const state_of after = look(&c);
        assert_near(after.volume / before.volume, 1, 1e-13);
        assert_near(after.energy / before.energy, 1, 1e-13);
        for (int i = 0; i < POINTS; i++) {
            int l;
            const block *q = &c.solver->blocks[place_of(i, &c, &l)];
            const double mu = q->rho[0][l] / k->rho0 - 1;
            const vd e = vd_set(q->e[0][l]), want = pressure(k, f, vd_set(mu), vd_set(q->rho[0][l]), e, vd_set(0));
            assert_near(q->p[0][l], want[0], 1e-13 * k->K0);
            /* works against P; 1e-9 of the largest: each energy is a difference */
            assert_near(after.E[i] - before.E[i] + before.P * (after.V[i] - before.V[i]), 0,
                        1e-9 * before.P * fabs(after.V[6] - before.V[6]));
            assert_near(q->T[0][l], temperature(k, e, reference_energy(k, f, vd_set(mu)), vd_set(0))[0], 1e-9);
        }
        for (int i = 6; i < 11; i += 4) { /* a quarter of the excess, less what all take up */
            assert_true(before.x[i] > 1.05 * RELAX_BOUND);
            assert_near(after.V[i] / before.V[i] - 1, 0.25 * (before.x[i] - RELAX_BOUND),
                        0.1 * (before.x[i] - RELAX_BOUND));
            assert_true(after.p[i] < before.p[i]);
        }
        assert_true(after.p[0] > before.p[0] && after.V[0] < before.V[0]);
        for (int i = 0; i < 200; i++) relax_once(&c, 0.25);
        const state_of end = look(&c);
        for (int i = 0; i < POINTS; i++) assert_below(fabs(end.x[i]), 1.1 * RELAX_BOUND);
        assert_near(end.volume / before.volume, 1, 1e-12);
        assert_near(end.energy / before.energy, 1, 1e-12);
        mpm_free(c.solver);
    }
}

/* Points within the bound are left to the last bit, and so is a point alone, however dense. */
static void test_leaves(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    const double close[POINTS] = { 1, 1.05, 1, 1.02, 1, 1, 1.08, 1, 1.01, 1, 1.03, 1 };
    cell_of_points c = points(&m, close, false);
    block was[2];
    memcpy(was, c.solver->blocks, sizeof was);
    relax_once(&c, 0.25);
    assert_memory_equal(was, c.solver->blocks, sizeof was);
    mpm_free(c.solver);
    c = points(&m, apart, false);
    for (int i = 0; i < POINTS; i++) {
        int l;
        const int n = place_of(i, &c, &l);
        if (i != 6) c.solver->blocks[n].mass[0][l] = 0, c.solver->links[n].mask &= (uint8_t) ~(1u << l);
    }
    c.solver->links[0].next = -1;
    memcpy(was, c.solver->blocks, sizeof was);
    relax_once(&c, 0.25);
    assert_memory_equal(was, c.solver->blocks, sizeof was);
    mpm_free(c.solver);
}

/* In a welded group a cell's chain may hold another body's block between two of a body: each is relaxed by its own
 * points, all of them, once. */
static void test_others_between(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    cell_of_points alone = points(&m, apart, false), c = points(&m, apart, false);
    block *between = &c.solver->blocks[2];
    memcpy(between, &c.solver->blocks[1], sizeof *between);
    for (int l = 0; l < LANES; l++) between->rho[0][l] *= 1.2;
    const block was = *between;
    c.solver->links[2] = c.solver->links[1];
    c.solver->links[2].body = 1, c.solver->links[0].next = 2, c.solver->links[2].next = 1;
    cell_of_points other = points(&m, apart, false);
    memcpy(&other.solver->blocks[0], between, sizeof *between);
    other.solver->links[0].mask = c.solver->links[2].mask, other.solver->links[0].next = -1;
    relax_once(&alone, 0.25), relax_once(&c, 0.25), relax_once(&other, 0.25);
    assert_memory_equal(alone.solver->blocks, c.solver->blocks, 2 * sizeof *between);
    assert_memory_equal(other.solver->blocks, between, sizeof *between);
    assert_memory_not_equal(between, &was, sizeof was);
    mpm_free(alone.solver), mpm_free(c.solver), mpm_free(other.solver);
}

/* Dust among points of some hundred gigapascals: without the limit on a step its volume would become negative. */
static void test_soft_among_dense(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    const double d[POINTS] = { 1.7, 1.7, 1.7, 0.26, 1.7, 1.7, 1.7, 1.7, 0.26, 1.7, 1.7, 1.7 };
    cell_of_points c = points(&m, d, true);
    for (int i = 0; i < POINTS; i++) {
        int l;
        block *q = &c.solver->blocks[place_of(i, &c, &l)];
        q->damage[0][l] = 1;
        if (d[i] < 1) q->p[0][l] = 0, q->mass[0][l] *= 1e-3;
    }
    const state_of before = look(&c);
    assert_true(before.P > 1e11);
    for (int i = 0; i < 50; i++) {
        const state_of was = look(&c);
        relax_once(&c, 0.4);
        const state_of is = look(&c);
        for (int k = 0; k < POINTS; k++) assert_true(is.V[k] > 0.499 * was.V[k]);
    }
    const state_of after = look(&c);
    assert_near(after.volume / before.volume, 1, 1e-12);
    assert_near(after.energy / before.energy, 1, 1e-12);
    assert_true(after.V[3] < 0.6 * before.V[3]);
    mpm_free(c.solver);
}

/* In a step of the solver: one point of a block in motion has half as much again of density.  It comes to the bound as
 * fast as sound crosses its cell, and the books close. */
static void test_in_a_step(void **state)
{
    (void)state;
    const mpm_material m = scene_hydro();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 10e-3, 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 2e-3, 2e-3, 2e-3, 8e-3, 8e-3, 8e-3, &m)->velocity[0] = 100;
    mpm *solver = scene_make(&s, 1);
    int n = -1, l = 0;
    for (int i = 0; n < 0 && i < solver->bricks_used; i++)
        if (solver->bricks[i].particles == (int)(BRICK_CELLS * 8)) n = solver->bricks[i].head[21];
    assert_true(n >= 0 && solver->blocks[n].mass[0][l] > 0);
    solver->blocks[n].rho[0][l] *= 1.5;
    const mpm_ledger before = mpm_balance(solver);
    scene_steps(solver, 20);
    const mpm_ledger after = mpm_balance(solver);
    double *density = scene_read(solver, MPM_density), densest = 0;
    for (size_t i = 0; i < mpm_points(solver); i++) densest = fmax(densest, density[i]);
    free(density);
    print_message("densest point after 20 steps: %.3f of the density at rest\n", densest / m.density);
    assert_true(densest < 1.3 * m.density);
    const double gain = after.kinetic + after.internal - after.work_ahead - before.kinetic - before.internal;
    assert_near(gain / before.kinetic, 0, 1e-11); /* rounding */
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_relaxes),        cmocka_unit_test(test_leaves),
        cmocka_unit_test(test_others_between), cmocka_unit_test(test_soft_among_dense),
        cmocka_unit_test(test_in_a_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
