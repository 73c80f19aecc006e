/* SPDX-License-Identifier: BSD-3-Clause */
/* breech sweep: another study for every combination of values of some keys of the case (section `sweep`).
 *
 * A combination is the case file read again with its values set, as --set does it: units, ranges and what follows from
 * other keys are those of a case file, and every error is told before anything is written.  Scenes of all combinations
 * are asked for at once, so that they come from the store or run side by side.  Where a varied key is a resolution, the
 * error of every output against the finest run is listed over the time that the run took. */
#include "coupling/host/table.h"
#include "coupling/host/words.h"
#include "coupling/output/expect.h"
#include "coupling/report/report_page.h"
#include "coupling/study/reread.h"
#include "coupling/study/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_RUNS = 2000, MOST_OUTPUTS = 24, USUAL_OUTPUTS = 6 };

/* ---- keys ---- */

static const summary_key run_keys[] = {
    SUMMARY_PAIRS(sweep_run, "inputs", inputs, n_inputs, "varied key: its value, in SI where it is a quantity"),
    SUMMARY_PAIRS(sweep_run, "outputs", outputs, n_outputs, "key of the run's summary: its value"),
    SUMMARY_PAIRS(sweep_run, "errors", errors, n_errors,
                  "of the outputs over those of the finest run; empty: no resolution is varied"),
    SUMMARY_NUMBER(sweep_run, "wall_seconds", wall_seconds, "s",
                   "time the run took, in the store's run if it is from there"),
    SUMMARY_END,
};

static const summary_key result_keys[] = {
    SUMMARY_TEXT(sweep_result, "of", of, "the study that was run for every combination"),
    SUMMARY_TEXT(sweep_result, "resolution", resolution, "the varied key that is a resolution; empty: none is"),
    SUMMARY_PAIRS(sweep_result, "units", units, n_units, "of inputs and outputs"),
    SUMMARY_LIST(sweep_result, "sweep", run, n_runs, run_keys, sizeof(sweep_run), "a combination each, keys below"),
    SUMMARY_NUMBER(sweep_result, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END,
};

/* ---- the combinations ---- */

static int runs_of(const case_sweep *w)
{
    double n = 1.0;
    if (w->together) return w->vary.item[0].values.n;
    for (int k = 0; k < w->vary.n; k++) n *= w->vary.item[k].values.n;
    return n > MOST_RUNS ? MOST_RUNS + 1 : (int)n;
}

/* Which value the key has in a run; of all combinations the last key changes fastest. */
static int value_index(const case_sweep *w, int run, int key)
{
    if (w->together) return run;
    for (int k = w->vary.n - 1; k > key; k--) run /= w->vary.item[k].values.n;
    return run % w->vary.item[key].values.n;
}

static const char *value_text(const case_sweep *w, int run, int key)
{
    return w->vary.item[key].values.item[value_index(w, run, key)].value;
}

enum { SHOWN = 40 }; /* of a value, in an error */

/* "particle.radius = 0.5 mm, scene.friction = 0.1" */
static void describe(const case_sweep *w, int run, char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    for (int k = 0; k < w->vary.n && used < size; k++) {
        const char *value = value_text(w, run, k);
        used += (size_t)snprintf(out + used, size - used, "%s%s = %.*s%s", k ? ", " : "", w->vary.item[k].key, SHOWN,
                                 value, strlen(value) > SHOWN ? "..." : "");
    }
}

/* Has the probe the column that `last.<column>` or `mean.<column>` names? */
static status check_column(const char *path, const char *key, const mpm_probe *probe)
{
    if (strncmp(key, "last.", 5) != 0 && strncmp(key, "mean.", 5) != 0) return status_ok();
    for (int c = 0; c < mpm_probe_columns(probe); c++)
        if (strcmp(key + 5, probe->kind->columns[c].name) == 0) return status_ok();
    return base_status_error(STATUS_BAD_INPUT, "%.200s: a probe of kind %s has no such column (breech --keys)", path,
                             probe->kind->name);
}

/* Does a path of a scene's probe or body, `probes.<name>.peak`, name one that the scene has? */
static status check_names(const char *path, const mpm_scene *scene)
{
    const bool probe = strncmp(path, "probes.", 7) == 0;
    const int n = probe ? scene->probes : scene->bodies;
    char known[300] = "";
    if (!probe && strncmp(path, "bodies.", 7) != 0) return status_ok();
    for (int i = 0; i < n; i++) {
        const char *name = probe ? scene->probe[i].name : scene->body[i].name;
        const size_t length = strlen(name), used = strlen(known);
        if (strncmp(path + 7, name, length) == 0 && path[7 + length] == '.')
            return probe ? check_column(path, path + 8 + length, &scene->probe[i]) : status_ok();
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", name);
    }
    return base_status_error(STATUS_BAD_INPUT, "%.200s: the scene has no such %s; it has %s", path,
                             probe ? "probe" : "body", n > 0 ? known : "none");
}

/* What is wrong with a run, by the path of the value that is to blame: the place of an error is that in the sweep's own
 * file, not that of the key in the case that the sweep is of.  key -1: no single value is. */
static status wrong_run(const case_sweep *w, int run, int key, const status *s)
{
    char which[300], at[60] = "sweep.vary";
    describe(w, run, which, sizeof which);
    if (key >= 0 && study_reread_key(s))
        snprintf(at, sizeof at, "sweep.vary[%d].key", key);
    else if (key >= 0)
        snprintf(at, sizeof at, "sweep.vary[%d].values[%d]", key, value_index(w, run, key));
    return base_status_error(s->code, "%s: run %d (%s): %.400s", at, run + 1, which, s->text);
}

/* Has the scene of this run what `read` names? */
static status check_read(const case_sweep *w, int run, const case_inputs *in)
{
    char which[300];
    describe(w, run, which, sizeof which);
    for (int k = 0; in->given.bodies && k < w->read.n; k++) {
        const status s = check_names(w->read.item[k].value, &in->bodies.scene);
        CHECK(s.code == STATUS_OK, s.code, "sweep.read[%d]: run %d (%s): %.400s", k, run + 1, which, s.text);
    }
    return status_ok();
}

/* The case with the values of one run. */
static status read_run(const study_case *of, const study *y, int run, case_inputs **out)
{
    const case_sweep *w = &of->in->sweep;
    case_change change[CASE_SWEEP_KEYS];
    int about;
    for (int k = 0; k < w->vary.n; k++) {
        snprintf(change[k].key, sizeof change[k].key, "%s", w->vary.item[k].key);
        snprintf(change[k].value, sizeof change[k].value, "%s", value_text(w, run, k));
    }
    const status s = study_reread(of, y, w->vary.n, change, out, &about);
    return s.code == STATUS_OK ? check_read(w, run, *out) : wrong_run(w, run, about, &s);
}

/* ---- before anything is written ---- */

static const char *output_name(const void *keys, int i)
{
    for (const summary_key *k = keys; k->name; k++)
        if (output_number_exists(keys, k->name) && i-- == 0) return k->name;
    return NULL;
}

static status check_outputs(const case_sweep *w, const study *y)
{
    CHECK(w->read.n <= MOST_OUTPUTS, STATUS_BAD_INPUT, "sweep.read: more than %d keys", MOST_OUTPUTS);
    for (int k = 0; k < w->read.n; k++) {
        const char *name = w->read.item[k].value, *near = host_nearest_name(name, output_name, y->keys);
        CHECK(output_number_exists(y->keys, name), STATUS_BAD_INPUT,
              "sweep.read[%d] = %s: no number of the summary of `breech %s`%s%s%s", k, name, study_command(y),
              near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "");
    }
    return status_ok();
}

/* Does a key set what an earlier one has set, itself or a section around it?  A list without a number is all of its
 * entries. */
static bool sets_again(const char *a, const char *earlier)
{
    const char *b = earlier;
    for (;; a++, b++) {
        const size_t n = strcspn(a, ".["), m = strcspn(b, ".[");
        if (n != m || strncmp(a, b, n) != 0) return false;
        a += n, b += n;
        if (*a == '[' && *b == '[' && atoi(a + 1) != atoi(b + 1)) return false;
        a += strcspn(a, "."), b += strcspn(b, ".");
        if (!*a || !*b) return !*a;
    }
}

static status check_values(const case_sweep *w)
{
    CHECK(w->vary.n > 0, STATUS_BAD_INPUT, "sweep.vary is empty: a list of {key: path.to.key, values: [..]}");
    CHECK(w->vary.n <= CASE_SWEEP_KEYS, STATUS_BAD_INPUT, "sweep.vary: more than %d keys", CASE_SWEEP_KEYS);
    for (int k = 0; k < w->vary.n; k++) {
        const case_varied *v = &w->vary.item[k];
        CHECK(v->values.n > 0, STATUS_BAD_INPUT, "sweep.vary[%d].values is empty: what the key is to be set to",
              k); /* the key would be taken for the place */
        CHECK(strncmp(v->key, "sweep.", 6) != 0, STATUS_BAD_INPUT,
              "sweep.vary[%d].key = %s: a sweep cannot vary itself", k, v->key);
        for (int i = 0; i < k; i++)
            CHECK(!sets_again(v->key, w->vary.item[i].key), STATUS_BAD_INPUT,
                  "sweep.vary[%d].key = %s: sets what vary[%d] sets, %s", k, v->key, i, w->vary.item[i].key);
        CHECK(!w->together || v->values.n == w->vary.item[0].values.n, STATUS_BAD_INPUT,
              "sweep.vary[%d].values: %d values, vary[0] has %d; with `together: yes` all have as many", k, v->values.n,
              w->vary.item[0].values.n);
    }
    CHECK(runs_of(w) <= MOST_RUNS, STATUS_BAD_INPUT, "sweep.vary: more than %d combinations", MOST_RUNS);
    return status_ok();
}

static status find_study(const case_inputs *in, const study **out)
{
    const case_sweep *w = &in->sweep;
    char known[200] = "";
    CHECK(in->onset.study.ensemble == 0, STATUS_BAD_INPUT,
          "study.ensemble = %d: a sweep runs single scenes; 0, or vary scene.grid_shift", in->onset.study.ensemble);
    *out = study_find(w->of);
    if (*out) *out = study_for(*out, in);
    for (int k = 0; k < STUDIES; k++)
        if (study_list[k]->can_vary)
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", known[0] ? ", " : "",
                     study_list[k]->name);
    CHECK(*out && (*out)->can_vary, STATUS_BAD_INPUT, "sweep.of = %s: must be one of %s", w->of, known);
    return status_ok();
}

/* Each, for what is wrong with it. */
static status read_runs(const study_case *of, const study *y)
{
    units *u;
    status s = host_units_open(&u);
    for (int i = 0; s.code == STATUS_OK && i < runs_of(&of->in->sweep); i++) {
        case_inputs *in;
        s = read_run(of, y, i, &in);
        case_inputs_free(in);
    }
    host_units_close(u);
    return s;
}

static status possible(const study_case *of)
{
    const case_sweep *w = &of->in->sweep;
    const study *y;
    TRY(find_study(of->in, &y));
    TRY(check_values(w));
    TRY(check_outputs(w, y));
    return read_runs(of, y);
}

/* ---- the runs ---- */

typedef char run_prefix[16]; /* of its scenes' and notes' names */

typedef struct {
    sweep_result result; /* borrows the rest */
    const study *of;
    int runs, keys, outputs;
    const char *output[MOST_OUTPUTS];                  /* paths of numbers, borrowed */
    char output_unit[MOST_OUTPUTS][SUMMARY_NAME_SIZE]; /* of the first run */
    case_inputs **in;     /* [runs], NULL: noted before; owned one by one, as all that follows */
    study_answer *answer; /* [runs] */
    run_prefix *prefix;   /* [runs] */
    sweep_run *run;       /* [runs] */
    summary_pair *input, *value, *error, *unit;
} sweep_answer;

static void answer_free(void *owned)
{
    sweep_answer *a = owned;
    if (!a) return;
    for (int i = 0; a->answer && i < a->runs; i++)
        if (a->of->free) a->of->free(a->answer[i].owned);
    for (int i = 0; a->in && i < a->runs; i++) case_inputs_free(a->in[i]);
    void *const all[] = { a->in, a->answer, a->prefix, a->run, a->input, a->value, a->error, a->unit, a };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) free(all[k]);
}

/* What `read` names; else what is usual for the study, its first numbers where it names none. */
static void choose_outputs(const case_sweep *w, sweep_answer *a)
{
    for (int k = 0; k < w->read.n; k++) a->output[a->outputs++] = w->read.item[k].value;
    if (w->read.n > 0) return;
    for (int k = 0; a->of->usual && a->of->usual[k]; k++) a->output[a->outputs++] = a->of->usual[k];
    for (int k = 0; !a->of->usual && k < USUAL_OUTPUTS && output_name(a->of->keys, k); k++)
        a->output[a->outputs++] = output_name(a->of->keys, k);
}

static status make_room(const case_sweep *w, sweep_answer *a)
{
    const size_t runs = (size_t)runs_of(w), keys = (size_t)w->vary.n, outputs = (size_t)a->outputs;
    a->in = calloc(runs, sizeof *a->in);
    a->answer = calloc(runs, sizeof *a->answer);
    a->prefix = calloc(runs, sizeof *a->prefix);
    a->run = calloc(runs, sizeof *a->run);
    a->input = calloc(runs * keys, sizeof *a->input);
    a->value = calloc(runs * outputs + 1, sizeof *a->value);
    a->error = calloc(runs * outputs + 1, sizeof *a->error);
    a->unit = calloc(keys + outputs, sizeof *a->unit);
    CHECK(a->in && a->answer && a->prefix && a->run && a->input && a->value && a->error && a->unit, STATUS_MEMORY,
          "no memory for %zu runs", runs);
    a->runs = (int)runs;
    a->keys = (int)keys;
    return status_ok();
}

static study_case case_of_run(const sweep_answer *a, int i)
{
    return (study_case){ .in = a->in[i], .one_of_several = true, .prefix = a->prefix[i] };
}

/* The scenes that are certain, of all runs left at once: any process may take any of them. */
static status run_scenes(session *s, const sweep_answer *a)
{
    scene_query *query = malloc((size_t)a->runs * sizeof *query);
    const scene_record **record = malloc((size_t)a->runs * sizeof *record);
    status done = query && record ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for %d runs", a->runs);
    int n = 0;
    for (int i = a->result.n_runs; done.code == STATUS_OK && a->of->scenes && i < a->runs; i++) {
        const study_case of = case_of_run(a, i);
        n += a->of->scenes(&of, &query[n]);
    }
    if (done.code == STATUS_OK) done = run_scenes_all(s, query, n, record);
    free(query);
    free(record);
    return done;
}

/* ---- what came out ---- */

static void fill_inputs(const units *u, const case_sweep *w, sweep_answer *a)
{
    for (int k = 0; k < a->keys; k++) {
        const char *unit = NULL;
        for (int i = 0; i < a->runs; i++) {
            summary_pair *p = &a->input[i * a->keys + k];
            *p = (summary_pair){ .name = w->vary.item[k].key, .text = value_text(w, i, k) };
            if (output_number_in_si(u, p->text, &p->value, &unit)) p->text = NULL;
        }
        a->unit[k] = (summary_pair){ .name = w->vary.item[k].key, .text = unit ? unit : "" };
    }
    for (int k = 0; k < a->outputs; k++)
        a->unit[a->keys + k] = (summary_pair){ .name = a->output[k], .text = a->output_unit[k] };
}

static void fill_output(sweep_answer *a, int i, int k, double value)
{
    a->value[i * a->outputs + k] = (summary_pair){ .name = a->output[k], .value = value };
}

static void fill_run(sweep_answer *a, int i, double wall_seconds)
{
    a->run[i] = (sweep_run){ .n_inputs = a->keys,
                             .inputs = a->input + i * a->keys,
                             .n_outputs = a->outputs,
                             .outputs = a->value + i * a->outputs,
                             .errors = a->error + i * a->outputs,
                             .wall_seconds = wall_seconds };
    a->result.n_runs = i + 1;
}

/* ---- what came out is noted, so that a resumed sweep does not run it again: the time, each output with its unit, the
 * warnings, a line each, numbers with all their bits ---- */

static void note_name(const sweep_answer *a, int i, char name[SUMMARY_NAME_SIZE])
{
    snprintf(name, SUMMARY_NAME_SIZE, "%srun", a->prefix[i]);
}

/* warnings: those of the run alone. */
static status note_run(session *s, const sweep_answer *a, int i, const char *warnings)
{
    char name[SUMMARY_NAME_SIZE], *text = NULL;
    size_t bytes = 0;
    FILE *f = open_memstream(&text, &bytes);
    CHECK(f, STATUS_MEMORY, "no memory to note run %d", i + 1);
    fprintf(f, "%a\n", a->run[i].wall_seconds);
    for (int k = 0; k < a->outputs; k++) fprintf(f, "%a %s\n", a->run[i].outputs[k].value, a->output_unit[k]);
    fputs(warnings, f);
    const bool closed = fclose(f) == 0;
    note_name(a, i, name);
    run_session_note_drop(s, a->prefix[i]); /* of what led there */
    const status done = closed ? run_session_note_add(s, name, text, bytes)
                               : base_status_error(STATUS_MEMORY, "no memory to note run %d", i + 1);
    free(text);
    return done;
}

/* What the note of the next run says, once more; false: there is none. */
static bool take_note(session *s, sweep_answer *a, int i)
{
    char name[SUMMARY_NAME_SIZE];
    note_name(a, i, name);
    const session_note *note = run_session_note(s, name);
    if (!note) return false;
    const char *at = note->data;
    char *end;
    const double wall_seconds = strtod(at, &end);
    at = end + (*end == '\n');
    for (int k = 0; k < a->outputs; k++) {
        fill_output(a, i, k, strtod(at, &end));
        const char *unit = end + (*end == ' ');
        const int length = (int)strcspn(unit, "\n");
        if (length > 0) snprintf(a->output_unit[k], SUMMARY_NAME_SIZE, "%.*s", length, unit);
        at = unit + length + (unit[length] == '\n');
    }
    for (int length; *at; at += length + (at[length] == '\n')) {
        length = (int)strcspn(at, "\n");
        run_session_warn(s, "%.*s", length, at);
    }
    fill_run(a, i, wall_seconds);
    return true;
}

static status run_one(session *s, sweep_answer *a, int i)
{
    const size_t warned = strlen(s->warnings);
    const study_case one = case_of_run(a, i);
    TRY(a->of->run(s, &one, &a->answer[i]));
    const summary_object result = { a->of->keys, a->answer[i].result };
    for (int k = 0; k < a->outputs; k++)
        fill_output(a, i, k, output_number_of(&result, a->output[k], a->output_unit[k]));
    fill_run(a, i, output_number_of(&result, "wall_seconds", NULL));
    return note_run(s, a, i, s->warnings + warned);
}

/* 1: a larger value is finer, -1: a smaller one, 0: not a resolution. */
static int finer_by(const char *key)
{
    static const struct {
        const char *end;
        int by;
    } ends[] = { { "cells_per_radius", 1 }, { "fineness", 1 }, { "cell", -1 } };
    for (size_t k = 0; k < sizeof ends / sizeof ends[0]; k++) {
        const size_t n = strlen(key), m = strlen(ends[k].end);
        if (n >= m && strcmp(key + n - m, ends[k].end) == 0) return ends[k].by;
    }
    return 0;
}

/* The finest run with the other inputs of run i. */
static int finest_run(const case_sweep *w, const sweep_answer *a, int key, int i)
{
    const int by = finer_by(w->vary.item[key].key);
    int best = i;
    for (int j = 0; j < a->runs; j++) {
        bool alike = true;
        for (int k = 0; k < a->keys && !w->together; k++)
            alike = alike && (k == key || value_index(w, i, k) == value_index(w, j, k));
        const double now = a->input[j * a->keys + key].value, then = a->input[best * a->keys + key].value;
        if (alike && by * now > by * then) best = j;
    }
    return best;
}

static void fill_errors(const case_sweep *w, sweep_answer *a)
{
    int key = 0;
    while (key < a->keys && !finer_by(w->vary.item[key].key)) key++;
    if (key == a->keys) return;
    snprintf(a->result.resolution, sizeof a->result.resolution, "%s", w->vary.item[key].key);
    for (int i = 0; i < a->runs; i++) {
        const int finest = finest_run(w, a, key, i);
        for (int k = 0; k < a->outputs; k++) {
            const double exact = a->value[finest * a->outputs + k].value;
            a->error[i * a->outputs + k] =
                (summary_pair){ .name = a->output[k],
                                .value = fabs(a->value[i * a->outputs + k].value - exact) / fabs(exact) };
        }
        a->run[i].n_errors = a->outputs;
    }
}

/* ---- sweep.csv ---- */

static void csv_title(FILE *out, const summary_pair *unit, bool first)
{
    const bool bare = !unit->text[0] || strcmp(unit->text, "1") == 0;
    fprintf(out, "%s%s%s%s%s", first ? "" : ",", unit->name, bare ? "" : " [", bare ? "" : unit->text, bare ? "" : "]");
}

/* In quotes; those inside it are doubled (RFC 4180). */
static void csv_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) fputs(*text == '"' ? "\"\"" : (char[2]){ *text }, out);
    fputc('"', out);
}

static void csv_value(FILE *out, const summary_pair *p, bool first)
{
    if (!first) fputc(',', out);
    if (p->text)
        csv_text(out, p->text);
    else if (isfinite(p->value))
        fprintf(out, "%.15g", p->value);
}

static status write_csv(const session *s, const sweep_answer *a)
{
    char path[OUTDIR_PATH_SIZE];
    file_writer w;
    TRY(host_outdir_file(&s->dir, OUTDIR_SWEEP, path, sizeof path));
    TRY(host_file_begin(&w, path));
    for (int k = 0; k < a->result.n_units; k++) csv_title(w.stream, &a->result.units[k], k == 0);
    fputs(",wall_seconds [s]\n", w.stream);
    for (int i = 0; i < a->result.n_runs; i++) {
        for (int k = 0; k < a->keys; k++) csv_value(w.stream, &a->run[i].inputs[k], k == 0);
        for (int k = 0; k < a->outputs; k++) csv_value(w.stream, &a->run[i].outputs[k], false);
        csv_value(w.stream, &(summary_pair){ .value = a->run[i].wall_seconds }, false);
        fputc('\n', w.stream);
    }
    return host_file_end(&w, true);
}

/* ---- the whole ---- */

/* What is known before the first run; the units are open all the while, as each case that is read needs them. */
static status fill(session *s, const study_case *of, const units *u, sweep_answer *a)
{
    fill_inputs(u, &of->in->sweep, a);
    a->result.n_units = a->keys + a->outputs;
    a->result.units = a->unit;
    a->result.run = a->run;
    snprintf(a->result.of, sizeof a->result.of, "%s", a->of->name);
    for (int i = 0; i < a->runs; i++) snprintf(a->prefix[i], sizeof a->prefix[i], "s%d-", i + 1);
    while (a->result.n_runs < a->runs && take_note(s, a, a->result.n_runs)) continue;
    for (int i = a->result.n_runs; i < a->runs; i++) {
        CHECK(!s->stop || !s->stop(), STATUS_STOPPED, "before run %d was read", i + 1);
        TRY(read_run(of, a->of, i, &a->in[i]));
    }
    return status_ok();
}

static status sweep(session *s, const study_case *of, sweep_answer *a)
{
    units *u;
    TRY(find_study(of->in, &a->of));
    choose_outputs(&of->in->sweep, a);
    TRY(make_room(&of->in->sweep, a));
    TRY(host_units_open(&u));
    const status read = fill(s, of, u, a);
    host_units_close(u);
    TRY(read);
    TRY(run_scenes(s, a));
    for (int i = a->result.n_runs; i < a->runs; i++) TRY(run_one(s, a, i));
    fill_errors(&of->in->sweep, a);
    return status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    sweep_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for a sweep");
    const status done = sweep(s, of, a);
    a->result.wall_seconds = run_session_wall(s);
    out->result = &a->result;
    const status written = write_csv(s, a);
    return done.code == STATUS_OK ? written : done;
}

/* ---- for people ---- */

enum { COLUMNS = CASE_SWEEP_KEYS + MOST_OUTPUTS + 1 /* time */, CELL_ROOM = 320, ROW_ROOM = COLUMNS * CELL_ROOM };
_Static_assert((int)COLUMNS <= (int)TABLE_MAX_COLUMNS, "a table has all columns of a sweep");

/* The table cuts what is too wide; what is far too long is cut here, so that a row has room for every cell. */
static char *add_cell(char *row, const summary_pair *p)
{
    char number[24];
    return row + snprintf(row, CELL_ROOM, "%.300s" TABLE_NEXT,
                          p->text ? p->text : output_cell(p->value, 1.0, "%.5g", number));
}

static char *add_title(char *row, const summary_pair *unit)
{
    const bool bare = !unit->text[0] || strcmp(unit->text, "1") == 0;
    return row + snprintf(row, CELL_ROOM, "%.200s%s%.90s%s" TABLE_NEXT, unit->name, bare ? "" : " [",
                          bare ? "" : unit->text, bare ? "" : "]");
}

/* A run a line: its inputs, its outputs or their errors, its time. */
static status fill_table(const sweep_result *r, bool errors, table **t)
{
    char row[ROW_ROOM], *end = row;
    for (int k = 0; k < r->n_units; k++)
        end = add_title(end, errors && k >= r->run[0].n_inputs ? &(summary_pair){ r->units[k].name, "", NAN }
                                                               : &r->units[k]);
    strcpy(end, "time [s]");
    TRY(host_table_create(row, t));
    if (r->n_runs > 0) host_table_keep(*t, r->run[0].n_inputs);
    for (int i = 0; i < r->n_runs; i++) {
        const sweep_run *run = &r->run[i];
        char time[24];
        end = row;
        for (int k = 0; k < run->n_inputs; k++) end = add_cell(end, &run->inputs[k]);
        for (int k = 0; k < run->n_outputs; k++) end = add_cell(end, errors ? &run->errors[k] : &run->outputs[k]);
        TRY(host_table_row(*t, "%.*s%s", (int)(end - row), row, output_cell(run->wall_seconds, 1.0, "%.5g", time)));
    }
    return status_ok();
}

static void print_runs(const sweep_result *r, bool errors, FILE *out)
{
    table *t = NULL;
    if (r->n_runs == 0) return;
    const status s = fill_table(r, errors, &t);
    if (s.code == STATUS_OK)
        host_table_print(t, out);
    else
        fprintf(out, "no table here (%s); all runs are in sweep.csv\n", s.text);
    host_table_free(t);
}

static void print(const void *result, FILE *out)
{
    const sweep_result *r = result;
    print_runs(r, false, out);
    if (!r->resolution[0]) return;
    fprintf(out, "\nerror against the finest %s:\n", r->resolution);
    print_runs(r, true, out);
}

const study study_sweep = {
    .name = "sweep",
    .doc = "a scene or a shot for many values of some keys",
    .more =
        "Needs the section sweep, and what the study that it runs needs.  All errors are told before anything runs.",
    .example = "breech sweep cases/sweep",
    .needs = CASE_FOR_SWEEP,
    .many_scenes = true,
    .keys = result_keys,
    .report = { report_sweep_head, report_sweep_section },
    .print = print,
    .possible = possible,
    .run = run,
    .free = answer_free,
};
