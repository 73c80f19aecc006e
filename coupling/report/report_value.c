/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_value.h"

#include <math.h>

double report_number(const cJSON *object, const char *key)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, key);
    return cJSON_IsNumber(value) ? value->valuedouble : NAN;
}

double report_element(const cJSON *object, const char *key, int i)
{
    const cJSON *value = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(object, key), i);
    return cJSON_IsNumber(value) ? value->valuedouble : NAN;
}

const char *report_text(const cJSON *object, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, key));
    return text ? text : "";
}
