/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/profile_file.h"

#include "coupling/host/file_text.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char BYTE_ORDER_MARK[] = "\xEF\xBB\xBF"; /* of UTF-8, which spreadsheets put first */

typedef struct {
    circuit_supply_point *item;
    size_t n, room;
} point_list;

static bool keep(point_list *list, circuit_supply_point p)
{
    if (list->n == list->room) {
        const size_t room = list->room ? 2 * list->room : 64;
        circuit_supply_point *more = realloc(list->item, room * sizeof *more);
        if (!more) return false;
        list->item = more;
        list->room = room;
    }
    list->item[list->n++] = p;
    return true;
}

static bool is_heading(const char *line)
{
    line += strspn(line, " \t,;\"'");
    return isalpha((unsigned char)line[0]) || line[0] == '[' || line[0] == '(';
}

/* The units that a heading names in brackets must be those that are read. */
static status check_heading(const char *path, int number, const char *line)
{
    static const char *const wanted[] = { "s", "A" };
    for (int k = 0; k < 2 && (line = strpbrk(line, "[(")); k++) {
        const size_t n = strcspn(++line, "])");
        CHECK(n == strlen(wanted[k]) && strncmp(line, wanted[k], n) == 0, STATUS_BAD_INPUT,
              "%.300s:%d: column %d in %.*s: wanted time [s] and current [A]", path, number, k + 1,
              n < 20 ? (int)n : 20, line);
    }
    return status_ok();
}

static status read_line(const char *path, int number, char *line, point_list *list)
{
    circuit_supply_point p;
    char rest;
    line[strcspn(line, "#\r")] = '\0';
    if (line[strspn(line, " \t,;")] == '\0') return status_ok();
    const bool row = sscanf(line, " %lf%*[ \t,;]%lf %c", &p.time, &p.current, &rest) == 2;
    if (!row && list->n == 0 && is_heading(line)) return check_heading(path, number, line);
    CHECK(row && isfinite(p.time) && isfinite(p.current), STATUS_BAD_INPUT,
          "%.300s:%d: `%.60s`: wanted time [s] and current [A]", path, number, line);
    CHECK(list->n == 0 || p.time > list->item[list->n - 1].time, STATUS_BAD_INPUT,
          "%.300s:%d: %g s comes after %g s: times must ascend", path, number, p.time, list->item[list->n - 1].time);
    char place[340];
    snprintf(place, sizeof place, "%.300s:%d", path, number);
    TRY(base_params_check(circuit_supply_point_params, &p, place));
    CHECK(keep(list, p), STATUS_MEMORY, "no memory for the rows of %.300s", path);
    return status_ok();
}

status case_profile_read(const char *path, circuit_supply_point **points, int *n)
{
    char *bytes = NULL;
    size_t length = 0;
    point_list list = { NULL, 0, 0 };
    TRY(host_file_text(path, PROFILE_MAX_BYTES, &bytes, &length));
    char *text = realloc(bytes, length + 1), *line = text;
    status s = text ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for %.300s", path);
    if (text) text[length] = '\0';
    if (text && strncmp(text, BYTE_ORDER_MARK, strlen(BYTE_ORDER_MARK)) == 0) line += strlen(BYTE_ORDER_MARK);
    for (int number = 0; line && s.code == STATUS_OK; number++) {
        char *end = strchr(line, '\n');
        if (end) *end = '\0';
        s = read_line(path, number + 1, line, &list);
        line = end ? end + 1 : NULL;
    }
    free(text ? text : bytes);
    if (s.code != STATUS_OK) {
        free(list.item);
        return s;
    }
    *points = list.item;
    *n = (int)list.n;
    return s;
}
