/* SPDX-License-Identifier: BSD-3-Clause */
/* summary.json: the machine's face of every run, written at its end whatever the end was.
 *
 * A result is a plain struct, declared by whoever makes it, with one table that says every key once (name, unit, where
 * it stands).  Writing, reading back, the closing table, the manual's key list and the tests all walk the table they
 * are given; nobody here knows a result.  SI units; NaN and what a run did not reach become null, so every key is
 * always there.  To add a key: a member in the struct, one line in its table.  Keys are only ever added. */
#ifndef BREECH_COUPLING_SUMMARY_H
#define BREECH_COUPLING_SUMMARY_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { SUMMARY_NAME_SIZE = 96, SUMMARY_PATH_SIZE = 240 };

/* ---- tables of keys ---- */

typedef enum {
    KEY_NUMBER,  /* double [n] */
    KEY_COUNT,   /* uint64_t */
    KEY_INTEGER, /* int */
    KEY_FLAG,    /* bool */
    KEY_TEXT,    /* char[n] */
    KEY_NAME,    /* enum, named by `names` */
    KEY_BY_NAME, /* double[] and their names, char[][item_size]: an object */
    KEY_PAIRS,   /* const summary_pair *: an object */
    KEY_LIST,    /* objects by `item` */
    KEY_MAP,     /* the same, in an object by their names: the first key of `item`, a KEY_TEXT */
    KEY_ARRAY,   /* const double * */
    KEY_PART     /* a struct inside, its keys in the same object */
} key_kind;

/* A name with a number, or with a text where that is not NULL.  Borrowed. */
typedef struct {
    const char *name, *text;
    double value;
} summary_pair;

typedef struct summary_key {
    const char *name, *unit, *doc;
    key_kind kind;
    size_t offset;
    int n;                          /* KEY_NUMBER: 1, or the length of a vector; KEY_TEXT, KEY_BY_NAME: room */
    const char *const *names;       /* KEY_NAME */
    const struct summary_key *item; /* KEY_LIST, KEY_MAP, KEY_PART */
    size_t item_size;               /* KEY_LIST, KEY_MAP, KEY_BY_NAME */
    size_t n_offset;       /* where the int stands that counts them: KEY_LIST, _MAP, _ARRAY, _PAIRS, _BY_NAME */
    size_t names_offset;   /* KEY_BY_NAME */
    const char *only_with; /* people are shown it only where the integer of this name is not 0; NULL: always */
} summary_key;

/* One line of a table each: SUMMARY_NUMBER(struct, "key", member, "unit", "what it is"). */
#define SUMMARY_ROW(type, key, member, unit_, doc_) \
    .name = (key), .unit = (unit_), .doc = (doc_), .offset = offsetof(type, member)
/* clang-format off */
#define SUMMARY_NUMBER(type, key, member, unit, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = KEY_NUMBER, .n = 1 }
#define SUMMARY_VECTOR(type, key, member, n_, unit, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = KEY_NUMBER, .n = (n_) }
#define SUMMARY_VALUE(type, kind_, key, member, unit, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = (kind_) }
#define SUMMARY_WITH(type, kind_, key, member, unit, with, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = (kind_), .n = 1, .only_with = (with) }
#define SUMMARY_TEXT(type, key, member, doc) \
    { SUMMARY_ROW(type, key, member, "", doc), .kind = KEY_TEXT, .n = sizeof(((const type *)0)->member) }
#define SUMMARY_CHOICE(type, key, member, names_, doc) \
    { SUMMARY_ROW(type, key, member, "", doc), .kind = KEY_NAME, .names = (names_) }
#define SUMMARY_BY_NAME(type, key, member, names_, count, unit, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = KEY_BY_NAME, .n_offset = offsetof(type, count), \
      .names_offset = offsetof(type, names_), .item_size = sizeof(((const type *)0)->names_[0]), \
      .n = sizeof(((const type *)0)->names_) / sizeof(((const type *)0)->names_[0]) }
#define SUMMARY_PAIRS(type, key, member, count, doc) \
    { SUMMARY_ROW(type, key, member, "", doc), .kind = KEY_PAIRS, .n_offset = offsetof(type, count) }
#define SUMMARY_LIST(type, key, member, count, item_, item_size_, doc) \
    { SUMMARY_ROW(type, key, member, "", doc), .kind = KEY_LIST, .n_offset = offsetof(type, count), .item = (item_), \
      .item_size = (item_size_) }
#define SUMMARY_MAP(type, key, member, count, item_, item_size_, doc) \
    { SUMMARY_ROW(type, key, member, "", doc), .kind = KEY_MAP, .n_offset = offsetof(type, count), .item = (item_), \
      .item_size = (item_size_) }
#define SUMMARY_ARRAY(type, key, member, count, unit, doc) \
    { SUMMARY_ROW(type, key, member, unit, doc), .kind = KEY_ARRAY, .n_offset = offsetof(type, count) }
#define SUMMARY_PART(type, title, member, item_) \
    { SUMMARY_ROW(type, title, member, "", ""), .kind = KEY_PART, .item = (item_) }
#define SUMMARY_END { .name = NULL }
/* clang-format on */

/* What an object of the summary is written from.  Borrowed. */
typedef struct {
    const summary_key *keys;
    const void *of; /* the struct they are of; NULL: not reached, every key is null */
} summary_object;

/* ---- the summary of a run ---- */

typedef enum { RUN_DONE, RUN_STOPPED, RUN_FAILED } run_status;
extern const char *const output_run_status_names[]; /* "done", "stopped", "failed", NULL */

/* Everything a summary says.  All borrowed. */
typedef struct {
    const char *kind; /* the command */
    const char *case_name;
    const char *instruction_set;
    run_status status;
    const char *error;                            /* NULL when there is none */
    const char *warnings;                         /* a line each, NULL or "" when there are none */
    summary_object result;                        /* its keys stand at the top level */
    summary_object shot;                          /* under "shot"; keys NULL: such a run has none */
    void (*print)(const void *result, FILE *out); /* for people; NULL: output_keys_print */
} run_summary;

/* DIR/summary.json, at once or not at all. */
status output_summary_write(const char *dir, const run_summary *s);
/* Its text, malloc'ed, the caller frees it; NULL when out of memory. */
char *output_summary_text(const run_summary *s);
/* The closing table for people: each key with its value and, where 100 columns allow it, what it means. */
void output_summary_print(const run_summary *s, FILE *out);

/* ---- objects by themselves ---- */

/* One line of JSON; numbers survive exactly.  malloc'ed, the caller frees it; NULL when out of memory. */
char *output_object_text(const summary_object *o);
/* The struct back from it.  STATUS_IO: not such a text, or keys are missing.  Lists and maps are malloc'ed, the caller
 * frees them, on error too; *out is all zero at first where there are any.  Not for KEY_PAIRS, _ARRAY. */
status output_object_read(const char *text, const summary_key *keys, void *out);
/* The unit of the integral over time of a quantity in `unit`, where it is a quantity of its own: an impulse, an impulse
 * an area, a way, an energy.  NULL: it is none, as that of a temperature. */
const char *output_unit_over_time(const char *unit);

/* A number of an object by its path: `key`, of a vector `key[0]`, of maps and of what has names of its own
 * `key.name.key`.  A key without a unit, beside one that is called `unit`, has that; its vectors are its integral over
 * time.  Of an object without values the value is NaN, names are `*`, and units that only values tell are "". */
typedef struct {
    const char *path, *unit;
    double value; /* NaN: null */
    bool counts;  /* a whole number: how many */
} output_number;
/* Shown all numbers of the object in the order of the keys, those of its parts too. */
typedef void output_number_visitor(void *user, const output_number *number);
void output_numbers_visit(const summary_object *o, output_number_visitor *visit, void *user);
/* May an object of these keys hold a number of this path? */
bool output_number_exists(const summary_key *keys, const char *path);
/* Its value; NaN: null, or it is not there.  unit: NULL, or where the unit goes, left alone where it is not there. */
double output_number_of(const summary_object *o, const char *path, char unit[SUMMARY_NAME_SIZE]);

/* The tables of the summary of a kind of run; NULL: there is none. */
typedef struct {
    const summary_key *result, *shot; /* shot: of what stands under "shot" */
} summary_tables;

/* For people: key, value rounded to four digits and unit with its prefix, of what is short and known: no lists, no
 * `reason`, no null. */
void output_keys_print(const summary_object *o, FILE *out);
/* A table of keys for the manual, in markdown. */
void output_keys_manual(const char *title, const summary_key *keys, FILE *out);

/* x in units of `unit` for a table, "-" where there is none; returns text. */
const char *output_cell(double x, double unit, const char *format, char text[24]);

#endif
