/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report.h"

#include "coupling/host/outdir.h"
#include "coupling/report/report_page.h"
#include "coupling/report/report_svg.h"

#include <cJSON.h>
#include <stdlib.h>
#include <string.h>

/* ---- the head ---- */

static void section_head(const page *p, report_kind of)
{
    const cJSON *s = p->source->summary;
    const char *state = report_text(s, "status");
    char title[REPORT_USED_SIZE];
    report_used_value(p->source, "", "title", title);
    fprintf(p->out, "<h1>");
    report_svg_escaped(p->out, report_text(s, "case"));
    fprintf(p->out, "</h1>\n<p class=\"sub\">");
    report_svg_escaped(p->out, title);
    fprintf(p->out, "%sbreech %s &middot; %s</p>\n", title[0] ? " &middot; " : "",
            of.command ? of.command : report_text(s, "kind"), state);
    if (strcmp(state, "done") != 0) {
        fputs("<p class=\"verdict\" style=\"border-color:#c0392b\">The run ", p->out);
        fputs(strcmp(state, "stopped") == 0 ? "was stopped early; breech --resume goes on with it. " : "failed. ",
              p->out);
        report_svg_escaped(p->out, report_text(s, "error"));
        fputs("</p>\n", p->out);
    }
    if (of.part.head) of.part.head(p);
}

/* ---- warnings, inputs, versions ---- */

static void section_rest(const page *p)
{
    const cJSON *warnings = cJSON_GetObjectItemCaseSensitive(p->source->summary, "warnings"), *item;
    fputs("<h2 id=\"warnings\">Warnings</h2>\n", p->out);
    if (cJSON_GetArraySize(warnings) == 0) report_page_paragraph(p, "reason", "none");
    fputs("<ul>\n", p->out);
    cJSON_ArrayForEach(item, warnings)
    {
        fputs("<li>", p->out);
        report_svg_escaped(p->out, cJSON_IsString(item) ? item->valuestring : "");
        fputs("</li>\n", p->out);
    }
    fputs("</ul>\n", p->out);
    report_page_heading(p, "Inputs");
    if (p->source->used) {
        fputs("<details><summary>used.yaml</summary><pre>", p->out);
        report_svg_escaped(p->out, p->source->used);
        fputs("</pre></details>\n", p->out);
    } else {
        report_page_paragraph(p, "missing", "used.yaml is not there");
    }
    report_page_heading(p, "Versions");
    fputs("<p>Breech ", p->out);
    report_svg_escaped(p->out, report_text(p->source->summary, "version"));
    fputs(", instruction set ", p->out);
    report_svg_escaped(p->out, report_text(p->source->summary, "instruction_set"));
    fputs(".</p>\n", p->out);
}

/* Tables: see report_table.h.  A screen's width and a sheet's count alike. */
static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:72rem;margin:0 auto;padding:1rem;"
    "overflow-wrap:anywhere}h1{margin:.2rem 0 0}h2{margin:2rem 0 .5rem;border-bottom:1px solid #ddd}"
    ".sub,figcaption,.reason,.missing,.legend{color:#666}.sub,.reason{margin:.2rem 0 .6rem}"
    ".verdict{font-size:1.25rem;border-left:.4rem solid;padding:.4rem .8rem;background:#f7f6f3}"
    ".cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(8.5rem,1fr));gap:.5rem;margin:.7rem 0}"
    ".card,.speed{border:1px solid #ddd;border-radius:.4rem;padding:.4rem .6rem}"
    ".card span,.speed span,small{display:block;color:#666;font-size:.8rem}"
    ".speeds,.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr));gap:.2rem 1.2rem}"
    ".speed{border-width:1px 1px 1px .4rem}.speed b{font-size:1.35rem;display:block;line-height:1.3}"
    ".columns h2{margin-top:1rem}ul{padding-left:1.2rem}"
    ".plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,21rem),1fr));gap:.5rem 1rem;"
    "align-items:start}figure{margin:.5rem 0;max-width:36rem}figure svg{display:block;width:100%;height:auto}"
    "figcaption{font-size:.85rem}.legend span{margin-right:.8rem}.legend i{display:inline-block;width:.8rem;"
    "height:.8rem;margin-right:.3rem}"
    "table{border-collapse:collapse;font-size:.85rem;margin:.5rem 0}th,td{padding:.15rem .5rem;text-align:right;"
    "vertical-align:top;border-bottom:1px solid #eee;overflow-wrap:break-word}"
    "th{color:#666;font-weight:600;vertical-align:bottom}"
    "td.text,th.text{text-align:left}pre{overflow-wrap:anywhere;white-space:pre-wrap;font-size:.8rem}"
    "@media(max-width:70rem){table.many{display:block}}@media(max-width:42rem){table.some{display:block}}"
    "@media(max-width:70rem){.many thead{display:none}.many tbody{display:block}"
    ".many tr{display:grid}.many td{display:block}}"
    "@media(max-width:42rem){.some thead{display:none}.some tbody{display:block}"
    ".some tr{display:grid}.some td{display:block}}"
    "@media(max-width:70rem){.many tr{grid-template-columns:repeat(auto-fill,minmax(6.3rem,1fr));border:1px solid #ddd;"
    "border-radius:.4rem;margin:.4rem 0;padding:.3rem}.many td{text-align:left;border:0}"
    ".many td:first-child{grid-column:1/-1;font-weight:600}"
    ".many td:first-child:not(.text)::before{content:attr(data-title) \" \";color:#666}"
    ".many td:not(:first-child)::before{content:attr(data-title);display:block;color:#666;font-size:.75rem}}"
    "@media(max-width:42rem){.some tr{grid-template-columns:repeat(auto-fill,minmax(6.3rem,1fr));border:1px solid #ddd;"
    "border-radius:.4rem;margin:.4rem 0;padding:.3rem}.some td{text-align:left;border:0}"
    ".some td:first-child{grid-column:1/-1;font-weight:600}"
    ".some td:first-child:not(.text)::before{content:attr(data-title) \" \";color:#666}"
    ".some td:not(:first-child)::before{content:attr(data-title);display:block;color:#666;font-size:.75rem}}"
    "@media print{body{max-width:none;font-size:10pt;padding:0}figure,.card,.speed,tr,.verdict{break-inside:avoid}"
    "h2,h3{break-after:avoid}table{font-size:8pt}.plots{grid-template-columns:1fr 1fr}details{display:none}}";

static void write_page(const page *p, report_kind of)
{
    const report_source *r = p->source;
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>",
          p->out);
    report_svg_escaped(p->out, report_text(r->summary, "case"));
    fprintf(p->out, " &ndash; Breech</title><style>%s</style></head><body>\n", style);
    section_head(p, of);
    if (!r->history) report_page_paragraph(p, "missing", "history.h5 is not there: no curves and no craters.");
    if (of.part.section) of.part.section(p);
    report_crater_sections(p);
    report_shot_section(p);
    report_shot_ledger(p);
    section_rest(p);
    fputs("</body></html>\n", p->out);
}

static status report_page(const report_source *r, report_kind of)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%s/%s", r->dir, OUTDIR_REPORT);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", r->dir);
    file_writer w;
    TRY(host_file_begin(&w, path));
    write_page(&(page){ r, w.stream }, of);
    return host_file_end(&w, true);
}

/* The files beside the summary may be missing; the page says so. */
static status report_with(const outdir *d, const cJSON *summary, report_kind of)
{
    char path[OUTDIR_PATH_SIZE], *used = NULL;
    h5_file *history = NULL;
    TRY(host_outdir_file(d, OUTDIR_HISTORY, path, sizeof path));
    if (host_file_exists(path)) TRY(host_h5_open(path, &history));
    if (host_outdir_file(d, OUTDIR_USED, path, sizeof path).code == STATUS_OK && host_file_exists(path))
        (void)host_file_read(path, &used, NULL);
    const report_source source = { d->path, summary, history, used };
    const status s = report_page(&source, of);
    host_h5_close(history);
    free(used);
    return s;
}

status report_write(const char *dir, report_kind (*kind_of)(const char *kind))
{
    outdir d = { .lock = -1 };
    const int n = snprintf(d.path, sizeof d.path, "%s", dir);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_BAD_INPUT, "%.300s: path too long", dir);
    char path[OUTDIR_PATH_SIZE], *text;
    TRY(host_outdir_file(&d, OUTDIR_SUMMARY, path, sizeof path));
    CHECK(host_file_exists(path), STATUS_BAD_INPUT, "%.300s: holds no %s; give the output directory of a run", dir,
          OUTDIR_SUMMARY);
    TRY(host_file_read(path, &text, NULL));
    cJSON *summary = cJSON_Parse(text);
    free(text);
    CHECK(summary, STATUS_BAD_INPUT, "%.300s: is no JSON", path);
    const char *kind = report_text(summary, "kind");
    const report_kind of = kind_of(kind);
    const status s = of.command
                         ? report_with(&d, summary, of)
                         : base_status_error(STATUS_BAD_INPUT, "%.300s: is no summary of a run: its `kind` %.40s%s",
                                             path, kind[0] ? kind : "is missing", kind[0] ? " is unknown" : "");
    cJSON_Delete(summary);
    return s;
}
