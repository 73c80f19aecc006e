#include "coupling/run/scene_key.h"

#include "coupling/output/summary.h"
#include "coupling/run/checkpoint.h"
#include "coupling/run/solver_id.h" /* made by cmake/solver_id.cmake */

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool names_material(const breech_case *c, const char *name)
{
    for (int i = 0; i < c->rail.layers.n; i++)
        if (strcmp(c->rail.layers.item[i].material, name) == 0) return true;
    return strcmp(c->rail.material, name) == 0 || strcmp(c->projectile.material, name) == 0 ||
           strcmp(c->particle.material, name) == 0;
}

/* By name, so that the order in which the case came upon them does not count. */
static int by_name(const void *a, const void *b)
{
    return strcmp(((const material *)a)->name, ((const material *)b)->name);
}

static status keep_named_materials(breech_case *one, const case_materials *all)
{
    one->materials.n = 0;
    one->materials.item = calloc((size_t)all->n + 1, sizeof *one->materials.item);
    CHECK(one->materials.item, STATUS_MEMORY, "no memory for %d materials", all->n);
    for (int i = 0; i < all->n; i++)
        if (names_material(one, all->item[i].name)) one->materials.item[one->materials.n++] = all->item[i];
    qsort(one->materials.item, (size_t)one->materials.n, sizeof *one->materials.item, by_name);
    return status_ok();
}

/* A copy that borrows what c owns, but for the materials. */
static status case_of_scene(const breech_case *c, const site_state *state, double cells_per_radius, breech_case *one)
{
    const case_site *g = &state->grain;
    *one = *c;
    snprintf(one->name, sizeof one->name, "scene");
    one->title[0] = '\0';
    one->particle = (case_particle){ .radius = g->radius, .height = g->height, .bond_strength = g->bond_strength };
    memcpy(one->particle.shape, g->shape, sizeof g->shape);
    memcpy(one->particle.material, g->material, sizeof g->material);
    one->scene.velocity = state->velocity;
    one->scene.contact_pressure = state->contact_pressure;
    one->scene.cells_per_radius = cells_per_radius;
    one->output = (case_output){
        .snapshots = c->output.snapshots, .history_interval = NAN, .checkpoint_interval = 60.0, .report = false
    };
    one->given = (case_given){ .rail = true, .projectile = true, .particle = true, .scene = true, .output = true };
    return keep_named_materials(one, &c->materials);
}

static uint64_t hash_of(const char *text, size_t bytes)
{
    const uint64_t inputs =
        host_hash_bytes(host_hash_bytes(0, BREECH_SOLVER_ID, strlen(BREECH_SOLVER_ID)), text, bytes);
    const checkpoint_key who = run_checkpoint_key_of(mpm_instruction_set(), inputs);
    return host_hash_bytes(0, &who, sizeof who);
}

status run_scene_key_of(const breech_case *c, const site_state *state, double cells_per_radius, scene_key *out)
{
    breech_case one;
    *out = (scene_key){ .text = NULL };
    status done = case_of_scene(c, state, cells_per_radius, &one);
    FILE *f = done.code == STATUS_OK ? open_memstream(&out->text, &out->bytes) : NULL;
    if (f) {
        done = case_write_used(&one, f);
        if (fclose(f) != 0 && done.code == STATUS_OK)
            done = base_status_error(STATUS_MEMORY, "no memory for a scene's key");
        out->hash = hash_of(out->text, out->bytes);
    } else if (done.code == STATUS_OK) {
        done = base_status_error(STATUS_MEMORY, "no memory for a scene's key");
    }
    free(one.materials.item);
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
