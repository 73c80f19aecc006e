/* SPDX-License-Identifier: BSD-3-Clause */
/* What the arrivals of a search of a limit velocity say of it. */
#include "coupling/study/strike_limit.h"

#include <math.h>

double study_strike_fastest_held(const strike_limit *l, strike_class above, double velocity)
{
    double found = NAN;
    for (int i = 0; i < l->arrivals && l->arrival[i].is.impact_velocity <= velocity; i++) {
        const strike_class class = (strike_class)l->arrival[i].is.class;
        if (class != above && class != STRIKE_UNFINISHED) found = l->arrival[i].is.impact_velocity;
    }
    return found;
}

/* The slowest from a velocity on that was not; NAN: none [m/s]. */
static double slowest_above(const strike_limit *l, strike_class above, double velocity)
{
    for (int i = 0; i < l->arrivals; i++) {
        const strike_outcome *o = &l->arrival[i].is;
        if (o->impact_velocity >= velocity && (strike_class)o->class == above) return o->impact_velocity;
    }
    return NAN;
}

/* Of all arrivals, the strike's own too: the fastest held below all that are above, and the slowest above beyond all
 * that are held, so where the limit turns back both are outside. */
bool study_strike_limit_ends(strike_limit *l, strike_class above)
{
    const double slowest = slowest_above(l, above, 0.0), fastest = study_strike_fastest_held(l, above, INFINITY);
    l->interval[0] = study_strike_fastest_held(l, above, isnan(slowest) ? INFINITY : slowest);
    l->interval[1] = slowest_above(l, above, isnan(fastest) ? 0.0 : fastest);
    if (fastest > slowest && isnan(l->interval[1])) l->interval[1] = fastest; /* of all, held: no further is known */
    l->velocity = 0.5 * (l->interval[0] + l->interval[1]);
    return !(fastest > slowest);
}
