/* Small scenes through the runner: checkpoints come no oftener than they may, a whole scene goes on from the one that
 * ended at its gauge, a dying groove ends early. */
#include "coupling/gouge/growth.h"
#include "coupling/gouge/impact.h"
#include "coupling/gouge/result.h"
#include "coupling/gouge/site_state.h"
#include "tests/case_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    int steps, snapshots;
    history *rows;
    impact hit;
} run_counted;

static bool count_step(void *user)
{
    ((run_counted *)user)->steps++;
    return false;
}

static status count_snapshot(void *user, const char *path, const void *data, size_t bytes)
{
    (void)data;
    ((run_counted *)user)->snapshots += bytes > 0 && strstr(path, ".hdf") && !strstr(path, ".series");
    return status_ok();
}

static const char *const FAST[] = { "scene.velocity=2 km/s", "scene.end_time=3.4 us", "scene.contact_pressure=300 MPa",
                                    "scene.courant=0.3" }; /* more steps than pieces: none ends with the gauge's */
static const char *const SLOW[] = { "scene.velocity=0.8 km/s", "scene.end_time=8 us", "scene.contact_pressure=20 MPa",
                                    "scene.courant=0.4" };

static breech_case *small_case(const char *const *speed, bool to_gauge, const char *written)
{
    const char *const sets[] = { written,
                                 to_gauge ? "scene.stop_when_gauged=yes" : "scene.stop_when_gauged=no",
                                 speed[0],
                                 speed[1],
                                 speed[2],
                                 speed[3],
                                 "particle.radius=0.2 mm",
                                 "scene.coarse_cell=1.2 mm",
                                 "scene.growth=1.3",
                                 "scene.fine_ahead=3 mm",
                                 "scene.fine_width=2 mm",
                                 "scene.rail_ahead=8 mm",
                                 "scene.rail_behind=1 mm",
                                 "scene.rail_depth=4 mm",
                                 "scene.levels=2",
                                 "scene.fine_depth=0.6 mm",
                                 "scene.fine_above=0.5 mm",
                                 "scene.fine_behind=0.8 mm",
                                 "armature.length=10 mm",
                                 "armature.width=6 mm",
                                 "armature.half_bore=6 mm",
                                 "armature.head_thickness=6 mm",
                                 NULL };
    return changed_case(sets);
}

/* A small scene, to its gauge or whole. */
static run_counted run_small(const char *const *speed, bool to_gauge, const char *written, scene_shelf *shelf)
{
    breech_case *c = small_case(speed, to_gauge, written);
    const case_impact one = case_inputs_of(c).onset.impact;
    const site_state at = gouge_state_of_case(&one);
    run_counted r = { .steps = 0 };
    gouge_job job;
    OK(gouge_job_make(&one, &at, 1.2, &job));
    job.name = to_gauge ? "short" : "whole";
    job.twin = 1;
    OK(output_history_open(NULL, false, &r.rows));
    const snapshot_sink sink = { count_snapshot, &r };
    const scene_host host = {
        .sink = &sink, .history = r.rows, .shelf = shelf, .threads = 1, .stop = count_step, .user = &r
    };
    OK(gouge_run(&job, &host, &r.hit));
    gouge_job_free(&job);
    r.hit.result.wall_seconds = 0.0;
    case_free(c);
    return r;
}

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
    const case_impact one = case_inputs_of(c).onset.impact;
    const site_state at = gouge_state_of_case(&one);
    gouge_job job;
    impact hit;
    int saves = 0;
    OK(gouge_job_make(&one, &at, 1.2, &job));
    job.checkpoint_interval = 1e-3;
    const scene_host host = { .threads = 1, .save = save_slowly, .user = &saves };
    const double start = host_wall_clock();
    OK(gouge_run(&job, &host, &hit));
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
    const char *full = getenv("BREECH_FULL");
    if (full && strcmp(full, "1") == 0) {
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

/* A dying groove is not driven to its second gauge, and is no gouge. */
static void test_dies_early(void **state)
{
    (void)state;
    scene_shelf shelf = { .oldest = 0 };
    const run_counted slow = run_small(SLOW, true, "output.snapshots=0", &shelf);
    const double gauge = 28 * 0.2e-3 / 800.0, half = 22 * 0.2e-3 / 800.0;
    print_message("over at %.2f of the way to the second gauge: %s\n", slow.hit.result.end_time / gauge,
                  slow.hit.result.reason);
    assert_true(slow.hit.result.end_time >= half && slow.hit.result.end_time < 0.9 * gauge);
    assert_true(slow.hit.result.class == DAMAGE_SCRATCH || slow.hit.result.class == DAMAGE_NONE);
    assert_true(gouge_growth_folds(slow.hit.result.groove_growth, 0.2e-3, 800.0) < -0.5);
    OK(output_history_close(slow.rows));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_checkpoints),
        cmocka_unit_test(test_shelf),
        cmocka_unit_test(test_dies_early),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
