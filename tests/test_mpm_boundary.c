/* SPDX-License-Identifier: BSD-3-Clause */
/* Every line of boundary.def: what it does to the bodies is booked, and at both ends of an axis it does the same. */
#include "mpm_scenes.h"

static const double H = 0.5e-3, FAR = 6e-3, DEEP = 2e-3, END = 3e-6;

/* Two blocks of two groups at one end of x, or `away` from it, the upper at end 1.  They fly towards it, one of them
 * along it as well, and along the other. */
static void end_scene(mpm_scene *s, const mpm_material *m, int kind, int end, double away)
{
    const double lo = end ? -1 : 0, hi = end ? 0 : 1, out = end ? 30 : -30, off = end ? -away : away;
    mpm_scene_default(s);
    s->axis[0] = scene_axis(lo * FAR, hi * FAR, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[1] = scene_axis(-3e-3, 3e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[2] = scene_axis(-1e-3, 2e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[0].boundary[end] = (mpm_boundary_kind)kind;
    const double moved[] = { -0.5 * out, 8, 3 };
    memcpy(s->axis[0].boundary_velocity[end], moved, sizeof moved);
    scene_friction(s, 0.3);
    scene_box(s, lo * DEEP + off, -1e-3, 0, hi * DEEP + off, 0, 1e-3, m)->velocity[0] = out;
    mpm_body *b = scene_box(s, lo * DEEP + off, 0, 0, hi * DEEP + off, 1e-3, 1e-3, m);
    b->group = 1;
    b->velocity[0] = out, b->velocity[1] = -10, b->velocity[2] = 20;
}

typedef struct {
    mpm_ledger sums;
    double velocity[2][3]; /* of the blocks [m/s] */
} outcome;

static outcome run_scene(const mpm_scene *s)
{
    outcome o;
    mpm *solver = scene_make(s, 1);
    assert_ok(mpm_advance(solver, END, NULL));
    o.sums = mpm_balance(solver);
    for (int b = 0; b < 2; b++)
        for (int k = 0; k < 3; k++) o.velocity[b][k] = scene_mean(solver, MPM_velocity, k, b);
    mpm_free(solver);
    return o;
}

static outcome run_end(int kind, int end)
{
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    end_scene(&s, &m, kind, end, 0);
    return run_scene(&s);
}

/* Momentum and energy close to rounding; but for `free` the end acts, and against the motion. */
static void check_books(int kind, const outcome *o)
{
    print_message("%-10s impulse %+.3e N s, momentum %.1e, energy %+.1e\n", mpm_boundary_names[kind],
                  o->sums.impulse_boundary[0], o->sums.momentum_error, o->sums.energy_error);
    assert_below(o->sums.momentum_error, 1e-12);
    assert_near(o->sums.energy_error, 0, 1e-10);
    if (kind == MPM_BOUNDARY_FREE)
        assert_near(o->sums.impulse_boundary[0], 0, 0);
    else
        assert_true(o->sums.impulse_boundary[0] > 1e-6);
}

static void test_every_boundary(void **state)
{
    (void)state;
    for (int kind = 0; kind < MPM_BOUNDARIES; kind++) {
        const outcome lower = run_end(kind, 0), upper = run_end(kind, 1);
        check_books(kind, &lower);
        for (int b = 0; b < 2; b++)
            for (int k = 0; k < 3; k++) {
                const double mirrored = k == 0 ? -upper.velocity[b][k] : upper.velocity[b][k];
                /* 1e-4: rounding says in which step a face on a plane of the grid reaches the next node */
                if (!(fabs(lower.velocity[b][k] - mirrored) < 1e-4 * 30))
                    fail_msg("%s: component %d of block %d: %.12g m/s at the lower end, %.12g at the upper",
                             mpm_boundary_names[kind], k, b, lower.velocity[b][k], mirrored);
            }
    }
}

/* The same where the blocks come to the end, rubbing on each other there. */
static void test_coming(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    for (int kind = 0; kind < MPM_BOUNDARIES; kind++) {
        SCENE_LOCAL(s);
        end_scene(&s, &m, kind, 0, 0.1 * H);
        const outcome o = run_scene(&s);
        check_books(kind, &o);
    }
}

/* What each says of itself, of two blocks that were let fly into it with 30 m/s, one of them along it with 20 m/s too.
 */
static void test_what_they_do(void **state)
{
    (void)state;
    const outcome away = run_end(MPM_BOUNDARY_FREE, 0), mirror = run_end(MPM_BOUNDARY_SYMMETRY, 0),
                  fixed = run_end(MPM_BOUNDARY_FIXED, 0), moved = run_end(MPM_BOUNDARY_PRESCRIBED, 0),
                  viscous = run_end(MPM_BOUNDARY_ABSORBING, 0);
    const double along = away.velocity[1][2]; /* less than 20 m/s by the friction of the blocks on each other */
    assert_true(along > 10 && mirror.velocity[1][2] > 0.9 * along);
    assert_true(fixed.velocity[1][2] < 0.5 * along && viscous.velocity[1][2] < 0.7 * along);
    assert_near(away.velocity[0][0], -30, 0.1);
    assert_true(mirror.velocity[0][0] > -10 && fixed.velocity[0][0] > -10 && viscous.velocity[0][0] > -10);
    assert_true(moved.velocity[0][0] > 10); /* it is pushed inwards with 15 m/s */
}

/* Two ends that meet at an edge of the window, each with each: where both say a velocity only one counts, and the books
 * close. */
static void test_edges(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    for (int x = 0; x < MPM_BOUNDARIES; x++)
        for (int z = 0; z < MPM_BOUNDARIES; z++) {
            SCENE_LOCAL(s);
            end_scene(&s, &m, x, 0, 0);
            s.axis[2] = scene_axis(0, 2e-3, H, (mpm_boundary_kind)z, MPM_BOUNDARY_FREE);
            const double moved[] = { 4, 2, 9 };
            memcpy(s.axis[2].boundary_velocity[0], moved, sizeof moved);
            const outcome o = run_scene(&s);
            print_message("%-10s and %-10s momentum %.1e, energy %+.1e\n", mpm_boundary_names[x], mpm_boundary_names[z],
                          o.sums.momentum_error, o.sums.energy_error);
            assert_below(o.sums.momentum_error, 1e-12);
            assert_near(o.sums.energy_error, 0, 1e-10);
        }
}

/* A plate one cell thick whose face a fixed end holds is struck in its plane by a block that the end lets pass.  What
 * the contact gives to the nodes at the end, the end takes back: the plate is slower than one that may slide there. */
static void test_after_a_contact(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    double along[2];
    for (int slides = 0; slides < 2; slides++) {
        SCENE_LOCAL(s);
        mpm_scene_default(&s);
        s.axis[0] = scene_axis(0, 3e-3, H, slides ? MPM_BOUNDARY_SYMMETRY : MPM_BOUNDARY_FIXED, MPM_BOUNDARY_FREE);
        s.axis[1] = scene_axis(-3e-3, 3e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        s.axis[2] = scene_axis(0, 2e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        scene_box(&s, 0, -1e-3, 0.5e-3, H, 0, 1.5e-3, &m);
        mpm_body *b = scene_box(&s, 0, 0, 0.5e-3, H, 2e-3, 1.5e-3, &m);
        b->group = 1, b->velocity[1] = -30, b->passes[0] = true;
        const outcome o = run_scene(&s);
        along[slides] = -o.velocity[0][1];
        print_message("the plate moves with %.3g m/s, energy %+.1e\n", along[slides], o.sums.energy_error);
        assert_below(o.sums.momentum_error, 1e-12);
        assert_near(o.sums.energy_error, 0, 1e-10);
    }
    assert_true(along[1] > 10 && along[0] < 0.2 * along[1]);
}

/* Two bodies of one group under a pressure, air of 1 atm beside copper, between ends that absorb: they stay at rest, as
 * if they went on beyond.  Where one of them is struck, the books close. */
static void test_held_up(void **state)
{
    (void)state;
    static const double P = 101325;
    mpm_material air;
    base_params_default(mpm_material_params, &air);
    strcpy(air.name, "air");
    air.strength = MPM_STRENGTH_none, air.eos = MPM_EOS_stiffened_gas, air.density = 1.2041;
    air.specific_heat = 717.65, air.reference_temperature = 293.15, air.gas_gamma = 1.4, air.gas_stiffness = 0;
    air.gas_pressure = P;
    const mpm_material copper = scene_copper();
    for (int basis = MPM_BASIS_GIMP; basis <= MPM_BASIS_BSPLINE; basis++)
        for (int struck = 0; struck < 2; struck++) {
            SCENE_LOCAL(s);
            scene_bar(&s, 0, 10e-3, H, 2);
            s.surroundings = 0, s.basis = (mpm_basis_kind)basis;
            for (int end = 0; end < 2; end++) s.axis[0].boundary[end] = MPM_BOUNDARY_ABSORBING;
            scene_box(&s, 0, -1, -1, 6e-3, 1, 1, &air)->pressure = P;
            mpm_body *b = scene_box(&s, 6e-3, -1, -1, 10e-3, 1, 1, &copper);
            b->pressure = P, b->velocity[0] = struck ? -5 : 0;
            mpm *solver = scene_make(&s, 1);
            assert_ok(mpm_advance(solver, struck ? 5e-6 : 50e-6, NULL));
            const mpm_ledger l = mpm_balance(solver);
            double fastest = 0, *v = scene_read(solver, MPM_velocity);
            for (size_t i = 0; i < mpm_points(solver); i++) fastest = fmax(fastest, fabs(v[3 * i]));
            print_message("%s, %s: %.1e m/s, momentum %.1e, energy %+.1e\n", basis ? "bspline" : "gimp",
                          struck ? "struck" : "at rest", fastest, l.momentum_error, l.energy_error);
            if (!struck) assert_below(fastest, basis ? 1 : 1e-6); /* an eighth of a spline beside the end lies beyond */
            if (struck) assert_below(l.momentum_error, 1e-12);
            assert_near(l.energy_error, 0, 1e-10);
            free(v);
            mpm_free(solver);
        }
}

/* Two bodies of one group and one metal, apart, the first under a pressure: each end holds up that of its own body.
 * Until their free faces are heard there, nothing moves at the ends. */
static void test_each_pressure(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    scene_bar(&s, 0, 10e-3, H, 2);
    for (int end = 0; end < 2; end++) s.axis[0].boundary[end] = MPM_BOUNDARY_ABSORBING;
    scene_box(&s, 0, -1, -1, 4e-3, 1, 1, &copper)->pressure = 1e9;
    scene_box(&s, 6e-3, -1, -1, 10e-3, 1, 1, &copper);
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 0.3e-6, NULL));
    double *x = scene_read(solver, MPM_position), *v = scene_read(solver, MPM_velocity), fastest = 0, all = 0;
    for (size_t i = 0; i < mpm_points(solver); i++) {
        all = fmax(all, fabs(v[3 * i]));
        if (x[3 * i] < 0.5e-3 || x[3 * i] > 9.5e-3) fastest = fmax(fastest, fabs(v[3 * i]));
    }
    print_message("%.1e m/s at the ends, %.1e at the free face\n", fastest, all);
    assert_true(all > 10);
    assert_below(fastest, 1e-3 * all);
    free(x), free(v);
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_every_boundary),  cmocka_unit_test(test_coming),
                                        cmocka_unit_test(test_what_they_do),    cmocka_unit_test(test_edges),
                                        cmocka_unit_test(test_after_a_contact), cmocka_unit_test(test_held_up),
                                        cmocka_unit_test(test_each_pressure) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
