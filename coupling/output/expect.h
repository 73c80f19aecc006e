/* SPDX-License-Identifier: BSD-3-Clause */
/* What a case is expected to give, compared with what a run of it gave: `breech check CASE --expect DIR`.
 *
 * The expectations stand beside the case file: expected.yaml for case.yaml, NAME_expected.yaml for NAME.yaml.  A list:
 *
 *   - {key: crater_depth, value: 0.55 mm, within: 5 %, source: measured 2017}
 *   - {key: probes.gauge.peak, value: 48.48 GPa, within: 0.5 GPa}
 *   - {key: energy_error, at_least: -1e-6, at_most: 1e-6}
 *   - {key: class, is: gouge}
 *
 * `key` is a path through summary.json: names by dots, entries of lists as scenes[0] or scenes[name].  Numbers have
 * units and are held in SI like those of the summary; `within` with a % is relative to the value, else it has its unit.
 * A number in a unit of another kind than the summary's is refused, and where the summary's is not known, numbers of
 * one entry in units of different kinds.
 */
#ifndef BREECH_COUPLING_OUTPUT_EXPECT_H
#define BREECH_COUPLING_OUTPUT_EXPECT_H

#include "base/status.h"
#include "coupling/host/units.h"
#include "coupling/output/summary.h"

#include <stdbool.h>

enum { EXPECT_TEXT_SIZE = 120 };

typedef struct {
    char key[EXPECT_TEXT_SIZE];
    char wanted[EXPECT_TEXT_SIZE], found[EXPECT_TEXT_SIZE]; /* for people, in SI; found "missing" where there is none */
    char source[EXPECT_TEXT_SIZE];                          /* "" if none is given */
    double deviation;                                       /* relative to the value; NAN where none is given [1] */
    bool holds;
} expectation;

typedef struct {
    int n, held;
    expectation *item; /* n, owned */
} expectations;

/* case_file: path of the case file itself; dir: of the run's output; tables_of: by the kind that the summary names,
 * what units its numbers have.  STATUS_BAD_INPUT with file, line and column where
 * the list is wrong or not there.  output_expect_free(out) even on error. */
status output_expect(const char *case_file, const char *dir, summary_tables (*tables_of)(const char *kind),
                     expectations *out);
void output_expect_free(expectations *e);

/* A number with a unit of any of a summary's kinds, in SI; *unit: that.  false: it is none. */
bool output_number_in_si(const units *u, const char *text, double *value, const char **unit);

#endif
