/* SPDX-License-Identifier: BSD-3-Clause */
/* A comparison's answer in one sentence. */
#include "coupling/study/compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool gouges_not(const compare_entry *e)
{
    return e->gouges == 0.0 && isnan(e->threshold_velocity);
}

static void say(compare_result *r, const char *text)
{
    const size_t used = strlen(r->verdict);
    snprintf(r->verdict + used, sizeof r->verdict - used, "%s", text);
}

/* "x, y and z": the first so many of the ranking. */
static void say_names(compare_result *r, int n)
{
    for (int k = 0; k < n; k++) {
        say(r, k == 0 ? "" : k + 1 == n ? " and " : ", ");
        say(r, r->ranking[k].surface);
    }
}

/* No surface is told from any other: does none gouge? */
static void say_all_tied(compare_result *r)
{
    int gouging = 0;
    for (int i = 0; i < r->n; i++) gouging += !gouges_not(&r->ranking[i]);
    snprintf(r->verdict, sizeof r->verdict, "none of the %d surfaces %s", r->n,
             gouging ? "can be told from the others; fewest gouges: " : "gouges in this shot");
    if (gouging) say(r, r->ranking[0].surface);
}

void study_compare_conclude(compare_result *r)
{
    int tied = 0;
    r->verdict[0] = '\0';
    while (tied < r->n && r->ranking[tied].tied == r->ranking[0].tied) tied++;
    if (r->n > 1 && tied == r->n) {
        say_all_tied(r);
        return;
    }
    say(r, tied > 1 ? "best are " : "best is ");
    say_names(r, tied);
    if (tied > 1) say(r, ", which cannot be told apart");
}
