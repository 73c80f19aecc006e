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

status run_scene_key_of(const case_impact *one, scene_key *out)
{
    *out = (scene_key){ .text = NULL };
    FILE *f = open_memstream(&out->text, &out->bytes);
    CHECK(f, STATUS_MEMORY, "no memory for a scene's key");
    status done = case_impact_write(one, f);
    if (fclose(f) != 0 && done.code == STATUS_OK)
        done = base_status_error(STATUS_MEMORY, "no memory for a scene's key");
    if (done.code == STATUS_OK) out->hash = hash_of(out->text, out->bytes);
    return done;
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
