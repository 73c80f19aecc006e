#include "coupling/case/profile_file.h"

#include "coupling/host/file_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    supply_point *item;
    size_t n, room;
} point_list;

static bool keep(point_list *list, supply_point p)
{
    if (list->n == list->room) {
        const size_t room = list->room ? 2 * list->room : 64;
        supply_point *more = realloc(list->item, room * sizeof *more);
        if (!more) return false;
        list->item = more;
        list->room = room;
    }
    list->item[list->n++] = p;
    return true;
}

static status read_line(const char *path, int number, char *line, point_list *list)
{
    supply_point p;
    char rest;
    line[strcspn(line, "#\r")] = '\0';
    if (line[strspn(line, " \t,;")] == '\0') return status_ok();
    const bool row = sscanf(line, " %lf%*[ \t,;]%lf %c", &p.time, &p.current, &rest) == 2;
    if (!row && list->n == 0) return status_ok(); /* a heading */
    CHECK(row, STATUS_BAD_INPUT, "%.300s:%d: `%.60s`: wanted time [s] and current [A]", path, number, line);
    CHECK(keep(list, p), STATUS_MEMORY, "no memory for the rows of %.300s", path);
    return status_ok();
}

status case_profile_read(const char *path, supply_point **points, int *n)
{
    char *bytes = NULL;
    size_t length = 0;
    point_list list = { NULL, 0, 0 };
    TRY(host_file_text(path, PROFILE_MAX_BYTES, &bytes, &length));
    char *text = realloc(bytes, length + 1), *line = text;
    status s = text ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for %.300s", path);
    if (text) text[length] = '\0';
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
