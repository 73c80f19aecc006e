/* SPDX-License-Identifier: BSD-3-Clause */
/* How a case is read, for the files that do it: tree -> sections by their tables -> materials -> checks of the whole.
 */
#ifndef BREECH_COUPLING_CASE_READER_H
#define BREECH_COUPLING_CASE_READER_H

#include "coupling/case/case.h"
#include "coupling/case/case_errors.h"
#include "coupling/case/case_schema.h"
#include "coupling/host/units.h"
#include "coupling/host/yaml_tree.h"

enum { CASE_MAX_ENTRIES = 5000, CASE_KEY_SIZE = 160, CASE_SHOWN = 60 };

/* How an error shows a value: as it is written, a long one cut. */
#define CASE_ECHO "%.*s%s"
#define CASE_ECHO_OF(text) CASE_SHOWN, (text), strlen(text) > CASE_SHOWN ? "..." : ""

/* A place where the case names a material. */
typedef struct {
    char name[BASE_PARAM_TEXT_SIZE], key[CASE_KEY_SIZE];
    const tree_node *where; /* borrowed from the tree */
} material_use;

typedef struct {
    const units *u;
    const case_options *options;
    case_errors *errors;
    char file[CASE_MAX_FILES][CASE_PATH_SIZE]; /* the case's own, its base, that one's base, ... */
    int n_files;
    const tree_node *root;
    breech_case *out;
    material_use *use; /* owned */
    int n_use;
    bool out_of_memory;
} case_reader;

/* The files of a case as one tree, changed by --set.  *root NULL: errors were found that leave nothing to read. */
status case_tree_read(case_reader *r, const case_text *text, tree_node **root);

/* Sections and keys of one file that have an old name get the new one; and so does the path of a --set (*now is the
 * caller's, "" where nothing reads the key any more).  Each is a warning. */
status case_old_names(case_reader *r, tree_node *root);
status case_old_name_of_set(case_reader *r, const char *assignment, char **now);
/* The whole tree, --set included: keys of `scene.bodies` that nothing reads any more go, each with a warning. */
void case_old_keys_of_bodies(case_reader *r, tree_node *root);

/* A line for the user. */
void case_warn(case_reader *r, const char *line);
void case_warn_at(case_reader *r, const tree_node *node, const char *text); /* with the place of this value in front */

/* The case file that a path means: itself, or case.yaml in the folder. */
status case_file_of(const char *path, char file[CASE_PATH_SIZE]);
/* The same; where nothing is there and a case of this name (`NAME`, `cases/NAME`) came with the program, that one's. */
status case_file_find(const char *path, char file[CASE_PATH_SIZE]);
/* Is `cases/NAME` or `NAME` a case that came with the program?  *file stays as it is if there is none. */
bool case_file_shipped(const char *path, char file[CASE_PATH_SIZE]);
/* STATUS_BAD_INPUT of a path that is no case: the nearest name of a shipped one, or where those are. */
status case_file_missing(const char *path);
void case_folder_of(const char *file, char folder[CASE_PATH_SIZE]);
bool case_file_is_same(const char *a, const char *b);

/* The tree of a material's file, over those that it names as `base`, which lie in its folder or in those of the
 * options.  *root NULL: errors were found that leave nothing to read. */
status case_material_tree_read(case_reader *r, const char *bytes, size_t length, const char *path, tree_node **root);

/* A section, or all entries of a list, into its place in `parent`; path is "" for the root.  node NULL: defaults only.
 */
void case_section_read(case_reader *r, const case_section *section, const tree_node *node, void *parent,
                       const char *path);
void case_section_free(const case_section *section, void *parent);

/* One value by its param, with unit and range. */
void case_value_read(case_reader *r, const base_param *p, const tree_node *node, void *member, const char *path);

/* One value as it is written; has it one at all? */
void case_value_write(const base_param *p, const void *member, FILE *file);
bool case_value_is_set(const base_param *p, const void *member);
/* Must a case give it?  Its unit as errors name it: " [m]", or "" of a pure number and of what is no number. */
bool case_value_is_required(const base_param *p);
const char *case_unit_text(const base_param *p, char out[UNIT_SIZE + 3]);

/* A place that names a material without a key of that name. */
void case_note_material(case_reader *r, const char *name, const tree_node *where, const char *path);

/* What presets say, where populations leave it out; names their materials. */
void case_populations_resolve(case_reader *r);

/* Stretches inside the barrel, sizes that are there. */
void case_populations_check(case_reader *r);

/* Entry k of a list section in the tree (a lone mapping is entry 0); NULL if it is not there. */
const tree_node *case_entry_node(const tree_node *list, int k);

/* How many entries of the list this one in the tree stands for: as many as its lists of values have (1 without). */
int case_entry_values(const case_section *section, const tree_node *entry);
const case_section *case_section_find(const char *key); /* of the case; NULL if there is none */

/* What sites leave out, from `particle`; what `particle` leaves out. */
void case_resolve(breech_case *c, const tree_node *root);

/* What no single value can say: sections needed, lengths that must fit, sites inside the barrel, materials that
 * suffice. */
void case_check_whole(case_reader *r);

/* What a case for these needs needs beside: of `breech strike` without a velocity of its own, the shot. */
unsigned case_strike_needs(const tree_node *root, unsigned needs);
/* Has the name of a case a letter or a digit? */
bool case_name_has_word(const char *name);
/* The bodies that `strike` names, what its flight needs. */
void case_strike_check(case_reader *r);
/* The same of `breech life` under an armature; of `breech compare` by its life, which may do without grains. */
unsigned case_life_needs(const tree_node *root, unsigned needs);
/* The load of `life`: where one key asks for another. */
void case_life_check(case_reader *r);

/* case_read_memory with the unit system given; the one way in for all of them. */
status case_build(const units *u, const case_text *text, const case_options *options, breech_case **out, char **errors);

#endif
