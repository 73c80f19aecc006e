/* SPDX-License-Identifier: BSD-3-Clause */
/* Any scene by itself: run with the motion of each of its bodies on record, and its result.
 *
 * History: /scene/<name> as scene_run writes it, what scene_probe.h says, and
 * /scene/<name>/bodies/<body>/{mass, position_x, ...}, a row a piece.
 * All sums as computed: of a model that is cut by a mirror plane, its part. */
#ifndef BREECH_COUPLING_SCENE_BODIES_H
#define BREECH_COUPLING_SCENE_BODIES_H

#include "coupling/output/summary.h"
#include "coupling/scene/scene_probe.h"
#include "coupling/scene/scene_run.h"

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    double mass;                     /* in the window [kg] */
    double position[3], velocity[3]; /* means over its mass [m, m/s]; NAN where nothing is left */
    double lo[3], hi[3];             /* how far its intact material reaches [m]; NAN where there is none */
    double kinetic, internal;        /* [J] */
    double failed_volume;            /* [m3] */
    double peak_pressure;            /* largest so far of the 99.9th percentile by mass, of intact points [Pa] */
    double max_pressure, peak_mises; /* of any intact point so far [Pa] */
} scene_body;

typedef struct {
    int bodies;
    scene_body *body; /* at the end; owned */
    int probes;
    scene_probe_result *probe;             /* owned */
    double end_time;                       /* [s] */
    double peak_pressure;                  /* the largest of the bodies' [Pa] */
    double max_pressure, peak_temperature; /* of any intact point so far [Pa, K] */
    double kinetic, internal;              /* [J] */
    double heat_friction;                  /* part of internal [J] */
    double work_boundary, work_external;   /* [J] */
    double ejected_mass, eroded_mass;      /* [kg] */
    double momentum_error, energy_error;   /* [1] */
#define WORK(member, text) uint64_t member;
#include "coupling/scene/scene_work.def"
    double wall_seconds; /* [s] */
    int threads;
} scene_bodies_result;

extern const summary_key scene_bodies_keys[]; /* of scene_bodies_result */

/* job->watch must be NULL.  *out is for scene_bodies_free in any case.  STATUS_STOPPED as scene_run. */
status scene_bodies_run(const scene_job *job, const scene_host *host, scene_bodies_result *out);
/* The result of a scene that has ended, from /scene/<name>/result of the history it was run or taken up in: one object
 * of scene_bodies_keys.  STATUS_IO: there is none.  *out is for scene_bodies_free in any case. */
status scene_bodies_read(const history *h, const char *name, scene_bodies_result *out);
void scene_bodies_free(scene_bodies_result *r);

#endif
