/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report.h"

#include "coupling/host/outdir.h"
#include "coupling/report/report_page.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CRATERS = 24 };

/* ---- verdict ---- */

/* clang-format off */
static const page_column shot_cards[] = { { "peak_current", "peak current", 1e3, "kA" },
                                    { "muzzle_velocity", "muzzle velocity", 1.0, "m/s" },
                                    { "muzzle_time", "muzzle time", 1e-3, "ms" },
                                    { "muzzle_energy", "muzzle energy", 1e3, "kJ" },
                                    { "efficiency", "efficiency", 0.01, "%" },
                                    { "peak_acceleration", "peak acceleration", 9806.65, "&times; 1000 g" },
                                    { "exit_current", "exit current", 1e3, "kA" },
                                    { "energy_error", "energy error", 1.0, "" } };
/* clang-format on */

void report_shot_verdict(const page *p)
{
    report_page_cards(p, p->source->summary, shot_cards, PAGE_COUNT(shot_cards));
}

static void section_verdict(const page *p, report_part part)
{
    const cJSON *s = p->source->summary;
    const char *kind = report_text(s, "kind"), *state = report_text(s, "status");
    fprintf(p->out, "<h1>");
    report_page_escaped(p->out, report_text(s, "case"));
    fprintf(p->out, "</h1>\n<p class=\"sub\">breech %s &middot; %s</p>\n", kind, state);
    if (strcmp(state, "done") != 0) {
        fputs("<p class=\"verdict\" style=\"border-color:#c0392b\">The run ", p->out);
        fputs(strcmp(state, "stopped") == 0 ? "was stopped early; breech --resume goes on with it. " : "failed. ",
              p->out);
        report_page_escaped(p->out, report_text(s, "error"));
        fputs("</p>\n", p->out);
    }
    if (part.verdict) part.verdict(p);
    const cJSON *shot = cJSON_GetObjectItemCaseSensitive(s, "shot");
    if (shot) report_page_cards(p, shot, shot_cards, PAGE_COUNT(shot_cards));
}

/* ---- plots ---- */

static void section_shot(const page *p)
{
    if (!p->source->history || !host_h5_exists(p->source->history, "/shot/time")) return;
    report_page_heading(p, "The shot");
    report_page_draw(p, report_plot_shot, "shot", "Modules in grey: one unit of each group.");
}

/* ---- craters ---- */

static void one_crater(const page *p, const char *scene)
{
    char name[160], group[300], reason[256];
    bool map, profile;
    const status drawn_map = report_plot_crater_map(p->source, scene, &map);
    const status drawn_profile = report_plot_crater_profile(p->source, scene, &profile);
    fputs("<section class=\"crater\"><h3>", p->out);
    report_page_escaped(p->out, scene);
    fputs("</h3>\n", p->out);
    snprintf(group, sizeof group, "/scene/%.150s/crater", scene);
    if (host_h5_read_attribute_text(p->source->history, group, "reason", reason, sizeof reason).code == STATUS_OK)
        report_page_paragraph(p, "reason", reason);
    snprintf(name, sizeof name, "map-%.120s", scene);
    if (map)
        report_page_plot(p, name, "Depth below the undamaged surface, launch direction to the right.");
    else if (drawn_map.code != STATUS_OK)
        report_page_paragraph(p, "missing", drawn_map.text);
    snprintf(name, sizeof name, "profile-%.120s", scene);
    if (profile)
        report_page_plot(p, name, "Along the middle.");
    else if (drawn_profile.code != STATUS_OK)
        report_page_paragraph(p, "missing", drawn_profile.text);
    fputs("</section>\n", p->out);
}

static void section_craters(const page *p)
{
    char *names, group[300];
    if (!p->source->history || host_h5_list(p->source->history, "/scene", &names).code != STATUS_OK) return;
    int shown_craters = 0, left_out = 0;
    for (char *name = names, *end; (end = strchr(name, '\n')); name = end + 1) {
        *end = '\0';
        snprintf(group, sizeof group, "/scene/%.150s/crater/depth", name);
        if (!host_name_is_plain(name) || !host_h5_exists(p->source->history, group)) continue;
        if (shown_craters == 0) report_page_heading(p, "Craters");
        if (shown_craters < MAX_CRATERS) one_crater(p, name);
        if (shown_craters++ >= MAX_CRATERS) left_out++;
    }
    if (left_out) fprintf(p->out, "<p class=\"missing\">%d more craters are in history.h5.</p>\n", left_out);
    free(names);
}

/* ---- books, warnings, inputs ---- */

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

/* A row a place; adds its values at the start and at the end to the sums. */
static void ledger_place(const page *p, const char *column, const char *text, double sum[2])
{
    double end[2];
    ends_of(p->source, column, end);
    for (int k = 0; k < 2; k++) sum[k] += isfinite(end[k]) ? end[k] : 0.0;
    if (end[0] == 0.0 && end[1] == 0.0) return; /* not in this shot */
    fprintf(p->out, "<tr><td class=\"text\">%s</td><td class=\"text\">", column);
    report_page_escaped(p->out, text);
    fprintf(p->out, "</td><td>%.3f</td><td>%.3f</td></tr>\n", 1e-3 * end[0], 1e-3 * end[1]);
}

static void ledger_total(const page *p, const char *text, const double value[2])
{
    fprintf(p->out, "<tr><td class=\"text\"></td><td class=\"text\"><b>%s</b></td>", text);
    fprintf(p->out, "<td><b>%.3f</b></td><td><b>%.3f</b></td></tr>\n", 1e-3 * value[0], 1e-3 * value[1]);
}

/* Every place of circuit/ledger.def.  At the end there is what was there at the start and what was brought in. */
static void section_ledger(const page *p)
{
    if (!p->source->history || !host_h5_exists(p->source->history, "/shot/energy_error")) return;
    report_page_heading(p, "Where the energy went");
    fputs("<div class=\"wide\"><table><tr><th>column</th><th>place</th><th>start [kJ]</th><th>end [kJ]</th></tr>\n",
          p->out);
    double sum[2] = { 0.0, 0.0 }, given[2] = { 0.0, 0.0 }, error[2];
#define STORED(member, column, text) ledger_place(p, #column, text, sum);
#define SPENT(member, column, text) ledger_place(p, #column, text, sum);
#include "circuit/ledger.def"
    ledger_total(p, "sum", sum);
#define GIVEN(place, member, column, text) ledger_place(p, #column, text, given);
#include "circuit/ledger.def"
    ledger_total(p, "at the start and brought in", (double[2]){ sum[0], sum[0] + given[1] - given[0] });
    ends_of(p->source, "energy_error", error);
    fprintf(p->out, "</table></div><p>The sums differ by %.2e of the whole.</p>\n", error[1]);
}

static void section_rest(const page *p)
{
    const cJSON *warnings = cJSON_GetObjectItemCaseSensitive(p->source->summary, "warnings"), *item;
    report_page_heading(p, "Warnings");
    if (cJSON_GetArraySize(warnings) == 0) report_page_paragraph(p, "reason", "none");
    fputs("<ul>\n", p->out);
    cJSON_ArrayForEach(item, warnings)
    {
        fputs("<li>", p->out);
        report_page_escaped(p->out, cJSON_IsString(item) ? item->valuestring : "");
        fputs("</li>\n", p->out);
    }
    fputs("</ul>\n", p->out);
    report_page_heading(p, "Inputs");
    if (p->source->used) {
        fputs("<details><summary>used.yaml</summary><pre>", p->out);
        report_page_escaped(p->out, p->source->used);
        fputs("</pre></details>\n", p->out);
    } else {
        report_page_paragraph(p, "missing", "used.yaml is not there");
    }
    report_page_heading(p, "Versions");
    fputs("<p>Breech ", p->out);
    report_page_escaped(p->out, report_text(p->source->summary, "version"));
    fputs(", instruction set ", p->out);
    report_page_escaped(p->out, report_text(p->source->summary, "instruction_set"));
    fputs(".</p>\n", p->out);
}

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:60rem;margin:0 auto;padding:1rem}"
    "h1{margin:.2rem 0 0}h2{margin:2rem 0 .5rem;border-bottom:1px solid "
    "#ddd}.sub,figcaption,.reason,.missing{color:#666}"
    ".verdict{font-size:1.25rem;border-left:.4rem solid;padding:.4rem .8rem;background:#f7f6f3}"
    ".cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(9rem,1fr));gap:.5rem;margin:.7rem 0}"
    ".card{border:1px solid #ddd;border-radius:.4rem;padding:.4rem .6rem}.card "
    "span{display:block;color:#666;font-size:.8rem}"
    ".plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,25rem),1fr));gap:.5rem}"
    "figure{margin:.5rem 0}figure svg{display:block;width:100%;height:auto;max-width:760px}.wide{overflow-x:auto}"
    "table{border-collapse:collapse;font-size:.85rem}th,td{padding:.15rem .6rem;text-align:right;border-bottom:1px "
    "solid #eee;"
    "white-space:nowrap}th{text-align:right;color:#666}td.text{text-align:left}pre{overflow-x:auto;font-size:.8rem}"
    "@media print{body{max-width:none;font-size:11pt}figure,.card,tr{break-inside:avoid}h2{break-after:avoid}"
    ".wide{overflow:visible}table{font-size:7.5pt}th,td{padding:.1rem .3rem}}";

static void write_page(const page *p, report_part part)
{
    const report_source *r = p->source;
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>",
          p->out);
    report_page_escaped(p->out, report_text(r->summary, "case"));
    fprintf(p->out, " &ndash; Breech</title><style>%s</style></head><body>\n", style);
    section_verdict(p, part);
    if (!r->gnuplot)
        report_page_paragraph(p, "missing",
                              "gnuplot is not installed: the curves are left out; breech report draws them later.");
    if (!r->history) report_page_paragraph(p, "missing", "history.h5 is not there: no curves and no craters.");
    if (part.section) part.section(p);
    section_craters(p);
    section_shot(p);
    section_ledger(p);
    section_rest(p);
    fputs("</body></html>\n", p->out);
}

static status report_page(const report_source *r, report_part part)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%s/%s", r->dir, OUTDIR_REPORT);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", r->dir);
    file_writer w;
    TRY(host_file_begin(&w, path));
    write_page(&(page){ r, w.stream }, part);
    return host_file_end(&w, true);
}

/* The files beside the summary may be missing; the page says so. */
static status report_with(const outdir *d, const cJSON *summary, report_part part)
{
    char path[OUTDIR_PATH_SIZE], *used = NULL;
    h5_file *history = NULL;
    TRY(host_outdir_file(d, OUTDIR_HISTORY, path, sizeof path));
    if (host_file_exists(path)) TRY(host_h5_open(path, &history));
    if (host_outdir_file(d, OUTDIR_USED, path, sizeof path).code == STATUS_OK && host_file_exists(path))
        (void)host_file_read(path, &used, NULL);
    const report_source source = { d->path, summary, history, used, report_gnuplot_exists() };
    const status s = report_page(&source, part);
    host_h5_close(history);
    free(used);
    return s;
}

status report_write(const char *dir, report_part (*part_of)(const char *kind))
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
    const status s = report_with(&d, summary, part_of(report_text(summary, "kind")));
    cJSON_Delete(summary);
    return s;
}
