/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/units.h"

#include "coupling/host/hash.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

enum { NUMBER_SIZE = 64, REMEMBERED = 1024 };

/* From one unit to another, as it was found out. */
typedef struct {
    char from[UNIT_SIZE], to[UNIT_SIZE]; /* "": the place is free */
    bool known;                          /* `from` is a unit */
    int angle;                           /* power of the radian in `from` over that in `to` */
    cv_converter *converter;             /* NULL: they are of different kinds; owned */
} conversion;

struct units {
    ut_system *system;
    int users;
    conversion *remembered; /* [REMEMBERED] by a hash of both names, a later one in the place of an older; owned */
};

/* All who have it open at a time share it. */
static units *shared;

static void conversion_forget(conversion *c)
{
    if (c->converter) cv_free(c->converter);
    *c = (conversion){ .converter = NULL };
}

status host_units_open(units **out)
{
    *out = shared;
    if (shared) {
        shared->users++;
        return status_ok();
    }
    ut_set_error_message_handler(ut_ignore);
    units *u = calloc(1, sizeof *u);
    conversion *remembered = calloc(REMEMBERED, sizeof *remembered);
    ut_system *system = u && remembered ? ut_read_xml(NULL) : NULL;
    if (!system) {
        const bool memory = u && remembered;
        free(u);
        free(remembered);
        CHECK(memory, STATUS_MEMORY, "out of memory for the unit system");
        return base_status_error(STATUS_IO, "udunits2 cannot read its unit database (udunits2.xml): is the package "
                                            "libudunits2-data installed, or UDUNITS2_XML_PATH set to another file?");
    }
    *u = (units){ .system = system, .users = 1, .remembered = remembered };
    shared = *out = u;
    return status_ok();
}

void host_units_close(units *u)
{
    if (!u || --u->users > 0) return;
    for (int i = 0; i < REMEMBERED; i++) conversion_forget(&u->remembered[i]);
    ut_free_system(u->system);
    free(u->remembered);
    free(u);
    shared = NULL;
}

static bool same(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

/* Length of the decimal number at the start of `text`, 0 if there is none.  No hexadecimal, no "nan". */
static size_t number_length(const char *text)
{
    size_t i = 0, digits = 0;
    if (text[i] == '+' || text[i] == '-') i++;
    if (strncmp(text + i, ".inf", 4) == 0 || strncmp(text + i, "inf", 3) == 0) return i + (text[i] == '.' ? 4 : 3);
    for (; isdigit((unsigned char)text[i]); i++) digits++;
    if (text[i] == '.') i++;
    for (; isdigit((unsigned char)text[i]); i++) digits++;
    if (digits == 0) return 0;
    if (text[i] != 'e' && text[i] != 'E') return i;
    size_t j = i + 1;
    if (text[j] == '+' || text[j] == '-') j++;
    if (!isdigit((unsigned char)text[j])) return i;
    while (isdigit((unsigned char)text[j])) j++;
    return j;
}

static double number_value(const char *text, size_t length)
{
    const bool minus = text[0] == '-';
    if (strstr(text, "inf") && text[length - 1] == 'f') return minus ? -INFINITY : INFINITY;
    char copy[NUMBER_SIZE];
    memcpy(copy, text, length);
    copy[length] = '\0';
    return strtod(copy, NULL);
}

/* Words udunits2 would take for a shift of the origin, a logarithm or a sign. */
static bool has_forbidden_word(const char *unit)
{
    static const char *const words[] = { "since", "after", "from", "ref", "re", "lg", "ln", "lb", "log", "per", NULL };
    for (const char *s = unit; *s;) {
        const size_t length = strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
        for (int k = 0; words[k]; k++)
            if (length == strlen(words[k]) && strncmp(s, words[k], length) == 0) return true;
        s += length > 0 ? length : 1;
    }
    return false;
}

/* ---- what a unit may look like ----
 *
 *   unit    = [1/] product               "1/s", "kg m^-3", "W/(m K)"
 *   product = factor { [* . / or nothing] factor }
 *   factor  = name [power] | ( product ) [power]
 *   power   = [^ or **] [sign] one or two digits, or a superscript 2 or 3
 *
 * udunits2 knows more, and loses memory on some of what it does not know: so it only sees what has this form.
 * Each function returns where its part ends, NULL where it is none. */

enum { UNIT_MAX_DEPTH = 3 };

static const char *skip_any(const char *s, const char *const *words)
{
    for (int k = 0; words[k]; k++)
        if (strncmp(s, words[k], strlen(words[k])) == 0) return s + strlen(words[k]);
    return s;
}

static const char *skip_name(const char *s)
{
    static const char *const letters[] = {
        "\xc2\xb5", "\xce\xbc", "\xc2\xb0", "\xce\xa9", "\xe2\x84\xa6", NULL
    }; /* micro, micro, degree, ohm, ohm */
    const char *start = s;
    for (;;) {
        const char *next = skip_any(s, letters);
        if (next == s && (isalpha((unsigned char)*s) || *s == '_' || *s == '%')) next++;
        if (next == s) return s > start ? s : NULL;
        s = next;
    }
}

static const char *skip_power(const char *s)
{
    static const char *const superscripts[] = { "\xc2\xb2", "\xc2\xb3", NULL }, *const marks[] = { "^", "**", NULL };
    const char *end = skip_any(s, superscripts);
    if (end != s) return end;
    end = skip_any(s, marks);
    if (*end == '-' || *end == '+') end++;
    const size_t digits = strspn(end, "0123456789");
    if (digits == 0) return end == s ? s : NULL; /* no power; a mark or a sign without a number */
    return digits <= 2 ? end + digits : NULL;
}

static const char *skip_blanks(const char *s)
{
    return s + strspn(s, " \t");
}

static const char *skip_product(const char *s, int depth);

static const char *skip_factor(const char *s, int depth)
{
    const char *end = NULL;
    if (*s == '(') {
        end = skip_product(s + 1, depth + 1);
        if (!end || *end != ')') return NULL;
        end++;
    } else {
        end = skip_name(s);
    }
    return end ? skip_power(end) : NULL;
}

/* Ends at the text's end or at a closing bracket. */
static const char *skip_product(const char *s, int depth)
{
    static const char *const signs[] = { "*", "/", ".", "\xc2\xb7", NULL };
    if (depth > UNIT_MAX_DEPTH) return NULL;
    s = skip_factor(skip_blanks(s), depth);
    while (s) {
        const char *next = skip_blanks(s);
        if (*next == '\0' || *next == ')') return next;
        const char *after = skip_any(next, signs);
        if (after == s) return NULL; /* neither a blank nor a sign between two factors */
        s = skip_factor(skip_blanks(after), depth);
    }
    return NULL;
}

static bool is_plausible(const char *unit)
{
    if (same(unit, "1")) return true;
    const char *end = skip_product(strncmp(unit, "1/", 2) == 0 ? unit + 2 : unit, 0);
    return end && *end == '\0' && !has_forbidden_word(unit);
}

static ut_unit *unit_parse(const units *u, const char *unit)
{
    if (same(unit, "deg")) unit = "degree";
    if (!is_plausible(unit)) return NULL;
    ut_unit *parsed = ut_parse(u->system, unit, UT_UTF8);
    ut_set_status(UT_SUCCESS);
    return parsed;
}

/* Radians and pure numbers are the same to udunits2, not to us. */
static bool is_angle(const char *unit)
{
    static const char *const names[] = { "deg",  "degree",   "degrees",   "rad",       "radian", "radians",
                                         "mrad", "\xc2\xb0", "arcminute", "arcsecond", NULL };
    for (int k = 0; names[k]; k++)
        if (same(unit, names[k])) return true;
    return false;
}

static bool is_pure(const char *unit)
{
    return same(unit, "") || same(unit, "1") || same(unit, "%") || same(unit, "percent") || same(unit, "ppm");
}

/* Fifteen digits: "18 mm" and "0.018 m" are then the same bits, whatever the conversion's last one. */
static double tidy(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.15g", value);
    return strtod(text, NULL);
}

/* udunits also turns a unit into its inverse, 5 kHz into 0.2 ms: that is no unit of a time. */
static bool is_inverse(cv_converter *converter)
{
    return !isfinite(cv_convert_double(converter, 0.0));
}

/* The power of the radian in a unit: udunits2 takes it for a pure number, and 50 Hz for 50 rad/s. */
static int angle_of(const ut_unit *unit)
{
    char text[200];
    if (!unit || ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION) >= (int)sizeof text) return 0;
    const char *rad = strstr(text, "rad");
    const int power = rad ? atoi(rad + 3) : 0;
    return rad && power == 0 ? 1 : power;
}

static void conversion_find(const units *u, const char *from, const char *to, conversion *out)
{
    ut_unit *a = unit_parse(u, from), *b = unit_parse(u, to);
    *out = (conversion){ .known = a != NULL, .angle = angle_of(a) - angle_of(b) };
    snprintf(out->from, sizeof out->from, "%s", from);
    snprintf(out->to, sizeof out->to, "%s", to);
    if (a && b && ut_are_convertible(a, b)) out->converter = ut_get_converter(a, b);
    if (out->converter && is_inverse(out->converter)) {
        cv_free(out->converter);
        out->converter = NULL;
    }
    ut_free(a);
    ut_free(b);
    ut_set_status(UT_SUCCESS);
}

/* Both names are shorter than UNIT_SIZE. */
static const conversion *conversion_of(const units *u, const char *from, const char *to)
{
    const uint64_t hash = host_hash_bytes(host_hash_bytes(0, from, strlen(from)), to, strlen(to));
    conversion *c = &u->remembered[hash % REMEMBERED];
    if (same(c->from, from) && same(c->to, to)) return c;
    conversion_forget(c);
    conversion_find(u, from, to, c);
    return c;
}

static status convert(const units *u, double number, const char *from, const char *to, double *value)
{
    const conversion *c = conversion_of(u, from, to);
    CHECK(c->known, STATUS_BAD_INPUT, "`%s` is not a known unit: write it in %s", from, to);
    CHECK(c->converter, STATUS_BAD_INPUT, "`%s` is not a unit of %s", from, to);
    CHECK(c->angle == 0 || strstr(to, "rad"), STATUS_BAD_INPUT, "`%s` is not a unit of %s: it has an angle in it", from,
          to);
    CHECK(c->angle == 0, STATUS_BAD_INPUT, "`%s` is not a unit of %s: it does not say of which angle; write %s%s", from,
          to, to, same(to, "rad/s") ? " or rpm" : "");
    *value = same(from, to) ? number : tidy(cv_convert_double(c->converter, number));
    return status_ok();
}

status host_quantity_read(const units *u, const char *text, const char *unit, double *value, char user_unit[UNIT_SIZE])
{
    const size_t length = number_length(text);
    const bool pure = same(unit, "1");
    const char *example = same(unit, "rad") ? "deg" : unit;
    user_unit[0] = '\0';
    if (pure) CHECK(length > 0, STATUS_BAD_INPUT, "must be a number");
    CHECK(length > 0, STATUS_BAD_INPUT, "must be a number with a unit, such as `1 %s`", example);
    CHECK(length < NUMBER_SIZE, STATUS_BAD_INPUT, "the number is longer than %d characters", NUMBER_SIZE - 1);
    const double number = number_value(text, length);
    CHECK(isfinite(number) || text[length - 1] == 'f', STATUS_BAD_INPUT, "is too large to be held in %s", unit);

    const char *rest = text + length + strspn(text + length, " \t");
    size_t end = strlen(rest);
    while (end > 0 && (rest[end - 1] == ' ' || rest[end - 1] == '\t')) end--;
    CHECK(end < UNIT_SIZE, STATUS_BAD_INPUT, "its unit is longer than %d characters", UNIT_SIZE - 1);
    memcpy(user_unit, rest, end);
    user_unit[end] = '\0';

    if (end == 0 && (pure || isinf(number))) {
        *value = number;
        return status_ok();
    }
    CHECK(end > 0, STATUS_BAD_INPUT, "needs a unit, such as `%.*s %s`", (int)length, text, example);
    if (pure)
        CHECK(is_pure(user_unit), STATUS_BAD_INPUT, "is a pure number: no unit `%s` (or give it in %%)", user_unit);
    if (same(unit, "rad"))
        CHECK(is_angle(user_unit), STATUS_BAD_INPUT, "`%s` is not a unit of angle: use deg or rad", user_unit);
    TRY(convert(u, number, user_unit, unit, value));
    CHECK(!isnan(*value) && (isfinite(*value) || isinf(number)), STATUS_BAD_INPUT, "is too large to be held in %s",
          unit);
    return status_ok();
}

/* ---- showing ---- */

static bool takes_prefix(const char *unit)
{
    static const char *const names[] = { "m", "s", "F", "H", "V", "A", "Pa", "ohm", "J", "W", "N", "Hz", "C", NULL };
    for (int k = 0; names[k]; k++)
        if (same(unit, names[k])) return true;
    return false;
}

void host_quantity_text(double value, const char *unit, char *out, size_t size)
{
    static const char *const prefix[] = { "p", "n", "u", "m", "", "k", "M", "G", "T" };
    if (same(unit, "1")) {
        snprintf(out, size, "%.6g", value);
        return;
    }
    int k = 4;
    if (takes_prefix(unit) && value != 0.0 && isfinite(value)) {
        k += (int)floor(log10(fabs(value)) / 3.0 + 1e-9);
        k = k < 0 ? 0 : k > 8 ? 8 : k;
        if (same(unit, "s") && k > 4) k = 4; /* nobody says kiloseconds */
    }
    snprintf(out, size, "%.6g %s%s", value * pow(10.0, -3.0 * (k - 4)), prefix[k], unit);
}

/* The user's unit is `unit` with a prefix or none: limits then read best with prefixes of their own. */
static bool is_prefixed(const char *user_unit, const char *unit)
{
    if (!takes_prefix(unit)) return false;
    const size_t a = strlen(user_unit), b = strlen(unit);
    return a == 0 || (a >= b && a <= b + 2 && same(user_unit + a - b, unit));
}

static void limit_text(const units *u, double value, const char *unit, const char *user_unit, char *out, size_t size)
{
    double shown = value;
    if (user_unit[0] == '\0' || same(user_unit, unit) || is_prefixed(user_unit, unit) ||
        convert(u, value, unit, user_unit, &shown).code != STATUS_OK)
        host_quantity_text(value, unit, out, size);
    else
        snprintf(out, size, "%.6g %s", shown, user_unit);
}

void host_quantity_limits(const units *u, double min, double max, const char *unit, const char *user_unit,
                          char out[LIMITS_SIZE])
{
    char a[LIMITS_SIZE / 2 - 4], b[LIMITS_SIZE / 2 - 4];
    limit_text(u, min, unit, user_unit, a, sizeof a);
    limit_text(u, max, unit, user_unit, b, sizeof b);
    if (isinf(min) && isinf(max))
        snprintf(out, LIMITS_SIZE, "any value");
    else if (isinf(max))
        snprintf(out, LIMITS_SIZE, "at least %s", a);
    else if (isinf(min))
        snprintf(out, LIMITS_SIZE, "at most %s", b);
    else
        snprintf(out, LIMITS_SIZE, "%s .. %s", a, b);
}
