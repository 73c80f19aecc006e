/* SPDX-License-Identifier: BSD-3-Clause */
/* Points that have come into coarser cells than they need.  Two sound ones side by side become one where their cell
 * allows a point of that length and is deep: each of the six cells that share a face with it holds points of the group,
 * failed ones too.  In the other cells, those of a free surface and of the window's ends, points outlive the cells
 * that they came from, so a surface stays as sharp as it was made.  A cell that meets a void with an edge or a corner
 * alone is deep. */
#include "mpm/memory/store.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MERGE_RATIO = 0.9; /* of a merged domain to the longest that its cell allows, at most */

/* A cell's points; a thread has its own. */
typedef struct {
    int n, capacity, merged;
    int *body;
    double (*data)[BLOCK_DOUBLES];
} gathering;

static bool make_room(gathering *g, int n)
{
    if (n <= g->capacity) return true;
    const int capacity = 2 * n + 64;
    int *b = realloc(g->body, (size_t)capacity * sizeof *b);
    if (b) g->body = b;
    double(*d)[BLOCK_DOUBLES] = realloc(g->data, (size_t)capacity * sizeof *d);
    if (d) g->data = d;
    if (b && d) g->capacity = capacity;
    return b && d;
}

/* All of the points, or only what decides which of them are merged. */
static bool gather_cell(const mpm *m, const brick *b, int cell, bool whole, gathering *g)
{
    static const int decides[] = { FIRST_x,        FIRST_x + 1,    FIRST_x + 2, FIRST_half,
                                   FIRST_half + 1, FIRST_half + 2, FIRST_damage };
    const int fields = whole ? (int)BLOCK_DOUBLES : (int)(sizeof decides / sizeof *decides);
    g->n = g->merged = 0;
    for (int q = b->head[cell]; q >= 0; q = m->links[q].next) {
        const double(*from)[LANES] = (const double(*)[LANES])(const void *)&m->blocks[q];
        if (!make_room(g, g->n + LANES)) return false;
        for (unsigned lanes = m->links[q].mask; lanes; lanes &= lanes - 1) {
            for (int i = 0; i < fields; i++) {
                const int field = whole ? i : decides[i];
                g->data[g->n][field] = from[field][__builtin_ctz(lanes)];
            }
            g->body[g->n++] = m->links[q].body;
        }
    }
    return true;
}

/* Side by side along an axis, of one size across, sound, and together no longer than `longest`? */
static bool mergeable(const double *a, const double *b, int along, double longest)
{
    if (a[FIRST_damage] >= 1 || b[FIRST_damage] >= 1) return false;
    const double length = a[FIRST_half + along] + b[FIRST_half + along],
                 apart = fabs(a[FIRST_x + along] - b[FIRST_x + along]);
    if (2 * length > longest || fabs(apart - length) > 0.5 * length) return false;
    for (int i = 1; i < 3; i++) {
        const int k = (along + i) % 3;
        const double small = fmin(a[FIRST_half + k], b[FIRST_half + k]),
                     large = fmax(a[FIRST_half + k], b[FIRST_half + k]);
        if (small < 0.7 * large || fabs(a[FIRST_x + k] - b[FIRST_x + k]) > 0.5 * small) return false;
    }
    return true;
}

static int partner(const gathering *g, int i, int along, double longest)
{
    int best = -1;
    double nearest = HUGE_VAL;
    for (int j = i + 1; j < g->n; j++) {
        const double d = fabs(g->data[i][FIRST_x + along] - g->data[j][FIRST_x + along]);
        if (g->body[j] == g->body[i] && d < nearest && mergeable(g->data[i], g->data[j], along, longest))
            best = j, nearest = d;
    }
    return best;
}

static void merge_along(gathering *g, int along, double longest, double dt)
{
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < g->n; i++) {
            const int j = partner(g, i, along, longest);
            if (j < 0) continue;
            mpm_point_merge(g->data[i], g->data[j], along, dt);
            g->n--;
            g->body[j] = g->body[g->n];
            memcpy(g->data[j], g->data[g->n], sizeof g->data[j]);
            g->merged++;
            again = true;
        }
    }
}

static bool any_partner(const gathering *g, const double longest[3])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < g->n && longest[k] > 0; i++)
            if (partner(g, i, k, longest[k]) >= 0) return true;
    return false;
}

/* Longest domains along each axis; 0: none is merged along it.  False: no memory. */
static bool merge_cell(mpm *m, brick *b, int cell, const double longest[3], gathering *g)
{
    if (!gather_cell(m, b, cell, false, g)) return false;
    if (!any_partner(g, longest)) return true;
    if (!gather_cell(m, b, cell, true, g)) return false;
    for (int k = 0; k < 3; k++) merge_along(g, k, longest[k], level_dt_last(m, b->level));
    b->particles -= g->n + g->merged;
    mpm_store_release_cell(m, b, cell);
    for (int i = 0; i < g->n; i++)
        mpm_store_insert(m, b, cell, g->body[i], g->data[i]); /* fits: less than was released */
    return true;
}

/* How long points may become by merging in a brick's cells along each axis; 0 where cells are no larger than fine ones.
 */
static bool merge_lengths(const mpm *m, const brick *b, double longest[3][BRICK])
{
    bool any = false;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < BRICK; i++) {
            const axis *a = &axes_of(m, b)[k];
            const int node = BRICK * b->at[k] + i;
            const bool larger =
                node >= 1 && node <= a->last && a->node[node + 1] - a->node[node - 1] > 2.4 * m->scene.axis[k].fine;
            longest[k][i] = larger ? MERGE_RATIO * a->longest[node] : 0;
            any = any || larger;
        }
    return any;
}

/* Has the group points, sound or failed, in the six cells that share a face with this one?  As it was before this look:
 * while that goes on, other threads take the chains of their cells apart. */
static bool is_deep(const mpm *m, const brick *b, int cell)
{
    static const int stride[3] = { 1, BRICK, BRICK * BRICK }, step[3] = { 1, 3, 9 };
    for (int k = 0; k < 3; k++)
        for (int way = -1; way <= 1; way += 2) {
            const int place = cell / stride[k] % BRICK + way;
            const bool here = place >= 0 && place < BRICK;
            const int other = b->neighbour[SELF + way * step[k]];
            const int there = here ? cell + way * stride[k] : cell - way * (BRICK - 1) * stride[k];
            if (!here && other < 0) return false;
            if (!((here ? b : &m->bricks[other])->occupied >> there & 1)) return false;
        }
    return true;
}

/* Cells of more than a block, so that what lies in its cell as it was made costs nothing. */
static bool merge_brick(mpm *m, brick *b, gathering *g, uint64_t *merges)
{
    double along[3][BRICK];
    if (!b->fresh || !merge_lengths(m, b, along)) return true;
    b->fresh = false;
    for (int c = 0; c < BRICK_CELLS; c++) {
        const double longest[3] = { along[0][c % BRICK], along[1][c / BRICK % BRICK], along[2][c / (BRICK * BRICK)] };
        if (b->head[c] < 0 || m->links[b->head[c]].next < 0 || !is_deep(m, b, c)) continue;
        if (!merge_cell(m, b, c, longest, g)) return false;
        *merges += (uint64_t)g->merged;
    }
    return true;
}

status mpm_merge_points(mpm *m)
{
    bool enough = true;
    uint64_t merges = 0;
#pragma omp parallel num_threads(m->threads) reduction(&& : enough) reduction(+ : merges)
    {
        gathering g = { 0 };
#pragma omp for schedule(dynamic, 4)
        for (int i = 0; i < m->bricks_used; i++) enough = merge_brick(m, &m->bricks[i], &g, &merges) && enough;
        free(g.body);
        free(g.data);
    }
    m->report.merges += merges;
    CHECK(enough, STATUS_MEMORY, "no memory to merge points");
    return status_ok();
}
