/* SPDX-License-Identifier: BSD-3-Clause */
/* The shot: its numbers, its curves until the armature has left, and where its energy went. */
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- numbers ---- */

/* clang-format off */
static const page_column cards[] = { { "muzzle_velocity", "muzzle velocity", 1.0, "m/s", NULL },
                                     { "muzzle_energy", "muzzle energy", 1e3, "kJ", NULL },
                                     { "efficiency", "of the stored energy", 0.01, "%", NULL },
                                     { "peak_current", "peak current", 1e3, "kA", NULL },
                                     { "exit_current", "current at exit", 1e3, "kA", NULL },
                                     { "peak_acceleration", "peak acceleration", 9806.65, "thousand g", NULL },
                                     { "muzzle_time", "leaves after", 1e-3, "ms", NULL },
                                     { "rail_rise", "rail warmer by", 1.0, "K", NULL } };
/* clang-format on */

/* Of `breech shot` the summary itself, else its part `shot`. */
static const cJSON *shot_of(const page *p)
{
    const cJSON *part = report_page_list(p, "shot");
    return cJSON_IsObject(part) ? part : p->source->summary;
}

static void verdict_inside(const page *p, const cJSON *shot)
{
    const bool ran_out = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(shot, "time_ran_out"));
    const double x = report_number(shot, "end_position");
    fputs(ran_out ? "The armature is still in the barrel when options.max_time runs out"
                  : "The armature does not leave the barrel",
          p->out);
    if (isfinite(x)) {
        fputs(ran_out ? ": it is at " : ": it rests at ", p->out);
        report_page_number(p->out, x, 1.0, "m");
        if (ran_out) {
            fputs(" with ", p->out);
            report_page_number(p->out, report_number(shot, "end_velocity"), 1.0, "m/s");
        }
    }
    fputs(".", p->out);
}

void report_shot_head(const page *p)
{
    const cJSON *shot = shot_of(p);
    const double v = report_number(shot, "muzzle_velocity");
    if (report_page_is_done(p)) {
        fputs("<p class=\"verdict\">", p->out);
        if (isfinite(v)) {
            fputs("The armature leaves the muzzle with ", p->out);
            report_page_number(p->out, v, 1.0, "m/s");
            fputs(" after ", p->out);
            report_page_number(p->out, report_number(shot, "muzzle_time"), 1e-3, "ms");
            fputs(", at a peak current of ", p->out);
            report_page_number(p->out, report_number(shot, "peak_current"), 1e3, "kA.");
        } else {
            verdict_inside(p, shot);
        }
        fputs("</p>\n", p->out);
    }
    report_page_cards(p, shot, cards, PAGE_COUNT(cards));
}

/* ---- curves ---- */

enum { PANEL_CURVES = 7, MOST_MODULES = 60 };
static const double AFTER_EXIT = 1.08; /* of the time in the barrel: how far the curves go on */

typedef struct {
    const char *name, *label, *unit;
    struct {
        const char *column, *title;
    } curve[PANEL_CURVES];
    const char *caption;
} panel;

static const panel panels[] = {
    { "shot-current",
      "current",
      "A",
      { { "current", "rails" }, { "shunt_current", "shunt" } },
      "Thin grey: the modules, one unit of each group." },
    { "shot-velocity", "velocity", "m/s", { { "velocity", "" } }, "" },
    { "shot-position", "position", "m", { { "position", "" } }, "" },
    { "shot-voltage", "voltage", "V", { { "breech_voltage", "breech" }, { "muzzle_voltage", "muzzle" } }, "" },
    { "shot-force",
      "force",
      "N",
      { { "force", "electromagnetic" },
        { "friction", "friction" },
        { "drag", "gas" },
        { "contact_force", "contact, one face" } },
      "" },
    { "shot-acceleration", "acceleration", "m/s^2", { { "acceleration", "" } }, "" },
    { "shot-energy",
      "energy",
      "J",
      { { "energy_capacitors", "capacitors" },
        { "energy_coils", "coils" },
        { "energy_rotors", "rotors" },
        { "energy_rails_field", "field of the rails" },
        { "energy_kinetic", "armature" },
        { "heat_rails", "heat of the rails" },
        { "heat_contact", "heat of the contact" } },
      "" },
    { "shot-temperature",
      "temperature",
      "K",
      { { "armature_temperature", "armature, face" },
        { "lead_face_temperature", "armature, lead face" },
        { "film_temperature", "melt (estimate)" },
        { "rail_behind_temperature", "rail behind (estimate)" },
        { "rail_temperature", "rail ahead" } },
      "Dashed: estimates with constant properties, of the melt on the armature's face and of the rail's surface one "
      "contact length behind it. They leave out the heat that melting and boiling take, so above a melting temperature "
      "they say that metal melts there, not how hot it gets. Nothing else of the run depends on them." },
};
enum { PANELS = sizeof panels / sizeof *panels };

/* Zero throughout, or not known. */
static bool is_zero(const double *y, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (y[i] != 0.0 && !isnan(y[i])) return false;
    return true;
}

/* A column over time; nothing where there is none or where it is zero until `end`. */
static void add_curve(report_chart *c, const report_source *r, const char *column, const char *title,
                      const char *colour, double end)
{
    const bool module = strncmp(column, "modules/", 8) == 0;
    char path[100];
    snprintf(path, sizeof path, "/shot/%s", column);
    report_curve curve = report_curve_read(r, module ? "/shot/modules/time" : "/shot/time", path);
    const size_t n = isfinite(end) ? report_curve_until(&curve, end) : curve.n;
    const bool estimate = strstr(title, "(estimate)");
    if (!is_zero(curve.y, n))
        (module     ? report_chart_thin_line
         : estimate ? report_chart_dashed
                    : report_chart_line)(c, title, colour, curve.x, curve.y, n);
    report_curve_free(&curve);
}

static void add_modules(report_chart *c, const report_source *r, double end)
{
    char path[60], full[80];
    for (int n = 0; n < MOST_MODULES; n++) {
        snprintf(path, sizeof path, "modules/current_%03d", n);
        snprintf(full, sizeof full, "/shot/%s", path);
        if (!host_h5_exists(r->history, full)) break;
        add_curve(c, r, path, "", "#b0b0b0", end);
    }
}

static void draw_panel(const page *p, const panel *k, double exit, double end)
{
    static const char *const shades[PANEL_CURVES] = { "#1f5fa8", "#c0392b", "#3d8b4f", "#7a4a1e",
                                                      "#7b5ea7", "#d99a00", "#2a9d8f" };
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = k->label, .unit = k->unit, .from_zero = true });
    if (k == panels) add_modules(c, p->source, end);
    for (int i = 0; i < PANEL_CURVES && k->curve[i].column; i++)
        add_curve(c, p->source, k->curve[i].column, k->curve[i].title, shades[i], end);
    if (isfinite(exit)) report_chart_rule(c, "muzzle", "#555555", 'x', exit);
    report_page_chart(p, k->name, k->caption, c);
}

void report_shot_section(const page *p)
{
    if (!p->source->history || !host_h5_exists(p->source->history, "/shot/time")) return;
    const double exit = report_number(shot_of(p), "muzzle_time");
    report_page_heading(p, "The shot");
    if (isfinite(exit))
        report_page_paragraph(p, "reason",
                              "Until the armature has left; the decay of the current after that is in history.h5.");
    report_page_plots_begin(p);
    for (int k = 0; k < PANELS; k++) draw_panel(p, &panels[k], exit, AFTER_EXIT * exit);
    report_page_plots_end(p);
}

/* ---- where the energy went ---- */

/* First and last value of a column, NaN where there is none. */
static void ends_of(const report_source *r, const char *column, double end[2])
{
    double *data;
    size_t dims[H5_MAX_RANK];
    char path[100];
    end[0] = end[1] = NAN;
    snprintf(path, sizeof path, "/shot/%s", column);
    if (host_h5_read(r->history, path, &data, dims).code != STATUS_OK) return;
    if (dims[0] > 0) end[0] = data[0], end[1] = data[dims[0] - 1];
    free(data);
}

typedef struct {
    report_table table;
    int decimals; /* of all numbers, so that a reader may add them up [kJ] */
} ledger_page;

static void ledger_row(ledger_page *l, const char *column, const char *text, const double value[2])
{
    char number[40];
    report_table_row(&l->table);
    report_table_text(&l->table, text);
    for (int k = 0; k < 2; k++) {
        snprintf(number, sizeof number, "%.*f", l->decimals, 1e-3 * value[k] + 0.0);
        report_table_html(&l->table, number[0] == '-' && strspn(number, "-0.") == strlen(number) ? "0" : number);
    }
    report_table_text(&l->table, column);
}

/* A row a place that the shot has. */
static void ledger_place(const page *p, ledger_page *l, const char *column, const char *text, double sum[2])
{
    double end[2];
    ends_of(p->source, column, end);
    for (int k = 0; k < 2; k++) sum[k] += isfinite(end[k]) ? end[k] : 0.0;
    if (end[0] != 0.0 || end[1] != 0.0) ledger_row(l, column, text, end);
}

/* Five digits of the largest sum. */
static int ledger_decimals(const page *p)
{
    double sum[2] = { 0.0, 0.0 }, end[2];
#define STORED(member, column, text) ends_of(p->source, #column, end), sum[1] += isfinite(end[1]) ? end[1] : 0.0;
#define SPENT(member, column, text) STORED(member, column, text)
#include "circuit/ledger.def"
    return sum[1] > 0.0 ? (int)fmax(0.0, 4.0 - floor(log10(1e-3 * sum[1]))) : 0;
}

/* Every place of circuit/ledger.def.  At the end there is what was there at the start and what was brought in. */
void report_shot_ledger(const page *p)
{
    if (!p->source->history || !host_h5_exists(p->source->history, "/shot/energy_error")) return;
    double sum[2] = { 0.0, 0.0 }, given[2] = { 0.0, 0.0 }, error[2];
    ledger_page l = { .decimals = ledger_decimals(p) };
    report_page_heading(p, "Where the energy went");
    report_table_begin(&l.table, p->out);
    report_table_text_title(&l.table, "place");
    report_table_title(&l.table, "start", "kJ");
    report_table_title(&l.table, "end", "kJ");
    report_table_text_title(&l.table, "column of history.h5");
#define STORED(member, column, text) ledger_place(p, &l, #column, text, sum);
#define SPENT(member, column, text) ledger_place(p, &l, #column, text, sum);
#include "circuit/ledger.def"
    ledger_row(&l, "", "sum", sum);
#define GIVEN(place, member, column, text) ledger_place(p, &l, #column, text, given);
#include "circuit/ledger.def"
    ledger_row(&l, "", "at the start and brought in", (double[2]){ sum[0], sum[0] + given[1] - given[0] });
    report_table_end(&l.table);
    ends_of(p->source, "energy_error", error);
    fprintf(p->out, "<p>The sums differ by %.0e of the whole.</p>\n", fabs(error[1]));
}
