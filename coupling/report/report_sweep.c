/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of a sweep: a table of its runs; every output over the first varied key that is a number; where a
 * resolution is varied, the errors over the time they take. */
#include "coupling/report/report_page.h"

#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const cJSON *member(const cJSON *object, const char *key)
{
    return cJSON_GetObjectItemCaseSensitive(object, key);
}

/* The first entry of an object of a run; NULL of a summary that was changed by hand and has none there. */
static const cJSON *first_of(const cJSON *run, const char *object)
{
    const cJSON *of = member(run, object);
    return cJSON_IsObject(of) ? of->child : NULL;
}

static const char *unit_of(const page *p, const char *key)
{
    return report_text(report_page_list(p, "units"), key);
}

/* ---- the head ---- */

void report_sweep_head(const page *p)
{
    const cJSON *runs = report_page_list(p, "sweep"), *item;
    const char *of = report_text(p->source->summary, "of"); /* a scene of bodies is a scene's command, too */
    const int n = cJSON_GetArraySize(runs);
    int k = 0;
    if (!report_page_is_done(p) || n == 0) return;
    fprintf(p->out, "<p class=\"verdict\">%d runs of <code>breech ", n);
    report_svg_escaped(p->out, strcmp(of, "bodies") == 0 || strcmp(of, "ensemble") == 0 ? "scene" : of);
    fputs("</code> that differ in ", p->out);
    for (item = first_of(runs->child, "inputs"); item; item = item->next) {
        fputs(k++ ? ", <code>" : "<code>", p->out);
        report_svg_escaped(p->out, item->string);
        fputs("</code>", p->out);
    }
    fputs(".</p>\n", p->out);
}

/* ---- the table ---- */

/* A column of numbers: of an object of the runs, or of the run itself where object is NULL. */
typedef struct {
    const char *object, *key;
    double factor; /* of its unit, with the prefix that its largest number asks for */
} run_column;

static const cJSON *value_of(const cJSON *run, const run_column *c)
{
    return member(c->object ? member(run, c->object) : run, c->key);
}

static void add_column(const page *p, report_table *t, run_column *c, const char *unit)
{
    const cJSON *run;
    double largest = 0.0;
    bool text = false;
    char with_prefix[60];
    cJSON_ArrayForEach(run, report_page_list(p, "sweep"))
    {
        const cJSON *value = value_of(run, c);
        if (cJSON_IsNumber(value)) largest = fmax(largest, fabs(value->valuedouble));
        text = text || cJSON_IsString(value);
    }
    const char *prefix = report_chart_prefix(largest, unit, &c->factor);
    snprintf(with_prefix, sizeof with_prefix, "%s%.40s", prefix, unit);
    if (text)
        report_table_text_title(t, c->key);
    else
        report_table_title(t, c->key, with_prefix);
}

/* A run a row: its inputs, the object `what`, its time. */
static void run_table(const page *p, const char *what)
{
    const cJSON *run, *item, *runs = report_page_list(p, "sweep");
    const bool errors = strcmp(what, "errors") == 0;
    run_column column[REPORT_COLUMNS];
    int n = 0;
    report_table t;
    report_table_begin(&t, p->out);
    for (item = first_of(runs->child, "inputs"); item; item = item->next) {
        if (n == REPORT_COLUMNS - 1) break;
        column[n] = (run_column){ "inputs", item->string, 1.0 };
        add_column(p, &t, &column[n++], unit_of(p, item->string));
    }
    for (item = first_of(runs->child, what); item; item = item->next) {
        if (n == REPORT_COLUMNS - 1) break;
        column[n] = (run_column){ what, item->string, 1.0 };
        add_column(p, &t, &column[n++], errors ? "" : unit_of(p, item->string));
    }
    column[n] = (run_column){ NULL, "wall_seconds", 1.0 };
    report_table_title(&t, "time", "s");
    cJSON_ArrayForEach(run, runs)
    {
        report_table_row(&t);
        for (int k = 0; k <= n; k++) {
            const cJSON *value = value_of(run, &column[k]);
            if (cJSON_IsString(value))
                report_table_text(&t, value->valuestring);
            else
                report_table_number(&t, cJSON_IsNumber(value) ? value->valuedouble : NAN, column[k].factor);
        }
    }
    report_table_end(&t);
}

/* ---- charts ---- */

/* The input that outputs are drawn over: the first that is a number, else the first. */
static const cJSON *drawn_over(const cJSON *run)
{
    const cJSON *first = first_of(run, "inputs");
    for (const cJSON *input = first; input; input = input->next)
        if (cJSON_IsNumber(input)) return input;
    return first;
}

/* What is drawn over what: y a key of an object of the run; x its time, or that input. */
typedef struct {
    const char *object, *key;
    bool over_time;
} drawn;

static double x_of(const cJSON *run, const drawn *d)
{
    const cJSON *x = d->over_time ? member(run, "wall_seconds") : drawn_over(run);
    return cJSON_IsNumber(x) ? x->valuedouble : NAN;
}

static bool same_others(const cJSON *a, const cJSON *b)
{
    const cJSON *x = first_of(a, "inputs"), *y = first_of(b, "inputs");
    for (; x && y; x = x->next, y = y->next)
        if (x != drawn_over(a) && !cJSON_Compare(x, y, true)) return false;
    return true;
}

/* What sets a curve apart from the others: its further inputs. */
static void curve_name(const page *p, const cJSON *run, char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    for (const cJSON *x = first_of(run, "inputs"); x && used + 1 < size; x = x->next) {
        if (x == drawn_over(run)) continue;
        const char *key = strrchr(x->string, '.');
        char value[REPORT_USED_SIZE];
        if (cJSON_IsNumber(x))
            snprintf(value, sizeof value, "%.4g %.30s", x->valuedouble,
                     strcmp(unit_of(p, x->string), "1") ? unit_of(p, x->string) : "");
        else
            snprintf(value, sizeof value, "%s", x->valuestring ? x->valuestring : "");
        used +=
            (size_t)snprintf(out + used, size - used, "%s%s %s", used ? ", " : "", key ? key + 1 : x->string, value);
    }
}

/* The runs whose other inputs are those of `alike`, in their order. */
static void add_curve(const page *p, report_chart *c, const cJSON *alike, const drawn *d, int k)
{
    const cJSON *run, *runs = report_page_list(p, "sweep");
    const size_t most = (size_t)cJSON_GetArraySize(runs) + 1;
    double *x = malloc(most * sizeof *x), *y = malloc(most * sizeof *y);
    char name[96];
    size_t n = 0;
    cJSON_ArrayForEach(run, runs)
    {
        if (!x || !y || !same_others(alike, run)) continue;
        x[n] = x_of(run, d);
        y[n] = report_number(member(run, d->object), d->key);
        n += isfinite(x[n]) && isfinite(y[n]) && (!d->over_time || y[n] > 0.0);
    }
    curve_name(p, alike, name, sizeof name);
    if (n > 0) {
        report_chart_line(c, "", report_shade(k), x, y, n);
        report_chart_dots(c, name, report_shade(k), x, y, n);
    }
    free(x);
    free(y);
}

static void draw_curves(const page *p, const char *name, const drawn *d)
{
    enum { MOST = 12 };
    const cJSON *run, *runs = report_page_list(p, "sweep"), *first[MOST];
    const cJSON *input = drawn_over(runs->child);
    int n = 0;
    if (!input) return;
    char label[120];
    snprintf(label, sizeof label, d->over_time ? "error of %.90s" : "%.90s", d->key);
    report_chart *c = report_chart_create(
        d->over_time ? (report_axis){ .label = "time of the run", .unit = "s", .log = true, .fixed = true }
                     : (report_axis){ .label = input->string, .unit = unit_of(p, input->string) },
        (report_axis){ .label = label, .unit = d->over_time ? "" : unit_of(p, d->key), .log = d->over_time });
    cJSON_ArrayForEach(run, runs)
    {
        int k = 0;
        while (k < n && !same_others(first[k], run)) k++;
        if (k < n || n == MOST) continue;
        first[n] = run;
        add_curve(p, c, run, d, n++);
    }
    report_page_chart(p, name, "", c);
}

static void draw_all(const page *p, const char *object, bool over_time, const char *prefix)
{
    enum { MOST_CHARTS = 8 };
    const cJSON *item;
    int n = 0;
    report_page_plots_begin(p);
    for (item = first_of(report_page_list(p, "sweep")->child, object); item; item = item->next) {
        char name[32];
        if (n++ == MOST_CHARTS) break;
        snprintf(name, sizeof name, "%s-%d", prefix, n);
        draw_curves(p, name, &(drawn){ object, item->string, over_time });
    }
    report_page_plots_end(p);
}

void report_sweep_section(const page *p)
{
    if (cJSON_GetArraySize(report_page_list(p, "sweep")) == 0) return;
    report_page_heading(p, "The runs");
    run_table(p, "outputs");
    draw_all(p, "outputs", false, "sweep");
    if (!report_text(p->source->summary, "resolution")[0]) return;
    report_page_heading(p, "Error against run time");
    report_page_paragraph(p, "reason", "Against the finest run of the same other inputs.");
    draw_all(p, "errors", true, "error");
    run_table(p, "errors");
}
