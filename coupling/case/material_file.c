/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/material_file.h"

#include "coupling/case/case_reader.h"
#include "coupling/host/file_text.h"

#include <stdlib.h>
#include <string.h>

void case_material_sheet_free(material_sheet *sheet)
{
    for (int k = 0; k < sheet->n; k++) {
        free(sheet->constant[k].source);
        free(sheet->constant[k].note);
    }
    sheet->n = 0;
}

/* ---- one file ---- */

static const base_param *constant_of(const char *key)
{
    for (const base_param *p = mpm_material_params; p->key; p++)
        if (p->kind == BASE_PARAM_NUMBER && strcmp(p->key, key) == 0) return p;
    return NULL;
}

static const char *constant_name(const void *user, int i)
{
    (void)user;
    for (const base_param *p = mpm_material_params; p->key; p++)
        if (p->kind == BASE_PARAM_NUMBER && i-- == 0) return p->key;
    return NULL;
}

static const char *list_name(const void *user, int i)
{
    return ((const char *const *)user)[i];
}

static void check_keys(case_reader *r, const tree_node *map, const char *path, const char *const *known)
{
    for (int k = 0; k < map->n; k++) {
        bool found = false;
        for (int i = 0; known[i]; i++) found = found || strcmp(known[i], map->key[k]->text) == 0;
        if (found) continue;
        const char *near = host_nearest_name(map->key[k]->text, list_name, known);
        case_errors_add(r->errors, map->key[k], "unknown key `%.*s` in %s%s%s%s", CASE_SHOWN, map->key[k]->text, path,
                        near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "");
    }
}

/* A text that must be there; NULL with an error if it is not. */
static const char *text_of(case_reader *r, const tree_node *map, const char *key, const char *path)
{
    const tree_node *node = host_tree_find(map, key);
    if (node && node->kind == TREE_TEXT && !host_tree_is_empty(node) && node->text[0]) return node->text;
    case_errors_add(r->errors, node ? node : map, "%s.%s is missing: every constant has a value and a source", path,
                    key);
    return NULL;
}

static char *copy_text(case_reader *r, const char *text)
{
    char *copy = strdup(text);
    if (!copy) r->out_of_memory = true;
    return copy;
}

static void read_source(case_reader *r, const tree_node *entry, const char *path, material_constant *c)
{
    const char *name = text_of(r, entry, "source", path);
    if (!name) return;
    const tree_node *source = host_tree_find(host_tree_find(r->root, "sources"), name); /* those of its bases too */
    if (source && source->kind == TREE_TEXT && source->text[0])
        c->source = copy_text(r, source->text);
    else
        case_errors_add(r->errors, host_tree_find(entry, "source"), "%s.source = %.*s: not in `sources` of this file",
                        path, CASE_SHOWN, name);
}

static void read_remarks(case_reader *r, const tree_node *entry, const char *path, material_constant *c)
{
    static const base_param weak = {
        .key = "weak", .unit = "1", .kind = BASE_PARAM_FLAG, .max = 1, .doc = "yes or no"
    };
    char key[CASE_KEY_SIZE + 8];
    const tree_node *flag = host_tree_find(entry, "weak"), *note = host_tree_find(entry, "note");
    snprintf(key, sizeof key, "%s.weak", path);
    if (flag) case_value_read(r, &weak, flag, &c->weak, key);
    if (note && note->kind == TREE_TEXT)
        c->note = copy_text(r, note->text);
    else if (note)
        case_errors_add(r->errors, note, "%s.note: must be one line of text", path);
}

static void read_constant(case_reader *r, const tree_node *key, const tree_node *entry, material_sheet *sheet)
{
    static const char *const known[] = { "value", "source", "weak", "note", NULL };
    char path[CASE_KEY_SIZE], value_path[CASE_KEY_SIZE + 8];
    const base_param *p = constant_of(key->text);
    if (!p) {
        const char *near = host_nearest_name(key->text, constant_name, NULL);
        case_errors_add(r->errors, key, "unknown constant `%.*s`%s%s%s", CASE_SHOWN, key->text,
                        near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "");
        return;
    }
    snprintf(path, sizeof path, "constants.%s", p->key);
    if (entry->kind != TREE_MAP) {
        case_errors_add(r->errors, entry, "%s: must be {value: ..., source: ...}", path);
        return;
    }
    check_keys(r, entry, path, known);
    if (sheet->n == MATERIAL_MAX_CONSTANTS) return; /* no file has more keys than the table: duplicates are refused */
    material_constant *c = &sheet->constant[sheet->n++];
    *c = (material_constant){ .constant = p };
    read_source(r, entry, path, c);
    read_remarks(r, entry, path, c);
    if (!text_of(r, entry, "value", path)) return;
    snprintf(value_path, sizeof value_path, "%s.value", path);
    case_value_read(r, p, host_tree_find(entry, "value"), (char *)&sheet->material + p->offset, value_path);
}

static void read_sources(case_reader *r)
{
    const tree_node *sources = host_tree_find(r->root, "sources");
    if (!sources || sources->kind != TREE_MAP) {
        case_errors_add(r->errors, sources ? sources : r->root,
                        "`sources` is missing: short name and citation, one a line");
        return;
    }
    for (int k = 0; k < sources->n; k++)
        if (sources->item[k]->kind != TREE_TEXT || !sources->item[k]->text[0])
            case_errors_add(r->errors, sources->key[k], "sources.%.*s: must be a citation, one line", CASE_SHOWN,
                            sources->key[k]->text);
}

static void read_texts(case_reader *r, material_sheet *sheet)
{
    static const base_param texts[] = {
        PARAM_LONG_STRING(material_sheet, title, "", "one line"),
        PARAM_LONG_STRING(material_sheet, take_for, "", "when to take it, of several for one metal"),
        PARAMS_END,
    };
    for (const base_param *p = texts; p->key; p++) {
        const tree_node *node = host_tree_find(r->root, p->key);
        if (node) case_value_read(r, p, node, (char *)sheet + p->offset, p->key);
    }
}

static void read_name(case_reader *r, const char *path, material_sheet *sheet)
{
    static const base_param name = {
        .key = "name", .unit = "1", .kind = BASE_PARAM_TEXT, .doc = "the file's name without .yaml"
    };
    const tree_node *node = host_tree_find(r->root, "name");
    const char *file = strrchr(path, '/') ? strrchr(path, '/') + 1 : path; /* not its base's */
    const char *dot = strrchr(file, '.');
    const size_t stem = dot ? (size_t)(dot - file) : strlen(file);
    if (!node) {
        case_errors_add(r->errors, r->root, "name is missing: the file's name without .yaml");
        return;
    }
    case_value_read(r, &name, node, sheet->material.name, "name");
    const char *given = sheet->material.name;
    if (given[0] && (strlen(given) != stem || strncmp(given, file, stem) != 0))
        case_errors_add(r->errors, node, "name = %s: must be the file's name, %.*s", given, (int)stem, file);
}

/* The laws: no constants, so without a source of their own. */
static void read_laws(case_reader *r, material_sheet *sheet)
{
    for (const base_param *p = mpm_material_params; p->key; p++) {
        const tree_node *node = p->kind == BASE_PARAM_CHOICE ? host_tree_find(r->root, p->key) : NULL;
        if (node) case_value_read(r, p, node, (char *)&sheet->material + p->offset, p->key);
    }
}

static void read_sheet(case_reader *r, const char *path, material_sheet *sheet)
{
    static const char *const known[] = { "name", "title",   "take_for", "base",      "strength",
                                         "eos",  "failure", "sources",  "constants", NULL };
    if (r->root->kind != TREE_MAP) {
        char keys[200] = "";
        for (int i = 0; known[i]; i++) {
            const size_t used = strlen(keys);
            snprintf(keys + used, sizeof keys - used, "%s%s", i ? ", " : "", known[i]);
        }
        case_errors_add(r->errors, r->root, "a material's file has the keys %s", keys);
        return;
    }
    check_keys(r, r->root, "a material's file", known);
    read_name(r, path, sheet);
    read_texts(r, sheet);
    read_laws(r, sheet);
    read_sources(r);
    const tree_node *constants = host_tree_find(r->root, "constants");
    if (!constants || constants->kind != TREE_MAP) {
        case_errors_add(r->errors, constants ? constants : r->root, "`constants` is missing");
        return;
    }
    for (int k = 0; k < constants->n; k++) read_constant(r, constants->key[k], constants->item[k], sheet);
}

status case_material_sheet_parse(const units *u, const char *bytes, size_t length, const char *path,
                                 const char *const *dirs, int n_dirs, material_sheet *out, char **errors)
{
    tree_node *root = NULL;
    const case_options options = { .material_dirs = dirs, .n_material_dirs = n_dirs };
    *errors = NULL;
    memset(out, 0, sizeof *out);
    base_params_default(mpm_material_params, &out->material);
    snprintf(out->path, sizeof out->path, "%s", path);
    case_errors *found = calloc(1, sizeof *found);
    CHECK(found, STATUS_MEMORY, "out of memory while reading %s", path);
    case_reader r = { .u = u, .errors = found, .options = &options };
    status s = case_material_tree_read(&r, bytes, length, path, &root);
    r.root = root;
    if (root) read_sheet(&r, path, out);
    if (r.n_files > 1) snprintf(out->base, sizeof out->base, "%s", r.file[1]);
    if (s.code != STATUS_MEMORY) s = case_errors_finish(found, errors);
    if (r.out_of_memory) s = base_status_error(STATUS_MEMORY, "out of memory while reading %s", path);
    if (s.code != STATUS_OK) case_material_sheet_free(out);
    host_tree_free(root);
    case_errors_free(found);
    free(found);
    free(r.use);
    return s;
}

/* ---- found by name ---- */

static status sheet_from_file(const units *u, const char *path, const char *const *dirs, int n_dirs,
                              material_sheet *out, char **errors)
{
    char *bytes = NULL;
    size_t length = 0;
    TRY(host_file_text(path, TREE_MAX_BYTES, &bytes, &length));
    const status s = case_material_sheet_parse(u, bytes, length, path, dirs, n_dirs, out, errors);
    free(bytes);
    return s;
}

status case_material_sheet_find(const units *u, const char *name, const char *const *dirs, int n_dirs,
                                material_sheet *out, char **errors)
{
    char path[MATERIAL_PATH_SIZE];
    *errors = NULL;
    memset(out, 0, sizeof *out);
    TRY(case_material_file_find(name, dirs, n_dirs, path));
    return sheet_from_file(u, path, dirs, n_dirs, out, errors);
}

static bool is_path(const char *name)
{
    const size_t n = strlen(name);
    return strchr(name, '/') || (n > 5 && strcmp(name + n - 5, ".yaml") == 0);
}

status case_material_sheet_open(const char *name, const char *const *dirs, int n_dirs, material_sheet *out,
                                char **errors)
{
    units *u = NULL;
    *errors = NULL;
    memset(out, 0, sizeof *out);
    TRY(host_units_open(&u));
    const status s = is_path(name) ? sheet_from_file(u, name, dirs, n_dirs, out, errors)
                                   : case_material_sheet_find(u, name, dirs, n_dirs, out, errors);
    host_units_close(u);
    CHECK(s.code != STATUS_BAD_INPUT || *errors || is_path(name), s.code, "material %.100s: %.450s", name, s.text);
    return s;
}

void case_material_sheet_warning(const material_sheet *sheet, char out[MATERIAL_WARNING_SIZE])
{
    int used = 0, weak = 0;
    out[0] = '\0';
    for (int k = 0; k < sheet->n; k++) {
        if (!sheet->constant[k].weak || used >= MATERIAL_WARNING_SIZE) continue;
        if (weak == 0)
            used = snprintf(out, MATERIAL_WARNING_SIZE,
                            "material %s: from secondary or unchecked sources: ", sheet->material.name);
        used += snprintf(out + used, (size_t)(MATERIAL_WARNING_SIZE - used), "%s%s", weak > 0 ? ", " : "",
                         sheet->constant[k].constant->key);
        weak++;
    }
}
