/* SPDX-License-Identifier: BSD-3-Clause */
/* Rail surfaces compared by how long they last: the untreated one and every treatment of the case, at the same shot.
 *
 * A surface's life is that of the metal on top: its uppermost layer, else the rail.  The rail's own metal has the
 * constants of life.material; any other its own, and is not judged where it lacks them.  The metal is taken to reach
 * down as far as the cracks.  A preheated rail is flown warm.  What hardening, polish, a lead face or the armature's
 * metal in the scenes do is not in the law: such a surface is tied with the untreated one.
 *
 * `better_than_next`: that it lasts longer than the next one.  Of one metal A is the same, so it is certain, or tied
 * where the lives differ by less than a twentieth; of two each A has a spread of its own. */
#ifndef BREECH_COUPLING_STUDY_LIFE_COMPARE_H
#define BREECH_COUPLING_STUDY_LIFE_COMPARE_H

#include "coupling/study/rail_life.h"

#define STUDY_SIGNIFICANT 0.95 /* chance from which on the better of two surfaces is told */

typedef struct {
    char surface[SUMMARY_NAME_SIZE];
    char metal[BASE_PARAM_TEXT_SIZE]; /* whose constants are taken */
    char lacks[160];                  /* why it is not judged; "": it is */
    rail_life_result is;              /* owned */
    double spread;                    /* fatigue_A_spread of the metal */
    double better_than_next;          /* [1]; NAN: not known */
    bool significant;                 /* that is at least STUDY_SIGNIFICANT */
    int tied;                         /* rank of the best of its group, from which it cannot be told; from 1 */
} life_entry;

typedef struct {
    int n;
    life_entry *ranking; /* n, owned; longest life first, then those without a judgement */
    double wall_seconds; /* [s] */
} life_ranking;

/* *out needs study_life_compare_free, even on error.  record, NULL: not wanted, is the untreated rail's shot. */
status study_life_compare_run(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                              bool with_history, life_ranking *out, shot_record *record);
void study_life_compare_free(life_ranking *r);
const life_entry *study_life_compare_find(const life_ranking *r, const char *surface); /* NULL: there is none */

#endif
