/* A session: one run of the program on one case, and what it carries along - output directory, history, progress, timing,
 * checkpoints, the scenes computed so far.
 *
 * Scenes are kept by name in a store; the store is part of every checkpoint, so that a resumed run computes no scene twice
 * and goes on inside the one it was stopped in, bit for bit. */
#ifndef BREECH_COUPLING_SESSION_H
#define BREECH_COUPLING_SESSION_H

#include "coupling/handoff/scene_run.h"
#include "coupling/io/checkpoint.h"
#include "coupling/io/outdir.h"

typedef struct {
    onset_scene entry;
    double impulse, mass_loss; /* as impact */
} stored_scene;

typedef struct {
    const breech_case *c; /* borrowed */
    outdir dir;
    history *history;
    progress progress;
    timing timing;
    int threads;
    bool (*stop)(void);
    status (*run_scene)(const scene_job *, const scene_host *, impact *); /* scene_run; tests put another in */
    checkpoint_key key;
    checkpoint resumed;          /* empty unless the run goes on */
    double started, wall_before; /* wall clock; spent before this process [s] */
    int n_store;
    stored_scene *store; /* owned */
    char *warnings;      /* a line each, owned */
} session;

typedef struct {
    const char *dir;    /* NULL: out/<case> */
    outdir_options how; /* --force, --resume */
    int threads;
    FILE *progress_to;
    bool quiet;
    bool (*stop)(void);
} session_options;

/* Opens the output directory, writes used.yaml, takes up the checkpoint.  s->dir.state OUTDIR_FINISHED: nothing to do.
 * session_close is due in any case. */
status session_open(const breech_case *c, const session_options *o, session *s);
/* Flushes the history, frees all.  finished: the checkpoint has served. */
status session_close(session *s, bool finished);

double session_wall(const session *s); /* spent by the run, the stopped parts too [s] */
void session_warn(session *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The scene of that name: from the store, or run, from its checkpoint where there is one.  `about` gives the entry all but
 * its result.  *out is borrowed, valid until the next call. */
status session_scene(session *s, scene_job *job, const onset_scene *about, const stored_scene **out);

/* The shot of the case, with what is asked for in jumps (NULL: none); only the first one of a run writes history. */
status session_shot(session *s, const site_jump *jump, bool with_history, shot_outcome *out, shot_record *record);

#endif
