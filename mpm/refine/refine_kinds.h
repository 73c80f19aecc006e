/* SPDX-License-Identifier: BSD-3-Clause */
/* For writing rules of refinement (refine.h has the rules). */
#ifndef BREECH_MPM_REFINE_KINDS_H
#define BREECH_MPM_REFINE_KINDS_H

#include "mpm/memory/store.h"
#include "mpm/refine/refine.h"

#include <math.h>

#define REFINE(name) extern const mpm_refine_kind mpm_refine_##name;
#include "mpm/refine/refine.def"
#undef REFINE

/* The values of a rule as the struct that its table is made of, which has no members but doubles. */
#define REFINE_VALUES(type, r) ((const type *)(const void *)(r)->value)

#endif
