/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case.h"

#include "coupling/case/case_bodies.h"
#include "coupling/case/case_place.h"
#include "coupling/case/material_file.h"
#include "coupling/case/profile_file.h"
#include "coupling/host/file_text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void case_free(breech_case *c)
{
    if (!c) return;
    for (const case_section *s = case_root.children; s->key; s++) case_section_free(s, c);
    mpm_scene_free(&c->bodies.scene);
    case_places_free(c->places);
    free(c->warnings);
    free(c);
}

/* ---- materials ---- */

static void keep_material(case_reader *r, const mpm_material *m)
{
    case_materials *list = &r->out->materials;
    mpm_material *more = realloc(list->item, ((size_t)list->n + 1) * sizeof *more);
    if (!more) {
        r->out_of_memory = true;
        return;
    }
    more[list->n++] = *m;
    list->item = more;
}

/* All lines of a material file's errors, after the case's own; those of a base that several files have, once. */
static void add_lines(case_errors *e, char *lines)
{
    char *rest = NULL;
    for (char *line = strtok_r(lines, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        bool told = false;
        for (int k = 0; k < e->n; k++) told = told || strcmp(e->item[k].text, line) == 0;
        if (told) continue;
        if (e->n == CASE_MAX_ERRORS) return;
        e->item[e->n] = (case_error){ .set = -1, .line = 1 << 30, .order = e->n, .text = strdup(line) };
        if (e->item[e->n].text)
            e->n++;
        else
            e->out_of_memory = true;
    }
}

static void load_one(case_reader *r, const material_use *use, const char *const *dirs, int n_dirs)
{
    material_sheet sheet;
    char *errors = NULL, warning[MATERIAL_WARNING_SIZE];
    const status s = case_material_sheet_find(r->u, use->name, dirs, n_dirs, &sheet, &errors);
    if (s.code == STATUS_MEMORY) {
        r->out_of_memory = true;
    } else if (s.code != STATUS_OK) {
        case_errors_add(r->errors, use->where, "%s = %.*s: %s", use->key, CASE_SHOWN, use->name,
                        errors ? "its file has errors" : s.text);
        if (errors) add_lines(r->errors, errors);
    } else {
        keep_material(r, &sheet.material);
        case_material_sheet_warning(&sheet, warning);
        case_warn(r, warning);
        case_material_sheet_free(&sheet);
    }
    free(errors);
}

static void check_own(case_reader *r)
{
    const case_materials *list = &r->out->materials;
    const tree_node *node = host_tree_find(r->root, "materials");
    char line[BASE_PARAM_TEXT_SIZE + 100];
    for (int k = 0; k < list->n; k++) {
        const char *name = list->item[k].name;
        for (int i = 0; i < k; i++)
            if (name[0] && strcmp(name, list->item[i].name) == 0)
                case_errors_add(r->errors, node, "materials[%d].name = %s: the same as materials[%d]", k, name, i);
        snprintf(line, sizeof line, "material %s: constants as given in the case itself, without their sources", name);
        case_warn(r, line);
    }
}

/* Was this name tried before?  One error a name is enough. */
static bool seen(const case_reader *r, int k)
{
    for (int i = 0; i < k; i++)
        if (strcmp(r->use[i].name, r->use[k].name) == 0) return true;
    return false;
}

/* Loads what the case names, in the order of the naming, after the case's own materials: from beside the case, beside
 * what it builds on, and where the options say. */
static void load_materials(case_reader *r)
{
    enum { MAX_DIRS = 16 + CASE_MAX_FILES };
    const char *dirs[MAX_DIRS];
    char folder[CASE_MAX_FILES][CASE_PATH_SIZE];
    int n_dirs = 0;
    for (int k = 0; k < r->n_files; k++) {
        case_folder_of(r->file[k], folder[k]);
        dirs[n_dirs++] = folder[k];
    }
    for (int k = 0; k < r->options->n_material_dirs && n_dirs < MAX_DIRS; k++)
        dirs[n_dirs++] = r->options->material_dirs[k];

    check_own(r);
    for (int k = 0; k < r->n_use; k++)
        if (!case_material(&r->out->materials, r->use[k].name) && !seen(r, k)) load_one(r, &r->use[k], dirs, n_dirs);
}

/* ---- current profiles ---- */

static void profile_load(case_reader *r, circuit_supply_profile *p, const tree_node *entry)
{
    char path[CASE_PATH_SIZE + sizeof p->file + 2], folder[CASE_PATH_SIZE];
    const tree_node *where = host_tree_find(entry, "file");
    if (!where) where = entry;
    if (p->file[0] == '\0') return;
    if (p->points.n > 0) {
        case_errors_add(r->errors, where, "a current profile with both file and points: give one of them");
        return;
    }
    case_folder_of(r->file[where->file], folder);
    snprintf(path, sizeof path, "%s%s%s", p->file[0] == '/' ? "" : folder, p->file[0] == '/' ? "" : "/", p->file);
    const status s = case_profile_read(path, &p->points.item, &p->points.n);
    if (s.code != STATUS_OK) case_errors_add(r->errors, where, "%.400s", s.text);
    p->file[0] = '\0'; /* used.yaml then has the points themselves */
}

/* Current profiles given as files. */
static void load_profiles(case_reader *r)
{
    case_supplies *list = &r->out->supplies[CIRCUIT_SUPPLY_profile];
    const case_section *section = case_section_find(circuit_supply_sections[CIRCUIT_SUPPLY_profile]);
    const tree_node *node = host_tree_find(r->root, section->key), *from = NULL;
    for (int k = 0, i = 0; i < list->n && (from = case_entry_node(node, k)); k++)
        for (int pick = 0; pick < case_entry_values(section, from) && i < list->n; pick++)
            profile_load(r, (circuit_supply_profile *)list->item + i++, from);
}

/* ---- the whole way ---- */

static status read_tree(case_reader *r)
{
    breech_case *c = r->out;
    case_section root = case_root;
    root.offset = 0;
    case_section_read(r, &root, r->root, c, "");
    case_bodies_read(r);
    case_populations_resolve(r);
    load_materials(r);
    load_profiles(r);
    case_resolve(c, r->root);
    case_bodies_resolve(r);
    case_check_whole(r);
    CHECK(!r->out_of_memory, STATUS_MEMORY, "out of memory while reading %.200s", c->path);
    return status_ok();
}

static status build(case_reader *r, const case_text *text, tree_node **root)
{
    TRY(case_tree_read(r, text, root));
    r->root = *root;
    if (!r->root) return status_ok();
    case_options own = *r->options;
    if ((own.needs & CASE_FOR_SCENE) && host_tree_find(host_tree_find(*root, "scene"), "bodies"))
        own.needs ^= CASE_FOR_SCENE | CASE_FOR_BODIES;
    own.needs = case_life_needs(*root, case_strike_needs(*root, own.needs));
    r->options = &own;
    return read_tree(r);
}

status case_build(const units *u, const case_text *text, const case_options *options, breech_case **out, char **errors)
{
    tree_node *root = NULL;
    *out = NULL;
    *errors = NULL;
    CHECK(strlen(text->path) < CASE_PATH_SIZE, STATUS_BAD_INPUT, "the case's path is longer than %d bytes",
          CASE_PATH_SIZE - 1);
    breech_case *c = calloc(1, sizeof *c);
    case_errors *found = calloc(1, sizeof *found);
    case_reader r = { .u = u, .options = options, .errors = found, .out = c };
    status s = base_status_error(STATUS_MEMORY, "out of memory while reading %.200s", text->path);
    if (c && found) {
        c->warnings = strdup("");
        snprintf(c->path, sizeof c->path, "%s", text->path);
        if (c->warnings) s = build(&r, text, &root);
        if (s.code == STATUS_OK) s = case_errors_finish(found, errors);
        case_errors_free(found);
    }
    if (s.code == STATUS_OK) {
        const char *files[CASE_MAX_FILES];
        for (int k = 0; k < r.n_files; k++) files[k] = r.file[k];
        c->places = case_places_make(root, files, r.n_files, text->sets, text->n_sets);
        root = NULL;
    }
    free(r.use);
    free(found);
    host_tree_free(root);
    if (s.code == STATUS_OK)
        *out = c;
    else
        case_free(c);
    return s;
}

status case_read_memory(const case_text *text, const case_options *options, breech_case **out, char **errors)
{
    units *u = NULL;
    *out = NULL;
    *errors = NULL;
    TRY(host_units_open(&u));
    const status s = case_build(u, text, options, out, errors);
    host_units_close(u);
    return s;
}

status case_read(const char *path, const char *const *sets, int n_sets, const case_options *options, breech_case **out,
                 char **errors)
{
    char file[CASE_PATH_SIZE];
    char *bytes = NULL;
    size_t length = 0;
    *out = NULL;
    *errors = NULL;
    TRY(case_file_find(path, file));
    if (access(file, F_OK) != 0 && errno == ENOENT) {
        const status none = case_file_missing(path);
        CHECK(host_folder_exists(path), STATUS_BAD_INPUT, "%.300s: %s; `breech new NAME` begins one", path, none.text);
        return base_status_error(STATUS_BAD_INPUT, "%.300s: there is no such file in this folder", file);
    }
    TRY(host_file_text(file, TREE_MAX_BYTES, &bytes, &length));
    const case_text text = { bytes, length, file, sets, n_sets };
    const status s = case_read_memory(&text, options, out, errors);
    free(bytes);
    return s;
}
