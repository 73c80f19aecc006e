/* SPDX-License-Identifier: BSD-3-Clause */
/* What the pages of an onset and of a comparison have in common.  Internal to the report. */
#ifndef BREECH_COUPLING_REPORT_ONSET_H
#define BREECH_COUPLING_REPORT_ONSET_H

#include "coupling/report/report_page.h"

/* Numbers of a list's objects as points; prefix: of their names, NULL: all. */
typedef struct {
    const char *outcome, *x, *y, *prefix;
    double x_unit, y_unit;
} report_onset_points;

/* One series a kind of outcome, in its colour. */
void report_onset_dots(report_chart *c, const cJSON *list, const report_onset_points *of);
/* Does a scene's name begin with the prefix of a surface ("t3-"); "": of no treated one? */
bool report_onset_has_prefix(const char *name, const char *prefix);
/* The scenes of a surface (prefix NULL: all): growth, or severity, over velocity, with the intervals of `bounds`. */
void report_onset_threshold_chart(const page *p, const char *name, const char *caption, const cJSON *bounds,
                                  const char *prefix);
void report_onset_scene_tables(const page *p);

#endif
