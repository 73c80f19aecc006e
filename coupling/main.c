/* breech: the program.  Options in, exit code out; the only place that prints and exits.
 *
 * To add a command that runs a case: a study (study/study.h); any other: a line in `others`, its function here. */
#include "coupling/case/case_new.h"
#include "coupling/case/material_file.h"
#include "coupling/gouge/impact.h"
#include "coupling/host/stop.h"
#include "coupling/host/table.h"
#include "coupling/host/version.h"
#include "coupling/output/expect.h"
#include "coupling/report/report.h"
#include "coupling/run/crew.h"
#include "coupling/run/ranks.h"
#include "coupling/study/check.h"
#include "coupling/study/flow.h"
#include "coupling/study/study.h"

#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_STOPPED = 75, MAX_SETS = 200 };

typedef struct options options;

/* What the program does: its studies (study/study.def), then what is no run. */
typedef struct {
    const char *name, *subject, *doc, *more;
    int (*run)(const options *o);
    bool subject_required;
    const study *study; /* NULL: not a run */
} command;

struct options {
    command command;
    const char *subject; /* CASE, NAME or DIR; NULL */
    const char *dir;     /* -o */
    const char *store;   /* --store; NULL: in the output directory, "": none */
    const char *sets[MAX_SETS];
    int n_sets, threads;
    lending *lending;
    char ensemble[40];  /* --ensemble as one of sets, "" without it */
    const char *expect; /* --expect: a run's output directory; NULL */
    const char *from;   /* --from: what a new case begins from; NULL */
    outdir_options how;
    double max_walltime; /* [s], INFINITY: none */
    bool quiet, no_store;
    bool scene;           /* check: print the scene */
    const char *given[8]; /* options with a value, but --set: as many as there are */
    int n_given;
};

static int run_case(const options *o);
static int run_check(const options *o);
static int run_materials(const options *o);
static int run_flow(const options *o);
static int run_report(const options *o);
static int run_new(const options *o);

static const command others[] = {
    { "check", "CASE", "read and validate only; memory and time estimate",
      "Writes nothing.  Checks the case for every command whose sections it has.", run_check, true, NULL },
    { "materials", "[NAME]", "materials at hand; the constants of one, with their sources", "", run_materials, false,
      NULL },
    { "flow", "NAME", "flow stress of a material over plastic strain, as the solver computes it",
      "Prints columns: strain, flow stress, temperature.  --set strain=, points=, rate=, temperature=, pressure=,\n"
      "cold_work=, yield_scale=, heat= (share of the plastic work that warms it, 0: isothermal); quantities with "
      "units.",
      run_flow, true, NULL },
    { "report", "DIR", "make report.html of an output directory anew", "", run_report, true, NULL },
    { "new", "NAME", "begin a case of your own: the folder NAME with a case.yaml that runs as it is",
      "Begins from a shipped case, every key with a comment; --from chooses it.  What is there already stays.", run_new,
      true, NULL },
};
enum { OTHERS = sizeof others / sizeof others[0], COMMANDS = STUDIES + OTHERS };

static command command_at(int i)
{
    if (i >= STUDIES) return others[i - STUDIES];
    const study *y = study_list[i];
    return (command){ y->name, "CASE", y->doc, y->more, run_case, true, y };
}

/* ---- words ---- */

static void print_help(FILE *out)
{
    fputs("usage: breech COMMAND CASE [options]        CASE: a case.yaml, or a folder that holds one\n\n", out);
    for (int i = 0; i < COMMANDS; i++) {
        const command c = command_at(i);
        fprintf(out, "  breech %-10s %-7s %s\n", c.name, c.subject, c.doc);
    }
    fputs("\n"
          "  -o DIR            output directory, default out/<case>\n"
          "  --set KEY=VALUE   change a value of the case, --set bank.charge=\"9 kV\"; repeatable\n"
          "  --threads N       default: all of the machine\n"
          "  --ensemble N      scene: on N grids, each shifted by another part of a cell; sets study.ensemble\n"
          "  --resume          go on with a stopped run; starts anew where there is none\n"
          "  --force           overwrite what a former run left\n"
          "  --store DIR       scenes computed before are taken from there and left there; default: store/ in the\n"
          "                    output directory; --no-store: none\n"
          "  --max-walltime T  stop with a checkpoint after T (90, 30m, 2h, 1:30:00)\n"
          "  --quiet           no progress, no closing table\n"
          "  --expect DIR      check: does the run in DIR give what the case's expected.yaml says?\n"
          "  --from CASE       new: begin from shot (default), bodies, strike, a shipped case or one of yours\n"
          "  --scene           check: print the case's scene as a case of bodies, every value resolved\n"
          "  --keys            list every key of a case file\n"
          "  --version, --help [COMMAND]\n\n"
          "exit codes: 0 done, 1 failed while running, 2 bad input or usage, 75 stopped early with a checkpoint\n",
          out);
}

/* Its name is NULL where there is none. */
static command command_find(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(command_at(i).name, name) == 0) return command_at(i);
    return (command){ .name = NULL };
}

static int help(const char *name)
{
    const command c = name ? command_find(name) : (command){ .name = NULL };
    if (name && !c.name) {
        fprintf(stderr, "breech: no command `%s`; breech --help lists them\n", name);
        return EXIT_USAGE;
    }
    if (!c.name)
        print_help(stdout);
    else
        printf("breech %s %s: %s\n%s%sOptions: breech --help\n", c.name, c.subject, c.doc, c.more,
               c.more[0] ? "\n" : "");
    return EXIT_DONE;
}

static int exit_code(status s)
{
    switch (s.code) {
    case STATUS_OK: return EXIT_DONE;
    case STATUS_BAD_INPUT: return EXIT_USAGE;
    case STATUS_STOPPED: return EXIT_STOPPED;
    default: return EXIT_FAILED;
    }
}

static int complain(status s)
{
    if (s.code != STATUS_OK) fprintf(stderr, "breech: %s\n", s.text);
    return exit_code(s);
}

/* ---- the case ---- */

static study_case study_case_of(const options *o, const case_inputs *in)
{
    return (study_case){ .in = in, .prefix = "", .sets = o->sets, .n_sets = o->n_sets };
}

/* With the place in the case of what it is about, where that can be told. */
static int complain_of(const case_inputs *in, status s)
{
    char place[400];
    if (s.code == STATUS_OK) return EXIT_DONE;
    case_inputs_place(in, s.text, place, sizeof place);
    if (!place[0]) return complain(s);
    fprintf(stderr, "%s%s\n", place, s.text);
    return exit_code(s);
}

static status read_case(const options *o, unsigned needs, case_inputs **in)
{
    material_places at;
    case_material_places_find(&at);
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n, .needs = needs };
    char *errors = NULL;
    status s = case_inputs_read(o->subject, o->sets, o->n_sets, &how, in, &errors);
    if (s.code == STATUS_OK) {
        s = study_prepare(*in);
        const study_case of = study_case_of(o, *in);
        if (s.code == STATUS_OK) s = study_possible_all(&of, needs);
        complain_of(*in, s);
        if (s.code != STATUS_OK) case_inputs_free(*in);
    } else if (errors) {
        fputs(errors, stderr);
    } else {
        complain(s);
    }
    free(errors);
    return s;
}

/* ---- runs ---- */

static run_status status_of(status s)
{
    return s.code == STATUS_OK ? RUN_DONE : s.code == STATUS_STOPPED ? RUN_STOPPED : RUN_FAILED;
}

static status write_results(const options *o, const case_inputs *in, session *s, const study_answer *a, status work)
{
    char error[600];
    run_summary made = study_summary(study_for(o->command.study, in), a), *summary = &made;
    summary->case_name = in->name;
    summary->instruction_set = mpm_instruction_set();
    summary->status = status_of(work);
    if (work.code == STATUS_STOPPED)
        snprintf(error, sizeof error, "%s: %s", host_stop_reason(), work.text);
    else
        snprintf(error, sizeof error, "%s", work.text);
    summary->error = work.code == STATUS_OK ? NULL : error;
    summary->warnings = s->warnings;
    TRY(output_history_flush(s->history));
    const status written = output_summary_write(s->dir.path, summary);
    host_progress_close(&s->progress);
    if (!o->quiet) {
        fputc('\n', stdout);
        output_summary_print(summary, stdout);
        fputc('\n', stdout);
        host_timing_print(&s->timing, stdout);
    }
    return written;
}

static void say_where(const options *o, const session *s, status work)
{
    if (work.code == STATUS_STOPPED)
        fprintf(stderr, "breech: stopped (%s); --resume goes on: breech %s %s -o %s --resume\n", host_stop_reason(),
                o->command.name, o->subject, s->dir.path);
    else if (!o->quiet)
        printf("\nresults: %s\n", s->dir.path);
}

static void draw_report(const char *dir)
{
    const status drawn = report_write(dir, study_report_part);
    if (drawn.code != STATUS_OK) fprintf(stderr, "breech: no report: %s\n", drawn.text);
}

/* --resume of a finished run; one that was killed while it drew its report gets that. */
static void say_finished(const options *o, const case_inputs *in, const session *s)
{
    char path[OUTDIR_PATH_SIZE];
    if (!o->quiet) printf("%s: finished already\n", s->dir.path);
    if (in->output.report && host_outdir_file(&s->dir, OUTDIR_REPORT, path, sizeof path).code == STATUS_OK &&
        !host_file_exists(path))
        draw_report(s->dir.path);
}

static int carry_out(const options *o, const case_inputs *in, session *s)
{
    const study_case of = study_case_of(o, in);
    study_answer answer = { .result = NULL };
    host_stop_install(o->max_walltime);
    const study *y = study_for(o->command.study, in);
    status work = y->run(s, &of, &answer);
    const status written = write_results(o, in, s, &answer, work);
    char path[OUTDIR_PATH_SIZE];
    snprintf(path, sizeof path, "%s", s->dir.path);
    const bool report = in->output.report && written.code == STATUS_OK && work.code == STATUS_OK;
    say_where(o, s, work);
    const status closed = run_session_close(s, work.code == STATUS_OK && written.code == STATUS_OK);
    if (y->free) y->free(answer.owned); /* scenes may be made of its cases until then */
    if (report) draw_report(path);
    if (work.code != STATUS_OK) return work.code == STATUS_STOPPED ? EXIT_STOPPED : complain(work);
    return complain(written.code != STATUS_OK ? written : closed);
}

static int run_case(const options *o)
{
    case_inputs *in = NULL;
    session s;
    const status got = read_case(o, o->command.study->needs, &in);
    if (got.code != STATUS_OK) return exit_code(got);
    const session_options how = { .command = o->command.name,
                                  .dir = o->dir,
                                  .store = o->store,
                                  .how = o->how,
                                  .threads = o->threads,
                                  .lending = o->lending,
                                  .run_scene = gouge_run,
                                  .progress_to = stderr,
                                  .quiet = o->quiet,
                                  .stop = host_stop_requested };
    const status opened = run_session_open(in, &how, &s);
    int code;
    if (opened.code == STATUS_OK && s.dir.state != OUTDIR_FINISHED) {
        if (!o->quiet && in->warnings[0]) fputs(in->warnings, stderr);
        code = carry_out(o, in, &s);
    } else {
        if (opened.code == STATUS_OK) say_finished(o, in, &s);
        code = complain(opened);
        run_session_close(&s, false);
    }
    case_inputs_free(in);
    return code;
}

/* ---- check ---- */

/* The commands whose sections the case has. */
static unsigned needs_of(const case_inputs *in)
{
    const case_given *g = &in->given;
    unsigned needs = 0;
    for (int k = 0; k < SUPPLY_KINDS; k++)
        if (g->supplies[k]) needs |= CASE_FOR_SHOT;
    if (g->sites || g->populations) needs |= CASE_FOR_ONSET;
    if (g->treatments) needs |= CASE_FOR_COMPARE;
    if (g->projectile && g->scene && (!isnan(in->onset.impact.scene.velocity) || !(needs & CASE_FOR_ONSET)))
        needs |= CASE_FOR_SCENE;
    if (g->bodies) needs |= CASE_FOR_SCENE;
    if (g->strike) needs |= CASE_FOR_STRIKE;
    if (g->rails) needs |= CASE_FOR_INDUCTANCE;
    if (g->sweep) needs |= CASE_FOR_SWEEP;
    return needs;
}

/* What the random shots draw at most: grains too slow to gouge are not drawn. */
static void print_random(const case_onset *c)
{
    double grains = 0.0;
    for (int k = 0; k < c->populations.n; k++) {
        const case_population *p = &c->populations.item[k];
        grains += p->density * (p->to - p->from) * (p->renewed ? c->study.shots : 1);
    }
    if (grains > 0.0)
        printf("random shots: %d histories, at most %.2g grains\n", c->study.sampled, grains * c->study.sampled);
}

static status print_check(const case_inputs *in, int threads)
{
    scene_estimate e[CHECK_MAX_ESTIMATES];
    int n = 0;
    table *t;
    TRY(study_check(in, threads, e, &n));
    printf("%s: %s\n", in->path, in->title[0] ? in->title : in->name);
    fputs(in->warnings, stdout);
    TRY(host_table_create("scene|points at the start|memory [GB]|steps|time, at least", &t));
    for (int i = 0; i < n; i++) {
        const mpm_needs *at = &e[i].needs;
        char time[40];
        host_duration_text(e[i].seconds, time, sizeof time);
        host_table_row(t, "%s|%zu|%.2f|%.0f|%s", e[i].what, at->particles, 1e-9 * (double)at->bytes, e[i].steps, time);
    }
    if (n > 0) host_table_print(t, stdout);
    host_table_free(t);
    const case_onset *c = &in->onset;
    if (c->study.ensemble > 0) printf("scene: on %d grids, each as above\n", c->study.ensemble);
    if (c->sites.n > 0 || c->populations.n > 0)
        printf("onset: %d sites, %d populations, at most %d scenes\n", c->sites.n, c->populations.n,
               c->study.max_scenes);
    if (in->treatments.n > 0)
        printf("compare: %d surfaces, at most %d scenes each\n", in->treatments.n + 1, c->study.max_scenes);
    print_random(c);
    return status_ok();
}

/* Does a run's summary hold what the case's list of expectations says? */
static int run_expect(const options *o)
{
    case_inputs *in = NULL;
    expectations e;
    table *t = NULL;
    const status read = read_case(o, 0, &in);
    if (read.code != STATUS_OK) return exit_code(read);
    status s = output_expect(in->path, o->expect, &e);
    if (s.code == STATUS_OK) s = host_table_create("key|expected|found|deviation|", &t);
    for (int i = 0; i < e.n && s.code == STATUS_OK; i++) {
        const expectation *x = &e.item[i];
        char deviation[30] = "";
        if (!isnan(x->deviation)) snprintf(deviation, sizeof deviation, "%+.2f %%", 100.0 * x->deviation);
        s = host_table_row(t, "%s|%s|%s|%s|%s", x->key, x->wanted, x->found, deviation, x->holds ? "holds" : "FAILS");
    }
    if (s.code == STATUS_OK) {
        host_table_print(t, stdout);
        printf("%d of %d expectations hold\n", e.held, e.n);
    }
    const bool all = e.held == e.n;
    host_table_free(t);
    output_expect_free(&e);
    case_inputs_free(in);
    return s.code == STATUS_OK && !all ? EXIT_FAILED : complain(s);
}

static int run_check(const options *o)
{
    if (o->expect) return run_expect(o);
    case_inputs *in = NULL;
    status s = read_case(o, 0, &in);
    if (s.code != STATUS_OK) return exit_code(s);
    const unsigned needs = needs_of(in) & (o->scene ? CASE_FOR_SCENE : ~0u);
    case_inputs_free(in);
    s = read_case(o, needs, &in);
    if (s.code != STATUS_OK) return exit_code(s);
    s = o->scene ? study_print_scene(in, stdout) : print_check(in, o->threads);
    case_inputs_free(in);
    return complain(s);
}

/* ---- materials ---- */

static void print_sheet(const material_sheet *sheet)
{
    printf("%s: %s\n%s\n", sheet->material.name, sheet->title, sheet->path);
    printf("  strength: %s\n  eos: %s\n  failure: %s\n", mpm_material_strength_text(sheet->material.strength),
           mpm_material_eos_text(sheet->material.eos), mpm_material_failure_text(sheet->material.failure));
    for (int i = 0; i < sheet->n; i++) {
        const material_constant *k = &sheet->constant[i];
        const double value = *(const double *)(const void *)((const char *)&sheet->material + k->constant->offset);
        char text[60];
        host_quantity_text(value, k->constant->unit, text, sizeof text);
        printf("  %-22s %-16s %s%s\n", k->constant->key, text, k->weak ? "[weak] " : "", k->source);
        if (k->note) printf("  %-22s %-16s (%s)\n", "", "", k->note);
    }
}

static int print_names(const material_places *at)
{
    for (int d = 0; d < at->n; d++) {
        char **names;
        int n;
        const status s = case_material_names(at->dir[d], &names, &n);
        if (s.code != STATUS_OK) return complain(s);
        for (int i = 0; i < n; i++) printf("%-20s %s\n", names[i], at->dir[d]);
        case_material_names_free(names, n);
    }
    return EXIT_DONE;
}

static status open_material(const char *name, material_sheet *sheet)
{
    material_places at;
    char *errors = NULL;
    case_material_places_find(&at);
    const status s = case_material_sheet_open(name, at.dir, at.n, sheet, &errors);
    if (errors) fputs(errors, stderr);
    free(errors);
    return s;
}

static int run_materials(const options *o)
{
    material_places at;
    material_sheet sheet;
    case_material_places_find(&at);
    if (!o->subject) return print_names(&at);
    const status s = open_material(o->subject, &sheet);
    if (s.code != STATUS_OK) return complain(s);
    print_sheet(&sheet);
    case_material_sheet_free(&sheet);
    return EXIT_DONE;
}

static int run_flow(const options *o)
{
    material_sheet sheet;
    status s = open_material(o->subject, &sheet);
    if (s.code != STATUS_OK) return complain(s);
    s = study_flow_print(&sheet.material, o->sets, o->n_sets, stdout);
    case_material_sheet_free(&sheet);
    return complain(s);
}

/* ---- the rest ---- */

static int run_report(const options *o)
{
    const status s = report_write(o->subject, study_report_part);
    if (s.code == STATUS_OK && !o->quiet) printf("%s/%s\n", o->subject, OUTDIR_REPORT);
    return complain(s);
}

/* The case that a new one begins from must be one. */
static status start_read(const char *file)
{
    material_places at;
    case_material_places_find(&at);
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n };
    case_inputs *in = NULL;
    char *errors = NULL;
    status s = case_inputs_read(file, NULL, 0, &how, &in, &errors);
    if (errors) {
        fputs(errors, stderr);
        s = base_status_error(STATUS_BAD_INPUT, "%.300s has errors: nothing was begun from it", file);
    }
    free(errors);
    case_inputs_free(in);
    return s;
}

static int run_new(const options *o)
{
    const case_kind *kind = NULL;
    char file[CASE_START_SIZE];
    status s = case_new_start(o->from, &kind, file);
    if (s.code == STATUS_OK) s = start_read(file);
    if (s.code == STATUS_OK) s = case_new_make(o->subject, file);
    if (s.code != STATUS_OK) return complain(s);
    if (o->quiet) return EXIT_DONE;
    printf("%s/case.yaml, begun from %s\n\n", o->subject, file);
    printf("  breech check %-20s what it needs, what is wrong with it\n", o->subject);
    if (kind) printf("  breech %-5s %-20s %s\n", kind->run, o->subject, kind->doc);
    return EXIT_DONE;
}

/* ---- options ---- */

/* "90", "45s", "30m", "2h", "1:30", "1:30:00" in seconds; NAN if it is none of these. */
static double wall_time(const char *text)
{
    double total = 0.0;
    bool behind_colon = false;
    for (;;) {
        char *end;
        const double part = strtod(text, &end);
        if (end == text || !(part >= 0.0) || !isfinite(part)) return NAN;
        if (behind_colon && part >= 60.0) return NAN;
        total = 60.0 * total + part;
        if (*end == '\0') return total;
        if (*end != ':') {
            const char *unit = strchr("s m h ", *end);
            if (!unit || end[1] != '\0' || *end == ' ') return NAN;
            return total * (*end == 's' ? 1.0 : *end == 'm' ? 60.0 : 3600.0);
        }
        text = end + 1;
        behind_colon = true;
    }
}

static bool whole_number(const char *text, int low, int high, int *out)
{
    char *end;
    errno = 0;
    const long n = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno || n < low || n > high) return false;
    *out = (int)n;
    return true;
}

static status take_set(options *o, const char *set)
{
    CHECK(o->n_sets < MAX_SETS, STATUS_BAD_INPUT, "--set: more than %d", MAX_SETS);
    o->sets[o->n_sets++] = set;
    return status_ok();
}

static status take_ensemble(options *o, const char *value)
{
    int scenes;
    CHECK(whole_number(value, 2, 1000, &scenes), STATUS_BAD_INPUT, "--ensemble %.40s: must be 2 .. 1000", value);
    snprintf(o->ensemble, sizeof o->ensemble, "study.ensemble=%d", scenes);
    return take_set(o, o->ensemble);
}

/* An option with a value.  STATUS_BAD_INPUT says what is wrong with it. */
static status take_value(options *o, const char *name, const char *value)
{
    CHECK(value, STATUS_BAD_INPUT, "%s needs a value", name);
    if (strcmp(name, "-o") == 0) {
        CHECK(value[0], STATUS_BAD_INPUT, "-o: the directory's name is empty");
        o->dir = value;
    } else if (strcmp(name, "--store") == 0) {
        CHECK(value[0], STATUS_BAD_INPUT, "--store: the directory's name is empty; --no-store uses none");
        o->store = value;
    } else if (strcmp(name, "--expect") == 0) {
        CHECK(value[0], STATUS_BAD_INPUT, "--expect: the directory's name is empty");
        o->expect = value;
    } else if (strcmp(name, "--from") == 0) {
        CHECK(value[0], STATUS_BAD_INPUT, "--from: the case's name is empty");
        o->from = value;
    } else if (strcmp(name, "--set") == 0) {
        TRY(take_set(o, value));
    } else if (strcmp(name, "--ensemble") == 0) {
        TRY(take_ensemble(o, value));
    } else if (strcmp(name, "--threads") == 0) {
        CHECK(whole_number(value, 1, 4096, &o->threads), STATUS_BAD_INPUT, "--threads %.40s: must be 1 .. 4096", value);
    } else {
        o->max_walltime = wall_time(value);
        CHECK(o->max_walltime > 0.0, STATUS_BAD_INPUT,
              "--max-walltime %.40s: must be a time such as 90, 45s, 30m, 2h or 1:30:00", value);
    }
    return status_ok();
}

static bool takes_value(const char *name)
{
    static const char *const names[] = { "-o",        "--store",    "--expect",       "--from", "--set",
                                         "--threads", "--ensemble", "--max-walltime", NULL };
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0) return true;
    return false;
}

static bool take_flag(options *o, const char *name)
{
    if (strcmp(name, "--resume") == 0)
        o->how.resume = true;
    else if (strcmp(name, "--force") == 0)
        o->how.force = true;
    else if (strcmp(name, "--quiet") == 0)
        o->quiet = true;
    else if (strcmp(name, "--scene") == 0)
        o->scene = true;
    else if (strcmp(name, "--no-store") == 0)
        o->no_store = true;
    else
        return false;
    return true;
}

/* A value is given once. */
static status first_time(options *o, const char *name)
{
    if (strcmp(name, "--set") == 0) return status_ok();
    for (int k = 0; k < o->n_given; k++)
        CHECK(strcmp(o->given[k], name) != 0, STATUS_BAD_INPUT, "%s is given twice", name);
    o->given[o->n_given++] = name;
    return status_ok();
}

/* One word of the command line; *i moves on where the next one is its value.  --name=value is understood too. */
static status take_word(options *o, int argc, char **argv, int *i)
{
    char *word = argv[*i], *equals = strncmp(word, "--", 2) == 0 ? strchr(word, '=') : NULL;
    if (equals) *equals = '\0';
    if (takes_value(word)) {
        const char *value = equals ? equals + 1 : *i + 1 < argc ? argv[++*i] : NULL;
        TRY(first_time(o, word));
        return take_value(o, word, value);
    }
    CHECK(!equals, STATUS_BAD_INPUT, "%.80s takes no value, or is no option; breech --help lists them", word);
    if (take_flag(o, word)) return status_ok();
    CHECK(word[0] != '-' || word[1] == '\0', STATUS_BAD_INPUT, "no option %.80s; breech --help lists them", word);
    if (!o->command.name) {
        o->command = command_find(word);
        CHECK(o->command.name, STATUS_BAD_INPUT, "no command `%.80s`; breech --help lists them", word);
        return status_ok();
    }
    CHECK(!o->subject, STATUS_BAD_INPUT, "%s takes one %s: `%.80s` is one too many", o->command.name,
          o->command.subject, word);
    o->subject = word;
    return status_ok();
}

static status parse(int argc, char **argv, options *o)
{
    for (int i = 1; i < argc; i++) TRY(take_word(o, argc, argv, &i));
    CHECK(o->command.name, STATUS_BAD_INPUT, "no command given; breech --help lists them");
    CHECK(!o->store || !o->no_store, STATUS_BAD_INPUT, "--store and --no-store exclude each other");
    if (o->no_store) o->store = "";
    CHECK(!o->scene || o->command.run == run_check, STATUS_BAD_INPUT, "--scene goes with `breech check CASE`");
    CHECK(!o->from || o->command.run == run_new, STATUS_BAD_INPUT, "--from goes with `breech new NAME`");
    CHECK(!o->ensemble[0] || o->command.study == &study_scene, STATUS_BAD_INPUT,
          "--ensemble goes with `breech scene CASE`; for a threshold it is --set study.threshold_ensemble=N");
    CHECK(o->subject || !o->command.subject_required, STATUS_BAD_INPUT, "%s needs a %s: breech %s %s", o->command.name,
          o->command.subject, o->command.name, o->command.subject);
    return status_ok();
}

/* --help, --version and --keys, wherever they stand; -1: none of them. */
static int answer(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        const char *name = i + 1 < argc ? argv[i + 1] : i > 1 ? argv[1] : NULL;
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) return help(name);
        if (strcmp(argv[i], "--version") == 0) {
            printf("breech %s, instruction set %s\n", host_version(), mpm_instruction_set());
            return EXIT_DONE;
        }
        if (strcmp(argv[i], "--keys") == 0) {
            case_print_keys(stdout);
            return EXIT_DONE;
        }
    }
    return -1;
}

/* Threads that spin while they wait cost a busy machine several times its speed; OpenMP reads its settings before main,
 * so the program starts itself once more.  A setting of the user's stays. */
static void wait_passively(char **argv)
{
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
    if (setenv("OMP_WAIT_POLICY", "passive", 1) == 0) execv("/proc/self/exe", argv);
}

/* All of the machine, or of what the launcher has bound this process to; several processes on one machine share it. */
static int default_threads(void)
{
    const int mine = omp_get_num_procs(), all = (int)sysconf(_SC_NPROCESSORS_ONLN), here = run_ranks_on_machine();
    if (getenv("OMP_NUM_THREADS") || mine < all || here == 1) return omp_get_max_threads();
    return mine > here ? mine / here : 1;
}

static int lead(int argc, char **argv, int threads, lending *l)
{
    const int answered = argc > 1 ? answer(argc, argv) : -1;
    if (answered >= 0) return answered;
    if (argc == 1) {
        print_help(stderr);
        return EXIT_USAGE;
    }
    options o = { .threads = threads, .lending = l, .max_walltime = INFINITY };
    const status s = parse(argc, argv, &o);
    if (s.code != STATUS_OK) return complain(s);
    run_lending_own(l, o.threads);
    return o.command.run(&o);
}

/* The other processes read their number of threads only; what is wrong with the words, rank 0 says. */
static int follow(int argc, char **argv, int threads, lending *l)
{
    options o = { .threads = threads };
    (void)parse(argc, argv, &o);
    run_lending_own(l, o.threads);
    run_crew_serve(o.threads, l, gouge_run);
    return EXIT_DONE;
}

int main(int argc, char **argv)
{
    wait_passively(argv);
    status s = run_ranks_start();
    if (s.code != STATUS_OK) return complain(s);
    const int threads = default_threads(); /* before run_lending_open, which unbinds */
    lending *l;
    s = run_lending_open(threads, &l);
    if (s.code != STATUS_OK) return complain(s);
    int code;
    if (run_ranks_number() == 0) {
        code = lead(argc, argv, threads, l);
        if (fflush(stdout) != 0 || ferror(stdout)) {
            fprintf(stderr, "breech: standard output cannot be written to\n");
            if (code == EXIT_DONE) code = EXIT_FAILED;
        }
        run_crew_dismiss();
    } else {
        code = follow(argc, argv, threads, l);
    }
    run_lending_close(l);
    run_ranks_finish();
    return code;
}
