/* SPDX-License-Identifier: BSD-3-Clause */
/* A small scene of bodies with probes for tests of the store and of processes: a ball at 300 m/s onto a block. */
#ifndef BREECH_TESTS_BODY_SCENES_H
#define BREECH_TESTS_BODY_SCENES_H

#include "coupling/run/scenes.h"
#include "coupling/scene/scene_bodies.h"
#include "coupling/scene/scene_fill.h"

static const char body_scene_text[] =
    "name: ball\n"
    "output: {snapshots: 2}\n"
    "scene:\n"
    "  end_time: 1 us\n"
    "  bodies:\n"
    "    - {name: wall, material: ofhc_copper, shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}}\n"
    "    - {name: ball, material: ofhc_copper, shape: {sphere: {center: -1 2 2 mm, radius: 1 mm}}, velocity: 300 0 0 "
    "m/s}\n"
    "  probes:\n"
    "    - {name: push, force: wall}\n"
    "    - {name: gauge, pressure: {at: 1 2 2 mm}}\n"
    "    - {name: dent, surface: {lo: -1 0 0 mm, hi: 2 4 4 mm, along: -1 0 0, cell: 0.4 mm, body: wall}}\n";

/* With one value changed, as --set does it: "scene.cell=0.4 mm". */
static inline case_inputs *body_scene(const char *set)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, CASE_FOR_SCENE };
    const case_text text = { body_scene_text, strlen(body_scene_text), "case.yaml", &set, 1 };
    case_inputs *in = NULL;
    char *errors = NULL;
    const status s = case_inputs_read_memory(&text, &how, &in, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    OK(scene_fill(&in->bodies.scene));
    return in;
}

static inline scene_query body_scene_query(const case_inputs *in, const char *name)
{
    scene_query q = { .bodies = case_body_scene_of(in) };
    snprintf(q.name, sizeof q.name, "%s", name);
    return q;
}

/* What a scene came to in this history, but for the time that it took. */
static inline char *body_scene_result(const history *h, const char *name)
{
    scene_bodies_result r;
    OK(scene_bodies_read(h, name, &r));
    assert_true(r.bodies == 2 && r.probes == 3 && r.steps > 20 && r.body[0].velocity[0] > 0.0);
    assert_true(r.probe[0].peak > 0.0 && r.probe[0].impulse[0] > 0.0 && r.probe[1].columns > 0);
    r.wall_seconds = 0.0, r.threads = 0;
    char *text = output_object_text(&(summary_object){ scene_bodies_keys, &r });
    assert_non_null(text);
    scene_bodies_free(&r);
    return text;
}

/* The series of a probe and of its map in two histories. */
static inline void assert_same_body_series(history *a, const char *name_a, history *b, const char *name_b)
{
    static const char *const series[] = { "probes/push/time", "probes/push/force_x", "probes/gauge/pressure",
                                          "probes/dent/x", "bodies/ball/velocity_x" };
    for (size_t i = 0; i < sizeof series / sizeof *series; i++) {
        double *x, *y;
        size_t n[H5_MAX_RANK], m[H5_MAX_RANK];
        OK(output_history_read(a, name_a, series[i], &x, n));
        OK(output_history_read(b, name_b, series[i], &y, m));
        assert_true(n[0] == m[0] && n[1] == m[1] && n[0] > 20);
        for (size_t k = 0; k < n[0] * n[1]; k++) assert_true(x[k] == y[k] || (isnan(x[k]) && isnan(y[k])));
        free(x), free(y);
    }
}

#endif
