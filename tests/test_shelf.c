/* SPDX-License-Identifier: BSD-3-Clause */
/* Small scenes through the runner: checkpoints come no oftener than they may, a whole scene goes on from the one that
 * ended at its gauge. */
#include "coupling/case/case.h"
#include "full_common.h"
#include "shelf_common.h"

static const char *const FAST[] = {
    "scene.velocity=2.4 km/s", "scene.end_time=3.4 us", "scene.contact_pressure=300 MPa",
    "scene.courant=0.3", /* more steps than pieces: none ends with the gauge's */
};

static const double SAVING = 5e-3; /* [s] */

static status save_slowly(void *user, const char *scene, const scene_now *now)
{
    (void)scene, (void)now;
    const double until = host_wall_clock() + SAVING;
    while (host_wall_clock() < until) {
    }
    ++*(int *)user;
    return status_ok();
}

/* Asked for every millisecond, checkpoints that take five are made no oftener than 20 times as far apart. */
static void test_checkpoints(void **state)
{
    (void)state;
    static const char *const brief[] = { "scene.velocity=2 km/s", "scene.end_time=1 us",
                                         "scene.contact_pressure=300 MPa", "scene.courant=0.2" };
    breech_case *c = small_case(brief, false, "output.snapshots=0");
    case_impact one = case_inputs_of(c).onset.impact;
    one.scene.cells_per_radius = 1.2;
    gouge_job job;
    impact hit;
    int saves = 0;
    OK(gouge_job_make(&one, &job));
    job.checkpoint_interval = 1e-3;
    const scene_host host = { .threads = 1, .save = save_slowly, .user = &saves };
    const double start = host_wall_clock();
    OK(gouge_job_run(&job, &host, &hit));
    gouge_job_free(&job);
    const double wall = host_wall_clock() - start;
    print_message("%d checkpoints of %g ms in %.2f s\n", saves, 1e3 * SAVING, wall);
    assert_true(saves > 1 && (saves - 1) * 20 * SAVING <= wall);
    case_free(c);
}

static void assert_same_rows(history *a, history *b)
{
    h5_file *file[2];
    double *time[2];
    size_t rows[2][H5_MAX_RANK];
    for (int i = 0; i < 2; i++) {
        OK(host_h5_create(&file[i]));
        OK(output_history_export(i ? b : a, "whole", file[i]));
        OK(host_h5_read(file[i], "/scene/time", &time[i], rows[i]));
    }
    assert_int_equal(rows[0][0], rows[1][0]);
    assert_true(rows[0][0] > 20);
    assert_memory_equal(time[0], time[1], rows[0][0] * sizeof *time[0]);
    for (int i = 0; i < 2; i++) free(time[i]), host_h5_close(file[i]);
}

/* A whole scene goes on from the one that ended at its gauge, to the same bits, unless a snapshot is missing. */
static void test_shelf(void **state)
{
    (void)state;
    scene_shelf shelf = { .oldest = 0 };
    const run_counted alone = run_small(FAST, false, "output.snapshots=2", NULL);
    const run_counted gauged = run_small(FAST, true, "output.snapshots=0", &shelf);
    assert_true(gauged.hit.result.groove_growth > 0.0 && scene_shelf_find(&shelf, 1) && !scene_shelf_find(&shelf, 2));
    const run_counted on = run_small(FAST, false, "output.snapshots=2", &shelf);
    print_message("%d steps from the start, %d to the gauge, %d from there\n", alone.steps, gauged.steps, on.steps);
    assert_memory_equal(&on.hit, &alone.hit, sizeof on.hit);
    assert_true(on.steps < alone.steps - gauged.steps + 20 && on.snapshots == 2 && alone.snapshots == 2);
    assert_same_rows(alone.rows, on.rows);
    if (full_tests()) {
        const run_counted many = run_small(FAST, false, "output.snapshots=31", &shelf);
        assert_true(many.steps > 0.9 * alone.steps && many.snapshots == 31);
        assert_memory_equal(&many.hit, &alone.hit, sizeof many.hit);
        OK(output_history_close(many.rows));
    }
    scene_shelf_clear(&shelf);
    assert_null(scene_shelf_find(&shelf, 1));
    history *const rows[] = { alone.rows, gauged.rows, on.rows };
    for (int i = 0; i < 3; i++) OK(output_history_close(rows[i]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_checkpoints),
        cmocka_unit_test(test_shelf),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
