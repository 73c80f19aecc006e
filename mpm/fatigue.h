/* SPDX-License-Identifier: BSD-3-Clause */
/* Life by direction: how many equal load cycles a point of a solid lasts, direction by direction in a plane.
 *
 *   lambda(0) = 1    d lambda / dN = - A eps^m    N = lambda / (A eps^m) cycles are left            (L-1)
 *
 * Source: Silling and Askari, Peridynamic model for fatigue cracking, SAND2014-18590 (first phase).  lambda is the life
 * that a direction has left [1], eps the range of its strain in a cycle [1], A [1] and m [1] constants of the metal
 * (material.h).  A range below the fatigue limit takes nothing.  A direction whose life is used up is cut for good.
 *
 * The strain of the direction n = (cos a, sin a) is  e = n . strain . n.  Of a cycle that runs between a least and a
 * largest e, both of which a cycle from and to no load makes hold zero, each measure has its own range:
 *   bond     largest - least: blind to the sign, so that compression takes life as tension does   (the paper's)
 *   tension  largest: compression takes none
 *   shear    range of 2 t . strain . n / (1 + nu), t across n: so scaled that a bar in tension lasts as long by all
 * No state of the solver; structs in, structs out. */
#ifndef BREECH_MPM_FATIGUE_H
#define BREECH_MPM_FATIGUE_H

#include "mpm/material.h"

#include <stdbool.h>

enum { FATIGUE_MAX_DIRECTIONS = 180 };

typedef enum { FATIGUE_BOND, FATIGUE_TENSION, FATIGUE_SHEAR } fatigue_measure;
extern const char *const mpm_fatigue_measure_names[]; /* "bond", ..., NULL */

/* Of a material: fatigue_A, fatigue_m; limit 0 where it has no fatigue_limit. */
typedef struct {
    double A, m, limit; /* [1, 1, strain range] */
} fatigue_law;
fatigue_law mpm_fatigue_law(const mpm_material *m);
double mpm_fatigue_rate(const fatigue_law *law, double range);   /* life that a cycle takes [1] */
double mpm_fatigue_cycles(const fatigue_law *law, double range); /* of a whole life; INFINITY below the limit [1] */

/* The directions of a point, angles from the first axis [rad].  A share says how much of a point's bonds is lost with
 * the direction, a stiffness how much of its elasticity; both add up to 1, and the stiffness is isotropic. */
typedef struct {
    int n;
    double angle[FATIGUE_MAX_DIRECTIONS];                                    /* [rad] */
    double cosine[FATIGUE_MAX_DIRECTIONS], sine[FATIGUE_MAX_DIRECTIONS];     /* of the angles [1] */
    double share[FATIGUE_MAX_DIRECTIONS], stiffness[FATIGUE_MAX_DIRECTIONS]; /* [1] */
} fatigue_fan;
/* n at equal angles, 3 .. FATIGUE_MAX_DIRECTIONS. */
fatigue_fan mpm_fatigue_fan_even(int n);
/* The 28 bonds of a square lattice within 3.015 of its spacing: 8 directions, shares by the number of bonds, stiffness
 * by their lengths, along the axes 8 % less than that, which makes it isotropic. */
fatigue_fan mpm_fatigue_fan_lattice(void);

/* Strain of direction k by a measure, before the range is taken; strain: xx, yy, and gamma = 2 xy [1]. */
double mpm_fatigue_strain(const fatigue_fan *fan, int k, fatigue_measure measure, double poisson,
                          const double strain[3]);
/* Between which strains every direction runs in a cycle from and to no load: zeros at first. */
typedef struct {
    double least[FATIGUE_MAX_DIRECTIONS], largest[FATIGUE_MAX_DIRECTIONS]; /* [1] */
} fatigue_extremes;
void mpm_fatigue_take(const fatigue_fan *fan, fatigue_measure measure, double poisson, const double strain[3],
                      fatigue_extremes *of);
/* Of a cycle between these two; zero is added to both where they do not hold it. */
double mpm_fatigue_range(fatigue_measure measure, double least, double largest);

/* ---- many points ---- */

/* A direction that is cut. */
typedef struct {
    int point, direction;
    double cycles; /* when it was cut [1] */
} fatigue_cut;

/* Points under a load that comes again and again.  Between two cuts every range stays what it is, so the cycles up to
 * the next cut are jumped over exactly: the least of lambda / (A eps^m), with the ranges before the cut. */
typedef struct {
    int points;
    fatigue_fan fan;
    fatigue_law law;
    double cycles;    /* so far [1] */
    double *life;     /* points x fan.n: lambda, what is left of each life; owned [1] */
    double *rate;     /* the same: what a cycle takes of it now; owned [1] */
    bool *is_cut;     /* the same; owned */
    double *index;    /* points: fraction of the directions that are cut; owned [1] */
    fatigue_cut *cut; /* in their order, n_cuts of points x fan.n at most; owned */
    int n_cuts;
} fatigue_points;
status mpm_fatigue_create(int points, const fatigue_fan *fan, const fatigue_law *law, fatigue_points *out);
void mpm_fatigue_free(fatigue_points *f);

/* Range of direction k of a point in the cycles that follow. */
void mpm_fatigue_set_range(fatigue_points *f, int point, int k, double range);
/* Cycles until the next direction is cut with these ranges; INFINITY: none ever is. */
double mpm_fatigue_wait(const fatigue_points *f);
/* Goes on to the next cut, and on to those that follow with these ranges before the cycles are (1 + batch) times as
 * many; those within a share of 1e-9 are one event in any case.  STATUS_BAD_INPUT: nothing is ever cut. */
status mpm_fatigue_jump(fatigue_points *f, double batch);
/* Cycles, those so far included, until this point's index is `limit` with these ranges for good; INFINITY: never. */
double mpm_fatigue_alone(const fatigue_points *f, int point, double limit);

#endif
