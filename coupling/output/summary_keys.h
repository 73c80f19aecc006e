/* The keys of summary.json: one table a struct (summary_keys.c), from which they are written (summary.c), read back,
 * printed and listed in the manual (summary_print.c).  Inside of coupling/io. */
#ifndef BREECH_COUPLING_SUMMARY_KEYS_H
#define BREECH_COUPLING_SUMMARY_KEYS_H

#include "coupling/output/summary.h"

#include <cJSON.h>
#include <stddef.h>

typedef enum {
    KEY_NUMBER,  /* double [n] */
    KEY_COUNT,   /* uint64_t */
    KEY_INTEGER, /* int */
    KEY_FLAG,    /* bool */
    KEY_TEXT,    /* char[] */
    KEY_NAME,    /* enum, named by `names` */
    KEY_BY_BODY, /* double a body of a scene_result: an object */
    KEY_LIST,    /* objects by `item`, n_member of them */
    KEY_ARRAY    /* const double *, n_member of them */
} key_kind;

typedef struct summary_key {
    const char *name, *unit, *doc;
    key_kind kind;
    size_t offset;
    int n;                          /* KEY_NUMBER: 1, or the length of a vector */
    const char *const *names;       /* KEY_NAME */
    const struct summary_key *item; /* KEY_LIST */
    size_t item_size, n_offset;     /* KEY_LIST, KEY_ARRAY: where the int stands that counts them */
} summary_key;

extern const summary_key output_summary_shot_keys[], output_summary_scene_keys[], output_summary_site_keys[],
    output_summary_study_scene_keys[], output_summary_surface_keys[], output_summary_skip_keys[],
    output_summary_sensitivity_keys[], output_summary_repeated_keys[], output_summary_compare_entry_keys[];
extern const summary_key *const output_summary_keys_of_kind[RUN_KINDS];
const void *output_summary_object_of_kind(const run_summary *s); /* what those keys are of; NULL: not there */

/* A key's value of the struct it belongs to; the caller frees. */
cJSON *output_summary_value_json(const summary_key *k, const void *from);

#endif
