/* SPDX-License-Identifier: BSD-3-Clause */
/* A comparison's answer in one sentence. */
#include "coupling/study/compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Also where no scene was run, if the screen calls its grains quiet. */
static bool gouges_not(const compare_entry *e)
{
    const bool quiet = isnan(e->gouges) && e->probability_gouge < 1.0 - STUDY_SIGNIFICANT;
    return (e->gouges == 0.0 || quiet) && isnan(e->threshold_velocity);
}

static void say(compare_result *r, const char *text)
{
    const size_t used = strlen(r->verdict);
    snprintf(r->verdict + used, sizeof r->verdict - used, "%s", text);
}

static bool with_best(const compare_result *r, int i)
{
    return i > 0 && r->ranking[i].tied == r->ranking[0].tied;
}

/* "x, y and z": those n that cannot be told from the best. */
static void say_names(compare_result *r, int n)
{
    for (int i = 1, k = 0; i < r->n; i++) {
        if (!with_best(r, i)) continue;
        say(r, k == 0 ? "" : k + 1 == n ? " and " : ", ");
        say(r, r->ranking[i].surface);
        k++;
    }
}

static bool none_gouges(const compare_result *r)
{
    for (int i = 0; i < r->n; i++)
        if (!gouges_not(&r->ranking[i])) return false;
    return r->n > 1;
}

void study_compare_conclude(compare_result *r)
{
    int tied = 0;
    for (int i = 0; i < r->n; i++) tied += with_best(r, i);
    r->verdict[0] = '\0';
    if (none_gouges(r)) {
        snprintf(r->verdict, sizeof r->verdict, "none of the %d surfaces gouges in this shot", r->n);
        return;
    }
    if (isnan(r->ranking[0].gouges)) say(r, "with grains that no scene was run for, ");
    say(r, tied > 0 ? "fewest gouges: " : "best is ");
    say(r, r->ranking[0].surface);
    if (tied == 0) return;
    say(r, "; ");
    if (tied + 1 < r->n)
        say_names(r, tied);
    else
        say(r, r->n > 2 ? "none of the others" : r->ranking[1].surface);
    say(r, tied + 1 < r->n || r->n == 2 ? " cannot be told from it" : " can be told from it");
}
