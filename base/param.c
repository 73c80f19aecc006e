/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/param.h"

#include <stdbool.h>
#include <string.h>

static void set_default(const param *p, char *member)
{
    const double number = isinf(p->fallback) ? NAN : p->fallback;
    switch (p->kind) {
    case PARAM_NUMBER: *(double *)(void *)member = number; break;
    case PARAM_VECTOR:
        for (int k = 0; k < 3; k++) ((double *)(void *)member)[k] = number;
        break;
    case PARAM_POINTS:
        for (int k = 0; k < 2 * p->room; k++) ((double *)(void *)member)[k] = NAN;
        break;
    case PARAM_INTEGER:
    case PARAM_CHOICE: *(int *)(void *)member = (int)p->fallback; break;
    case PARAM_FLAG: *(bool *)(void *)member = p->fallback != 0; break;
    case PARAM_TEXT:
        strncpy(member, p->fallback_text ? p->fallback_text : "", PARAM_TEXT_SIZE - 1);
        member[PARAM_TEXT_SIZE - 1] = '\0';
        break;
    }
}

void base_params_default(const param *table, void *object)
{
    for (const param *p = table; p->key; p++) set_default(p, (char *)object + p->offset);
}

/* A NaN is "not given": allowed for OPTIONAL alone. */
static status check_number(const param *p, double value, const char *section)
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

static status check_choice(const param *p, int value, const char *section)
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

static status check_pairs(const param *p, const double *member, const char *section)
{
    const int n = base_param_pairs(member, p->room);
    CHECK(n > 0, STATUS_BAD_INPUT, "%s.%s is required [%s]: %s", section, p->key, p->unit, p->doc);
    for (int k = 0; k < 2 * n; k++) TRY(check_number(p, member[k], section));
    return status_ok();
}

static status check_one(const param *p, const char *member, const char *section)
{
    switch (p->kind) {
    case PARAM_NUMBER: return check_number(p, *(const double *)(const void *)member, section);
    case PARAM_VECTOR:
        for (int k = 0; k < 3; k++) TRY(check_number(p, ((const double *)(const void *)member)[k], section));
        return status_ok();
    case PARAM_POINTS: return check_pairs(p, (const double *)(const void *)member, section);
    case PARAM_INTEGER: return check_number(p, *(const int *)(const void *)member, section);
    case PARAM_CHOICE: return check_choice(p, *(const int *)(const void *)member, section);
    case PARAM_FLAG: return status_ok();
    case PARAM_TEXT:
        CHECK(p->fallback_text || member[0], STATUS_BAD_INPUT, "%s.%s is required: %s", section, p->key, p->doc);
        return status_ok();
    }
    return status_ok();
}

status base_params_check(const param *table, const void *object, const char *section)
{
    for (const param *p = table; p->key; p++) TRY(check_one(p, (const char *)object + p->offset, section));
    return status_ok();
}
