/* SPDX-License-Identifier: BSD-3-Clause */
/* How threads share a loop: each begins with a run of its own, the same one in every loop over the same list, so that
 * its core's cache still has what the loop before has written; then it takes what is left of the others'.  Which thread
 * does what changes no bit, as long as no iteration needs another's result. */
#ifndef BREECH_MPM_RUNS_H
#define BREECH_MPM_RUNS_H

#include "mpm/memory/store.h"

/* What nobody has begun yet of a thread's run, in a cache line of its own. */
typedef struct {
    _Alignas(64) int next;
    int end;
} loop_run;

typedef struct {
    int threads;
    loop_run of[MPM_MAX_THREADS];
} loop_runs;

/* 0 .. count - 1, in runs of equal length. */
void mpm_runs_even(loop_runs *out, int threads, int count);
/* The bricks, in runs of about equal work in a step of the coarsest level.  Which levels are due does not matter, so a
 * brick stays with its thread. */
void mpm_runs_of_bricks(loop_runs *out, const mpm *m);
/* The next iterations for this thread, *first .. *end - 1; false: all are begun. */
bool mpm_runs_take(loop_runs *r, int thread, int *first, int *end);

#endif
