/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of targets compared.  First which is best and whether it can be told apart, beside the target of the case as
 * it is; then all of them. */
#include "coupling/report/report_page.h"
#include "coupling/report/report_svg.h"

#include <math.h>
#include <string.h>

static void write_line(const page *p, const cJSON *entry)
{
    const double lo = report_element(entry, "limit_interval", 0), hi = report_element(entry, "limit_interval", 1);
    fputs("<li><b>", p->out);
    report_svg_escaped(p->out, report_text(entry, "target"));
    fputs("</b>: ", p->out);
    if (isfinite(lo) || isfinite(hi)) {
        fputs("limit velocity ", p->out);
        report_page_interval(p->out, report_number(entry, "limit_velocity"), lo, hi, 1.0, "m/s");
    } else {
        fprintf(p->out, "%s, ", report_text(entry, "class"));
        report_page_number(p->out, report_number(entry, "residual_velocity"), 1.0, "m/s");
        fputs(" of ", p->out);
        report_page_number(p->out, report_number(entry, "impact_velocity"), 1.0, "m/s");
        fputs(" left", p->out);
    }
    fputs("; it weighs ", p->out);
    report_page_number(p->out, report_number(entry, "target_mass"), 1e-3, "g");
    fputs(".</li>\n", p->out);
}

void report_compare_targets_head(const page *p)
{
    const cJSON *ranking = report_page_list(p, "ranking"), *entry;
    if (!report_page_is_done(p) || cJSON_GetArraySize(ranking) == 0) return;
    const cJSON *best = ranking->child;
    int tied = 0;
    cJSON_ArrayForEach(entry, ranking) tied += report_number(entry, "tied") == 1.0;
    fputs("<p class=\"verdict\">", p->out);
    if (tied > 1) {
        fprintf(p->out, "The best %d targets cannot be told apart", tied);
    } else {
        fputs("The best target is <b>", p->out);
        report_svg_escaped(p->out, report_text(best, "target"));
        fputs("</b>", p->out);
    }
    fputs(".</p>\n<ul>\n", p->out);
    write_line(p, best);
    cJSON_ArrayForEach(entry, ranking)
    {
        if (entry != best && strcmp(report_text(entry, "target"), "given") == 0) write_line(p, entry);
    }
    fputs("</ul>\n", p->out);
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
