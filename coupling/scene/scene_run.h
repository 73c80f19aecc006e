/* SPDX-License-Identifier: BSD-3-Clause */
/* One scene from its making to its end, with everything a run writes on the way.  Knows nothing of what the scene is
 * about: that is the watch's.
 *
 * Its time is cut into equal pieces, as many in every scene; after the step that ends one stand the watch's question
 * whether the scene is over and the history's row.  A snapshot follows the step after which it is due.  No step is
 * shortened for them, and no piece: what a run writes changes nothing of what it computes, and one that was stopped and
 * resumed gives the same bits. */
#ifndef BREECH_COUPLING_SCENE_RUN_H
#define BREECH_COUPLING_SCENE_RUN_H

#include "coupling/host/outdir.h"
#include "coupling/host/progress.h"
#include "coupling/output/history.h"
#include "coupling/output/snapshot.h"
#include "coupling/scene/scene_shelf.h"

/* What a user of the runner does between pieces.  A function that is NULL is not wanted. */
typedef struct {
    /* After every step, and again at the end of a piece, so it must give the same answer twice; cheap.  *ends: the
     * piece ends here; false when called. */
    status (*due)(void *user, const mpm *m, const mpm_report *now, bool *ends);
    /* After every step, once it has been seen: the finest level that is still needed (mpm_set_finest). */
    int (*finest)(void *user);
    /* At the start, and at the end of every piece.  *over: the scene ends here; false when called. */
    status (*piece)(void *user, const mpm *m, bool *over);
    /* Once the scene is over.  *keep: worth going on from (scene_job.whole); false when called. */
    status (*finish)(void *user, const mpm *m, bool *keep);
    void *user;         /* borrowed */
    void *state;        /* all that it remembers from step to step, plain bytes: part of every checkpoint; borrowed */
    size_t state_bytes; /* the same in every process that may go on with the scene */
    const history_column *column; /* [columns] what it adds to the rows of the scene's history; borrowed */
    int columns;
    void (*row)(void *user, double *row); /* their values, as it saw them last; wanted where there are columns */
} scene_watch;

/* Where a scene was stopped and can be taken up. */
typedef struct {
    const void *image; /* by scene_image of the same scene and watch; NULL: from the start */
    size_t bytes;
    double time; /* reached [s] */
    double wall; /* spent so far [s] */
} scene_resume;

/* A scene between two steps. */
typedef struct {
    const mpm *m;
    const scene_watch *watch; /* NULL: none */
    double wall;              /* spent in it so far [s] */
} scene_now;

/* What a run offers its scenes; members that are NULL are not wanted.  All borrowed. */
typedef struct {
    const outdir *dir;         /* snapshots go to DIR/scenes/<name> */
    const snapshot_sink *sink; /* or are handed over, as scenes/<name>/... (dir NULL) */
    history *history;          /* takes /scene/<name> */
    progress *progress;
    timing *timing;
    scene_shelf *shelf;             /* keeps scenes that their watch ended early, and is what whole ones go on from */
    int threads;                    /* 0: as many as there are */
    int (*threads_now)(void *user); /* asked after every step: how many from here on; NULL: threads */
    bool (*stop)(void *user);       /* asked after every step; true: save, STATUS_STOPPED */
    /* A checkpoint: on a stop, and every checkpoint_interval.  The history's rows must be safe before it. */
    status (*save)(void *user, const char *scene, const scene_now *now);
    void *user;
} scene_host;

typedef struct {
    const char *name;           /* plain (outdir.h) */
    const char *task;           /* for people: "scene 3, 1480 m/s" */
    const mpm_scene *scene;     /* borrowed, like all pointers here */
    const scene_watch *watch;   /* NULL: none */
    int snapshots;              /* evenly over its time, from its start to its end; 1: of its end; 0: none */
    double checkpoint_interval; /* wall time [s]; 0: after every step */
    int force_on;               /* group whose contact force the history has */
    double last_time;           /* when it will be over, for all that is known before, for the progress line [s] */
    scene_resume resume;
    uint64_t
        twin;   /* the same for a scene that its watch ends early and for the whole one, for no others; 0: not known */
    bool whole; /* goes on from its twin on the shelf; else is put there where its watch keeps it */
} scene_job;

typedef struct {
    mpm_report report;
    mpm_ledger ledger;
    double wall; /* spent, stopped parts too [s] */
    int threads;
} scene_outcome;

/* STATUS_STOPPED: saved through host->save.  STATUS_NUMERICAL as mpm_advance. */
status scene_run(const scene_job *job, const scene_host *host, scene_outcome *out);

/* To go on from, watch's state included.  *image is malloc'ed, the caller frees it. */
status scene_image(const scene_now *now, void **image, size_t *bytes);

#endif
