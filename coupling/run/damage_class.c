/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/damage_class.h"

#include <stddef.h>

const char *const run_damage_names[] = { "none", "scratch", "gouge", "undecided", NULL };
