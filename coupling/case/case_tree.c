/* SPDX-License-Identifier: BSD-3-Clause */
/* The tree of a case: its file, the files it builds on (`base:`), what --set changes; old names become the new ones. */
#include "coupling/case/case_reader.h"

#include "coupling/host/file_text.h"

#include <stdlib.h>
#include <string.h>

/* The file that `base` names, seen from the file it stands in: a new one of the reader's.  What is wrong with it is an
 * error at `base`; then the result is -1. */
static int base_file(case_reader *r, const tree_node *base)
{
    char folder[CASE_PATH_SIZE], path[CASE_PATH_SIZE + TREE_MAX_TEXT + 2], *file = r->file[r->n_files];
    if (base->kind != TREE_TEXT || base->text[0] == '\0' || host_tree_is_empty(base)) {
        case_errors_add(r->errors, base, "base: must be the path of a case, seen from this file's folder");
        return -1;
    }
    if (r->n_files == CASE_MAX_FILES) {
        case_errors_add(r->errors, base, "base = %.*s: a chain of more than %d bases", CASE_SHOWN, base->text,
                        CASE_MAX_FILES - 1);
        return -1;
    }
    case_folder_of(r->file[base->file], folder);
    const bool as_it_is = base->text[0] == '/' || strcmp(folder, ".") == 0;
    snprintf(path, sizeof path, "%s%s%s", as_it_is ? "" : folder, as_it_is ? "" : "/", base->text);
    status s = case_file_of(path, file);
    if (s.code == STATUS_OK && !host_file_exists(file) && !case_file_shipped(base->text, file))
        s = case_file_missing(base->text);
    if (s.code != STATUS_OK) {
        case_errors_add(r->errors, base, "base = %.*s: %s", CASE_SHOWN, base->text, s.text);
        return -1;
    }
    for (int k = 0; k < r->n_files; k++) {
        if (!case_file_is_same(file, r->file[k])) continue;
        case_errors_add(r->errors, base, "base = %.*s: leads back to %.200s, which builds on this file", CASE_SHOWN,
                        base->text, r->file[k]);
        return -1;
    }
    r->errors->file[r->n_files] = file;
    return r->n_files++;
}

static status tree_of(case_reader *r, const char *bytes, size_t length, int file, tree_node **out);

/* *root becomes the tree of its base, changed by it; NULL if that cannot be read, which is an error of the case. */
static status build_on(case_reader *r, const tree_node *base, tree_node **root)
{
    char *bytes = NULL;
    size_t length = 0;
    tree_node *changes = *root, *below = NULL;
    *root = NULL;
    const int file = base_file(r, base);
    status s = status_ok();
    if (file >= 0) s = host_file_text(r->file[file], TREE_MAX_BYTES, &bytes, &length);
    if (file >= 0 && s.code != STATUS_OK && s.code != STATUS_MEMORY) {
        case_errors_add(r->errors, base, "base = %.*s: %.300s", CASE_SHOWN, base->text, s.text);
        s = status_ok();
    }
    if (bytes) s = tree_of(r, bytes, length, file, &below);
    free(bytes);
    if (s.code != STATUS_OK || !below) {
        host_tree_free(below);
        host_tree_free(changes);
        return s;
    }
    s = host_tree_merge(&below, changes);
    *root = below;
    return s;
}

/* The tree of one file and of what it builds on; NULL where they have errors that leave nothing to read. */
static status tree_of(case_reader *r, const char *bytes, size_t length, int file, tree_node **out)
{
    int line, column;
    status s = host_tree_parse(bytes, length, out, &line, &column);
    CHECK(s.code != STATUS_MEMORY, s.code, "%s", s.text);
    if (s.code != STATUS_OK) {
        case_errors_add_at(r->errors, file, line, column, "%s", s.text);
        return status_ok();
    }
    host_tree_number(*out, file);
    if ((*out)->kind != TREE_MAP) {
        case_errors_add(r->errors, *out, "%.200s is no case: it must hold sections, such as `bank:` and `rail:`",
                        r->file[file]);
        host_tree_free(*out);
        *out = NULL;
        return status_ok();
    }
    TRY(case_old_names(r, *out));
    tree_node *base = host_tree_take(*out, "base");
    if (!base) return status_ok();
    s = build_on(r, base, out);
    host_tree_free(base);
    return s;
}

/* ---- --set ---- */

static status set_all(case_reader *r, const case_text *text, tree_node **root)
{
    for (int k = 0; k < text->n_sets; k++) {
        char *now = NULL;
        TRY(case_old_name_of_set(r, text->sets[k], &now));
        const bool is_read = now[0] || !text->sets[k][0]; /* an empty one is not an old key, but wrong */
        const status s = is_read ? host_tree_set(root, now, k) : status_ok();
        free(now);
        CHECK(s.code == STATUS_OK || s.code == STATUS_BAD_INPUT, s.code, "%s", s.text);
        if (s.code != STATUS_OK) case_errors_add(r->errors, &(tree_node){ .set = k }, "%s", s.text);
    }
    return status_ok();
}

status case_tree_read(case_reader *r, const case_text *text, tree_node **root)
{
    snprintf(r->file[0], CASE_PATH_SIZE, "%s", text->path);
    r->n_files = 1;
    r->errors->file[0] = r->file[0];
    r->errors->sets = text->sets;
    TRY(tree_of(r, text->bytes, text->length, 0, root));
    if (!*root) return status_ok();
    TRY(set_all(r, text, root));
    case_old_keys_of_bodies(r, *root);
    return status_ok();
}
