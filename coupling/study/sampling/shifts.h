/* SPDX-License-Identifier: BSD-3-Clause */
/* Shifts of a scene's grid against its bodies (mpm_scene.grid_shift), and what its answers do over them: their scatter,
 * what they owe to where the cells happen to lie.
 *
 * The first grid is the scene's own, the next ones move by a sequence that fills the unit cube evenly whatever its
 * length, so that a larger ensemble takes up the scenes of a smaller one. */
#ifndef BREECH_COUPLING_SHIFTS_H
#define BREECH_COUPLING_SHIFTS_H

/* The shift of the i-th grid, from 0, of a scene whose own shift is `own`: in 0 .. 1 along each axis [cells]. */
void study_shift_of(int i, const double own[3], double out[3]);

/* Of the numbers that are there; how many of n.  deviation: by one less than these, NAN of fewer than two. */
typedef struct {
    int scenes;
    double mean, deviation, least, largest; /* in the values' unit */
} shift_spread;
shift_spread study_shift_spread(const double *value, int n);

#endif
