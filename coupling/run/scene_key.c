/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/scene_key.h"

#include "coupling/run/checkpoint.h"
#include "coupling/run/solver_id.h" /* made by cmake/solver_id.cmake */
#include "mpm/mpm.h"

#include <stdlib.h>
#include <string.h>

static uint64_t hash_of(const char *text, size_t bytes)
{
    const uint64_t inputs =
        host_hash_bytes(host_hash_bytes(0, BREECH_SOLVER_ID, strlen(BREECH_SOLVER_ID)), text, bytes);
    const checkpoint_key who = run_checkpoint_key_of(mpm_instruction_set(), inputs);
    return host_hash_bytes(0, &who, sizeof who);
}

static status key_of(const case_impact *impact, const case_body_scene *bodies, scene_key *out)
{
    *out = (scene_key){ .text = NULL };
    FILE *f = open_memstream(&out->text, &out->bytes);
    CHECK(f, STATUS_MEMORY, "no memory for a scene's key");
    status done = impact ? case_impact_write(impact, f) : case_body_scene_write(bodies, f);
    if (fclose(f) != 0 && done.code == STATUS_OK)
        done = base_status_error(STATUS_MEMORY, "no memory for a scene's key");
    if (done.code == STATUS_OK) out->hash = hash_of(out->text, out->bytes);
    return done;
}

status run_scene_key_of(const case_impact *one, scene_key *out)
{
    return key_of(one, NULL, out);
}

status run_scene_key_of_bodies(const case_body_scene *one, scene_key *out)
{
    return key_of(NULL, one, out);
}

void run_scene_key_free(scene_key *k)
{
    free(k->text);
    *k = (scene_key){ .text = NULL };
}

const char *run_solver_id(void)
{
    return BREECH_SOLVER_ID;
}
