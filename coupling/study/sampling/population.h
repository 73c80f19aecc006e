/* SPDX-License-Identifier: BSD-3-Clause */
/* Sizes of a population of grains (case.h), log-normal or tabulated. */
#ifndef BREECH_COUPLING_POPULATION_H
#define BREECH_COUPLING_POPULATION_H

#include "base/status.h"
#include "coupling/case/case_sections.h"

/* Share of the grains with at least this radius [1]. */
double study_population_share_from(const case_population *p, double radius);

/* The radius that a share of the grains stays below, 0 < share < 1 [m]. */
double study_population_quantile(const case_population *p, double share);

enum { POPULATION_MAX_SIZES = 24 }; /* at which one population's threshold is searched for */

/* The sizes of a population, rising, and the number of grains that each stands for. */
typedef struct {
    int n;
    double size[POPULATION_MAX_SIZES];   /* [m] */
    double number[POPULATION_MAX_SIZES]; /* [1] */
} population_sizes;

/* Sizes at which the threshold of this population is wanted.  Log-normal: the series 1, 1.26, 1.58, 2, ... (ten a
 * decade, so that populations share scenes) over the middle 96 % above `smallest`, the classes' borders half way in
 * ln r, the last ones open; the last class that there is room for is open too.  Tabulated: its own above `smallest`;
 * more than POPULATION_MAX_SIZES are refused. */
status study_population_sizes(const case_population *p, double smallest, population_sizes *out);

#endif
