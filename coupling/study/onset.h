/* The main job: where along the rail does gouging begin?
 *
 *   shot -> every site's state at arrival -> screen -> for each kind of grain the threshold velocity (threshold.h), by
 *   scenes -> sites judged by their velocity against the interval -> gouges handed back to the shot.
 * A kind of grain: radius, height, shape, material and bond; sites of one kind share its scenes.  A scene's contact pressure
 * is the shot's where it has the scene's velocity, in steps of 5 MPa, unless the case gives one.
 * A site at v gouges from the interval's upper end on, does not up to its lower end, and is undecided between. */
#ifndef BREECH_COUPLING_ONSET_H
#define BREECH_COUPLING_ONSET_H

#include "coupling/study/session.h"
#include "coupling/study/threshold.h"

/* The threshold of one kind of grain. */
typedef struct {
    case_site grain; /* of its first site */
    int sites;       /* that need an answer */
    threshold_result threshold;
    double pressure_low, pressure_high; /* of its scenes [Pa] */
} grain_kind;

typedef struct {
    onset_result result; /* borrows the arrays below */
    shot_record shot;
    onset_site *site;   /* owned */
    onset_scene *scene; /* owned */
    int kinds;
    grain_kind *kind;             /* owned */
    int *kind_of;                 /* of each site, owned; -1: needs none */
    double threshold_position[3]; /* x(v) of the threshold and of its interval's ends; NaN: never [m] */
    double muzzle_velocity_fed;   /* with the gouges' impulse and mass loss; NaN: no feedback [m/s] */
    int gouges;                   /* sites that gouge */
} onset_answer;

/* *out needs onset_answer_free even on error; what was reached by then is in it. */
status onset_run(session *s, onset_answer *out);
void onset_answer_free(onset_answer *a);

#endif
