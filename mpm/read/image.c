/* SPDX-License-Identifier: BSD-3-Clause */
/* Checkpoints and estimates.
 *
 * An image is a flat array of bytes: a header, the ledger, the reports of bodies and groups, then every brick in its
 * order with its chains of blocks in theirs, holes included.  A restored solver continues with the same bits. */
#include "mpm/memory/build.h"
#include "mpm/memory/cavities.h"
#include "mpm/memory/store.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char MAGIC[8] = "BREECHC";

typedef struct {
    char magic[8];
    char instruction_set[16];
    uint64_t scene, bytes;
    double time, dt, dt_last, dense_steps;
    uint64_t steps;
    int bricks, blocks, pages, finest;
} image_head;

typedef struct {
    int group, level, at[3], particles, has_out, fresh;
    uint64_t covered, reached;
    int still;
    double still_rate;
    int blocks[BRICK_CELLS];
} image_brick;

/* ---- writing ---- */

static size_t image_bytes(const mpm *m, int blocks)
{
    return sizeof(image_head) + sizeof(mpm_ledger) + sizeof(mpm_report) +
           (size_t)m->scene.bodies * sizeof *m->body_report + (size_t)m->groups * sizeof *m->force +
           (size_t)m->bricks_used * sizeof(image_brick) + (size_t)blocks * (sizeof(block) + sizeof(block_link)) +
           (size_t)m->grids.pages * (sizeof(grid_page) + PAGE_FLAGS) + mpm_cavities_bytes(m);
}

static char *put(char *to, const void *from, size_t bytes)
{
    memcpy(to, from, bytes);
    return to + bytes;
}

static char *put_brick(char *to, const mpm *m, const brick *b)
{
    image_brick head;
    memset(&head, 0, sizeof head);
    head.group = b->group, head.level = b->level, head.particles = b->particles, head.has_out = b->out != NULL,
    head.fresh = b->fresh, head.covered = b->covered, head.reached = b->reached;
    head.still = b->still, head.still_rate = b->still_rate;
    memcpy(head.at, b->at, sizeof head.at);
    for (int c = 0; c < BRICK_CELLS; c++)
        for (int q = b->head[c]; q >= 0; q = m->links[q].next) head.blocks[c]++;
    to = put(to, &head, sizeof head);
    for (int c = 0; c < BRICK_CELLS; c++)
        for (int q = b->head[c]; q >= 0; q = m->links[q].next) {
            to = put(to, &m->links[q], sizeof m->links[q]);
            to = put(to, &m->blocks[q], sizeof m->blocks[q]);
        }
    return to;
}

status mpm_save(const mpm *m, void **image, size_t *bytes)
{
    int blocks = 0;
    for (int i = 0; i < m->bricks_used; i++) blocks += m->bricks[i].blocks;
    *bytes = image_bytes(m, blocks);
    char *to = malloc(*bytes);
    *image = to;
    CHECK(to, STATUS_MEMORY, "no memory for a checkpoint of %.1f MB", 1e-6 * (double)*bytes);
    image_head head;
    memset(&head, 0, sizeof head);
    memcpy(head.magic, MAGIC, sizeof head.magic);
    strncpy(head.instruction_set, m->kernel->name, sizeof head.instruction_set - 1);
    head.scene = m->scene_key, head.bytes = *bytes;
    head.time = m->time, head.dt = m->dt, head.dt_last = m->dt_last, head.dense_steps = m->dense_steps,
    head.steps = m->steps;
    head.bricks = m->bricks_used, head.blocks = blocks, head.pages = m->grids.pages, head.finest = m->finest;
    to = put(to, &head, sizeof head);
    to = put(to, &m->ledger, sizeof m->ledger);
    to = put(to, &m->report, sizeof m->report);
    to = put(to, m->body_report, (size_t)m->scene.bodies * sizeof *m->body_report);
    to = put(to, m->force, (size_t)m->groups * sizeof *m->force);
    to = put(to, m->grids.page, (size_t)m->grids.pages * sizeof(grid_page));
    to = put(to, m->grids.active, (size_t)grids_flags(&m->grids));
    for (int i = 0; i < m->bricks_used; i++) to = put_brick(to, m, &m->bricks[i]);
    mpm_cavities_put(m, to);
    return status_ok();
}

/* ---- reading ---- */

typedef struct {
    const char *at, *end;
} reader;

static bool get(reader *r, void *to, size_t bytes)
{
    if ((size_t)(r->end - r->at) < bytes) return false;
    memcpy(to, r->at, bytes);
    r->at += bytes;
    return true;
}

static status cut_short(void)
{
    return base_status_error(STATUS_IO, "the checkpoint is cut short or damaged");
}

static status get_cell(mpm *m, brick *b, int cell, int blocks, reader *r)
{
    int *link = &b->head[cell];
    for (int i = 0; i < blocks; i++) {
        const int q = m->free_head;
        CHECK(q >= 0, STATUS_IO, "the checkpoint holds more points than it says");
        m->free_head = m->links[q].next;
        m->blocks_free--;
        if (!get(r, &m->links[q], sizeof m->links[q]) || !get(r, &m->blocks[q], sizeof m->blocks[q]))
            return cut_short();
        CHECK(m->links[q].body < m->scene.bodies, STATUS_IO, "the checkpoint names a body that the scene lacks");
        m->links[q].next = -1;
        *link = q;
        link = &m->links[q].next;
        b->blocks++;
    }
    return status_ok();
}

static status get_brick(mpm *m, reader *r)
{
    image_brick head;
    int index;
    if (!get(r, &head, sizeof head)) return cut_short();
    CHECK(head.level >= 0 && head.level < m->grids.levels, STATUS_IO,
          "the checkpoint holds a level that the scene lacks");
    for (int k = 0; k < 3; k++)
        CHECK(head.at[k] >= 0 && head.at[k] < m->grids.level[head.level].axes[k].bricks, STATUS_IO,
              "the checkpoint holds a place outside the window");
    CHECK(head.group >= 0 && head.group < m->groups, STATUS_IO, "the checkpoint holds a group that the scene lacks");
    TRY(mpm_store_brick(m, head.group, head.level, head.at, &index));
    brick *b = &m->bricks[index];
    b->particles = head.particles, b->fresh = head.fresh;
    b->covered = head.covered, b->reached = head.reached;
    if (head.has_out) TRY(mpm_store_open(b));
    for (int c = 0; c < BRICK_CELLS; c++) TRY(get_cell(m, b, c, head.blocks[c], r));
    b->still = head.still, b->still_rate = head.still_rate;
    b->occupied = mpm_occupied_cells(b);
    return status_ok();
}

static status get_pages(mpm *m, const image_head *h, reader *r)
{
    const size_t bytes = (size_t)h->pages * sizeof(grid_page);
    if (h->pages < 0 || bytes > (size_t)(r->end - r->at)) return cut_short();
    grid_page *page = malloc(bytes + 1);
    CHECK(page, STATUS_MEMORY, "no memory for %d pages of the grid", h->pages);
    const bool whole = get(r, page, bytes);
    const status s = whole ? mpm_grids_take_pages(&m->grids, page, h->pages) : cut_short();
    free(page);
    TRY(s);
    return get(r, m->grids.active, (size_t)grids_flags(&m->grids)) ? status_ok() : cut_short();
}

static status check_head(const mpm *m, const image_head *h, size_t bytes)
{
    CHECK(memcmp(h->magic, MAGIC, sizeof MAGIC) == 0, STATUS_IO, "this is no checkpoint of this version");
    CHECK(strncmp(h->instruction_set, m->kernel->name, sizeof h->instruction_set) == 0, STATUS_IO,
          "the checkpoint was written with instruction set %.16s, this run uses %s: results would differ in last bits; "
          "pin the set or start anew",
          h->instruction_set, m->kernel->name);
    CHECK(h->scene == m->scene_key, STATUS_IO, "the checkpoint belongs to another scene");
    CHECK(h->bytes == bytes, STATUS_IO, "the checkpoint has %zu bytes, it says %llu: cut short", bytes,
          (unsigned long long)h->bytes);
    CHECK(h->finest >= 0 && h->finest < m->grids.levels, STATUS_IO,
          "the checkpoint asks for a level that the scene lacks");
    return status_ok();
}

status mpm_restore(mpm *m, const void *image, size_t bytes)
{
    reader r = { image, (const char *)image + bytes };
    image_head head;
    if (!get(&r, &head, sizeof head)) return cut_short();
    TRY(check_head(m, &head, bytes));
    TRY(mpm_store_empty(m, head.blocks));
    if (!get(&r, &m->ledger, sizeof m->ledger) || !get(&r, &m->report, sizeof m->report) ||
        !get(&r, m->body_report, (size_t)m->scene.bodies * sizeof *m->body_report) ||
        !get(&r, m->force, (size_t)m->groups * sizeof *m->force))
        return cut_short();
    TRY(get_pages(m, &head, &r));
    for (int i = 0; i < head.bricks; i++) TRY(get_brick(m, &r));
    m->time = head.time, m->dt = head.dt, m->dt_last = head.dt_last, m->dense_steps = head.dense_steps,
    m->steps = head.steps, m->finest = head.finest;
    if ((size_t)(r.end - r.at) < mpm_cavities_bytes(m)) return cut_short();
    mpm_cavities_get(m, r.at);
    TRY(mpm_store_relink(m));
    return mpm_store_reserve(m, 0);
}

/* ---- estimate ---- */

typedef struct {
    const grids *grids;
    double particles, work;
    int empty; /* first body without a point, -1: none */
} counting;

static status count_point(void *user, int body, const build_point *p)
{
    (void)body;
    counting *c = user;
    c->particles++;
    c->work += 1.0 / (1 << mpm_grids_level(c->grids, p->x));
    return status_ok();
}

/* A large body's points are counted in a sample of its boxes. */
static status count_body(const mpm_scene *s, int body, const law *k, counting *c)
{
    static const double MOST = 1e4; /* boxes: a hundredth of a second's work */
    counting own = { .grids = c->grids };
    const build_sink sink = { count_point, &own };
    double share;
    TRY(mpm_build_sample(s, body, k, c->grids, MOST, &sink, &share));
    if (own.particles == 0 && share < 1) {
        TRY(mpm_build_body(s, body, k, c->grids, &mpm_build_everywhere, &sink));
        share = 1;
    }
    if (own.particles == 0 && c->empty < 0) c->empty = body;
    c->particles += own.particles / share;
    c->work += own.work / share;
    return status_ok();
}

static status count(const mpm_scene *s, const grids *g, counting *c, double *dt)
{
    double fastest = 0;
    *c = (counting){ .grids = g, .empty = -1 };
    for (int i = 0; i < s->bodies; i++) {
        law k;
        TRY(mpm_law_make(&s->body[i], s, &k));
        TRY(count_body(s, i, &k, c));
        const double sound = mpm_law_start_sound(&k);
        const double spin = mpm_build_spin_speed(s, i);
        for (int q = 0; q < 3; q++)
            fastest = fmax(fastest, (sound + fabs(s->body[i].velocity[q]) + spin) / g->level[0].axes[q].smallest);
    }
    *dt = s->courant / fastest;
    return status_ok();
}

/* Small cells that a rule asks for around a body at all times. */
typedef struct {
    const mpm_scene *s;
    const grids *at_start;
    grids *refined;
    int level;
    double reach; /* [m] */
    int buffer;   /* cells */
} asking;

static status ask_point(void *user, int body, const build_point *p)
{
    (void)body;
    const asking *a = user;
    const axis *axes = a->at_start->level[mpm_grids_level(a->at_start, p->x)].axes;
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        const double *edge = &axes[k].edge[mpm_axis_locate(&axes[k], p->x[k])];
        const double more = a->reach + a->buffer * a->s->axis[k].fine * (1 << a->level);
        lo[k] = edge[0] - more, hi[k] = edge[1] + more;
    }
    return mpm_grids_activate(a->refined, a->level, lo, hi);
}

static status ask_rules(const mpm_scene *s, const grids *at_start, grids *refined)
{
    for (int i = 0; i < s->refines && s->levels > 1; i++) {
        const mpm_refine *r = &s->refine[i];
        asking a = { .s = s, .at_start = at_start, .refined = refined, .buffer = r->kind->buffer };
        if (!r->kind->reach) continue;
        a.reach = r->kind->reach(r), a.level = mpm_grids_level_for(s, r->cell);
        const build_sink sink = { ask_point, &a };
        for (int body = 0; body < s->bodies; body++) {
            law k;
            if (r->body >= 0 && body != r->body) continue;
            TRY(mpm_law_make(&s->body[body], s, &k));
            TRY(mpm_build_body(s, body, &k, at_start, &mpm_build_everywhere, &sink));
        }
    }
    return mpm_grids_nest(refined);
}

static status refine(const mpm_scene *s, grids *g)
{
    grids at_start;
    TRY(mpm_grids_make(s, &at_start));
    const status asked = ask_rules(s, &at_start, g);
    mpm_grids_free(&at_start);
    return asked;
}

status mpm_estimate(const mpm_scene *scene, mpm_needs *needs)
{
    grids g;
    counting c;
    mpm_scene whole = *scene; /* borrows its arrays */
    mpm_scene_levels_fill(&whole);
    TRY(mpm_grids_make(&whole, &g));
    status s = refine(&whole, &g);
    if (s.code == STATUS_OK) s = count(&whole, &g, &c, &needs->dt);
    mpm_grids_free(&g);
    TRY(s);
    needs->particles = (size_t)(c.particles + 0.5), needs->work = c.work, needs->empty = c.empty;
    needs->bytes = MPM_BYTES + needs->particles * MPM_BYTES_A_PARTICLE + (size_t)scene->bodies * MPM_BYTES_A_BODY;
    return status_ok();
}
