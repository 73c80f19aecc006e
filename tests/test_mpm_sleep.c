/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies at rest cost nothing: points whose nodes do not move are left as they are until something comes (g2p.c). */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

/* A cube of 3 mm flies at a block of 12 mm and is half a millimetre off; `drift`: velocity of the block. */
static void target(mpm_scene *s, const mpm_material *copper, double drift, int levels)
{
    mpm_scene_default(s);
    s->levels = levels;
    for (int k = 0; k < 3; k++) s->axis[k] = scene_axis(0, 20e-3, 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(s, 6e-3, 4e-3, 4e-3, 18e-3, 16e-3, 16e-3, copper);
    scene_box(s, 2.5e-3, 8e-3, 8e-3, 5.5e-3, 11e-3, 11e-3, copper);
    s->body[0].velocity[0] = drift, s->body[1].velocity[0] = 400;
    s->body[1].group = 1;
}

static mpm *after(const mpm_scene *s, double time)
{
    mpm *m = scene_make(s, 2);
    assert_ok(mpm_advance(m, time, NULL));
    return m;
}

static uint64_t points_of(const mpm *m, int body)
{
    uint64_t n = 0;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                if (m->links[q].body == body) n += (uint64_t)__builtin_popcount(m->links[q].mask);
    return n;
}

/* Until it is hit the block takes two steps, however many the cube takes. */
static void test_waits(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    target(&s, &copper, 0, 1);
    mpm *m = after(&s, 0.5e-6);
    const mpm_report r = mpm_state(m);
    const uint64_t block_points = points_of(m, 0), cube_points = points_of(m, 1);
    assert_true(r.steps > 10);
    assert_int_equal(r.particle_steps, r.steps * cube_points + BRICK_ASLEEP * block_points);
    assert_int_equal(r.particle_steps_asleep, (r.steps - BRICK_ASLEEP) * block_points);
    mpm_free(m);
}

/* Once it is hit it moves as one that never slept, for it drifts by a trillionth of the cube's velocity. */
static void test_wakes(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int levels = 1; levels <= 2; levels++) {
        mpm *m[2];
        for (int i = 0; i < 2; i++) {
            SCENE_LOCAL(s);
            target(&s, &copper, i * 1e-9, levels);
            m[i] = after(&s, 3e-6);
        }
        const mpm_report slept = mpm_state(m[0]), awake = mpm_state(m[1]);
        const mpm_ledger l = mpm_balance(m[0]);
        const double v[2] = { scene_mean(m[0], MPM_velocity, 0, 0), scene_mean(m[1], MPM_velocity, 0, 0) };
        print_message(
            "%d levels: %llu point steps asleep of %llu, block at %.9g and %.9g m/s, momentum %.1e, energy %.1e\n",
            levels, (unsigned long long)slept.particle_steps_asleep,
            (unsigned long long)(slept.particle_steps_asleep + slept.particle_steps), v[0], v[1], l.momentum_error,
            l.energy_error);
        assert_int_equal(awake.particle_steps_asleep, 0);
        assert_true(slept.particle_steps_asleep > 0.2 * (double)slept.particle_steps);
        assert_true(v[0] > 1);
        assert_near(v[0], v[1], 1e-6 * v[1]);
        assert_near(slept.peak_pressure, awake.peak_pressure, 1e-6 * awake.peak_pressure);
        assert_below(l.momentum_error, 1e-12);
        mpm_free(m[0]), mpm_free(m[1]);
    }
}

/* A force from outside adds up, however small: a block that one acts on does not sleep. */
static void test_force(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    target(&s, &copper, 0, 1);
    const double a = 1e-5; /* [m/s2]: a step's gain is a hundredth of what counts as slow */
    s.body[0].body_force[1] = a;
    mpm *m = after(&s, 0.5e-6);
    assert_int_equal(mpm_state(m).particle_steps_asleep, 0);
    assert_near(scene_mean(m, MPM_velocity, 1, 0) / (a * mpm_state(m).time), 1, 1e-6);
    mpm_free(m);
}

static void set_half_lengths(mpm *m, const brick *b, int k, double half)
{
    for (int c = 0; c < BRICK_CELLS; c++)
        for (int q = b->head[c]; q >= 0; q = m->links[q].next)
            for (int l = 0; l < LANES; l++) m->blocks[q].half[k][l] = half;
}

/* Flat points beside cells that become empty have longer domains: a brick that sleeps gives its nodes anew what it
 * gives, the same as one that never slept. */
static void test_open_sides(void **state)
{
    (void)state;
    static double out[3][HALO_NODES][LINE];
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    target(&s, &copper, 0, 1);
    mpm *m = after(&s, 0.5e-6);
    brick *b = m->bricks;
    while (b->still < BRICK_ASLEEP || b->neighbour[SELF + 1] < 0 || !m->bricks[b->neighbour[SELF + 1]].occupied)
        assert_true(++b < m->bricks + m->bricks_used);
    set_half_lengths(m, b, 0, 0.05 * s.axis[0].fine);
    for (int i = 0; i < 3; i++) {
        if (i != 1) b->given = false;
        if (i == 1) m->bricks[b->neighbour[SELF + 1]].occupied = 0;
        m->kernel->p2g(m, b);
        memcpy(out[i], b->out, sizeof out[i]);
    }
    assert_memory_not_equal(out[0], out[1], sizeof out[0]);
    assert_memory_equal(out[1], out[2], sizeof out[1]);
    mpm_free(m);
}

/* Same bits on any number of threads and on from a checkpoint while part of it sleeps. */
static void test_bits(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    target(&s, &copper, 0, 2);
    mpm *m = scene_same_bits(&s, 30, 10);
    assert_true(mpm_state(m).particle_steps_asleep > 0);
    mpm_free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_waits), cmocka_unit_test(test_wakes),
                                        cmocka_unit_test(test_force), cmocka_unit_test(test_open_sides),
                                        cmocka_unit_test(test_bits) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
