/* SPDX-License-Identifier: BSD-3-Clause */
/* Loops that threads share by runs (mpm/memory/runs.h): every iteration once, a thread's own run first. */
#include "mpm_scenes.h"

#include "mpm/memory/runs.h"

enum { MOST = 70 };

/* Threads take turns, all but those that are late: these come when nothing else is left. */
static void take_all(loop_runs *r, int threads, int late, int taken[MOST])
{
    for (int t = 0, idle = 0; idle < threads - late; t = (t + 1) % (threads - late)) {
        int i, end;
        if (!mpm_runs_take(r, t, &i, &end)) {
            idle++;
            continue;
        }
        assert_true(end > i);
        for (; i < end; i++) taken[i]++;
    }
}

static void test_every_iteration_once(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 5; threads++)
        for (int late = 0; late < threads; late++)
            for (int count = 0; count <= MOST; count++) {
                loop_runs r;
                int taken[MOST] = { 0 }, i, end;
                mpm_runs_even(&r, threads, count);
                take_all(&r, threads, late, taken);
                for (int k = 0; k < count; k++) assert_int_equal(taken[k], 1);
                for (int k = count; k < MOST; k++) assert_int_equal(taken[k], 0);
                for (int t = 0; t < threads; t++) assert_false(mpm_runs_take(&r, t, &i, &end));
            }
}

static void test_own_run_first(void **state)
{
    (void)state;
    loop_runs r;
    int i, end;
    mpm_runs_even(&r, 3, 60);
    for (int t = 0; t < 3; t++) {
        assert_true(mpm_runs_take(&r, t, &i, &end));
        assert_int_equal(i, 20 * t);
    }
}

/* A brick counts with its points, half as much on the next coarser level. */
static void test_bricks_by_work(void **state)
{
    (void)state;
    mpm *m = calloc(1, sizeof *m);
    brick b[6] = { { .particles = 100, .level = 0 }, { .particles = 0, .level = 0 },  { .particles = 100, .level = 1 },
                   { .particles = 100, .level = 1 }, { .particles = 50, .level = 0 }, { .particles = 50, .level = 0 } };
    loop_runs r;
    assert_non_null(m);
    m->bricks = b, m->bricks_used = 6, m->threads = 3, m->grids.levels = 2;
    mpm_runs_of_bricks(&r, m);
    assert_true(r.of[0].next == 0 && r.of[0].end == 1);
    assert_true(r.of[1].next == 1 && r.of[1].end == 4);
    assert_true(r.of[2].next == 4 && r.of[2].end == 6);
    free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_iteration_once),
        cmocka_unit_test(test_own_run_first),
        cmocka_unit_test(test_bricks_by_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
