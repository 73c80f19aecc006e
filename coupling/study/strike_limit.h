/* SPDX-License-Identifier: BSD-3-Clause */
/* The limit velocity of a target: between the arrivals that stop a projectile and those that pierce, by the bracketing
 * search of search/threshold.h over study.velocity_low .. velocity_high.
 *
 * `pierced` lies above the limit, of a piston's water `torn`, every other class below; `unfinished` is undecided and
 * widens the interval, which has no lower end where nothing slower is decided.  What the search interpolates is
 * (v_r/v0)^2 above, which rises from zero at the limit, and a constant below; of a piston's water a constant on
 * either side, so that it halves its bracket. */
#ifndef BREECH_COUPLING_STUDY_STRIKE_LIMIT_H
#define BREECH_COUPLING_STUDY_STRIKE_LIMIT_H

#include "coupling/strike/outcome.h"
#include "coupling/strike/recht_ipson.h"
#include "coupling/study/search/threshold.h"
#include "coupling/study/study.h"

/* One arrival. */
typedef struct {
    char scene[SUMMARY_NAME_SIZE];
    strike_outcome is;
} strike_arrival;

typedef struct {
    double velocity;    /* middle of the interval; NAN: not asked for, or an end is not known [m/s] */
    double interval[2]; /* NAN: that end is not known [m/s] */
    strike_fit fit;     /* of all that pierced */
    int arrivals;
    strike_arrival *arrival; /* [arrivals] rising in velocity; owned */
    int scenes;
    case_bodies *bodies; /* [scenes] theirs; owned */
} strike_limit;

/* STATUS_BAD_INPUT: the range of the search is empty. */
status study_strike_limit_possible(const case_study *c);
/* Fills interval and velocity from the arrivals, of which `above` lie above the limit.  false: the limit turns back, a
 * faster arrival being held than one that is above. */
bool study_strike_limit_ends(strike_limit *l, strike_class above);
/* The fastest arrival up to a velocity that was really held; NAN: none [m/s]. */
double study_strike_fastest_held(const strike_limit *l, strike_class above, double velocity);
/* Searches; `first` is an arrival that is known already, or NULL.  study_strike_limit_free even on error, once the
 * session is closed. */
status study_strike_limit_search(session *s, const study_case *of, const strike_projectile *p,
                                 const strike_arrival *first, strike_limit *out);
void study_strike_limit_free(strike_limit *l);

#endif
