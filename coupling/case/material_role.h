/* SPDX-License-Identifier: BSD-3-Clause */
/* What a material is good for: the parts that it can have in a run, each with the constants without which a case is
 * refused.  The checks of a case and the table of `breech materials` ask the same functions.
 * To add a part: one line of the table. */
#ifndef BREECH_COUPLING_MATERIAL_ROLE_H
#define BREECH_COUPLING_MATERIAL_ROLE_H

#include "coupling/case/material_file.h"

#include <stdio.h>

/* Sum of mpm_material_need for a material in scenes; damage: they let it fail; meets: the screen asks how hard the rail
 * and the armature are that meet. */
unsigned case_material_needs(bool damage, bool meets);

typedef struct {
    const char *name, *doc;
    unsigned needs;     /* sum of mpm_material_need */
    unsigned without;   /* of these, what bodies that may not fail do not need */
    const char *unless; /* what the case then says; NULL: it fails in this part, or never does */
} material_role;
/* One line for each material in the first folders, `listed` of them, with its law of strength, at most 100 columns; an
 * earlier folder's hides those of its name, and what one builds on may lie in any that comes later. */
status case_materials_print(const material_places *at, int listed, FILE *out);
/* Laws, where that of strength is from, what it is good for, constants with their sources. */
void case_material_print(const material_sheet *sheet, FILE *out);

#endif
