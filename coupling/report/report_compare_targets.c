/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of targets compared.  First which is best and whether it can be told apart, beside the target of the case as
 * it is; then all of them. */
#include "coupling/report/report_page.h"

#include <math.h>

static void write_line(FILE *out, const cJSON *entry)
{
    const double lo = report_element(entry, "limit_interval", 0), hi = report_element(entry, "limit_interval", 1);
    fputs(": ", out);
    if (isfinite(lo) || isfinite(hi)) {
        fputs("limit velocity ", out);
        report_page_interval(out, report_number(entry, "limit_velocity"), lo, hi, 1.0, "m/s");
    } else {
        fprintf(out, "%s, ", report_text(entry, "class"));
        report_page_number(out, report_number(entry, "residual_velocity"), 1.0, "m/s");
        fputs(" of ", out);
        report_page_number(out, report_number(entry, "impact_velocity"), 1.0, "m/s");
        fputs(" left", out);
    }
    fputs("; it weighs ", out);
    report_page_number(out, report_number(entry, "target_mass"), 1e-3, "g");
}

void report_compare_targets_head(const page *p)
{
    report_page_ranking(p, &(page_ranking){ .name = "target",
                                            .reference = "given",
                                            .best = "The best target is",
                                            .tied = "targets cannot be told apart",
                                            .line = write_line });
}

void report_compare_targets_section(const page *p)
{
    static const page_column columns[] = { { "tied", "rank", 1.0, "", NULL },
                                           { "target", "target", 1.0, "", NULL },
                                           { "target_mass", "mass", 1e-3, "g", NULL },
                                           { "class", "class", 1.0, "", NULL },
                                           { "limit_velocity", "limit", 1.0, "m/s", NULL },
                                           { "residual_velocity", "left", 1.0, "m/s", NULL },
                                           { "energy_absorbed", "energy taken", 1.0, "J", NULL },
                                           { "peak_force", "peak force", 1e3, "kN", NULL },
                                           { "deflection", "deflection *", 1e-3, "mm", NULL },
                                           { "hole_diameter", "hole *", 1e-3, "mm", NULL },
                                           { "debris_mass", "debris", 1e-3, "g", NULL } };
    report_page_listed(p, "ranking", "Targets", columns, PAGE_COUNT(columns));
    report_page_paragraph(p, "reason",
                          "* rests on what failed, which does not settle as cells become smaller: compare it on the "
                          "same cells alone (docs/guide/target.md).");
}
