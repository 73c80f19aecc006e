/* SPDX-License-Identifier: BSD-3-Clause */
/* The tree of a material's file: the file, and the materials that it changes (`base:`). */
#include "coupling/case/case_reader.h"

#include "coupling/case/material_file.h"
#include "coupling/host/file_text.h"

#include <stdlib.h>
#include <string.h>

/* The path of the material that `base` names: beside the file it stands in, or where materials are looked for. */
static status find_base(const case_reader *r, const tree_node *base, char path[MATERIAL_PATH_SIZE])
{
    enum { MAX_DIRS = 32 };
    const char *dirs[MAX_DIRS];
    char folder[CASE_PATH_SIZE];
    int n_dirs = 0;
    case_folder_of(r->file[base->file], folder);
    dirs[n_dirs++] = folder;
    for (int k = 0; k < r->options->n_material_dirs && n_dirs < MAX_DIRS; k++)
        dirs[n_dirs++] = r->options->material_dirs[k];
    CHECK(base->kind == TREE_TEXT && !host_tree_is_empty(base), STATUS_BAD_INPUT, "must be the name of a material");
    CHECK(r->n_files < CASE_MAX_FILES, STATUS_BAD_INPUT, "a chain of more than %d bases", CASE_MAX_FILES - 1);
    TRY(case_material_file_find(base->text, dirs, n_dirs, path));
    for (int k = 0; k < r->n_files; k++)
        CHECK(!case_file_is_same(path, r->file[k]), STATUS_BAD_INPUT, "leads back to %.200s", r->file[k]);
    return status_ok();
}

/* Constants that the changes give leave the base whole, so that no note of the old value stays with the new one. */
static void make_way(tree_node *below, const tree_node *changes)
{
    const tree_node *constants = host_tree_find(changes, "constants");
    tree_node *old = NULL;
    for (int k = 0; k < below->n; k++)
        if (strcmp(below->key[k]->text, "constants") == 0) old = below->item[k];
    if (!old || old->kind != TREE_MAP || !constants || constants->kind != TREE_MAP) return;
    for (int k = 0; k < constants->n; k++)
        if (constants->item[k]->kind == TREE_MAP) host_tree_free(host_tree_take(old, constants->key[k]->text));
}

/* A source of the base is cited by its constants: the changes may not say something else by that name. */
static void check_sources(case_reader *r, const tree_node *below, const tree_node *changes)
{
    const tree_node *sources = host_tree_find(changes, "sources");
    for (int k = 0; sources && sources->kind == TREE_MAP && k < sources->n; k++) {
        const char *name = sources->key[k]->text;
        const tree_node *was = host_tree_find(host_tree_find(below, "sources"), name), *is = sources->item[k];
        if (was && (was->kind != TREE_TEXT || is->kind != TREE_TEXT || strcmp(was->text, is->text) != 0))
            case_errors_add(r->errors, sources->key[k],
                            "sources.%.*s: the base has a source of this name; take another", CASE_SHOWN, name);
    }
}

static status tree_of(case_reader *r, const char *bytes, size_t length, int file, tree_node **out);

/* The tree of the base, NULL with an error at `base` if there is none. */
static status base_tree(case_reader *r, const tree_node *base, tree_node **below)
{
    char *bytes = NULL, path[MATERIAL_PATH_SIZE];
    size_t length = 0;
    status s = find_base(r, base, path);
    if (s.code == STATUS_OK) s = host_file_text(path, TREE_MAX_BYTES, &bytes, &length);
    CHECK(s.code != STATUS_MEMORY, s.code, "%s", s.text);
    if (s.code != STATUS_OK) {
        case_errors_add(r->errors, base, "base = %.*s: %.400s", CASE_SHOWN,
                        base->kind == TREE_TEXT && base->text ? base->text : "", s.text);
        return status_ok();
    }
    const int file = r->n_files++;
    snprintf(r->file[file], CASE_PATH_SIZE, "%s", path);
    r->errors->file[file] = r->file[file];
    s = tree_of(r, bytes, length, file, below);
    free(bytes);
    return s;
}

static status tree_of(case_reader *r, const char *bytes, size_t length, int file, tree_node **out)
{
    int line, column;
    tree_node *below = NULL;
    status s = host_tree_parse(bytes, length, out, &line, &column);
    CHECK(s.code != STATUS_MEMORY, s.code, "%s", s.text);
    if (s.code != STATUS_OK) {
        case_errors_add_at(r->errors, file, line, column, "%s", s.text);
        return status_ok();
    }
    host_tree_number(*out, file);
    tree_node *base = host_tree_take(*out, "base"), *changes = *out;
    if (!base) return status_ok();
    s = base_tree(r, base, &below);
    host_tree_free(base);
    *out = below;
    if (s.code != STATUS_OK || !below) {
        host_tree_free(changes);
        return s;
    }
    check_sources(r, below, changes);
    if (below->kind == TREE_MAP) {
        make_way(below, changes);
        host_tree_free(host_tree_take(below, "take_for"));
    }
    return host_tree_merge(out, changes);
}

status case_material_tree_read(case_reader *r, const char *bytes, size_t length, const char *path, tree_node **root)
{
    *root = NULL;
    snprintf(r->file[0], CASE_PATH_SIZE, "%s", path);
    r->n_files = 1;
    r->errors->file[0] = r->file[0];
    return tree_of(r, bytes, length, 0, root);
}
