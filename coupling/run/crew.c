/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/crew.h"

#include "coupling/run/crew_messages.h"
#include "coupling/run/ranks.h"

#include <stdlib.h>
#include <string.h>

typedef enum { WAITING, AWAY, HERE, FINISHED } place;

/* A scene that is waiting, being computed or finished. */
typedef struct errand {
    scene_query query;
    scene_key key;
    uint64_t twin; /* of a whole scene, else 0 */
    place where;
    bool wanted;            /* by the call under way; else it may be wanted */
    bool ahead;             /* still in the list of those that may be */
    int order;              /* in the list it came up in last */
    int member;             /* AWAY: who has it */
    bool dropped;           /* AWAY: that one was told to give it up */
    struct errand *put_off; /* AWAY: by the member that has it, for this one */
    h5_file *file;          /* FINISHED and not failed */
    status failed;          /* FINISHED: STATUS_OK if not */
    status stored;          /* FINISHED: why the store has not taken it */
    history *rows;          /* of rank 0's own scenes */
    void *image;            /* laid aside by rank 0, to go on from; owned */
    scene_resume at;        /* image, when there is one */
    bool saved;             /* the checkpoint goes on from it; one errand at most */
} errand;

struct crew {
    session *s;
    int members; /* ranks but rank 0 */
    errand *
        *busy; /* members + 1, by rank: what it computes, then what it has put off; NULL: idle; rank 0's is unused */
    scene_answer *told; /* members + 1, by rank: the last, for its shelf */
    int n;
    errand **errand; /* n, in the order they came up; owned, one by one */
    bool any_order;  /* wanted ones do not go before the others */
    bool aside;      /* rank 0's scene is being laid aside */
    status error;    /* met while rank 0's scene was stepping */
};

/* ---- the list ---- */

static errand *find(const crew *k, uint64_t key)
{
    for (int i = 0; i < k->n; i++)
        if (k->errand[i]->key.hash == key) return k->errand[i];
    return NULL;
}

static void errand_free(errand *e)
{
    run_scene_key_free(&e->key);
    host_h5_close(e->file);
    output_history_close(e->rows);
    free(e->image);
    free(e);
}

static void errand_unlist(crew *k, const errand *e)
{
    int kept = 0;
    for (int i = 0; i < k->n; i++)
        if (k->errand[i] != e) k->errand[kept++] = k->errand[i];
    k->n = kept;
}

static status add(crew *k, const scene_query *q, errand **out)
{
    errand *e = calloc(1, sizeof *e);
    errand **more = realloc(k->errand, ((size_t)k->n + 1) * sizeof *more);
    if (more) k->errand = more;
    if (!e || !more) {
        free(e);
        return base_status_error(STATUS_MEMORY, "no memory for %d scenes", k->n + 1);
    }
    e->query = *q;
    k->errand[k->n++] = e;
    *out = e;
    return status_ok();
}

static status find_or_add(crew *k, const scene_query *q, errand **out)
{
    scene_key key = { .text = NULL };
    status done = run_scene_query_key(q, &key);
    *out = find(k, key.hash);
    if (done.code == STATUS_OK && !*out) {
        uint64_t twin = 0;
        if (!case_impact_is_gauged(&q->impact)) done = run_scene_twin(q, &twin);
        if (done.code == STATUS_OK) done = add(k, q, out);
        if (done.code == STATUS_OK) {
            (*out)->key = key;
            (*out)->twin = twin;
            return done;
        }
    }
    run_scene_key_free(&key);
    return done;
}

/* The checkpoint holds this scene's image; NULL: none. */
static void mark_saved(crew *k, const errand *e)
{
    for (int i = 0; i < k->n; i++) k->errand[i]->saved = k->errand[i] == e;
}

/* Scenes that nobody asks for any more: those that wait are forgotten, members are told to drop those they compute. */
static status forget_idle(crew *k)
{
    for (int i = k->n - 1; i >= 0; i--) {
        errand *e = k->errand[i];
        if (e->wanted || e->ahead) continue;
        if (e->where == WAITING) {
            errand_unlist(k, e);
            errand_free(e);
        } else if (e->where == AWAY && !e->dropped) {
            e->dropped = true;
            TRY(run_crew_say(e->member, SAY_DROP, &e->key.hash, sizeof e->key.hash, NULL, 0));
        }
    }
    return status_ok();
}

/* ---- messages ---- */

static void errand_finish(crew *k, errand *e, h5_file *file)
{
    e->where = FINISHED;
    e->file = file;
    if (k->s->store[0]) e->stored = run_store_put(k->s->store, &e->key, file);
}

static status write_file(const crew *k, const message *m)
{
    char path[OUTDIR_PATH_SIZE], folder[OUTDIR_PATH_SIZE];
    const size_t name = strlen(m->data) + 1;
    TRY(host_outdir_file(&k->s->dir, m->data, path, sizeof path));
    snprintf(folder, sizeof folder, "%s", path);
    *strrchr(folder, '/') = '\0';
    TRY(host_folder_make(folder));
    return host_file_write(path, m->data + name, m->bytes - name);
}

/* Takes a scene off its member's stack.  It need not be the last one handed out: a message with an outcome and one with
 * a new scene may have crossed. */
static void remove_from_member(crew *k, errand *e)
{
    errand **at = &k->busy[e->member];
    while (*at != e) at = &(*at)->put_off;
    *at = e->put_off;
    e->put_off = NULL;
}

static status read_outcome(crew *k, const message *m)
{
    scene_answer *told = &k->told[m->from];
    memcpy(told, m->data, sizeof *told);
    errand *e = find(k, told->key);
    const char *body = m->data + sizeof *told;
    const size_t bytes = m->bytes - sizeof *told;
    if (!e || e->where != AWAY) return status_ok();
    remove_from_member(k, e);
    if (m->kind == SAY_FAILED && e->dropped) { /* unless it has been asked for again */
        e->where = WAITING;
        e->dropped = false;
        return status_ok();
    }
    if (m->kind == SAY_FAILED) {
        e->where = FINISHED;
        memcpy(&e->failed, body, sizeof e->failed);
        return status_ok();
    }
    h5_file *file;
    TRY(host_h5_open_image(e->query.name, body, bytes, &file));
    errand_finish(k, e, file);
    return status_ok();
}

static status read_messages(crew *k)
{
    for (;;) {
        message m;
        bool any;
        TRY(run_ranks_receive(&m, &any));
        if (!any) return status_ok();
        const status done = m.kind == SAY_FILE ? write_file(k, &m) : read_outcome(k, &m);
        run_message_free(&m);
        TRY(done);
    }
}

static bool resumable(const crew *k, const errand *e)
{
    return e->image || run_session_resume_of(k->s, e->query.name).image;
}

/* An idle member that has computed this scene up to its gauge and can continue it; 0: none, or rank 0 has begun it. */
static int idle_member_with_gauge(const crew *k, const errand *e)
{
    if (!e->twin || resumable(k, e)) return 0;
    for (int r = 1; r <= k->members; r++)
        for (int i = 0; i < SCENE_SHELF_ROOM; i++)
            if (!k->busy[r] && k->told[r].shelf[i] == e->twin) return r;
    return 0;
}

static bool begun_here(const crew *k, const errand *e)
{
    return resumable(k, e) || scene_shelf_find(&k->s->shelf, e->twin);
}

/* Should a be computed before b?  Wanted scenes come before those ahead; if any order is allowed, list order counts. */
static bool goes_first(const crew *k, const errand *a, const errand *b)
{
    return !b || (!k->any_order && a->wanted != b->wanted ? a->wanted : a->order < b->order);
}

/* The next scene for a member.  A scene that rank 0 has begun stays with rank 0. */
static errand *next_for_member(const crew *k)
{
    errand *best = NULL;
    for (int i = 0; i < k->n; i++) {
        errand *e = k->errand[i];
        if (e->where == WAITING && (e->wanted || e->ahead) && !resumable(k, e) && goes_first(k, e, best)) best = e;
    }
    return best;
}

/* The next scene for rank 0: wanted ones first, among equals those that it has begun.  Scenes that an idle member can
 * continue are left to that member. */
static errand *next_for_me(const crew *k)
{
    errand *best = NULL;
    for (int i = 0; i < k->n; i++) {
        errand *e = k->errand[i];
        if (e->where != WAITING || !(e->wanted || e->ahead) || idle_member_with_gauge(k, e)) continue;
        const bool sooner =
            best && (k->any_order || best->wanted == e->wanted) && begun_here(k, e) != begun_here(k, best)
                ? begun_here(k, e)
                : goes_first(k, e, best);
        if (sooner) best = e;
    }
    return best;
}

static int idle_member(const crew *k)
{
    for (int r = 1; r <= k->members; r++)
        if (!k->busy[r]) return r;
    return 0;
}

/* The member to compute this scene: an idle one, if possible one that has begun it.  For a wanted scene also one that
 * computes a scene nobody waits for, if it has put off none yet, as each scene put off keeps its memory.  0: nobody. */
static int member_for(const crew *k, const errand *e)
{
    const int idle = idle_member_with_gauge(k, e) ? idle_member_with_gauge(k, e) : idle_member(k);
    if (idle || !e->wanted || k->any_order) return idle;
    for (int r = 1; r <= k->members; r++)
        if (!k->busy[r]->wanted && !k->busy[r]->put_off) return r;
    return 0;
}

static status give(crew *k, errand *e, int member)
{
    scene_order order;
    memset(&order, 0, sizeof order);
    order.key = e->key.hash;
    snprintf(order.name, sizeof order.name, "%s", e->query.name);
    host_outdir_drop_scene(&k->s->dir, e->query.name); /* of a part that was stopped */
    TRY(run_crew_say(member, SAY_SCENE, &order, sizeof order, e->key.text, e->key.bytes));
    e->where = AWAY;
    e->member = member;
    e->put_off = k->busy[member];
    k->busy[member] = e;
    return status_ok();
}

static status hand_out(crew *k)
{
    for (;;) {
        errand *e = next_for_member(k);
        const int member = e ? member_for(k, e) : 0;
        if (!member) return status_ok();
        TRY(give(k, e, member));
    }
}

/* ---- rank 0's own scene ---- */

typedef struct {
    crew *k;
    errand *e;
} own_scene;

static bool wanted_is_finished(const crew *k)
{
    for (int i = 0; i < k->n; i++)
        if (k->errand[i]->wanted && k->errand[i]->where == FINISHED) return true;
    return false;
}

/* After every step of it. */
static bool stop_own(void *user)
{
    const own_scene *own = user;
    crew *k = own->k;
    if (k->error.code == STATUS_OK) k->error = read_messages(k);
    if (k->error.code == STATUS_OK) k->error = hand_out(k);
    if (k->error.code != STATUS_OK || (k->s->stop && k->s->stop())) return true;
    k->aside = wanted_is_finished(k) && ((!own->e->wanted && !k->any_order) || idle_member(k));
    return k->aside;
}

static int threads_now(void *user)
{
    const own_scene *own = user;
    return run_lending_threads(own->k->s->lending);
}

static status save_own(void *user, const char *scene, const scene_now *now)
{
    const own_scene *own = user;
    errand *e = own->e;
    if (!own->k->aside) {
        TRY(output_history_copy_scene(e->rows, scene, own->k->s->history));
        TRY(run_session_save_inside(own->k->s, scene, now));
        mark_saved(own->k, e);
        return status_ok();
    }
    free(e->image);
    e->image = NULL;
    size_t bytes;
    TRY(scene_image(now, &e->image, &bytes));
    e->at = (scene_resume){ e->image, bytes, mpm_glance(now->m).time, now->wall };
    return status_ok();
}

static status take_up_rows(crew *k, errand *e)
{
    if (e->rows) return status_ok();
    TRY(output_history_open(NULL, false, &e->rows));
    return e->at.image ? output_history_copy_scene(k->s->history, e->query.name, e->rows) : status_ok();
}

static status run_own(crew *k, errand *e)
{
    session *s = k->s;
    own_scene own = { k, e };
    char task[160];
    scene_record r;
    h5_file *file;
    const scene_host host = { .dir = &s->dir,
                              .history = e->rows,
                              .progress = &s->progress,
                              .timing = &s->timing,
                              .shelf = &s->shelf,
                              .threads = s->threads,
                              .threads_now = s->lending ? threads_now : NULL,
                              .stop = stop_own,
                              .save = save_own,
                              .user = &own };
    snprintf(task, sizeof task, "%s, %d of %d others at work", e->query.name, k->members - (idle_member(k) ? 1 : 0),
             k->members);
    const scene_work_how how = { s->run_scene, task, &host, s->lending, e->at };
    TRY(run_scene_work(&e->query, e->key.hash, &how, &r));
    TRY(run_scene_file_make(&r, &e->key, e->rows, &file));
    errand_finish(k, e, file);
    return status_ok();
}

static status compute_own(crew *k, errand *e)
{
    if (!e->image) e->at = run_session_resume_of(k->s, e->query.name);
    TRY(take_up_rows(k, e));
    e->where = HERE;
    k->aside = false;
    const status done = run_own(k, e);
    if (k->error.code != STATUS_OK) return k->error;
    if (e->where == FINISHED) return done;
    e->where = WAITING;
    if (done.code == STATUS_STOPPED) return k->aside ? status_ok() : done;
    e->where = FINISHED;
    e->failed = done;
    return status_ok();
}

/* ---- what the study calls ---- */

status run_crew_create(session *s, int side_by_side, crew **out)
{
    crew *k = calloc(1, sizeof *k);
    errand **busy = calloc((size_t)run_ranks_count(), sizeof *busy);
    scene_answer *told = calloc((size_t)run_ranks_count(), sizeof *told);
    *out = k;
    if (!k || !busy || !told) {
        free(k);
        free(busy);
        free(told);
        *out = NULL;
        return base_status_error(STATUS_MEMORY, "no memory for %d processes", run_ranks_count());
    }
    k->s = s;
    k->members = run_ranks_count() - 1;
    if (side_by_side > 0 && run_ranks_on_machine() == run_ranks_count() && side_by_side <= k->members)
        k->members = side_by_side - 1;
    k->busy = busy;
    k->told = told;
    k->error = status_ok();
    return status_ok();
}

/* Tells every computing member to give up and waits for its answer, so that the next crew finds all of them idle. */
static void stop_members(crew *k)
{
    int left = 0;
    for (int r = 1; r <= k->members; r++) {
        if (k->busy[r]) run_ranks_send(r, SAY_STOP, "", 0);
        for (const errand *e = k->busy[r]; e; e = e->put_off) left++;
    }
    while (left > 0) {
        message m;
        bool any = false;
        run_ranks_receive(&m, &any);
        if (!any) run_ranks_pause();
        left -= any && (m.kind == SAY_DONE || m.kind == SAY_FAILED);
        run_message_free(&m);
    }
}

/* Does a resumed run need the snapshots?  It goes on from the scene in the checkpoint, and takes from the store what
 * was finished when the run stopped. */
static bool is_resumed_with(const crew *k, const errand *e)
{
    return e->saved || (e->wanted && e->file && k->s->store[0]);
}

void run_crew_free(crew *k, bool finished)
{
    if (!k) return;
    stop_members(k);
    for (int i = 0; i < k->n; i++) {
        errand *e = k->errand[i];
        if (finished || !is_resumed_with(k, e)) host_outdir_drop_scene(&k->s->dir, e->query.name);
        errand_free(e);
    }
    free(k->errand);
    free(k->busy);
    free(k->told);
    free(k);
}

status run_crew_ahead(crew *k, const scene_query *query, int n, bool any_order)
{
    k->any_order = any_order;
    for (int i = 0; i < k->n; i++) k->errand[i]->ahead = false;
    for (int i = 0; i < n; i++) {
        errand *e;
        TRY(find_or_add(k, &query[i], &e));
        e->ahead = true;
        e->order = i;
    }
    return status_ok();
}

static status mark_wanted(crew *k, const scene_query *query, int n)
{
    for (int i = 0; i < k->n; i++) k->errand[i]->wanted = false;
    for (int i = 0; i < n; i++) {
        errand *e;
        TRY(find_or_add(k, &query[i], &e));
        if (!(k->any_order && e->ahead)) e->order = i;
        e->wanted = true;
    }
    return forget_idle(k);
}

status run_crew_some(crew *k, const scene_query *query, int n)
{
    TRY(mark_wanted(k, query, n));
    for (;;) {
        TRY(read_messages(k));
        errand *mine = wanted_is_finished(k) ? NULL : next_for_me(k);
        if (mine) mine->where = HERE;
        TRY(hand_out(k));
        if (wanted_is_finished(k)) return status_ok();
        if (k->s->stop && k->s->stop()) return base_status_error(STATUS_STOPPED, "stopped while others computed");
        if (mine)
            TRY(compute_own(k, mine));
        else
            run_ranks_pause();
    }
}

status run_crew_take(crew *k, const scene_key *key, h5_file **out)
{
    errand *e = find(k, key->hash);
    *out = NULL;
    if (!e || e->where != FINISHED) return status_ok();
    const status failed = e->failed, stored = e->stored;
    if (failed.code != STATUS_OK) return failed;
    *out = e->file;
    e->file = NULL;
    mark_saved(k, NULL); /* the caller writes the next checkpoint, between scenes */
    errand_unlist(k, e);
    errand_free(e);
    return stored;
}
