/* SPDX-License-Identifier: BSD-3-Clause */
/* A call that must succeed: else the test fails with the call and what its status says.  After cmocka.h. */
#ifndef BREECH_TESTS_STATUS_COMMON_H
#define BREECH_TESTS_STATUS_COMMON_H

#include "base/status.h"

#define OK(call)                                                        \
    do {                                                                \
        const status ok_ = (call);                                      \
        if (ok_.code != STATUS_OK) fail_msg("%s: %s", #call, ok_.text); \
    } while (0)

#endif
