#include "coupling/run/session.h"

#include "coupling/run/crew.h"
#include "coupling/run/ranks.h"

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
    host_progress_say(&s->progress, "warning: %s", line);
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
    if (s->dir.state == OUTDIR_RESUMED) TRY(run_session_take_up(s));
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
    if (finished && s->dir.lock >= 0 && run_session_checkpoint_path(s, path).code == STATUS_OK) unlink(path);
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
