/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a scene of bodies: what became of each, their speeds and the scene's energies over time. */
#include "coupling/report/report_page.h"

#include "coupling/report/report_svg.h"

#include <math.h>

#define SCENE "/scene/scene"

/* ---- charts ---- */

/* The speed of a body over time. */
static void add_speed(report_chart *chart, const report_source *r, const char *body, int k)
{
    char path[200];
    snprintf(path, sizeof path, SCENE "/bodies/%.100s/velocity", body);
    report_curve v = report_curve_size(r, SCENE "/bodies/time", path);
    if (v.n > 1) report_chart_line(chart, body, report_shade(k), v.x, v.y, v.n);
    report_curve_free(&v);
}

static void draw_speeds(const page *p)
{
    const cJSON *body;
    int k = 0;
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = "speed", .unit = "m/s", .from_zero = true });
    cJSON_ArrayForEach(body, report_page_list(p, "bodies")) add_speed(c, p->source, body->string, k++);
    report_page_chart(p, "speeds", "Speed of each body, mean over its mass.", c);
}

static void draw_energies(const page *p)
{
    static const struct {
        const char *key, *title;
    } energies[] = { { "kinetic", "motion" },
                     { "internal", "internal" },
                     { "heat_friction", "of it, friction" },
                     { "work_external", "done by loads" },
                     { "ejected_energy", "left the window" } };
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = "energy", .unit = "J", .from_zero = true });
    for (int k = 0; k < PAGE_COUNT(energies); k++) {
        char path[100];
        snprintf(path, sizeof path, SCENE "/%s", energies[k].key);
        report_curve e = report_curve_read(p->source, SCENE "/time", path);
        bool some = false;
        for (size_t i = 0; i < e.n; i++) some = some || e.y[i] != 0.0;
        if (some && e.n > 1) report_chart_line(c, energies[k].title, report_shade(k), e.x, e.y, e.n);
        report_curve_free(&e);
    }
    report_page_chart(p, "energies", "Energies of the model as computed: half a model is half.", c);
}

/* ---- the page ---- */

static double speed_of(const cJSON *body)
{
    const double x = report_element(body, "velocity", 0), y = report_element(body, "velocity", 1),
                 z = report_element(body, "velocity", 2);
    return sqrt(x * x + y * y + z * z);
}

/* How far the scene has come, and which body is the fastest then. */
static void write_fastest(const page *p)
{
    const cJSON *body, *fastest = NULL;
    cJSON_ArrayForEach(body, report_page_list(p, "bodies"))
    {
        if (isfinite(speed_of(body)) && (!fastest || speed_of(body) > speed_of(fastest))) fastest = body;
    }
    if (!fastest) return;
    fputs("<p class=\"verdict\">After ", p->out);
    report_page_number(p->out, report_number(p->source->summary, "end_time"), 1e-6, "&micro;s <b>");
    report_svg_escaped(p->out, fastest->string);
    fputs("</b> is the fastest body, with ", p->out);
    report_page_number(p->out, speed_of(fastest), 1.0, "m/s.</p>\n");
}

void report_bodies_head(const page *p)
{
    static const page_column cards[] = { { "end_time", "simulated", 1e-6, "&micro;s", NULL },
                                         { "peak_pressure", "peak pressure", 1e9, "GPa", NULL },
                                         { "peak_temperature", "peak temperature", 1.0, "K", NULL },
                                         { "kinetic", "motion, at the end", 1.0, "J", NULL },
                                         { "internal", "internal, at the end", 1.0, "J", NULL },
                                         { "energy_error", "energy error", 1.0, "", NULL },
                                         { "particles", "points", 1.0, "", NULL },
                                         { "wall_seconds", "took", 1.0, "s", NULL } };
    if (report_page_is_done(p)) write_fastest(p);
    report_page_cards(p, p->source->summary, cards, PAGE_COUNT(cards));
}

static void body_table(const page *p, const cJSON *bodies)
{
    static const page_column numbers[] = { { "mass", "mass", 1e-3, "g", NULL },
                                           { "kinetic", "motion", 1.0, "J", NULL },
                                           { "internal", "internal", 1.0, "J", NULL },
                                           { "failed_volume", "failed *", 1e-9, "mm\302\263", NULL },
                                           { "peak_pressure", "peak pressure", 1e9, "GPa", NULL },
                                           { "peak_mises", "peak von Mises", 1e9, "GPa", NULL } };
    static const char *const velocity[] = { "velocity x", "velocity y", "velocity z" };
    const cJSON *body;
    report_table t;
    report_table_begin(&t, p->out);
    report_table_text_title(&t, "body");
    for (int k = 0; k < 3; k++) report_table_title(&t, velocity[k], "m/s");
    for (int k = 0; k < PAGE_COUNT(numbers); k++) report_table_title(&t, numbers[k].title, numbers[k].name);
    cJSON_ArrayForEach(body, bodies)
    {
        report_table_row(&t);
        report_table_text(&t, body->string);
        for (int k = 0; k < 3; k++) report_table_number(&t, report_element(body, "velocity", k), 1.0);
        for (int k = 0; k < PAGE_COUNT(numbers); k++)
            report_table_number(&t, report_number(body, numbers[k].key), numbers[k].unit);
    }
    report_table_end(&t);
}

void report_bodies_part(const page *p)
{
    const cJSON *bodies = report_page_list(p, "bodies");
    if (cJSON_GetArraySize(bodies) == 0) return;
    report_page_heading(p, "Bodies at the end");
    body_table(p, bodies);
    report_page_paragraph(p, "reason",
                          "Masses, energies, volumes, and forces of probes are those of the model as computed: beside "
                          "one mirror half of the whole, beside two a quarter. Velocities and pressures hold for both. "
                          "* does not settle as cells become smaller.");
    report_page_plots_begin(p);
    draw_speeds(p);
    draw_energies(p);
    report_page_plots_end(p);
}

void report_bodies_section(const page *p)
{
    report_bodies_part(p);
    report_cut_section(p);
    report_probes_section(p);
}
