/* SPDX-License-Identifier: BSD-3-Clause */
/* A case as it is read, checked and written as a whole: the struct of this room alone.  Others get what
 * case_plain.h makes of it; its sections are in case_sections.h. */
#ifndef BREECH_COUPLING_CASE_H
#define BREECH_COUPLING_CASE_H

#include "coupling/case/case_sections.h"

#include <stdio.h>

typedef struct breech_case {
    char name[BASE_PARAM_TEXT_SIZE];
    char title[BASE_PARAM_TEXT_SIZE];
    case_supplies supplies[CIRCUIT_SUPPLY_KINDS]; /* by kind: sections `bank`, ... of circuit/supply/supply.def */
    circuit_shot_rails rails;
    circuit_shot_barrel barrel;
    circuit_shot_armature armature;
    circuit_shot_options options;
    circuit_firing_wish optimise; /* of `breech shot` where it is given */
    case_rail rail;
    case_projectile projectile;
    case_particle particle;
    case_sites sites;
    case_populations populations;
    case_treatments treatments;
    case_scene scene;
    case_bodies bodies;
    case_study study;
    case_sweep sweep;
    case_strike strike;
    case_targets targets;
    case_life life;
    case_vessel vessel;
    case_output output;
    case_materials materials; /* every material the case names, loaded */
    case_given given;
    char path[CASE_PATH_SIZE];  /* of the file, as given */
    struct case_places *places; /* of its keys; owned, NULL: not known */
    char *warnings;             /* lines for the user (weak material constants, ...), "" if none; owned */
} breech_case;

/* Reads and checks `path` (a case.yaml, or a folder that holds one); sets are "path.to.key=value", applied first.
 * STATUS_BAD_INPUT: *errors then holds every error of the file, one a line, and the status text the first; the caller
 * frees *errors (NULL when there are none).  Nothing is written anywhere.  case_free frees *out (NULL on error). */
status case_read(const char *path, const char *const *sets, int n_sets, const case_options *options, breech_case **out,
                 char **errors);

status case_read_memory(const case_text *text, const case_options *options, breech_case **out, char **errors);

void case_free(breech_case *c); /* NULL allowed */

/* Has the armature the lengths of a body in a scene, or only what the circuit needs? */
bool case_has_body(const breech_case *c);

/* used.yaml: all values resolved, in SI with units, the materials' constants too.  Read back it gives the same case. */
status case_write_used(const breech_case *c, FILE *file);

/* A case of this scene, made from c, in the form of scene.bodies: read back it gives the same scene, bit for bit. */
status case_write_scene(const breech_case *c, const mpm_scene *s, FILE *file);

#endif
