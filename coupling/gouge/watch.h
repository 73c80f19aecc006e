/* SPDX-License-Identifier: BSD-3-Clause */
/* The watch over a gouging scene: what is looked at between its pieces, when it is over, what it has come to.
 *
 * Over, before its end time, is a scene whose growth is known where that judges it (gouge_scene.gauged), and one that
 * is settled (stop_when_settled).  Settled where the groove is followed: the groove is dead, or the contact face
 * has gone over its front.  Settled else: the contact face has crossed the fine zone at its first speed, and no intact
 * rail point in the crater's map could still move a tenth of the measuring depth until the end at its present speed.
 */
#ifndef BREECH_COUPLING_GOUGE_WATCH_H
#define BREECH_COUPLING_GOUGE_WATCH_H

#include "coupling/gouge/growth.h"
#include "coupling/gouge/metal.h"
#include "coupling/run/scene_result.h"
#include "coupling/scene/scene_run.h"

/* From step to step; plain bytes, part of every checkpoint. */
typedef struct {
    gouge_front front;
    gouge_gauges gauges;
    double gauge_length_over_width; /* of the crater at the second gauge, NAN without one; 0: not yet [1] */
    double gauge_length;            /* of that crater [m] */
    gouge_metal start;              /* the armature's at the start */
} gouge_watched;

/* Zero but for `scene` and `timing`, its address in scene_watch.user; free found with gouge_crater_free. */
typedef struct {
    const gouge_scene *scene; /* borrowed */
    timing *timing;           /* borrowed; NULL: none */
    gouge_watched state;
    gouge_metal end;     /* the rest is filled when the scene is over; the armature's then */
    crater found;        /* owned */
    double growth;       /* gouge_growth [1/s] */
    bool growth_decides; /* followed to its second gauge, or until it died or the contact face had passed it */
    bool face_passed;    /* it did not grow, but the contact face had passed where it begins: not known why */
    double front_speed;  /* gouge_front_speed [m/s] */
    double carried[RESULT_BODIES]; /* gouge_carried_volumes [m3] */
    double failed[RESULT_BODIES];  /* of each body, as computed [m3] */
    mpm_body_report rail, armature;
    double peak_force[3]; /* on the rail and what is welded to it, as computed [N] */
} gouge_watch;

scene_watch gouge_watch_of(gouge_watch *w);

/* The manual's list of what it adds to a scene's history, in markdown. */
void gouge_watch_print_columns(FILE *out);

#endif
