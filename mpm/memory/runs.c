/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/memory/runs.h"

#include <stdint.h>

enum { CHUNK = 4 }; /* iterations taken at a time */

/* Run t ends, and the next one begins, at i. */
static void cut(loop_runs *r, int t, int i)
{
    r->of[t].end = i;
    if (t + 1 < r->threads) r->of[t + 1].next = i;
}

void mpm_runs_even(loop_runs *out, int threads, int count)
{
    out->threads = threads;
    out->of[0].next = 0;
    for (int t = 0; t < threads; t++) cut(out, t, (int)((long)count * (t + 1) / threads));
}

/* Its points' steps in one of the coarsest level: each finer one takes twice as many. */
static int64_t work_of(const mpm *m, const brick *b)
{
    return (int64_t)b->particles << (m->grids.levels - 1 - b->level);
}

void mpm_runs_of_bricks(loop_runs *out, const mpm *m)
{
    int64_t all = 0, before = 0;
    int t = 0;
    for (int i = 0; i < m->bricks_used; i++) all += work_of(m, &m->bricks[i]);
    out->threads = m->threads;
    out->of[0].next = 0;
    for (int i = 0; i < m->bricks_used; i++) {
        while (t + 1 < m->threads && before >= all * (t + 1) / m->threads) cut(out, t++, i);
        before += work_of(m, &m->bricks[i]);
    }
    while (t < m->threads) cut(out, t++, m->bricks_used);
}

bool mpm_runs_take(loop_runs *r, int thread, int *first, int *end)
{
    for (int k = 0; k < r->threads; k++) {
        loop_run *run = &r->of[(thread + k) % r->threads];
        int at;
#pragma omp atomic capture
        {
            at = run->next;
            run->next += CHUNK;
        }
        if (at >= run->end) continue;
        *first = at;
        *end = at + CHUNK < run->end ? at + CHUNK : run->end;
        return true;
    }
    return false;
}
