/* SPDX-License-Identifier: BSD-3-Clause */
/* Pages of docs/reference that hold what the program's tables print.  After cmocka.h. */
#ifndef BREECH_TESTS_MANUAL_COMMON_H
#define BREECH_TESTS_MANUAL_COMMON_H

#include "coupling/host/outdir.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "full_common.h"
#include "status_common.h"

/* What two texts have in common at their beginning, in whole lines [bytes]. */
static inline size_t manual_alike(const char *a, const char *b)
{
    size_t n = 0, line = 0;
    for (; a[n] && a[n] == b[n]; n++)
        if (a[n] == '\n') line = n + 1;
    return line;
}

/* The page holds `printed` between the line `begin` with an empty one behind it, and the text `end` (NULL: the page's
 * end).  Where it does not, the test says from which line on and how to mend it; with BREECH_WRITE=1 it mends it. */
static inline void manual_holds(const char *path, const char *begin, const char *end, const char *printed)
{
    char *page = NULL, *mended = NULL;
    size_t bytes = 0;
    OK(host_file_read(path, &page, NULL));
    char *from = strstr(page, begin);
    if (!from) fail_msg("%s has no line `%s`", path, begin);
    from += strlen(begin);
    from += strspn(from, "\n"), printed += strspn(printed, "\n");
    char *to = end ? strstr(from, end) : from + strlen(from);
    if (!to) fail_msg("%s has no `%s` behind `%s`", path, end, begin);
    if ((size_t)(to - from) != strlen(printed) || strncmp(from, printed, strlen(printed)) != 0) {
        if (!is_asked_for("BREECH_WRITE")) {
            const char *is = printed + manual_alike(from, printed);
            fail_msg("%s is not what the tables print, the first line of them that it lacks: %.*s\n"
                     "run this test with BREECH_WRITE=1 in the environment: it writes the page anew",
                     path, (int)strcspn(is, "\n"), is);
        }
        FILE *out = open_memstream(&mended, &bytes);
        assert_non_null(out);
        fprintf(out, "%.*s%s%s", (int)(from - page), page, printed, to);
        fclose(out);
        OK(host_file_write(path, mended, bytes));
        free(mended);
    }
    free(page);
}

#endif
