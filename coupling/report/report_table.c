/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_table.h"

#include "coupling/report/report_svg.h"
#include "coupling/report/report_value.h"

#include <string.h>

enum { FEW = 4, SOME = 10 }; /* columns that fit a phone, and a page of half a screen */

void report_table_begin(report_table *t, FILE *out)
{
    *t = (report_table){ .out = out, .at = -1 };
}

void report_table_title(report_table *t, const char *title, const char *unit)
{
    if (t->columns == REPORT_COLUMNS) return;
    if (unit[0] && strcmp(unit, "1") != 0)
        snprintf(t->title[t->columns++], REPORT_TITLE_SIZE, "%.80s [%.30s]", title, unit);
    else
        snprintf(t->title[t->columns++], REPORT_TITLE_SIZE, "%.110s", title);
}

void report_table_text_title(report_table *t, const char *title)
{
    if (t->columns < REPORT_COLUMNS) t->of_text[t->columns] = true;
    report_table_title(t, title, "");
}

/* A key such as scene.bodies[0].material may go on in the next line behind a dot and an underscore: long ones in the
 * head would push the last columns off the page. */
static void breakable(FILE *out, const char *title)
{
    char part[REPORT_TITLE_SIZE];
    while (*title) {
        const size_t n = strcspn(title, "._") + 1, whole = strlen(title);
        snprintf(part, sizeof part, "%.*s", (int)(n < whole ? n : whole), title);
        report_svg_escaped(out, part);
        title += strlen(part);
        if (*title) fputs("&#8203;", out);
    }
}

/* ---- rows ---- */

static void head(report_table *t)
{
    fprintf(t->out, "<table class=\"%s\"><thead><tr>",
            t->columns <= FEW    ? "few"
            : t->columns <= SOME ? "some"
                                 : "many");
    for (int k = 0; k < t->columns; k++) {
        fputs(t->of_text[k] ? "<th class=\"text\">" : "<th>", t->out);
        breakable(t->out, t->title[k]);
        fputs("</th>", t->out);
    }
    fputs("</tr></thead><tbody>", t->out);
}

void report_table_row(report_table *t)
{
    if (t->at < 0)
        head(t);
    else
        fputs("</tr>", t->out);
    fputs("\n<tr>", t->out);
    t->at = 0;
}

void report_table_end(report_table *t)
{
    if (t->at >= 0) fputs("</tr>\n</tbody></table>\n", t->out);
}

/* ---- cells ---- */

static bool open_cell(report_table *t, const char *class, const char *colour)
{
    if (t->at >= t->columns) return false;
    fprintf(t->out, "<td%s%s%s data-title=\"", class[0] ? " class=\"" : "", class, class[0] ? "\"" : "");
    breakable(t->out, t->title[t->at++]);
    fputs("\"", t->out);
    if (colour[0]) fprintf(t->out, " style=\"color:%s\"", colour);
    fputs(">", t->out);
    return true;
}

void report_table_coloured(report_table *t, const char *text, const char *colour)
{
    if (!open_cell(t, "text", colour)) return;
    report_svg_escaped(t->out, text);
    fputs("</td>", t->out);
}

void report_table_text(report_table *t, const char *text)
{
    report_table_coloured(t, text, "");
}

void report_table_html(report_table *t, const char *html)
{
    if (open_cell(t, "", "")) fprintf(t->out, "%s</td>", html);
}

void report_table_number(report_table *t, double x, double unit)
{
    char text[REPORT_VALUE_SIZE];
    report_value_plain(x / unit, text);
    report_table_html(t, text);
}

void report_table_interval(report_table *t, double x, double lo, double hi, double unit)
{
    char text[REPORT_VALUE_SIZE];
    report_value_interval(x / unit, lo / unit, hi / unit, text);
    report_table_html(t, text);
}
