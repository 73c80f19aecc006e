/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_page.h"

#include <math.h>
#include <string.h>

void report_page_escaped(FILE *out, const char *text)
{
    for (; *text; text++) {
        switch (*text) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        default: fputc(*text, out);
        }
    }
}

void report_page_heading(const page *p, const char *text)
{
    fprintf(p->out, "<h2>%s</h2>\n", text);
}

void report_page_paragraph(const page *p, const char *class, const char *text)
{
    fprintf(p->out, "<p class=\"%s\">", class);
    report_page_escaped(p->out, text);
    fputs("</p>\n", p->out);
}

/* "1.48e+03" is for machines: as many digits as people read. */
void report_page_number(FILE *out, double x, double unit, const char *name)
{
    if (!isfinite(x))
        fputs("&ndash;", out);
    else
        fprintf(out, "%.4g%s%s", x / unit, name[0] ? "&nbsp;" : "", name);
}

void report_page_cards(const page *p, const cJSON *object, const page_column *list, int n)
{
    fputs("<div class=\"cards\">\n", p->out);
    for (int i = 0; i < n; i++) {
        fprintf(p->out, "<div class=\"card\"><span>%s</span><b>", list[i].title);
        report_page_number(p->out, report_number(object, list[i].key), list[i].unit, list[i].name);
        fputs("</b></div>\n", p->out);
    }
    fputs("</div>\n", p->out);
}

static void table_head(const page *p, const page_column *list, int n)
{
    fputs("<div class=\"wide\"><table><tr>", p->out);
    for (int i = 0; i < n; i++)
        fprintf(p->out, "<th>%s%s%s%s</th>", list[i].title, list[i].name[0] ? " [" : "", list[i].name,
                list[i].name[0] ? "]" : "");
    fputs("</tr>\n", p->out);
}

static void table_value(FILE *out, const cJSON *value, double unit)
{
    if (cJSON_IsBool(value)) {
        fputs(cJSON_IsTrue(value) ? "yes" : "no", out);
    } else if (cJSON_IsArray(value)) {
        for (const cJSON *end = value->child; end; end = end->next) {
            report_page_number(out, cJSON_IsNumber(end) ? end->valuedouble : NAN, unit, "");
            if (end->next) fputs(" to ", out);
        }
    } else {
        report_page_number(out, cJSON_IsNumber(value) ? value->valuedouble : NAN, unit, "");
    }
}

/* A row of an object's values; texts that are outcomes get their colour. */
static void host_table_row(const page *p, const cJSON *object, const page_column *list, int n)
{
    fputs("<tr>", p->out);
    for (int i = 0; i < n; i++) {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, list[i].key);
        if (cJSON_IsString(value)) {
            fprintf(p->out, "<td class=\"text\" style=\"color:%s\">", report_colour(value->valuestring));
            report_page_escaped(p->out, value->valuestring);
        } else {
            fputs("<td>", p->out);
            table_value(p->out, value, list[i].unit);
        }
        fputs("</td>", p->out);
    }
    fputs("</tr>\n", p->out);
}

void report_page_list_table(const page *p, const cJSON *list, const page_column *columns, int n)
{
    if (cJSON_GetArraySize(list) == 0) return;
    table_head(p, columns, n);
    const cJSON *item;
    cJSON_ArrayForEach(item, list) host_table_row(p, item, columns, n);
    fputs("</table></div>\n", p->out);
}

void report_page_plot(const page *p, const char *name, const char *caption)
{
    fputs("<figure>", p->out);
    if (report_plot_inline(p->source, name, p->out).code != STATUS_OK)
        report_page_paragraph(p, "missing", "this plot could not be read back");
    if (caption[0]) fprintf(p->out, "<figcaption>%s</figcaption>", caption);
    fputs("</figure>\n", p->out);
}

void report_page_draw(const page *p, status (*draw)(const report_source *, bool *), const char *name,
                      const char *caption)
{
    bool drawn;
    const status s = draw(p->source, &drawn);
    if (drawn)
        report_page_plot(p, name, caption);
    else if (s.code != STATUS_OK)
        report_page_paragraph(p, "missing", s.text);
}

void report_page_listed(const page *p, const char *key, const char *title, const page_column *columns, int n)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(p->source->summary, key);
    if (cJSON_GetArraySize(list) == 0) return;
    report_page_heading(p, title);
    report_page_list_table(p, list, columns, n);
}

bool report_page_is_done(const page *p)
{
    return strcmp(report_text(p->source->summary, "status"), "done") == 0;
}
