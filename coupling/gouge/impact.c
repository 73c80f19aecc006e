/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/impact.h"

#include "coupling/gouge/crater_history.h"
#include "coupling/gouge/result.h"
#include "coupling/gouge/watch.h"

#include <math.h>
#include <string.h>

status gouge_job_make(const case_impact *c, gouge_job *job)
{
    memset(job, 0, sizeof *job);
    job->snapshots = c->snapshots;
    job->checkpoint_interval = c->checkpoint_interval;
    return gouge_scene_make(c, &job->scene);
}

void gouge_job_free(gouge_job *job)
{
    gouge_scene_free(&job->scene);
}

/* The lost metal keeps its own speed's worth of impulse out of the sum: circuit_shot_jump books it with the mass
 * (docs/theory/onset.md). */
static void book_losses(const gouge_scene *s, const gouge_watch *w, double time, impact *out)
{
    const gouge_metal *before = &w->state.start, *after = &w->end;
    const double halves = s->crater.mirrored ? 2.0 : 1.0;
    const double pressing = -s->scene.body[s->armature].body_force[1] * before->mass;
    out->mass_loss = halves * fmax(before->mass - after->mass, 0.0);
    const double kept = after->mass * s->velocity - after->momentum;
    out->impulse = fmax(halves * (kept - s->friction * pressing * time), 0.0);
}

static status run_watched(const gouge_job *job, const scene_host *host, gouge_watch *w, impact *out)
{
    const scene_watch watch = gouge_watch_of(w);
    const scene_job run = { .name = job->name,
                            .task = job->task,
                            .scene = &job->scene.scene,
                            .watch = &watch,
                            .snapshots = job->snapshots,
                            .checkpoint_interval = job->checkpoint_interval,
                            .force_on = job->scene.scene.body[job->scene.rail].group,
                            .last_time = gouge_last_time(&job->scene),
                            .resume = job->resume,
                            .twin = job->twin,
                            .whole = !job->scene.gauged };
    scene_outcome o;
    TRY(scene_run(&run, host, &o));
    out->result = gouge_result(&job->scene, w, &o);
    book_losses(&job->scene, w, o.report.time, out);
    if (!host->history || job->scene.gauged) return status_ok();
    return gouge_crater_record(&w->found, &out->result, host->history, job->name);
}

status gouge_job_run(const gouge_job *job, const scene_host *host, impact *out)
{
    gouge_watch w = { .scene = &job->scene, .timing = host->timing };
    memset(out, 0, sizeof *out);
    const status done = run_watched(job, host, &w, out);
    gouge_crater_free(&w.found);
    return done;
}

status gouge_run(const impact_job *job, const scene_host *host, impact *out)
{
    gouge_job made;
    TRY(gouge_job_make(&job->of, &made));
    made.name = job->name;
    made.task = job->task;
    made.resume = job->resume;
    made.twin = job->twin;
    const status done = gouge_job_run(&made, host, out);
    gouge_job_free(&made);
    return done;
}
