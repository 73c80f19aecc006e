/* SPDX-License-Identifier: BSD-3-Clause */
/* What thresholds owe to where the cells happen to lie (study.threshold_ensemble, judged by growth).
 *
 * Of each family the search's scene nearest to its threshold is computed on further grids, each shifted by another part
 * of a cell (sampling/shifts.h).  Each grid's threshold is placed by its own scenes where it has them on both sides,
 * else by the slope of the search's scenes over velocity; their mean is the threshold, their standard deviation is its
 * scatter [m/s]. */
#ifndef BREECH_COUPLING_SCATTER_H
#define BREECH_COUPLING_SCATTER_H

#include "coupling/study/search/family.h"

/* After the search of `grains`; into grain_family.scatter of those that have a threshold.  What they move is
 * study_uncertain_run's to do. */
status study_scatter_run(session *s, grain_families *grains);

#endif
