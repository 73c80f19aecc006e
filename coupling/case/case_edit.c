/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_edit.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t case_edit_place(const case_edits *e, int line, int column)
{
    size_t at = e->length >= 3 && memcmp(e->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; /* a byte-order mark */
    for (int k = 1; k < line && at < e->length; at++) k += e->text[at] == '\n';
    for (int k = 1; k < column && at < e->length && e->text[at] != '\n'; k++) {
        at++;
        while (at < e->length && ((unsigned char)e->text[at] & 0xC0) == 0x80) at++;
    }
    return at;
}

size_t case_edit_line_end(const case_edits *e, int line)
{
    size_t at = case_edit_place(e, line, 1);
    while (at < e->length && e->text[at] != '\n') at++;
    return at > 0 && e->text[at - 1] == '\r' ? at - 1 : at;
}

void case_edit_add(case_edits *e, size_t at, size_t skip, const char *format, ...)
{
    char text[2 * TREE_MAX_TEXT + 100];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    case_edit *more = realloc(e->item, ((size_t)e->n + 1) * sizeof *more);
    if (more) e->item = more;
    char *put = more ? strdup(text) : NULL;
    if (!put) {
        e->out_of_memory = true;
        return;
    }
    e->item[e->n] = (case_edit){ at, skip, e->n, put };
    e->n++;
}

/* How many bytes a value takes in the text, quotes included. */
static size_t written_length(const case_edits *e, size_t at, const tree_node *value)
{
    const char quote = e->text[at];
    if (!value->quoted) return strlen(value->text);
    size_t end = at + 1;
    for (; end < e->length && e->text[end] != '\n'; end++) {
        const char next = end + 1 < e->length ? e->text[end + 1] : '\0';
        if (e->text[end] == '\\' && quote == '"')
            end++;
        else if (e->text[end] == quote && (quote == '"' || next != quote))
            return end + 1 - at;
        else if (e->text[end] == quote)
            end++;
    }
    return end - at;
}

/* May it stand in a case without quotes, wherever that is? */
static bool is_plain(const char *text)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
    return text[0] && text[0] != '-' && text[strspn(text, plain)] == '\0';
}

void case_edit_value(case_edits *e, const tree_node *value, const char *text)
{
    const size_t at = case_edit_place(e, value->line, value->column);
    char put[2 * TREE_MAX_TEXT + 3];
    size_t n = 0;
    if (at >= e->length) return;
    put[n++] = '"';
    for (const char *c = text; *c && n < sizeof put - 3; c++) {
        if (*c == '"' || *c == '\\') put[n++] = '\\';
        put[n++] = *c;
    }
    put[n++] = '"';
    put[n] = '\0';
    case_edit_add(e, at, written_length(e, at, value), "%s", is_plain(text) ? text : put);
}

static int by_place(const void *a, const void *b)
{
    const case_edit *x = a, *y = b;
    return x->at < y->at ? -1 : x->at > y->at ? 1 : x->order - y->order;
}

status case_edits_apply(case_edits *e, char **out, size_t *length)
{
    size_t room = e->length + 1, from = 0, n = 0;
    *out = NULL;
    for (int k = 0; k < e->n; k++) room += strlen(e->item[k].put);
    char *text = e->out_of_memory ? NULL : malloc(room);
    CHECK(text, STATUS_MEMORY, "no memory for a case of %zu bytes", room);
    if (e->n > 0) qsort(e->item, (size_t)e->n, sizeof *e->item, by_place);
    for (int k = 0; k < e->n; k++) {
        const case_edit *x = &e->item[k];
        memcpy(text + n, e->text + from, x->at - from);
        n += x->at - from;
        memcpy(text + n, x->put, strlen(x->put));
        n += strlen(x->put);
        from = x->at + x->skip;
    }
    memcpy(text + n, e->text + from, e->length - from);
    *length = n + e->length - from;
    text[*length] = '\0';
    *out = text;
    return status_ok();
}

void case_edits_free(case_edits *e)
{
    for (int k = 0; k < e->n; k++) free(e->item[k].put);
    free(e->item);
    *e = (case_edits){ .text = NULL };
}
