/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/memory/cavities.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { EMPTY, COVERED, WALL }; /* of a cell: by no intact point, by some, by some of a wall */

static int cells_of(const struct mpm_cavities *c)
{
    return c->size[0] * c->size[1] * c->size[2];
}

static int place_of(const struct mpm_cavities *c, const int at[3])
{
    return (at[2] * c->size[1] + at[1]) * c->size[0] + at[0];
}

static void at_of(const struct mpm_cavities *c, int place, int at[3])
{
    at[0] = place % c->size[0], at[1] = place / c->size[0] % c->size[1], at[2] = place / (c->size[0] * c->size[1]);
}

static const axis *axes(const mpm *m)
{
    return m->grids.level[0].axes;
}

/* A cell of the window? */
static bool inside(const mpm *m, const int at[3])
{
    for (int k = 0; k < 3; k++)
        if (at[k] < 1 || at[k] > axes(m)[k].last) return false;
    return true;
}

/* At an end of the window that is no mirror? */
static bool at_end(const mpm *m, const int at[3])
{
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++)
            if (at[k] == (side ? axes(m)[k].last : 1) && m->scene.axis[k].boundary[side] != MPM_BOUNDARY_SYMMETRY)
                return true;
    return false;
}

static bool is_wall(const mpm *m, int body)
{
    for (int k = 0; k < m->cavities->n; k++)
        if (m->scene.cavity[k].wall == body) return true;
    return false;
}

/* ---- what covers the cells ---- */

static void cover_point(mpm *m, const block *q, int lane, bool wall)
{
    static const double WITHIN = 0.999; /* of the domain: one that ends at a cell's face does not cover the next */
    struct mpm_cavities *c = m->cavities;
    int lo[3], hi[3], at[3];
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes(m)[k];
        const double x = q->x[k][lane], half = WITHIN * q->half[k][lane];
        at[k] = mpm_axis_locate(a, x), lo[k] = mpm_axis_locate(a, x - half), hi[k] = mpm_axis_locate(a, x + half);
    }
    c->matter[place_of(c, at)] += q->mass[0][lane] / q->rho[0][lane];
    if (q->damage[0][lane] >= 1) return;
    for (at[2] = lo[2]; at[2] <= hi[2]; at[2]++)
        for (at[1] = lo[1]; at[1] <= hi[1]; at[1]++)
            for (at[0] = lo[0]; at[0] <= hi[0]; at[0]++) {
                uint8_t *cover = &c->cover[place_of(c, at)];
                *cover = wall || *cover == WALL ? WALL : COVERED;
            }
}

/* In the order of bricks, cells and chains, by one thread: the sums have the same bits on any number of them. */
static void cover(mpm *m)
{
    memset(m->cavities->cover, EMPTY, (size_t)cells_of(m->cavities));
    memset(m->cavities->matter, 0, (size_t)cells_of(m->cavities) * sizeof *m->cavities->matter);
    for (int i = 0; i < m->bricks_used; i++)
        for (int cell = 0; cell < BRICK_CELLS; cell++)
            for (int q = m->bricks[i].head[cell]; q >= 0; q = m->links[q].next) {
                const bool wall = is_wall(m, m->links[q].body);
                for (int l = 0; l < LANES; l++)
                    if (m->blocks[q].mass[0][l] > 0) cover_point(m, &m->blocks[q], l, wall);
            }
}

/* ---- floods ---- */

enum { SEEN = 0x20 }; /* in the map, while a flood lasts */

/* Through cells covered less than `most`, from the first n of the queue; how many it reaches, all in the queue then.
 * *out: has it come to an end of the window? */
static int flood(mpm *m, int n, int most, bool *out)
{
    struct mpm_cavities *c = m->cavities;
    *out = false;
    for (int i = 0; i < n; i++) c->map[c->queue[i]] |= SEEN;
    for (int i = 0; i < n; i++) {
        int at[3];
        at_of(c, c->queue[i], at);
        *out = *out || at_end(m, at);
        for (int k = 0; k < 6; k++) {
            int to[3] = { at[0], at[1], at[2] };
            to[k / 2] += k % 2 ? 1 : -1;
            const int place = inside(m, to) ? place_of(c, to) : -1;
            if (place < 0 || c->cover[place] >= most || c->map[place] & SEEN) continue;
            c->map[place] |= SEEN;
            c->queue[n++] = place;
        }
    }
    for (int i = 0; i < n; i++) c->map[c->queue[i]] &= (uint8_t)~SEEN;
    return n;
}

/* Cells that a cavity had and that are still empty into the queue; their number. */
static int seeds(struct mpm_cavities *c, int cavity)
{
    int n = 0;
    for (int i = 0; i < cells_of(c); i++)
        if (c->map[i] & CAVITY_VOID && (c->map[i] & CAVITY_OF) == cavity + 1 && c->cover[i] == EMPTY) c->queue[n++] = i;
    return n;
}

/* The gas of one goes to another that it meets, with all that has joined it; a burst one goes on venting there. */
static void join(struct mpm_cavities *c, int gone, int to)
{
    mpm_cavity_state *a = &c->state[gone], *b = &c->state[to];
    b->moles += a->moles, b->volume += a->volume, b->lost += a->lost;
    b->burst_time = fmin(b->burst_time, a->burst_time), b->open_hole += a->open_hole; /* NAN: the other's */
    a->moles = a->volume = a->pressure = a->open_hole = 0, a->joined = to;
    for (int k = 0; k < c->n; k++)
        if (c->state[k].joined == gone) c->state[k].joined = to;
    for (int i = 0; i < cells_of(c); i++)
        if ((c->map[i] & CAVITY_OF) == gone + 1) c->map[i] = (uint8_t)((c->map[i] & ~CAVITY_OF) | (to + 1));
}

/* The cavity's cells anew.  One that nothing is left of keeps those it had. */
static void find_void(mpm *m, int cavity)
{
    struct mpm_cavities *c = m->cavities;
    int n = seeds(c, cavity);
    if (n == 0) return;
    n = flood(m, n, COVERED, &c->state[cavity].open);
    for (int i = 0; i < n; i++) {
        const int other = (c->map[c->queue[i]] & CAVITY_OF) - 1;
        if (c->map[c->queue[i]] & CAVITY_VOID && other >= 0 && other != cavity) join(c, other, cavity);
    }
    for (int i = 0; i < cells_of(c); i++)
        if ((c->map[i] & CAVITY_OF) == cavity + 1) c->map[i] = 0;
    for (int i = 0; i < n; i++) c->map[c->queue[i]] = (uint8_t)(CAVITY_VOID | (cavity + 1));
}

/* Of the cavity and those that have joined it the first that has a wall; NULL: none has. */
static const mpm_cavity *walled(const mpm *m, int cavity)
{
    if (m->scene.cavity[cavity].wall >= 0) return &m->scene.cavity[cavity];
    for (int k = 0; k < m->cavities->n; k++)
        if (m->cavities->state[k].joined == cavity && m->scene.cavity[k].wall >= 0) return &m->scene.cavity[k];
    return NULL;
}

static void look_for_burst(mpm *m, int cavity)
{
    mpm_cavity_state *s = &m->cavities->state[cavity];
    const mpm_cavity *is = walled(m, cavity);
    bool out;
    if (!is || !isnan(s->burst_time)) return;
    flood(m, seeds(m->cavities, cavity), WALL, &out);
    if (out) s->burst_time = m->time, s->open_hole = is->hole;
}

/* ---- the nodes about it ---- */

/* `bits` into the map of cells without any of `mask` that lie within `reach` of a cell whose map & of == is. */
static void spread(mpm *m, int of, int is, int reach, int mask, int bits)
{
    struct mpm_cavities *c = m->cavities;
    for (int i = 0; i < cells_of(c); i++) {
        int at[3], to[3];
        if ((c->map[i] & of) != is) continue;
        at_of(c, i, at);
        for (int k = 0; k < 3; k++) to[k] = at[k] - reach;
        for (to[2] = at[2] - reach; to[2] <= at[2] + reach; to[2]++)
            for (to[1] = at[1] - reach; to[1] <= at[1] + reach; to[1]++)
                for (to[0] = at[0] - reach; to[0] <= at[0] + reach; to[0]++)
                    if (inside(m, to) && !(c->map[place_of(c, to)] & mask)) c->map[place_of(c, to)] |= (uint8_t)bits;
    }
}

/* The volume that its cells and those about them have beside their points. */
static double found_volume(const mpm *m, int cavity)
{
    const struct mpm_cavities *c = m->cavities;
    double sum = 0;
    for (int i = 0; i < cells_of(c); i++) {
        int at[3];
        double volume = 1;
        if ((c->map[i] & CAVITY_OF) != cavity + 1) continue;
        at_of(c, i, at);
        for (int k = 0; k < 3; k++) {
            const axis *a = &axes(m)[k];
            volume *= fmin(a->edge[at[k] + 1], a->node[a->last]) - fmax(a->edge[at[k]], a->node[1]);
        }
        sum += volume - c->matter[i];
    }
    return sum;
}

void mpm_cavities_look(mpm *m)
{
    struct mpm_cavities *c = m->cavities;
    if (!c) return;
    cover(m);
    for (int i = 0; i < cells_of(c); i++)
        c->map[i] = c->map[i] & CAVITY_VOID ? c->map[i] & (CAVITY_VOID | CAVITY_OF) : 0;
    for (int k = 0; k < c->n; k++)
        if (c->state[k].joined < 0) find_void(m, k);
    for (int k = 0; k < c->n; k++)
        if (c->state[k].joined < 0) look_for_burst(m, k);
    for (int k = 0; k < c->n; k++)
        if (c->state[k].joined < 0) spread(m, CAVITY_VOID | CAVITY_OF, CAVITY_VOID | (k + 1), 2, CAVITY_OF, k + 1);
    for (int k = 0; k < c->n; k++) spread(m, CAVITY_OF, k + 1, 1, 0, CAVITY_REACHES);
    for (int k = 0; k < c->n; k++) c->state[k].found = found_volume(m, k);
}

/* ---- gas ---- */

/* (G-6).  Beyond the turn of its isotherm the equation of state means nothing: its pressure falls below zero, and rises
 * without limit towards b. */
static status set_pressure(const mpm *m, int cavity)
{
    mpm_cavity_state *s = &m->cavities->state[cavity];
    const mpm_cavity *is = &m->scene.cavity[cavity];
    const mpm_gas *g = &m->cavities->gas[cavity];
    s->pressure = 0;
    if (!(s->moles > 0) || s->joined >= 0 || s->open) return status_ok();
    CHECK(s->volume > s->moles * g->least, STATUS_NUMERICAL,
          "t = %g s: cavity `%s`: %g mol of gas at %g K in %g m3: a vapour needs more than %g m3, and no liquid is "
          "computed: end the scene before, feed or squeeze less, or give a temperature above critical_temperature",
          m->time, is->name, s->moles, is->temperature, s->volume, s->moles * g->least);
    s->pressure = mpm_gas_pressure(g, s->volume / s->moles) - is->ambient;
    return status_ok();
}

/* What a step's feed brings, or takes out where it is negative. */
static status feed(mpm *m, int cavity)
{
    mpm_cavity_state *s = &m->cavities->state[cavity];
    const mpm_cavity *is = &m->scene.cavity[cavity];
    if (s->joined >= 0) s = &m->cavities->state[s->joined];
    s->moles += m->dt * is->feed;
    CHECK(
        is->feed >= 0 || s->moles > 0, STATUS_NUMERICAL,
        "t = %g s: cavity `%s` has no gas left: its feed = %g mol/s has taken out all of it; end the scene before, or "
        "take out less",
        m->time, is->name, is->feed);
    return status_ok();
}

status mpm_cavities_step(mpm *m)
{
    struct mpm_cavities *c = m->cavities;
    for (int k = 0; c && k < c->n; k++) {
        mpm_cavity_state *s = &c->state[k];
        const mpm_cavity *is = &m->scene.cavity[k];
        double swept = 0;
        for (int i = 0; i < m->site_count; i++) swept += c->swept[m->site_list[i] * c->n + k];
        m->ledger.work_external += s->pressure * swept;
        s->volume += swept;
        TRY(feed(m, k));
        if (s->open_hole > 0) {
            const mpm_orifice hole = { s->open_hole, is->discharge, is->gas_gamma, is->molar_mass };
            const double flow = mpm_gas_flow(&hole, is->temperature, s->pressure + is->ambient, is->ambient);
            const double lost = fmin(m->dt * flow, 0.5 * s->moles);
            s->moles -= lost, s->lost += lost;
        }
    }
    for (int k = 0; c && k < c->n; k++) TRY(set_pressure(m, k));
    return status_ok();
}

const mpm_cavity_state *mpm_cavity_of(const mpm *m, int cavity)
{
    return &m->cavities->state[cavity];
}

/* ---- memory ---- */

static status allocate(mpm *m)
{
    struct mpm_cavities *c = m->cavities = calloc(1, sizeof *c);
    CHECK(c, STATUS_MEMORY, "no memory for cavities");
    c->n = m->scene.cavities;
    double all = 1;
    for (int k = 0; k < 3; k++) all *= c->size[k] = axes(m)[k].last + 2;
    m->refused = (mpm_refused){ MPM_PART_SCENE, 0, "cavities" };
    CHECK(all <= INT_MAX, STATUS_BAD_INPUT,
          "%.3g cells: a scene with cavities has at most %d, so give it larger ones or a smaller window", all, INT_MAX);
    const size_t cells = (size_t)cells_of(c), n = (size_t)c->n;
    c->state = calloc(n, sizeof *c->state), c->gas = calloc(n, sizeof *c->gas);
    c->map = calloc(cells, 1), c->cover = calloc(cells, 1);
    c->queue = malloc(cells * sizeof *c->queue), c->matter = calloc(cells, sizeof *c->matter);
    CHECK(c->state && c->gas && c->map && c->cover && c->queue && c->matter, STATUS_MEMORY, "no memory for cavities");
    return status_ok();
}

/* The cell at its place, from which the first flood begins. */
static status begin(mpm *m, int cavity)
{
    struct mpm_cavities *c = m->cavities;
    const mpm_cavity *is = &m->scene.cavity[cavity];
    int at[3];
    m->refused = (mpm_refused){ MPM_PART_CAVITY, cavity, "place" };
    for (int k = 0; k < 3; k++) at[k] = mpm_axis_locate(&axes(m)[k], is->place[k]);
    CHECK(inside(m, at) && c->cover[place_of(c, at)] == EMPTY, STATUS_BAD_INPUT,
          "cavity `%s`: there is no void at (%g, %g, %g) m, or no whole cell of it", is->name, is->place[0],
          is->place[1], is->place[2]);
    CHECK((c->map[place_of(c, at)] & CAVITY_OF) == 0, STATUS_BAD_INPUT, "cavity `%s` is part of `%s`", is->name,
          m->scene.cavity[(c->map[place_of(c, at)] & CAVITY_OF) - 1].name);
    c->map[place_of(c, at)] = (uint8_t)(CAVITY_VOID | (cavity + 1));
    c->gas[cavity] = mpm_gas_make(is->temperature, is->critical_temperature, is->critical_pressure);
    c->state[cavity] = (mpm_cavity_state){ .burst_time = NAN, .joined = -1 };
    find_void(m, cavity);
    CHECK(!c->state[cavity].open, STATUS_BAD_INPUT,
          "cavity `%s` is open: its void, from (%g, %g, %g) m, comes to an end of the window that is no mirror",
          is->name, is->place[0], is->place[1], is->place[2]);
    return status_ok();
}

status mpm_cavities_make(mpm *m)
{
    if (m->scene.cavities == 0) return status_ok();
    TRY(allocate(m));
    struct mpm_cavities *c = m->cavities;
    cover(m);
    for (int k = 0; k < c->n; k++) TRY(begin(m, k));
    mpm_cavities_look(m);
    for (int k = 0; k < c->n; k++) {
        const mpm_cavity *is = &m->scene.cavity[k];
        mpm_cavity_state *s = &c->state[k];
        s->volume = s->found;
        s->moles = s->volume / mpm_gas_molar_volume(&c->gas[k], is->pressure + is->ambient);
        m->refused = (mpm_refused){ MPM_PART_CAVITY, k, "pressure" };
        CHECK(isfinite(s->moles) && s->moles > 0, STATUS_BAD_INPUT,
              "cavity `%s`: %g mol of gas in %g m3: its void is no larger than the points about it, or its gas has no "
              "pressure of %g Pa at %g K",
              is->name, s->moles, s->volume, is->pressure + is->ambient, is->temperature);
        TRY(set_pressure(m, k));
    }
    return status_ok();
}

void mpm_cavities_free(mpm *m)
{
    struct mpm_cavities *c = m->cavities;
    if (!c) return;
    free(c->state), free(c->gas), free(c->map), free(c->cover), free(c->queue), free(c->matter), free(c->swept);
    free(c);
    m->cavities = NULL;
}

status mpm_cavities_reserve(mpm *m)
{
    struct mpm_cavities *c = m->cavities;
    if (!c || c->places >= m->places) return status_ok();
    free(c->swept);
    c->swept = calloc((size_t)m->places * (size_t)c->n, sizeof *c->swept);
    c->places = c->swept ? m->places : 0;
    CHECK(c->swept, STATUS_MEMORY, "no memory for the volumes of %d cavities", c->n);
    return status_ok();
}

/* ---- checkpoints ---- */

size_t mpm_cavities_bytes(const mpm *m)
{
    const struct mpm_cavities *c = m->cavities;
    return c ? (size_t)c->n * sizeof *c->state + (size_t)cells_of(c) : 0;
}

void mpm_cavities_put(const mpm *m, char *to)
{
    const struct mpm_cavities *c = m->cavities;
    if (!c) return;
    memcpy(to, c->state, (size_t)c->n * sizeof *c->state), to += (size_t)c->n * sizeof *c->state;
    memcpy(to, c->map, (size_t)cells_of(c));
}

void mpm_cavities_get(mpm *m, const char *from)
{
    struct mpm_cavities *c = m->cavities;
    if (!c) return;
    memcpy(c->state, from, (size_t)c->n * sizeof *c->state), from += (size_t)c->n * sizeof *c->state;
    memcpy(c->map, from, (size_t)cells_of(c));
}
