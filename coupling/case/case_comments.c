/* SPDX-License-Identifier: BSD-3-Clause */
/* Comments for a case: what each of its keys means, from the tables that read it.  A line with a comment keeps its own;
 * of a list the first entry is commented. */
#include "coupling/case/case_new.h"

#include "coupling/case/case_bodies.h"
#include "coupling/case/case_reader.h"

#include <string.h>

enum { COMMENT_COLUMN = 36, COMMENT_WIDTH = 110 };

/* The section of a path: of the case, or of a scene of bodies; NULL where there is none. */
static const case_section *section_of(const char *path, bool bodies)
{
    if (bodies)
        for (const case_section *s = case_bodies_manual; s->key; s++)
            if (strcmp(s->key, strcmp(path, "scene") == 0 ? "scene with bodies" : path) == 0) return s;
    const case_section *level = case_root.children, *found = NULL;
    for (;;) {
        const size_t length = strcspn(path, ".");
        for (found = NULL; level && level->key && !found; level++)
            if (strlen(level->key) == length && strncmp(level->key, path, length) == 0) found = level;
        if (!found || path[length] == '\0') return found;
        level = found->children;
        path += length + 1;
    }
}

static const char *doc_in(const case_section *section, const char *key)
{
    for (const case_section *part = section; part; part = part->also)
        for (const base_param *p = part->table; p->key; p++)
            if (strcmp(p->key, key) == 0) return p->doc;
    return NULL;
}

static const char *doc_of(const char *path, const char *key, bool bodies)
{
    const char *doc = NULL;
    const case_section *section = path[0] ? section_of(path, bodies) : &case_root;
    if (section) doc = doc_in(section, key);
    if (!doc && bodies && strcmp(path, "scene") == 0)
        for (const case_section *s = case_bodies_manual; s->key && !doc; s++)
            if (strncmp(s->key, "scene with bodies", 17) == 0) doc = doc_in(s, key);
    return doc;
}

/* Has the line a comment, or does another key stand before this one? */
static bool line_is_taken(const case_edits *e, const tree_node *key)
{
    const size_t from = case_edit_place(e, key->line, 1), at = case_edit_place(e, key->line, key->column),
                 end = case_edit_line_end(e, key->line);
    for (size_t k = from; k < at; k++)
        if (!strchr(" -", e->text[k])) return true;
    return memchr(e->text + from, '#', end - from) != NULL;
}

static bool line_before_is_comment(const case_edits *e, int line)
{
    if (line == 1) return false;
    size_t at = case_edit_place(e, line - 1, 1);
    while (e->text[at] == ' ') at++;
    return e->text[at] == '#';
}

/* Is the line before this one neither empty nor a comment? */
static bool line_before_is_full(const case_edits *e, int line)
{
    const size_t at = line > 1 ? case_edit_place(e, line - 1, 1) : 0;
    return line > 1 && !strchr("#\r\n", e->text[at]);
}

/* A comment of whole lines before this one. */
static void comment_above(case_edits *e, int line, int indent, const char *doc)
{
    const size_t at = case_edit_place(e, line, 1), room = (size_t)(COMMENT_WIDTH - indent - 2);
    if (indent == 0 && line_before_is_full(e, line)) case_edit_add(e, at, 0, "\n");
    while (*doc) {
        size_t length = strlen(doc);
        if (length > room) {
            length = room;
            while (length > 0 && doc[length] != ' ') length--;
            if (length == 0) length = room;
        }
        case_edit_add(e, at, 0, "%*s# %.*s\n", indent, "", (int)length, doc);
        doc += length;
        while (*doc == ' ') doc++;
    }
}

/* Beside the key where it fits, else above its line. */
static void comment_key(case_edits *e, const tree_node *key, const char *doc)
{
    const size_t start = case_edit_place(e, key->line, 1), end = case_edit_line_end(e, key->line);
    const int used = (int)(end - start), gap = used < COMMENT_COLUMN ? COMMENT_COLUMN - used : 1;
    if (used + gap + 2 + (int)strlen(doc) <= COMMENT_WIDTH)
        case_edit_add(e, end, 0, "%*s# %s", gap, "", doc);
    else
        comment_above(e, key->line, key->column - 1, doc);
}

static void comment_map(case_edits *e, const tree_node *map, const char *path, bool bodies)
{
    for (int k = 0; k < map->n; k++) {
        const tree_node *key = map->key[k], *value = map->item[k];
        char inner[CASE_KEY_SIZE];
        snprintf(inner, sizeof inner, "%.100s%s%.50s", path, path[0] ? "." : "", key->text);
        const case_section *section = value->kind == TREE_TEXT ? NULL : section_of(inner, bodies);
        const char *doc = doc_of(path, key->text, bodies);
        if (section && !line_is_taken(e, key) && !line_before_is_comment(e, key->line))
            comment_above(e, key->line, key->column - 1, section->doc);
        else if (doc && !section && !line_is_taken(e, key))
            comment_key(e, key, doc);
        if (value->kind == TREE_LIST && value->n > 0) value = value->item[0];
        if (section && value->kind == TREE_MAP) comment_map(e, value, inner, bodies);
    }
}

void case_comments_add(case_edits *e, const tree_node *root)
{
    const tree_node *scene = host_tree_find(root, "scene");
    if (root->kind == TREE_MAP) comment_map(e, root, "", host_tree_find(scene, "bodies") != NULL);
}
