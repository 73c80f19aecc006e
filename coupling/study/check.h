/* SPDX-License-Identifier: BSD-3-Clause */
/* `breech check`: what each scene the case leads to would take (check.c), and how that is told (check_print.c). */
#ifndef BREECH_COUPLING_STUDY_CHECK_H
#define BREECH_COUPLING_STUDY_CHECK_H

#include "coupling/case/case_plain.h"
#include "mpm/mpm.h"

typedef struct {
    char what[80];
    mpm_needs needs;
    double steps;   /* of the finest level [1] */
    double seconds; /* with the points and steps of the start [s] */
    double likely;  /* [s]; NAN: no scene of the case is small enough to be tried */
    bool searched;  /* one of the two ends of the search's range, with its fine cells */
} scene_estimate;
enum { CHECK_MAX_ESTIMATES = 40 };
#define CHECK_SECONDS_A_STEP 200e-9 /* one thread, where no scene is tried */
#define CHECK_GROWTH 1.8 /* time of a whole scene over that at the pace of its first steps: docs/notes/speed.md */
#define CHECK_SECONDS_A_GRAIN 150e-9 /* of the random shots: 12 million grains in 1.85 s */

/* What the runs would have of the machine. */
typedef struct {
    int threads;    /* of each process */
    int processes;  /* that are asked for */
    int fit;        /* so many of the largest scenes are held in memory side by side; 0: the case has none */
    size_t largest; /* memory of that scene [bytes] */
} check_machine;

/* The commands whose sections the case has: a sum of CASE_FOR_. */
unsigned study_check_needs(const case_inputs *in);

/* All that is to be said of a case that reads well for these needs. */
status study_check_print(const case_inputs *in, const check_machine *on, unsigned needs, FILE *out);

/* The scene of the case as a case of bodies, with every value resolved.  STATUS_BAD_INPUT: it has none. */
status study_print_scene(const case_inputs *in, FILE *out);

/* The scene of the case; then of its first site, or of the median grain of its first population, both ends of the
 * search's range, and with each treatment its slow end, as many of these as there is room for; *n of them.  The first
 * that is small runs for some tenths of a second: *rate is what it took a point and step [s], NAN: none is small. */
status study_check(const case_inputs *in, int threads, scene_estimate out[CHECK_MAX_ESTIMATES], int *n, double *rate);

/* What the times of study_check assume; rate: as it found. */
void study_check_assumptions(const case_inputs *in, int threads, double rate, FILE *out);

/* Seconds that so many scenes of the search take, from the mean of its ends; NAN: not known. */
double study_check_search_time(const scene_estimate *e, int n, int scenes);

/* A warning where study.max_scenes leaves a search fewer scenes than a bracket has ends. */
void study_check_searches(const case_inputs *in, FILE *out);

/* A line for each layer that is thinner than the cells of the searches: a film, and what it takes to resolve it. */
void study_check_thin_layers(const case_inputs *in, FILE *out);

#endif
