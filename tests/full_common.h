/* SPDX-License-Identifier: BSD-3-Clause */
/* Do the long parts of the tests run (./test.sh --full)? */
#ifndef BREECH_TESTS_FULL_COMMON_H
#define BREECH_TESTS_FULL_COMMON_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static inline bool full_tests(void)
{
    const char *full = getenv("BREECH_FULL");
    return full && strcmp(full, "1") == 0;
}

#endif
