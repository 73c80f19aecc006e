/* SPDX-License-Identifier: BSD-3-Clause */
/* Random shots over threshold surfaces: how many grains gouge, where first, how much.
 *
 * Surfaces (a rail under a treatment, or one with a changed input) meet the same grains: every random number is drawn
 * once and used by all, so differences between surfaces are not blurred by chance.
 * What is not known is drawn too, once a world: where in its band a family's threshold lies (u_b), how far cells and
 * uncertain inputs have moved it (a share u_a of what is allowed for them below or above), and how far the place of
 * the grid has (a share u_o of that; threshold.h).  u_a is one number for all, since cells and metals err alike on all
 * surfaces; u_b and u_o are drawn for every surface and family:
 * v_th(r) = low(r) + u_b (high(r) - low(r)) + u_a alike + u_o own,  u_a and u_o in -1 .. 1.
 * Of each number one world lies in every MC_WORLDS-th of what it may be, in an order of its own: a Latin hypercube.
 * A history is a rail under `shots` shots.  A gouge leaves a rim downstream, which is a grain of the same family to
 * the next shot: its place and height, in radii of the grain that made it, by the scenes that gouged (gouge_law.h);
 * its radius is its height over the family's aspect.  What else the shots leave for those after them is the caller's
 * to say (repeated.h): `along`, `changed`, `bare`. Populations are a Poisson process; grains that no surface could
 * gouge with are not drawn. */
#ifndef BREECH_COUPLING_MONTECARLO_H
#define BREECH_COUPLING_MONTECARLO_H

#include "coupling/host/progress.h"
#include "coupling/study/search/family.h"

enum { MC_WORLDS = 1000, MC_BINS = 1000, MC_PLACES = 1024, MC_PIECES = 20 };

/* How a rail is another one than that of `grains`: it is warmer [K], its layers are worn by so much [m], so much of the
 * armature's metal lies on it [m]. */
typedef enum { MC_WARMTH, MC_WEAR, MC_METAL, MC_CHANGES } mc_change;

/* What a shot of one number finds along the barrel, at MC_PLACES equal steps. */
typedef struct {
    double v[MC_PLACES + 1];                /* of the armature [m/s] */
    double left[MC_CHANGES][MC_PLACES + 1]; /* by the shots before it [K, m, m] */
} mc_along;

/* The same grains on a rail that is changed by `most`; in between thresholds and craters are linear. */
typedef struct {
    const grain_families *grains; /* borrowed; NULL: this change is not looked at */
    double most;                  /* [K, m, m] */
} mc_changed;

/* One surface. */
typedef struct {
    const grain_families *grains; /* borrowed, as all that follows */
    int draws;          /* surfaces with the same number share their u_b and u_o: the same thresholds, other inputs */
    double size_factor; /* on every grain (a sensitivity); else 1 */
    const mc_along *along;          /* [shots]; NULL: every shot is that of `grains`, and finds its rail */
    mc_changed changed[MC_CHANGES]; /* their factors on a threshold are multiplied: study_mc_threshold_changed */
    const grain_families *bare;     /* for rims where a gouge wore the layers through; NULL: as all others */
} mc_surface;

typedef struct {
    int histories, shots, seed;
    double length; /* of the barrel [m] */
    int n;
    const mc_surface *surface; /* n; the first says what populations and sites there are; borrowed */
    bool (*stop)(void);        /* asked while grains are drawn; NULL: never */
    progress *progress;        /* borrowed; NULL: none */
} mc_plan;

/* Of one shot number on one surface, over all histories. */
typedef struct {
    double gouges, volume;                         /* mean number, mean volume, NaN: not known [1, m3] */
    double gouges_interval[2], volume_interval[2]; /* 5 and 95 % of the worlds' means */
    double probability;                            /* that it gouges at all [1] */
    double first[3];        /* place of the first gouge: 5, 50, 95 % of all shots; NaN where so many do not gouge [m] */
    double before[MC_BINS]; /* P(gouge before (k + 1) / MC_BINS of the barrel) [1] */
} mc_shot;

/* Of a population's grains that gouge in one of MC_PIECES equal pieces of the barrel. */
typedef struct {
    double gouges, volume; /* mean number, mean volume in all, NaN: not known [1, m3] */
} mc_strewn;

typedef struct {
    int n, shots, histories;
    mc_shot *of; /* [n x shots], owned */
    int populations;
    mc_strewn *strewn;     /* [n x shots x populations x MC_PIECES], owned */
    double *world_gouges;  /* [n x shots x MC_WORLDS] means, owned */
    double *world_volumes; /* the same for the volume [m3], owned */
    double seconds;        /* that it took [s] */
} mc_result;

/* v of an mc_along, no more of it. */
void study_mc_velocities(const shot_outcome *flown, double length, double v[MC_PLACES + 1]);

/* A threshold times the factor of one change of the rail: a share, 0 .. 1, of what takes `cold`, that of the rail as
 * new, to `hot`, that of the changed one.  Where one of the two never gouges (INFINITY), the nearer one says [m/s]. */
double study_mc_threshold_changed(double threshold, double cold, double hot, double share);

/* *out needs study_mc_free even on error.  STATUS_STOPPED: nothing of it can be used. */
status study_mc_run(const mc_plan *plan, mc_result *out);
void study_mc_free(mc_result *r);

/* A surface over all its shots: means of one. */
typedef struct {
    double gouges, volume, probability;            /* as in mc_shot [1, m3, 1] */
    double gouges_interval[2], volume_interval[2]; /* [1, m3] */
    double world_gouges[MC_WORLDS];                /* [1] */
} mc_mean_shot;
void study_mc_mean_shot(const mc_result *r, int surface, mc_mean_shot *out);

/* Of one surface in the middle of its bands, by quadrature: expected number of gouges [1]. */
double study_mc_expected(const grain_families *grains, double length);

#endif
