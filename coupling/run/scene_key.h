/* SPDX-License-Identifier: BSD-3-Clause */
/* What decides a scene, as text: the case file that `breech scene` would compute just this scene from
 * (case_impact_write).
 *
 * It is written by the tables of the case's schema, so that a new key of its sections is in it from the start.  Of
 * `output` the number of snapshots counts: it sets where a scene looks whether it is settled.  The key is the hash of
 * this text, the version, the instruction set and the solver's id. */
#ifndef BREECH_COUPLING_SCENE_KEY_H
#define BREECH_COUPLING_SCENE_KEY_H

#include "coupling/case/case_plain.h"

#include <stdint.h>

typedef struct {
    char *text; /* owned */
    size_t bytes;
    uint64_t hash;
} scene_key;

/* *out needs run_scene_key_free even on error. */
status run_scene_key_of(const case_impact *one, scene_key *out);
status run_scene_key_of_bodies(const case_body_scene *one, scene_key *out);
void run_scene_key_free(scene_key *k);

/* Of the solver's sources, the compiler and its flags (cmake/solver_id.cmake). */
const char *run_solver_id(void);

#endif
