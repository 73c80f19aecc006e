/* SPDX-License-Identifier: BSD-3-Clause */
/* A YAML text as a small tree of nodes that know where they stand; the only file that knows libyaml.
 *
 * Robust to any bytes: size, depth, number of nodes and keys are limited.  Anchors, aliases, tags, several documents,
 * duplicate keys, keys that are not plain words and control characters are errors with a position.
 * host_tree_set puts a value from the command line into the tree, so that it is checked like the rest. */
#ifndef BREECH_COUPLING_YAML_TREE_H
#define BREECH_COUPLING_YAML_TREE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    TREE_MAX_BYTES = 4 << 20,
    TREE_MAX_DEPTH = 40,
    TREE_MAX_NODES = 400000,
    TREE_MAX_KEYS = 256, /* of one mapping */
    TREE_MAX_TEXT = 1000 /* bytes of one value */
};

typedef enum { TREE_TEXT, TREE_MAP, TREE_LIST } tree_kind;

typedef struct tree_node {
    tree_kind kind;
    int file;                /* number that host_tree_number has given; 0 before */
    int line, column;        /* from 1 */
    int set;                 /* the --set it comes from, -1: the file */
    bool quoted;             /* TREE_TEXT */
    char *text;              /* TREE_TEXT: owned, no NUL inside */
    int n;                   /* entries of a map or a list */
    struct tree_node **key;  /* TREE_MAP: n TREE_TEXT nodes, owned */
    struct tree_node **item; /* n values, owned */
} tree_node;

/* On STATUS_BAD_INPUT the text has no position: *line and *column hold it. */
status host_tree_parse(const char *bytes, size_t length, tree_node **out, int *line, int *column);

/* Notes in every node which of several files it comes from. */
void host_tree_number(tree_node *root, int file);

/* "path.to.key=value": path through lists as bank[1].charge (from 0), bank.charge = all entries.  A value that begins
 * with [ { or a quote is YAML, any other is taken as it stands.  Sections that are missing on the way are made. */
status host_tree_set(tree_node **root, const char *assignment, int set);

/* *below changed by `changes`, which is taken over, also on error.  Maps merge key by key; any other value replaces the
 * one below; an empty one (`key: ~`) takes the key out, where there is one.  A merged map stands where its changes
 * stand. */
status host_tree_merge(tree_node **below, tree_node *changes);

void host_tree_free(tree_node *node); /* NULL allowed */

/* Takes `key` out of a map: its value is then the caller's; NULL if it is not there. */
tree_node *host_tree_take(tree_node *map, const char *key);

/* Value of `key` in a map; NULL if it is not there or `map` is NULL or no map. */
const tree_node *host_tree_find(const tree_node *map, const char *key);

/* A plain text with nothing in it: `key:` or ~. */
bool host_tree_is_empty(const tree_node *node);

#endif
