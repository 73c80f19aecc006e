/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/scene_key.h"

#include "coupling/host/hash.h"
#include "coupling/host/version.h"
#include "coupling/run/solver_id.h" /* made by cmake/solver_id.cmake */
#include "mpm/mpm.h"

#include <stdlib.h>
#include <string.h>

/* Of the version, the instruction set, and the inputs with the solver's id.  The bytes hashed are those of all versions
 * so far: else no scene that was stored before is found again. */
static uint64_t hash_of(const char *text, size_t bytes)
{
    const uint64_t inputs =
        host_hash_bytes(host_hash_bytes(0, BREECH_SOLVER_ID, strlen(BREECH_SOLVER_ID)), text, bytes);
    enum { TEXT = 32 };
    char who[2 * TEXT + sizeof inputs] = { 0 };
    snprintf(who, TEXT, "%s", host_version());
    snprintf(who + TEXT, TEXT, "%s", mpm_instruction_set());
    memcpy(who + 2 * (size_t)TEXT, &inputs, sizeof inputs);
    return host_hash_bytes(0, who, sizeof who);
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
