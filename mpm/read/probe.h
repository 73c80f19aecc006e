/* SPDX-License-Identifier: BSD-3-Clause */
/* Probes: quantities of a scene that a user asks for (mpm_scene.probe), read between steps by the caller of the solver.
 *
 * A probe has a kind, which says what is read, and values, which say where.  Reading changes nothing in the solver and
 * gives the same bits on any number of threads.
 * To add a kind: write mpm/read/probe_<name>.c with `const mpm_probe_kind mpm_probe_<name>`, and one line in probe.def.
 * Case files, series and tests take it from there.  Every kind satisfies
 *   out holds rows x columns numbers, row by row, in the columns' units; NAN where there is nothing to read;
 *   a mean is by mass or volume over points as they are now; a force is the mean of the last step.
 * tests/test_mpm_probe.c checks every kind of the table against a closed answer. */
#ifndef BREECH_MPM_PROBE_H
#define BREECH_MPM_PROBE_H

#include "base/param.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct mpm; /* mpm.h */

enum { MPM_PROBE_VALUES = 16 };

typedef struct {
    const char *name, *unit, *doc;
} mpm_column;

typedef struct mpm_probe mpm_probe;

typedef struct {
    const char *name, *doc;
    const base_param *params;  /* of the values, offsets from mpm_probe.value; m, m/s, rad or 1 */
    const mpm_column *columns; /* of every row; NULL name at the end */
    int main, mains;           /* which columns stand for it: one, or 3 of a vector's size; mains 0: none, a map */
    bool of_step;              /* about the last step alone: a series wants every step */
    bool of_body;              /* reads one body, which must be given; else all bodies where none is */
    int (*rows)(const mpm_probe *p);                            /* NULL: one */
    base_status (*check)(const mpm_probe *p, const char *name); /* checks beyond the table's ranges; NULL: none */
    base_status (*read)(const struct mpm *m, const mpm_probe *p, double *out); /* BASE_STATUS_MEMORY alone */
} mpm_probe_kind;

struct mpm_probe {
    char name[BASE_PARAM_TEXT_SIZE];
    const mpm_probe_kind *kind;
    int body; /* index; -1: all */
    double value[MPM_PROBE_VALUES];
};

/* Kind by name, NULL if there is none.  mpm_probe_kind_at(i) walks the table, NULL at its end. */
const mpm_probe_kind *mpm_probe_kind_find(const char *name);
const mpm_probe_kind *mpm_probe_kind_at(int i);

/* A probe with its values at their defaults, of no body.  A value by its name, NULL: this kind has none of it. */
mpm_probe mpm_probe_make(const mpm_probe_kind *kind, const char *name);
double *mpm_probe_value(mpm_probe *p, const char *name);

/* BASE_STATUS_BAD_INPUT names the probe, the value and what it must be, unless a scene of so many bodies can be
 * read. */
base_status mpm_probe_check(const mpm_probe *p, int bodies);

int mpm_probe_rows(const mpm_probe *p);
int mpm_probe_columns(const mpm_probe *p);

/* One of the scene's, or any other that mpm_probe_check has passed.  out: rows x columns, owned by the caller. */
base_status mpm_probe_read(const struct mpm *m, const mpm_probe *p, double *out);

#ifdef __cplusplus
}
#endif

#endif
