/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_run.h"

#include "coupling/scene/scene_image.h"

#include <math.h>
#include <string.h>

enum { PIECES = 60 };                     /* of a scene */
static const double LIVE_INTERVAL = 0.25; /* between two looks at the solver for the progress line [s] */
/* ---- one run ---- */

typedef struct {
    const scene_job *job;
    const scene_host *host;
    mpm *m;
    scene_resume from;      /* job->resume, or what was on the shelf */
    double piece_end;       /* of the piece under way [s] */
    double before, reached; /* times of the last two steps [s] */
    snapshots *shots;
    int series;                      /* of the history, -1: none */
    int gaps, gaps_over;             /* between snapshots, 0: none are wanted; whose end has one */
    bool shows_start;                /* a single one is of the end */
    double shown;                    /* time of the last of them [s] */
    double started, save_at, looked; /* wall clock [s] */
    double aside;                    /* of the piece under way, for snapshots and checkpoints [s] */
    status error;                    /* of what was done after a step */
} run;

static void book(const scene_host *h, const char *phase, double since)
{
    if (h->timing) host_timing_add(h->timing, phase, host_wall_clock() - since);
}

/* What is done between two steps is not the steps' time. */
static void book_aside(run *r, const char *phase, double since)
{
    book(r->host, phase, since);
    r->aside += host_wall_clock() - since;
}

static double wall_spent(const run *r)
{
    return r->from.wall + host_wall_clock() - r->started;
}

static double progress_of(const run *r, const mpm_report *now)
{
    return fmin(now->time / r->job->last_time, 1.0);
}

/* Until the snapshots so far are on disk. */
static status await_snapshots(run *r)
{
    if (!r->shots) return status_ok();
    const double since = host_wall_clock();
    TRY(output_snapshots_wait(r->shots));
    book_aside(r, "snapshots", since);
    return status_ok();
}

/* A large scene's checkpoints come further apart than asked for, lest they take more than a twentieth of the time. */
static status save(run *r)
{
    enum { SHARE = 20 };
    const scene_host *h = r->host;
    TRY(await_snapshots(r));
    const double since = host_wall_clock();
    if (h->save) {
        TRY(h->save(h->user, r->job->name, &(scene_now){ r->m, r->job->watch, wall_spent(r) }));
        book_aside(r, "checkpoints", since);
    }
    const double now = host_wall_clock(), interval = r->job->checkpoint_interval;
    r->save_at = now + (interval > 0 ? fmax(interval, SHARE * (now - since)) : 0.0); /* 0: after every step */
    return status_ok();
}

/* Of so many equal parts of the scene's time. */
static double part_end(const run *r, int parts, int part)
{
    const double end = r->job->scene->end_time;
    return part + 1 == parts ? end * (1.0 - 1e-12) : end * (part + 1) / parts;
}

/* Parts that are over by then; a step may end several. */
static int parts_over(const run *r, int parts, double time)
{
    int n = 0;
    while (n < parts && part_end(r, parts, n) <= time) n++;
    return n;
}

static status write_snapshot(run *r)
{
    if (!r->shots) return status_ok();
    const double since = host_wall_clock();
    TRY(output_snapshots_write(r->shots, r->m));
    book_aside(r, "snapshots", since);
    return status_ok();
}

/* One that is due by now.  It ends no piece: a scene's answer does not hang on what is shown of it. */
static status show(run *r, double time)
{
    if (r->gaps_over == r->gaps || part_end(r, r->gaps, r->gaps_over) > time) return status_ok();
    r->gaps_over = parts_over(r, r->gaps, time);
    r->shown = time;
    return write_snapshot(r);
}

/* Has the step ended a piece, or the scene?  The watch is asked after every step: it may note what it sees. */
static status ends_piece(const run *r, const mpm_report *now, bool *ends)
{
    const scene_watch *w = r->job->watch;
    *ends = false;
    if (w && w->due) TRY(w->due(w->user, r->m, now, ends));
    *ends = *ends || now->time >= r->piece_end;
    return status_ok();
}

/* After every step: cheap unless something is due.  What a piece's end asks for comes before a stop or a checkpoint. */
static bool on_step(void *user, const mpm *m)
{
    run *r = user;
    const double now = host_wall_clock();
    const mpm_report state = mpm_glance(m);
    bool ends;
    r->before = r->reached, r->reached = state.time;
    if (r->host->threads_now) mpm_set_threads(r->m, r->host->threads_now(r->host->user));
    if (r->host->progress && now - r->looked >= LIVE_INTERVAL) {
        r->looked = now;
        host_progress_update(r->host->progress, progress_of(r, &state), state.particle_steps);
    }
    r->error = ends_piece(r, &state, &ends);
    if (r->error.code == STATUS_OK) r->error = show(r, state.time);
    if (r->job->watch && r->job->watch->finest) mpm_set_finest(r->m, r->job->watch->finest(r->job->watch->user));
    if (r->error.code != STATUS_OK || ends) return false;
    if (now >= r->save_at) r->error = save(r);
    return r->error.code == STATUS_OK && !(r->host->stop && r->host->stop(r->host->user));
}

static status write_row(run *r)
{
    double row[HISTORY_MAX_COLUMNS];
    if (r->series < 0) return status_ok();
    const double since = host_wall_clock();
    const mpm_report state = mpm_state(r->m);
    const mpm_ledger balance = mpm_balance(r->m);
    const scene_watch *w = r->job->watch;
    double *more = output_history_scene_row(&state, &balance, mpm_contact_force(r->m, r->job->force_on), row);
    if (w && w->columns > 0) w->row(w->user, more);
    TRY(output_history_append(r->host->history, r->series, row));
    TRY(output_history_tick(r->host->history));
    book(r->host, "history", since);
    return status_ok();
}

/* At the start, and at the end of every piece. */
static status ask_watch(const run *r, bool *over)
{
    const scene_watch *w = r->job->watch;
    return w && w->piece ? w->piece(w->user, r->m, over) : status_ok();
}

/* To the end of the piece, or to where the watch ends it. */
static status advance_piece(run *r, int piece)
{
    const mpm_sink sink = { on_step, r };
    const double since = host_wall_clock();
    r->piece_end = part_end(r, PIECES, piece);
    r->aside = 0.0;
    const status s = mpm_advance(r->m, r->job->scene->end_time, &sink);
    book(r->host, "scene steps", since + r->aside);
    if (r->error.code != STATUS_OK) return r->error;
    const mpm_report now = mpm_glance(r->m);
    if (s.code != STATUS_STOPPED) return s;
    bool ends;
    TRY(ends_piece(r, &now, &ends));
    if (ends) return status_ok();
    TRY(save(r));
    return s;
}

/* Where every step ends a piece, no step sees that a stop is wanted. */
static status stop_between(run *r)
{
    if (!r->host->stop || !r->host->stop(r->host->user)) return status_ok();
    TRY(save(r));
    return base_status_error(STATUS_STOPPED, "stopped at t = %g s", mpm_glance(r->m).time);
}

static status advance(run *r)
{
    bool over = false;
    int piece = parts_over(r, PIECES, mpm_glance(r->m).time);
    r->gaps_over = parts_over(r, r->gaps, mpm_glance(r->m).time);
    if (!r->from.image) {
        TRY(ask_watch(r, &over));
        TRY(write_row(r));
        if (r->shows_start) TRY(write_snapshot(r));
    }
    while (piece < PIECES && !over) {
        TRY(advance_piece(r, piece));
        TRY(ask_watch(r, &over));
        TRY(write_row(r));
        const double time = mpm_glance(r->m).time;
        if (over && r->shown < time) TRY(write_snapshot(r));
        piece = parts_over(r, PIECES, time);
        if (piece < PIECES && !over) TRY(stop_between(r));
    }
    return status_ok();
}

/* ---- what came out ---- */

static status finish(run *r, scene_outcome *out, bool *keep)
{
    const scene_host *h = r->host;
    const scene_watch *w = r->job->watch;
    *out = (scene_outcome){ mpm_state(r->m), mpm_balance(r->m), wall_spent(r), h->threads };
    if (w && w->finish) TRY(w->finish(w->user, r->m, keep));
    return r->series >= 0 ? output_history_end(h->history, r->series) : status_ok();
}

/* ---- the shelf ---- */

static status shelve(run *r)
{
    const scene_host *h = r->host;
    shelved_scene item = { .twin = r->job->twin, .time = r->reached, .before = r->before, .wall = wall_spent(r) };
    TRY(scene_image(&(scene_now){ r->m, r->job->watch, item.wall }, &item.image, &item.bytes));
    status s = h->history ? host_h5_create(&item.rows) : status_ok();
    if (s.code == STATUS_OK && h->history) s = output_history_export(h->history, r->job->name, item.rows);
    scene_shelf_put(h->shelf, &item);
    return s;
}

/* What a whole scene would have written up to there must be what the shorter one has: the same rows, and no snapshot
 * but the first. */
static bool goes_on_from(const run *r, const shelved_scene *item)
{
    return parts_over(r, PIECES, item->time) == parts_over(r, PIECES, item->before) &&
           !item->rows == !r->host->history && parts_over(r, r->gaps, item->time) == 0;
}

static const shelved_scene *find_shelved(const run *r)
{
    if (!r->host->shelf || r->job->resume.image || !r->job->whole) return NULL;
    const shelved_scene *item = scene_shelf_find(r->host->shelf, r->job->twin);
    return item && goes_on_from(r, item) ? item : NULL;
}

/* ---- setting up ---- */

/* Snapshots are evenly apart, the first of the start, the last of the end, which a single one is of. */
static void plan_snapshots(run *r)
{
    const int n = r->job->snapshots;
    if (n > 0 && (r->host->dir || r->host->sink)) r->gaps = n > 1 ? n - 1 : 1;
    r->shows_start = n > 1;
}

static status open_snapshots(run *r, double reached)
{
    char dir[OUTDIR_PATH_SIZE];
    if (r->gaps == 0) return status_ok();
    if (r->host->sink) {
        snprintf(dir, sizeof dir, "scenes/%s", r->job->name);
        return output_snapshots_open_sink(dir, r->host->sink, &r->shots);
    }
    TRY(host_outdir_scene(r->host->dir, r->job->name, dir, sizeof dir));
    return output_snapshots_open(dir, reached, &r->shots);
}

static status open_output(run *r)
{
    const scene_host *h = r->host;
    const scene_watch *w = r->job->watch;
    /* what was stopped there has its row of that instant, if one was due; what a shorter scene ended with is redone */
    const double near = r->job->resume.image ? 1e-9 : -1e-9,
                 reached = r->from.image ? r->from.time * (1.0 + near) : -1.0;
    if (h->history) {
        TRY(output_history_scene(h->history, r->job->name, w ? w->column : NULL, w ? w->columns : 0, &r->series));
        TRY(output_history_rewind(h->history, r->series, reached));
    }
    return open_snapshots(r, r->job->resume.image ? reached : -1.0);
}

/* From the start, from where it was stopped, or from where the shorter one has ended; then its first snapshot, of the
 * start, is still to be written. */
static status take_up(run *r)
{
    const shelved_scene *shelved = find_shelved(r);
    if (shelved) {
        r->from = (scene_resume){ shelved->image, shelved->bytes, shelved->time, shelved->wall };
        if (r->host->history) TRY(output_history_import(r->host->history, r->job->name, shelved->rows));
    }
    TRY(open_output(r));
    if (shelved && r->shows_start) TRY(write_snapshot(r));
    return r->from.image ? scene_image_take_up(&r->from, r->job->watch, r->m) : status_ok();
}

static status run_made(run *r, scene_outcome *out)
{
    bool keep = false;
    TRY(take_up(r));
    const mpm_report state = mpm_glance(r->m);
    r->reached = state.time;
    if (r->host->progress)
        host_progress_task(r->host->progress, r->job->task, progress_of(r, &state), state.particle_steps);
    TRY(advance(r));
    TRY(await_snapshots(r));
    TRY(finish(r, out, &keep));
    const bool shelved = keep && r->host->shelf && r->job->twin && !r->job->whole;
    return shelved && r->reached < r->piece_end ? shelve(r) : status_ok();
}

status scene_run(const scene_job *job, const scene_host *host, scene_outcome *out)
{
    run r = { .job = job, .host = host, .from = job->resume, .series = -1, .error = status_ok() };
    memset(out, 0, sizeof *out);
    r.started = r.looked = host_wall_clock();
    r.save_at = r.started + job->checkpoint_interval;
    plan_snapshots(&r);
    status s = mpm_create(job->scene, host->threads, &r.m);
    book(host, "scene making", r.started);
    if (s.code == STATUS_OK) s = run_made(&r, out);
    output_snapshots_close(r.shots);
    mpm_free(r.m);
    return s;
}
