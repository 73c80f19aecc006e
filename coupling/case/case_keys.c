/* SPDX-License-Identifier: BSD-3-Clause */
/* The keys of one mapping from several tables at once: a body's numbers and a solid's values have no struct of their
 * own in the case. */
#include "coupling/case/case_bodies.h"

#include <string.h>

typedef struct {
    const case_keys *keys;
    int n;
    const char *const *others;
} known;

static const char *known_name(const void *user, int i)
{
    const known *k = user;
    for (int t = 0; t < k->n; t++)
        for (const base_param *p = k->keys[t].table; p->key; p++)
            if (i-- == 0) return p->key;
    for (int o = 0; k->others[o]; o++)
        if (i-- == 0) return k->others[o];
    return NULL;
}

void case_unknown_name(case_reader *r, const tree_node *where, const char *what, const char *path,
                       const char *(*names)(const void *user, int i), const void *user)
{
    char all[400] = "";
    const char *near = host_nearest_name(where->text, names, user);
    for (int i = 0; names(user, i); i++) {
        const size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i > 0 ? ", " : "", names(user, i));
    }
    case_errors_add(r->errors, where, "unknown %s `%.*s` in %s%s%s%s; known are %s", what, CASE_SHOWN, where->text,
                    path, near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "", all);
}

static bool is_other(const char *const *others, const char *key)
{
    for (int i = 0; others[i]; i++)
        if (strcmp(others[i], key) == 0) return true;
    return false;
}

static void read_one(case_reader *r, const known *k, const tree_node *key, const tree_node *value, const char *path)
{
    char inner[CASE_KEY_SIZE];
    snprintf(inner, sizeof inner, "%.*s.%.*s", CASE_KEY_SIZE - CASE_SHOWN - 2, path, CASE_SHOWN, key->text);
    for (int t = 0; t < k->n; t++)
        for (const base_param *p = k->keys[t].table; p->key; p++)
            if (strcmp(p->key, key->text) == 0) {
                case_value_read(r, p, value, (char *)k->keys[t].object + p->offset, inner);
                return;
            }
    if (!is_other(k->others, key->text)) case_unknown_name(r, key, "key", path, known_name, k);
}

void case_keys_read(case_reader *r, const tree_node *map, const char *path, const case_keys *keys, int n,
                    const char *const *others)
{
    const known k = { keys, n, others };
    for (int t = 0; t < n; t++) base_params_default(keys[t].table, keys[t].object);
    if (map->kind != TREE_MAP && !host_tree_is_empty(map)) {
        case_errors_add(r->errors, map, "%s must be a section: key and value, one a line, or {key: value, ..}", path);
        return;
    }
    for (int i = 0; map->kind == TREE_MAP && i < map->n; i++) read_one(r, &k, map->key[i], map->item[i], path);
    for (int t = 0; t < n; t++)
        for (const base_param *p = keys[t].table; p->key; p++) {
            char unit[UNIT_SIZE + 3];
            if (case_value_is_required(p) && !host_tree_find(map, p->key))
                case_errors_add(r->errors, map, "%s.%s is missing%s: %s", path, p->key, case_unit_text(p, unit),
                                p->doc);
        }
}

void case_keys_write(const base_param *table, const void *object, bool first, FILE *file)
{
    for (const base_param *p = table; p->key; p++) {
        const void *member = (const char *)object + p->offset;
        if (!case_value_is_set(p, member)) continue;
        fprintf(file, "%s%s: ", first ? "" : ", ", p->key);
        case_value_write(p, member, file);
        first = false;
    }
}
