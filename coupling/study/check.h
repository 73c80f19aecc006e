/* SPDX-License-Identifier: BSD-3-Clause */
/* `breech check`: what each scene the case leads to would take. */
#ifndef BREECH_COUPLING_STUDY_CHECK_H
#define BREECH_COUPLING_STUDY_CHECK_H

#include "coupling/case/case_plain.h"
#include "mpm/mpm.h"

typedef struct {
    char what[80];
    mpm_needs needs;
    double steps;   /* of the finest level */
    double seconds; /* at CHECK_SECONDS_A_STEP on this machine's threads, with the points of the start */
} scene_estimate;
enum { CHECK_MAX_ESTIMATES = 40 };
#define CHECK_SECONDS_A_STEP 200e-9  /* one thread */
#define CHECK_SECONDS_A_GRAIN 150e-9 /* of the random shots: 12 million grains in 1.85 s */

/* The scene of the case as a case of bodies, with every value resolved.  STATUS_BAD_INPUT: it has none. */
status study_print_scene(const case_inputs *in, FILE *out);

/* Kinds of grains among sites and populations: at most so many searches. */
int study_grain_kinds(const case_onset *c);

/* The scene of the case; then of its first site, or of the median grain of its first population, the slowest and finest
 * of the search, and with each treatment as many of these as there is room for; *n of them. */
status study_check(const case_inputs *in, int threads, scene_estimate out[CHECK_MAX_ESTIMATES], int *n);

/* What the times of study_check assume, so that a run takes longer. */
void study_check_assumptions(const case_inputs *in, int threads, FILE *out);

/* A warning where study.max_scenes leaves a search fewer scenes than a bracket has ends. */
void study_check_searches(const case_inputs *in, FILE *out);

/* A line for each layer that is thinner than the cells of the searches: a film, and what it takes to resolve it. */
void study_check_films(const case_inputs *in, FILE *out);

#endif
