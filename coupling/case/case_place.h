/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a case says what a message is about: checks beyond the reader's name keys by their path, such as
 * `rail.face_crown`, and know nothing of files. */
#ifndef BREECH_COUPLING_CASE_PLACE_H
#define BREECH_COUPLING_CASE_PLACE_H

#include "coupling/host/yaml_tree.h"

/* The place of a value of --set. */
#define CASE_SET_PLACE "--set %.120s: "

typedef struct case_places case_places;

/* Takes the tree over, also where there is no memory for the rest (NULL); copies file names and the texts of --set. */
case_places *case_places_make(tree_node *root, const char *const *files, int n_files, const char *const *sets,
                              int n_sets);
void case_places_free(case_places *p); /* NULL allowed */

/* "case.yaml:12:18: " or "--set rail.count=4: " for the first path in the message that the case has; of a key that is
 * left to its default, the section's; "" where there is none. */
void case_places_find(const case_places *p, const char *message, char *out, size_t size);

#endif
