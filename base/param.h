/* SPDX-License-Identifier: BSD-3-Clause */
/* Parameters: one table a struct says every key once: unit, default, range, text.
 *
 * The case reader, `breech check`, used.yaml and the manual's key list are all made from these tables, and so is any
 * validation of a struct that was filled in by hand (base_params_check).
 * To add a parameter: a member in the struct, one line in its table.  Nothing else.
 * A double that has no value and needs none holds NAN (`OPTIONAL`).  Units are udunits2 expressions of the SI value
 * held. */
#ifndef BREECH_BASE_PARAM_H
#define BREECH_BASE_PARAM_H

#include "base/status.h"

#include <math.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { BASE_PARAM_TEXT_SIZE = 64 }; /* bytes of a BASE_PARAM_TEXT member whose row says no other */

typedef enum {
    BASE_PARAM_NUMBER,  /* double, in `unit` */
    BASE_PARAM_INTEGER, /* int */
    BASE_PARAM_FLAG,    /* bool: true/false, yes/no */
    BASE_PARAM_CHOICE,  /* int: index into `choices` */
    BASE_PARAM_TEXT,    /* char[base_param_text_size] */
    BASE_PARAM_VECTOR,  /* double[3], in `unit`, written [a, b, c] */
    BASE_PARAM_POINTS   /* double[2 * room], in `unit`, written [[a, b], [c, d], ...]; NAN behind the last */
} base_param_kind;

typedef struct {
    const char *key, *unit, *doc;
    size_t offset;
    double fallback, min, max; /* in `unit`; min and max are inclusive */
    base_param_kind kind;
    const char *const *choices; /* BASE_PARAM_CHOICE: names, NULL at the end */
    const char *fallback_text;  /* BASE_PARAM_TEXT: default, NULL = required */
    int room; /* BASE_PARAM_POINTS: pairs at most; at least one must be given.  BASE_PARAM_TEXT: bytes, 0 = the usual */
} base_param;

/* A table ends with a row whose key is NULL.  The macros that write rows are for Breech's own sources. */
#ifdef BREECH_INSIDE
#define REQUIRED INFINITY /* fallback of a number that must be given */
#define OPTIONAL NAN      /* fallback of a number that may stay unset (the member then holds NAN) */
/* clang-format off */
#define PARAMS_END { .key = NULL }
#define PARAM_DOUBLE(type, member, unit_, fallback_, min_, max_, doc_)                                             \
    { .key = #member, .unit = (unit_), .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_), \
      .min = (min_), .max = (max_), .kind = BASE_PARAM_NUMBER }
#define PARAM_INT(type, member, fallback_, min_, max_, doc_)                                                       \
    { .key = #member, .unit = "1", .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_),     \
      .min = (min_), .max = (max_), .kind = BASE_PARAM_INTEGER }
#define PARAM_BOOL(type, member, fallback_, doc_)                                                                  \
    { .key = #member, .unit = "1", .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_),     \
      .min = 0, .max = 1, .kind = BASE_PARAM_FLAG }
#define PARAM_ENUM(type, member, choices_, fallback_, doc_)                                                        \
    { .key = #member, .unit = "1", .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_),     \
      .min = 0, .max = 1e9, .kind = BASE_PARAM_CHOICE, .choices = (choices_) }
#define PARAM_STRING(type, member, fallback_text_, doc_)                                                           \
    { .key = #member, .unit = "1", .doc = (doc_), .offset = offsetof(type, member), .kind = BASE_PARAM_TEXT,          \
      .fallback_text = (fallback_text_) }
#define PARAM_LONG_STRING(type, member, fallback_text_, doc_)                                                     \
    { .key = #member, .unit = "1", .doc = (doc_), .offset = offsetof(type, member), .kind = BASE_PARAM_TEXT,          \
      .fallback_text = (fallback_text_), .room = (int)sizeof(((type *)0)->member) }
#define PARAM_VEC3(type, member, unit_, fallback_, min_, max_, doc_)                                               \
    { .key = #member, .unit = (unit_), .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_), \
      .min = (min_), .max = (max_), .kind = BASE_PARAM_VECTOR }
#define PARAM_PAIRS(type, member, unit_, min_, max_, doc_)                                                         \
    { .key = #member, .unit = (unit_), .doc = (doc_), .offset = offsetof(type, member), .fallback = REQUIRED,    \
      .min = (min_), .max = (max_), .kind = BASE_PARAM_POINTS,                                                         \
      .room = (int)(sizeof(((type *)0)->member) / (2 * sizeof(double))) }
/* clang-format on */
#endif

/* Fills every member of the table with its default; REQUIRED numbers become NAN, required texts "". */
void base_params_default(const base_param *table, void *object);

/* Bytes of a BASE_PARAM_TEXT member, the 0 at its end included. */
size_t base_param_text_size(const base_param *p);

/* How many pairs a BASE_PARAM_POINTS member holds. */
int base_param_pairs(const double *member, int room);

/* Error BASE_STATUS_BAD_INPUT naming "<section>.<key>", value, unit and range for the first member that is out of range
 * or required and unset. */
base_status base_params_check(const base_param *table, const void *object, const char *section);

#ifdef __cplusplus
}
#endif

#endif
