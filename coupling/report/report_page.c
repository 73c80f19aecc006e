/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_page.h"

#include "coupling/host/outdir.h"
#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char report_gouge_band[] = "#e58a7f", report_scratch_band[] = "#e0b84c", report_blue[] = "#1f5fa8",
           report_red[] = "#c0392b", report_grey[] = "#777777";

const char *report_colour(const char *outcome)
{
    static const struct {
        const char *outcome, *colour;
    } colours[] = { { "gouge", "#c0392b" },     { "scratch", "#b07a00" }, { "none", "#3d8b4f" },
                    { "undecided", "#7b5ea7" }, { "skipped", "#5c8db5" }, { "not_reached", "#8a8a8a" },
                    { "pierced", "#c0392b" },   { "torn", "#c0392b" },    { "stopped", "#3d8b4f" },
                    { "rebound", "#3d8b4f" },   { "bulged", "#b07a00" },  { "unfinished", "#7b5ea7" } };
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        if (strcmp(colours[i].outcome, outcome) == 0) return colours[i].colour;
    return "#555555";
}

const char *report_shade(int k)
{
    static const char *const shades[] = { "#1f5fa8", "#c0392b", "#3d8b4f", "#7a4a1e", "#7b5ea7",
                                          "#d99a00", "#2a9d8f", "#b04a8a", "#5f6f2a", "#444444" };
    return shades[k % PAGE_COUNT(shades)];
}

const cJSON *report_page_list(const page *p, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(p->source->summary, key);
}

bool report_page_is_done(const page *p)
{
    return strcmp(report_text(p->source->summary, "status"), "done") == 0;
}

/* ---- text ---- */

void report_page_heading(const page *p, const char *text)
{
    fprintf(p->out, "<h2>%s</h2>\n", text);
}

void report_page_paragraph(const page *p, const char *class, const char *text)
{
    fprintf(p->out, class[0] ? "<p class=\"%s\">" : "<p>", class);
    report_svg_escaped(p->out, text);
    fputs("</p>\n", p->out);
}

static void write_ranked(FILE *out, const page_ranking *of, const cJSON *entry)
{
    fputs("<li><b>", out);
    report_svg_escaped(out, report_text(entry, of->name));
    fputs("</b>", out);
    of->line(out, entry);
    fputs(".</li>\n", out);
}

void report_page_ranking(const page *p, const page_ranking *of)
{
    const cJSON *ranking = report_page_list(p, "ranking"), *entry;
    if (!report_page_is_done(p) || cJSON_GetArraySize(ranking) == 0) return;
    const cJSON *best = ranking->child;
    int tied = 0;
    cJSON_ArrayForEach(entry, ranking) tied += report_number(entry, "tied") == report_number(best, "tied");
    fputs("<p class=\"verdict\">", p->out);
    if (tied > 1) {
        fprintf(p->out, "The best %d %s", tied, of->tied);
    } else {
        fprintf(p->out, "%s <b>", of->best);
        report_svg_escaped(p->out, report_text(best, of->name));
        fputs("</b>", p->out);
    }
    fputs(".</p>\n<ul>\n", p->out);
    write_ranked(p->out, of, best);
    cJSON_ArrayForEach(entry, ranking)
    {
        if (entry != best && strcmp(report_text(entry, of->name), of->reference) == 0) write_ranked(p->out, of, entry);
    }
    fputs("</ul>\n", p->out);
}

void report_page_number(FILE *out, double x, double unit, const char *name)
{
    report_page_interval(out, x, NAN, NAN, unit, name);
}

void report_page_interval(FILE *out, double x, double lo, double hi, double unit, const char *name)
{
    char text[REPORT_VALUE_SIZE];
    report_value_interval(x / unit, lo / unit, hi / unit, text);
    fprintf(out, "%s%s%s", text, name[0] ? "&nbsp;" : "", name);
}

void report_page_cards(const page *p, const cJSON *object, const page_column *list, int n)
{
    int shown = 0;
    for (int i = 0; i < n; i++) {
        const double x = report_number(object, list[i].key),
                     lo = list[i].interval ? report_element(object, list[i].interval, 0) : NAN,
                     hi = list[i].interval ? report_element(object, list[i].interval, 1) : NAN;
        if (!isfinite(x) && !isfinite(lo) && !isfinite(hi)) continue;
        if (shown++ == 0) fputs("<div class=\"cards\">\n", p->out);
        fprintf(p->out, "<div class=\"card\"><span>%s</span><b>", list[i].title);
        report_page_interval(p->out, x, lo, hi, list[i].unit, list[i].name);
        fputs("</b></div>\n", p->out);
    }
    if (shown) fputs("</div>\n", p->out);
}

/* ---- lists as tables ---- */

static bool has_value(const cJSON *object, const page_column *column)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, column->key);
    if (cJSON_IsString(value)) return value->valuestring[0] != '\0';
    if (cJSON_IsNumber(value) || cJSON_IsBool(value)) return true;
    const char *vector = column->interval ? column->interval : column->key;
    return isfinite(report_element(object, vector, 0)) || isfinite(report_element(object, vector, 1));
}

static bool in_some_row(const cJSON *list, const page_column *column)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        if (has_value(item, column)) return true;
    }
    return false;
}

static bool is_text(const cJSON *list, const page_column *column)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(item, column->key);
        if (cJSON_IsString(value) || cJSON_IsBool(value)) return true;
    }
    return false;
}

static void add_cell(report_table *t, const cJSON *object, const page_column *column)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, column->key);
    const char *interval = column->interval ? column->interval : column->key;
    if (cJSON_IsString(value))
        report_table_coloured(t, value->valuestring, report_colour(value->valuestring));
    else if (cJSON_IsBool(value))
        report_table_text(t, cJSON_IsTrue(value) ? "yes" : "no");
    else
        report_table_interval(t, report_number(object, column->key), report_element(object, interval, 0),
                              report_element(object, interval, 1), column->unit);
}

void report_page_list_table(const page *p, const cJSON *list, const page_column *columns, int n)
{
    report_table t;
    const cJSON *item;
    bool shown[REPORT_COLUMNS];
    report_table_begin(&t, p->out);
    for (int i = 0; i < n; i++) {
        shown[i] = in_some_row(list, &columns[i]);
        if (!shown[i]) continue;
        if (is_text(list, &columns[i]))
            report_table_text_title(&t, columns[i].title);
        else
            report_table_title(&t, columns[i].title, columns[i].name);
    }
    cJSON_ArrayForEach(item, list)
    {
        report_table_row(&t);
        for (int i = 0; i < n; i++)
            if (shown[i]) add_cell(&t, item, &columns[i]);
    }
    report_table_end(&t);
}

void report_page_listed(const page *p, const char *key, const char *title, const page_column *columns, int n)
{
    const cJSON *list = report_page_list(p, key);
    if (cJSON_GetArraySize(list) == 0) return;
    report_page_heading(p, title);
    report_page_list_table(p, list, columns, n);
}

/* ---- drawings ---- */

void report_page_plots_begin(const page *p)
{
    fputs("<div class=\"plots\">\n", p->out);
}

void report_page_plots_end(const page *p)
{
    fputs("</div>\n", p->out);
}

void report_page_svg(const page *p, const char *name, const char *caption, char *svg)
{
    char path[OUTDIR_PATH_SIZE];
    if (!svg) return;
    const int n = snprintf(path, sizeof path, "%.900s/plot-%.110s.svg", p->source->dir, name);
    const bool written = n > 0 && n < OUTDIR_PATH_SIZE && host_file_write(path, svg, strlen(svg)).code == STATUS_OK;
    fprintf(p->out, "<figure>%s", svg);
    if (caption[0]) {
        fputs("<figcaption>", p->out);
        report_svg_escaped(p->out, caption);
        fputs("</figcaption>", p->out);
    }
    fputs("</figure>\n", p->out);
    if (!written) report_page_paragraph(p, "missing", "The file of this plot could not be written.");
    free(svg);
}

void report_page_chart(const page *p, const char *name, const char *caption, report_chart *c)
{
    report_page_svg(p, name, caption, report_chart_svg(c, name));
}

/* ---- curves of the history ---- */

report_curve report_curve_read(const report_source *r, const char *x, const char *y)
{
    report_curve c = { NULL, NULL, 0 };
    size_t a[H5_MAX_RANK], b[H5_MAX_RANK];
    if (!r->history || host_h5_read(r->history, x, &c.x, a).code != STATUS_OK) return c;
    if (host_h5_read(r->history, y, &c.y, b).code == STATUS_OK) c.n = a[0] < b[0] ? a[0] : b[0];
    return c;
}

report_curve report_curve_size(const report_source *r, const char *x, const char *y)
{
    report_curve part[3];
    bool whole = true;
    for (int k = 0; k < 3; k++) {
        char path[500];
        snprintf(path, sizeof path, "%.480s_%c", y, "xyz"[k]);
        part[k] = report_curve_read(r, x, path);
        whole = whole && part[k].n > 0 && part[k].n == part[0].n;
    }
    for (size_t i = 0; whole && i < part[0].n; i++)
        part[0].y[i] = sqrt(part[0].y[i] * part[0].y[i] + part[1].y[i] * part[1].y[i] + part[2].y[i] * part[2].y[i]);
    for (int k = whole ? 1 : 0; k < 3; k++) report_curve_free(&part[k]);
    return part[0];
}

void report_curve_free(report_curve *c)
{
    free(c->x);
    free(c->y);
    *c = (report_curve){ NULL, NULL, 0 };
}

size_t report_curve_until(const report_curve *c, double x)
{
    size_t n = 0;
    while (n < c->n && c->x[n] <= x) n++;
    return n;
}

double report_curve_at(const report_curve *c, double x)
{
    const size_t n = report_curve_until(c, x);
    if (n == 0 || (n == c->n && c->x[n - 1] < x)) return NAN;
    if (n == c->n) return c->y[n - 1];
    const double part = (x - c->x[n - 1]) / (c->x[n] - c->x[n - 1]);
    return c->y[n - 1] + part * (c->y[n] - c->y[n - 1]);
}

/* ---- what the case said ---- */

/* The line of a section that says `key: value`, up to its end; a section ends where a line is not indented. */
static const char *value_in(const char *text, const char *section, const char *key)
{
    const size_t m = strlen(section), n = strlen(key);
    bool inside = section[0] == '\0';
    for (const char *line = text, *end; line && *line; line = end ? end + 1 : NULL) {
        end = strchr(line, '\n');
        const char *word = line + strspn(line, " ");
        if (word == line && section[0]) inside = strncmp(line, section, m) == 0 && line[m] == ':';
        if (inside && (word > line) == (section[0] != '\0') && strncmp(word, key, n) == 0 && word[n] == ':')
            return word + n + 1;
    }
    return NULL;
}

void report_used_value(const report_source *r, const char *section, const char *key, char out[REPORT_USED_SIZE])
{
    const char *value = r->used ? value_in(r->used, section, key) : NULL;
    size_t n = 0;
    if (value) {
        value += strspn(value, " \"");
        for (; value[n] && value[n] != '\n' && value[n] != '"' && n + 1 < REPORT_USED_SIZE; n++) out[n] = value[n];
    }
    out[n] = '\0';
}
