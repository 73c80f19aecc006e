/* SPDX-License-Identifier: BSD-3-Clause */
/* Probes of a scene of bodies: what each came to, all of one quantity over time in one plot, the last of every map. */
#include "coupling/report/report_gnuplot.h"
#include "coupling/report/report_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SCENE "/scene/scene"

static const cJSON *probes_of(const report_source *r)
{
    return cJSON_GetObjectItemCaseSensitive(r->summary, "probes");
}

/* ---- the table ---- */

static void probe_row(const page *p, const cJSON *probe)
{
    static const struct {
        const char *key;
        double unit;
    } numbers[] = { { "peak", 1.0 }, { "time_of_peak", 1e-6 }, { "arrival", 1e-6 }, { "least", 1.0 } };
    const char *texts[] = { probe->string, report_text(probe, "kind"), report_text(probe, "quantity"),
                            report_text(probe, "unit") };
    fputs("<tr>", p->out);
    for (int k = 0; k < PAGE_COUNT(texts); k++) {
        fputs("<td class=\"text\">", p->out);
        report_page_escaped(p->out, texts[k]);
        fputs("</td>", p->out);
    }
    for (int k = 0; k < PAGE_COUNT(numbers); k++) {
        fputs("<td>", p->out);
        report_page_number(p->out, report_number(probe, numbers[k].key), numbers[k].unit, "");
        fputs("</td>", p->out);
    }
    for (int k = 0; k < 3; k++) {
        fputs("<td>", p->out);
        report_page_number(p->out, report_element(probe, "impulse", k), 1.0, "");
        fputs("</td>", p->out);
    }
    fputs("</tr>\n", p->out);
}

static void probe_table(const page *p)
{
    const cJSON *probe;
    fputs(
        "<div class=\"wide\"><table><tr><th>probe</th><th>kind</th><th>quantity</th><th>unit</th><th>peak</th>"
        "<th>at [us]</th><th>arrival [us]</th><th>least</th><th colspan=\"3\">integral over time [unit s]</th></tr>\n",
        p->out);
    cJSON_ArrayForEach(probe, probes_of(p->source)) probe_row(p, probe);
    fputs("</table></div>\n", p->out);
}

/* ---- a quantity over time ---- */

/* Data block $probe<i>: the quantity, the size of a vector, over time in us; false where it has no series. */
static bool series_block(FILE *script, const report_source *r, const cJSON *probe, int i)
{
    static const char *const ends[2][3] = { { "" }, { "_x", "_y", "_z" } };
    const bool vector = isfinite(report_element(probe, "impulse", 2));
    double *t = NULL, *value[3] = { NULL };
    size_t n[H5_MAX_RANK] = { 0 }, m[H5_MAX_RANK];
    char path[400], name[24];
    snprintf(path, sizeof path, SCENE "/probes/%.120s/time", probe->string);
    bool whole = host_h5_read(r->history, path, &t, n).code == STATUS_OK && n[0] > 1;
    for (int k = 0; k < (vector ? 3 : 1) && whole; k++) {
        snprintf(path, sizeof path, SCENE "/probes/%.120s/%.80s%s", probe->string, report_text(probe, "quantity"),
                 ends[vector][k]);
        whole = host_h5_read(r->history, path, &value[k], m).code == STATUS_OK && m[0] == n[0];
    }
    for (size_t q = 0; whole && q < n[0]; q++) {
        t[q] *= 1e6;
        if (vector)
            value[0][q] = sqrt(value[0][q] * value[0][q] + value[1][q] * value[1][q] + value[2][q] * value[2][q]);
    }
    snprintf(name, sizeof name, "probe%d", i);
    if (whole) report_plot_data(script, name, t, value[0], n[0]);
    for (int k = 0; k < 3; k++) free(value[k]);
    free(t);
    return whole;
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
static status plot_quantity(const report_source *r, const cJSON *of, const char *name, bool *drawn)
{
    enum { MOST = 40 };
    const cJSON *shown[MOST], *probe;
    int n = 0;
    plot p;
    TRY(report_plot_begin(&p, r, name, 560, 380));
    cJSON_ArrayForEach(probe, probes_of(r))
    {
        if (n < MOST && same_quantity(probe, of) && series_block(p.script, r, probe, n)) shown[n++] = probe;
    }
    fprintf(p.script, "set xlabel 'time [us]'\nset ylabel '%s [%s]' noenhanced\nset format y '%%.3g'\nplot ",
            report_text(of, "quantity"), report_text(of, "unit"));
    for (int i = 0; i < n; i++)
        fprintf(p.script, "%s$probe%d with lines lw 1.5 title '%s' noenhanced", i ? ", " : "", i, shown[i]->string);
    fputs(n ? "\n" : "0 notitle\n", p.script);
    *drawn = n > 0;
    return report_plot_end(&p);
}

/* ---- the last of a map ---- */

typedef struct {
    char name[96], unit[32];
    double *last; /* [rows], owned */
    size_t distinct;
} map_column;

enum { MAP_COLUMNS = 3 };

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static size_t distinct_values(const double *x, size_t n)
{
    size_t count = n > 0;
    double *sorted = malloc((n ? n : 1) * sizeof *sorted);
    if (!sorted) return 0;
    memcpy(sorted, x, n * sizeof *x);
    qsort(sorted, n, sizeof *sorted, by_value);
    for (size_t i = 1; i < n; i++) count += sorted[i] != sorted[i - 1];
    free(sorted);
    return count;
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
        c->distinct = dims[0] > 0 ? distinct_values(all, dims[1]) : 0;
        n++;
    }
    free(names);
    return n;
}

/* The column that stands over the two others, whose values make a regular grid; -1: none does. */
static int value_column(const map_column c[MAP_COLUMNS], size_t rows)
{
    for (int k = 0; k < MAP_COLUMNS; k++)
        if (rows > 1 && c[(k + 1) % 3].distinct * c[(k + 2) % 3].distinct == rows) return k;
    return -1;
}

static void map_block(FILE *script, const map_column c[MAP_COLUMNS], int value, size_t rows)
{
    const map_column *x = &c[(value + 1) % 3], *y = &c[(value + 2) % 3], *z = &c[value];
    fputs("$map << EOD\n", script);
    for (size_t i = 0; i < rows; i++) {
        if (i > 0 && x->last[i] != x->last[i - 1] && y->last[i] != y->last[i - 1]) fputs("\n", script);
        fprintf(script, "%.6g %.6g ", 1e3 * x->last[i], 1e3 * y->last[i]);
        if (isfinite(z->last[i]))
            fprintf(script, "%.6g\n", 1e3 * z->last[i]);
        else
            fputs("NaN\n", script);
    }
    fputs("EOD\n", script);
    fprintf(script, "set xlabel '%s [mm]'\nset ylabel '%s [mm]'\nset cblabel '%s [mm]'\n", x->name, y->name, z->name);
}

/* Lengths all three, in mm; a map of another kind is not drawn. */
static status plot_map(const report_source *r, const cJSON *probe, const char *name, bool *drawn)
{
    map_column c[MAP_COLUMNS] = { { .last = NULL } };
    size_t rows = 0;
    status done = status_ok();
    const int n = read_map(r, probe->string, c, &rows), value = n == MAP_COLUMNS ? value_column(c, rows) : -1;
    bool lengths = true;
    for (int k = 0; k < n; k++) lengths = lengths && strcmp(c[k].unit, "m") == 0;
    if (value >= 0 && lengths) {
        plot p;
        done = report_plot_begin(&p, r, name, 560, 460);
        if (done.code == STATUS_OK) {
            map_block(p.script, c, value, rows);
            fprintf(p.script,
                    "set title '%s' noenhanced\nset size ratio -1\nset palette rgbformulae 33,13,10\n"
                    "plot $map using 1:2:3 with points pt 5 ps 0.3 palette notitle\n",
                    probe->string);
            done = report_plot_end(&p);
            *drawn = done.code == STATUS_OK;
        }
    }
    for (int k = 0; k < n; k++) free(c[k].last);
    return done;
}

/* ---- the section ---- */

static void draw(const page *p, const cJSON *probe, const char *name)
{
    bool drawn = false;
    const bool map = !report_text(probe, "quantity")[0];
    const status s = map ? plot_map(p->source, probe, name, &drawn) : plot_quantity(p->source, probe, name, &drawn);
    if (s.code != STATUS_OK)
        report_page_paragraph(p, "missing", s.text);
    else if (drawn)
        report_page_plot(p, name, "");
}

void report_section_probes(const page *p)
{
    const cJSON *probe, *list = probes_of(p->source);
    int n = 0;
    if (cJSON_GetArraySize(list) == 0) return;
    report_page_heading(p, "Probes");
    probe_table(p);
    if (!p->source->history || !p->source->gnuplot) return;
    fputs("<div class=\"plots\">\n", p->out);
    cJSON_ArrayForEach(probe, list)
    {
        char name[32];
        snprintf(name, sizeof name, "probe-%d", ++n);
        if (!report_text(probe, "quantity")[0] || is_first_of_quantity(list, probe)) draw(p, probe, name);
    }
    fputs("</div>\n", p->out);
}
