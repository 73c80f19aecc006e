/* SPDX-License-Identifier: BSD-3-Clause */
/* Random numbers that are the same on every machine (Knuth's linear congruence, its upper 53 bits). */
#ifndef BREECH_TESTS_RANDOM_COMMON_H
#define BREECH_TESTS_RANDOM_COMMON_H

#include <math.h>
#include <stdint.h>

/* lo .. hi, hi left out; the seed moves on. */
static inline double random_between(uint64_t *seed, double lo, double hi)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(*seed >> 11) * 0x1p-53;
}

/* The same, evenly in the logarithm. */
static inline double random_log_between(uint64_t *seed, double lo, double hi)
{
    return lo * pow(hi / lo, random_between(seed, 0.0, 1.0));
}

#endif
