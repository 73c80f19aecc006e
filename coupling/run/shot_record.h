/* SPDX-License-Identifier: BSD-3-Clause */
/* What a shot says of itself in summary.json. */
#ifndef BREECH_COUPLING_SHOT_RECORD_H
#define BREECH_COUPLING_SHOT_RECORD_H

#include "circuit/firing.h"
#include "circuit/shot.h"
#include "coupling/output/summary.h"

/* The shot, and what it took. */
typedef struct {
    circuit_shot_summary is;
    circuit_shot_limits limits;
    double rail_rise,
        rail_rise_position;       /* largest that the shot leaves in its rails, even over the section; where [K, m] */
    double wall_seconds;          /* [s] */
    circuit_firing_result firing; /* of the search for firing times, all zero where there was none */
    int n_fire_at;
    const double *fire_at; /* of the bank's groups, as found [s]; n_fire_at, borrowed */
} shot_record;

extern const summary_key run_shot_keys[]; /* of shot_record */

/* For people: what became of the armature, in a line or two. */
void run_shot_verdict(const shot_record *r, FILE *out);

#endif
