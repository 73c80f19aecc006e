#include "coupling/run/scene_work.h"

#include <string.h>

static void surface_text(const case_rail *rail, char *out, size_t size)
{
    const case_layers *layers = &rail->layers;
    int n = snprintf(out, size, "%s", rail->material);
    for (int i = 0; i < layers->n && n > 0 && (size_t)n < size; i++)
        n += snprintf(out + n, size - (size_t)n, " + %s", layers->item[i].material);
}

onset_scene run_scene_entry(const scene_query *q)
{
    const case_impact *of = &q->impact;
    onset_scene e;
    memset(&e, 0, sizeof e);
    memcpy(e.name, q->name, sizeof e.name);
    e.velocity = of->scene.velocity;
    e.radius = of->particle.radius;
    e.height = of->particle.height;
    memcpy(e.shape, of->particle.shape, sizeof e.shape);
    memcpy(e.material, of->particle.material, sizeof e.material);
    surface_text(&of->rail, e.surface, sizeof e.surface);
    e.contact_pressure = of->scene.contact_pressure;
    e.temperature = of->rail.temperature;
    e.cells_per_radius = of->scene.cells_per_radius;
    e.gauged = case_impact_is_gauged(of);
    return e;
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

status run_scene_work(const scene_query *q, uint64_t key, const scene_work_how *how, scene_record *out)
{
    impact_job job = { .name = q->name, .task = how->task, .of = q->impact, .resume = how->resume };
    impact hit;
    TRY(run_scene_twin(q, &job.twin));
    run_lending_begin(how->lending);
    const status run = how->run(&job, how->host, &hit);
    run_lending_end(how->lending);
    TRY(run);
    memset(out, 0, sizeof *out);
    out->entry = run_scene_entry(q);
    out->entry.result = hit.result;
    out->impulse = hit.impulse;
    out->mass_loss = hit.mass_loss;
    out->key = key;
    return status_ok();
}
