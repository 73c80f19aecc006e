/* SPDX-License-Identifier: BSD-3-Clause */
/* The default shot's case, changed, for tests that need a whole one. */
#ifndef BREECH_TESTS_CASE_COMMON_H
#define BREECH_TESTS_CASE_COMMON_H

#include "coupling/case/case.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "status_common.h"

/* With the texts of --set, a NULL behind them; NULL: as it is.  The caller frees it. */
static inline breech_case *changed_case(const char *const *sets)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET | CASE_FOR_SCENE };
    breech_case *c = NULL;
    char *errors = NULL;
    int n = 0;
    while (sets && sets[n]) n++;
    const status s = case_read(BREECH_TESTS "/../cases/default_shot", sets, n, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    return c;
}

#endif
