/* SPDX-License-Identifier: BSD-3-Clause */
/* How fast a groove grows and how fast its front runs: plastic power and front (front.h), noted at the gauges.
 *
 * growth = ln(P2 / P1) / (t2 - t1), P the power at the first look after each gauge.  Positive: the groove would go on
 * as long as the armature presses on it.
 * front speed = slope of the least-squares line through the front's place over time, all looks from the first one after
 * the first gauge to the first one after the second.  The front is known to a slice of two cells, so two looks alone
 * would be too coarse. */
#ifndef BREECH_COUPLING_GROWTH_H
#define BREECH_COUPLING_GROWTH_H

#include "coupling/gouge/front.h"

/* What was noted; all zero at a scene's start.  Plain bytes: part of a checkpoint. */
typedef struct {
    double at[2], power[2]; /* first look at or after each gauge; 0: not yet [s, W] */
    /* Sums over the looks between the gauges, both ends included; t from at[0], x from `from`. */
    double looks, from, last; /* number of them, front at the first [m], time of the last [s] */
    double t, x, tt, tx;      /* [s, m, s2, m s] */
    double most;              /* largest power since the second gauge, 0 before [W] */
} gouge_gauges;

/* The two times for a grain of that radius under an armature of that speed [s]. */
void gouge_gauge_times(double radius, double velocity, double time[2]);
/* The armature's way to the second one, in grain radii [1]. */
double gouge_gauge_way(void);

/* After every step. */
void gouge_gauges_note(const gouge_scene *s, const gouge_front *now, gouge_gauges *g);

/* From the first gauge to the second, or as far as it has come; NAN before [1/s]. */
double gouge_growth(const gouge_gauges *g, const gouge_front *now);
/* Of the front, over the same way; NAN before its second look [m/s]. */
double gouge_front_speed(const gouge_gauges *g);

/* Level of the smallest cells that the groove still needs, after its second gauge: one level is given up each time it
 * has become twice as wide as it was at the first, so that as many cells as then lie across it.  Power goes with the
 * section that is ploughed: four times as much then.  Never less than before. */
int gouge_finest_level(const gouge_scene *s, const gouge_gauges *g);

/* Length of the shortest crater at the second gauge that is a groove's, of a grain of that radius: as far as two fluids
 * of these densities that meet head on would dig from gauge to gauge.  A shorter one has not left its grain [m]. */
double gouge_shortest_groove(double radius, double density_armature, double density_rail);

/* A growth [1/s] as e-folds over the way between the two gauges [1]; one that died before the first has the growth NAN
 * and counts as -3, and none as less. */
double gouge_growth_folds(double growth, double radius, double velocity);

/* What passes zero where a groove that grows becomes a gouge, a tear-drop instead of a furrow: the smaller of its
 * growth in e-folds and of ln(limit / length over width) [1].  A groove without a crater (NAN) counts as dead. */
double gouge_tear_drop_excess(double folds, double length_over_width, double limit);

/* At that time, half way between its gauges or later: does the groove's plastic power fall so fast that the rest of the
 * way would not change the answer? */
bool gouge_groove_dies(const gouge_scene *s, const gouge_gauges *g, const gouge_front *now, double time);

#endif
