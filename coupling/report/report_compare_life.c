/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of surfaces compared by life.  First which lasts longest and whether it can be told apart, beside the rail
 * as it is; then all of them. */
#include "coupling/report/report_page.h"

#include <math.h>

static void write_line(FILE *out, const cJSON *entry)
{
    char text[REPORT_VALUE_SIZE];
    const double life = report_number(entry, "life"), early = report_element(entry, "life_quantiles", 0),
                 late = report_element(entry, "life_quantiles", 2);
    if (!isfinite(life)) {
        fputs(report_text(entry, "lacks")[0] ? " is not judged" : " is not known to crack", out);
        return;
    }
    if (isfinite(early))
        report_value_interval(life, early, late, text);
    else
        report_value_known(life, 0.7 * life, 1.3 * life, text);
    fprintf(out, " cracks after %s shots, by %s", text, report_text(entry, "life_cause"));
}

void report_compare_life_head(const page *p)
{
    report_page_ranking(p, &(page_ranking){ .name = "surface",
                                            .reference = "untreated",
                                            .best = "Longest lasts",
                                            .tied = "surfaces cannot be told apart by their life",
                                            .line = write_line });
}

void report_compare_life_section(const page *p)
{
    static const page_column columns[] = { { "tied", "rank", 1.0, "", NULL },
                                           { "surface", "surface", 1.0, "", NULL },
                                           { "metal", "metal on top", 1.0, "", NULL },
                                           { "life", "shots", 1.0, "", NULL },
                                           { "life_position", "x", 1.0, "m", NULL },
                                           { "life_depth", "depth", 1e-3, "mm", NULL },
                                           { "life_cause", "by", 1.0, "", NULL },
                                           { "life_range", "strain range", 1e-2, "%", NULL },
                                           { "life_without_heat", "shots without heat", 1.0, "", NULL },
                                           { "better_than_next", "better than the next", 1e-2, "%", NULL },
                                           { "lacks", "not judged", 1.0, "", NULL } };
    report_page_listed(p, "ranking", "Surfaces", columns, PAGE_COUNT(columns));
}
