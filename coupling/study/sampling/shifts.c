/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/sampling/shifts.h"

#include <math.h>

/* g^-1, g^-2, g^-3 with g^4 = g + 1: multiples of them, less their whole parts, lie evenly in the unit cube. */
static const double STEP[3] = { 0.8191725133961644, 0.671043606703789, 0.5497004779019701 };

void study_shift_of(int i, const double own[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        const double at = own[k] + i * STEP[k];
        out[k] = i == 0 ? own[k] : at - floor(at);
    }
}

shift_spread study_shift_spread(const double *value, int n)
{
    shift_spread s = { .mean = NAN, .deviation = NAN, .least = NAN, .largest = NAN };
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; i++) {
        if (!isfinite(value[i])) continue;
        s.scenes++;
        sum += value[i];
        s.least = fmin(s.least, value[i]), s.largest = fmax(s.largest, value[i]); /* NAN gives way */
    }
    if (s.scenes > 0) s.mean = sum / s.scenes;
    for (int i = 0; i < n; i++)
        if (isfinite(value[i])) squares += (value[i] - s.mean) * (value[i] - s.mean);
    if (s.scenes > 1) s.deviation = sqrt(squares / (s.scenes - 1));
    return s;
}
