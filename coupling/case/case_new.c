/* SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700 /* nftw */
#include "coupling/case/case_new.h"

#include "coupling/case/case_reader.h"
#include "coupling/case/material_file.h"
#include "coupling/host/file_text.h"
#include "coupling/host/outdir.h"

#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const case_kind case_kinds[] = {
    { "shot", "default_shot", "onset", "a bank, rails, an armature and grains: where does the rail gouge?" },
    { "bodies", "ball_gauge", "scene", "a ball on a plate with a pressure gauge in it" },
    { "strike", "sphere_plate", "strike", "a projectile on its target: does it pierce, what is left of its velocity?" },
    { "life", "rail_fatigue", "life", "a rail under a load that comes again and again: when does it crack?" },
    { NULL, NULL, NULL, NULL },
};

/* ---- what to begin from ---- */

/* "shot, bodies, strike, life" and the folders with shipped cases. */
static status nothing_to_begin_from(const case_folders *at, const char *from)
{
    char kinds[200] = "", folders[2 * MATERIAL_PATH_SIZE] = "";
    for (const case_kind *k = case_kinds; k->name; k++) {
        const size_t used = strlen(kinds);
        snprintf(kinds + used, sizeof kinds - used, "%s%s", used ? ", " : "", k->name);
    }
    for (int k = 0; k < at->n; k++) {
        const size_t used = strlen(folders);
        snprintf(folders + used, sizeof folders - used, "%s%s", used ? ", " : "", at->dir[k]);
    }
    return base_status_error(STATUS_BAD_INPUT,
                             "no case `%.200s` to begin from: give one of %s, a path, or the name of a case in %s",
                             from, kinds, at->n ? folders : "(no folder of cases was found beside the program)");
}

status case_new_start(const char *from, const case_kind **kind, char file[CASE_START_SIZE])
{
    char path[CASE_PATH_SIZE];
    case_folders at;
    case_folders_find(&at);
    *kind = from ? NULL : case_kinds;
    for (const case_kind *k = case_kinds; from && k->name; k++)
        if (strcmp(k->name, from) == 0) *kind = k;
    if (*kind) {
        if (!case_file_shipped((*kind)->from, path)) return nothing_to_begin_from(&at, (*kind)->from);
    } else {
        TRY(case_file_find(from, path));
        if (!host_file_exists(path)) return nothing_to_begin_from(&at, from);
    }
    snprintf(file, CASE_START_SIZE, "%s", path);
    return status_ok();
}

/* ---- what comes along ---- */

/* The last part of a path. */
static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static status path_in(char path[CASE_START_SIZE], const char *folder, const char *name)
{
    const int n = name[0] == '/' ? snprintf(path, CASE_START_SIZE, "%s", name)
                                 : snprintf(path, CASE_START_SIZE, "%s/%s", folder, name);
    CHECK(n < CASE_START_SIZE, STATUS_BAD_INPUT, "%.200s/%.200s: the path is too long", folder, name);
    return status_ok();
}

static status file_copy(const char *from, const char *to)
{
    char *bytes = NULL, folder[CASE_PATH_SIZE];
    size_t length = 0;
    TRY(host_file_read(from, &bytes, &length));
    case_folder_of(to, folder);
    status s = host_folder_make(folder);
    if (s.code == STATUS_OK) s = host_file_write(to, bytes, length);
    free(bytes);
    return s;
}

/* A case and those that build on it, up to the new one. */
typedef struct layer {
    const tree_node *root;
    const char *folder, *to, *as; /* where its file lies; where it comes, by which name */
    const struct layer *above;
} layer;

static status same_bytes(const char *a, const char *b, bool *same)
{
    char *x = NULL, *y = NULL;
    size_t n = 0, m = 0;
    status s = host_file_read(a, &x, &n);
    if (s.code == STATUS_OK) s = host_file_read(b, &y, &m);
    *same = s.code == STATUS_OK && n == m && memcmp(x, y, n) == 0;
    free(x);
    free(y);
    return s;
}

/* name, or name-2, name-3, ... before its ending: the first that no other file of the new case has. */
static status free_name(const layer *l, const char *from, const char *name, char out[TREE_MAX_TEXT + 20])
{
    enum { MOST = 100 };
    const char *last = last_part(name), *dot = strrchr(last, '.');
    const int stem = (int)(dot && dot > last ? (size_t)(dot - name) : strlen(name));
    for (int k = 1; k < MOST; k++) {
        char number[16] = "", copy[CASE_START_SIZE];
        bool same = false;
        if (k > 1) snprintf(number, sizeof number, "-%d", k);
        snprintf(out, TREE_MAX_TEXT + 20, "%.*s%s%s", stem, name, number, name + stem);
        TRY(path_in(copy, l->to, out));
        if (strcmp(out, l->as) == 0) continue; /* the case itself, which is written last */
        if (host_file_exists(copy)) TRY(same_bytes(from, copy, &same));
        if (same || !host_file_exists(copy)) return status_ok();
    }
    return base_status_error(STATUS_BAD_INPUT, "%.300s: %d other files that the case names are called %.200s too", from,
                             MOST - 1, last);
}

/* A file that a value names from its case's folder: the same name in the new one.  What lies elsewhere comes into the
 * new folder itself.  Where another file has that name already, it gets one that is free. */
static status bring_file(case_edits *e, const tree_node *value, const layer *l)
{
    char from[CASE_START_SIZE], copy[CASE_START_SIZE], name[TREE_MAX_TEXT + 20];
    TRY(path_in(from, l->folder, value->text));
    if (value->text[0] == '/' || !host_file_exists(from)) return status_ok();
    const bool elsewhere = strstr(value->text, "..") != NULL;
    TRY(free_name(l, from, elsewhere ? last_part(value->text) : value->text, name));
    if (strcmp(name, value->text) != 0) case_edit_value(e, value, name);
    TRY(path_in(copy, l->to, name));
    return file_copy(from, copy);
}

/* A material that lies in a folder, and below it what it builds on there. */
static status bring_material(const char *material, const char *folder, const char *to, int depth)
{
    char name[BASE_PARAM_TEXT_SIZE + 8], from[CASE_START_SIZE], copy[CASE_START_SIZE], *bytes = NULL;
    size_t length = 0;
    int line, column;
    tree_node *root = NULL;
    bool same = true;
    if (!case_material_name_valid(material)) return status_ok();
    snprintf(name, sizeof name, "%s.yaml", material);
    TRY(path_in(from, folder, name));
    TRY(path_in(copy, to, name));
    if (!host_file_exists(from) || depth == CASE_MAX_FILES) return status_ok();
    if (host_file_exists(copy)) TRY(same_bytes(from, copy, &same));
    CHECK(same, STATUS_BAD_INPUT, "%.300s: another file that the case names is called %.100s too", from, name);
    TRY(file_copy(from, copy));
    TRY(host_file_read(copy, &bytes, &length));
    status s = host_tree_parse(bytes, length, &root, &line, &column);
    free(bytes);
    if (s.code == STATUS_BAD_INPUT) return status_ok(); /* whoever reads the case says what is wrong with it */
    const tree_node *base = s.code == STATUS_OK ? host_tree_find(root, "base") : NULL;
    if (base && base->kind == TREE_TEXT) s = bring_material(base->text, folder, to, depth + 1);
    host_tree_free(root);
    return s;
}

/* Those of all materials that the values name which lie in this folder. */
static status bring_materials(const tree_node *node, const char *folder, const char *to)
{
    if (node->kind == TREE_TEXT) return bring_material(node->text, folder, to, 0);
    for (int k = 0; k < node->n; k++) TRY(bring_materials(node->item[k], folder, to));
    return status_ok();
}

/* Whatever value names a file beside the case. */
static status bring_files(case_edits *e, const tree_node *node, const layer *l)
{
    if (node->kind == TREE_TEXT) return node->text[0] ? bring_file(e, node, l) : status_ok();
    for (int k = 0; k < node->n; k++) {
        const bool base = node->kind == TREE_MAP && strcmp(node->key[k]->text, "base") == 0;
        if (!base) TRY(bring_files(e, node->item[k], l));
    }
    return status_ok();
}

/* What a case names beside itself.  A material that it names may lie beside those that build on it too, and theirs
 * beside it. */
static status bring_all(case_edits *e, const layer *l)
{
    TRY(bring_materials(l->root, l->folder, l->to));
    for (const layer *a = l->above; a; a = a->above) {
        TRY(bring_materials(a->root, l->folder, l->to));
        TRY(bring_materials(l->root, a->folder, a->to));
    }
    return bring_files(e, l->root, l);
}

static int height(const layer *l)
{
    return l ? 1 + height(l->above) : 0;
}

static status copy_case(const char *file, const char *to, const char *as, const char *name, const layer *above);

/* What the case builds on, in a folder of its own inside the new one; a shipped case that it calls by its name stays
 * what it is. */
static status bring_base(case_edits *e, const layer *l)
{
    const tree_node *base = host_tree_find(l->root, "base");
    if (!base || base->kind != TREE_TEXT) return status_ok();
    char path[CASE_START_SIZE], file[CASE_PATH_SIZE], where[CASE_PATH_SIZE], inner[CASE_START_SIZE], now[TREE_MAX_TEXT];
    TRY(path_in(path, l->folder, base->text));
    TRY(case_file_of(path, file));
    if (!host_file_exists(file) && case_file_shipped(base->text, file)) return status_ok();
    CHECK(height(l) < CASE_MAX_FILES, STATUS_BAD_INPUT, "%.300s: a chain of more than %d bases", file,
          CASE_MAX_FILES - 1);
    char *real = realpath(file, NULL);
    CHECK(real && strlen(real) < CASE_PATH_SIZE, STATUS_BAD_INPUT, "base %.300s: there is no such case", file);
    case_folder_of(real, where);
    const char *of = last_part(where), *as = last_part(real);
    snprintf(now, sizeof now, strcmp(as, "case.yaml") == 0 ? "%.400s" : "%.400s/%.400s", of, as);
    case_edit_value(e, base, now);
    status s = path_in(inner, l->to, of);
    if (s.code == STATUS_OK) s = copy_case(real, inner, as, NULL, l);
    free(real);
    return s;
}

/* The case's own name, and comments. */
static void make_own(case_edits *e, const tree_node *root, const char *file, const char *name)
{
    const tree_node *old = host_tree_find(root, "name");
    case_edit_add(e, case_edit_place(e, 1, 1), 0,
                  "# %s, begun from %s by `breech new`.\n# Every key: breech --keys.  What it needs: breech check.\n",
                  name, file);
    if (old && old->kind == TREE_TEXT)
        case_edit_value(e, old, name);
    else
        case_edit_add(e, case_edit_place(e, 1, 1), 0, "name: %s\n", name);
    case_comments_add(e, root);
}

/* A case file with what belongs to it, as to/as.  name NULL: it keeps its own, and its comments. */
static status copy_case(const char *file, const char *to, const char *as, const char *name, const layer *above)
{
    char folder[CASE_PATH_SIZE], path[CASE_START_SIZE], *bytes = NULL, *text = NULL;
    size_t length = 0;
    int line, column;
    tree_node *root = NULL;
    case_folder_of(file, folder);
    TRY(path_in(path, to, as));
    TRY(host_file_read(file, &bytes, &length));
    case_edits e = { .text = bytes, .length = length };
    status s = host_tree_parse(bytes, length, &root, &line, &column);
    if (s.code == STATUS_OK) s = host_folder_make(to);
    const layer own = { root, folder, to, as, above };
    if (s.code == STATUS_OK) s = bring_all(&e, &own);
    if (s.code == STATUS_OK) s = bring_base(&e, &own);
    if (s.code == STATUS_OK && name) make_own(&e, root, file, name);
    if (s.code == STATUS_OK) s = case_edits_apply(&e, &text, &length);
    if (s.code == STATUS_OK) s = host_file_write(path, text, length);
    case_edits_free(&e);
    host_tree_free(root);
    free(text);
    free(bytes);
    return s;
}

enum { OPEN_FOLDERS = 8 };

static int remove_entry(const char *path, const struct stat *info, int type, struct FTW *at)
{
    (void)info, (void)type, (void)at;
    return remove(path);
}

status case_new_make(const char *path, const char *file)
{
    char folder[CASE_START_SIZE];
    struct stat there;
    const int n = snprintf(folder, sizeof folder, "%s", path);
    CHECK(n < CASE_PATH_SIZE - 20, STATUS_BAD_INPUT, "%.200s...: the path is too long", path);
    for (int end = n; end > 1 && folder[end - 1] == '/';) folder[--end] = '\0';
    const char *name = last_part(folder);
    CHECK(
        host_name_is_plain(name) && case_name_has_word(name) && strlen(name) < BASE_PARAM_TEXT_SIZE, STATUS_BAD_INPUT,
        "%.200s is no name for a case: at most %d letters, digits, - _ and dots, one of the first two at least, no dot "
        "first",
        path, BASE_PARAM_TEXT_SIZE - 1);
    CHECK(lstat(folder, &there) != 0, STATUS_BAD_INPUT, "%s is there already: take another name, or remove it", folder);
    const status s = copy_case(file, folder, "case.yaml", name, NULL);
    if (s.code != STATUS_OK) nftw(folder, remove_entry, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS);
    return s;
}
