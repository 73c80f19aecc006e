/* breech scene of a case with scene.bodies: any scene of the solver, run to its end. */
#include "coupling/study/study.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/run/lending.h"
#include "coupling/scene/scene_bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ENERGY_ERROR_LIMIT = 0.01; /* above it the scene is warned about */

static bool stop_asked(void *user)
{
    const session *s = user;
    return s->stop && s->stop();
}

static int threads_now(void *user)
{
    const session *s = user;
    return run_lending_threads(s->lending);
}

static void warn(session *s, const scene_bodies_result *r)
{
    if (fabs(r->energy_error) > ENERGY_ERROR_LIMIT)
        run_session_warn(s, "energy error %.2f %%, above %.0f %%: lower scene.courant or take smaller cells",
                         100.0 * r->energy_error, 100.0 * ENERGY_ERROR_LIMIT);
    for (int i = 0; i < r->bodies; i++)
        if (!(r->body[i].mass > 0.0))
            run_session_warn(s, "body %s: nothing of it is in the window at the end", r->body[i].name);
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const case_bodies *b = &of->in->bodies;
    const case_output *output = &of->in->output;
    scene_bodies_result *r = calloc(1, sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for a scene's result");
    out->owned = r;
    char name[24];
    snprintf(name, sizeof name, "%sscene", of->prefix);
    const scene_job job = { .name = name,
                            .task = name,
                            .scene = &b->scene,
                            .snapshots = output->snapshots,
                            .checkpoint_interval = output->checkpoint_interval,
                            .force_on = b->scene.body[0].group,
                            .last_time = b->scene.end_time,
                            .resume = run_session_resume_of(s, name),
                            .whole = true };
    const scene_host host = { .dir = &s->dir,
                              .history = s->history,
                              .progress = &s->progress,
                              .timing = &s->timing,
                              .threads = s->threads,
                              .threads_now = s->lending ? threads_now : NULL,
                              .stop = stop_asked,
                              .save = run_session_save_inside,
                              .user = s };
    run_lending_begin(s->lending);
    const status done = scene_bodies_run(&job, &host, r);
    run_lending_end(s->lending);
    TRY(done);
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
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

static void free_owned(void *owned)
{
    if (owned) scene_bodies_free(owned);
    free(owned);
}

const study study_bodies = {
    .name = "bodies",
    .doc = "breech scene of a case with scene.bodies",
    .more = "",
    .needs = CASE_FOR_SCENE,
    .keys = scene_bodies_keys,
    .can_vary = true,
    .report = { report_bodies_verdict, report_section_bodies },
    .print = print,
    .run = run,
    .free = free_owned,
};
