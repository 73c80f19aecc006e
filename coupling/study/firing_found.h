/* SPDX-License-Identifier: BSD-3-Clause */
/* What the section `optimise` of a case asks for, found before its shot: firing times and charges of the bank. */
#ifndef BREECH_COUPLING_STUDY_FIRING_FOUND_H
#define BREECH_COUPLING_STUDY_FIRING_FOUND_H

#include "circuit/firing.h"
#include "coupling/case/case_plain.h"
#include "coupling/run/session.h"
#include "coupling/run/shot_record.h"

typedef struct {
    circuit_shot_module *modules; /* [n] the bank's groups; owned */
    double *fire_at;              /* [n] owned [s] */
    int n;
    circuit_firing_result is;
} firing_found;

/* The flight's bank becomes the one that is found, which borrows from `out`.  study_firing_free even on error.  The
 * trials are noted under a name that begins with `prefix`, so that a resumed search does not run them again. */
status study_firing_find(session *s, const circuit_firing_wish *wish, const char *prefix, case_flight *flight,
                         firing_found *out);
void study_firing_free(firing_found *f);

/* Says in the record what was found; it borrows the times.  Warns where the current exceeds what was wished. */
void study_firing_record(session *s, const circuit_firing_wish *wish, const firing_found *f, shot_record *record);

#endif
