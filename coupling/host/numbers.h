/* SPDX-License-Identifier: BSD-3-Clause */
/* Doubles of which NAN says that they are not given, and their order. */
#ifndef BREECH_COUPLING_HOST_NUMBERS_H
#define BREECH_COUPLING_HOST_NUMBERS_H

/* The value; `fallback`, in the same unit, where it is NAN. */
double host_number_or(double value, double fallback);

/* For qsort and bsearch of doubles without NAN, the smallest first. */
int host_number_order(const void *a, const void *b);

#endif
