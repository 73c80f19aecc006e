/* SPDX-License-Identifier: BSD-3-Clause */
/* Which parts of the tests run: ./test.sh --full has them all. */
#ifndef BREECH_TESTS_FULL_COMMON_H
#define BREECH_TESTS_FULL_COMMON_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SANITIZE_ADDRESS__)
enum { BUILT_WITH_SANITIZERS = 1 };
#elif defined(__has_feature)
enum { BUILT_WITH_SANITIZERS = __has_feature(address_sanitizer) };
#else
enum { BUILT_WITH_SANITIZERS = 0 };
#endif

static inline bool is_asked_for(const char *variable)
{
    const char *value = getenv(variable);
    return value && strcmp(value, "1") == 0;
}

/* The long parts: once, by the first build. */
static inline bool full_tests(void)
{
    return is_asked_for("BREECH_FULL");
}

/* What takes ten seconds and more with sanitizers, though its code is in shorter tests too.  A build with them leaves
 * it out; with BREECH_HEAVY=1 it does not. */
static inline bool heavy_tests(void)
{
    return !BUILT_WITH_SANITIZERS || is_asked_for("BREECH_HEAVY");
}

#endif
