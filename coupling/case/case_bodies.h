/* SPDX-License-Identifier: BSD-3-Clause */
/* `scene:` with `bodies:` in it: any scene of the solver, said in the solver's own terms.
 *
 *   scene:
 *     end_time: 60 us
 *     bodies:
 *       - {name: plate, material: steel_4340, shape: {box: {lo: 0 -50 -50 mm, hi: 10 50 50 mm}}}
 *       - {name: ball, material: w_alloy, shape: {sphere: {center: -6 0 0 mm, radius: 5 mm}}, velocity: 1.5 0 0 km/s}
 *     contacts: [{default: coulomb, friction: 0.1}]
 *     boundary: {x: [free, absorbing]}
 *
 * Shapes, contact laws and their values are those of the solver's tables: one that is added there is read and written
 * here without a change.  A solid is a mapping of one key, its kind; an operation has its parts under `of`, or is the
 * list of its parts where it has no values.  What the file leaves out of the window and its cells is NAN, for
 * scene_fill (coupling/scene) to choose. */
#ifndef BREECH_COUPLING_CASE_BODIES_H
#define BREECH_COUPLING_CASE_BODIES_H

#include "coupling/case/case_reader.h"

/* The section as the file has it into r->out->bodies; nothing where it has no `bodies`. */
void case_bodies_read(case_reader *r);
/* Once the materials are loaded. */
void case_bodies_resolve(case_reader *r);

/* The section's text; read back it gives the same scene, bit for bit. */
void case_bodies_write(const case_bodies *b, FILE *file);

/* ---- solids (case_solid.c) ---- */

/* Into the scene's solids; *root is the last of them.  false: there was an error. */
bool case_solid_read(case_reader *r, const tree_node *node, const char *path, mpm_scene *s, int *root);
/* In one line of flow style. */
void case_solid_write(const mpm_solid *root, FILE *file);

/* Once the materials are loaded and nothing was wrong: what the solver refuses of a scene (mpm_check_entry). */
void case_refused_check(case_reader *r);

/* Refuses bodies that fill the same place; list: the entries of scene.bodies. */
void case_overlap_check(case_reader *r, const tree_node *list);

/* ---- keys of one mapping, from several tables at once ---- */

typedef struct {
    const base_param *table;
    void *object;
} case_keys;

/* Defaults, then what the map gives; `others` (NULL at the end) are keys that the caller reads.  n tables. */
void case_keys_read(case_reader *r, const tree_node *map, const char *path, const case_keys *keys, int n,
                    const char *const *others);
/* "key: value" of the table's members that have a value, in flow style; each with ", " after the first. */
void case_keys_write(const base_param *table, const void *object, bool first, FILE *file);

/* Names the nearest of names(user, i), NULL at the end, and all of them. */
void case_unknown_name(case_reader *r, const tree_node *where, const char *what, const char *path,
                       const char *(*names)(const void *user, int i), const void *user);

/* The name of a body of an mpm_scene, NULL past the last: for case_unknown_name. */
const char *case_body_name(const void *scene, int i);

/* For the manual: the tables of the section as sections of their own; ends with a NULL key. */
extern const case_section case_bodies_manual[];

#endif
