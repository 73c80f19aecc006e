/* SPDX-License-Identifier: BSD-3-Clause */
/* breech scene: one embedded impact at a given velocity. */
#include "coupling/study/study.h"
#include "coupling/report/report_page.h"
#include "coupling/study/scene_doubts.h"

#include <math.h>
#include <string.h>

static int scenes(const study_case *of, scene_query *out)
{
    *out = (scene_query){ .impact = of->in->onset.impact, .anew = !of->one_of_several };
    double *pressure = &out->impact.scene.contact_pressure, *temperature = &out->impact.armature.temperature;
    if (isnan(*pressure)) *pressure = 0.0; /* no shot presses or heats: one key for such a scene, however it is said */
    if (isnan(*temperature)) *temperature = CASE_ROOM_TEMPERATURE;
    snprintf(out->name, sizeof out->name, "%.60sscene", of->prefix);
    return 1;
}

static status run(session *s, const study_case *of, study_answer *out)
{
    scene_query query;
    const scene_record *done;
    study_scene_doubts_warn(s, of);
    TRY(run_scenes_all(s, &query, scenes(of, &query), &done));
    run_scenes_warn_of(s, &done->entry);
    out->result = &done->entry.result;
    return status_ok();
}

static void print(const void *result, FILE *out)
{
    const scene_result *r = result;
    output_keys_print(&(summary_object){ run_result_keys, r }, out);
    if (r->reason[0]) fprintf(out, "\n%s: %s\n", run_damage_names[r->class], r->reason);
    if (strcmp(r->crater_reason, r->reason) != 0)
        fprintf(out, "its crater alone, %s: %s\n", run_damage_names[r->crater_class], r->crater_reason);
}

const study study_scene = {
    .name = "scene",
    .doc = "one embedded impact at a given velocity",
    .more =
        "Needs rail, armature, particle and scene, with scene.velocity and particle.radius; or a scene with bodies.",
    .example = "breech scene cases/ball_gauge --set \"scene.cell=0.6 mm\"",
    .instead = &study_ensemble,
    .needs = CASE_FOR_SCENE,
    .keys = run_result_keys,
    .can_vary = true,
    .report = { report_scene_head, NULL },
    .print = print,
    .scenes = scenes,
    .run = run,
};
