/* SPDX-License-Identifier: BSD-3-Clause */
/* For writing kinds of probes (probe.h has the rules). */
#ifndef BREECH_MPM_PROBE_KINDS_H
#define BREECH_MPM_PROBE_KINDS_H

#include "mpm/read/probe.h"
#include "mpm/read/visit.h"

#include <math.h>

#define PROBE(name) extern const mpm_probe_kind mpm_probe_##name;
#include "mpm/read/probe.def"
#undef PROBE

/* Rows of a parameter table: a point, a length [m]. */
#define PROBE_FARTHEST 1e3
#define PROBE_POINT(type, member, doc) PARAM_VEC3(type, member, "m", REQUIRED, -PROBE_FARTHEST, PROBE_FARTHEST, doc)

/* The values of a probe as the struct that its table is made of, which has no members but doubles. */
#define PROBE_VALUES(type, p) ((const type *)(const void *)(p)->value)

/* Means by volume over what points of a body (-1: all) have in a box: pressure, normal stresses; then that volume, and
 * its density. */
enum { PROBE_BOX_MEANS = 4, PROBE_BOX_VOLUME = PROBE_BOX_MEANS, PROBE_BOX_COLUMNS = PROBE_BOX_VOLUME + 2 };
extern const mpm_column mpm_probe_box_columns[PROBE_BOX_COLUMNS + 1];
void mpm_probe_box_mean(const mpm *m, int body, const double lo[3], const double hi[3], double out[PROBE_BOX_COLUMNS]);

/* STATUS_BAD_INPUT unless one number is 1 or -1 and the others are 0. */
status mpm_probe_check_axis(const double along[3], const char *name);

#endif
