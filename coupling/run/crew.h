/* The processes under mpirun as a crew: rank 0 thinks, hands scenes out, computes one itself and alone writes; the
 * others compute what they are handed.
 *
 * Dynamic: an idle member gets the next scene that is wanted, else the likeliest of those that may be wanted next.  All
 * look for messages after every step.  A member that computes what may be wanted puts it off for what is, and goes on
 * with it when that is done, or gives it up when nobody asks for it any more.  When an outcome has come that the study
 * waits for and somebody has nothing to do, rank 0 lays its own scene aside, lets the study think, and goes on with it
 * later.  All to the same bits. A scene is handed out as its key's text, a case file; it comes back as the file the
 * store keeps.  A member whose key differs (another build, another instruction set) refuses.
 * A member that dies takes the run with it (MPI's way); finished scenes are in the store by then. */
#ifndef BREECH_COUPLING_CREW_H
#define BREECH_COUPLING_CREW_H

#include "coupling/run/scene_work.h"

typedef struct crew crew;

/* Rank 0, of more than one. */
status run_crew_create(session *s, crew **out);
/* Stops what is under way, drops what nobody asked for, its snapshots too. */
void run_crew_free(crew *k); /* NULL allowed */

/* Computes these until at least one of them has come; the queries' cases are borrowed until run_crew_free. */
status run_crew_some(crew *k, const scene_query *query, int n);
/* These may be wanted next, the likeliest first; any_order as in scenes.h. */
status run_crew_ahead(crew *k, const scene_query *query, int n, bool any_order);
/* *out: the file of a scene that has come, the caller's now; NULL: it has not.  A scene that failed: its status. */
status run_crew_take(crew *k, const scene_key *key, h5_file **out);

/* The others: compute until rank 0 says it is over. */
void run_crew_serve(int threads, lending *l, impact_runner run);
/* Rank 0, last: says so and waits until all have heard. */
void run_crew_dismiss(void);

#endif
