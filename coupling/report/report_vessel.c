/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a vessel: when it bursts and in what state, then how it gets there. */
#include "coupling/report/report_page.h"

#include <math.h>

void report_vessel_head(const page *p)
{
    static const page_column cards[] = { { "rupture_pressure", "pressure then", 1e3, "kPa", NULL },
                                         { "rupture_film", "film then", 1e-6, "&micro;m", NULL },
                                         { "rupture_strain", "plastic strain then", 1.0, "", NULL },
                                         { "peak_pressure", "peak pressure", 1e3, "kPa", NULL },
                                         { "vent_time", "half the pressure after", 1e-3, "ms", NULL },
                                         { "end_swelling", "diameter at the end", 1.0, "times", NULL } };
    const cJSON *s = p->source->summary;
    const double time = report_number(s, "rupture_time");
    if (report_page_is_done(p)) {
        fputs("<p class=\"verdict\">", p->out);
        if (isfinite(time)) {
            fputs("The film bursts after ", p->out);
            report_page_number(p->out, time, 1e-3, "ms");
            fputs(", at ", p->out);
            report_page_number(p->out, report_number(s, "rupture_swelling"), 1.0, "times its diameter.");
        } else {
            fputs("The film does not burst.", p->out);
        }
        fputs("</p>\n", p->out);
    }
    report_page_cards(p, s, cards, PAGE_COUNT(cards));
}

void report_vessel_section(const page *p)
{
    static const struct {
        const char *column, *label, *unit;
    } curves[] = { { "swelling", "diameter over that at first", "1" }, { "pressure", "pressure inside", "Pa" },
                   { "film", "thickness of the film", "m" },           { "strain", "plastic strain of the film", "1" },
                   { "bubble", "radius of the largest bubble", "m" },  { "damage", "damage of the film", "1" } };
    if (!p->source->history || !host_h5_exists(p->source->history, "/vessel/time")) return;
    report_page_heading(p, "Over time");
    report_page_plots_begin(p);
    for (int k = 0; k < PAGE_COUNT(curves); k++) {
        char path[60], name[60];
        snprintf(path, sizeof path, "/vessel/%s", curves[k].column);
        snprintf(name, sizeof name, "vessel-%s", curves[k].column);
        report_curve c = report_curve_read(p->source, "/vessel/time", path);
        report_chart *chart = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                                  (report_axis){ .label = curves[k].label, .unit = curves[k].unit });
        if (c.n > 1) report_chart_line(chart, "", report_blue, c.x, c.y, c.n);
        report_chart_rule(chart, "bursts", "#555555", 'x', report_number(p->source->summary, "rupture_time"));
        report_page_chart(p, name, "", chart);
        report_curve_free(&c);
    }
    report_page_plots_end(p);
}
