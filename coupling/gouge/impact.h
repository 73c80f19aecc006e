/* SPDX-License-Identifier: BSD-3-Clause */
/* One impact of the armature on a grain: its scene run under the watch, and what came of it for rail and armature. */
#ifndef BREECH_COUPLING_GOUGE_IMPACT_H
#define BREECH_COUPLING_GOUGE_IMPACT_H

#include "coupling/gouge/impact_scene.h"
#include "coupling/gouge/result.h"
#include "coupling/run/impact_job.h"

typedef struct {
    const char *name; /* plain (outdir.h) */
    const char *task; /* for people: "scene 3, 1480 m/s" */
    gouge_scene scene;
    int snapshots;              /* as in scene_job, and the rest too */
    double checkpoint_interval; /* [s] */
    scene_resume resume;
    uint64_t twin;
} gouge_job;

/* The impact's scene, and what it says of output; name and task are the caller's, who frees the job; after an error it
 * is empty. */
status gouge_job_make(const case_impact *c, gouge_job *job);
void gouge_job_free(gouge_job *job);

/* The crater goes into the host's history, unless the scene ends before it is whole.
 * STATUS_STOPPED: saved through host->save.  STATUS_NUMERICAL as mpm_advance. */
status gouge_job_run(const gouge_job *job, const scene_host *host, impact *out);

/* The impact_runner: makes the scene and runs it. */
status gouge_run(const impact_job *job, const scene_host *host, impact *out);

#endif
