/* SPDX-License-Identifier: BSD-3-Clause */
/* Probes of a scene of bodies: what each came to, all of one quantity over time in one chart, the last of every map. */
#include "coupling/report/report_page.h"

#include "coupling/host/numbers.h"
#include "coupling/output/summary.h"
#include "coupling/report/report_relief.h"
#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SCENE "/scene/scene"

static const cJSON *probes_of(const page *p)
{
    return report_page_list(p, "probes");
}

/* ---- the table ---- */

/* As report_svg_escaped writes it. */
static void escape(const char *text, char *out, size_t size)
{
    memset(out, 0, size);
    FILE *f = fmemopen(out, size - 1, "w");
    if (!f) return;
    report_svg_escaped(f, text);
    fclose(f);
}

/* A number of the probe's unit with the prefix that reads well. */
static void add_quantity(report_table *t, double x, const char *unit)
{
    double factor;
    char value[REPORT_VALUE_SIZE], html[200], text[REPORT_VALUE_SIZE + sizeof html + 20];
    const char *prefix = report_chart_prefix(fabs(x), unit, &factor);
    report_value_plain(x / factor, value);
    escape(isfinite(x) && strcmp(unit, "1") != 0 ? unit : "", html, sizeof html);
    snprintf(text, sizeof text, "%.60s%s%s%s", value, isfinite(x) ? "&nbsp;" : "", isfinite(x) ? prefix : "", html);
    report_table_html(t, text);
}

/* The integral over time: of a vector its size. */
static double integral_of(const cJSON *probe)
{
    const double x = report_element(probe, "impulse", 0), y = report_element(probe, "impulse", 1),
                 z = report_element(probe, "impulse", 2);
    return isfinite(y) && isfinite(z) ? sqrt(x * x + y * y + z * z) : x;
}

static void probe_row(report_table *t, const cJSON *probe)
{
    const char *unit = report_text(probe, "unit"), *over_time = output_unit_over_time(unit);
    report_table_row(t);
    report_table_text(t, probe->string);
    report_table_text(t, report_text(probe, "kind"));
    report_table_text(t, report_text(probe, "quantity")[0] ? report_text(probe, "quantity") : "a map");
    add_quantity(t, report_number(probe, "peak"), unit);
    report_table_number(t, report_number(probe, "time_of_peak"), 1e-6);
    report_table_number(t, report_number(probe, "arrival"), 1e-6);
    add_quantity(t, report_number(probe, "least"), unit);
    add_quantity(t, over_time ? integral_of(probe) : NAN, over_time ? over_time : "");
}

static void probe_table(const page *p)
{
    static const char *const titles[] = { "peak",  "at [\302\265s]",     "arrives [\302\265s]",
                                          "least", "integral over time", NULL };
    const cJSON *probe;
    report_table t;
    report_table_begin(&t, p->out);
    report_table_text_title(&t, "probe");
    report_table_text_title(&t, "kind");
    report_table_text_title(&t, "quantity");
    for (int k = 0; titles[k]; k++) report_table_title(&t, titles[k], "");
    cJSON_ArrayForEach(probe, probes_of(p)) probe_row(&t, probe);
    report_table_end(&t);
}

/* ---- a quantity over time ---- */

/* The quantity, the size of a vector, over time. */
static void add_series(report_chart *c, const report_source *r, const cJSON *probe, int k)
{
    const bool vector = isfinite(report_element(probe, "impulse", 2));
    char time[200], path[400];
    snprintf(time, sizeof time, SCENE "/probes/%.120s/time", probe->string);
    snprintf(path, sizeof path, SCENE "/probes/%.120s/%.80s", probe->string, report_text(probe, "quantity"));
    report_curve curve = vector ? report_curve_size(r, time, path) : report_curve_read(r, time, path);
    if (curve.n > 1) report_chart_line(c, probe->string, report_shade(k), curve.x, curve.y, curve.n);
    report_curve_free(&curve);
}

static bool same_quantity(const cJSON *a, const cJSON *b)
{
    return strcmp(report_text(a, "quantity"), report_text(b, "quantity")) == 0 &&
           strcmp(report_text(a, "unit"), report_text(b, "unit")) == 0;
}

static bool is_first_of_quantity(const cJSON *list, const cJSON *probe)
{
    for (const cJSON *other = list->child; other != probe; other = other->next)
        if (same_quantity(other, probe)) return false;
    return report_text(probe, "quantity")[0] != '\0';
}

/* All probes of the quantity of this one. */
static void draw_quantity(const page *p, const cJSON *of, const char *name)
{
    enum { MOST = 40 };
    const cJSON *probe;
    int n = 0;
    report_chart *c =
        report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                            (report_axis){ .label = report_text(of, "quantity"), .unit = report_text(of, "unit") });
    cJSON_ArrayForEach(probe, probes_of(p))
    {
        if (n < MOST && same_quantity(probe, of)) add_series(c, p->source, probe, n++);
    }
    report_page_chart(p, name, "", c);
}

/* ---- the last of a map ---- */

typedef struct {
    char name[96], unit[32];
    double *last; /* [rows], owned */
    double *distinct;
    size_t n; /* distinct values, rising, owned */
} map_column;

enum { MAP_COLUMNS = 3 };

static void find_distinct(map_column *c, size_t rows)
{
    c->distinct = malloc((rows ? rows : 1) * sizeof *c->distinct);
    if (!c->distinct || rows == 0) return;
    memcpy(c->distinct, c->last, rows * sizeof *c->distinct);
    qsort(c->distinct, rows, sizeof *c->distinct, host_number_order);
    c->n = 1;
    for (size_t i = 1; i < rows; i++)
        if (c->distinct[i] != c->distinct[c->n - 1]) c->distinct[c->n++] = c->distinct[i];
}

/* The last row of each of the first columns; how many there are. */
static int read_map(const report_source *r, const char *probe, map_column column[MAP_COLUMNS], size_t *rows)
{
    char group[200], path[320], *names = NULL;
    int n = 0;
    snprintf(group, sizeof group, SCENE "/probes/%.120s", probe);
    if (host_h5_list(r->history, group, &names).code != STATUS_OK) return 0;
    for (char *at = names, *end; n < MAP_COLUMNS && (end = strchr(at, '\n')); at = end + 1) {
        map_column *c = &column[n];
        double *all;
        size_t dims[H5_MAX_RANK];
        snprintf(c->name, sizeof c->name, "%.*s", (int)(end - at), at);
        if (strcmp(c->name, "time") == 0) continue;
        snprintf(path, sizeof path, "%s/%.90s", group, c->name);
        if (host_h5_read(r->history, path, &all, dims).code != STATUS_OK) continue;
        if (host_h5_read_attribute_text(r->history, path, "units", c->unit, sizeof c->unit).code != STATUS_OK)
            c->unit[0] = '\0';
        *rows = dims[1];
        if (dims[0] > 0) memmove(all, all + (dims[0] - 1) * dims[1], dims[1] * sizeof *all);
        c->last = all;
        if (dims[0] > 0) find_distinct(c, dims[1]);
        n++;
    }
    free(names);
    return n;
}

/* The column that stands over the two others, whose values make a regular grid; -1: none does. */
static int value_column(const map_column c[MAP_COLUMNS], size_t rows)
{
    for (int k = 0; k < MAP_COLUMNS; k++)
        if (rows > 4 && c[(k + 1) % 3].n > 1 && c[(k + 2) % 3].n > 1 && c[(k + 1) % 3].n * c[(k + 2) % 3].n == rows)
            return k;
    return -1;
}

static size_t index_of(const map_column *c, double value)
{
    const double *at = bsearch(&value, c->distinct, c->n, sizeof value, host_number_order);
    return at ? (size_t)(at - c->distinct) : 0;
}

/* Heights above their median, so that what has not moved is pale. */
static double *grid_of(const map_column *x, const map_column *y, const map_column *z, size_t rows, double *middle)
{
    double *grid = malloc(rows * sizeof *grid);
    size_t n = 0;
    if (!grid) return NULL;
    for (size_t i = 0; i < rows; i++)
        if (isfinite(z->last[i])) grid[n++] = z->last[i];
    qsort(grid, n, sizeof *grid, host_number_order);
    *middle = n > 0 ? grid[n / 2] : 0.0;
    for (size_t i = 0; i < rows; i++)
        grid[index_of(x, x->last[i]) * y->n + index_of(y, y->last[i])] =
            isfinite(z->last[i]) ? z->last[i] - *middle : 0.0;
    return grid;
}

static void draw_grid(const page *p, const cJSON *probe, const char *name, const map_column c[MAP_COLUMNS], int value,
                      size_t rows)
{
    const map_column *x = &c[(value + 1) % 3], *y = &c[(value + 2) % 3], *z = &c[value];
    double middle, range = 0.0;
    char caption[400], text[REPORT_VALUE_SIZE];
    double *grid = grid_of(x, y, z, rows, &middle);
    if (!grid) return;
    for (size_t i = 0; i < rows; i++) range = fmax(range, fabs(grid[i]));
    const report_relief relief = { .height = grid,
                                   .nx = x->n,
                                   .ny = y->n,
                                   .x0 = x->distinct[0],
                                   .dx = (x->distinct[x->n - 1] - x->distinct[0]) / (double)(x->n - 1),
                                   .y0 = y->distinct[0],
                                   .dy = (y->distinct[y->n - 1] - y->distinct[0]) / (double)(y->n - 1),
                                   .colour_range = fmax(range, 1e-9),
                                   .unit = 1e-3,
                                   .legend = "against the median [mm]",
                                   .above = "" };
    report_value_plain(1e3 * middle, text);
    snprintf(caption, sizeof caption,
             "The last of %.60s: %.40s over %.40s (to the right) and %.40s, against its median, %.60s mm.",
             probe->string, z->name, x->name, y->name, text);
    report_page_svg(p, name, caption, report_relief_map(&relief, probe->string));
    free(grid);
}

/* Lengths all three; a map of another kind is not drawn. */
static void draw_map(const page *p, const cJSON *probe, const char *name)
{
    map_column c[MAP_COLUMNS] = { { .last = NULL } };
    size_t rows = 0;
    const int n = read_map(p->source, probe->string, c, &rows), value = n == MAP_COLUMNS ? value_column(c, rows) : -1;
    bool lengths = true;
    for (int k = 0; k < n; k++) lengths = lengths && strcmp(c[k].unit, "m") == 0;
    if (value >= 0 && lengths) draw_grid(p, probe, name, c, value, rows);
    for (int k = 0; k < n; k++) {
        free(c[k].last);
        free(c[k].distinct);
    }
}

/* ---- the section ---- */

void report_probes_section(const page *p)
{
    const cJSON *probe, *list = probes_of(p);
    int n = 0;
    if (cJSON_GetArraySize(list) == 0) return;
    report_page_heading(p, "Probes");
    probe_table(p);
    if (!p->source->history) return;
    report_page_plots_begin(p);
    cJSON_ArrayForEach(probe, list)
    {
        char name[32];
        snprintf(name, sizeof name, "probe-%d", ++n);
        if (!report_text(probe, "quantity")[0])
            draw_map(p, probe, name);
        else if (is_first_of_quantity(list, probe))
            draw_quantity(p, probe, name);
    }
    report_page_plots_end(p);
}
