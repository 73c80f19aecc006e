/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/crew.h"
#include "coupling/run/crew_messages.h"
#include "coupling/run/ranks.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>

status run_crew_say(int to, int kind, const void *head, size_t head_bytes, const void *body, size_t body_bytes)
{
    char *all = malloc(head_bytes + body_bytes + 1);
    CHECK(all, STATUS_MEMORY, "no memory for a message of %zu bytes", head_bytes + body_bytes);
    memcpy(all, head, head_bytes);
    if (body_bytes) memcpy(all + head_bytes, body, body_bytes);
    const status said = run_ranks_send(to, kind, all, head_bytes + body_bytes);
    free(all);
    return said;
}

typedef struct member member;

/* A scene under way; those below the top are put off until it is done. */
typedef struct work {
    member *me;
    uint64_t key;
    bool give_up;
    struct work *put_off;
} work;

struct member {
    int threads;
    lending *lending;
    impact_runner run;
    work *top;
    scene_shelf shelf;
    bool over; /* nothing more comes */
};

static bool listen(member *me);

/* Between two steps: a scene that comes now is computed here and now, and this one then goes on. */
static bool heard_stop(void *user)
{
    const work *w = user;
    while (listen(w->me)) continue;
    return w->give_up;
}

static int threads_now(void *user)
{
    const work *w = user;
    return run_lending_threads(w->me->lending);
}

static status send_file(void *user, const char *path, const void *data, size_t bytes)
{
    (void)user;
    return run_crew_say(0, SAY_FILE, path, strlen(path) + 1, data, bytes);
}

/* ---- one scene ---- */

static status compute(work *w, const scene_query *q, const scene_key *key, h5_file **file)
{
    scene_record r;
    history *rows;
    progress silent;
    host_progress_open(&silent, stderr, true);
    TRY(output_history_open(NULL, false, &rows));
    const scene_host host = { .sink = &(snapshot_sink){ send_file, NULL },
                              .history = rows,
                              .progress = &silent,
                              .shelf = &w->me->shelf,
                              .threads = w->me->threads,
                              .threads_now = w->me->lending ? threads_now : NULL,
                              .stop = heard_stop,
                              .user = w };
    const scene_work_how how = { .run = w->me->run, .task = q->name, .host = &host, .lending = w->me->lending };
    status done = run_scene_work(q, key->hash, &how, &r);
    if (done.code == STATUS_OK) done = run_scene_file_make(&r, key, rows, file);
    output_history_close(rows);
    return done;
}

static status check_key(const scene_order *order, const scene_key *key)
{
    CHECK(
        key->hash == order->key, STATUS_BAD_INPUT,
        "rank %d would compute another scene than rank 0 asks for (solver %s, instruction set %s): all processes must "
        "run the same build with the same instruction set",
        run_ranks_number(), run_solver_id(), mpm_instruction_set());
    return status_ok();
}

static status compute_case(work *w, const scene_order *order, const case_inputs *in, h5_file **file)
{
    scene_query q = { .impact = in->onset.impact };
    scene_key key = { .text = NULL };
    if (in->given.bodies) q.bodies = case_body_scene_of(in);
    snprintf(q.name, sizeof q.name, "%s", order->name);
    status done = run_scene_query_key(&q, &key);
    if (done.code == STATUS_OK) done = check_key(order, &key);
    if (done.code == STATUS_OK) done = compute(w, &q, &key, file);
    run_scene_key_free(&key);
    return done;
}

static status answer(const member *me, uint64_t key, status done, h5_file *file)
{
    scene_answer head = { .key = key };
    const void *image;
    size_t bytes;
    for (int i = 0; i < SCENE_SHELF_ROOM; i++) head.shelf[i] = me->shelf.item[i].twin;
    if (done.code != STATUS_OK) return run_crew_say(0, SAY_FAILED, &head, sizeof head, &done, sizeof done);
    TRY(host_h5_image(file, &image, &bytes));
    return run_crew_say(0, SAY_DONE, &head, sizeof head, image, bytes);
}

static status take_order(member *me, const message *m)
{
    scene_order order;
    case_inputs *in = NULL;
    char *errors = NULL;
    h5_file *file = NULL;
    memcpy(&order, m->data, sizeof order);
    work w = { .me = me, .key = order.key, .put_off = me->top };
    me->top = &w;
    const case_text text = { .bytes = m->data + sizeof order,
                             .length = m->bytes - sizeof order,
                             .path = "rank 0's case" };
    status done = case_inputs_read_memory(&text, &(case_options){ .needs = CASE_FOR_SCENE }, &in, &errors);
    if (done.code == STATUS_OK) done = compute_case(&w, &order, in, &file);
    me->top = w.put_off;
    done = answer(me, order.key, done, file);
    host_h5_close(file);
    case_inputs_free(in);
    free(errors);
    return done;
}

/* key NULL: all */
static void give_up(member *me, const char *key)
{
    for (work *w = me->top; w; w = w->put_off)
        w->give_up = w->give_up || !key || memcmp(key, &w->key, sizeof w->key) == 0;
}

/* One message, if there is one. */
static bool listen(member *me)
{
    message m;
    bool any = false;
    status done = run_ranks_receive(&m, &any);
    if (any && m.kind == SAY_SCENE && !me->over) done = take_order(me, &m);
    if (any && m.kind == SAY_DROP) give_up(me, m.data);
    if (any && (m.kind == SAY_STOP || m.kind == SAY_END)) give_up(me, NULL);
    me->over = me->over || (any && m.kind == SAY_END);
    if (done.code != STATUS_OK) fprintf(stderr, "breech, rank %d: %s\n", run_ranks_number(), done.text);
    run_message_free(&m);
    return any;
}

void run_crew_serve(int threads, lending *l, impact_runner run)
{
    member me = { .threads = threads, .lending = l, .run = run };
    signal(SIGINT, SIG_IGN); /* rank 0 hears them and says what to do */
    signal(SIGTERM, SIG_IGN);
    while (!me.over)
        if (!listen(&me)) run_ranks_pause();
    scene_shelf_clear(&me.shelf);
    run_ranks_send(0, SAY_END, "", 0);
}

void run_crew_dismiss(void)
{
    int left = run_ranks_count() - 1;
    for (int to = 1; to <= left; to++) run_ranks_send(to, SAY_END, "", 0);
    while (left > 0) {
        message m;
        bool any = false;
        run_ranks_receive(&m, &any);
        if (!any) run_ranks_pause();
        left -= any && m.kind == SAY_END;
        run_message_free(&m);
    }
}
