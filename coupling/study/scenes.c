#include "coupling/study/scenes.h"

#include "coupling/study/store.h"

#include <math.h>
#include <string.h>

static const double ENERGY_ERROR_LIMIT = 0.01; /* above it a scene is warned about (issue's bound of the base case) */

/* ---- what a query asks for ---- */

static void surface_text(const breech_case *c, char *out, size_t size)
{
    const case_layers *layers = &c->rail.layers;
    int n = snprintf(out, size, "%s", c->rail.material);
    for (int i = 0; i < layers->n && n > 0 && (size_t)n < size; i++)
        n += snprintf(out + n, size - (size_t)n, " + %s", layers->item[i].material);
}

/* The entry all but its result. */
static onset_scene describe(const scene_query *q)
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
    return e;
}

/* ---- computing ---- */

static void warn_of(session *s, const onset_scene *e)
{
    const scene_result *r = &e->result;
    if (fabs(r->energy_error) > ENERGY_ERROR_LIMIT)
        session_warn(s, "scene %s: energy error %.2f %%, above %.0f %%: lower scene.courant or raise the resolution",
                     e->name, 100.0 * r->energy_error, 100.0 * ENERGY_ERROR_LIMIT);
    if (r->crater_truncated)
        session_warn(s,
                     "scene %s: the crater reaches the edge of the fine zone: enlarge scene.fine_ahead or fine_width",
                     e->name);
}

static void say_outcome(session *s, const onset_scene *e)
{
    const scene_result *r = &e->result;
    progress_say(&s->progress, "%-22s %s, severity %.2f, widening %.2f (%.0f s)", e->name, damage_class_names[r->class],
                 r->severity, r->widening, r->wall_seconds);
}

static status run_here(session *s, const scene_query *q, impact *hit)
{
    scene_job job;
    char task[120];
    TRY(scene_job_make(q->c, &q->state, q->cells_per_radius, &job));
    snprintf(task, sizeof task, "scene %d, %g m/s, %g cells a radius", s->n_records + 1, q->state.velocity,
             q->cells_per_radius);
    job.name = q->name;
    job.task = task;
    job.resume = session_resume_of(s, q->name);
    const scene_host host = { .dir = &s->dir,
                              .history = s->history,
                              .progress = &s->progress,
                              .timing = &s->timing,
                              .threads = s->threads,
                              .stop = s->stop,
                              .save = session_save_inside,
                              .user = s };
    return s->run_scene(&job, &host, hit);
}

static status into_store(session *s, const scene_record *r, const scene_key *key)
{
    h5_file *file;
    if (!s->store[0]) return status_ok();
    TRY(scene_store_open(s->store));
    TRY(scene_file_make(r, key, s->history, &file));
    const status done = scene_store_put(s->store, key, file);
    h5_close(file);
    return done;
}

static status keep(session *s, const scene_record *fresh)
{
    TRY(session_keep(s, fresh));
    warn_of(s, &fresh->entry);
    say_outcome(s, &fresh->entry);
    return status_ok();
}

static status compute(session *s, const scene_query *q, const scene_key *key)
{
    scene_record fresh;
    impact hit;
    memset(&fresh, 0, sizeof fresh);
    TRY(run_here(s, q, &hit));
    fresh.entry = describe(q);
    fresh.entry.result = hit.result;
    fresh.impulse = hit.impulse;
    fresh.mass_loss = hit.mass_loss;
    fresh.key = key->hash;
    TRY(into_store(s, &fresh, key));
    return keep(s, &fresh);
}

/* ---- taking up what is there ---- */

/* The scene's series and crater come along where its file has them. */
static status take_file(session *s, const scene_query *q, const scene_key *key, const h5_file *file)
{
    scene_record old;
    memset(&old, 0, sizeof old);
    old.entry = describe(q);
    old.entry.reused = true;
    TRY(scene_file_read(file, key, &old));
    if (h5_exists(file, "/scene")) TRY(history_import(s->history, q->name, file));
    return keep(s, &old);
}

/* A file that cannot be used is none: its scene is computed and replaces it. */
static status take_stored(session *s, const scene_query *q, const scene_key *key)
{
    h5_file *file = NULL;
    if (!s->store[0] || q->anew) return status_ok();
    TRY(scene_store_get(s->store, key, &file));
    if (!file) return status_ok();
    const status taken = take_file(s, q, key, file);
    h5_close(file);
    if (taken.code == STATUS_IO) session_warn(s, "%s; computed anew", taken.text);
    return taken.code == STATUS_IO ? status_ok() : taken;
}

static const scene_record *record_of(const session *s, uint64_t key)
{
    for (int i = 0; i < s->n_records; i++)
        if (s->record[i]->key == key) return s->record[i];
    return NULL;
}

/* ---- asking ---- */

/* Known by now, or NULL in *out; the key is the caller's to free. */
static status look_up(session *s, const scene_query *q, scene_key *key, const scene_record **out)
{
    *out = NULL;
    TRY(scene_key_of(q->c, &q->state, q->cells_per_radius, key));
    *out = record_of(s, key->hash);
    if (*out) return status_ok();
    TRY(take_stored(s, q, key));
    *out = record_of(s, key->hash);
    return status_ok();
}

status scenes_find(session *s, const scene_query *query, const scene_record **out)
{
    scene_key key = { .text = NULL };
    const status done = look_up(s, query, &key, out);
    scene_key_free(&key);
    return done;
}

static status find_or_compute(session *s, const scene_query *q, const scene_record **out)
{
    scene_key key = { .text = NULL };
    status done = look_up(s, q, &key, out);
    if (done.code == STATUS_OK && !*out) {
        done = compute(s, q, &key);
        *out = record_of(s, key.hash);
    }
    scene_key_free(&key);
    return done;
}

status scenes_all(session *s, const scene_query *query, int n, const scene_record **out)
{
    for (int i = 0; i < n; i++) TRY(find_or_compute(s, &query[i], &out[i]));
    return status_ok();
}

status scenes_some(session *s, const scene_query *query, int n)
{
    const scene_record *known;
    for (int i = 0; i < n; i++) {
        TRY(scenes_find(s, &query[i], &known));
        if (!known) return find_or_compute(s, &query[i], &known);
    }
    return status_ok();
}

status scenes_ahead(session *s, const scene_query *query, int n)
{
    (void)s, (void)query, (void)n; /* one process has no idle ones */
    return status_ok();
}
