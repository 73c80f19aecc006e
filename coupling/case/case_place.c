/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_place.h"

#include "coupling/case/case_reader.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct case_places {
    tree_node *root; /* owned, as all texts here */
    char *file[CASE_MAX_FILES], **set;
    int n_files, n_sets;
};

static char **copy_sets(const char *const *sets, int n)
{
    char **all = calloc((size_t)n + 1, sizeof *all);
    for (int k = 0; all && k < n; k++) all[k] = strdup(sets[k]);
    return all;
}

case_places *case_places_make(tree_node *root, const char *const *files, int n_files, const char *const *sets,
                              int n_sets)
{
    case_places *p = calloc(1, sizeof *p);
    if (!p) {
        host_tree_free(root);
        return NULL;
    }
    p->root = root;
    for (; p->n_files < n_files; p->n_files++) p->file[p->n_files] = strdup(files[p->n_files]);
    p->set = copy_sets(sets, n_sets);
    p->n_sets = p->set ? n_sets : 0;
    return p;
}

void case_places_free(case_places *p)
{
    if (!p) return;
    host_tree_free(p->root);
    for (int k = 0; k < p->n_files; k++) free(p->file[k]);
    for (int k = 0; k < p->n_sets; k++) free(p->set[k]);
    free(p->set);
    free(p);
}

/* Entry k of a list, as it was read: an entry with lists of values stands for several (bank). */
static const tree_node *entry_at(const tree_node *list, const case_section *section, int k)
{
    const tree_node *entry = NULL;
    for (int i = 0; (entry = case_entry_node(list, i)); i++) {
        k -= section && section->list ? case_entry_values(section, entry) : 1;
        if (k < 0) return entry;
    }
    return NULL;
}

/* The node of a path of so many characters, or of what there is of it; *whole: of all of it. */
static const tree_node *node_at(const tree_node *root, const char *path, size_t length, bool *whole)
{
    const tree_node *at = root, *found = NULL;
    const char *end = path + length;
    *whole = false;
    while (at && path < end) {
        char key[BASE_PARAM_TEXT_SIZE];
        const size_t n = strcspn(path, ".[");
        snprintf(key, sizeof key, "%.*s", (int)(n < (size_t)(end - path) ? n : (size_t)(end - path)), path);
        const case_section *section = at == root ? case_section_find(key) : NULL;
        at = host_tree_find(at, key);
        path += strlen(key);
        for (; path < end && *path == '['; path += path < end) {
            if (at) at = entry_at(at, section, atoi(path + 1));
            while (path < end && *path != ']') path++;
        }
        if (at) found = at;
        if (path < end && *path++ != '.') return found;
    }
    *whole = at != NULL;
    return found;
}

static bool is_of_path(char c)
{
    return isalnum((unsigned char)c) || c == '_' || c == '.' || c == '[' || c == ']';
}

static const tree_node *node_of(const tree_node *root, const char *message)
{
    const tree_node *part = NULL;
    for (const char *c = message; *c;) {
        size_t n = 0;
        while (is_of_path(c[n])) n++;
        const size_t length = n > 0 && c[n - 1] == '.' ? n - 1 : n; /* a full stop */
        bool whole;
        const tree_node *node =
            memchr(c, '.', length) || memchr(c, '[', length) ? node_at(root, c, length, &whole) : NULL;
        if (node && whole) return node;
        if (!part) part = node;
        c += n > 0 ? n : 1;
    }
    return part;
}

void case_places_find(const case_places *p, const char *message, char *out, size_t size)
{
    const tree_node *node = p ? node_of(p->root, message) : NULL;
    out[0] = '\0';
    if (node && node->set >= 0 && node->set < p->n_sets)
        snprintf(out, size, CASE_SET_PLACE, p->set[node->set]);
    else if (node && node->set < 0 && node->file < p->n_files)
        snprintf(out, size, "%.200s:%d:%d: ", p->file[node->file], node->line, node->column);
}
