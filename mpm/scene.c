/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/scene.h"

#include "mpm/law/contact.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void mpm_scene_default(mpm_scene *s)
{
    memset(s, 0, sizeof *s);
    s->contact = mpm_contact_of(mpm_contact_find("coulomb"));
    base_params_default(mpm_scene_params, s);
}

/* Room for one more element behind n; the memory is a power of two of them, so n says when it is full. */
static status grow(void **array, int n, size_t size)
{
    if (n & (n - 1)) return status_ok(); /* n is no power of two, nor 0 */
    void *more = realloc(*array, (n ? 2 * (size_t)n : 1) * size);
    CHECK(more, STATUS_MEMORY, "no memory for a scene of more than %d bodies, solids, pairs or probes", n);
    *array = more;
    return status_ok();
}

status mpm_scene_add_body(mpm_scene *s, mpm_body **added)
{
    void *array = s->body;
    TRY(grow(&array, s->bodies, sizeof *s->body));
    s->body = array;
    *added = &s->body[s->bodies++];
    memset(*added, 0, sizeof **added);
    base_params_default(mpm_body_params, *added);
    return status_ok();
}

status mpm_scene_add_solid(mpm_scene *s, const char *kind, int a, int b, mpm_solid **added)
{
    void *array = s->solid;
    const int part[MPM_SOLID_PARTS] = { a, b };
    const mpm_solid_kind *k = mpm_solid_kind_find(kind);
    CHECK(k, STATUS_BAD_INPUT, "`%s` is no kind of solid", kind);
    TRY(grow(&array, s->solids, sizeof *s->solid));
    s->solid = array;
    *added = &s->solid[s->solids];
    **added = mpm_solid_make(k);
    for (int i = 0; i < MPM_SOLID_PARTS; i++)
        if (part[i] >= 0) (*added)->part[i] = s->solids - part[i];
    s->solids++;
    return status_ok();
}

status mpm_scene_add_probe(mpm_scene *s, const char *kind, const char *name, mpm_probe **added)
{
    void *array = s->probe;
    const mpm_probe_kind *k = mpm_probe_kind_find(kind);
    CHECK(k, STATUS_BAD_INPUT, "probe `%s`: `%s` is no kind of probe", name, kind);
    TRY(grow(&array, s->probes, sizeof *s->probe));
    s->probe = array;
    *added = &s->probe[s->probes++];
    **added = mpm_probe_make(k, name);
    return status_ok();
}

status mpm_scene_add_refine(mpm_scene *s, const char *kind, mpm_refine **added)
{
    void *array = s->refine;
    const mpm_refine_kind *k = mpm_refine_kind_find(kind);
    CHECK(k, STATUS_BAD_INPUT, "refine: `%s` is no kind of rule", kind);
    TRY(grow(&array, s->refines, sizeof *s->refine));
    s->refine = array;
    *added = &s->refine[s->refines++];
    **added = mpm_refine_make(k);
    return status_ok();
}

status mpm_scene_add_cavity(mpm_scene *s, const char *name, mpm_cavity **added)
{
    void *array = s->cavity;
    TRY(grow(&array, s->cavities, sizeof *s->cavity));
    s->cavity = array;
    *added = &s->cavity[s->cavities++];
    memset(*added, 0, sizeof **added);
    base_params_default(mpm_cavity_params, *added);
    snprintf((*added)->name, sizeof(*added)->name, "%s", name);
    return status_ok();
}

status mpm_scene_add_pair(mpm_scene *s, int a, int b, mpm_pair **added)
{
    void *array = s->pair;
    const mpm_pair pair = mpm_scene_contact(s, a, b);
    TRY(grow(&array, s->pairs, sizeof *s->pair));
    s->pair = array;
    *added = &s->pair[s->pairs++];
    **added = pair;
    return status_ok();
}

mpm_pair mpm_scene_contact(const mpm_scene *s, int a, int b)
{
    for (int i = 0; i < s->pairs; i++) {
        const mpm_pair *p = &s->pair[i];
        if ((p->a == a && p->b == b) || (p->a == b && p->b == a)) return *p;
    }
    return (mpm_pair){ .a = a, .b = b, .contact = s->contact, .normal_of = a < b ? a : b };
}

int mpm_scene_groups(const mpm_scene *s)
{
    int groups = 0;
    for (int i = 0; i < s->bodies; i++)
        if (s->body[i].group >= groups) groups = s->body[i].group + 1;
    return groups;
}

static const double ALWAYS = 1e6; /* [s] */

/* Do the axes' largest cells have room for cells so many times the smallest? */
static bool is_room_for(const mpm_scene *s, int times)
{
    for (int k = 0; k < 3; k++)
        if (s->axis[k].fine * times > s->axis[k].coarse * (1.0 + 1e-9)) return false;
    return true;
}

void mpm_scene_levels_fill(mpm_scene *s)
{
    if (isnan(s->zone_until)) s->zone_until = s->refines > 0 ? 0.0 : ALWAYS;
    if (s->levels > 0) return;
    s->levels = 1;
    if (s->refines == 0 || s->basis != MPM_BASIS_GIMP) return;
    while (s->levels < MPM_MAX_LEVELS && is_room_for(s, 1 << s->levels)) s->levels++;
}

static status duplicate(const void *from, int n, size_t size, void **to)
{
    size_t room = 1;
    while (room < (size_t)n) room *= 2; /* as grow has it */
    *to = NULL;
    if (n == 0) return status_ok();
    *to = malloc(room * size);
    CHECK(*to, STATUS_MEMORY, "no memory for a copy of a scene");
    memcpy(*to, from, (size_t)n * size);
    return status_ok();
}

status mpm_scene_copy(const mpm_scene *from, mpm_scene *to)
{
    void *body = NULL, *solid = NULL, *pair = NULL, *probe = NULL, *refine = NULL, *cavity = NULL;
    status s = duplicate(from->body, from->bodies, sizeof *from->body, &body);
    if (s.code == STATUS_OK) s = duplicate(from->solid, from->solids, sizeof *from->solid, &solid);
    if (s.code == STATUS_OK) s = duplicate(from->pair, from->pairs, sizeof *from->pair, &pair);
    if (s.code == STATUS_OK) s = duplicate(from->probe, from->probes, sizeof *from->probe, &probe);
    if (s.code == STATUS_OK) s = duplicate(from->refine, from->refines, sizeof *from->refine, &refine);
    if (s.code == STATUS_OK) s = duplicate(from->cavity, from->cavities, sizeof *from->cavity, &cavity);
    if (s.code != STATUS_OK) {
        free(body), free(solid), free(pair), free(probe), free(refine);
        return s;
    }
    *to = *from;
    to->body = body, to->solid = solid, to->pair = pair, to->probe = probe, to->refine = refine, to->cavity = cavity;
    return s;
}

void mpm_scene_free(mpm_scene *s)
{
    free(s->body);
    free(s->solid);
    free(s->pair);
    free(s->probe);
    free(s->refine);
    free(s->cavity);
    memset(s, 0, sizeof *s);
}
