/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a scene of bodies: what became of each, their speeds and the scene's energies over time. */
#include "coupling/report/report_gnuplot.h"
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>

#define SCENE "/scene/scene"

/* ---- plots ---- */

typedef struct {
    double *value;
    size_t n;
} column;

static column column_read(const report_source *r, const char *path)
{
    column c = { NULL, 0 };
    size_t dims[H5_MAX_RANK];
    if (r->history && host_h5_read(r->history, path, &c.value, dims).code == STATUS_OK) c.n = dims[0];
    return c;
}

/* Data block $body<i>: the speed of a body in m/s over time in us; false where it has no series. */
static bool speed_block(FILE *script, const report_source *r, const char *body, int i)
{
    column t = column_read(r, SCENE "/bodies/time"), v[3];
    bool whole = t.n > 1;
    for (int k = 0; k < 3; k++) {
        char path[200];
        snprintf(path, sizeof path, SCENE "/bodies/%.100s/velocity_%c", body, "xyz"[k]);
        v[k] = column_read(r, path);
        whole = whole && v[k].n == t.n;
    }
    for (size_t q = 0; whole && q < t.n; q++) {
        t.value[q] *= 1e6;
        v[0].value[q] =
            sqrt(v[0].value[q] * v[0].value[q] + v[1].value[q] * v[1].value[q] + v[2].value[q] * v[2].value[q]);
    }
    char name[24];
    snprintf(name, sizeof name, "body%d", i);
    if (whole) report_plot_data(script, name, t.value, v[0].value, t.n);
    for (int k = 0; k < 3; k++) free(v[k].value);
    free(t.value);
    return whole;
}

/* Data block $<key>: an energy in J over time in us. */
static bool energy_block(FILE *script, const report_source *r, const char *key)
{
    char path[100];
    snprintf(path, sizeof path, SCENE "/%s", key);
    column t = column_read(r, SCENE "/time"), e = column_read(r, path);
    const bool whole = t.n > 1 && e.n == t.n;
    for (size_t q = 0; whole && q < t.n; q++) t.value[q] *= 1e6;
    if (whole) report_plot_data(script, key, t.value, e.value, t.n);
    free(t.value);
    free(e.value);
    return whole;
}

static void plot_speeds(FILE *script, const report_source *r)
{
    const cJSON *body;
    int n = 0, i = 0;
    bool used[100] = { false };
    cJSON_ArrayForEach(body, cJSON_GetObjectItemCaseSensitive(r->summary, "bodies"))
    {
        if (i < 100) used[i] = speed_block(script, r, body->string, i);
        i++;
    }
    fputs("set xlabel 'time [us]'\nset ylabel 'speed, mean over the body [m/s]'\nplot ", script);
    i = 0;
    cJSON_ArrayForEach(body, cJSON_GetObjectItemCaseSensitive(r->summary, "bodies"))
    {
        if (i < 100 && used[i])
            fprintf(script, "%s$body%d with lines lw 2 title '%s' noenhanced", n++ ? ", " : "", i, body->string);
        i++;
    }
    fputs(n ? "\n" : "0 notitle\n", script);
}

static void plot_energies(FILE *script, const report_source *r)
{
    static const char *const keys[] = { "kinetic", "internal", "heat_friction", "work_external", "ejected_energy" };
    enum { KEYS = sizeof keys / sizeof *keys };
    bool used[KEYS];
    int n = 0;
    for (int i = 0; i < KEYS; i++) used[i] = energy_block(script, r, keys[i]);
    fputs("set ylabel 'energy, as computed [J]'\nplot ", script);
    for (int i = 0; i < KEYS; i++)
        if (used[i]) fprintf(script, "%s$%s with lines lw 2 title '%s' noenhanced", n++ ? ", " : "", keys[i], keys[i]);
    fputs(n ? "\n" : "0 notitle\n", script);
}

static status plot_bodies(const report_source *r, bool *drawn)
{
    *drawn = false;
    if (!r->history || !r->gnuplot || !host_h5_exists(r->history, SCENE "/bodies/time")) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "bodies", 760, 740));
    fputs("set multiplot layout 2,1\n", p.script);
    plot_speeds(p.script, r);
    plot_energies(p.script, r);
    fputs("unset multiplot\n", p.script);
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

/* ---- the page ---- */

void report_bodies_verdict(const page *p)
{
    static const page_column cards[] = { { "end_time", "simulated", 1e-6, "us" },
                                         { "peak_pressure", "peak pressure", 1e9, "GPa" },
                                         { "peak_temperature", "peak temperature", 1.0, "K" },
                                         { "kinetic", "motion, at the end", 1.0, "J" },
                                         { "internal", "internal, at the end", 1.0, "J" },
                                         { "energy_error", "energy error", 1.0, "" },
                                         { "particles", "points", 1e3, "thousand" },
                                         { "wall_seconds", "took", 1.0, "s" } };
    report_page_cards(p, p->source->summary, cards, PAGE_COUNT(cards));
}

static void body_row(const page *p, const cJSON *body)
{
    fputs("<tr><td class=\"text\">", p->out);
    report_page_escaped(p->out, body->string);
    static const page_column numbers[] = { { "mass", "", 1e-3, "" },         { "kinetic", "", 1.0, "" },
                                           { "internal", "", 1.0, "" },      { "failed_volume", "", 1e-9, "" },
                                           { "peak_pressure", "", 1e9, "" }, { "peak_mises", "", 1e9, "" } };
    for (int k = 0; k < 3; k++) {
        fputs("</td><td>", p->out);
        report_page_number(p->out, report_element(body, "velocity", k), 1.0, "");
    }
    for (int i = 0; i < PAGE_COUNT(numbers); i++) {
        fputs("</td><td>", p->out);
        report_page_number(p->out, report_number(body, numbers[i].key), numbers[i].unit, numbers[i].name);
    }
    fputs("</td></tr>\n", p->out);
}

void report_section_bodies(const page *p)
{
    const cJSON *body, *bodies = cJSON_GetObjectItemCaseSensitive(p->source->summary, "bodies");
    if (cJSON_GetArraySize(bodies) == 0) return;
    report_page_heading(p, "Bodies at the end");
    fputs("<div class=\"wide\"><table><tr><th>body</th><th>v<sub>x</sub> [m/s]</th><th>v<sub>y</sub> [m/s]</th>"
          "<th>v<sub>z</sub> [m/s]</th><th>mass [g]</th><th>motion [J]</th><th>internal [J]</th><th>failed "
          "[mm&sup3;]</th>"
          "<th>peak pressure [GPa]</th><th>peak von Mises [GPa]</th></tr>\n",
          p->out);
    cJSON_ArrayForEach(body, bodies) body_row(p, body);
    fputs("</table></div>\n", p->out);
    report_page_draw(p, plot_bodies, "bodies", "Means over each body; energies of the model as computed.");
    report_section_probes(p);
}
