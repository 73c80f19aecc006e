#include "coupling/run/session.h"

#include "coupling/run/crew.h"
#include "coupling/run/ranks.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

double run_session_wall(const session *s)
{
    return s->wall_before + host_wall_clock() - s->started;
}

void run_session_warn(session *s, const char *format, ...)
{
    char line[600];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    const size_t old = s->warnings ? strlen(s->warnings) : 0, more = strlen(line);
    char *all = realloc(s->warnings, old + more + 2);
    if (!all) return;
    snprintf(all + old, more + 2, "%s\n", line);
    s->warnings = all;
    host_progress_say(&s->progress, "warning: %s", line);
}

/* ---- checkpoints: the records one after the other, after a head that says how many ---- */

typedef struct {
    uint64_t scenes, scene_bytes;
    double scene_wall; /* spent in the scene under way [s] */
} store_head;

static status checkpoint_path(const session *s, char path[OUTDIR_PATH_SIZE])
{
    return host_outdir_file(&s->dir, OUTDIR_CHECKPOINT, path, OUTDIR_PATH_SIZE);
}

static status write_checkpoint(const session *s, checkpoint *c, double scene_wall)
{
    char path[OUTDIR_PATH_SIZE];
    const store_head head = { (uint64_t)s->n_records, sizeof(scene_record), scene_wall };
    const size_t bytes = (size_t)s->n_records * sizeof(scene_record);
    TRY(checkpoint_path(s, path));
    char *study = malloc(sizeof head + bytes);
    CHECK(study, STATUS_MEMORY, "no memory for a checkpoint of %d scenes", s->n_records);
    memcpy(study, &head, sizeof head);
    for (int i = 0; i < s->n_records; i++)
        memcpy(study + sizeof head + (size_t)i * sizeof(scene_record), s->record[i], sizeof(scene_record));
    c->study = study;
    c->study_bytes = sizeof head + bytes;
    c->wall_seconds = run_session_wall(s);
    const status done = run_checkpoint_write(path, &s->key, c);
    free(study);
    return done;
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

static status take_up(session *s)
{
    char path[OUTDIR_PATH_SIZE];
    store_head head;
    TRY(checkpoint_path(s, path));
    TRY(run_checkpoint_read(path, &s->key, &s->resumed));
    CHECK(s->resumed.study_bytes >= sizeof head, STATUS_IO, "%.300s: holds no study; start over with --force", path);
    memcpy(&head, s->resumed.study, sizeof head);
    CHECK(head.scene_bytes == sizeof(scene_record) &&
              s->resumed.study_bytes == sizeof head + head.scenes * sizeof(scene_record),
          STATUS_IO, "%.300s: its scenes are of another build; start over with --force", path);
    for (size_t i = 0; i < head.scenes; i++) {
        scene_record one;
        memcpy(&one, (const char *)s->resumed.study + sizeof head + i * sizeof one, sizeof one);
        TRY(add_record(s, &one));
    }
    s->wall_before = s->resumed.wall_seconds;
    return status_ok();
}

static double resumed_scene_wall(const session *s)
{
    store_head head;
    memcpy(&head, s->resumed.study, sizeof head);
    return head.scene_wall;
}

/* ---- opening and closing ---- */

/* used.yaml into the directory, its hash into the key. */
static status write_used(const case_inputs *in, session *s)
{
    char *text = NULL, path[OUTDIR_PATH_SIZE];
    size_t bytes = 0;
    FILE *f = open_memstream(&text, &bytes);
    CHECK(f, STATUS_MEMORY, "no memory for used.yaml");
    status done = case_inputs_write(in, f);
    if (fclose(f) != 0 && done.code == STATUS_OK) done = base_status_error(STATUS_MEMORY, "no memory for used.yaml");
    s->key = run_checkpoint_key_of(mpm_instruction_set(), host_hash_bytes(0, text, bytes));
    if (done.code == STATUS_OK) done = host_outdir_file(&s->dir, OUTDIR_USED, path, sizeof path);
    if (done.code == STATUS_OK && s->dir.state == OUTDIR_NEW) done = host_file_write(path, text, bytes);
    free(text);
    return done;
}

static status find_store(session *s, const char *wanted)
{
    if (!wanted)
        TRY(host_outdir_file(&s->dir, OUTDIR_STORE, s->store, sizeof s->store));
    else
        CHECK(snprintf(s->store, sizeof s->store, "%s", wanted) < (int)sizeof s->store, STATUS_BAD_INPUT,
              "--store: the path is too long");
    return status_ok();
}

status run_session_open(const case_inputs *in, const session_options *o, session *s)
{
    char dir[OUTDIR_PATH_SIZE];
    memset(s, 0, sizeof *s);
    s->dir.lock = -1;
    s->threads = o->threads;
    s->lending = o->lending;
    s->stop = o->stop;
    s->run_scene = o->run_scene;
    s->started = host_wall_clock();
    s->warnings = strdup(in->warnings);
    CHECK(s->warnings, STATUS_MEMORY, "no memory for the warnings");
    host_progress_open(&s->progress, o->progress_to, o->quiet);
    host_timing_open(&s->timing);
    if (o->dir)
        CHECK(snprintf(dir, sizeof dir, "%s", o->dir) < (int)sizeof dir, STATUS_BAD_INPUT, "-o: the path is too long");
    else
        TRY(host_outdir_default(in->name, dir, sizeof dir));
    TRY(host_outdir_open(dir, o->how, &s->dir));
    if (s->dir.state == OUTDIR_FINISHED) return status_ok();
    TRY(find_store(s, o->store));
    TRY(write_used(in, s));
    if (s->dir.state == OUTDIR_RESUMED) TRY(take_up(s));
    TRY(host_outdir_file(&s->dir, OUTDIR_HISTORY, dir, sizeof dir));
    TRY(output_history_open(dir, s->dir.state == OUTDIR_RESUMED, &s->history));
    return run_ranks_count() > 1 ? run_crew_create(s, &s->crew) : status_ok();
}

status run_session_close(session *s, bool finished)
{
    char path[OUTDIR_PATH_SIZE];
    host_progress_close(&s->progress);
    run_crew_free(s->crew);
    s->crew = NULL;
    const status done = output_history_close(s->history);
    if (finished && s->dir.lock >= 0 && checkpoint_path(s, path).code == STATUS_OK) unlink(path);
    host_outdir_close(&s->dir);
    run_checkpoint_free(&s->resumed);
    scene_shelf_clear(&s->shelf);
    for (int i = 0; i < s->n_records; i++) free(s->record[i]);
    free(s->record);
    free(s->warnings);
    s->history = NULL;
    s->record = NULL;
    s->n_records = 0;
    s->warnings = NULL;
    return done;
}

/* ---- scenes ---- */

status run_session_save_inside(void *user, const char *scene, const scene_now *now)
{
    const session *s = user;
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
    TRY(output_history_flush(s->history));
    return write_checkpoint(s, &between, 0.0);
}
