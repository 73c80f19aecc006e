/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/words.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

enum { WORD_SIZE = 64 };

static int plain_word(const char *name, char out[WORD_SIZE])
{
    int n = 0;
    for (; *name && n < WORD_SIZE - 1; name++)
        if (*name != '_' && *name != '-' && *name != ' ') out[n++] = (char)tolower((unsigned char)*name);
    out[n] = '\0';
    return n;
}

static int least(int a, int b, int c)
{
    const int d = a < b ? a : b;
    return d < c ? d : c;
}

/* Damerau-Levenshtein distance (neighbouring letters swapped count once), three rows of the table kept. */
int host_word_distance(const char *name_a, const char *name_b)
{
    char a[WORD_SIZE], b[WORD_SIZE];
    const int na = plain_word(name_a, a), nb = plain_word(name_b, b);
    int row[3][WORD_SIZE];
    for (int j = 0; j <= nb; j++) row[0][j] = j;
    for (int i = 1; i <= na; i++) {
        int *now = row[i % 3];
        const int *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= nb; j++) {
            now[j] = least(last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1]));
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && before[j - 2] + 1 < now[j]) now[j] = before[j - 2] + 1;
        }
    }
    return row[na % 3][nb];
}

const char *host_nearest_name(const char *name, const char *(*next)(const void *user, int i), const void *user)
{
    const char *best = NULL;
    const int length = (int)strlen(name);
    int limit = length < 4 ? 1 : length < 8 ? 2 : length / 3;
    for (int i = 0;; i++) {
        const char *candidate = next(user, i);
        if (!candidate) return best;
        const int distance = host_word_distance(name, candidate);
        if (distance > limit) continue;
        best = candidate;
        limit = distance - 1;
    }
}
