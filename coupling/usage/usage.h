/* SPDX-License-Identifier: BSD-3-Clause */
/* The command line: which commands and options there are, and all that is written of them - help, the manual page, what
 * a shell completes - from three lists: commands.def beside the studies, options.def, words.def.
 *
 * To add an option: one line in options.def and a member of usage_line.  To add a command: a study, or one line in
 * commands.def and its function in main.c. */
#ifndef BREECH_COUPLING_USAGE_H
#define BREECH_COUPLING_USAGE_H

#include "coupling/study/study.h"

enum { USAGE_MAX_SETS = 200 };

#define COMMAND(name, ...) USAGE_##name,
enum {
#include "coupling/usage/commands.def"
    USAGE_OTHERS
};
#undef COMMAND
enum { USAGE_COMMANDS_MADE = STUDIES + USAGE_OTHERS };

typedef struct {
    const char *name, *subject, *doc, *more, *example;
    bool subject_required;
    const study *study; /* NULL: one of commands.def */
    int number;         /* its place among all, studies first */
} usage_command;

typedef enum {
    USAGE_FLAG,  /* bool: there or not */
    USAGE_TEXT,  /* const char *, not empty; borrowed */
    USAGE_SET,   /* key=value, more than once */
    USAGE_COUNT, /* int in a range */
    USAGE_TIME   /* double [s] */
} usage_kind;

typedef enum {
    USAGE_NO_NAMES,
    USAGE_FOLDERS,
    USAGE_STARTS,   /* what a new case begins from */
    USAGE_COMMANDS, /* of the program */
    USAGE_SHELLS
} usage_names;

typedef struct {
    const char *name, *value; /* value NULL: a flag, or a word without one */
    usage_kind kind;
    int low, high;     /* USAGE_COUNT */
    uint64_t taken_by; /* a bit for each command, by its number */
    usage_names completes;
    size_t offset; /* in usage_line */
    const char *doc;
} usage_option;
extern const usage_option usage_options[], usage_words[]; /* each ends with a NULL name */

/* What a command line says. */
typedef struct {
    usage_command command;
    const char *subject; /* CASE, NAME or DIR; NULL */
    const char *dir, *expect, *from;
    const char *instruction_set; /* NULL: not given */
    const char *store;           /* NULL: in the output directory, "": none */
    const char *sets[USAGE_MAX_SETS];
    int n_sets, threads;
    int processes;         /* 0: not given */
    int ensemble;          /* 0: not given; is among sets then */
    char ensemble_set[40]; /* its text there */
    double max_walltime;   /* [s], INFINITY: none */
    bool resume, force, quiet, no_store, scene;
    uint64_t given; /* a bit for each option */
} usage_line;

/* The defaults stand in *out, which borrows argv.  STATUS_BAD_INPUT says what is wrong. */
status usage_parse(int argc, char **argv, usage_line *out);

bool usage_given(const usage_line *l, const char *option);
/* The command line that goes on with the run in dir: case, values and options of this one, --resume. */
void usage_print_resume(const usage_line *l, const char *dir, FILE *out);

usage_command usage_command_at(int i); /* of USAGE_COMMANDS_MADE */
/* Its name is NULL where there is none of this name. */
usage_command usage_command_find(const char *name);
/* STATUS_BAD_INPUT of a name that is no command, with the nearest that is. */
status usage_no_command(const char *name);
bool usage_takes(const usage_command *c, const usage_option *o);

/* All commands and options; one command. */
void usage_help(FILE *out);
void usage_help_command(const usage_command *c, FILE *out);
/* The manual page, roff of man(7). */
void usage_man(FILE *out);
/* "bash" or "zsh".  STATUS_BAD_INPUT: another. */
status usage_completion(const char *shell, FILE *out);

/* What the program's exit code means. */
typedef struct {
    int code;
    const char *doc;
} usage_exit;
extern const usage_exit usage_exits[]; /* ends with a NULL doc */

#endif
