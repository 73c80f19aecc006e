/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_gnuplot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two columns of a group, of equal length; frees nothing on failure.  n = 0 where they are missing. */
typedef struct {
    double *x, *y;
    size_t n;
} curve;

static void curve_free(curve *c)
{
    free(c->x);
    free(c->y);
}

static curve curve_read(const report_source *r, const char *x, const char *y)
{
    curve c = { NULL, NULL, 0 };
    size_t a[H5_MAX_RANK], b[H5_MAX_RANK];
    if (!r->history || host_h5_read(r->history, x, &c.x, a).code != STATUS_OK) return c;
    if (host_h5_read(r->history, y, &c.y, b).code == STATUS_OK) c.n = a[0] < b[0] ? a[0] : b[0];
    return c;
}

static void scale(double *x, size_t n, double unit)
{
    for (size_t i = 0; i < n; i++) x[i] /= unit;
}

/* ---- the shot ---- */

enum { PANEL_CURVES = 7, PLOT_MODULES = 60 };

typedef struct {
    const char *label;
    double unit;
    struct {
        const char *column, *title;
    } curve[PANEL_CURVES];
} panel;

static const panel panels[] = {
    { "current [kA]", 1e3, { { "current", "rails" }, { "shunt_current", "shunt" } } },
    { "voltage [V]", 1.0, { { "breech_voltage", "breech" }, { "muzzle_voltage", "muzzle" } } },
    { "velocity [m/s]", 1.0, { { "velocity", "armature" } } },
    { "position [m]", 1.0, { { "position", "armature" } } },
    { "force [kN]",
      1e3,
      { { "force", "electromagnetic" },
        { "friction", "friction" },
        { "drag", "gas" },
        { "contact_force", "contact, one face" } } },
    { "acceleration [km/s^2]", 1e3, { { "acceleration", "armature" } } },
    { "energy [kJ]",
      1e3,
      { { "energy_capacitors", "capacitors" },
        { "energy_coils", "coils" },
        { "energy_rotors", "rotors" },
        { "energy_rails_field", "field of the rails" },
        { "energy_kinetic", "armature" },
        { "heat_rails", "heat of the rails" },
        { "heat_contact", "heat of the contact" } } },
    { "temperature [K]",
      1.0,
      { { "armature_temperature", "armature, face" },
        { "film_temperature", "melt" },
        { "rail_behind_temperature", "rail behind" },
        { "rail_temperature", "rail ahead" } } },
};
enum { PANELS = sizeof panels / sizeof *panels };

/* A data block of a column over time, in ms and `unit`; false where there is none, or it is zero throughout. */
static bool time_block(FILE *script, const report_source *r, const char *path, const char *block, double unit)
{
    const bool of_modules = strncmp(path, "modules/", 8) == 0;
    char full[100];
    snprintf(full, sizeof full, "/shot/%s", path);
    curve c = curve_read(r, of_modules ? "/shot/modules/time" : "/shot/time", full);
    bool some = false;
    for (size_t i = 0; i < c.n; i++) some = some || c.y[i] != 0.0;
    scale(c.x, c.n, 1e-3);
    scale(c.y, c.n, unit);
    if (some) report_plot_data(script, block, c.x, c.y, c.n);
    curve_free(&c);
    return some;
}

/* The modules' currents, thin and grey, behind those of the rails; returns how many. */
static int module_blocks(FILE *script, const report_source *r)
{
    int n = 0;
    for (char path[40], block[20], full[60]; n < PLOT_MODULES; n++) {
        snprintf(path, sizeof path, "modules/current_%03d", n);
        snprintf(block, sizeof block, "module%d", n);
        snprintf(full, sizeof full, "/shot/%s", path);
        if (!host_h5_exists(r->history, full)) break;
        if (!time_block(script, r, path, block, 1e3)) fprintf(script, "$%s << EOD\n0 0\nEOD\n", block);
    }
    return n;
}

static void draw_panel(FILE *script, const report_source *r, int p, int modules)
{
    static const char *const shades[PANEL_CURVES] = { "#1f5fa8", "#c0392b", "#3d8b4f", "#7a4a1e",
                                                      "#7b5ea7", "#d99a00", "#2a9d8f" };
    bool used[PANEL_CURVES] = { false };
    int n = 0;
    char block[32];
    for (int c = 0; c < PANEL_CURVES && panels[p].curve[c].column; c++) {
        snprintf(block, sizeof block, "panel%d_%d", p, c);
        used[c] = time_block(script, r, panels[p].curve[c].column, block, panels[p].unit);
    }
    fprintf(script, "set ylabel '%s'\nplot ", panels[p].label);
    for (int m = 0; p == 0 && m < modules; m++)
        fprintf(script, "%s$module%d with lines lw 1 lc rgb '#b8b8b8' notitle", n++ ? ", " : "", m);
    for (int c = 0; c < PANEL_CURVES; c++) {
        if (!used[c]) continue;
        fprintf(script, "%s$panel%d_%d with lines lw 2 lc rgb '%s' title '%s'", n++ ? ", " : "", p, c, shades[c],
                panels[p].curve[c].title);
    }
    fputs(n ? "\n" : "0 notitle\n", script);
}

status report_plot_shot(const report_source *r, bool *drawn)
{
    *drawn = false;
    curve c = curve_read(r, "/shot/time", "/shot/current");
    const size_t rows = c.n;
    const double end = rows > 0 ? 1e3 * c.x[rows - 1] : 0.0;
    curve_free(&c);
    if (rows < 2 || !r->gnuplot) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "shot", 1100, 1300));
    const int modules = module_blocks(p.script, r);
    fprintf(p.script, "set xrange [0:%.7g]\nset xlabel 'time [ms]'\nset multiplot layout %d,2\n", end,
            (PANELS + 1) / 2);
    for (int k = 0; k < PANELS; k++) draw_panel(p.script, r, k, modules);
    fputs("unset multiplot\n", p.script);
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

status report_plot_barrel(const report_source *r, bool *drawn)
{
    *drawn = false;
    curve c = curve_read(r, "/shot/position", "/shot/velocity");
    if (c.n < 2 || !r->gnuplot) {
        curve_free(&c);
        return status_ok();
    }
    plot p;
    status s = report_plot_begin(&p, r, "barrel", 760, 400);
    if (s.code == STATUS_OK) {
        bool used[OUTCOMES];
        report_plot_data(p.script, "curve", c.x, c.y, c.n);
        report_plot_outcome_data(p.script, r, &(point_source){ "sites", "outcome", "position", "velocity", 1.0 }, used);
        report_plot_band(p.script, 1, r->summary, "onset_interval", true, report_gouge_band);
        report_plot_band(p.script, 2, r->summary, "threshold_interval", false, report_gouge_band);
        report_plot_band(p.script, 3, r->summary, "scratch_interval", false, report_scratch_band);
        fputs("set xlabel 'position along the barrel [m]'\nset ylabel 'velocity [m/s]'\n"
              "plot $curve with lines lw 2 lc rgb '#1f5fa8' title 'armature'",
              p.script);
        report_plot_outcomes(p.script, used, false);
        s = report_plot_end(&p);
    }
    curve_free(&c);
    *drawn = s.code == STATUS_OK;
    return s;
}

status report_plot_threshold(const report_source *r, bool *drawn)
{
    *drawn = false;
    const cJSON *scenes = cJSON_GetObjectItemCaseSensitive(r->summary, "scenes"), *item;
    bool gauged = false; /* judged by growth, which whole scenes have too */
    int points = 0;
    cJSON_ArrayForEach(item, scenes)
    {
        gauged = gauged || cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(item, "gauged"));
        points += !isnan(report_number(item, "severity"));
    }
    if (points == 0 || !r->gnuplot) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "threshold", 760, 380));
    bool used[OUTCOMES];
    const char *y = gauged ? "groove_growth" : "severity";
    report_plot_outcome_data(p.script, r, &(point_source){ "scenes", "class", "velocity", y, 1.0 }, used);
    report_plot_band(p.script, 2, r->summary, "scratch_interval", true, report_scratch_band);
    report_plot_band(p.script, 1, r->summary, "threshold_interval", true, report_gouge_band);
    fprintf(p.script,
            "set xlabel 'velocity [m/s]'\nset ylabel '%s'\nset offsets graph 0.05, graph 0.05, graph 0.1, graph 0.1\n"
            "plot 0 with lines lw 1.5 dt 2 lc rgb '#555555' title 'growth sets in'",
            gauged ? "growth of the groove [1/s]" : "severity [1]");
    report_plot_outcomes(p.script, used, false);
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

status report_plot_inductance(const report_source *r, bool *drawn)
{
    *drawn = false;
    const int n = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(r->summary, "frequency"));
    if (n < 2 || !r->gnuplot) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "inductance", 760, 380));
    fputs("$table << EOD\n", p.script);
    for (int i = 0; i < n; i++)
        fprintf(p.script, "%.9g %.9g %.9g\n", report_element(r->summary, "frequency", i),
                1e6 * report_element(r->summary, "L_gradient", i), 1e3 * report_element(r->summary, "R_gradient", i));
    fputs("EOD\nset logscale x\nset logscale y2\nset border 11\nset ytics nomirror\nset y2tics\n"
          "set xlabel 'frequency [Hz]'\nset ylabel \"L' [uH/m]\"\nset y2label \"R' [mohm/m]\"\n"
          "plot $table using 1:2 with linespoints pt 7 ps 0.4 lw 2 lc rgb '#1f5fa8' title \"L'\", "
          "$table using 1:3 axes x1y2 with linespoints pt 7 ps 0.4 lw 2 lc rgb '#c0392b' title \"R'\"\n",
          p.script);
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

status report_plot_perimeter(const report_source *r, bool *drawn)
{
    *drawn = false;
    const int n = cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(r->summary, "perimeter"));
    if (n < 2 || !r->gnuplot) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "perimeter", 760, 380));
    fputs("$table << EOD\n", p.script);
    for (int i = 0; i < n; i++)
        fprintf(p.script, "%.9g %.9g %.9g\n", 1e3 * report_element(r->summary, "perimeter", i),
                1e-6 * report_element(r->summary, "perimeter_current", i),
                1e-6 * report_element(r->summary, "perimeter_heat", i));
    fprintf(p.script,
            "EOD\nset border 11\nset ytics nomirror\nset y2tics\nset yrange [0:*]\nset y2range [0:*]\n"
            "set xlabel 'along the surface, bore face to back [mm], at %.4g Hz'\n"
            "set ylabel 'current density [A/mm2 per A]'\nset y2label 'heating [W/cm3 per A2]'\n"
            "plot $table using 1:2 with lines lw 2 lc rgb '#1f5fa8' title 'current', "
            "$table using 1:3 axes x1y2 with lines lw 2 lc rgb '#c0392b' title 'heating'\n",
            report_number(r->summary, "perimeter_frequency"));
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

/* ---- the crater along its middle ---- */

/* Depth at the map's middle: the two rows beside z = 0 where it lies between them. */
static void middle_profile(const double *depth, const size_t dims[H5_MAX_RANK], double *out)
{
    const size_t nz = dims[1], a = (nz - 1) / 2, b = nz / 2;
    for (size_t i = 0; i < dims[0]; i++) out[i] = -0.5e3 * (depth[i * nz + a] + depth[i * nz + b]);
}

static status draw_profile(const report_source *r, const char *scene, const curve *c)
{
    char name[160];
    snprintf(name, sizeof name, "profile-%.120s", scene);
    plot p;
    TRY(report_plot_begin(&p, r, name, 640, 240));
    report_plot_data(p.script, "curve", c->x, c->y, c->n);
    fputs("unset key\nset xlabel 'along the rail [mm]'\nset ylabel 'height [mm]'\n"
          "set offsets graph 0, graph 0, graph 0.1, graph 0.1\n"
          "plot 0 with lines lw 1 dt 2 lc rgb '#888888', $curve with lines lw 2 lc rgb '#7a4a1e'\n",
          p.script);
    return report_plot_end(&p);
}

status report_plot_crater_profile(const report_source *r, const char *scene, bool *drawn)
{
    *drawn = false;
    if (!r->history || !r->gnuplot) return status_ok();
    char path[300];
    double *depth = NULL;
    size_t dims[H5_MAX_RANK], nx[H5_MAX_RANK] = { 0, 0 };
    curve c = { NULL, NULL, 0 };
    snprintf(path, sizeof path, "/scene/%.150s/crater/x", scene);
    if (host_h5_read(r->history, path, &c.x, nx).code != STATUS_OK) return status_ok();
    snprintf(path, sizeof path, "/scene/%.150s/crater/depth", scene);
    status s = host_h5_read(r->history, path, &depth, dims);
    if (s.code == STATUS_OK && dims[0] == nx[0] && dims[0] > 1 && dims[1] > 0) {
        c.n = dims[0];
        c.y = malloc(c.n * sizeof *c.y);
        s = c.y ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for a profile");
        if (c.y) {
            middle_profile(depth, dims, c.y);
            scale(c.x, c.n, 1e-3);
            s = draw_profile(r, scene, &c);
            *drawn = s.code == STATUS_OK;
        }
    }
    free(depth);
    curve_free(&c);
    return s;
}

status report_plot_inline(const report_source *r, const char *name, FILE *page)
{
    char path[OUTDIR_PATH_SIZE], *text;
    const int n = snprintf(path, sizeof path, "%.900s/plot-%.110s.svg", r->dir, name);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", r->dir);
    TRY(host_file_read(path, &text, NULL));
    const char *svg = strstr(text, "<svg");
    if (svg) fputs(svg, page);
    free(text);
    return status_ok();
}
