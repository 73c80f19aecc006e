/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_errors.h"

#include "coupling/case/case_place.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add(case_errors *e, const case_error *at, const char *format, va_list args)
{
    char line[CASE_ERROR_SIZE];
    int used = 0;
    for (int k = 0; at->set >= 0 && k < e->n; k++)
        if (e->item[k].set == at->set) return;
    if (at->set >= 0 && e->sets)
        used = snprintf(line, sizeof line, CASE_SET_PLACE, e->sets[at->set]);
    else if (at->line > 0)
        used = snprintf(line, sizeof line, "%.200s:%d:%d: ", e->file[at->file], at->line, at->column);
    else
        used = snprintf(line, sizeof line, "%.200s: ", e->file[at->file]);
    vsnprintf(line + used, sizeof line - (size_t)used, format, args);
    for (int k = 0; k < e->n; k++)
        if (strcmp(e->item[k].text, line) == 0) return;
    if (e->n == CASE_MAX_ERRORS) {
        e->more++;
        return;
    }

    e->item[e->n] = *at;
    e->item[e->n].order = e->n;
    e->item[e->n].text = strdup(line);
    if (e->item[e->n].text)
        e->n++;
    else
        e->out_of_memory = true;
}

void case_errors_add(case_errors *e, const tree_node *where, const char *format, ...)
{
    case_error at = { .set = -1 };
    if (where)
        at = (case_error){ .set = where->set, .file = where->file, .line = where->line, .column = where->column };
    va_list args;
    va_start(args, format);
    add(e, &at, format, args);
    va_end(args);
}

void case_errors_add_at(case_errors *e, int file, int line, int column, const char *format, ...)
{
    const case_error at = { .set = -1, .file = file, .line = line, .column = column };
    va_list args;
    va_start(args, format);
    add(e, &at, format, args);
    va_end(args);
}

static int by_place(const void *a, const void *b)
{
    const case_error *p = a, *q = b;
    if (p->set != q->set) return p->set < q->set ? -1 : 1;
    if (p->file != q->file) return p->file < q->file ? -1 : 1;
    if (p->line != q->line) return p->line < q->line ? -1 : 1;
    if (p->column != q->column) return p->column < q->column ? -1 : 1;
    return p->order < q->order ? -1 : p->order > q->order;
}

status case_errors_finish(case_errors *e, char **text)
{
    *text = NULL;
    CHECK(!e->out_of_memory, STATUS_MEMORY, "out of memory while collecting the errors of %.200s", e->file[0]);
    if (e->n == 0) return status_ok();
    qsort(e->item, (size_t)e->n, sizeof e->item[0], by_place);
    size_t size = 100;
    for (int k = 0; k < e->n; k++) size += strlen(e->item[k].text) + 1;
    char *all = malloc(size), *end = all;
    CHECK(all, STATUS_MEMORY, "out of memory while collecting the errors of %.200s", e->file[0]);
    for (int k = 0; k < e->n; k++) end += snprintf(end, size - (size_t)(end - all), "%s\n", e->item[k].text);
    if (e->more > 0) snprintf(end, size - (size_t)(end - all), "... and %d more\n", e->more);
    *text = all;
    return base_status_error(STATUS_BAD_INPUT, "%s", e->item[0].text);
}

void case_errors_free(case_errors *e)
{
    for (int k = 0; k < e->n; k++) free(e->item[k].text);
    e->n = 0;
}

/* ---- the nearest name ---- */
