/* SPDX-License-Identifier: BSD-3-Clause */
/* The processes of a run that mpirun started, and messages between them.  MPI is behind this file: ranks_mpi.c, or
 * ranks_alone.c where the build has none.
 *
 * Rank 0 runs the study and alone writes; the others compute scenes for it (crew.h).  Nobody waits busily: receiving
 * polls. A message has a kind and bytes; those from one sender come in the order they were sent.  Whatever goes wrong
 * in MPI itself ends all processes, MPI's own way. */
#ifndef BREECH_COUPLING_RANKS_H
#define BREECH_COUPLING_RANKS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    int from, kind;
    char *data; /* owned, a 0 byte behind it; run_message_free */
    size_t bytes;
} message;

/* Before anything else of this file; outside mpirun it costs nothing.
 * STATUS_BAD_INPUT: several processes were started of a build without MPI. */
status run_ranks_start(void);
/* All processes call it last; waits for each other. */
void run_ranks_finish(void);

int run_ranks_number(void);     /* of this process, from 0 */
int run_ranks_count(void);      /* 1 outside mpirun */
int run_ranks_on_machine(void); /* of them on this machine */

/* Returns when the bytes may be reused, which may be when the other one has received them.  At most 2 GiB. */
status run_ranks_send(int to, int kind, const void *data, size_t bytes);
/* false: nothing has come.  STATUS_MEMORY only. */
status run_ranks_receive(message *out, bool *any);
void run_message_free(message *m);

/* Memory that the processes of one machine share, a part each, one behind the other.  All of several processes call
 * these two together. */
typedef struct {
    void *part;
    int n, me;
    void *window; /* MPI's, owned */
} ranks_memory;
/* Returns when every part holds what its process has brought; bytes: the same for all.  For what changes later:
 * atomics. */
status run_ranks_share(const void *mine, size_t bytes, ranks_memory *out);
void run_ranks_unshare(ranks_memory *m);

/* Sleeps a little: between two looks that found nothing. */
void run_ranks_pause(void);

#endif
