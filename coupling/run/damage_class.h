/* SPDX-License-Identifier: BSD-3-Clause */
/* What an impact has done to the rail: what its crater is, or its groove while it forms (gouge/crater.h says when). */
#ifndef BREECH_COUPLING_DAMAGE_CLASS_H
#define BREECH_COUPLING_DAMAGE_CLASS_H

typedef enum { DAMAGE_NONE, DAMAGE_SCRATCH, DAMAGE_GOUGE, DAMAGE_UNDECIDED } damage_class;
extern const char *const run_damage_names[]; /* "none", "scratch", "gouge", "undecided", NULL */

#endif
