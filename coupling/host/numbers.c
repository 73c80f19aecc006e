/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/numbers.h"

#include <math.h>

double host_number_or(double value, double fallback)
{
    return isnan(value) ? fallback : value;
}

int host_number_order(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
