/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes for a study: ask with inputs, get outcomes.  The one way in which a study comes by a scene.
 *
 * A scene is what its inputs make it: the case's rail, projectile, scene and material constants, the grain, velocity,
 * contact pressure, heat of the armature and resolution, the program's version and instruction set.  Whoever asks for
 * the same inputs again - another site, kind, treatment, a resumed run - gets the scene that is there.
 *   run_scenes_find   what is known already; costs no scene
 *   run_scenes_all    these, all of them: a batch
 *   run_scenes_some   at least one more of these: for a study that can go on with whichever comes first
 *   run_scenes_ahead  these may be asked for next: for processes that would be idle
 * One process computes in the order of the list, one at a time, and nothing ahead; several share the work
 * (docs/theory/onset.md).  A study stays sequential in its thinking and parallel in its scenes where its searches are
 * continuations (search/threshold.h): tell each what run_scenes_find knows until it needs more, run_scenes_some of what
 * all of them need, again until none needs any.  What a search concludes may depend on its own outcomes alone, never on
 * which scene came first or on what else is known: then the answer is the same for any number of processes. */
#ifndef BREECH_COUPLING_SCENES_H
#define BREECH_COUPLING_SCENES_H

#include "coupling/run/session.h"

typedef struct {
    case_impact impact;           /* what it borrows stays until run_session_close */
    case_body_scene bodies;       /* the same; or a scene of bodies, where it has any */
    char name[SUMMARY_NAME_SIZE]; /* plain (outdir.h); a scene of this run keeps the name it has */
    bool anew;                    /* for its snapshots and live history: do not take it from the store */
} scene_query;

/* *out is NULL: not computed yet; else borrowed from the session, stays where it is until run_session_close. */
status run_scenes_find(session *s, const scene_query *query, const scene_record **out);

/* Computes what is missing of the n; out[i], borrowed as above, answers query[i].  n = 0 is fine.
 * STATUS_STOPPED: checkpointed, what was reached is kept.  STATUS_BAD_INPUT: a scene that cannot be built. */
status run_scenes_all(session *s, const scene_query *query, int n, const scene_record **out);

/* Returns as soon as one more of the n is known, at once when all are. */
status run_scenes_some(session *s, const scene_query *query, int n);

/* What is to be said of a scene that was computed.  By whoever lists a study's scenes, in that list's order: they come
 * in another with every number of processes. */
void run_scenes_warn_of(session *s, const onset_scene *e);
/* Of its energy error alone [1]; scene: its name, "" where there is but one. */
void run_scenes_warn_of_energy(session *s, const char *scene, double error);

/* Scenes that may be needed next, the likeliest first; replaces the former list.  any_order: these scenes may run in
 * any order; the search needs all of them before it continues.  Those that run_scenes_some needs may then stand among
 * them, and all are computed in the order of this list. */
status run_scenes_ahead(session *s, const scene_query *query, int n, bool any_order);

#endif
