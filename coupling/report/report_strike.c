/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a strike.  First what became of projectile and target; then velocity and force over time, the target cut
 * before and after, and the search for the limit velocity. */
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PROBES "/scene/scene/probes"

/* ---- the head ---- */

/* "The projectile ..." by class. */
static void write_outcome(const page *p)
{
    static const struct {
        const char *class, *says;
    } outcomes[] = { { "pierced", "The target is pierced: the projectile goes on" },
                     { "stopped", "The target holds: the projectile comes to rest in it" },
                     { "rebound", "The target holds: the projectile flies back" },
                     { "bulged", "The target holds and bulges" },
                     { "torn", "The plate tears, but holds the projectile" },
                     { "unfinished", "The scene ended before it was decided: the projectile still moves" } };
    const cJSON *s = p->source->summary;
    const char *class = report_text(s, "class"), *says = class;
    for (int k = 0; k < PAGE_COUNT(outcomes); k++)
        if (strcmp(outcomes[k].class, class) == 0) says = outcomes[k].says;
    const double residual = report_number(s, "residual_velocity");
    fprintf(p->out, "<p class=\"verdict\" style=\"border-color:%s\">%s", report_colour(class), says);
    if (isfinite(residual) && strcmp(class, "stopped") != 0 && strcmp(class, "bulged") != 0) {
        fputs(" with ", p->out);
        report_page_number(p->out, fabs(residual), 1.0, "m/s");
    }
    fputs(", of ", p->out);
    report_page_number(p->out, report_number(s, "impact_velocity"), 1.0, "m/s");
    fputs(" at arrival.", p->out);
    const double lo = report_element(s, "limit_interval", 0), hi = report_element(s, "limit_interval", 1);
    if (isfinite(lo) || isfinite(hi)) {
        fputs(" Limit velocity: ", p->out);
        report_page_interval(p->out, report_number(s, "limit_velocity"), lo, hi, 1.0, "m/s");
        fputs(".", p->out);
    }
    fputs("</p>\n", p->out);
}

void report_strike_head(const page *p)
{
    static const page_column cards[] = { { "energy_absorbed", "energy it lost", 1.0, "J", NULL },
                                         { "energy_share", "of its energy", 0.01, "%", NULL },
                                         { "peak_force", "peak force", 1e3, "kN", NULL },
                                         { "impulse", "impulse", 1.0, "N s", NULL },
                                         { "deflection", "deflection *", 1e-3, "mm", NULL },
                                         { "hole_diameter", "hole *", 1e-3, "mm", NULL },
                                         { "debris_mass", "debris", 1e-3, "g", NULL },
                                         { "muzzle_velocity", "muzzle velocity", 1.0, "m/s", NULL },
                                         { "flight_time", "flight", 1e-3, "ms", NULL },
                                         { "projectile_mass", "projectile", 1e-3, "g", NULL },
                                         { "wall_seconds", "took", 1.0, "s", NULL } };
    if (report_page_is_done(p)) write_outcome(p);
    report_page_cards(p, p->source->summary, cards, PAGE_COUNT(cards));
    report_page_paragraph(p, "reason",
                          "Masses, energies, forces of the whole, mirror parts included. * rests on what failed, which "
                          "does not settle as cells "
                          "become smaller: compare it on the same cells alone (docs/guide/target.md).");
}

/* ---- over time ---- */

/* How many times what was computed makes the whole, mirror parts included, by the projectile's mass; 1 where that is
 * not known. */
static double parts_of(const page *p)
{
    char name[REPORT_USED_SIZE];
    report_used_value(p->source, "strike", "projectile", name);
    const cJSON *body = cJSON_GetObjectItemCaseSensitive(report_page_list(p, "bodies"), name);
    const double parts = round(report_number(p->source->summary, "projectile_mass") / report_number(body, "mass"));
    return parts == 2.0 || parts == 4.0 ? parts : 1.0;
}

/* The mean over the time `filter` before each row. */
static void filter_mean(report_curve *c, double filter, double parts)
{
    double *mean = malloc((c->n + 1) * sizeof *mean), sum = 0.0;
    size_t from = 1;
    if (!mean) return;
    for (size_t i = 0; i < c->n; i++) {
        if (i > 0) sum += c->y[i] * (c->x[i] - c->x[i - 1]);
        while (from < i && c->x[i] - c->x[from] >= filter) {
            sum -= c->y[from] * (c->x[from] - c->x[from - 1]);
            from++;
        }
        const double time = i > 0 ? c->x[i] - c->x[from - 1] : 0.0;
        mean[i] = time > 0.0 ? parts * sum / fmax(time, filter) : 0.0;
    }
    free(c->y);
    c->y = mean;
}

static void draw_speed(const page *p)
{
    report_curve v = report_curve_read(p->source, PROBES "/projectile_way/time", PROBES "/projectile_way/speed");
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = "velocity", .unit = "m/s", .from_zero = true });
    if (v.n > 1) report_chart_line(c, "projectile, along its flight", report_blue, v.x, v.y, v.n);
    report_chart_rule(c, "residual", "#555555", 'y', report_number(p->source->summary, "residual_velocity"));
    report_page_chart(p, "velocity", "Mean over the projectile's intact metal.", c);
    report_curve_free(&v);
}

/* The axis along which the projectile flies, 0 .. 2, and its sign: by its velocity at the start. */
static int flight_axis(const page *p, double *sign)
{
    char name[REPORT_USED_SIZE];
    double most = 0.0;
    int axis = 0;
    *sign = 1.0;
    report_used_value(p->source, "strike", "projectile", name);
    for (int k = 0; k < 3; k++) {
        char path[300];
        snprintf(path, sizeof path, "/scene/scene/bodies/%.150s/velocity_%c", name, "xyz"[k]);
        report_curve v = report_curve_read(p->source, "/scene/scene/bodies/time", path);
        if (v.n > 0 && fabs(v.y[0]) > most) {
            most = fabs(v.y[0]);
            axis = k;
            *sign = v.y[0] < 0.0 ? -1.0 : 1.0;
        }
        report_curve_free(&v);
    }
    return axis;
}

static void draw_force(const page *p)
{
    char text[REPORT_USED_SIZE], caption[200];
    double sign;
    const char *const columns[] = { PROBES "/projectile_force/force_x", PROBES "/projectile_force/force_y",
                                    PROBES "/projectile_force/force_z" };
    report_used_value(p->source, "strike", "filter", text);
    const double parts = parts_of(p), filter = atof(text);
    const int axis = flight_axis(p, &sign);
    report_curve f = report_curve_read(p->source, PROBES "/projectile_force/time", columns[axis]);
    if (f.n > 1) filter_mean(&f, filter, -sign * parts);
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = "force", .unit = "N", .from_zero = true });
    if (f.n > 1) report_chart_line(c, "on the projectile", report_red, f.x, f.y, f.n);
    snprintf(caption, sizeof caption, "Against the flight, mean over %g \302\265s (strike.filter)%s.", 1e6 * filter,
             parts > 1.0 ? ", of the whole: mirror parts included" : "");
    report_page_chart(p, "force", caption, c);
    report_curve_free(&f);
}

/* ---- the limit velocity ---- */

/* Arrivals of a class; NULL: of all others than `pierced` and `torn`. */
static void add_arrivals(report_chart *c, const cJSON *list, const char *class, const char *label, const char *colour)
{
    const int most = cJSON_GetArraySize(list);
    double *x = malloc(((size_t)most + 1) * sizeof *x), *y = malloc(((size_t)most + 1) * sizeof *y);
    const cJSON *a;
    size_t n = 0;
    if (x && y) {
        cJSON_ArrayForEach(a, list)
        {
            const char *is = report_text(a, "class");
            if (class ? strcmp(is, class) != 0 : strcmp(is, "pierced") == 0 || strcmp(is, "torn") == 0) continue;
            x[n] = report_number(a, "impact_velocity");
            y[n++] = report_number(a, "residual_velocity");
        }
        if (n > 0) (class ? report_chart_dots : report_chart_rings)(c, label, colour, x, y, n);
    }
    free(x);
    free(y);
}

/* v_r = k sqrt(v0^2 - v50^2) up to the fastest arrival. */
static void add_fit(report_chart *c, const cJSON *s, const cJSON *list)
{
    enum { POINTS = 80 };
    const double k = report_number(s, "recht_ipson_factor"), limit = report_number(s, "recht_ipson_limit");
    double x[POINTS], y[POINTS], fastest = 0.0;
    const cJSON *a;
    cJSON_ArrayForEach(a, list) fastest = fmax(fastest, report_number(a, "impact_velocity"));
    if (!isfinite(k) || !isfinite(limit) || !(fastest > limit)) return;
    for (int i = 0; i < POINTS; i++) {
        const double part = (double)i / (POINTS - 1);
        x[i] = limit + part * part * (fastest - limit);
        y[i] = k * sqrt(x[i] * x[i] - limit * limit);
    }
    report_chart_line(c, "Recht and Ipson", report_grey, x, y, POINTS);
}

static void draw_limit(const page *p, const cJSON *list)
{
    const cJSON *s = p->source->summary;
    report_chart *c = report_chart_create((report_axis){ .label = "velocity of arrival", .unit = "m/s" },
                                          (report_axis){ .label = "residual velocity", .unit = "m/s" });
    report_chart_band(c, "limit velocity", report_gouge_band, 'x', report_element(s, "limit_interval", 0),
                      report_element(s, "limit_interval", 1));
    add_fit(c, s, list);
    add_arrivals(c, list, "pierced", "pierced", report_red);
    add_arrivals(c, list, "torn", "torn", "#d08a1e");
    add_arrivals(c, list, NULL, "neither", "#3d8b4f");
    report_page_chart(p, "limit", "One point an arrival of the search.", c);
}

void report_strike_section(const page *p)
{
    static const page_column columns[] = {
        { "impact_velocity", "arrival", 1.0, "m/s", NULL },    { "class", "class", 1.0, "", NULL },
        { "residual_velocity", "residual", 1.0, "m/s", NULL }, { "energy_absorbed", "energy it lost", 1.0, "J", NULL },
        { "peak_force", "peak force", 1e3, "kN", NULL },       { "scene", "scene", 1.0, "", NULL }
    };
    const cJSON *list = report_page_list(p, "arrivals");
    if (p->source->history && host_h5_exists(p->source->history, PROBES "/projectile_way")) {
        report_page_heading(p, "Over time");
        report_page_plots_begin(p);
        draw_speed(p);
        draw_force(p);
        report_page_plots_end(p);
    }
    report_cut_section(p);
    if (cJSON_GetArraySize(list) > 0) {
        report_page_heading(p, "The limit velocity");
        report_page_plots_begin(p);
        draw_limit(p, list);
        report_page_plots_end(p);
        report_page_list_table(p, list, columns, PAGE_COUNT(columns));
    }
    report_bodies_part(p);
    report_probes_section(p);
}
