/* SPDX-License-Identifier: BSD-3-Clause */
/* A small gouge scene through the runner, its steps and snapshots counted.  A `speed` is four changes of the case. */
#ifndef BREECH_TESTS_SHELF_COMMON_H
#define BREECH_TESTS_SHELF_COMMON_H

#include "coupling/case/case.h"
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

static inline bool count_step(void *user)
{
    ((run_counted *)user)->steps++;
    return false;
}

static inline status count_snapshot(void *user, const char *path, const void *data, size_t bytes)
{
    (void)data;
    ((run_counted *)user)->snapshots += bytes > 0 && strstr(path, ".hdf") && !strstr(path, ".series");
    return status_ok();
}

static inline breech_case *small_case(const char *const *speed, bool to_gauge, const char *written)
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
                                 "scene.rail_ahead=8 mm",
                                 "scene.rail_behind=1 mm",
                                 "scene.rail_depth=4 mm",
                                 "scene.levels=3",
                                 "armature.length=10 mm",
                                 "armature.width=6 mm",
                                 "armature.half_bore=6 mm",
                                 "armature.leg_thickness=5 mm",
                                 "armature.head_thickness=6 mm",
                                 NULL };
    return changed_case(sets);
}

/* A small scene, to its gauge or whole. */
static inline run_counted run_small(const char *const *speed, bool to_gauge, const char *written, scene_shelf *shelf)
{
    breech_case *c = small_case(speed, to_gauge, written);
    case_impact one = case_inputs_of(c).onset.impact;
    one.scene.cells_per_radius = 1.2;
    run_counted r = { .steps = 0 };
    gouge_job job;
    OK(gouge_job_make(&one, &job));
    job.name = to_gauge ? "short" : "whole";
    job.twin = 1;
    OK(output_history_open(NULL, false, &r.rows));
    const snapshot_sink sink = { count_snapshot, &r };
    const scene_host host = {
        .sink = &sink, .history = r.rows, .shelf = shelf, .threads = 1, .stop = count_step, .user = &r
    };
    OK(gouge_job_run(&job, &host, &r.hit));
    gouge_job_free(&job);
    r.hit.result.wall_seconds = 0.0;
    case_free(c);
    return r;
}

#endif
