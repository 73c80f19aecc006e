/* SPDX-License-Identifier: BSD-3-Clause */
/* What a session keeps in its checkpoint, and takes up from one. */
#include "coupling/run/session.h"

#include <stdlib.h>
#include <string.h>

double run_session_wall(const session *s)
{
    return s->wall_before + host_wall_clock() - s->started;
}

/* ---- checkpoints: a head that says how many there are, the records one after the other, the notes ---- */

typedef struct {
    uint64_t scenes, scene_bytes, notes, note_bytes;
    double scene_wall; /* spent in the scene under way [s] */
} store_head;

status run_session_checkpoint_path(const session *s, char path[OUTDIR_PATH_SIZE])
{
    return host_outdir_file(&s->dir, OUTDIR_CHECKPOINT, path, OUTDIR_PATH_SIZE);
}

/* All that the study keeps, one after the other; the caller's. */
static status pack(const session *s, double scene_wall, char **study, size_t *bytes)
{
    char *notes;
    size_t note_bytes;
    const size_t scene_bytes = (size_t)s->n_records * sizeof(scene_record);
    TRY(run_session_notes_pack(s, &notes, &note_bytes));
    const store_head head = { (uint64_t)s->n_records, sizeof(scene_record), (uint64_t)s->n_notes, note_bytes,
                              scene_wall };
    *bytes = sizeof head + scene_bytes + note_bytes;
    char *at = *study = malloc(*bytes);
    if (at) {
        memcpy(at, &head, sizeof head);
        at += sizeof head;
        for (int i = 0; i < s->n_records; i++, at += sizeof(scene_record))
            memcpy(at, s->record[i], sizeof(scene_record));
        memcpy(at, notes, note_bytes);
    }
    free(notes);
    CHECK(at, STATUS_MEMORY, "no memory for a checkpoint of %d scenes", s->n_records);
    return status_ok();
}

/* The history first: rows later than the checkpoint are dropped by the run that goes on, missing ones would be lost. */
static status write_checkpoint(session *s, checkpoint *c, double scene_wall)
{
    char path[OUTDIR_PATH_SIZE], *study;
    const double since = host_wall_clock();
    TRY(run_session_checkpoint_path(s, path));
    TRY(output_history_flush(s->history));
    TRY(pack(s, scene_wall, &study, &c->study_bytes));
    c->study = study;
    c->wall_seconds = run_session_wall(s);
    const status done = run_checkpoint_write(path, &s->key, c);
    free(study);
    s->saved = host_wall_clock();
    s->save_seconds = s->saved - since;
    if (done.code == STATUS_OK) s->notes_unsaved = false;
    return done;
}

status run_session_note_save(session *s)
{
    checkpoint between = { .scene = "" };
    return s->notes_unsaved ? write_checkpoint(s, &between, 0.0) : status_ok();
}

status run_session_note_add(session *s, const char *name, const void *bytes, size_t n)
{
    static const double PAUSE = 2.0, SHARE = 20.0; /* [s], and of the time at most one part in so many */
    TRY(run_session_note_append(s, name, bytes, n));
    s->notes_unsaved = true;
    const double since = host_wall_clock() - s->saved;
    return since < PAUSE || since < SHARE * s->save_seconds ? status_ok() : run_session_note_save(s);
}

static status add_record(session *s, const scene_record *from)
{
    scene_record *copy = malloc(sizeof *copy);
    scene_record **more = realloc(s->record, ((size_t)s->n_records + 1) * sizeof *more);
    if (more) s->record = more;
    if (!copy || !more) {
        free(copy);
        return base_status_error(STATUS_MEMORY, "no memory for %d scenes", s->n_records + 1);
    }
    memcpy(copy, from, sizeof *copy);
    s->record[s->n_records++] = copy;
    return status_ok();
}

status run_session_take_up(session *s)
{
    char path[OUTDIR_PATH_SIZE];
    store_head head;
    TRY(run_session_checkpoint_path(s, path));
    TRY(run_checkpoint_read(path, &s->key, &s->resumed));
    CHECK(s->resumed.study_bytes >= sizeof head, STATUS_IO, "%.300s: holds no study; start over with --force", path);
    memcpy(&head, s->resumed.study, sizeof head);
    CHECK(head.scene_bytes == sizeof(scene_record) &&
              s->resumed.study_bytes == sizeof head + head.scenes * sizeof(scene_record) + head.note_bytes,
          STATUS_IO, "%.300s: its scenes are of another build; start over with --force", path);
    const char *at = (const char *)s->resumed.study + sizeof head;
    for (size_t i = 0; i < head.scenes; i++, at += sizeof(scene_record)) {
        scene_record one;
        memcpy(&one, at, sizeof one);
        TRY(add_record(s, &one));
    }
    TRY(run_session_notes_unpack(s, at, (size_t)head.note_bytes, (size_t)head.notes));
    s->wall_before = s->resumed.wall_seconds;
    return status_ok();
}

static double resumed_scene_wall(const session *s)
{
    store_head head;
    memcpy(&head, s->resumed.study, sizeof head);
    return head.scene_wall;
}

/* ---- inside a scene, and after one ---- */

status run_session_save_inside(void *user, const char *scene, const scene_now *now)
{
    session *s = user;
    checkpoint c = { .scene_hash = host_hash_bytes(0, scene, strlen(scene)), .scene_time = mpm_glance(now->m).time };
    void *image = NULL;
    snprintf(c.scene, sizeof c.scene, "%s", scene);
    TRY(scene_image(now, &image, &c.image_bytes));
    c.image = image;
    const status done = write_checkpoint(s, &c, now->wall);
    free(image);
    return done;
}

scene_resume run_session_resume_of(const session *s, const char *scene)
{
    if (!s->resumed.image || strcmp(s->resumed.scene, scene) != 0) return (scene_resume){ .image = NULL };
    return (scene_resume){ s->resumed.image, s->resumed.image_bytes, s->resumed.scene_time, resumed_scene_wall(s) };
}

status run_session_keep(session *s, const scene_record *fresh)
{
    checkpoint between = { .scene = "" };
    TRY(add_record(s, fresh));
    return write_checkpoint(s, &between, 0.0);
}
