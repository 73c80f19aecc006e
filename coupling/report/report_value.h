/* SPDX-License-Identifier: BSD-3-Clause */
/* What a summary says, and how a number of it is written: with the digits that are known, no more.
 *
 * A number with an interval is rounded as the nearer end's distance h is, or half the interval where it lies at an end:
 * to two digits of h where they are 10 to 35, else to one, so that 953.7 between 788.9 and 1156.0 is "950 (790 to
 * 1160)".  One without is given three digits; whole numbers
 * stay whole. */
#ifndef BREECH_COUPLING_REPORT_VALUE_H
#define BREECH_COUPLING_REPORT_VALUE_H

#include <cJSON.h>

/* A number of the object, NaN where it is null or missing; a text, "" where missing. */
double report_number(const cJSON *object, const char *key);
const char *report_text(const cJSON *object, const char *key);
/* Element i of a vector, NaN where it is null or missing. */
double report_element(const cJSON *object, const char *key, int i);

/* HTML, without a unit; a dash where there is no number. */
enum { REPORT_VALUE_SIZE = 96 };
void report_value_plain(double x, char out[REPORT_VALUE_SIZE]);
/* The value alone, rounded as its interval lo .. hi asks. */
void report_value_known(double x, double lo, double hi, char out[REPORT_VALUE_SIZE]);
/* With its interval: "950 (790 to 1160)"; where there is no value "above 1440", "below 500" or "790 to 1160". */
void report_value_interval(double x, double lo, double hi, char out[REPORT_VALUE_SIZE]);

#endif
