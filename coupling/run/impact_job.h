/* SPDX-License-Identifier: BSD-3-Clause */
/* An impact as this room knows it: plain numbers that are asked for and plain numbers that come back.
 *
 * How its scene is made, when it is over and what its crater is stands above, in gouge/; that comes in as an
 * impact_runner, chosen by whoever opens a session. */
#ifndef BREECH_COUPLING_IMPACT_JOB_H
#define BREECH_COUPLING_IMPACT_JOB_H

#include "coupling/case/case_plain.h"
#include "coupling/run/scene_result.h"
#include "coupling/scene/scene_run.h"

typedef struct {
    const char *name; /* plain (outdir.h) */
    const char *task; /* for people: "scene 3, 1480 m/s" */
    case_impact of;   /* all that decides its scene */
    scene_resume resume;
    uint64_t twin; /* as in scene_job */
} impact_job;

typedef struct {
    scene_result result;
    /* What the impact took from the armature, full model: its momentum along the rail at the start less that of its
     * sound metal at the end and less what smooth friction would have taken [N s]; 0 if less. */
    double impulse;
    double mass_loss; /* armature metal that failed, or was left behind slower than half the armature's speed [kg] */
} impact;

/* STATUS_STOPPED: saved through host->save.  STATUS_BAD_INPUT: a scene that cannot be built.  STATUS_NUMERICAL as
 * mpm_advance. */
typedef status (*impact_runner)(const impact_job *, const scene_host *, impact *);

#endif
