/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of the rails' inductance and resistance. */
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>

/* A chart of one key of the summary over another. */
static void draw(const page *p, const char *name, const char *caption, const char *x_key, const char *y_key,
                 report_axis x_axis, report_axis y_axis)
{
    const cJSON *s = p->source->summary;
    const int n = cJSON_GetArraySize(report_page_list(p, x_key));
    double *x = malloc(((size_t)n + 1) * sizeof *x), *y = malloc(((size_t)n + 1) * sizeof *y);
    if (x && y && n > 1) {
        for (int i = 0; i < n; i++) {
            x[i] = report_element(s, x_key, i);
            y[i] = report_element(s, y_key, i);
        }
        report_chart *c = report_chart_create(x_axis, y_axis);
        report_chart_line(c, "", report_blue, x, y, (size_t)n);
        if (n < 60) report_chart_dots(c, "", report_blue, x, y, (size_t)n);
        report_page_chart(p, name, caption, c);
    }
    free(x);
    free(y);
}

void report_inductance_head(const page *p)
{
    const cJSON *s = p->source->summary;
    const int last = cJSON_GetArraySize(report_page_list(p, "frequency")) - 1;
    if (!report_page_is_done(p) || last < 0) return;
    fputs("<p class=\"verdict\">A metre of these rails has ", p->out);
    report_page_number(p->out, report_element(s, "L_gradient", 0), 1e-6, "&micro;H");
    fputs(" at ", p->out);
    report_page_number(p->out, report_element(s, "frequency", 0), 1.0, "Hz");
    if (last > 0) {
        fputs(" and ", p->out);
        report_page_number(p->out, report_element(s, "L_gradient", last), 1e-6, "&micro;H");
        fputs(" at ", p->out);
        report_page_number(p->out, report_element(s, "frequency", last), 1e3, "kHz");
    }
    fputs(".</p>\n", p->out);
}

void report_inductance_section(const page *p)
{
    const double at = report_number(p->source->summary, "perimeter_frequency");
    char caption[160], value[REPORT_VALUE_SIZE];
    const report_axis frequency = { .label = "frequency", .unit = "Hz", .log = true, .fixed = true };
    const report_axis around = { .label = "along the surface, bore face to back", .unit = "m", .from_zero = true };
    report_page_heading(p, "Inductance and resistance gradients");
    report_page_plots_begin(p);
    draw(p, "inductance", "", "frequency", "L_gradient", frequency,
         (report_axis){ .label = "inductance gradient", .unit = "H/m" });
    draw(p, "resistance", "", "frequency", "R_gradient", frequency,
         (report_axis){ .label = "resistance gradient", .unit = "ohm/m", .log = true });
    report_value_plain(at, value);
    snprintf(caption, sizeof caption, "Current on the rail's surface at %.60s Hz, for 1 A in the rail.", value);
    draw(p, "perimeter", caption, "perimeter", "perimeter_current", around,
         (report_axis){ .label = "current density", .unit = "A/m^2 per A", .from_zero = true });
    snprintf(caption, sizeof caption, "Heating of the rail's surface at %.60s Hz, for 1 A in the rail.", value);
    draw(p, "heating", caption, "perimeter", "perimeter_heat", around,
         (report_axis){ .label = "heating", .unit = "W/m^3 per A^2", .from_zero = true });
    report_page_plots_end(p);
}
