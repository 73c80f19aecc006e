/* SPDX-License-Identifier: BSD-3-Clause */
/* Threads that the processes on one machine lend each other, so that a core is not idle while a scene is computed
 * beside it.
 *
 * Who computes no scene lends all of its own; those that do share them out, and ask between two steps how many they
 * have. On every machine the shares of those at work add up to the threads of all, and none has fewer than its own.
 * Another machine's threads cannot be lent, nor those that OpenMP (OMP_PROC_BIND, OMP_PLACES) or the system keeps on
 * their own process's cores.  A process alone has no lending: NULL, which all but one of these take. */
#ifndef BREECH_COUPLING_LENDING_H
#define BREECH_COUPLING_LENDING_H

#include "base/status.h"

typedef struct lending lending;

/* All processes together, after run_ranks_start and before the first parallel region: from here on each may run on
 * every core that one of the machine's was bound to.  threads: this process's own.  *out NULL: there is one process. */
status run_lending_open(int threads, lending **out);
/* All processes together, before run_ranks_finish. */
void run_lending_close(lending *l);

void run_lending_own(lending *l, int threads); /* another number of its own */
/* Around the computing of a scene; they nest. */
void run_lending_begin(lending *l);
void run_lending_end(lending *l);
int run_lending_threads(const lending *l); /* that this process has now; not of NULL */

#endif
