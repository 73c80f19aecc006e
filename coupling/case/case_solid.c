/* SPDX-License-Identifier: BSD-3-Clause */
/* Solids of a case: one key, the kind; its values by the kind's own table; the parts of an operation under `of`. */
#include "coupling/case/case_bodies.h"

#include <string.h>

static const char *kind_name(const void *user, int i)
{
    (void)user;
    const mpm_solid_kind *k = mpm_solid_kind_at(i);
    return k ? k->name : NULL;
}

static const tree_node *parts_of(const tree_node *value)
{
    return value->kind == TREE_LIST ? value : host_tree_find(value, "of");
}

/* The key that an error names behind the solid's path, where the file gives it. */
static const tree_node *named_key(const tree_node *value, const char *path, const char *error)
{
    char key[CASE_KEY_SIZE];
    const size_t n = strlen(path);
    if (strncmp(error, path, n) != 0 || error[n] != '.') return value;
    snprintf(key, sizeof key, "%.*s", (int)strcspn(error + n + 1, " :"), error + n + 1);
    const tree_node *node = host_tree_find(value, key);
    return node ? node : value;
}

/* The node of this kind with its values, made of the nodes a and b. */
static bool add(case_reader *r, const tree_node *where, const char *path, const mpm_solid *made, const int part[2],
                mpm_scene *s, int *root)
{
    mpm_solid *added;
    status done = mpm_scene_add_solid(s, made->kind->name, part[0], part[1], &added);
    if (done.code == STATUS_OK) {
        memcpy(added->value, made->value, sizeof added->value);
        *root = s->solids - 1;
        if (made->kind->check) done = made->kind->check(added, path);
    }
    if (done.code != STATUS_OK) case_errors_add(r->errors, named_key(where, path, done.text), "%.400s", done.text);
    return done.code == STATUS_OK;
}

/* Its parts; an operation on two takes more from left to right: [a, b, c] is (a, b), c. */
static bool read_parts(case_reader *r, const tree_node *value, const char *path, const mpm_solid *made, mpm_scene *s,
                       int *root)
{
    const tree_node *parts = parts_of(value);
    const int wanted = made->kind->parts, given = !parts ? 0 : parts->kind == TREE_LIST ? parts->n : 1;
    if (given < wanted || (wanted == 1 && given > 1)) {
        case_errors_add(r->errors, value, "%s is made of %s%d solid%s, under `of`: %d given", path,
                        wanted > 1 ? "at least " : "", wanted, wanted > 1 ? "s" : "", given);
        return false;
    }
    int part[MPM_SOLID_PARTS] = { -1, -1 };
    for (int i = 0; i < given; i++) {
        char inner[CASE_KEY_SIZE];
        snprintf(inner, sizeof inner, "%.*s[%d]", CASE_KEY_SIZE - 20, path, i);
        const tree_node *one = parts->kind == TREE_LIST ? parts->item[i] : parts;
        if (!case_solid_read(r, one, inner, s, &part[i > 0])) return false;
        if (i + 1 < wanted) continue;
        if (!add(r, value, path, made, part, s, root)) return false;
        part[0] = *root;
    }
    return true;
}

bool case_solid_read(case_reader *r, const tree_node *node, const char *path, mpm_scene *s, int *root)
{
    static const char *const no_others[] = { NULL }, *const parts[] = { "of", NULL };
    const int errors = r->errors->n;
    if (node->kind != TREE_MAP || node->n != 1) {
        case_errors_add(r->errors, node,
                        "%s must name one kind of solid, such as {sphere: {center: 0 0 0 mm, radius: 1 mm}}", path);
        return false;
    }
    const mpm_solid_kind *kind = mpm_solid_kind_find(node->key[0]->text);
    const tree_node *value = node->item[0];
    if (!kind) {
        case_unknown_name(r, node->key[0], "shape", path, kind_name, NULL);
        return false;
    }
    char inner[CASE_KEY_SIZE];
    mpm_solid made = mpm_solid_make(kind);
    snprintf(inner, sizeof inner, "%.*s.%s", CASE_KEY_SIZE - 40, path, kind->name);
    const case_keys keys = { kind->params, made.value };
    tree_node nothing = *value; /* its place, without its parts */
    nothing.kind = TREE_MAP, nothing.n = 0;
    const bool list = kind->parts > 0 && value->kind == TREE_LIST; /* of parts alone */
    case_keys_read(r, list ? &nothing : value, inner, &keys, 1, kind->parts > 0 ? parts : no_others);
    if (r->errors->n > errors) return false;
    if (kind->parts > 0) return read_parts(r, value, inner, &made, s, root);
    return add(r, value, inner, &made, (const int[]){ -1, -1 }, s, root);
}

void case_solid_write(const mpm_solid *root, FILE *file)
{
    fprintf(file, "{%s: {", root->kind->name);
    case_keys_write(root->kind->params, root->value, true, file);
    if (root->kind->parts > 0) fprintf(file, "%sof: [", root->kind->params->key ? ", " : "");
    for (int i = 0; i < root->kind->parts; i++) {
        if (i > 0) fputs(", ", file);
        case_solid_write(mpm_solid_part(root, i), file);
    }
    fputs(root->kind->parts > 0 ? "]}}" : "}}", file);
}
