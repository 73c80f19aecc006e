/* SPDX-License-Identifier: BSD-3-Clause */
/* A session: one run of the program on one case, and what it carries along - output directory, history, progress,
 * timing, checkpoints, the scenes computed so far.
 *
 * The scenes of the run (scenes.h asks for them) are part of every checkpoint, so that a resumed run computes none
 * twice and goes on inside the one it was stopped in, bit for bit.  So are the notes of its study: what else it does
 * not wish to compute twice. */
#ifndef BREECH_COUPLING_SESSION_H
#define BREECH_COUPLING_SESSION_H

#include "coupling/host/outdir.h"
#include "coupling/run/checkpoint.h"
#include "coupling/run/impact_job.h"
#include "coupling/run/scene_entry.h"

/* A scene that was computed. */
typedef struct {
    onset_scene entry;
    double impulse, mass_loss; /* as impact */
    uint64_t key;              /* hash of all that decides it, scene_key.h */
    bool of_bodies;            /* no more of the entry than its name; the result lies by its series (scene_bodies.h) */
} scene_record;

/* What a study has worked out besides scenes. */
typedef struct {
    char name[SUMMARY_NAME_SIZE];
    size_t bytes;
    char *data; /* bytes and a 0 behind them, owned */
} session_note;

typedef struct {
    outdir dir;
    history *history;
    progress progress;
    timing timing;
    int threads;
    struct lending *lending; /* borrowed; NULL: there is none */
    bool (*stop)(void);
    impact_runner run_scene;
    checkpoint_key key;
    checkpoint resumed;           /* empty unless the run goes on */
    double started, wall_before;  /* wall clock; spent before this process [s] */
    char store[OUTDIR_PATH_SIZE]; /* folder of the scene store, "": none */
    bool started_over;            /* by --force: the snapshots of the former run are gone */
    struct crew *crew;            /* the other processes (crew.h), owned; NULL: there are none */
    scene_shelf shelf;            /* of this process */
    int n_records;
    scene_record **record; /* in the order they came; owned, one by one */
    int n_notes;
    session_note *note;         /* owned */
    bool notes_unsaved;         /* the checkpoint on the disk lacks some of them */
    double saved, save_seconds; /* when the last checkpoint was written, of host_wall_clock; what that took [s] */
    char *warnings;             /* a line each, owned */
} session;

typedef struct {
    const char *command; /* its name: a run is resumed by the same command only */
    const char *dir;     /* NULL: out/<case> */
    const char *store;   /* NULL: <dir>/store; "": none */
    outdir_options how;  /* --force, --resume */
    int threads;
    int side_by_side;        /* scenes that one machine can hold; 0: as many as there are processes */
    struct lending *lending; /* between processes (lending.h), borrowed; NULL: none */
    impact_runner run_scene; /* gouge_run, or a test's; the same in all processes */
    FILE *progress_to;
    bool quiet;
    bool (*stop)(void);
} session_options;

/* Opens the output directory, writes used.yaml, takes up the checkpoint.  *s stays where it is until run_session_close.
 * s->dir.state OUTDIR_FINISHED: nothing to do.  STATUS_BAD_INPUT: what is to be resumed is of another command, case or
 * values; it stays as it is.  run_session_close is due in any case. */
status run_session_open(const case_inputs *in, const session_options *o, session *s);
/* Writes what the checkpoint lacks of the notes, flushes the history, frees all.  finished: the checkpoint has
 * served. */
status run_session_close(session *s, bool finished);

double run_session_wall(const session *s); /* spent by the run, the stopped parts too [s] */
void run_session_warn(session *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* For run_session_open and _close: where the checkpoint lies; takes up what it holds. */
status run_session_checkpoint_path(const session *s, char path[OUTDIR_PATH_SIZE]);
status run_session_take_up(session *s);

/* The note of that name; NULL: there is none.  Borrowed until the next is added or dropped. */
const session_note *run_session_note(const session *s, const char *name);
/* Puts a copy of the bytes behind those that the note of that name has.  Writes a checkpoint unless the last one was
 * written a moment ago: a run that is killed loses a few seconds, one that is stopped or fails nothing. */
status run_session_note_add(session *s, const char *name, const void *bytes, size_t n);
/* Forgets all notes whose names begin so. */
void run_session_note_drop(session *s, const char *beginning);
/* Writes a checkpoint with them, where the one on the disk lacks some; for run_session_close. */
status run_session_note_save(session *s);
/* The same without a checkpoint. */
status run_session_note_append(session *s, const char *name, const void *bytes, size_t n);
/* For the checkpoint: all of them, malloc'ed; takes up what that gave, of the given number of them. */
status run_session_notes_pack(const session *s, char **out, size_t *bytes);
status run_session_notes_unpack(session *s, const char *from, size_t bytes, size_t notes);

/* Takes a copy of the record, flushes the history, writes the checkpoint. */
status run_session_keep(session *s, const scene_record *fresh);
/* A checkpoint inside a scene: the scene_host's save, the session its user. */
status run_session_save_inside(void *session, const char *scene, const scene_now *now);
/* Where the scene of this name is to be taken up; from the start unless the run was stopped inside it. */
scene_resume run_session_resume_of(const session *s, const char *scene);

#endif
