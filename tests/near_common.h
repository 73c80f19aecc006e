/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers compared in double precision, which cmocka's own comparison is not; what fails is said with both values.
 * After cmocka.h. */
#ifndef BREECH_TESTS_NEAR_COMMON_H
#define BREECH_TESTS_NEAR_COMMON_H

#include <math.h>

/* |value - want| <= tolerance, in their unit. */
#define assert_near(value, want, tolerance)                                                    \
    do {                                                                                       \
        const double value_ = (value), want_ = (want), tolerance_ = (tolerance);               \
        if (!(fabs(value_ - want_) <= tolerance_))                                             \
            fail_msg("%s = %.12g, want %.12g within %.3g", #value, value_, want_, tolerance_); \
    } while (0)

/* |value / want - 1| <= fraction; of want = 0 nothing but 0. */
#define assert_close(value, want, fraction)                                                                 \
    do {                                                                                                    \
        const double value_ = (value), want_ = (want), fraction_ = (fraction);                              \
        if (!(fabs(value_ - want_) <= fraction_ * fabs(want_)))                                             \
            fail_msg("%s = %.12g, want %.12g within a fraction of %.3g", #value, value_, want_, fraction_); \
    } while (0)

#define assert_below(value, limit)                                                                 \
    do {                                                                                           \
        const double value_ = (value), limit_ = (limit);                                           \
        if (!(value_ < limit_)) fail_msg("%s = %.6g, must be below %.6g", #value, value_, limit_); \
    } while (0)

#endif
