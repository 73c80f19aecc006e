/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_value.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

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

/* ---- digits ---- */

enum { USUAL_DIGITS = 3 };

static int power_of(double x)
{
    return (int)floor(log10(fabs(x)) + 1e-12);
}

/* To the power of ten of its last digit; zeros at its end stay where `keep`. */
static void write_rounded(double x, int last, bool keep, char *out)
{
    const double unit = pow(10.0, last), rounded = round(x / unit) * unit;
    const int decimals = last < 0 ? -last : 0;
    int n = snprintf(out, REPORT_VALUE_SIZE, "%.*f", decimals, rounded == 0.0 ? 0.0 : rounded);
    if (keep || decimals == 0 || n >= REPORT_VALUE_SIZE) return;
    while (out[n - 1] == '0') out[--n] = '\0';
    if (out[n - 1] == '.') out[--n] = '\0';
}

void report_value_plain(double x, char out[REPORT_VALUE_SIZE])
{
    if (!isfinite(x)) {
        snprintf(out, REPORT_VALUE_SIZE, "&ndash;");
    } else if (x == 0.0 || (x == round(x) && fabs(x) < 1e5)) {
        snprintf(out, REPORT_VALUE_SIZE, "%.0f", x + 0.0);
    } else if (fabs(x) >= 1e6 || fabs(x) < 1e-3) {
        int power = power_of(x);
        char first[REPORT_VALUE_SIZE];
        double front = x / pow(10.0, power);
        if (fabs(front) >= 9.995) front /= 10.0, power++;
        write_rounded(front, 1 - USUAL_DIGITS, false, first);
        snprintf(out, REPORT_VALUE_SIZE, "%.40s&times;10<sup>%d</sup>", first, power);
    } else {
        write_rounded(x, power_of(x) + 1 - USUAL_DIGITS, false, out);
    }
}

/* The power of ten of the last digit that an interval which reaches so far lets a value keep. */
static int last_digit(double reach)
{
    const int power = power_of(reach);
    return reach / pow(10.0, power) < 3.55 ? power - 1 : power;
}

/* How far the interval of x reaches. */
static double reach_of(double x, double lo, double hi)
{
    return lo < x && x < hi ? fmin(x - lo, hi - x) : 0.5 * (hi - lo);
}

static void write_known(double x, double reach, char out[REPORT_VALUE_SIZE])
{
    if (isfinite(x) && reach > 0.0 && reach > 1e-9 * fabs(x))
        write_rounded(x, last_digit(reach), true, out);
    else
        report_value_plain(x, out);
}

void report_value_known(double x, double lo, double hi, char out[REPORT_VALUE_SIZE])
{
    write_known(x, reach_of(x, lo, hi), out);
}

void report_value_interval(double x, double lo, double hi, char out[REPORT_VALUE_SIZE])
{
    char value[REPORT_VALUE_SIZE], from[REPORT_VALUE_SIZE], to[REPORT_VALUE_SIZE];
    const double reach = reach_of(x, lo, hi);
    write_known(x, reach, value);
    write_known(lo, reach, from);
    write_known(hi, reach, to);
    if (!isfinite(x) && isfinite(lo) && !isfinite(hi))
        snprintf(out, REPORT_VALUE_SIZE, "above %.80s", from);
    else if (!isfinite(x) && !isfinite(lo) && isfinite(hi))
        snprintf(out, REPORT_VALUE_SIZE, "below %.80s", to);
    else if (!isfinite(x) && isfinite(lo))
        snprintf(out, REPORT_VALUE_SIZE, "%.40s to %.40s", from, to);
    else if (isfinite(lo) && isfinite(hi) && hi > lo)
        snprintf(out, REPORT_VALUE_SIZE, "%.26s (%.26s to %.26s)", value, from, to);
    else if (isfinite(lo) && !isfinite(hi))
        snprintf(out, REPORT_VALUE_SIZE, "%.30s (from %.40s)", value, from);
    else if (isfinite(hi) && !isfinite(lo))
        snprintf(out, REPORT_VALUE_SIZE, "%.30s (up to %.40s)", value, to);
    else
        snprintf(out, REPORT_VALUE_SIZE, "%s", value);
}
