#include "coupling/scene/scene_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECES = 60 };                     /* of a scene, at least */
static const double LIVE_INTERVAL = 0.25; /* between two looks at the solver for the progress line [s] */
static const double SETTLED_SHARE = 0.1;  /* of the measuring depth */
static const double DEAD_SHARE = 0.1;     /* of its largest plastic power, below which a groove is dead */

status scene_job_make(const breech_case *c, const site_state *state, double cells_per_radius, scene_job *job)
{
    memset(job, 0, sizeof *job);
    job->c = c;
    return gouge_scene_from_state(c, state, cells_per_radius, &job->scene, &job->spec);
}

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
    int pieces, per_snapshot;        /* pieces; pieces from one snapshot to the next, 0: no snapshots */
    double started, save_at, looked; /* wall clock [s] */
    status error;                    /* of the sink */
} run;

/* ---- the material points, read once for all who look at them ---- */

typedef struct {
    size_t n;
    double *position, *velocity, *size, *damage, *mass, *body; /* one block of memory, owned by position */
} points;

/* Behind the fine zone the rail's points are those of the wake, as fine as they were there. */
static status points_read(const mpm *m, points *p)
{
    const size_t live = mpm_particles(m), room = live + mpm_wake_of(m)->n;
    double *all = malloc((room ? room : 1) * 12 * sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory to read %zu material points", room);
    *p = (points){ .n = live,
                   .position = all,
                   .velocity = all + 3 * room,
                   .size = all + 6 * room,
                   .damage = all + 9 * room,
                   .mass = all + 10 * room,
                   .body = all + 11 * room };
    mpm_read(m, MPM_position, p->position);
    mpm_read(m, MPM_velocity, p->velocity);
    mpm_read(m, MPM_size, p->size);
    mpm_read(m, MPM_damage, p->damage);
    mpm_read(m, MPM_mass, p->mass);
    mpm_read(m, MPM_body, p->body);
    return status_ok();
}

static void append_wake(const mpm_wake *w, points *p)
{
    for (size_t i = 0; i < w->n; i++, p->n++) {
        const mpm_wake_point *q = &w->point[i];
        memcpy(p->position + 3 * p->n, q->position, sizeof q->position);
        memcpy(p->velocity + 3 * p->n, q->velocity, sizeof q->velocity);
        memcpy(p->size + 3 * p->n, q->size, sizeof q->size);
        p->damage[p->n] = q->damage, p->mass[p->n] = q->mass, p->body[p->n] = q->body;
    }
}

static void points_free(points *p)
{
    free(p->position);
}

/* Keeps the rail's points over the crater's map, in their order: those of the wake behind the fine zone, where the
 * solver's own are merged. */
static void keep_rail(const run *r, points *p)
{
    const scene_job *job = r->job;
    const crater_spec *s = &job->spec;
    const mpm_wake *wake = mpm_wake_of(r->m);
    size_t kept = 0;
    for (size_t i = 0; i < p->n; i++) {
        double *x = p->position + 3 * i, *half = p->size + 3 * i;
        if (!gouge_body_is_rail(&job->scene, (int)p->body[i]) || !mpm_cut_at(wake->until, true, x, half, &p->mass[i]) ||
            x[0] + half[0] < s->x_lo || x[0] - half[0] > s->x_hi || fabs(x[2]) - half[2] > s->z_hi)
            continue;
        memmove(p->position + 3 * kept, x, 3 * sizeof *x);
        memmove(p->velocity + 3 * kept, p->velocity + 3 * i, 3 * sizeof *x);
        memmove(p->size + 3 * kept, half, 3 * sizeof *x);
        p->damage[kept] = p->damage[i];
        p->mass[kept] = p->mass[i];
        kept++;
    }
    p->n = kept;
    append_wake(wake, p);
}

static void book(const scene_host *h, const char *phase, double since)
{
    if (h->timing) host_timing_add(h->timing, phase, host_wall_clock() - since);
}

static double wall_spent(const run *r)
{
    return r->from.wall + host_wall_clock() - r->started;
}

static double progress_of(const run *r, const mpm_report *now)
{
    return fmin(now->time / gouge_last_time(r->job->c, &r->job->scene), 1.0);
}

/* A large scene's checkpoints come further apart than asked for, lest they take more than a twentieth of the time. */
static status save(run *r)
{
    enum { SHARE = 20 };
    const scene_host *h = r->host;
    const double since = host_wall_clock();
    if (h->save) {
        TRY(h->save(h->user, r->job->name, r->m, wall_spent(r)));
        if (h->history) TRY(output_history_flush(h->history));
        book(h, "checkpoints", since);
    }
    const double now = host_wall_clock(), interval = r->job->c->output.checkpoint_interval;
    r->save_at = now + (interval > 0 ? fmax(interval, SHARE * (now - since)) : 0.0); /* 0: after every step */
    return status_ok();
}

static bool is_gauged(const run *r, const mpm_report *now)
{
    const breech_case *c = r->job->c;
    return gouge_is_gauged(c) && (now->gauge_at[1] > 0.0 || gouge_groove_dies(c, &r->job->scene, now));
}

/* Has the step ended a piece, or the scene? */
static bool is_due(const run *r, const mpm_report *now)
{
    return now->time >= r->piece_end || is_gauged(r, now);
}

/* After every step: cheap unless something is due.  What a piece's end asks for comes before a stop or a checkpoint. */
static bool on_step(void *user, const mpm *m)
{
    run *r = user;
    const double now = host_wall_clock();
    const mpm_report state = mpm_glance(m);
    r->before = r->reached, r->reached = state.time;
    if (r->host->threads_now) mpm_set_threads(r->m, r->host->threads_now(r->host->user));
    if (r->host->progress && now - r->looked >= LIVE_INTERVAL) {
        r->looked = now;
        host_progress_update(r->host->progress, progress_of(r, &state), state.particle_steps);
    }
    if (is_due(r, &state)) return false;
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
    output_history_scene_row(&state, &balance, row);
    TRY(output_history_append(r->host->history, r->series, row));
    TRY(output_history_tick(r->host->history));
    book(r->host, "history", since);
    return status_ok();
}

static status write_snapshot(run *r)
{
    if (!r->shots) return status_ok();
    const double since = host_wall_clock();
    TRY(output_snapshots_write(r->shots, r->m));
    book(r->host, "snapshots", since);
    return status_ok();
}

/* Largest distance that a sound rail point of the map would still go until the end [m]. */
static status distance_left(const run *r, double *distance)
{
    points p;
    TRY(points_read(r->m, &p));
    keep_rail(r, &p);
    double fastest2 = 0.0;
    for (size_t i = 0; i < p.n; i++) {
        const double *v = p.velocity + 3 * i;
        if (p.damage[i] < 1.0) fastest2 = fmax(fastest2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    points_free(&p);
    *distance = sqrt(fastest2) * (r->job->scene.end_time - mpm_glance(r->m).time);
    return status_ok();
}

/* A groove that is followed: dead, or the armature's contact face has gone over its front. */
static bool groove_over(const run *r, const mpm_report *now)
{
    const mpm_scene *s = &r->job->scene;
    return now->time > gouge_grain_passed(s) && (now->plastic_power < DEAD_SHARE * now->peak_plastic_power ||
                                                 gouge_face_tail(s, now->time) > now->plastic_front);
}

static status is_settled(const run *r, bool *settled)
{
    const mpm_report now = mpm_glance(r->m);
    *settled = is_gauged(r, &now);
    if (*settled) return status_ok();
    if (!r->job->c->scene.stop_when_settled) return status_ok();
    if (r->job->scene.follow_bodies) {
        *settled = groove_over(r, &now);
        return status_ok();
    }
    if (now.time < gouge_crossing_time(&r->job->scene)) return status_ok();
    const crater_spec *s = &r->job->spec;
    double distance;
    TRY(distance_left(r, &distance));
    *settled = distance < SETTLED_SHARE * fmax(0.1 * s->particle_radius, 0.5 * s->cell);
    return status_ok();
}

static double piece_end(const run *r, int piece)
{
    const double end = r->job->scene.end_time;
    return piece + 1 == r->pieces ? end * (1.0 - 1e-12) : end * (piece + 1) / r->pieces;
}

/* Pieces that are over by then; a step may end several. */
static int pieces_over(const run *r, double time)
{
    int n = 0;
    while (n < r->pieces && piece_end(r, n) <= time) n++;
    return n;
}

/* To the end of the piece, or to the gauge in it. */
static status advance_piece(run *r, int piece)
{
    const mpm_sink sink = { on_step, r };
    const double since = host_wall_clock();
    r->piece_end = piece_end(r, piece);
    const status s = mpm_advance(r->m, r->job->scene.end_time, &sink);
    book(r->host, "scene steps", since);
    if (r->error.code != STATUS_OK) return r->error;
    const mpm_report now = mpm_glance(r->m);
    if (s.code != STATUS_STOPPED) return s;
    if (is_due(r, &now)) return status_ok();
    TRY(save(r));
    return s;
}

static status advance(run *r)
{
    bool settled = false;
    int piece = pieces_over(r, mpm_glance(r->m).time);
    if (!r->from.image) {
        TRY(write_row(r));
        TRY(write_snapshot(r));
    }
    while (piece < r->pieces && !settled) {
        TRY(advance_piece(r, piece));
        TRY(is_settled(r, &settled));
        TRY(write_row(r));
        const int over = pieces_over(r, mpm_glance(r->m).time);
        const bool due = r->per_snapshot && over / r->per_snapshot > piece / r->per_snapshot;
        if (due || (settled && r->per_snapshot)) TRY(write_snapshot(r));
        piece = over;
    }
    return status_ok();
}

/* ---- what came out ---- */

static status measure_crater(const run *r, crater *out)
{
    points p;
    TRY(points_read(r->m, &p));
    keep_rail(r, &p);
    const crater_points rail = { .n = p.n, .position = p.position, .size = p.size, .damage = p.damage };
    crater_spec spec = r->job->spec;
    spec.x_hi = fmin(spec.x_hi, mpm_scene_of(r->m)->axis[0].fine_hi); /* a zone that follows has got so far */
    const status s = gouge_crater_measure(&rail, &spec, out);
    points_free(&p);
    return s;
}

typedef struct {
    double mass, momentum; /* of the armature's sound metal, along x [kg, kg m/s] */
} armature_metal;

static status armature_now(const run *r, armature_metal *out)
{
    const int armature = gouge_body_of_armature(&r->job->scene);
    const double slow = 0.5 * r->job->scene.body[armature].velocity[0];
    points p;
    *out = (armature_metal){ 0.0, 0.0 };
    TRY(points_read(r->m, &p));
    for (size_t i = 0; i < p.n; i++) {
        const double vx = p.velocity[3 * i];
        if ((int)p.body[i] != armature || !(p.damage[i] < 1.0) || vx < slow) continue;
        out->mass += p.mass[i];
        out->momentum += p.mass[i] * vx;
    }
    points_free(&p);
    return status_ok();
}

/* Sound metal of every body that goes with the armature: chips, layers that came off. */
static status measure_carried(const run *r, scene_result *out)
{
    const mpm_scene *s = &r->job->scene;
    const double fast = 0.5 * s->body[gouge_body_of_armature(s)].velocity[0];
    const double halves = r->job->c->scene.half_model ? 2.0 : 1.0;
    points p;
    TRY(points_read(r->m, &p));
    for (size_t i = 0; i < p.n; i++) {
        const int body = (int)p.body[i];
        if (p.damage[i] < 1.0 && p.velocity[3 * i] > fast)
            out->carried_volume[body] += halves * p.mass[i] / s->body[body].material->density;
    }
    points_free(&p);
    return status_ok();
}

/* The lost metal keeps its own speed's worth of impulse out of the sum: circuit_shot_jump books it with the mass
 * (docs/onset.md). */
static void book_losses(const run *r, const armature_metal *before, const armature_metal *after, impact *out)
{
    const breech_case *c = r->job->c;
    const mpm_body *b = &r->job->scene.body[gouge_body_of_armature(&r->job->scene)];
    const double halves = c->scene.half_model ? 2.0 : 1.0, time = mpm_glance(r->m).time;
    const double pressing = -b->body_force[1] * before->mass;
    out->mass_loss = halves * fmax(before->mass - after->mass, 0.0);
    const double kept = after->mass * b->velocity[0] - after->momentum;
    out->impulse = fmax(halves * (kept - c->scene.friction * pressing * time), 0.0);
}

/* A scene that ends at its second gauge, or dying, has no whole crater to be judged by; what left none until then is
 * still `none`. */
static void judge_by_growth(const run *r, scene_result *out)
{
    const double scatter = r->job->c->scene.growth_scatter;
    const double folds =
        gouge_growth_folds(out->groove_growth, r->job->spec.particle_radius, r->job->scene.follow_speed);
    const bool decided = fabs(folds) >= scatter;
    const damage_class below = out->class == DAMAGE_NONE ? DAMAGE_NONE : DAMAGE_SCRATCH;
    out->class = !decided ? DAMAGE_UNDECIDED : folds > 0.0 ? DAMAGE_GOUGE : below;
    snprintf(out->reason, sizeof out->reason,
             "the groove's plastic power changes by %.2f e-folds from gauge to gauge, %s %.2f", folds,
             decided ? "beyond" : "within", scatter);
}

static status finish(run *r, const armature_metal *before, impact *out)
{
    const scene_host *h = r->host;
    const double since = host_wall_clock();
    armature_metal after;
    crater found;
    TRY(armature_now(r, &after));
    TRY(measure_crater(r, &found));
    const mpm_report report = mpm_state(r->m);
    const mpm_ledger ledger = mpm_balance(r->m);
    const scene_outcome o = { .scene = &r->job->scene,
                              .report = &report,
                              .ledger = &ledger,
                              .crater = &found,
                              .wall_seconds = wall_spent(r),
                              .threads = h->threads,
                              .mirrored = r->job->c->scene.half_model };
    out->result = output_scene_result(&o);
    if (gouge_is_gauged(r->job->c)) judge_by_growth(r, &out->result);
    book_losses(r, before, &after, out);
    status s = measure_carried(r, &out->result);
    const bool whole = !gouge_is_gauged(r->job->c);
    if (s.code == STATUS_OK && h->history && whole) s = output_history_crater(h->history, r->job->name, &found);
    gouge_crater_free(&found);
    if (s.code == STATUS_OK && r->series >= 0) s = output_history_end(h->history, r->series);
    book(h, "crater", since);
    return s;
}

/* ---- the shelf ---- */

static status shelve(run *r)
{
    const scene_host *h = r->host;
    shelved_scene item = {
        .twin = r->job->twin, .pieces = r->pieces, .time = r->reached, .before = r->before, .wall = wall_spent(r)
    };
    TRY(mpm_save(r->m, &item.image, &item.bytes));
    status s = h->history ? host_h5_create(&item.rows) : status_ok();
    if (s.code == STATUS_OK && h->history) s = output_history_export(h->history, r->job->name, item.rows);
    scene_shelf_put(h->shelf, &item);
    return s;
}

/* What a whole scene would have written up to there must be what the one to its gauge has: the same rows, and no
 * snapshot but the first. */
static bool goes_on_from(const run *r, const shelved_scene *item)
{
    const int over = pieces_over(r, item->time);
    return item->pieces == r->pieces && over == pieces_over(r, item->before) && !item->rows == !r->host->history &&
           (!r->per_snapshot || over < r->per_snapshot);
}

static const shelved_scene *find_shelved(const run *r)
{
    if (!r->host->shelf || r->job->resume.image || gouge_is_gauged(r->job->c)) return NULL;
    const shelved_scene *item = scene_shelf_find(r->host->shelf, r->job->twin);
    return item && goes_on_from(r, item) ? item : NULL;
}

/* ---- setting up ---- */

/* Snapshots stand at piece ends, the first at the start, the last at the end; the pieces are those of the case whether
 * anybody wants the snapshots or not. */
static void plan_pieces(run *r)
{
    const int n = r->job->c->output.snapshots;
    r->pieces = PIECES;
    if (n == 0) return;
    const int gaps = n > 1 ? n - 1 : 1, per_gap = (PIECES + gaps - 1) / gaps;
    r->pieces = gaps * per_gap;
    if (r->host->dir || r->host->sink) r->per_snapshot = per_gap;
}

static status open_snapshots(run *r, double reached)
{
    char dir[OUTDIR_PATH_SIZE];
    if (!r->per_snapshot) return status_ok();
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
    const double reached =
        r->from.image ? r->from.time * (1.0 - 1e-9) : -1.0; /* what stands at that instant is redone */
    if (h->history) {
        TRY(output_history_scene(h->history, r->job->name, &r->series));
        TRY(output_history_rewind(h->history, r->series, reached));
    }
    return open_snapshots(r, r->job->resume.image ? reached : -1.0);
}

/* From the start, from where it was stopped, or from where the one to its gauge has ended; then its first snapshot, of
 * the start, is still to be written. */
static status take_up(run *r)
{
    const shelved_scene *shelved = find_shelved(r);
    if (shelved) {
        r->from = (scene_resume){ shelved->image, shelved->bytes, shelved->time, shelved->wall };
        if (r->host->history) TRY(output_history_import(r->host->history, r->job->name, shelved->rows));
    }
    TRY(open_output(r));
    if (shelved) TRY(write_snapshot(r));
    return r->from.image ? mpm_restore(r->m, r->from.image, r->from.bytes) : status_ok();
}

static status run_made(run *r, impact *out)
{
    armature_metal before;
    TRY(armature_now(r, &before));
    TRY(take_up(r));
    const mpm_report state = mpm_glance(r->m);
    r->reached = state.time;
    if (r->host->progress)
        host_progress_task(r->host->progress, r->job->task, progress_of(r, &state), state.particle_steps);
    TRY(advance(r));
    TRY(finish(r, &before, out));
    const bool goes_on =
        r->host->shelf && r->job->twin && gouge_is_gauged(r->job->c) && out->result.groove_growth > 0.0;
    return goes_on && r->reached < r->piece_end ? shelve(r) : status_ok();
}

status scene_run(const scene_job *job, const scene_host *host, impact *out)
{
    run r = { .job = job, .host = host, .from = job->resume, .series = -1, .error = status_ok() };
    memset(out, 0, sizeof *out);
    r.started = r.looked = host_wall_clock();
    r.save_at = r.started + r.job->c->output.checkpoint_interval;
    plan_pieces(&r);
    status s = mpm_create(&job->scene, host->threads, &r.m);
    book(host, "scene making", r.started);
    if (s.code == STATUS_OK) s = run_made(&r, out);
    output_snapshots_close(r.shots);
    mpm_free(r.m);
    return s;
}
