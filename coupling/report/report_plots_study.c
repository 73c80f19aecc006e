/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_gnuplot.h"

#include <math.h>
#include <string.h>

static const cJSON *list_of(const report_source *r, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(r->summary, key);
}

/* ---- threshold velocity over size ---- */

/* Families are numbered from 1 or 0 without gaps; the largest number. */
static int last_family(const cJSON *surface)
{
    double last = 0.0;
    const cJSON *item;
    cJSON_ArrayForEach(item, surface) last = fmax(last, report_number(item, "family"));
    return (int)last;
}

/* radius [mm], threshold, lower end, upper end [m/s]; a size without a threshold is left out. */
static int family_data(FILE *script, const cJSON *surface, int family)
{
    int n = 0;
    const cJSON *item;
    fprintf(script, "$family%d << EOD\n", family);
    cJSON_ArrayForEach(item, surface)
    {
        const double v = report_number(item, "threshold_velocity"), lo = report_element(item, "threshold_interval", 0),
                     hi = report_element(item, "threshold_interval", 1);
        if ((int)report_number(item, "family") != family || isnan(v)) continue;
        fprintf(script, "%.7g %.7g %.7g %.7g\n", 1e3 * report_number(item, "radius"), v, isnan(lo) ? v : lo,
                isnan(hi) ? v : hi);
        n++;
    }
    fputs("EOD\n", script);
    return n;
}

status report_plot_surface(const report_source *r, bool *drawn)
{
    const cJSON *surface = list_of(r, "surface");
    *drawn = false;
    if (cJSON_GetArraySize(surface) < 2 || !r->gnuplot) return status_ok();
    plot p;
    TRY(report_plot_begin(&p, r, "surface", 760, 420));
    bool used[OUTCOMES], first = true;
    const int families = last_family(surface);
    int sizes[64] = { 0 };
    for (int f = 0; f <= families && f < 64; f++) sizes[f] = family_data(p.script, surface, f);
    report_plot_outcome_data(p.script, r, &(point_source){ "scenes", "class", "radius", "velocity", 1e-3 }, used);
    fputs("set logscale x\nset xlabel 'radius of the grain [mm]'\nset ylabel 'velocity [m/s]'\n"
          "set offsets graph 0.05, graph 0.05, graph 0.1, graph 0.1\nplot ",
          p.script);
    for (int f = 0; f <= families && f < 64; f++) {
        if (sizes[f] == 0) continue;
        fprintf(p.script,
                "%s$family%d using 1:3:4 with filledcurves fillstyle solid 0.2 noborder lc rgb '#e58a7f' notitle, "
                "$family%d using 1:2:3:4 with yerrorbars pt 0 lc rgb '#555555' notitle, "
                "$family%d using 1:2 with lines lw 2 lc rgb '#555555' title 'threshold%s'",
                first ? "" : ", ", f, f, f, families > 1 ? ", by kind of grain" : "");
        first = false;
    }
    report_plot_outcomes(p.script, used, first);
    TRY(report_plot_end(&p));
    *drawn = true;
    return status_ok();
}

/* ---- the ranking ---- */

/* What ranks: expected gouges where the comparison counted them, else the threshold velocity. */
typedef struct {
    const char *key, *interval, *label;
} ranked_by;

static const ranked_by by_gouges = { "gouges", "gouges_interval", "expected gouges a shot, and 5 to 95 %" },
                       by_threshold = { "threshold_velocity", "threshold_interval", "threshold velocity [m/s]" };

/* gnuplot's own quotes would end a name. */
static void print_name(FILE *script, const char *name)
{
    for (; *name; name++) fputc(*name == '"' || *name == '\\' || (unsigned char)*name < ' ' ? ' ' : *name, script);
}

static int ranking_data(FILE *script, const cJSON *ranking, const ranked_by *by)
{
    int row = 0, n = 0;
    const cJSON *item;
    fputs("$ranking << EOD\n", script);
    cJSON_ArrayForEach(item, ranking)
    {
        const double x = report_number(item, by->key), lo = report_element(item, by->interval, 0),
                     hi = report_element(item, by->interval, 1);
        row++;
        fprintf(script, "%.7g %d %.7g %.7g \"", x, row, isnan(lo) ? x : lo, isnan(hi) ? x : hi);
        print_name(script, report_text(item, "surface"));
        fputs("\"\n", script);
        n += isfinite(x);
    }
    fputs("EOD\n", script);
    return n;
}

status report_plot_ranking(const report_source *r, bool *drawn)
{
    const cJSON *ranking = list_of(r, "ranking");
    const int n = cJSON_GetArraySize(ranking);
    *drawn = false;
    if (n == 0 || !r->gnuplot) return status_ok();
    const bool counted = cJSON_IsNumber(cJSON_GetObjectItemCaseSensitive(ranking->child, "gouges"));
    const ranked_by *by = counted ? &by_gouges : &by_threshold;
    plot p;
    TRY(report_plot_begin(&p, r, "ranking", 760, 90 + 36 * n));
    const bool any = ranking_data(p.script, ranking, by) > 0;
    fprintf(p.script, "unset key\nset xlabel '%s'\nset yrange [%d.5:0.5]\nset offsets 0, 0, 0, 0\n", by->label, n);
    if (counted) fputs("set xrange [0:*]\n", p.script);
    if (any)
        fputs("plot $ranking using 1:2:3:4:yticlabels(5) with xerrorbars pt 7 ps 0.9 lw 1.5 lc rgb '#1f5fa8'\n",
              p.script);
    TRY(report_plot_end(&p));
    *drawn = any;
    return status_ok();
}
