/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/scene_work.h"

#include "coupling/scene/scene_bodies.h"

#include <string.h>

static void surface_text(const case_rail *rail, char *out, size_t size)
{
    const case_layers *layers = &rail->layers;
    int n = snprintf(out, size, "%s", rail->material);
    for (int i = 0; i < layers->n && n > 0 && (size_t)n < size; i++)
        n += snprintf(out + n, size - (size_t)n, " + %s", layers->item[i].material);
}

static onset_scene entry_of(const scene_query *q)
{
    const case_impact *of = &q->impact;
    onset_scene e;
    memset(&e, 0, sizeof e);
    memcpy(e.name, q->name, sizeof e.name);
    if (q->bodies.bodies) return e;
    e.velocity = of->scene.velocity;
    e.radius = of->particle.radius;
    e.height = of->particle.height;
    memcpy(e.shape, of->particle.shape, sizeof e.shape);
    memcpy(e.material, of->particle.material, sizeof e.material);
    surface_text(&of->rail, e.surface, sizeof e.surface);
    e.contact_pressure = of->scene.contact_pressure;
    e.temperature = of->rail.temperature;
    e.lead_face_temperature = of->armature.temperature;
    e.cells_per_radius = of->scene.cells_per_radius;
    e.gauged = case_impact_is_gauged(of);
    return e;
}

scene_record run_scene_record(const scene_query *q)
{
    scene_record r;
    memset(&r, 0, sizeof r);
    r.entry = entry_of(q);
    r.of_bodies = q->bodies.bodies != NULL;
    return r;
}

status run_scene_query_key(const scene_query *q, scene_key *out)
{
    return q->bodies.bodies ? run_scene_key_of_bodies(&q->bodies, out) : run_scene_key_of(&q->impact, out);
}

/* What makes the scene, but for where it ends and what it writes. */
status run_scene_twin(const scene_query *q, uint64_t *twin)
{
    case_impact of = q->impact;
    scene_key key = { .text = NULL };
    *twin = 0;
    if (!of.scene.follow) return status_ok(); /* has no gauges */
    of.scene.stop_when_gauged = false;
    of.snapshots = 0;
    const status done = run_scene_key_of(&of, &key);
    if (done.code == STATUS_OK) *twin = key.hash;
    run_scene_key_free(&key);
    return done;
}

/* Its result lies by its series, in the host's history. */
static status run_bodies(const scene_query *q, const scene_work_how *how)
{
    const mpm_scene *s = &q->bodies.bodies->scene;
    scene_bodies_result r;
    const scene_job job = { .name = q->name,
                            .task = how->task,
                            .scene = s,
                            .snapshots = q->bodies.snapshots,
                            .checkpoint_interval = q->bodies.checkpoint_interval,
                            .last_time = s->end_time,
                            .resume = how->resume,
                            .whole = true };
    run_lending_begin(how->lending);
    const status run = scene_bodies_run(&job, how->host, &r);
    run_lending_end(how->lending);
    scene_bodies_free(&r);
    return run;
}

static status run_impact(const scene_query *q, const scene_work_how *how, scene_record *out)
{
    impact_job job = { .name = q->name, .task = how->task, .of = q->impact, .resume = how->resume };
    impact hit;
    TRY(run_scene_twin(q, &job.twin));
    run_lending_begin(how->lending);
    const status run = how->run(&job, how->host, &hit);
    run_lending_end(how->lending);
    TRY(run);
    out->entry.result = hit.result;
    out->impulse = hit.impulse;
    out->mass_loss = hit.mass_loss;
    return status_ok();
}

status run_scene_work(const scene_query *q, uint64_t key, const scene_work_how *how, scene_record *out)
{
    *out = run_scene_record(q);
    out->key = key;
    return out->of_bodies ? run_bodies(q, how) : run_impact(q, how, out);
}
