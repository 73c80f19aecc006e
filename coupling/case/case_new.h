/* SPDX-License-Identifier: BSD-3-Clause */
/* A new case, begun from another one: `breech new`.
 *
 * The text is that of a case that is there, shipped or the user's own: its name becomes the new one's, keys without a
 * comment get one from the tables that read them.  What the case names beside itself comes along: its base, materials,
 * tables of current.  No text of a case stands in the program. */
#ifndef BREECH_COUPLING_CASE_NEW_H
#define BREECH_COUPLING_CASE_NEW_H

#include "coupling/case/case_edit.h"

/* What a newcomer may want, and the shipped case that it begins from; the first is the default. */
typedef struct {
    const char *name, *from, *run, *doc; /* run: the command that answers its question */
} case_kind;
extern const case_kind case_kinds[]; /* ends with a NULL name */

enum { CASE_START_SIZE = 1024 };

/* The file to begin from: a kind, a path, or the name of a shipped case; NULL: the first kind.  *kind: NULL if it is
 * not one.  STATUS_BAD_INPUT says what there is. */
status case_new_start(const char *from, const case_kind **kind, char file[CASE_START_SIZE]);

/* Makes the folder `path` with a case.yaml of its last part's name, begun from this file.  STATUS_BAD_INPUT: it is
 * there already, or is no name for a case. */
status case_new_make(const char *path, const char *file);

/* A comment for every key of the tree that has none. */
void case_comments_add(case_edits *e, const tree_node *root);

#endif
