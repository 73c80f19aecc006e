/* SPDX-License-Identifier: BSD-3-Clause */
/* A material's file: cases/materials/<name>.yaml, every constant with its source.
 *
 *   name: ofhc_copper
 *   title: OFHC copper
 *   sources:
 *     JC: Johnson and Cook 1983, as used in public solver inputs
 *   constants:
 *     density: {value: 8960 kg/m^3, source: JC}
 *     hardness: {value: 725 MPa, source: book, weak: true, note: annealed 0.5 GPa .. half hard 0.95 GPa}
 *
 * `take_for` below the title, where several files are of one metal, says when to take this one.
 *
 * The constants are those of mpm_material_params (mpm/material.h), each optional: one that is not there is not known,
 * and what needs it refuses the material.  `weak: true` marks a secondary or unchecked value; whoever uses it is
 * warned.  `strength`, `eos` and `failure` after the title choose the laws by their names in mpm/law/<table>.def; not
 * given: johnson_cook, mie_gruneisen and johnson_cook.
 *
 * A file may be a change of another:
 *
 *   name: my_copper
 *   base: ofhc_copper_half_hard
 *   sources: {mine: "hardness test of our rails, 12 May"}
 *   constants:
 *     hardness: {value: 1.05 GPa, source: mine}
 *
 * `base` is the name of a material in the same folder or where materials are looked for.  A constant replaces that of
 * the base whole, with source, note and weakness; `~` takes it out.  `take_for` is not the base's.
 *
 * To add a material: add a file; tests/test_materials.c covers it at once. */
#ifndef BREECH_COUPLING_MATERIAL_FILE_H
#define BREECH_COUPLING_MATERIAL_FILE_H

#include "coupling/host/units.h"
#include "mpm/material.h"

#include <stdbool.h>

enum {
    MATERIAL_MAX_CONSTANTS = sizeof(mpm_material) / sizeof(double),
    MATERIAL_PATH_SIZE = 512,
    MATERIAL_ADVICE_SIZE = 76,
    MATERIAL_WARNING_SIZE = 600
};

typedef struct {
    const base_param *constant; /* borrowed from mpm_material_params */
    bool weak;
    char *source; /* the whole citation, owned */
    char *note;   /* owned, NULL if none */
} material_constant;

typedef struct {
    mpm_material material;
    char title[BASE_PARAM_TEXT_SIZE], take_for[MATERIAL_ADVICE_SIZE]; /* "" where the file does not say */
    char path[MATERIAL_PATH_SIZE], base[MATERIAL_PATH_SIZE];          /* base "": it builds on none */
    int n;
    material_constant constant[MATERIAL_MAX_CONSTANTS]; /* those given, in the file's order */
} material_sheet;

/* Finds <dir>/<name>.yaml in the first of the folders that has it.  STATUS_BAD_INPUT names the folders and the nearest
 * name; errors of the file itself are all in *errors (owned by the caller, NULL when there are none). */
status case_material_sheet_find(const units *u, const char *name, const char *const *dirs, int n_dirs,
                                material_sheet *out, char **errors);

/* The same for those who have no unit system open; a name with a slash, or that ends in .yaml, is a file's path. */
status case_material_sheet_open(const char *name, const char *const *dirs, int n_dirs, material_sheet *out,
                                char **errors);

/* From memory; the name in the file must be that of `path`.  Its base lies beside it or in one of the folders. */
status case_material_sheet_parse(const units *u, const char *bytes, size_t length, const char *path,
                                 const char *const *dirs, int n_dirs, material_sheet *out, char **errors);

/* The path of the first such file; STATUS_BAD_INPUT as of case_material_sheet_find. */
status case_material_file_find(const char *name, const char *const *dirs, int n_dirs, char path[MATERIAL_PATH_SIZE]);

void case_material_sheet_free(material_sheet *sheet);

/* A line naming the weak constants, "" if there are none. */
void case_material_sheet_warning(const material_sheet *sheet, char out[MATERIAL_WARNING_SIZE]);

/* Names of all materials in a folder, sorted; *names is an array of *n strings, freed with case_material_names_free.
 * A folder that is not there has none. */
status case_material_names(const char *dir, char ***names, int *n);
void case_material_names_free(char **names, int n);

/* Where the program looks beside the case's own folder: $BREECH_MATERIALS, the installation the program belongs to
 * (../share/breech/cases/materials from its folder), cases/materials of the source tree; those that are there.
 * STATUS_BAD_INPUT: $BREECH_MATERIALS is given and is no folder. */
enum { MATERIAL_MAX_DIRS = 3 };
typedef struct {
    int n;
    const char *dir[MATERIAL_MAX_DIRS + 1]; /* n; point into the environment, the program, `installed`; room for one
                                             * of the user's */
    char installed[MATERIAL_PATH_SIZE];
} material_places;
status case_material_places_find(material_places *out);

/* Where the shipped cases are, folders of <name>/case.yaml: beside the program, in the source tree. */
enum { CASE_MAX_FOLDERS = 2 };
typedef struct {
    int n;
    const char *dir[CASE_MAX_FOLDERS]; /* n; point into the program and `installed` */
    char installed[MATERIAL_PATH_SIZE];
} case_folders;
void case_folders_find(case_folders *out);

/* Letters, digits, _ - + and dots, not a dot first: a name that cannot lead out of its folder. */
bool case_material_name_valid(const char *name);

#endif
