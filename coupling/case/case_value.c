/* SPDX-License-Identifier: BSD-3-Clause */
/* One value of a case file as it is written. */
#include "coupling/case/case_reader.h"

#include <math.h>
#include <string.h>

/* The shortest text that reads back as the same number. */
static void number_text(double value, char out[32])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, 32, "%.*g", digits, value);
        double back;
        if (sscanf(out, "%lf", &back) == 1 && back == value) return;
    }
}

static bool is_pure(const base_param *p)
{
    return strcmp(p->unit, "1") == 0;
}

static void write_number(FILE *file, const base_param *p, double value)
{
    char text[32];
    if (isnan(value)) {
        fputs("none", file);
        return;
    }
    number_text(value, text);
    fprintf(file, "%s%s%s", text, is_pure(p) ? "" : " ", is_pure(p) ? "" : p->unit);
}

static void write_quoted(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') fputc('\\', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

static void write_vector(FILE *file, const base_param *p, const double *v)
{
    for (int k = 0; k < 3; k++) {
        fputs(k == 0 ? "[" : ", ", file);
        write_number(file, p, v[k]);
    }
    fputc(']', file);
}

static void write_points(FILE *file, const base_param *p, const double *v)
{
    for (int i = 0; i < base_param_pairs(v, p->room); i++) {
        fputs(i == 0 ? "[[" : ", [", file);
        write_number(file, p, v[2 * i]);
        fputs(", ", file);
        write_number(file, p, v[2 * i + 1]);
        fputc(']', file);
    }
    fputc(']', file);
}

bool case_value_is_required(const base_param *p)
{
    return p->kind == BASE_PARAM_TEXT ? !p->fallback_text : isinf(p->fallback);
}

const char *case_unit_text(const base_param *p, char out[UNIT_SIZE + 3])
{
    out[0] = '\0';
    if (!is_pure(p)) snprintf(out, UNIT_SIZE + 3, " [%s]", p->unit);
    return out;
}

/* Left out: a text that is empty, and a number that is required but has no value (there is no `none` for it). */
bool case_value_is_set(const base_param *p, const void *member)
{
    const bool number = p->kind == BASE_PARAM_NUMBER || p->kind == BASE_PARAM_VECTOR || p->kind == BASE_PARAM_POINTS;
    if (number) return !isinf(p->fallback) || !isnan(*(const double *)member);
    return p->kind != BASE_PARAM_TEXT || *(const char *)member != '\0';
}

void case_value_write(const base_param *p, const void *member, FILE *file)
{
    switch (p->kind) {
    case BASE_PARAM_NUMBER: write_number(file, p, *(const double *)member); break;
    case BASE_PARAM_INTEGER: fprintf(file, "%d", *(const int *)member); break;
    case BASE_PARAM_FLAG: fputs(*(const bool *)member ? "yes" : "no", file); break;
    case BASE_PARAM_CHOICE: fputs(p->choices[*(const int *)member], file); break;
    case BASE_PARAM_TEXT: write_quoted(file, member); break;
    case BASE_PARAM_VECTOR: write_vector(file, p, member); break;
    case BASE_PARAM_POINTS: write_points(file, p, member); break;
    }
}
