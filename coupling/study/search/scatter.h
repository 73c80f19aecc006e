/* SPDX-License-Identifier: BSD-3-Clause */
/* What thresholds owe to where the cells happen to lie (study.threshold_ensemble, judged by growth).
 *
 * Of each family the search's scene nearest to its threshold is computed on further grids, each shifted by another part
 * of a cell (sampling/shifts.h).  Each grid's threshold is placed by its own scenes where it has them on both sides,
 * else by the slope of the search's scenes over velocity; their mean is the threshold, their standard deviation is its
 * scatter [m/s].
 * Where the search saw one side alone, all of its scenes are computed on the further grids: its interval reaches as far
 * as they agree. */
#ifndef BREECH_COUPLING_SCATTER_H
#define BREECH_COUPLING_SCATTER_H

#include "coupling/study/search/family.h"

/* After the search of `grains`; into grain_family.scatter of those that have a threshold: what they move is
 * study_uncertain_run's to do.  Of those that have none, it moves the known end of the interval. */
status study_scatter_run(session *s, grain_families *grains);

#endif
