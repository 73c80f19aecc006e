#include "coupling/run/scene_work.h"

#include <string.h>

static void surface_text(const breech_case *c, char *out, size_t size)
{
    const case_layers *layers = &c->rail.layers;
    int n = snprintf(out, size, "%s", c->rail.material);
    for (int i = 0; i < layers->n && n > 0 && (size_t)n < size; i++)
        n += snprintf(out + n, size - (size_t)n, " + %s", layers->item[i].material);
}

onset_scene run_scene_entry(const scene_query *q)
{
    const site_state *state = &q->state;
    onset_scene e;
    memset(&e, 0, sizeof e);
    memcpy(e.name, q->name, sizeof e.name);
    e.velocity = state->velocity;
    e.radius = state->grain.radius;
    e.height = state->grain.height;
    memcpy(e.shape, state->grain.shape, sizeof e.shape);
    memcpy(e.material, state->grain.material, sizeof e.material);
    surface_text(q->c, e.surface, sizeof e.surface);
    e.contact_pressure = state->contact_pressure;
    e.temperature = q->c->rail.temperature;
    e.cells_per_radius = q->cells_per_radius;
    e.gauged = gouge_is_gauged(q->c);
    return e;
}

/* What makes the scene, but for where it ends and what it writes. */
status run_scene_twin(const scene_query *q, uint64_t *twin)
{
    breech_case c = *q->c;
    scene_key key = { .text = NULL };
    *twin = 0;
    if (!c.scene.follow) return status_ok(); /* has no gauges */
    c.scene.stop_when_gauged = false;
    c.output.snapshots = 0;
    const status done = run_scene_key_of(&c, &q->state, q->cells_per_radius, &key);
    if (done.code == STATUS_OK) *twin = key.hash;
    run_scene_key_free(&key);
    return done;
}

status run_scene_work(const scene_query *q, uint64_t key, const scene_work_how *how, scene_record *out)
{
    gouge_job job;
    impact hit;
    TRY(gouge_job_make(q->c, &q->state, q->cells_per_radius, &job));
    job.name = q->name;
    job.task = how->task;
    job.resume = how->resume;
    status run = run_scene_twin(q, &job.twin);
    if (run.code == STATUS_OK) {
        run_lending_begin(how->lending);
        run = how->run(&job, how->host, &hit);
        run_lending_end(how->lending);
    }
    gouge_job_free(&job);
    TRY(run);
    memset(out, 0, sizeof *out);
    out->entry = run_scene_entry(q);
    out->entry.result = hit.result;
    out->impulse = hit.impulse;
    out->mass_loss = hit.mass_loss;
    out->key = key;
    return status_ok();
}
