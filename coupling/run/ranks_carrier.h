/* SPDX-License-Identifier: BSD-3-Clause */
/* What carries the messages of ranks.h: MPI (ranks_mpi.c), or sockets to processes that the program has forked
 * (ranks_fork.c).  Members mean what the functions of ranks.h do. */
#ifndef BREECH_COUPLING_RANKS_CARRIER_H
#define BREECH_COUPLING_RANKS_CARRIER_H

#include "coupling/run/ranks.h"

typedef struct {
    void (*finish)(void);
    int number, count, on_machine;
    /* Begins to send; the bytes stay where they are until `sent` says true, which somebody asks again and again. */
    status (*send)(int to, int kind, const void *data, size_t bytes);
    status (*sent)(bool *all);
    status (*receive)(message *out, bool *any);
    status (*share)(const void *mine, size_t bytes, ranks_memory *out);
    void (*unshare)(ranks_memory *m);
} ranks_carrier;

/* Of the processes that mpirun has started; *out NULL: it has started none.
 * STATUS_BAD_INPUT: it has, of a build without MPI. */
status run_ranks_mpi(const ranks_carrier **out);
/* Forks processes - 1, before any thread is made.  STATUS_IO: the system has no more. */
status run_ranks_fork(int processes, const ranks_carrier **out);

#endif
