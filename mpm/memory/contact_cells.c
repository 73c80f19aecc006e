/* Where groups may meet.  A particle's nodes are those of its cell and of the cells beside it, so two groups can share
 * a node only where their cells lie within two of each other along every axis. */
#include "mpm/memory/store.h"

enum { REACH = 2 }; /* cells */

uint64_t mpm_occupied_cells(const brick *b)
{
    uint64_t cells = 0;
    for (int c = 0; c < BRICK_CELLS; c++) cells |= (uint64_t)(b->head[c] >= 0) << c;
    return cells;
}

/* A brick's cells (bits) that lie within REACH of the given ones along axis k, those of the bricks before and after
 * included. */
static uint64_t spread(int k, uint64_t before, uint64_t here, uint64_t after)
{
    static const uint64_t first_layer[3] = { 0x1111111111111111, 0x000f000f000f000f, 0xffff };
    const int stride = 1 << 2 * k;
    uint64_t low = 0, r = here;
    for (int n = 1; n <= REACH; n++) {
        const int on = n * stride, back = (BRICK - n) * stride;
        low |= first_layer[k] << (n - 1) * stride; /* the first n layers; the last n: */
        const uint64_t high = low << back;
        r |= (here << on & ~low) | (before >> back & low) | (here >> on & ~high) | (after << back & high);
    }
    return r;
}

static uint64_t others_at(const mpm *m, const brick *b, const int step[3])
{
    int at[3];
    uint64_t cells = 0;
    for (int k = 0; k < 3; k++) {
        at[k] = b->at[k] + step[k];
        if (at[k] < 0 || at[k] >= axes_of(m, b)[k].bricks) return 0;
    }
    for (int f = 0; f < m->groups; f++) {
        const int other = brick_at(m, f, b->level, at);
        if (f != b->group && other >= 0) cells |= m->bricks[other].occupied;
    }
    return cells;
}

uint64_t mpm_contact_cells(const mpm *m, const brick *b)
{
    uint64_t plane[3];
    for (int z = 0; z < 3; z++) {
        uint64_t row[3];
        for (int y = 0; y < 3; y++) {
            uint64_t cells[3];
            for (int x = 0; x < 3; x++) cells[x] = others_at(m, b, (const int[3]){ x - 1, y - 1, z - 1 });
            row[y] = spread(0, cells[0], cells[1], cells[2]);
        }
        plane[z] = spread(1, row[0], row[1], row[2]);
    }
    return spread(2, plane[0], plane[1], plane[2]);
}
