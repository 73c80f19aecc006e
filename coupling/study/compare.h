/* Rail surfaces compared: the untreated one and every treatment of the case (case/treatment.h), at the same shot, the
 * same grains, the same random numbers.
 *
 * Ranked by the expected number of gouges a shot; of equals the one that reaches its threshold later is the better.
 * `better_than_next`: share of the worlds (montecarlo.h: what the bands of the thresholds leave open) in which a
 * surface has fewer gouges than the next one, ties half.  From 95 % on the difference is called significant; surfaces
 * that no significant step parts share their rank. */
#ifndef BREECH_COUPLING_COMPARE_H
#define BREECH_COUPLING_COMPARE_H

#include "coupling/study/onset.h"

typedef struct {
    compare_result result; /* borrows entry and scene */
    int n;
    breech_case *treated; /* n, each owned; the first is the case as it is */
    onset_answer *answer; /* n, each owned */
    mc_result drawn;      /* owned */
    compare_entry *entry; /* owned */
    onset_scene *scene;   /* owned */
} compare_answer;

/* *out needs study_compare_answer_free even on error; what was reached by then is in it. */
status study_compare_run(session *s, compare_answer *out);
void study_compare_answer_free(compare_answer *a);

#endif
