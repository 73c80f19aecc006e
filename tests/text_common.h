/* SPDX-License-Identifier: BSD-3-Clause */
/* How often a text stands in another. */
#ifndef BREECH_TESTS_TEXT_COMMON_H
#define BREECH_TESTS_TEXT_COMMON_H

#include <string.h>

static inline int text_count(const char *text, const char *what)
{
    int n = 0;
    for (; (text = strstr(text, what)); text++) n++;
    return n;
}

#endif
