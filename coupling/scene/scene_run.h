/* One impact scene from its making to its crater, with everything a run writes on the way.
 *
 * Its time is cut into equal pieces; after the step that ends one stand the history's row, a snapshot that is due and
 * the question whether the crater is settled.  No step is shortened for them: what a run writes changes nothing of what
 * it computes, and one that was stopped and resumed gives the same bits.  Settled (scene.stop_when_settled): the
 * armature's contact face has crossed the fine zone at its first speed, and no intact rail point in the crater's map
 * could still move a tenth of the measuring depth until the end at its present speed. */
#ifndef BREECH_COUPLING_SCENE_RUN_H
#define BREECH_COUPLING_SCENE_RUN_H

#include "coupling/gouge/scene_from_state.h"
#include "coupling/host/outdir.h"
#include "coupling/host/progress.h"
#include "coupling/output/history.h"
#include "coupling/output/snapshot.h"
#include "coupling/output/summary.h"
#include "coupling/scene/scene_shelf.h"

/* What a run offers its scenes; members that are NULL are not wanted.  All borrowed. */
typedef struct {
    const outdir *dir;         /* snapshots go to DIR/scenes/<name> */
    const snapshot_sink *sink; /* or are handed over, as scenes/<name>/... (dir NULL) */
    history *history;          /* takes /scene/<name> and its crater */
    progress *progress;
    timing *timing;
    scene_shelf
        *shelf;  /* keeps what ended at its gauge while its groove grew, and is what its whole scene goes on from */
    int threads; /* 0: as many as there are */
    int (*threads_now)(void *user); /* asked after every step: how many from here on; NULL: threads */
    bool (*stop)(void *user);       /* asked after every step; true: save, STATUS_STOPPED */
    /* A checkpoint: on a stop, and every output.checkpoint_interval.  wall: spent in the scene so far [s]. */
    status (*save)(void *user, const char *scene, const mpm *m, double wall);
    void *user;
} scene_host;

/* An image to go on from, made by mpm_save of the same scene. */
typedef struct {
    const void *image; /* NULL: from the start */
    size_t bytes;
    double time; /* reached [s] */
    double wall; /* spent so far [s] */
} scene_resume;

typedef struct {
    const char *name; /* plain (outdir.h) */
    const char *task; /* for people: "scene 3, 1480 m/s" */
    const breech_case *c;
    mpm_scene scene;
    crater_spec spec;
    scene_resume resume;
    uint64_t twin; /* the same for a scene to its gauge and for the whole one, for no others; 0: not known */
} scene_job;

typedef struct {
    scene_result result;
    /* What the impact took from the armature, full model: its momentum along the rail at the start less that of its
     * sound metal at the end and less what smooth friction would have taken [N s]; 0 if less. */
    double impulse;
    double mass_loss; /* armature metal that failed, or was left behind slower than half the armature's speed [kg] */
} impact;

/* job->scene and spec for this state; name and task are the caller's. */
status scene_job_make(const breech_case *c, const site_state *state, double cells_per_radius, scene_job *job);

/* STATUS_STOPPED: saved through host->save.  STATUS_NUMERICAL as mpm_advance. */
status scene_run(const scene_job *job, const scene_host *host, impact *out);

#endif
