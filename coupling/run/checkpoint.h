/* SPDX-License-Identifier: BSD-3-Clause */
/* Checkpoint: what a stopped run needs to go on bit for bit, in one file.
 *
 * Holds the study's own bookkeeping (opaque bytes: results so far, which scene is next) and, when stopped inside a
 * scene, the scene's image (scene_image).  A file made by another version, another build of its solver, another
 * instruction set or case, or damaged in any byte, is refused with words that say which. */
#ifndef BREECH_COUPLING_CHECKPOINT_H
#define BREECH_COUPLING_CHECKPOINT_H

#include "base/status.h"
#include "coupling/host/hash.h"

#include <stddef.h>
#include <stdint.h>

/* Who may read it: all three must agree. */
typedef struct {
    char version[32];         /* host_version() and run_solver_id() */
    char instruction_set[32]; /* mpm_instruction_set() */
    uint64_t inputs;          /* hash of everything that decides the result: host_hash_bytes over used.yaml */
} checkpoint_key;

typedef struct {
    char scene[128];     /* name of the scene under way, "" between scenes */
    uint64_t scene_hash; /* of its inputs */
    double scene_time;   /* reached in it [s] */
    double wall_seconds; /* spent by the run so far [s] */
    const void *study;   /* bookkeeping of the study; borrowed when writing, owned when read */
    size_t study_bytes;
    const void *image; /* scene_image's; borrowed when writing, owned when read */
    size_t image_bytes;
} checkpoint;

checkpoint_key run_checkpoint_key_of(const char *instruction_set, uint64_t inputs);

/* Atomic: an older checkpoint stays until the new one is complete. */
status run_checkpoint_write(const char *path, const checkpoint_key *key, const checkpoint *c);
status run_checkpoint_read(const char *path, const checkpoint_key *key, checkpoint *out);
void run_checkpoint_free(checkpoint *c); /* of one that was read */

#endif
