/* SPDX-License-Identifier: BSD-3-Clause */
/* What the pages of an onset and of a comparison have in common.  Internal to the report. */
#ifndef BREECH_COUPLING_REPORT_ONSET_H
#define BREECH_COUPLING_REPORT_ONSET_H

#include "coupling/report/report_page.h"

/* The scenes of a surface (prefix NULL: all): growth, or severity, over velocity, with the intervals of `bounds`. */
void report_onset_threshold_chart(const page *p, const char *name, const char *caption, const cJSON *bounds,
                                  const char *prefix);
void report_onset_scene_tables(const page *p);

#endif
