/* SPDX-License-Identifier: BSD-3-Clause */
/* The processes of a run, and messages between them: those that mpirun has started, or on one machine those that the
 * program has forked itself.  What carries the messages is behind this file (ranks_carrier.h).
 *
 * Rank 0 runs the study and alone writes; the others compute scenes for it (crew.h) and speak with it alone.  Nobody
 * waits busily: receiving polls.  A message has a kind and bytes; those from one sender come in the order they were
 * sent.  When one of the processes dies, all end. */
#ifndef BREECH_COUPLING_RANKS_H
#define BREECH_COUPLING_RANKS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

typedef struct {
    int from, kind;
    char *data; /* owned, a 0 byte behind it; run_message_free */
    size_t bytes;
} message;

/* Before anything else of this file, and before the first thread; returns in each of the processes.  Under mpirun they
 * are its own, whatever `processes` says.
 * STATUS_BAD_INPUT: mpirun has started several of a build without MPI.  STATUS_IO: the system grants no more. */
status run_ranks_start(int processes);
/* All processes call it last. */
void run_ranks_finish(void);

int run_ranks_number(void); /* of this process, from 0 */
int run_ranks_count(void);
bool run_ranks_launched(void);  /* by mpirun */
int run_ranks_on_machine(void); /* of them on this machine */

/* Returns when the bytes may be reused, which may be when the other one has received them; what comes meanwhile is kept
 * for run_ranks_receive, so two may send to each other.  At most 2 GiB. */
status run_ranks_send(int to, int kind, const void *data, size_t bytes);
/* false: nothing has come.  Of a message that has begun to come the rest is waited for.  STATUS_MEMORY only. */
status run_ranks_receive(message *out, bool *any);
void run_message_free(message *m);

/* Memory that the processes of one machine share, a part each, one behind the other.  All of several processes call
 * these two together. */
typedef struct {
    void *part;
    int n, me;
    void *window; /* MPI's, owned */
    size_t bytes; /* of all parts, where the program has forked the processes */
} ranks_memory;
/* Returns when every part holds what its process has brought; bytes: the same for all.  For what changes later:
 * atomics.  What was shared last is given back first. */
status run_ranks_share(const void *mine, size_t bytes, ranks_memory *out);
void run_ranks_unshare(ranks_memory *m);

/* Sleeps a little: between two looks that found nothing. */
static inline void run_ranks_pause(void)
{
    nanosleep(&(struct timespec){ 0, 2000000 }, NULL);
}

#endif
