/* SPDX-License-Identifier: BSD-3-Clause */
/* Levels of the grid (mpm/grid/grid.c, interface.c): nothing may tell that two levels meet but the size of the cells.
 * Tolerances are rounding, as in test_mpm_flight. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

static const double ROUNDING = 1e-12;
enum { LEVELS = 3 };

static void test_refused(void **state)
{
    (void)state;
    SCENE_LOCAL(s);
    grids g;
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++)
        s.axis[k] =
            scene_graded(scene_axis(0, 40e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE), 16e-3, 24e-3, 4e-3, 1.5);
    s.levels = 2;
    mpm_scene bad[4] = { s, s, s, s };
    bad[0].levels = 0, bad[1].levels = MPM_MAX_LEVELS + 1, bad[2].basis = MPM_BASIS_BSPLINE;
    bad[3].axis[1].hi = 3e-3; /* not two cells of the coarsest level */
    for (int i = 0; i < 4; i++) assert_int_equal(mpm_grids_make(&bad[i], &g).code, STATUS_BAD_INPUT);
    assert_ok(mpm_grids_make(&s, &g));
    mpm_grids_free(&g);
}

/* ---- fields ---- */

static void cube(mpm_scene *s, const mpm_material *m, int levels)
{
    mpm_scene_default(s);
    s->levels = levels;
    for (int k = 0; k < 3; k++) {
        s->axis[k] = scene_axis(0, k ? 20e-3 : 40e-3, 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        s->axis[k] = scene_graded(s->axis[k], k ? 7e-3 : 12e-3, k ? 11e-3 : 18e-3, 4e-3, 2);
    }
    scene_box(s, 3.3e-3, 3.3e-3, 3.3e-3, 9.3e-3, 9.3e-3, 9.3e-3, m);
}

/* A motion that is linear in space, and carried along the boxes meanwhile, stays what it was at all points, with a
 * gradient and no heat, wherever the levels meet: P is exact for it, and so is what a coarser level shows a finer one
 * amid its step. */
static void test_linear(void **state)
{
    (void)state;
    static const double CARRIED = 1000, RATE = 1e3, STEP = 3e-13; /* [m/s, 1/s, s]: it turns and stretches by 3e-10 */
    const mpm_material copper = scene_copper();
    for (int levels = 2; levels <= LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        s.viscosity_linear = s.viscosity_quadratic = 0; /* else there is stress at once */
        for (int i = 0; i < 3; i++) scene_values(&s, 0)[i] = 1e-3, scene_values(&s, 0)[3 + i] = 19e-3;
        mpm *m = scene_make(&s, 2);
        double L[9], at_level[LEVELS] = { 0 };
        srand(4);
        for (int i = 0; i < 9; i++) L[i] = RATE * scene_random(-1, 1);
        for (int i = 0; i < m->bricks_used; i++)
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) {
                    block *b = &m->blocks[q];
                    for (int l = 0; l < LANES; l++)
                        for (int k = 0; k < 3; k++) {
                            b->v[k][l] = CARRIED;
                            for (int j = 0; j < 3; j++)
                                b->L[3 * k + j][l] = L[3 * k + j], b->v[k][l] += L[3 * k + j] * b->x[j][l];
                        }
                }
        m->dt = STEP;
        assert_ok(mpm_advance(m, STEP, NULL));
        double worst = 0, worst_L = 0;
        for (int i = 0; i < m->bricks_used; i++)
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) {
                    const block *b = &m->blocks[q];
                    for (int l = 0; l < LANES; l++) {
                        if (!(b->mass[0][l] > 0)) continue;
                        at_level[m->bricks[i].level]++;
                        for (int k = 0; k < 3; k++) {
                            double v = CARRIED;
                            for (int j = 0; j < 3; j++) {
                                v += L[3 * k + j] * b->start[j][l];
                                worst_L = fmax(worst_L, fabs(b->L[3 * k + j][l] - L[3 * k + j]) / RATE);
                            }
                            worst = fmax(worst, fabs(b->v[k][l] - v) / CARRIED);
                        }
                    }
                }
        print_message("%d levels: %.0f, %.0f, %.0f points; linear velocity to %.1e, its gradient to %.1e\n", levels,
                      at_level[0], at_level[1], at_level[2], worst, worst_L);
        for (int i = 0; i < levels; i++) assert_true(at_level[i] > 500);
        assert_below(worst, ROUNDING);
        assert_below(worst_L, 1e-8);
        mpm_free(m);
    }
}

/* Each level makes the steps that its cells allow: a quarter, a half and the whole of the coarsest's. */
static void test_paces(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    double dt[LEVELS];
    for (int levels = 1; levels <= LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        for (int i = 0; i < 3; i++) scene_values(&s, 0)[i] = 1e-3, scene_values(&s, 0)[3 + i] = 19e-3;
        mpm *m = scene_make(&s, 2);
        uint64_t want = 0;
        for (int i = 0; i < m->bricks_used; i++)
            want += (uint64_t)m->bricks[i].particles << (levels - 1 - m->bricks[i].level);
        dt[levels - 1] = mpm_state(m).dt;
        scene_steps(m, 5);
        const mpm_report r = mpm_state(m);
        print_message("%d levels: %zu points, %llu points' steps in 5 of %.3g s\n", levels, r.particles,
                      (unsigned long long)r.particle_steps, dt[levels - 1]);
        assert_int_equal(r.steps, 5);
        assert_int_equal(r.particle_steps + r.particle_steps_asleep, 5 * want); /* nothing moves */
        assert_near(dt[levels - 1], dt[0] * (1 << (levels - 1)), 1e-12 * dt[0]);
        mpm_free(m);
    }
}

/* A cube flies through all levels, in and out again: split and put from one to the other, and nothing else happens to
 * it. */
static void test_flight(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int levels = 2; levels <= LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        mpm_body *b = &s.body[0];
        b->velocity[0] = 900, b->velocity[1] = 200, b->velocity[2] = -100;
        mpm *m = scene_make(&s, 2);
        const double K0 = mpm_material_bulk_modulus(&copper), x0 = scene_mean(m, MPM_position, 0, -1);
        assert_ok(mpm_advance(m, full_tests() ? 28e-6 : 14e-6, NULL));
        const mpm_ledger l = mpm_balance(m);
        const mpm_report r = mpm_state(m);
        const double way = scene_mean(m, MPM_position, 0, -1) - x0;
        print_message(
            "%d levels: %.1f mm, %llu splits, stress / K0 %.1e, kinetic energy %.1e, momentum %.1e, energy %.1e\n",
            levels, 1e3 * way, (unsigned long long)r.splits, scene_largest(m, MPM_stress) / K0,
            l.kinetic / l.kinetic_start - 1, l.momentum_error, l.energy_error);
        assert_true(r.splits > 1000 && way > 9e-3);
        assert_below(scene_largest(m, MPM_stress) / K0, ROUNDING);
        assert_near(l.kinetic / l.kinetic_start, 1, ROUNDING);
        assert_near(l.mass / l.mass_start, 1, ROUNDING);
        assert_below(l.momentum_error, ROUNDING);
        assert_near(l.energy_error, 0, ROUNDING);
        assert_near(way / (900 * r.time), 1, ROUNDING);
        mpm_free(m);
    }
}

/* Past an end of the window that the boxes reach, or come to from `away`: what goes out there, out of cells of any
 * size, is booked, and so is what the end does to the rest.  A mirror that does not act on the cube does nothing to
 * it. */
static void check_ends(double away, double speed)
{
    static const struct {
        mpm_boundary_kind kind;
        bool passes;
    } ends[] = { { MPM_BOUNDARY_FREE, false },
                 { MPM_BOUNDARY_ABSORBING, false },
                 { MPM_BOUNDARY_FIXED, false },
                 { MPM_BOUNDARY_SYMMETRY, false },
                 { MPM_BOUNDARY_SYMMETRY, true } };
    const mpm_material copper = scene_copper();
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        for (int levels = 2; levels <= LEVELS; levels++) {
            SCENE_LOCAL(s);
            cube(&s, &copper, levels);
            for (int k = 1; k < 3; k++)
                s.axis[k] = scene_graded(s.axis[k], k == 1 ? 0 : 16e-3, k == 1 ? 4e-3 : 20e-3, 4e-3, 2);
            s.axis[1].boundary[0] = s.axis[2].boundary[1] = ends[i].kind;
            s.body[0].passes[2] = s.body[0].passes[5] = ends[i].passes;
            double *box = scene_values(&s, 0);
            box[1] = away, box[4] = 3e-3 + away, box[2] = 15e-3 - away, box[5] = 20e-3 - away;
            s.body[0].velocity[0] = 900, s.body[0].velocity[1] = -speed, s.body[0].velocity[2] = speed;
            mpm *m = scene_make(&s, 2);
            assert_ok(mpm_advance(m, 9e-6, NULL));
            const mpm_ledger l = mpm_balance(m);
            print_message("end %zu, %d levels: %.1e of the mass left, mass %.1e, energy %.1e, momentum %.1e\n", i,
                          levels, l.ejected_mass / l.mass_start, (l.mass + l.ejected_mass) / l.mass_start - 1,
                          l.energy_error, l.momentum_error);
            const bool open = ends[i].kind == MPM_BOUNDARY_FREE || ends[i].passes;
            assert_int_equal(l.ejected_mass > 0.01 * l.mass_start, open);
            assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
            assert_below(l.momentum_error, ROUNDING);
            assert_near(l.energy_error, 0, ROUNDING);
            mpm_free(m);
        }
}

static void test_ends(void **state)
{
    (void)state;
    check_ends(0, 100);
    check_ends(0.3e-3, 300);
}

/* ---- the gouge ---- */

static void gouge(gouge_scene *g, int levels)
{
    scene_gouge(g, 0.25e-3, 1500);
    mpm_scene *s = &g->scene;
    s->levels = levels;
    s->axis[0] = scene_graded(s->axis[0], -1e-3, 2e-3, 1.5e-3, 1.5);
    s->axis[1] = scene_graded(s->axis[1], -1e-3, 1e-3, 1e-3, 1.5);
    s->axis[2] =
        scene_graded(scene_axis(0, 6e-3, 0.25e-3, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE), 0, 1e-3, 1e-3, 1.5);
    scene_values(s, 0)[3] = 40e-3; /* the rail goes on */
    s->zone_until = 0.5e-6;
    mpm_refine *plastic;
    assert_ok(mpm_scene_add_refine(s, "plastic", &plastic));
    *mpm_refine_value(plastic, "jump") = 75;
}

/* Cells become small where metal flows and large again where it has come to rest, points go from level to level, are
 * split and merged: the books close. */
static void test_books(void **state)
{
    (void)state;
    for (int levels = 2; levels <= 4; levels++) {
        GOUGE_LOCAL(g);
        gouge(&g, levels);
        mpm *m = scene_make(&g.scene, 2);
        assert_ok(mpm_advance(m, 4e-6, NULL));
        const mpm_ledger l = mpm_balance(m);
        const mpm_report r = mpm_state(m);
        print_message("%d levels: %llu splits, %llu merges, energy %.1e, momentum %.1e\n", levels,
                      (unsigned long long)r.splits, (unsigned long long)r.merges, l.energy_error, l.momentum_error);
        assert_true(r.splits > 1000);
        assert_true(r.merges > 300);
        assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
        assert_below(l.momentum_error, ROUNDING);
        assert_near(l.energy_error, 0, ROUNDING);
        assert_int_equal(r.particles, mpm_points(m));
        mpm_free(m);
    }
}

/* What an estimate counts in a sample of boxes is what is built. */
static void test_estimate(void **state)
{
    (void)state;
    for (int levels = 1; levels <= LEVELS; levels++) {
        GOUGE_LOCAL(g);
        gouge(&g, levels);
        mpm_needs needs;
        assert_ok(mpm_estimate(&g.scene, &needs));
        mpm *m = scene_make(&g.scene, 2);
        assert_near((double)needs.particles / (double)mpm_points(m), 1, 0.03);
        double work = 0;
        for (int k = 0; k < m->bricks_used; k++) work += (double)m->bricks[k].particles / (1 << m->bricks[k].level);
        assert_near(needs.work / work, 1, 0.03);
        mpm_free(m);
    }
}

/* Two bodies that meet in the boxes' middle: nodes that both reach have all that contact asks for, whichever level it
 * came from. The flow stress is one everywhere. */
static void test_contact_sums(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int i = 0; i < 12; i++) {
        const int levels = 2 + i % 2;
        const double y = 7.25e-3 + 0.3e-3 * i; /* where they meet, among the cells and bricks of the boxes */
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        const double low[6] = { 1e-3, 1e-3, 1e-3, 39e-3, y, 19e-3 }, high[6] = { 1e-3, y, 1e-3, 39e-3, 19e-3, 19e-3 };
        memcpy(scene_values(&s, 0), low, sizeof low);
        scene_box(&s, high[0], high[1], high[2], high[3], high[4], high[5], &copper)->group = 1;
        mpm *m = scene_make(&s, 2);
        m->dt = 1e-15; /* so that nothing moves */
        assert_ok(mpm_advance(m, 1e-15, NULL));
        int shared = 0;
        double worst = 0;
        for (int k = 0; k < m->bricks_used; k++) {
            const brick *b = &m->bricks[k], *other = NULL;
            const int o = brick_at(m, !b->group, b->level, b->at);
            if (o >= 0) other = &m->bricks[o];
            for (int c = 0; c < BRICK_CELLS && b->at_interface && other; c++) {
                const double *line = b->line[c], *extra = b->line[BRICK_CELLS + c];
                if ((b->interface.follow_coarser | b->interface.follow_finer) >> c & 1 ||
                    !(line[0] > 0 && other->line[c][0] > 0))
                    continue;
                shared++;
                assert_true(b->across && other->across);
                worst = fmax(worst, fabs(extra[6] / (line[0] * m->laws[b->group].flow_start) - 1));
            }
        }
        print_message("%d levels, meeting at %.2f mm: %d nodes of both, flow stress to %.1e\n", levels, 1e3 * y, shared,
                      worst);
        assert_true(shared > 100);
        assert_below(worst, ROUNDING);
        mpm_free(m);
    }
}

/* Every brick's flags, found out again, are what they were. */
static void hold_known(mpm *m)
{
    const int n = m->bricks_used;
    bool(*was)[2] = calloc((size_t)n, sizeof *was);
    assert_non_null(was);
    for (int i = 0; i < n; i++) was[i][0] = m->bricks[i].contact, was[i][1] = m->bricks[i].across;
    assert_ok(mpm_store_relink(m));
    for (int i = 0; i < n; i++) {
        const brick *b = &m->bricks[i];
        if (was[i][0] != b->contact || was[i][1] != b->across)
            fail_msg("step %d, brick %d of level %d: contact %d, across %d; found out again %d, %d", (int)m->steps, i,
                     b->level, was[i][0], was[i][1], b->contact, b->across);
    }
    free(was);
}

/* What a brick knows of the other groups around it follows from where particles are now, or a run that goes on from a
 * checkpoint would know other things than one without a stop.  A slab flies past a cube, into its bricks' neighbours
 * and out of them. */
static void test_known(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int levels = 1; levels <= LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        mpm_body *slab = scene_box(&s, 2e-3, 9.6e-3, 4e-3, 4e-3, 11e-3, 8e-3, &copper);
        slab->group = 1, slab->velocity[0] = 4000;
        mpm *m = scene_make(&s, 2);
        for (int step = 0; step < 120; step++) {
            scene_steps(m, 1);
            hold_known(m);
        }
        const double way = 4000 * mpm_state(m).time;
        print_message("%d levels: %.1f mm past the cube\n", levels, 1e3 * way);
        assert_true(way > 12e-3);
        mpm_free(m);
    }
}

static void test_bits(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    gouge(&g, 3);
    mpm *m = scene_same_bits(&g.scene, 230, 90);
    mpm_free(m);
}

/* Of the rail, beyond what its outer quarter across takes. */
static double groove_power(const mpm *m)
{
    enum { N = 32 };
    const mpm_axis *along = &mpm_scene_of(m)->axis[0], *across = &mpm_scene_of(m)->axis[2];
    const bool counts[] = { true, false, false };
    mpm_plastic_sum sums[2 * N];
    double power = 0;
    assert_ok(mpm_plastic_profile(m, counts,
                                  &(mpm_slices){ .along = 0,
                                                 .across = 2,
                                                 .n = N,
                                                 .lo = along->lo,
                                                 .width = (along->hi - along->lo) / N,
                                                 .half = across->hi,
                                                 .sides = 0.75 },
                                  sums));
    for (int i = 0; i < N; i++) {
        const mpm_plastic_sum *middle = &sums[2 * i], *sides = &sums[2 * i + 1];
        power += fmax(middle->power - (sides->volume > 0 ? sides->power * middle->volume / sides->volume : 0), 0);
    }
    return power;
}

/* The power that ploughs the rail and what the armature has lost, with fine cells all around and with levels. */
static void test_same_groove(void **state)
{
    (void)state;
    double power[LEVELS], lost[LEVELS];
    for (int levels = 1; levels <= LEVELS; levels++) {
        GOUGE_LOCAL(g);
        gouge(&g, levels);
        mpm *m = scene_make(&g.scene, 2);
        assert_ok(mpm_advance(m, 3e-6, NULL));
        power[levels - 1] = groove_power(m);
        lost[levels - 1] = 1 - scene_mean(m, MPM_velocity, 0, 2) / 1500;
        print_message("%d levels: %zu points, power %.4g W, velocity lost %.4f\n", levels, mpm_points(m),
                      power[levels - 1], lost[levels - 1]);
        mpm_free(m);
        assert_near(power[levels - 1] / power[0], 1,
                    levels < 3 ? 0.15 : 0.35); /* with three the scene is but a few cells wide */
        assert_near(lost[levels - 1] / lost[0], 1, 0.1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refused),  cmocka_unit_test(test_linear),       cmocka_unit_test(test_paces),
        cmocka_unit_test(test_flight),   cmocka_unit_test(test_ends),         cmocka_unit_test(test_books),
        cmocka_unit_test(test_estimate), cmocka_unit_test(test_contact_sums), cmocka_unit_test(test_known),
        cmocka_unit_test(test_bits),     cmocka_unit_test(test_same_groove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
