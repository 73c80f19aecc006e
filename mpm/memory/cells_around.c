/* SPDX-License-Identifier: BSD-3-Clause */
/* Cells and nodes around cells that hold points, as bits of bricks.
 *
 * A point's nodes are those of its cell and of the cells beside it.  So two groups can share a node only where their
 * cells lie within two of each other along every axis, and nodes within one of a group's cells have mass. */
#include "mpm/memory/store.h"

#include <stdlib.h>

static const uint64_t first_layer[3] = { 0x1111111111111111, 0x000f000f000f000f, 0xffff }; /* across each axis */

uint64_t mpm_occupied_cells(const brick *b)
{
    uint64_t cells = 0;
    for (int c = 0; c < BRICK_CELLS; c++) cells |= (uint64_t)(b->head[c] >= 0) << c;
    return cells;
}

/* A brick's cells (bits) that lie within `reach` of the given ones along axis k, those of the bricks before and after
 * included. */
static uint64_t spread(int k, int reach, uint64_t before, uint64_t here, uint64_t after)
{
    const int stride = 1 << 2 * k;
    uint64_t low = 0, r = here;
    for (int n = 1; n <= reach; n++) {
        const int on = n * stride, back = (BRICK - n) * stride;
        low |= first_layer[k] << (n - 1) * stride; /* the first n layers; the last n: */
        const uint64_t high = low << back;
        r |= (here << on & ~low) | (before >> back & low) | (here >> on & ~high) | (after << back & high);
    }
    return r;
}

/* Whose points count: those of the brick's own group, or of all others. */
typedef enum { OWN, OTHERS } whose;

static uint64_t occupied_at(const mpm *m, const brick *b, whose which, int step)
{
    int at[3];
    uint64_t cells = 0;
    if (!brick_step_inside(m, b, step, at)) return 0;
    const int site = grids_place(&m->grids, b->level, at);
    for (int f = 0; site >= 0 && site < m->places && f < m->groups; f++) {
        const int other = (f == b->group) == (which == OWN) ? brick_of_site(m, site, f) : -1;
        if (other >= 0) cells |= m->bricks[other].occupied;
    }
    return cells;
}

static uint64_t within(const mpm *m, const brick *b, whose which, int reach)
{
    uint64_t plane[3];
    for (int z = 0; z < 3; z++) {
        uint64_t row[3];
        for (int y = 0; y < 3; y++) {
            uint64_t cells[3];
            for (int x = 0; x < 3; x++) cells[x] = occupied_at(m, b, which, x + 3 * y + 9 * z);
            row[y] = spread(0, reach, cells[0], cells[1], cells[2]);
        }
        plane[z] = spread(1, reach, row[0], row[1], row[2]);
    }
    return spread(2, reach, plane[0], plane[1], plane[2]);
}

void mpm_cells_open(const mpm *m, const brick *b, int k, uint64_t open[2])
{
    static const int step[3] = { 1, 3, 9 };
    const int before = b->neighbour[SELF - step[k]], after = b->neighbour[SELF + step[k]];
    const int stride = 1 << 2 * k, back = (BRICK - 1) * stride;
    const uint64_t low = first_layer[k], high = low << back;
    const uint64_t last = before < 0 ? 0 : m->bricks[before].occupied >> back & low;
    const uint64_t first = after < 0 ? 0 : m->bricks[after].occupied << back & high;
    open[0] = ~((b->occupied << stride & ~low) | last);
    open[1] = ~((b->occupied >> stride & ~high) | first);
}

uint64_t mpm_cells_of_layer(int k, int layer)
{
    return first_layer[k] << layer * (1 << 2 * k);
}

static bool wants_face(const mpm *m, int group, int face)
{
    return m->group[group].arrives[face] || m->scene.axis[face / 2].boundary[face % 2] == MPM_BOUNDARY_ABSORBING;
}

bool mpm_near_arrival(const mpm *m, const brick *b, int reach)
{
    for (int face = 0; face < MPM_FACES; face++) {
        const int k = face / 2, end = face % 2 ? axes_of(m, b)[k].last : 1, first = BRICK * b->at[k];
        if (wants_face(m, b->group, face) && first - reach <= end && end <= first + BRICK - 1 + reach) return true;
    }
    return false;
}

uint64_t mpm_arrival_cells(const mpm *m, const brick *b)
{
    uint64_t cells = 0;
    for (int face = 0; face < MPM_FACES; face++) {
        if (!wants_face(m, b->group, face)) continue;
        const int k = face / 2, end = face % 2 ? axes_of(m, b)[k].last : 1;
        for (int i = 0; i < BRICK; i++)
            if (abs(BRICK * b->at[k] + i - end) <= 1) cells |= mpm_cells_of_layer(k, i);
    }
    return cells;
}

uint64_t mpm_contact_cells(const mpm *m, const brick *b)
{
    return within(m, b, OTHERS, 2);
}

uint64_t mpm_cells_around(const mpm *m, const brick *b, int reach)
{
    return within(m, b, OWN, reach);
}

uint64_t mpm_cells_towards(int step, int layers)
{
    uint64_t cells = ~0ull;
    for (int k = 0; k < 3; k++, step /= 3) {
        const int d = step % 3 - 1;
        uint64_t side = d == 0 ? ~0ull : 0;
        for (int n = 0; n < layers && d != 0; n++) side |= mpm_cells_of_layer(k, d < 0 ? n : BRICK - 1 - n);
        cells &= side;
    }
    return cells;
}
