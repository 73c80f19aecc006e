/* SPDX-License-Identifier: BSD-3-Clause */
/* The processes under mpirun.  Rank 0 runs the study, hands scenes out, computes one itself and alone writes files; the
 * other ranks, the members, compute the scenes they are handed.
 *
 * Order of work.  An idle member gets the next scene that the study waits for (`wanted`), else the likeliest of those
 * that it may need next (`ahead`).  Every rank looks for messages after each step.  A member that computes a scene
 * ahead puts it off for a wanted one and continues it afterwards, or drops it when the study no longer lists it.  When
 * a wanted scene is finished and a member is idle, rank 0 lays its own scene aside, lets the study continue, and
 * resumes the scene later.  The results have the same bits in any order.
 * Messages.  A scene is sent as the text of its key, which is a case file; the answer is the file that the store keeps.
 * A member whose key differs (another build, another instruction set) refuses the scene.
 * A member that dies ends the run, as MPI has it; finished scenes are in the store by then. */
#ifndef BREECH_COUPLING_CREW_H
#define BREECH_COUPLING_CREW_H

#include "coupling/run/scene_work.h"

typedef struct crew crew;

/* Rank 0, of more than one; side_by_side as in session_options: members beyond that only lend their threads. */
status run_crew_create(session *s, int side_by_side, crew **out);
/* Stops the scenes under way and removes those that nobody asked for, with their snapshots.  finished: the run is over,
 * else it may be resumed: snapshots stay of what the resumed run finds, in the checkpoint or in the store. */
void run_crew_free(crew *k, bool finished); /* NULL allowed */

/* Computes these until at least one of them is finished; the queries' cases are borrowed until run_crew_free. */
status run_crew_some(crew *k, const scene_query *query, int n);
/* These may be wanted next, the likeliest first; any_order as in scenes.h. */
status run_crew_ahead(crew *k, const scene_query *query, int n, bool any_order);
/* *out: the file of a finished scene, now the caller's; NULL: not finished.  Of a scene that failed: its status; of
 * one that the store has not taken, with its file: why. */
status run_crew_take(crew *k, const scene_key *key, h5_file **out);

/* The others: compute until rank 0 says it is over. */
void run_crew_serve(int threads, lending *l, impact_runner run);
/* Rank 0, last: says so and waits until all members know. */
void run_crew_dismiss(void);

#endif
