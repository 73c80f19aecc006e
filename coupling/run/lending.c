/* SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE /* sched_setaffinity */

#include "coupling/run/lending.h"

#include "coupling/run/ranks.h"

#include <omp.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>

/* What a process tells the others of its machine. */
typedef struct {
    atomic_int threads; /* written seldom, read after every step; MPI's memory is aligned for no more than this */
    atomic_int scenes;  /* under way, those that are put off too */
    cpu_set_t cores;    /* that it was bound to at the start */
} slip;

struct lending {
    ranks_memory board; /* of slips */
    bool borrows;
};

static slip *slip_of(const lending *l, int rank)
{
    return (slip *)l->board.part + rank;
}

/* Launchers bind a process to as many cores as it has threads, which borrowed ones would have to share.  false: so they
 * would now. */
static bool unbind(const lending *l)
{
    cpu_set_t all, mine;
    CPU_ZERO(&all);
    if (omp_get_proc_bind() != omp_proc_bind_false) return false;
    for (int i = 0; i < l->board.n; i++) CPU_OR(&all, &all, &slip_of(l, i)->cores);
    sched_setaffinity(0, sizeof all, &all);
    return sched_getaffinity(0, sizeof mine, &mine) == 0 && CPU_EQUAL(&mine, &all); /* a container grants less */
}

status run_lending_open(int threads, lending **out)
{
    slip mine = { .threads = threads };
    *out = NULL;
    if (run_ranks_count() == 1) return status_ok();
    lending *l = malloc(sizeof *l);
    CHECK(l, STATUS_MEMORY, "no memory for the threads of %d processes", run_ranks_count());
    CPU_ZERO(&mine.cores);
    sched_getaffinity(0, sizeof mine.cores, &mine.cores);
    const status shared = run_ranks_share(&mine, sizeof mine, &l->board);
    if (shared.code != STATUS_OK) {
        free(l);
        return shared;
    }
    l->borrows = unbind(l);
    *out = l;
    return status_ok();
}

void run_lending_close(lending *l)
{
    if (!l) return;
    run_ranks_unshare(&l->board);
    free(l);
}

void run_lending_own(lending *l, int threads)
{
    if (l) atomic_store(&slip_of(l, l->board.me)->threads, threads);
}

void run_lending_begin(lending *l)
{
    if (l) atomic_fetch_add(&slip_of(l, l->board.me)->scenes, 1);
}

void run_lending_end(lending *l)
{
    if (l) atomic_fetch_sub(&slip_of(l, l->board.me)->scenes, 1);
}

/* Its own, and as many of the idle ones' as the others at work; what is left over goes to the first of them. */
int run_lending_threads(const lending *l)
{
    const int own = atomic_load(&slip_of(l, l->board.me)->threads);
    int idle = 0, working = 0, before = 0;
    for (int i = 0; i < l->board.n; i++) {
        const bool works = atomic_load(&slip_of(l, i)->scenes) > 0;
        if (!works) idle += atomic_load(&slip_of(l, i)->threads);
        working += works;
        before += works && i < l->board.me;
    }
    return l->borrows && working > 0 ? own + idle / working + (before < idle % working) : own;
}
