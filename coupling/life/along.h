/* SPDX-License-Identifier: BSD-3-Clause */
/* Life along the barrel: what one passage of an armature takes from the rail at a place, and after how many shots a
 * crack is there.
 *
 * At a place the armature's load runs over the rail at the speed that it has there, in full slip: the strain is that of
 * a load that moves steadily (L-7), with the stress along the face K(v) times that at rest, plus that of the heat
 * (L-10).  One passage is one cycle; between two the rail is cold and free of load.  The range of a direction is over
 * the whole passage, from before the contact to when the current ends.
 *
 * Nothing is redistributed: directions that are cut change no strain.  A crack is there when at some depth the share of
 * the directions whose life is used up comes to the limit.  Shots may differ: life is lost shot by shot, and after the
 * last that was flown every further one is like it. */
#ifndef BREECH_COUPLING_LIFE_ALONG_H
#define BREECH_COUPLING_LIFE_ALONG_H

#include "coupling/life/contact.h"
#include "coupling/life/heat.h"
#include "mpm/fatigue.h"

enum { LIFE_DEPTHS = 48 };

/* The rail, and what of a passage is the same everywhere. */
typedef struct {
    double youngs, poisson, density; /* [Pa, 1, kg/m3] */
    double expansion;                /* NAN: heat strains nothing [1/K] */
    fatigue_law law;
    fatigue_fan fan;
    fatigue_measure measure;
    double limit;                 /* index of a crack [1] */
    double half_length, rounding; /* of the contact [m], of its pressure [1] */
} life_rail;

/* The passage at one place. */
typedef struct {
    double velocity, pressure, friction; /* [m/s, mean Pa, 1]; below the speed of Rayleigh waves */
    life_heat heat;
    double until; /* the current ends, after the contact's front edge came [s] */
} life_passage;

/* The face, then each a quarter deeper than the one before, to 1.5 half lengths. */
double life_along_depth(const life_rail *r, int k); /* [m] */

typedef enum { LIFE_BY_BOTH, LIFE_BY_CONTACT, LIFE_BY_HEAT, LIFE_CAUSES } life_cause;

/* Life that this passage takes from every direction k at depth j: rate[cause][j * fan.n + k]; the load and its heat
 * together, and each as if there were no other. */
void life_along_passage(const life_rail *r, const life_passage *p, double *const rate[LIFE_CAUSES]);

/* Shots at one place: `flight` says which of the rates each shot takes. */
typedef struct {
    int shots;
    const int *flight;         /* shots */
    const double *const *rate; /* of each flight at this place, LIFE_DEPTHS x fan.n */
} life_shots;

typedef struct {
    double life;         /* shots until a crack; below one: in the first; INFINITY: never */
    double first;        /* shots until the first direction is cut there */
    double depth, angle; /* of the crack [m]; of the first direction cut at that depth, from the rail [rad] */
    int depth_number;    /* of life_along_depth */
    double spent;        /* after the shots: life used up of the direction whose loss makes the crack, not capped; the
                             largest at any depth [1] */
} life_place;

/* With A times `factor`. */
life_place life_along_place(const life_rail *r, const life_shots *s, double factor);

#endif
