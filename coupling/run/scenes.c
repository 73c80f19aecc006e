/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/scenes.h"

#include "coupling/run/crew.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ENERGY_ERROR_LIMIT = 0.01; /* above it a scene is warned about (issue's bound of the base case) */

/* ---- computing ---- */

void run_scenes_warn_of_energy(session *s, const char *scene, double error)
{
    const bool named = scene[0] != '\0';
    if (fabs(error) > ENERGY_ERROR_LIMIT)
        run_session_warn(s, "%s%s%senergy error %.2f %%, above %.0f %%: lower scene.courant or take smaller cells",
                         named ? "scene " : "", scene, named ? ": " : "", 100.0 * error, 100.0 * ENERGY_ERROR_LIMIT);
}

void run_scenes_warn_of(session *s, const onset_scene *e)
{
    const scene_result *r = &e->result;
    run_scenes_warn_of_energy(s, e->name, r->energy_error);
    if (r->crater_truncated)
        run_session_warn(s, "scene %s: the crater reaches the edge of its map: enlarge scene.rail_ahead or rail_width",
                         e->name);
}

/* Between the fastest scene of this grain and surface that does not gouge and the slowest that does, as far as they are
 * known: "; gouges begin in 875 .. 1625 m/s".  Scenes of one search have names that are alike up to "-v". */
static void bracket_text(const session *s, const char *name, char *out, size_t size)
{
    double low = -INFINITY, high = INFINITY;
    const char *end = strstr(name, "-v");
    const size_t alike = end ? (size_t)(end - name) + 2 : 0;
    out[0] = '\0';
    for (int k = 0; alike > 0 && k < s->n_records; k++) {
        const onset_scene *e = &s->record[k]->entry;
        if (s->record[k]->of_bodies || strncmp(e->name, name, alike) != 0) continue;
        const damage_class class = e->gauged ? e->result.class : e->result.crater_class; /* as the search takes it */
        if (class == DAMAGE_GOUGE) high = fmin(high, e->velocity);
        if (class < DAMAGE_GOUGE) low = fmax(low, e->velocity);
    }
    if (low >= high) return; /* they turn back, or scatter */
    if (isfinite(low) && isfinite(high))
        snprintf(out, size, "; gouges begin in %.0f .. %.0f m/s", low, high);
    else if (isfinite(high))
        snprintf(out, size, "; gouges begin below %.0f m/s", high);
    else if (isfinite(low))
        snprintf(out, size, "; gouges begin above %.0f m/s", low);
}

static void say_outcome(session *s, const onset_scene *e)
{
    const scene_result *r = &e->result;
    char what[80] = "", bracket[80];
    bracket_text(s, e->name, bracket, sizeof bracket);
    if (e->gauged && isfinite(r->groove_growth))
        snprintf(what, sizeof what, ", growth %.2f a microsecond", 1e-6 * r->groove_growth);
    else if (!e->gauged && isfinite(r->severity) && isfinite(r->widening))
        snprintf(what, sizeof what, ", severity %.2f, widening %.2f", r->severity, r->widening);
    else if (!e->gauged && isfinite(r->severity))
        snprintf(what, sizeof what, ", severity %.2f", r->severity);
    host_progress_say(&s->progress, "%-22s %s%s (%.0f s)%s", e->name, run_damage_names[r->class], what, r->wall_seconds,
                      bracket);
}

static bool stop_asked(void *user)
{
    const session *s = user;
    return s->stop && s->stop();
}

static status run_here(session *s, const scene_query *q, const scene_key *key, scene_record *out)
{
    char task[150], bracket[80];
    bracket_text(s, q->name, bracket, sizeof bracket);
    if (q->bodies.bodies)
        snprintf(task, sizeof task, "%s", q->name);
    else
        snprintf(task, sizeof task, "scene %d, %g m/s, %g cells a radius%s", s->n_records + 1, q->impact.scene.velocity,
                 q->impact.scene.cells_per_radius, bracket);
    const scene_host host = { .dir = &s->dir,
                              .history = s->history,
                              .progress = &s->progress,
                              .timing = &s->timing,
                              .shelf = &s->shelf,
                              .threads = s->threads,
                              .stop = stop_asked,
                              .save = run_session_save_inside,
                              .user = s };
    const scene_work_how how = { s->run_scene, task, &host, NULL, run_session_resume_of(s, q->name) };
    return run_scene_work(q, key->hash, &how, out);
}

static status into_store(session *s, const scene_record *r, const scene_key *key)
{
    h5_file *file;
    if (!s->store[0]) return status_ok();
    TRY(run_scene_file_make(r, key, s->history, &file));
    const status done = run_store_put(s->store, key, file);
    host_h5_close(file);
    return done;
}

static status keep(session *s, const scene_record *fresh)
{
    TRY(run_session_keep(s, fresh));
    if (!fresh->of_bodies) say_outcome(s, &fresh->entry);
    return status_ok();
}

static status compute(session *s, const scene_query *q, const scene_key *key)
{
    scene_record fresh;
    TRY(run_here(s, q, key, &fresh));
    const status stored = into_store(s, &fresh, key);
    TRY(keep(s, &fresh)); /* where the store's disk is full, too: the run goes on from here */
    return stored;
}

/* ---- taking up what is there ---- */

/* The scene's series and crater come along where its file has them. */
static status take_file(session *s, const scene_query *q, const scene_key *key, const h5_file *file, bool reused)
{
    scene_record r = run_scene_record(q);
    r.entry.reused = reused;
    TRY(run_scene_file_read(file, key, &r));
    if (host_h5_exists(file, "/scene")) TRY(output_history_import(s->history, q->name, file));
    return keep(s, &r);
}

/* From another process, or computed ahead. */
static status take_come(session *s, const scene_query *q, const scene_key *key)
{
    h5_file *file = NULL;
    if (!s->crew) return status_ok();
    const status done = run_crew_take(s->crew, key, &file);
    const status taken = file ? take_file(s, q, key, file, false) : status_ok();
    host_h5_close(file);
    return done.code == STATUS_OK ? taken : done;
}

/* Snapshots are not stored: a run that was started over makes those that it has removed again. */
static bool may_be_stored(const session *s, const scene_query *q)
{
    const bool shows = (q->bodies.bodies ? q->bodies.snapshots : q->impact.snapshots) > 0;
    return s->store[0] && !q->anew && !(s->started_over && shows);
}

/* Once a file: it is looked for again and again until its scene is computed. */
static void warn_of_damaged(session *s, const char *what)
{
    if (!s->warnings || !strstr(s->warnings, what)) run_session_warn(s, "%s; computed anew", what);
}

static const scene_record *record_of(const session *s, uint64_t key)
{
    for (int i = 0; i < s->n_records; i++)
        if (s->record[i]->key == key) return s->record[i];
    return NULL;
}

/* A file that cannot be used is none: its scene is computed and replaces it. */
static status take_stored(session *s, const scene_query *q, const scene_key *key)
{
    h5_file *file = NULL;
    if (!may_be_stored(s, q)) return status_ok();
    status taken = run_store_get(s->store, key, &file);
    if (file) taken = take_file(s, q, key, file, true);
    host_h5_close(file);
    if (taken.code != STATUS_IO || record_of(s, key->hash)) return taken; /* taken: it is the checkpoint's */
    warn_of_damaged(s, taken.text);
    return status_ok();
}

/* ---- asking ---- */

/* Known by now, or NULL in *out; the key is the caller's to free. */
static status look_up(session *s, const scene_query *q, scene_key *key, const scene_record **out)
{
    *out = NULL;
    TRY(run_scene_query_key(q, key));
    *out = record_of(s, key->hash);
    if (*out) return status_ok();
    if (s->store[0]) TRY(run_store_check(s->store, key));
    TRY(take_come(s, q, key));
    *out = record_of(s, key->hash);
    if (*out) return status_ok();
    TRY(take_stored(s, q, key));
    *out = record_of(s, key->hash);
    return status_ok();
}

status run_scenes_find(session *s, const scene_query *query, const scene_record **out)
{
    scene_key key = { .text = NULL };
    const status done = look_up(s, query, &key, out);
    run_scene_key_free(&key);
    return done;
}

static status compute_here(session *s, const scene_query *q)
{
    scene_key key = { .text = NULL };
    status done = run_scene_query_key(q, &key);
    if (done.code == STATUS_OK) done = compute(s, q, &key);
    run_scene_key_free(&key);
    return done;
}

/* Those of the n that are not known, into missing (n of room); *left of them. */
static status list_missing(session *s, const scene_query *query, int n, scene_query *missing, int *left)
{
    *left = 0;
    for (int i = 0; i < n; i++) {
        const scene_record *known;
        TRY(run_scenes_find(s, &query[i], &known));
        if (!known) missing[(*left)++] = query[i];
    }
    return status_ok();
}

/* One more of them, wherever it is computed; *left: how many were missing before. */
static status one_more(session *s, const scene_query *query, int n, int *left)
{
    scene_query *missing = malloc(((size_t)n + 1) * sizeof *missing);
    CHECK(missing, STATUS_MEMORY, "no memory for %d scenes", n);
    status done = list_missing(s, query, n, missing, left);
    if (done.code == STATUS_OK && *left > 0)
        done = s->crew ? run_crew_some(s->crew, missing, *left) : compute_here(s, &missing[0]);
    free(missing);
    return done;
}

status run_scenes_some(session *s, const scene_query *query, int n)
{
    int left;
    return one_more(s, query, n, &left);
}

status run_scenes_all(session *s, const scene_query *query, int n, const scene_record **out)
{
    int left = n;
    while (left > 0) TRY(one_more(s, query, n, &left));
    for (int i = 0; i < n; i++) TRY(run_scenes_find(s, &query[i], &out[i]));
    return status_ok();
}

static status is_known(const session *s, const scene_query *q, bool *known)
{
    scene_key key = { .text = NULL };
    status done = run_scene_query_key(q, &key);
    if (done.code == STATUS_OK && s->store[0]) done = run_store_check(s->store, &key);
    *known = record_of(s, key.hash) || (may_be_stored(s, q) && run_store_has(s->store, &key));
    run_scene_key_free(&key);
    return done;
}

/* One process has no idle ones. */
status run_scenes_ahead(session *s, const scene_query *query, int n, bool any_order)
{
    if (!s->crew) return status_ok();
    scene_query *open = malloc(((size_t)n + 1) * sizeof *open);
    CHECK(open, STATUS_MEMORY, "no memory for %d scenes", n);
    int left = 0;
    status done = status_ok();
    for (int i = 0; i < n && done.code == STATUS_OK; i++) {
        bool known;
        done = is_known(s, &query[i], &known);
        if (!known) open[left++] = query[i];
    }
    if (done.code == STATUS_OK) done = run_crew_ahead(s->crew, open, left, any_order);
    free(open);
    return done;
}
