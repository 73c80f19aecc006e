/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_bodies.h"

#include "coupling/case/material_role.h"
#include "coupling/host/outdir.h"
#include "mpm/law/contact.h"
#include "mpm/read/probe.h"

#include <stdlib.h>
#include <string.h>

/* ---- the tables ---- */

static const char *const overlap_names[] = { [OVERLAP_REFUSED] = "refused", [OVERLAP_LATER] = "later", NULL };

/* The solver's own tables, from their first row that is a key; what is left out of an axis is chosen by scene_fill. */
static const base_param *const method_params = &mpm_scene_params[MPM_SCENE_KEYED];
static const base_param *const axis_params = &mpm_axis_params[MPM_AXIS_KEYED];
static const base_param *const body_params = &mpm_body_params[MPM_BODY_KEYED];
static const base_param *const cavity_params = &mpm_cavity_params[MPM_CAVITY_KEYED];

typedef struct {
    int overlap;
    double cell, coarse_cell, growth; /* of all axes that do not say it themselves; NAN: not given */
} shared_keys;

static const base_param shared_params[] = {
    PARAM_ENUM(shared_keys, overlap, overlap_names, OVERLAP_REFUSED,
               "bodies that overlap: refused, or the later one has what both claim"),
    PARAM_DOUBLE(
        shared_keys, cell, "m", OPTIONAL, 1e-9, 1e2,
        "smallest cells; not given: that of a rule of `refine`, else a twentieth of the smallest extent of any body"),
    PARAM_DOUBLE(shared_keys, coarse_cell, "m", OPTIONAL, 1e-9, 1e2,
                 "largest cells; not given: four times as large, eight times with `refine`"),
    PARAM_DOUBLE(shared_keys, growth, "1", OPTIONAL, 1.0, 2.0,
                 "ratio of neighbouring cells outside it; not given: 1.2"),
    PARAMS_END,
};

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
} probe_keys;

static const base_param probe_params[] = {
    PARAM_STRING(probe_keys, name, NULL, "its name: letters, digits, - _ ."),
    PARAMS_END,
};

static const base_param refine_params[] = {
    PARAM_DOUBLE(mpm_refine, cell, "m", 0.0, 0.0, 1e2,
                 "the smallest cells that the rule asks for; 0: the scene's `cell`"),
    PARAMS_END,
};

#define MANUAL(key_, table_, text)                                        \
    {                                                                     \
        .key = (key_), .doc = (text), .table = (table_), .given = NO_FLAG \
    }
static const base_param no_params[] = { PARAMS_END };

const case_section case_bodies_manual[] = {
    MANUAL("scene with bodies", &mpm_scene_params[MPM_SCENE_KEYED],
           "A scene of one's own: `scene` with `bodies` (scenes.md)."),
    MANUAL("scene with bodies, cells", shared_params, "Of the same section."),
    MANUAL("scene.bodies", &mpm_body_params[MPM_BODY_KEYED],
           "A list. Besides these keys: `material`; `shape`, a solid; `group`, any word: bodies of one group are "
           "welded, a "
           "body without one is a group by itself; `passes`, ends of the window whose boundary does not act on it."),
    MANUAL("scene.window", &mpm_axis_params[MPM_AXIS_KEYED],
           "`x`, `y` and `z`, each with these keys; what is left out follows from the bodies."),
    MANUAL("scene.boundary", no_params,
           "`x`, `y` and `z`, each a list of two, what acts at the window's lower end and at its upper one: `[free, "
           "symmetry]`. Kinds: `boundary: ..` below; an axis that is left out ends freely."),
    MANUAL("scene.contacts", no_params,
           "A list (scenes.md). `default: LAW` and the law's values hold for all groups that no pair names, `between: "
           "[a, b]`, `law: LAW` and its values for the groups of two bodies; there `normal_of` names the one whose "
           "surface gives the normal. Laws: `contact: ..` below."),
    MANUAL("scene.probes", probe_params,
           "A list. Besides its name one key, the kind of probe (below): its values and `body`, or the name of a body "
           "alone; without a body it reads all of them. `force_on: a` stands for `force: {body: a}`."),
    MANUAL("scene.refine", refine_params,
           "A list of rules that say where cells are small. Besides `cell` one key, the kind of rule (below), with the "
           "name of a body or `all`, and the kind's own keys."),
    MANUAL(
        "scene.cavities", &mpm_cavity_params[MPM_CAVITY_KEYED],
        "A list of voids between bodies that hold a gas (scenes.md). Besides these keys: `wall`, the body that holds "
        "it in: where its intact points no longer do, the cavity has burst."),
    { .key = NULL },
};

/* ---- names ---- */

const char *case_body_name(const void *scene, int i)
{
    const mpm_scene *s = scene;
    return i < s->bodies ? s->body[i].name : NULL;
}

static int find_body(const mpm_scene *s, const char *name)
{
    for (int i = 0; i < s->bodies; i++)
        if (strcmp(s->body[i].name, name) == 0) return i;
    return -1;
}

/* The body that a key names, -1 after an error. */
static int named_body(case_reader *r, const tree_node *map, const char *key, const char *path)
{
    const mpm_scene *s = &r->out->bodies.scene;
    const tree_node *node = host_tree_find(map, key);
    if (!node || node->kind != TREE_TEXT) {
        case_errors_add(r->errors, node ? node : map, "%s.%s must name a body", path, key);
        return -1;
    }
    const int body = find_body(s, node->text);
    if (body < 0) case_unknown_name(r, node, "body", path, case_body_name, s);
    return body;
}

static const char *text_of(const tree_node *map, const char *key)
{
    const tree_node *node = host_tree_find(map, key);
    return node && node->kind == TREE_TEXT ? node->text : "";
}

/* ---- bodies ---- */

/* Numbered as they are met; a body without one has its own. */
static int group_of(const mpm_scene *s, const tree_node *list, int k)
{
    const char *name = text_of(case_entry_node(list, k), "group");
    int next = 0;
    for (int i = 0; i < k; i++) {
        if (name[0] && strcmp(text_of(case_entry_node(list, i), "group"), name) == 0) return s->body[i].group;
        if (s->body[i].group >= next) next = s->body[i].group + 1;
    }
    return next;
}

static void read_passes(case_reader *r, const tree_node *node, const char *path, mpm_body *b)
{
    if (node->kind != TREE_LIST) {
        case_errors_add(r->errors, node, "%s.passes must be a list of ends of the window, such as [-x, +x]", path);
        return;
    }
    for (int i = 0; i < node->n; i++) {
        int face = 0;
        const char *text = node->item[i]->kind == TREE_TEXT ? node->item[i]->text : "";
        while (mpm_face_names[face] && strcmp(mpm_face_names[face], text) != 0) face++;
        if (mpm_face_names[face])
            b->passes[face] = true;
        else
            case_errors_add(r->errors, node->item[i], "%s.passes[%d] must be one of -x, +x, -y, +y, -z, +z", path, i);
    }
}

static void check_name(case_reader *r, const tree_node *map, const char *path, const mpm_body *b)
{
    const mpm_scene *s = &r->out->bodies.scene;
    const tree_node *node = host_tree_find(map, "name");
    if (!node || !b->name[0]) return; /* an error already */
    if (!host_name_is_plain(b->name))
        case_errors_add(r->errors, node, "%s.name = %s: letters, digits, - _ . only", path, b->name);
    for (int i = 0; &s->body[i] != b; i++)
        if (strcmp(s->body[i].name, b->name) == 0)
            case_errors_add(r->errors, node, "%s.name = %s: the same as scene.bodies[%d]", path, b->name, i);
}

static void read_body(case_reader *r, const tree_node *list, int k, const char *path)
{
    static const char *const others[] = { "material", "group", "shape", "passes", NULL };
    const tree_node *map = case_entry_node(list, k);
    mpm_scene *s = &r->out->bodies.scene;
    mpm_body *b;
    if (mpm_scene_add_body(s, &b).code != STATUS_OK) {
        r->out_of_memory = true;
        return;
    }
    const case_keys keys = { body_params, b };
    case_keys_read(r, map, path, &keys, 1, others);
    if (map->kind == TREE_TEXT && !host_tree_is_empty(map)) return; /* no section: that was said */
    check_name(r, map, path, b);
    b->group = group_of(s, list, k);
    const tree_node *metal = host_tree_find(map, "material"), *shape = host_tree_find(map, "shape");
    char inner[CASE_KEY_SIZE];
    snprintf(inner, sizeof inner, "%s.material", path);
    if (metal && metal->kind == TREE_TEXT && metal->text[0])
        case_note_material(r, metal->text, metal, inner);
    else
        case_errors_add(r->errors, metal ? metal : map, "%s is missing: name of a material", inner);
    snprintf(inner, sizeof inner, "%s.shape", path);
    if (shape)
        case_solid_read(r, shape, inner, s, &b->solid);
    else
        case_errors_add(r->errors, map, "%s is missing: the volume it fills", inner);
    const tree_node *passes = host_tree_find(map, "passes");
    if (passes) read_passes(r, passes, path, b);
}

static void read_bodies(case_reader *r, const tree_node *list)
{
    if (list->kind != TREE_LIST || list->n == 0) {
        case_errors_add(r->errors, list,
                        "scene.bodies must be a list of bodies, at least one; each begins with `- name: ..`");
        return;
    }
    for (int k = 0; k < list->n; k++) {
        char path[40];
        snprintf(path, sizeof path, "scene.bodies[%d]", k);
        read_body(r, list, k, path);
    }
}

static bool all_have_names(const mpm_scene *s)
{
    for (int b = 0; b < s->bodies; b++)
        if (!s->body[b].name[0]) return false;
    return s->bodies > 0;
}

/* ---- contacts ---- */

static const char *law_name(const void *user, int i)
{
    (void)user;
    const mpm_contact_law *law = mpm_contact_at(i);
    return law ? law->name : NULL;
}

/* By the law's own table; key: the one that names the law. */
static bool read_contact(case_reader *r, const tree_node *map, const char *key, const char *path, mpm_contact *out)
{
    static const char *const others[] = { "default", "between", "law", "normal_of", NULL };
    const tree_node *node = host_tree_find(map, key);
    if (!node || node->kind != TREE_TEXT) {
        case_errors_add(r->errors, node ? node : map, "%s.%s must name a law of contact, such as %s", path, key,
                        law_name(NULL, 0));
        return false;
    }
    const mpm_contact_law *law = mpm_contact_find(node->text);
    if (!law) {
        case_unknown_name(r, node, "law of contact", path, law_name, NULL);
        return false;
    }
    *out = mpm_contact_of(law);
    const case_keys keys = { law->params, out };
    case_keys_read(r, map, path, &keys, 1, others);
    return true;
}

static void read_pair(case_reader *r, const tree_node *map, const tree_node *between, const char *path)
{
    mpm_scene *s = &r->out->bodies.scene;
    int group[2];
    if (between->kind != TREE_LIST || between->n != 2) {
        case_errors_add(r->errors, between, "%s.between must name two bodies: [a, b]", path);
        return;
    }
    for (int i = 0; i < 2; i++) {
        const tree_node *node = between->item[i];
        const int body = node->kind == TREE_TEXT ? find_body(s, node->text) : -1;
        if (body < 0) {
            if (node->kind == TREE_TEXT) case_unknown_name(r, node, "body", path, case_body_name, s);
            return;
        }
        group[i] = s->body[body].group;
    }
    if (group[0] == group[1]) {
        case_errors_add(r->errors, between, "%s.between: both are of one group, which is welded", path);
        return;
    }
    mpm_pair *p;
    if (mpm_scene_add_pair(s, group[0], group[1], &p).code != STATUS_OK) {
        r->out_of_memory = true;
        return;
    }
    read_contact(r, map, "law", path, &p->contact);
    if (!host_tree_find(map, "normal_of")) return;
    const int body = named_body(r, map, "normal_of", path);
    if (body < 0) return;
    p->normal_of = s->body[body].group;
    if (p->normal_of != group[0] && p->normal_of != group[1])
        case_errors_add(r->errors, host_tree_find(map, "normal_of"), "%s.normal_of must be one of the two", path);
}

/* The default first, whatever its place in the list: pairs begin as it. */
static void read_contacts(case_reader *r, const tree_node *list)
{
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; case_entry_node(list, k); k++) {
            char path[CASE_KEY_SIZE];
            const tree_node *map = case_entry_node(list, k);
            const tree_node *between = host_tree_find(map, "between");
            snprintf(path, sizeof path, "scene.contacts[%d]", k);
            if (pass == 0 && !between) read_contact(r, map, "default", path, &r->out->bodies.scene.contact);
            if (pass == 1 && between) read_pair(r, map, between, path);
        }
}

/* ---- probes ---- */

static const char *probe_kind_name(const void *user, int i)
{
    (void)user;
    const mpm_probe_kind *k = mpm_probe_kind_at(i);
    return k ? k->name : NULL;
}

static void check_probe_name(case_reader *r, const tree_node *node, const char *path, const char *name)
{
    const mpm_scene *s = &r->out->bodies.scene;
    if (!name[0]) return; /* an error already */
    if (!host_name_is_plain(name))
        case_errors_add(r->errors, node, "%s.name = %s: letters, digits, - _ . only", path, name);
    for (int i = 0; i < s->probes; i++)
        if (strcmp(s->probe[i].name, name) == 0)
            case_errors_add(r->errors, node, "%s.name = %s: the same as scene.probes[%d]", path, name, i);
}

/* The only key beside the name; NULL after an error. */
static const mpm_probe_kind *read_probe_kind(case_reader *r, const tree_node *map, const char *path,
                                             const tree_node **value)
{
    const mpm_probe_kind *kind = NULL;
    for (int i = 0; map->kind == TREE_MAP && i < map->n; i++) {
        const char *key = map->key[i]->text;
        const mpm_probe_kind *found = mpm_probe_kind_find(strcmp(key, "force_on") == 0 ? "force" : key);
        if (strcmp(key, "name") == 0) continue;
        if (!found)
            case_unknown_name(r, map->key[i], "kind of probe", path, probe_kind_name, NULL);
        else if (kind)
            case_errors_add(r->errors, map->key[i], "%s is a probe of two kinds, %s and %s", path, kind->name, key);
        if (!found || kind) return NULL;
        kind = found;
        *value = map->item[i];
    }
    if (!kind)
        case_errors_add(r->errors, map, "%s must name a kind of probe, such as {name: push, force: {body: plate}}",
                        path);
    return kind;
}

/* Its values by the kind's own table; a text is the name of a body. */
static void read_probe_values(case_reader *r, const tree_node *value, const char *path, mpm_probe *p)
{
    static const char *const body[] = { "body", NULL };
    const mpm_scene *s = &r->out->bodies.scene;
    const int errors = r->errors->n;
    const case_keys keys = { p->kind->params, p->value };
    const bool name_alone = value->kind == TREE_TEXT && value->text[0];
    tree_node nothing = *value; /* its place, without its parts */
    nothing.kind = TREE_MAP, nothing.n = 0;
    case_keys_read(r, name_alone ? &nothing : value, path, &keys, 1, body);
    if (name_alone && (p->body = find_body(s, value->text)) < 0)
        case_unknown_name(r, value, "body", path, case_body_name, s);
    if (!name_alone && host_tree_find(value, "body")) p->body = named_body(r, value, "body", path);
    if (r->errors->n > errors) return;
    if (p->kind->of_body && p->body < 0) case_errors_add(r->errors, value, "%s.body must name a body", path);
    const status fits = p->kind->check ? p->kind->check(p, path) : status_ok();
    if (fits.code != STATUS_OK) case_errors_add(r->errors, value, "%.400s", fits.text);
}

static void read_probe(case_reader *r, const tree_node *list, int k)
{
    char path[40], inner[CASE_KEY_SIZE];
    const tree_node *map = case_entry_node(list, k), *value = NULL, *name = host_tree_find(map, "name");
    mpm_probe *p;
    snprintf(path, sizeof path, "scene.probes[%d]", k);
    const mpm_probe_kind *kind = read_probe_kind(r, map, path, &value);
    if (!kind) return;
    snprintf(inner, sizeof inner, "%s.name", path);
    probe_keys keys = { .name = "" };
    if (name)
        case_value_read(r, probe_params, name, keys.name, inner);
    else
        case_errors_add(r->errors, map, "%s is missing: %s", inner, probe_params[0].doc);
    check_probe_name(r, name, path, keys.name);
    if (mpm_scene_add_probe(&r->out->bodies.scene, kind->name, keys.name, &p).code != STATUS_OK) {
        r->out_of_memory = true;
        return;
    }
    snprintf(inner, sizeof inner, "%s.%s", path, kind->name);
    read_probe_values(r, value, inner, p);
}

/* ---- the window ---- */

static void read_window(case_reader *r, const tree_node *window)
{
    static const char *const none[] = { NULL };
    mpm_scene *s = &r->out->bodies.scene;
    if (window) case_keys_read(r, window, "scene.window", NULL, 0, mpm_axis_names);
    for (int k = 0; k < 3; k++) {
        char path[CASE_KEY_SIZE];
        const tree_node *map = host_tree_find(window, mpm_axis_names[k]);
        const case_keys keys = { axis_params, &s->axis[k] };
        snprintf(path, sizeof path, "scene.window.%s", mpm_axis_names[k]);
        if (map)
            case_keys_read(r, map, path, &keys, 1, none);
        else
            base_params_default(axis_params, &s->axis[k]);
    }
}

/* One end of the window: the name of a boundary, or {prescribed: velocity}. */
static void read_end(case_reader *r, const tree_node *node, const char *path, mpm_axis *a, int end)
{
    static const base_param velocity[] = { { .key = "prescribed",
                                             .unit = "m/s",
                                             .doc = "velocity",
                                             .fallback = REQUIRED,
                                             .min = -1e5,
                                             .max = 1e5,
                                             .kind = BASE_PARAM_VECTOR },
                                           PARAMS_END };
    static const char *const none[] = { NULL };
    if (node->kind == TREE_MAP) {
        const case_keys keys = { velocity, a->boundary_velocity[end] };
        case_keys_read(r, node, path, &keys, 1, none);
        a->boundary[end] = MPM_BOUNDARY_PRESCRIBED;
        return;
    }
    int kind = 0, n = 0;
    char names[300] = "";
    const char *text = node->kind == TREE_TEXT ? node->text : "";
    while (kind < MPM_BOUNDARIES && (kind == MPM_BOUNDARY_PRESCRIBED || strcmp(mpm_boundary_names[kind], text) != 0))
        kind++;
    if (kind < MPM_BOUNDARIES) {
        a->boundary[end] = (mpm_boundary_kind)kind;
        return;
    }
    for (int k = 0; k < MPM_BOUNDARIES; k++)
        if (k != MPM_BOUNDARY_PRESCRIBED)
            n += snprintf(names + n, sizeof names - (size_t)n, "%s, ", mpm_boundary_names[k]);
    case_errors_add(r->errors, node, "%s = %.*s: must be one of %sor {prescribed: 3 0 0 m/s}", path, CASE_SHOWN, text,
                    names);
}

static void read_boundary(case_reader *r, const tree_node *map)
{
    case_keys_read(r, map, "scene.boundary", NULL, 0, mpm_axis_names);
    for (int k = 0; k < 3; k++) {
        const tree_node *ends = host_tree_find(map, mpm_axis_names[k]);
        if (!ends) continue;
        if (ends->kind != TREE_LIST || ends->n != 2) {
            case_errors_add(r->errors, ends,
                            "scene.boundary.%s must be two boundaries, at the lower and at the upper "
                            "end: [free, symmetry]",
                            mpm_axis_names[k]);
            continue;
        }
        for (int e = 0; e < 2; e++) {
            char path[CASE_KEY_SIZE];
            snprintf(path, sizeof path, "scene.boundary.%s[%d]", mpm_axis_names[k], e);
            read_end(r, ends->item[e], path, &r->out->bodies.scene.axis[k], e);
        }
    }
}

/* Gas between bodies; its wall is a body. */
static void read_cavity(case_reader *r, const tree_node *map, int k)
{
    static const char *const others[] = { "wall", NULL };
    mpm_scene *s = &r->out->bodies.scene;
    char path[CASE_KEY_SIZE];
    mpm_cavity *c;
    snprintf(path, sizeof path, "scene.cavities[%d]", k);
    if (mpm_scene_add_cavity(s, "", &c).code != STATUS_OK) {
        r->out_of_memory = true;
        return;
    }
    const case_keys keys = { cavity_params, c };
    case_keys_read(r, map, path, &keys, 1, others);
    if (host_tree_find(map, "wall")) c->wall = named_body(r, map, "wall", path);
}

static const char *refine_kind_name(const void *user, int i)
{
    (void)user;
    const mpm_refine_kind *k = mpm_refine_kind_at(i);
    return k ? k->name : NULL;
}

/* The first key that is a kind of rule; NULL after an error. */
static const mpm_refine_kind *read_refine_kind(case_reader *r, const tree_node *map, const char *path)
{
    for (int i = 0; map->kind == TREE_MAP && i < map->n; i++) {
        const mpm_refine_kind *kind = mpm_refine_kind_find(map->key[i]->text);
        if (kind) return kind;
    }
    if (map->kind == TREE_MAP && map->n > 0 && strcmp(map->key[0]->text, "cell") != 0)
        case_unknown_name(r, map->key[0], "rule of refinement", path, refine_kind_name, NULL);
    else
        case_errors_add(r->errors, map, "%s must name a rule, such as {around: ball, within: 1 mm, cell: 0.1 mm}",
                        path);
    return NULL;
}

static void read_refine(case_reader *r, const tree_node *map, int k)
{
    mpm_scene *s = &r->out->bodies.scene;
    char path[CASE_KEY_SIZE];
    mpm_refine *rule;
    snprintf(path, sizeof path, "scene.refine[%d]", k);
    const mpm_refine_kind *kind = read_refine_kind(r, map, path);
    if (!kind) return;
    if (mpm_scene_add_refine(s, kind->name, &rule).code != STATUS_OK) {
        r->out_of_memory = true;
        return;
    }
    const char *const others[] = { kind->name, NULL };
    const case_keys keys[] = { { kind->params, rule->value }, { refine_params, rule } };
    case_keys_read(r, map, path, keys, 2, others);
    if (strcmp(text_of(map, kind->name), "all") != 0)
        rule->body = named_body(r, map, kind->name, path);
    else if (kind->of_body)
        case_errors_add(r->errors, host_tree_find(map, kind->name), "%s.%s must name a body", path, kind->name);
}

/* The smallest cells that any rule of refinement asks for; NAN: none says. */
static double cell_of_rules(const mpm_scene *s)
{
    double least = NAN;
    for (int i = 0; i < s->refines; i++)
        if (s->refine[i].cell > 0.0) least = fmin(least, s->refine[i].cell);
    return least;
}

/* What is said once for all axes; an axis's own value goes first, a rule's cells come last. */
static void share(const shared_keys *keys, mpm_scene *s)
{
    const double cell = isnan(keys->cell) ? cell_of_rules(s) : keys->cell;
    for (int k = 0; k < 3; k++) {
        mpm_axis *a = &s->axis[k];
        if (isnan(a->fine)) a->fine = cell;
        if (isnan(a->coarse)) a->coarse = keys->coarse_cell;
        if (isnan(a->growth)) a->growth = keys->growth;
    }
}

/* ---- the section ---- */

void case_bodies_read(case_reader *r)
{
    static const char *const others[] = { "bodies", "contacts", "refine", "cavities",
                                          "window", "boundary", "probes", NULL };
    const tree_node *scene = host_tree_find(r->root, "scene"), *bodies = host_tree_find(scene, "bodies");
    mpm_scene *s = &r->out->bodies.scene;
    shared_keys shared;
    if (!bodies) return;
    r->out->given.bodies = true;
    if (r->options->needs & (CASE_FOR_ONSET | CASE_FOR_COMPARE))
        case_errors_add(r->errors, bodies,
                        "scene.bodies: a study makes its scenes from rail, armature and grains; "
                        "`breech scene` runs this one");
    mpm_scene_default(s);
    const case_keys keys[] = { { method_params, s }, { shared_params, &shared } };
    case_keys_read(r, scene, "scene", keys, 2, others);
    if (!host_tree_find(scene, "end_time") && !host_tree_find(host_tree_find(r->root, "strike"), "travel"))
        case_errors_add(r->errors, scene, "scene.end_time is missing [s]: time that is simulated");
    r->out->bodies.overlap = shared.overlap;
    read_window(r, host_tree_find(scene, "window"));
    if (host_tree_find(scene, "boundary")) read_boundary(r, host_tree_find(scene, "boundary"));
    const int errors = r->errors->n;
    read_bodies(r, bodies);
    if (!all_have_names(s)) return; /* what follows names bodies */
    if (r->errors->n == errors && shared.overlap == OVERLAP_REFUSED) case_overlap_check(r, bodies);
    if (host_tree_find(scene, "contacts")) read_contacts(r, host_tree_find(scene, "contacts"));
    for (int k = 0; case_entry_node(host_tree_find(scene, "probes"), k); k++)
        read_probe(r, host_tree_find(scene, "probes"), k);
    for (int k = 0; case_entry_node(host_tree_find(scene, "refine"), k); k++)
        read_refine(r, case_entry_node(host_tree_find(scene, "refine"), k), k);
    for (int k = 0; case_entry_node(host_tree_find(scene, "cavities"), k); k++)
        read_cavity(r, case_entry_node(host_tree_find(scene, "cavities"), k), k);
    share(&shared, s);
}

void case_bodies_resolve(case_reader *r)
{
    const tree_node *list = host_tree_find(host_tree_find(r->root, "scene"), "bodies");
    mpm_scene *s = &r->out->bodies.scene;
    for (int k = 0; k < s->bodies; k++) {
        mpm_body *b = &s->body[k];
        const tree_node *node = host_tree_find(case_entry_node(list, k), "material");
        b->material = case_material(&r->out->materials, text_of(case_entry_node(list, k), "material"));
        if (!b->material) continue; /* an error already */
        const status enough = mpm_material_check(b->material, case_material_needs(b->damage, false));
        const bool failure = b->damage && mpm_material_check(b->material, MPM_MATERIAL_FOR_SCENE).code == STATUS_OK;
        if (enough.code != STATUS_OK)
            case_errors_add(r->errors, node, "scene.bodies[%d].material = %s: %.400s%s", k, b->material->name,
                            enough.text, failure ? " (or set damage: no)" : "");
    }
    const unsigned scenes = CASE_FOR_BODIES | CASE_FOR_STRIKE | CASE_FOR_TARGETS;
    if (r->out->given.bodies && r->options->needs & scenes && r->errors->n == 0) case_refused_check(r);
}

/* ---- writing ---- */

static void write_body(const mpm_scene *s, const mpm_body *b, FILE *file)
{
    fputs("    - {", file);
    case_keys_write(body_params, b, true, file);
    fprintf(file, ",\n       material: %s, group: %d", b->material->name, b->group);
    bool first = true;
    for (int face = 0; mpm_face_names[face]; face++) {
        if (!b->passes[face]) continue;
        fprintf(file, "%s%s", first ? ", passes: [" : ", ", mpm_face_names[face]);
        first = false;
    }
    fprintf(file, "%s,\n       shape: ", first ? "" : "]");
    case_solid_write(&s->solid[b->solid], file);
    fputs("}\n", file);
}

static int first_of(const mpm_scene *s, int group)
{
    int i = 0;
    while (i < s->bodies - 1 && s->body[i].group != group) i++;
    return i;
}

static void write_contact(const mpm_contact *c, FILE *file)
{
    fputs(c->law->name, file);
    case_keys_write(c->law->params, c, false, file);
    fputs("}\n", file);
}

static void write_contacts(const mpm_scene *s, FILE *file)
{
    fputs("  contacts:\n    - {default: ", file);
    write_contact(&s->contact, file);
    for (int i = 0; i < s->pairs; i++) {
        const mpm_pair *p = &s->pair[i];
        fprintf(file, "    - {between: [%s, %s], normal_of: %s, law: ", s->body[first_of(s, p->a)].name,
                s->body[first_of(s, p->b)].name, s->body[first_of(s, p->normal_of)].name);
        write_contact(&p->contact, file);
    }
}

static void write_window(const mpm_scene *s, FILE *file)
{
    static const base_param velocity = { .unit = "m/s", .kind = BASE_PARAM_VECTOR };
    fputs("  window:\n", file);
    for (int k = 0; k < 3; k++) {
        fprintf(file, "    %s: {", mpm_axis_names[k]);
        case_keys_write(axis_params, &s->axis[k], true, file);
        fputs("}\n", file);
    }
    fputs("  boundary:\n", file);
    for (int k = 0; k < 3; k++) {
        const mpm_axis *a = &s->axis[k];
        fprintf(file, "    %s: [", mpm_axis_names[k]);
        for (int e = 0; e < 2; e++) {
            const bool moved = a->boundary[e] == MPM_BOUNDARY_PRESCRIBED;
            fprintf(file, "%s%s%s", e ? ", " : "", moved ? "{" : "", mpm_boundary_names[a->boundary[e]]);
            if (!moved) continue;
            fputs(": ", file);
            case_value_write(&velocity, a->boundary_velocity[e], file);
            fputc('}', file);
        }
        fputs("]\n", file);
    }
}

static void write_probe(const mpm_scene *s, const mpm_probe *p, FILE *file)
{
    fprintf(file, "    - {name: %s, %s: {", p->name, p->kind->name);
    if (p->body >= 0) fprintf(file, "body: %s", s->body[p->body].name);
    case_keys_write(p->kind->params, p->value, p->body < 0, file);
    fputs("}}\n", file);
}

static void write_refine(const mpm_scene *s, const mpm_refine *r, FILE *file)
{
    fprintf(file, "    - {%s: %s", r->kind->name, r->body < 0 ? "all" : s->body[r->body].name);
    case_keys_write(r->kind->params, r->value, false, file);
    case_keys_write(refine_params, r, false, file);
    fputs("}\n", file);
}

static void write_cavity(const mpm_scene *s, const mpm_cavity *c, FILE *file)
{
    fputs("    - {", file);
    case_keys_write(cavity_params, c, true, file);
    if (c->wall >= 0) fprintf(file, ", wall: %s", s->body[c->wall].name);
    fputs("}\n", file);
}

void case_bodies_write(const case_bodies *b, FILE *file)
{
    const mpm_scene *s = &b->scene;
    fputs("scene:\n", file);
    for (const base_param *p = method_params; p->key; p++) {
        if (!case_value_is_set(p, (const char *)s + p->offset)) continue;
        fprintf(file, "  %s: ", p->key);
        case_value_write(p, (const char *)s + p->offset, file);
        fputc('\n', file);
    }
    fprintf(file, "  overlap: %s\n", overlap_names[b->overlap]);
    write_window(s, file);
    fputs("  bodies:\n", file);
    for (int i = 0; i < s->bodies; i++) write_body(s, &s->body[i], file);
    write_contacts(s, file);
    if (s->refines > 0) fputs("  refine:\n", file);
    for (int i = 0; i < s->refines; i++) write_refine(s, &s->refine[i], file);
    if (s->cavities > 0) fputs("  cavities:\n", file);
    for (int i = 0; i < s->cavities; i++) write_cavity(s, &s->cavity[i], file);
    if (s->probes > 0) fputs("  probes:\n", file);
    for (int i = 0; i < s->probes; i++) write_probe(s, &s->probe[i], file);
}
