/* SPDX-License-Identifier: BSD-3-Clause */
/* breech scene of a case with scene.bodies: any scene of the solver, run to its end. */
#include "coupling/study/study.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/scene/scene_bodies.h"
#include "coupling/study/scene_doubts.h"

#include <stdlib.h>

static void warn(session *s, const scene_bodies_result *r)
{
    run_scenes_warn_of_energy(s, "", r->energy_error);
    for (int i = 0; i < r->bodies; i++)
        if (!(r->body[i].mass > 0.0))
            run_session_warn(s, "body %s: nothing of it is in the window at the end", r->body[i].name);
}

/* One that is wanted with its snapshots is computed where they are to lie. */
static int scenes(const study_case *of, scene_query *out)
{
    *out = (scene_query){ .bodies = case_body_scene_of(of->in),
                          .anew = !of->one_of_several && of->in->output.snapshots > 0 };
    snprintf(out->name, sizeof out->name, "%.60sscene", of->prefix);
    return 1;
}

static status run(session *s, const study_case *of, study_answer *out)
{
    scene_query query;
    const scene_record *done;
    scene_bodies_result *r = out->owned = calloc(1, sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for a scene's result");
    study_scene_doubts_warn(s, of);
    TRY(run_scenes_all(s, &query, scenes(of, &query), &done));
    TRY(scene_bodies_read(s->history, done->entry.name, r));
    warn(s, r);
    out->result = r;
    return status_ok();
}

static void print(const void *result, FILE *out)
{
    const scene_bodies_result *r = result;
    output_keys_print(&(summary_object){ scene_bodies_keys, r }, out);
    table *t;
    if (host_table_create("body|mass [g]|v_x [m/s]|v_y|v_z|motion [J]|failed [mm3]", &t).code != STATUS_OK) return;
    for (int i = 0; i < r->bodies; i++) {
        const scene_body *b = &r->body[i];
        host_table_row(t, "%s|%.4g|%.4g|%.4g|%.4g|%.4g|%.4g", b->name, 1e3 * b->mass, b->velocity[0], b->velocity[1],
                       b->velocity[2], b->kinetic, 1e9 * b->failed_volume);
    }
    fputs("\nmasses, energies and volumes of the scene and its bodies are those of the model as computed:\n"
          "beside one mirror half of the whole, beside two a quarter\n\n",
          out);
    host_table_print(t, out);
    host_table_free(t);
}

static void free_owned(void *owned)
{
    if (owned) scene_bodies_free(owned);
    free(owned);
}

static bool has_bodies(const case_inputs *in)
{
    return in->given.bodies;
}

const study study_bodies = {
    .name = "bodies",
    .doc = "breech scene of a case with scene.bodies",
    .more = "",
    .takes = has_bodies,
    .needs = CASE_FOR_SCENE,
    .keys = scene_bodies_keys,
    .can_vary = true,
    .report = { report_bodies_head, report_bodies_section },
    .print = print,
    .scenes = scenes,
    .run = run,
    .free = free_owned,
};
