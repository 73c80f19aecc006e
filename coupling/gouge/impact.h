/* One impact of the armature on a grain: its scene run under the watch, and what came of it for rail and armature. */
#ifndef BREECH_COUPLING_GOUGE_IMPACT_H
#define BREECH_COUPLING_GOUGE_IMPACT_H

#include "coupling/gouge/result.h"
#include "coupling/gouge/scene_from_state.h"
#include "coupling/scene/scene_run.h"

typedef struct {
    const char *name; /* plain (outdir.h) */
    const char *task; /* for people: "scene 3, 1480 m/s" */
    gouge_scene scene;
    int snapshots;              /* as in scene_job, and the rest too */
    double checkpoint_interval; /* [s] */
    scene_resume resume;
    uint64_t twin;
} gouge_job;

typedef struct {
    scene_result result;
    /* What the impact took from the armature, full model: its momentum along the rail at the start less that of its
     * sound metal at the end and less what smooth friction would have taken [N s]; 0 if less. */
    double impulse;
    double mass_loss; /* armature metal that failed, or was left behind slower than half the armature's speed [kg] */
} impact;

/* The job's scene for this state, and what the impact says of output; name and task are the caller's, who frees the
 * job; after an error it is empty. */
status gouge_job_make(const case_impact *c, const site_state *state, double cells_per_radius, gouge_job *job);
void gouge_job_free(gouge_job *job);

/* The crater goes into the host's history, unless the scene ends before it is whole.
 * STATUS_STOPPED: saved through host->save.  STATUS_NUMERICAL as mpm_advance. */
status gouge_run(const gouge_job *job, const scene_host *host, impact *out);

#endif
