/* SPDX-License-Identifier: BSD-3-Clause */
/* Names of sections and keys that this version still reads under their old name, with a warning that says the new one.
 *
 * To rename a key: a line below; take it out again one version later. */
#include "coupling/case/case_reader.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *section, *key;       /* as it was; key NULL: the whole section */
    const char *to_section, *to_key; /* as it is now; both NULL: nothing reads it any more */
    const char *beside; /* the old meaning holds only in a file that has this old section too; NULL: always */
} old_name;

/* Keys first: a section is renamed once its keys have their new names. */
static const old_name old_names[] = {
    { "rails", "temperature", "rail", "initial_temperature", NULL },
    { "armature", "temperature", "armature", "initial_temperature", "projectile" },
    { "armature", "leg_thickness", "armature", "wear_thickness", "projectile" },
    { "rails", NULL, "rail", NULL, NULL },
    { "projectile", NULL, "armature", NULL, NULL },
    { "study", "screen_high", NULL, NULL, NULL },
    { "scene", "fine_ahead", NULL, NULL, NULL },
    { "scene", "fine_behind", NULL, NULL, NULL },
    { "scene", "fine_above", NULL, NULL, NULL },
    { "scene", "fine_depth", NULL, NULL, NULL },
    { "scene", "fine_width", NULL, NULL, NULL },
    { "scene", "follow_lead", NULL, NULL, NULL },
};
enum { OLD_NAMES = sizeof old_names / sizeof old_names[0] };

static void path_text(const char *section, const char *key, char out[CASE_KEY_SIZE])
{
    snprintf(out, CASE_KEY_SIZE, "%s%s%s", section, key ? "." : "", key ? key : "");
}

/* `where` in words: a place in a file or a --set. */
static void warn(case_reader *r, const old_name *o, const char *where)
{
    char was[CASE_KEY_SIZE], now[CASE_KEY_SIZE], line[4 * CASE_KEY_SIZE + CASE_PATH_SIZE];
    path_text(o->section, o->key, was);
    if (!o->to_section) {
        snprintf(line, sizeof line, "%s: `%s` is no longer read by anything: leave it out", where, was);
    } else {
        path_text(o->to_section, o->key ? o->to_key : NULL, now);
        snprintf(line, sizeof line, "%s: `%s` is now `%s`; the next version no longer reads the old name", where, was,
                 now);
    }
    case_warn(r, line);
}

enum { PLACE_SIZE = CASE_PATH_SIZE + 40 };

static void place_of(const case_reader *r, const tree_node *node, char where[PLACE_SIZE])
{
    snprintf(where, PLACE_SIZE, "%s:%d:%d", r->file[node->file], node->line, node->column);
}

static void warn_at(case_reader *r, const old_name *o, const tree_node *node)
{
    char where[PLACE_SIZE];
    place_of(r, node, where);
    warn(r, o, where);
}

static tree_node *key_node(const tree_node *map, const char *key)
{
    for (int k = 0; map->kind == TREE_MAP && k < map->n; k++)
        if (strcmp(map->key[k]->text, key) == 0) return map->key[k];
    return NULL;
}

/* A key's new text; the old one is freed. */
static status retitle(tree_node *key, const char *text)
{
    char *copy = strdup(text);
    CHECK(copy, STATUS_MEMORY, "out of memory while reading a case");
    free(key->text);
    key->text = copy;
    return status_ok();
}

/* In one map: the key gets its new name, or, where the map has that already, goes into its value. */
static status rename_in(tree_node *map, const char *from, const char *to)
{
    tree_node *now = key_node(map, to);
    if (!now) return retitle(key_node(map, from), to);
    tree_node *changes = host_tree_take(map, from);
    for (int k = 0; k < map->n; k++)
        if (map->key[k] == now) return host_tree_merge(&map->item[k], changes);
    return status_ok();
}

static status apply(case_reader *r, const old_name *o, tree_node *root)
{
    tree_node *section = key_node(root, o->section);
    if (!section || (o->beside && !key_node(root, o->beside))) return status_ok();
    if (!o->key) {
        warn_at(r, o, section);
        return rename_in(root, o->section, o->to_section);
    }
    for (int k = 0; k < root->n; k++) {
        tree_node *key = root->key[k] == section ? key_node(root->item[k], o->key) : NULL;
        if (!key) continue;
        warn_at(r, o, key);
        if (o->to_key) return rename_in(root->item[k], o->key, o->to_key);
        host_tree_free(host_tree_take(root->item[k], o->key));
    }
    return status_ok();
}

status case_old_names(case_reader *r, tree_node *root)
{
    for (int i = 0; i < OLD_NAMES; i++) TRY(apply(r, &old_names[i], root));
    return status_ok();
}

/* Length of the path in the assignment that this name matches; 0: none. */
static size_t match(const old_name *o, const char *assignment)
{
    char path[CASE_KEY_SIZE];
    path_text(o->section, o->key, path);
    const size_t n = strlen(path);
    return strncmp(assignment, path, n) == 0 && strchr(".[=", assignment[n]) && assignment[n] ? n : 0;
}

status case_old_name_of_set(case_reader *r, const char *assignment, char **now)
{
    const size_t size = strlen(assignment) + CASE_KEY_SIZE;
    *now = malloc(size);
    CHECK(*now, STATUS_MEMORY, "out of memory while reading --set");
    snprintf(*now, size, "%s", assignment);
    for (int i = 0; i < OLD_NAMES; i++) {
        const old_name *o = &old_names[i];
        const size_t n = o->beside ? 0 : match(o, assignment);
        char path[CASE_KEY_SIZE], where[CASE_KEY_SIZE];
        if (n == 0) continue;
        snprintf(where, sizeof where, "--set %.120s", assignment);
        warn(r, o, where);
        (*now)[0] = '\0';
        if (!o->to_section) return status_ok();
        path_text(o->to_section, o->key ? o->to_key : NULL, path);
        snprintf(*now, size, "%s%s", path, assignment + n);
        return status_ok();
    }
    return status_ok();
}

/* ---- a scene of bodies ---- */

static tree_node *value_node(const tree_node *map, const char *key)
{
    for (int k = 0; map && map->kind == TREE_MAP && k < map->n; k++)
        if (strcmp(map->key[k]->text, key) == 0) return map->item[k];
    return NULL;
}

static void drop(case_reader *r, tree_node *map, const char *path, const char *key)
{
    const tree_node *node = key_node(map, key);
    char where[PLACE_SIZE];
    if (!node) return;
    if (node->set >= 0)
        snprintf(where, sizeof where, "--set %.120s", r->errors->sets[node->set]);
    else
        place_of(r, node, where);
    warn(r, &(old_name){ .section = path, .key = key }, where);
    host_tree_free(host_tree_take(map, key));
}

/* `scene.follow` is a key of an impact's scene too. */
void case_old_keys_of_bodies(case_reader *r, tree_node *root)
{
    tree_node *scene = value_node(root, "scene"), *bodies = value_node(scene, "bodies");
    if (!bodies) return;
    drop(r, scene, "scene", "follow");
    for (int k = 0; bodies->kind == TREE_LIST && k < bodies->n; k++) {
        char path[CASE_KEY_SIZE];
        snprintf(path, sizeof path, "scene.bodies[%d]", k);
        drop(r, bodies->item[k], path, "followed");
    }
}
