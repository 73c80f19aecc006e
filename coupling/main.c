/* SPDX-License-Identifier: BSD-3-Clause */
/* breech: the program.  Options in, exit code out; the only place that prints and exits.
 *
 * To add a command that runs a case: a study (study/study.h); any other: a line in usage/commands.def and its function
 * here, run_<name>. */
#include "coupling/case/case_new.h"
#include "coupling/case/material_role.h"
#include "coupling/gouge/impact.h"
#include "coupling/host/machine.h"
#include "coupling/host/stop.h"
#include "coupling/host/table.h"
#include "coupling/host/version.h"
#include "coupling/output/expect.h"
#include "coupling/report/report.h"
#include "coupling/run/crew.h"
#include "coupling/run/ranks.h"
#include "coupling/study/check.h"
#include "coupling/study/flow.h"
#include "coupling/usage/usage.h"

#include <math.h>
#include <omp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_PROCESSES = 256, USUAL_PROCESSES = 8 };
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_STOPPED = 75 };

typedef struct {
    usage_line line;
    double started; /* of host_wall_clock, when the program was [s] */
    lending *lending;
    size_t *largest; /* memory of the case's largest scene, once it is read [bytes] */
} options;

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

/* Processes of a study of several scenes: a scene gets little faster with more than a few threads, and a process
 * without one lends its own.  Who says how many threads there are has decided otherwise. */
static int usual_processes(const usage_line *l)
{
    if (usage_given(l, "--threads") || getenv("OMP_NUM_THREADS")) return 1;
    const int cores = omp_get_num_procs();
    return cores < USUAL_PROCESSES ? cores : USUAL_PROCESSES;
}

/* ---- the case ---- */

static study_case study_case_of(const options *o, const case_inputs *in)
{
    return (
        study_case){ .in = in, .prefix = "", .sets = o->line.sets, .n_sets = o->line.n_sets, .largest = o->largest };
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

/* For a study, or NULL and these needs. */
static status read_case(const options *o, const study *y, unsigned needs, case_inputs **in)
{
    material_places at;
    char *errors = NULL;
    status s = case_material_places_find(&at);
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n, .needs = y ? y->needs : needs };
    if (s.code == STATUS_OK) s = case_inputs_read(o->line.subject, o->line.sets, o->line.n_sets, &how, in, &errors);
    if (s.code == STATUS_OK) {
        s = study_prepare(*in);
        const study_case of = study_case_of(o, *in);
        if (s.code == STATUS_OK) s = study_possible_all(&of, y ? study_for(y, *in)->needs : needs);
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
    run_summary made = study_summary(study_for(o->line.command.study, in), a), *summary = &made;
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
    if (!o->line.quiet) {
        fputc('\n', stdout);
        output_summary_print(summary, stdout);
        fputc('\n', stdout);
        host_timing_print(&s->timing, stdout);
    }
    return written;
}

static void say_where(const options *o, const session *s, status work)
{
    if (work.code == STATUS_STOPPED) {
        fprintf(stderr, "breech: stopped (%s); --resume goes on: ", host_stop_reason());
        usage_print_resume(&o->line, s->dir.path, stderr);
    } else if (!o->line.quiet) {
        printf("\nresults: %s\n", s->dir.path);
    }
}

static int draw_report(const char *dir)
{
    const status drawn = report_write(dir, study_report_kind);
    if (drawn.code == STATUS_OK) return EXIT_DONE;
    fprintf(stderr, "breech: no report: %s; `breech report` makes it from what is there\n", drawn.text);
    return EXIT_FAILED;
}

/* --resume of a finished run; one that was killed while it drew its report gets that. */
static int say_finished(const options *o, const case_inputs *in, const session *s)
{
    char path[OUTDIR_PATH_SIZE];
    if (!o->line.quiet) printf("%s: finished already\n", s->dir.path);
    if (in->output.report && host_outdir_file(&s->dir, OUTDIR_REPORT, path, sizeof path).code == STATUS_OK &&
        !host_file_exists(path))
        return draw_report(s->dir.path);
    return EXIT_DONE;
}

static int carry_out(const options *o, const case_inputs *in, session *s)
{
    const study_case of = study_case_of(o, in);
    study_answer answer = { .result = NULL };
    host_stop_install(o->started, o->line.max_walltime);
    const study *y = study_for(o->line.command.study, in);
    status work = y->run(s, &of, &answer);
    const status written = write_results(o, in, s, &answer, work);
    char path[OUTDIR_PATH_SIZE];
    snprintf(path, sizeof path, "%s", s->dir.path);
    const bool report = in->output.report && written.code == STATUS_OK && work.code == STATUS_OK;
    say_where(o, s, work);
    const status closed = run_session_close(s, work.code == STATUS_OK && written.code == STATUS_OK);
    if (y->free) y->free(answer.owned); /* scenes may be made of its cases until then */
    const int drawn = report ? draw_report(path) : EXIT_DONE;
    if (work.code != STATUS_OK && work.code != STATUS_STOPPED) return complain(work);
    const status last = written.code != STATUS_OK ? written : closed;
    if (last.code != STATUS_OK) return complain(last);
    return work.code == STATUS_OK ? drawn : exit_code(work);
}

/* Scenes of this size that the machine holds side by side: each process may have put one off for another. */
static int side_by_side(size_t largest)
{
    return largest ? (int)fmin(fmax(host_memory("") / (2.0 * (double)largest), 1), MOST_PROCESSES) : 0;
}

static int run_case(const options *o)
{
    case_inputs *in = NULL;
    session s;
    const status got = read_case(o, o->line.command.study, 0, &in);
    if (got.code != STATUS_OK) return exit_code(got);
    const session_options how = { .command = o->line.command.name,
                                  .dir = o->line.dir,
                                  .store = o->line.store,
                                  .how = { .force = o->line.force, .resume = o->line.resume },
                                  .threads = o->line.threads,
                                  .side_by_side = side_by_side(*o->largest),
                                  .lending = o->lending,
                                  .run_scene = gouge_run,
                                  .progress_to = stderr,
                                  .quiet = o->line.quiet,
                                  .stop = host_stop_requested };
    const status opened = run_session_open(in, &how, &s);
    int code;
    if (opened.code == STATUS_OK && s.dir.state != OUTDIR_FINISHED) {
        if (in->warnings[0]) fputs(in->warnings, stderr);
        code = carry_out(o, in, &s);
    } else {
        const bool finished = opened.code == STATUS_OK;
        code = finished ? say_finished(o, in, &s) : complain(opened);
        run_session_close(&s, finished); /* killed at its very end it has left a checkpoint */
    }
    case_inputs_free(in);
    return code;
}

/* ---- check ---- */

/* Does a run's summary hold what the case's list of expectations says? */
static int run_expect(const options *o)
{
    case_inputs *in = NULL;
    expectations e;
    table *t = NULL;
    const status read = read_case(o, NULL, 0, &in);
    if (read.code != STATUS_OK) return exit_code(read);
    status s = output_expect(in->path, o->line.expect, study_tables, &e);
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
    if (o->line.expect) return run_expect(o);
    case_inputs *in = NULL;
    status s = read_case(o, NULL, 0, &in);
    if (s.code != STATUS_OK) return exit_code(s);
    const unsigned needs = study_check_needs(in) & (o->line.scene ? CASE_FOR_SCENE : ~0u);
    case_inputs_free(in);
    s = read_case(o, NULL, needs, &in);
    if (s.code != STATUS_OK) return exit_code(s);
    const check_machine on = { .threads = o->line.threads,
                               .processes = o->line.processes ? o->line.processes : usual_processes(&o->line),
                               .fit = side_by_side(*o->largest),
                               .largest = *o->largest };
    s = o->line.scene ? study_print_scene(in, stdout) : study_check_print(in, &on, needs, stdout);
    case_inputs_free(in);
    return complain(s);
}

/* ---- materials ---- */

/* Says what is wrong with it. */
static status open_material(const char *name, material_sheet *sheet)
{
    material_places at;
    char *errors = NULL;
    const char *dirs[MATERIAL_MAX_DIRS + 1] = { "." }; /* as beside a case */
    status s = case_material_places_find(&at);
    for (int i = 0; i < at.n; i++) dirs[i + 1] = at.dir[i];
    if (s.code == STATUS_OK) s = case_material_sheet_open(name, dirs, at.n + 1, sheet, &errors);
    if (errors)
        fputs(errors, stderr);
    else
        complain(s);
    free(errors);
    return s;
}

static bool is_folder(const char *path)
{
    struct stat is;
    return stat(path, &is) == 0 && S_ISDIR(is.st_mode);
}

static int run_materials(const options *o)
{
    material_places at;
    material_sheet sheet;
    const status found = case_material_places_find(&at);
    if (found.code != STATUS_OK) return complain(found);
    if (!o->line.subject) return complain(case_materials_print(&at, at.n, stdout));
    if (is_folder(o->line.subject)) {
        memmove(at.dir + 1, at.dir, (size_t)at.n++ * sizeof *at.dir); /* what its materials build on may lie there */
        at.dir[0] = o->line.subject;
        return complain(case_materials_print(&at, 1, stdout));
    }
    const status s = open_material(o->line.subject, &sheet);
    if (s.code != STATUS_OK) return exit_code(s);
    case_material_print(&sheet, stdout);
    case_material_sheet_free(&sheet);
    return EXIT_DONE;
}

static int run_flow(const options *o)
{
    material_sheet sheet;
    status s = open_material(o->line.subject, &sheet);
    if (s.code != STATUS_OK) return exit_code(s);
    s = study_flow_print(&sheet.material, o->line.sets, o->line.n_sets, stdout);
    case_material_sheet_free(&sheet);
    return complain(s);
}

/* ---- the rest ---- */

static int run_report(const options *o)
{
    const status s = report_write(o->line.subject, study_report_kind);
    if (s.code == STATUS_OK && !o->line.quiet) printf("%s/%s\n", o->line.subject, OUTDIR_REPORT);
    return complain(s);
}

/* The case that a new one begins from must be one. */
static status start_read(const char *file)
{
    material_places at;
    TRY(case_material_places_find(&at));
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
    status s = case_new_start(o->line.from, &kind, file);
    if (s.code == STATUS_OK) s = start_read(file);
    if (s.code == STATUS_OK) s = case_new_make(o->line.subject, file);
    if (s.code != STATUS_OK) return complain(s);
    if (o->line.quiet) return EXIT_DONE;
    printf("%s/case.yaml, begun from %s\n\n", o->line.subject, file);
    printf("  breech check %-20s what it needs, what is wrong with it\n", o->line.subject);
    if (kind) printf("  breech %-5s %-20s %s\n", kind->run, o->line.subject, kind->doc);
    return EXIT_DONE;
}

/* ---- words in place of a command ---- */

static int help(const char *name)
{
    const usage_command c = name ? usage_command_find(name) : (usage_command){ .name = NULL };
    if (name && !c.name) return complain(usage_no_command(name));
    if (c.name)
        usage_help_command(&c, stdout);
    else
        usage_help(stdout);
    return EXIT_DONE;
}

/* Wherever they stand; -1: none of them. */
static int answer(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        const char *next = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)
            return help(next ? next : i > 1 ? argv[1] : NULL);
        if (strcmp(argv[i], "--completion") == 0) return complain(usage_completion(next ? next : "", stdout));
        const bool version = strcmp(argv[i], "--version") == 0, keys = strcmp(argv[i], "--keys") == 0,
                   man = strcmp(argv[i], "--man") == 0;
        if (version) printf("breech %s, instruction set %s\n", host_version(), mpm_instruction_set());
        if (keys) case_print_keys(stdout);
        if (man) usage_man(stdout);
        if (version || keys || man) return EXIT_DONE;
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

/* Studies of several scenes compute them side by side. */
static int default_processes(int argc, char **argv)
{
    usage_line line = { .threads = 0 };
    if (usage_parse(argc, argv, &line).code != STATUS_OK) return 1;
    if (!line.command.study) return 1;
    if (line.processes > 0) return line.processes;
    return line.command.study->many_scenes || line.ensemble > 0 ? usual_processes(&line) : 1;
}

/* All of the machine, or of what the launcher has bound this process to; several processes on one machine share it. */
static int default_threads(void)
{
    const int mine = omp_get_num_procs(), all = (int)sysconf(_SC_NPROCESSORS_ONLN), here = run_ranks_on_machine();
    const bool bound = run_ranks_launched() && mine < all;
    if (getenv("OMP_NUM_THREADS") || bound || here == 1) return omp_get_max_threads();
    return mine > here ? mine / here : 1;
}

/* By the command's number: studies first, then the commands of usage/commands.def. */
static int run_command(const options *o)
{
#define COMMAND(name, ...) run_##name,
    static int (*const others[])(const options *) = {
#include "coupling/usage/commands.def"
    };
#undef COMMAND
    return o->line.command.study ? run_case(o) : others[o->line.command.number - STUDIES](o);
}

static int lead(int argc, char **argv, double started, int threads, lending *l)
{
    const int answered = argc > 1 ? answer(argc, argv) : -1;
    if (answered >= 0) return answered;
    if (argc == 1) {
        usage_help(stderr);
        return EXIT_USAGE;
    }
    size_t largest = 0;
    options o = { .line = { .threads = threads }, .started = started, .lending = l, .largest = &largest };
    const status s = usage_parse(argc, argv, &o.line);
    if (s.code != STATUS_OK) return complain(s);
    if (o.line.processes && run_ranks_launched())
        return complain(base_status_error(STATUS_BAD_INPUT,
                                          "--processes %d: mpirun has started %d already; give the "
                                          "number to one of the two",
                                          o.line.processes, run_ranks_count()));
    const status chosen = mpm_instruction_set_choose(o.line.instruction_set);
    if (chosen.code != STATUS_OK) return complain(chosen);
    run_lending_own(l, o.line.threads);
    return run_command(&o);
}

/* The other processes read their number of threads and the instruction set only; what is wrong with the words, rank 0
 * says. */
static int follow(int argc, char **argv, int threads, lending *l)
{
    usage_line line = { .threads = threads };
    (void)usage_parse(argc, argv, &line);
    (void)mpm_instruction_set_choose(line.instruction_set);
    run_lending_own(l, line.threads);
    run_crew_serve(line.threads, l, gouge_run);
    return EXIT_DONE;
}

int main(int argc, char **argv)
{
    const double started = host_wall_clock();
    signal(SIGXFSZ, SIG_IGN); /* a file at the limit of its size (ulimit -f) is one that cannot be written */
    wait_passively(argv);
    status s = run_ranks_start(default_processes(argc, argv));
    if (s.code != STATUS_OK) return complain(s);
    const int threads = default_threads(); /* before run_lending_open, which unbinds */
    lending *l;
    s = run_lending_open(threads, &l);
    if (s.code != STATUS_OK) return complain(s);
    int code;
    if (run_ranks_number() == 0) {
        code = lead(argc, argv, started, threads, l);
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
