/* SPDX-License-Identifier: BSD-3-Clause */
/* A study: a command that turns a case into a result.
 *
 * To add one: write coupling/study/study_<name>.c with `const study study_<name>` and one line in study.def.  The
 * program's commands, their help, what they need of a case, summary.json, the closing table, the manual's keys and the
 * report come from that. */
#ifndef BREECH_COUPLING_STUDY_H
#define BREECH_COUPLING_STUDY_H

#include "coupling/report/report.h"
#include "coupling/run/scenes.h"
#include "coupling/run/shot_record.h"

/* How the case was read, so that a study can read it again with other values.  Borrowed. */
typedef struct {
    const case_inputs *in;
    bool one_of_several;     /* made by another study, not the case of the command line */
    const char *prefix;      /* of its scenes' names, so that those of several cases differ */
    const char *const *sets; /* of the command line, as case_read takes them */
    int n_sets;
    size_t *largest; /* raised to the memory that one of its scenes takes [bytes]; NULL: not asked */
} study_case;

typedef struct {
    const void *result;      /* of the study's keys; NULL: not reached; borrows owned */
    const shot_record *shot; /* of a study that shows_shot; NULL: not reached; borrows owned */
    void *owned;             /* by the caller: study.free, after run_session_close */
} study_answer;

typedef struct study {
    const char *name, *doc, *more, *example; /* example: a whole command line, of shipped cases */
    /* The next study that may take the place of one of study.def, for cases for which its `takes` says so; it has no
     * command of its own.  NULL: none. */
    const struct study *instead;
    bool (*takes)(const case_inputs *in);
    unsigned needs;          /* of the case, sum of CASE_FOR_... */
    const summary_key *keys; /* of its result */
    const char *const
        *usual;         /* of the keys, what a sweep reads unless told, NULL at the end; NULL: the first numbers */
    bool many_scenes;   /* it may compute several side by side */
    bool shows_shot;    /* its summary has the shot too, under "shot" */
    bool can_vary;      /* runs any case, not the session's alone: `breech sweep` may call it */
    report_part report; /* of report.html */
    void (*print)(const void *result, FILE *out); /* its closing table; NULL: its keys */
    /* STATUS_BAD_INPUT before anything is written: what reading the case cannot tell.  NULL: nothing. */
    status (*possible)(const study_case *of);
    /* The scenes that it asks for whatever they answer; how many, at most 1.  NULL: none is certain. */
    int (*scenes)(const study_case *of, scene_query *out);
    /* What was reached stands in *out on error too. */
    status (*run)(session *s, const study_case *of, study_answer *out);
    void (*free)(void *owned); /* NULL allowed as owned */
} study;

#define STUDY(name) extern const study study_##name;
#include "coupling/study/study.def"
#undef STUDY

#define STUDY(name) STUDY_##name,
enum {
#include "coupling/study/study.def"
    STUDIES
};
#undef STUDY
extern const study *const study_list[STUDIES];
/* Those that take a place: */
extern const study study_ensemble, study_bodies, study_rail_life, study_compare_life, study_compare_targets;

/* This one, or what takes its place for such a case. */
const study *study_for(const study *y, const case_inputs *in);

const study *study_find(const char *name); /* NULL: there is none */
/* The command that runs it: `scene` for what takes its place. */
const char *study_command(const study *y);

/* Decides what the case leaves to the program; before all that follows. */
status study_prepare(case_inputs *in);

/* Before anything is written: what only making the scenes can tell; largest as in study_case.  STATUS_BAD_INPUT. */
status study_possible(const case_inputs *in, unsigned needs, size_t *largest);
/* That, and what the studies whose needs are among these say themselves. */
status study_possible_all(const study_case *of, unsigned needs);

/* What the report shows of the study of that name; empty where there is none. */
report_kind study_report_kind(const char *name);

/* The tables of the summary of the study of that name; empty where there is none. */
summary_tables study_tables(const char *name);

/* What is written of an answer; the rest is the caller's. */
run_summary study_summary(const study *y, const study_answer *a);

/* The keys of all summaries, for the manual. */
void study_print_keys(FILE *out);

#endif
