/* SPDX-License-Identifier: BSD-3-Clause */
/* Sizes of a population of grains (case.h), log-normal or tabulated. */
#ifndef BREECH_COUPLING_POPULATION_H
#define BREECH_COUPLING_POPULATION_H

#include "coupling/case/case_sections.h"

/* Share of the grains with at least this radius [1]. */
double study_population_share_from(const case_population *p, double radius);

/* The radius that a share of the grains stays below, 0 < share < 1 [m]. */
double study_population_quantile(const case_population *p, double share);

/* Sizes at which the threshold of this population is wanted, rising, at most `room`, and the number of grains each
 * stands for.  Log-normal: the series 1, 1.26, 1.58, 2, ... (ten a decade, so that populations share scenes) over the
 * middle 96 % above `smallest`, the classes' borders half way in ln r, the last ones open.  Tabulated: its own.
 * Returns how many. */
int study_population_sizes(const case_population *p, double smallest, int room, double *size, double *number);

#endif
