/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/session.h"

#include "coupling/run/crew.h"
#include "coupling/run/ranks.h"
#include "coupling/run/store.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    host_progress_warn(&s->progress, "%s", line);
}

/* ---- opening and closing ---- */

/* The text of used.yaml: the command, then the case with its values. */
static status used_text(const case_inputs *in, const char *command, char **text, size_t *bytes)
{
    FILE *f = open_memstream(text, bytes);
    CHECK(f, STATUS_MEMORY, "no memory for used.yaml");
    fprintf(f, OUTDIR_RUN_BY "%s\n", command);
    const status done = case_inputs_write(in, f);
    const bool closed = fclose(f) == 0;
    TRY(done);
    CHECK(closed, STATUS_MEMORY, "no memory for used.yaml");
    return status_ok();
}

static const char *line_of(const char *text, size_t at, int *length)
{
    const char *from = text + at;
    while (from > text && from[-1] != '\n') from--;
    *length = (int)strcspn(from, "\n");
    return from;
}

/* A run goes on with, or takes for done, only what the same command left of the same case. */
static status check_same(const session *s, const char *path, const char *text)
{
    char *had;
    TRY(host_file_read(path, &had, NULL));
    size_t at = 0;
    int old_length, new_length, line = 1;
    while (had[at] && had[at] == text[at]) line += had[at++] == '\n';
    const char *old = line_of(had, at, &old_length), *new = line_of(text, at, &new_length);
    const status same = had[at] == text[at]
                            ? status_ok()
                            : base_status_error(STATUS_BAD_INPUT,
                                                "%.150s: holds a run of another command, case or values: line %d of "
                                                "its used.yaml is `%.*s`, now it would be `%.*s`; -o names another "
                                                "directory, --force starts over",
                                                s->dir.path, line, old_length < 80 ? old_length : 80, old,
                                                new_length < 80 ? new_length : 80, new);
    free(had);
    return same;
}

/* used.yaml into the directory, or compared with what is there; its hash into the key. */
static status put_used(const case_inputs *in, const char *command, session *s)
{
    char *text = NULL, path[OUTDIR_PATH_SIZE];
    size_t bytes = 0;
    status done = used_text(in, command, &text, &bytes);
    if (done.code == STATUS_OK) {
        s->key = run_checkpoint_key_of(mpm_instruction_set(), host_hash_bytes(0, text, bytes));
        done = host_outdir_file(&s->dir, OUTDIR_USED, path, sizeof path);
    }
    if (done.code == STATUS_OK)
        done = s->dir.state == OUTDIR_NEW ? host_file_write(path, text, bytes) : check_same(s, path, text);
    free(text);
    return done;
}

/* One that is named is tried before anything is written; that of the output directory is made with its first scene. */
static status find_store(session *s, const char *wanted)
{
    if (wanted) {
        CHECK(snprintf(s->store, sizeof s->store, "%s", wanted) < (int)sizeof s->store, STATUS_BAD_INPUT,
              "--store %.60s...: a path has at most %zu bytes", wanted, sizeof s->store - 1);
        return wanted[0] ? run_store_open(wanted) : status_ok();
    }
    TRY(host_outdir_file(&s->dir, OUTDIR_STORE, s->store, sizeof s->store));
    return host_folder_exists(s->store) ? run_store_open(s->store) : status_ok();
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
    s->started_over = o->how.force;
    s->started = host_wall_clock();
    s->warnings = strdup(in->warnings);
    CHECK(s->warnings, STATUS_MEMORY, "no memory for the warnings");
    host_progress_open(&s->progress, o->progress_to, o->quiet);
    host_timing_open(&s->timing);
    if (o->dir)
        CHECK(snprintf(dir, sizeof dir, "%s", o->dir) < (int)sizeof dir, STATUS_BAD_INPUT,
              "-o %.60s...: a path has at most %zu bytes", o->dir, sizeof dir - 1);
    else
        TRY(host_outdir_default(in->name, dir, sizeof dir));
    if (o->store) TRY(find_store(s, o->store));
    TRY(host_outdir_open(dir, o->how, &s->dir));
    TRY(put_used(in, o->command, s));
    if (s->dir.state == OUTDIR_FINISHED) return status_ok();
    if (!o->store) TRY(find_store(s, NULL));
    if (s->dir.state == OUTDIR_RESUMED) TRY(run_session_take_up(s));
    TRY(host_outdir_file(&s->dir, OUTDIR_HISTORY, dir, sizeof dir));
    CHECK(s->dir.state != OUTDIR_RESUMED || host_file_exists(dir), STATUS_BAD_INPUT,
          "%.300s: is missing, and the checkpoint beside it goes on from it; put it back or start over with --force",
          dir);
    TRY(output_history_open(dir, s->dir.state == OUTDIR_RESUMED, &s->history));
    return run_ranks_count() > 1 ? run_crew_create(s, o->side_by_side, &s->crew) : status_ok();
}

status run_session_close(session *s, bool finished)
{
    char path[OUTDIR_PATH_SIZE];
    host_progress_close(&s->progress);
    run_crew_free(s->crew, finished);
    s->crew = NULL;
    const status noted = finished ? status_ok() : run_session_note_save(s);
    const status done = output_history_close(s->history);
    if (finished && s->dir.lock >= 0 && run_session_checkpoint_path(s, path).code == STATUS_OK) unlink(path);
    host_outdir_close(&s->dir);
    run_checkpoint_free(&s->resumed);
    scene_shelf_clear(&s->shelf);
    for (int i = 0; i < s->n_records; i++) free(s->record[i]);
    free(s->record);
    run_session_note_drop(s, "");
    free(s->note);
    free(s->warnings);
    s->history = NULL;
    s->record = NULL;
    s->n_records = 0;
    s->note = NULL;
    s->warnings = NULL;
    return noted.code == STATUS_OK ? done : noted;
}
