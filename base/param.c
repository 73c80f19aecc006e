/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/param.h"

#include <stdbool.h>
#include <string.h>

size_t base_param_text_size(const base_param *p)
{
    return p->room > 0 ? (size_t)p->room : (size_t)BASE_PARAM_TEXT_SIZE;
}

static void set_default(const base_param *p, char *member)
{
    const double number = isinf(p->fallback) ? NAN : p->fallback;
    switch (p->kind) {
    case BASE_PARAM_NUMBER: *(double *)(void *)member = number; break;
    case BASE_PARAM_VECTOR:
        for (int k = 0; k < 3; k++) ((double *)(void *)member)[k] = number;
        break;
    case BASE_PARAM_POINTS:
        for (int k = 0; k < 2 * p->room; k++) ((double *)(void *)member)[k] = NAN;
        break;
    case BASE_PARAM_INTEGER:
    case BASE_PARAM_CHOICE: *(int *)(void *)member = (int)p->fallback; break;
    case BASE_PARAM_FLAG: *(bool *)(void *)member = p->fallback != 0; break;
    case BASE_PARAM_TEXT:
        strncpy(member, p->fallback_text ? p->fallback_text : "", base_param_text_size(p) - 1);
        member[base_param_text_size(p) - 1] = '\0';
        break;
    }
}

void base_params_default(const base_param *table, void *object)
{
    for (const base_param *p = table; p->key; p++) set_default(p, (char *)object + p->offset);
}

/* A NaN is "not given": allowed for OPTIONAL alone. */
static status check_number(const base_param *p, double value, const char *section)
{
    const bool plain = strcmp(p->unit, "1") == 0;
    const char *gap = plain ? "" : " ", *unit = plain ? "" : p->unit;
    if (isnan(value) && isnan(p->fallback)) return status_ok();
    CHECK(!isnan(value) || !isinf(p->fallback), STATUS_BAD_INPUT, "%s.%s is required [%s]: %s", section, p->key,
          p->unit, p->doc);
    CHECK(value >= p->min && value <= p->max, STATUS_BAD_INPUT, "%s.%s = %g%s%s: must be %g .. %g%s%s", section, p->key,
          value, gap, unit, p->min, p->max, gap, unit);
    return status_ok();
}

static status check_choice(const base_param *p, int value, const char *section)
{
    int n = 0;
    while (p->choices[n]) n++;
    CHECK(value >= 0 && value < n, STATUS_BAD_INPUT, "%s.%s = choice %d: must be one of the %d from %s to %s", section,
          p->key, value, n, p->choices[0], p->choices[n - 1]);
    return status_ok();
}

int base_param_pairs(const double *member, int room)
{
    int n = 0;
    while (n < room && !isnan(member[2 * n])) n++;
    return n;
}

static status check_pairs(const base_param *p, const double *member, const char *section)
{
    const int n = base_param_pairs(member, p->room);
    CHECK(n > 0, STATUS_BAD_INPUT, "%s.%s is required [%s]: %s", section, p->key, p->unit, p->doc);
    for (int k = 0; k < 2 * n; k++) TRY(check_number(p, member[k], section));
    return status_ok();
}

static status check_one(const base_param *p, const char *member, const char *section)
{
    switch (p->kind) {
    case BASE_PARAM_NUMBER: return check_number(p, *(const double *)(const void *)member, section);
    case BASE_PARAM_VECTOR:
        for (int k = 0; k < 3; k++) TRY(check_number(p, ((const double *)(const void *)member)[k], section));
        return status_ok();
    case BASE_PARAM_POINTS: return check_pairs(p, (const double *)(const void *)member, section);
    case BASE_PARAM_INTEGER: return check_number(p, *(const int *)(const void *)member, section);
    case BASE_PARAM_CHOICE: return check_choice(p, *(const int *)(const void *)member, section);
    case BASE_PARAM_FLAG: return status_ok();
    case BASE_PARAM_TEXT:
        CHECK(p->fallback_text || member[0], STATUS_BAD_INPUT, "%s.%s is required: %s", section, p->key, p->doc);
        return status_ok();
    }
    return status_ok();
}

status base_params_check(const base_param *table, const void *object, const char *section)
{
    for (const base_param *p = table; p->key; p++) TRY(check_one(p, (const char *)object + p->offset, section));
    return status_ok();
}
