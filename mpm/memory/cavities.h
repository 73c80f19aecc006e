/* SPDX-License-Identifier: BSD-3-Clause */
/* The cavities of a solver (mpm/cavity.h): where they are, in steps and in checkpoints. */
#ifndef BREECH_MPM_CAVITIES_H
#define BREECH_MPM_CAVITIES_H

#include "mpm/cavity.h"
#include "mpm/law/gas.h"
#include "mpm/memory/store.h"

/* Of a node and its cell in mpm_cavities.map. */
enum {
    CAVITY_OF = 0x0f,     /* 1 + the cavity whose gas pushes on the node; 0: none */
    CAVITY_VOID = 0x40,   /* the cell is empty, and that cavity's */
    CAVITY_REACHES = 0x80 /* points of the cell reach such a node */
};

struct mpm_cavities {
    int n, size[3];          /* of the map: nodes 0 .. last + 1 along each axis */
    mpm_cavity_state *state; /* [n] */
    mpm_gas *gas;            /* [n] */
    uint8_t *map;            /* [size] */
    uint8_t *cover;          /* [size] what lies in a cell, while it is looked at */
    int *queue;              /* [size] */
    double *matter;          /* [size] volume of the cell's points, while it is looked at [m3] */
    double *swept;           /* [places][n] volume that a site's nodes have made in the step [m3] */
    int places;
};

status mpm_cavities_make(mpm *m); /* after the points; nothing where the scene has none */
void mpm_cavities_free(mpm *m);
status mpm_cavities_reserve(mpm *m); /* before the phase of nodes */
status
mpm_cavities_step(mpm *m); /* after a step: volumes, gas, pressures, work; STATUS_NUMERICAL: no gas, or no vapour */
void mpm_cavities_look(mpm *m); /* every MPM_CAVITY_EVERY steps */
size_t mpm_cavities_bytes(const mpm *m);
void mpm_cavities_put(const mpm *m, char *to);
void mpm_cavities_get(mpm *m, const char *from);

static inline uint8_t cavity_at(const struct mpm_cavities *c, const int index[3])
{
    return c->map[(index[2] * c->size[1] + index[1]) * c->size[0] + index[0]];
}

static inline bool is_in_map(const struct mpm_cavities *c, const int index[3])
{
    return index[0] < c->size[0] && index[1] < c->size[1] && index[2] < c->size[2];
}

/* Cells of a brick whose points reach a node that a gas pushes on. */
static inline uint64_t cavity_cells(const struct mpm_cavities *c, const brick *b)
{
    uint64_t cells = 0;
    for (int i = 0; i < BRICK_CELLS; i++) {
        const int at[3] = { BRICK * b->at[0] + i % BRICK, BRICK * b->at[1] + i / BRICK % BRICK,
                            BRICK * b->at[2] + i / (BRICK * BRICK) };
        if (is_in_map(c, at)) cells |= (uint64_t)(cavity_at(c, at) / CAVITY_REACHES) << i;
    }
    return cells;
}

#endif
