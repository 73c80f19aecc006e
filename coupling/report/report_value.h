/* SPDX-License-Identifier: BSD-3-Clause */
/* What a summary says. */
#ifndef BREECH_COUPLING_REPORT_VALUE_H
#define BREECH_COUPLING_REPORT_VALUE_H

#include <cJSON.h>

/* A number of the object, NaN where it is null or missing; a text, "" where missing. */
double report_number(const cJSON *object, const char *key);
const char *report_text(const cJSON *object, const char *key);
/* Element i of a vector, NaN where it is null or missing. */
double report_element(const cJSON *object, const char *key, int i);

#endif
