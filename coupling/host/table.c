/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/table.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_SIZE = 96, MAX_WIDTH = 100 };

typedef struct {
    char cell[TABLE_MAX_COLUMNS][CELL_SIZE];
} row;

struct table {
    int columns, kept; /* kept: the first ones, in every part */
    size_t rows, room;
    row *row; /* the titles come first */
};

/* Bytes that start a character: what a terminal shows of UTF-8. */
static int shown_width(const char *text)
{
    int n = 0;
    for (; *text; text++) n += ((unsigned char)*text & 0xC0) != 0x80;
    return n;
}

/* Of a text that is too long its start, to the end of a character, and "...". */
static void fill_cell(const char *text, size_t length, char cell[CELL_SIZE])
{
    const bool fits = length < CELL_SIZE;
    if (!fits) {
        length = CELL_SIZE - sizeof "...";
        while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    }
    for (size_t i = 0; i < length; i++) cell[i] = (char)(iscntrl((unsigned char)text[i]) ? ' ' : text[i]);
    strcpy(cell + length, fits ? "" : "...");
}

/* Number of cells; those past the last column that a table may have are only counted. */
static int split(const char *line, row *out)
{
    memset(out, 0, sizeof *out);
    for (int column = 0;; column++) {
        const size_t length = strcspn(line, TABLE_NEXT);
        if (column < TABLE_MAX_COLUMNS) fill_cell(line, length, out->cell[column]);
        if (!line[length]) return column + 1;
        line += length + 1;
    }
}

/* A copy of the text with TABLE_NEXT for each '|'; NULL: no memory.  free() it. */
static char *with_separators(const char *text)
{
    char *copy = strdup(text);
    for (char *at = copy; at && (at = strchr(at, '|'));) *at = *TABLE_NEXT;
    return copy;
}

static status add(table *t, const row *r)
{
    if (t->rows == t->room) {
        const size_t room = 2 * t->room + 8;
        row *grown = realloc(t->row, room * sizeof *grown);
        CHECK(grown, STATUS_MEMORY, "no memory for a table of %zu rows", room);
        t->row = grown;
        t->room = room;
    }
    t->row[t->rows++] = *r;
    return status_ok();
}

status host_table_create(const char *titles, table **out)
{
    *out = NULL;
    row r;
    char *line = with_separators(titles);
    CHECK(line, STATUS_MEMORY, "no memory for a table");
    const int columns = split(line, &r);
    free(line);
    CHECK(columns <= TABLE_MAX_COLUMNS, STATUS_BAD_INPUT, "table: at most %d columns: %.200s", TABLE_MAX_COLUMNS,
          titles);
    table *t = calloc(1, sizeof *t);
    CHECK(t, STATUS_MEMORY, "no memory for a table");
    t->columns = columns, t->kept = 1;
    const status s = add(t, &r);
    if (s.code != STATUS_OK) {
        host_table_free(t);
        return s;
    }
    *out = t;
    return s;
}

status host_table_row(table *t, const char *format, ...)
{
    char *own = with_separators(format), *line = NULL;
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    const int length = own ? vsnprintf(NULL, 0, own, args) : -1;
    if (length >= 0) line = malloc((size_t)length + 1);
    if (line) vsnprintf(line, (size_t)length + 1, own, again);
    va_end(again);
    va_end(args);
    free(own);
    CHECK(line, STATUS_MEMORY, "no memory for a row of a table");
    row r;
    const int columns = split(line, &r);
    free(line);
    CHECK(columns <= t->columns, STATUS_BAD_INPUT, "table: %d cells in a row of %d columns", columns, t->columns);
    return add(t, &r);
}

static bool is_number(const char *text)
{
    char *end;
    strtod(text, &end);
    if (end == text) return false;
    while (isspace((unsigned char)*end) || *end == '%') end++;
    return *end == '\0';
}

/* A column of numbers (and dashes for what is missing) goes to the right, with its title. */
static bool column_is_numbers(const table *t, int c)
{
    bool any = false;
    for (size_t i = 1; i < t->rows; i++) {
        const char *cell = t->row[i].cell[c];
        if (is_number(cell))
            any = true;
        else if (cell[0] && strcmp(cell, "-") != 0)
            return false;
    }
    return any;
}

typedef struct {
    int width[TABLE_MAX_COLUMNS];
    bool right[TABLE_MAX_COLUMNS];
} layout;

static void print_cell(const table *t, const layout *l, size_t i, int c, bool last, FILE *out)
{
    const char *cell = t->row[i].cell[c];
    const int pad = l->width[c] - shown_width(cell);
    if (c) fputs("  ", out);
    if (l->right[c]) fprintf(out, "%*s", pad, "");
    fputs(cell, out);
    if (!l->right[c] && !last) fprintf(out, "%*s", pad, "");
}

void host_table_keep(table *t, int columns)
{
    t->kept = columns;
}

/* As many of the kept columns as leave half of the width to others, the first one at least. */
static int columns_again(const table *t, const layout *l)
{
    int n = 1, wide = l->width[0];
    while (n < t->kept && n < t->columns && wide + 2 + l->width[n] <= MAX_WIDTH / 2) wide += 2 + l->width[n++];
    return n;
}

/* The kept columns, and those from one to before another. */
static void print_part(const table *t, const layout *l, int from, int to, FILE *out)
{
    const int again = from > 0 ? columns_again(t, l) : 0;
    for (size_t i = 0; i < t->rows; i++) {
        for (int c = 0; c < again; c++) print_cell(t, l, i, c, false, out);
        for (int c = from; c < to; c++) print_cell(t, l, i, c, c == to - 1, out);
        fputc('\n', out);
    }
}

void host_table_print(const table *t, FILE *out)
{
    layout l = { .width = { 0 } };
    for (int c = 0; c < t->columns; c++) {
        l.right[c] = column_is_numbers(t, c);
        for (size_t i = 0; i < t->rows; i++) {
            const int w = shown_width(t->row[i].cell[c]);
            if (w > l.width[c]) l.width[c] = w;
        }
    }
    for (int from = 0, to; from < t->columns; from = to) {
        int wide = 0;
        for (int c = 0; from > 0 && c < columns_again(t, &l); c++) wide += (c > 0 ? 2 : 0) + l.width[c];
        for (to = from; to < t->columns && (to == from || wide + 2 + l.width[to] <= MAX_WIDTH); to++)
            wide += (to > 0 ? 2 : 0) + l.width[to];
        if (from > 0) fputc('\n', out);
        print_part(t, &l, from, to, out);
    }
}

void host_table_free(table *t)
{
    if (!t) return;
    free(t->row);
    free(t);
}
