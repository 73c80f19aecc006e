/* SPDX-License-Identifier: BSD-3-Clause */
/* A shot of a session: run past its grains, timed, warned of where it leaves its limits, recorded. */
#ifndef BREECH_COUPLING_GOUGE_SESSION_SHOT_H
#define BREECH_COUPLING_GOUGE_SESSION_SHOT_H

#include "coupling/gouge/site_state.h"
#include "coupling/run/session.h"
#include "coupling/run/shot_record.h"

/* With what is asked for in jumps (NULL: none).  Of all shots of a run one alone writes history. */
status gouge_session_shot(session *s, const case_flight *flight, const site_jump *jump, bool with_history,
                          shot_outcome *out, shot_record *record);

#endif
