#include "coupling/io/report.h"

#include "coupling/io/outdir.h"
#include "coupling/io/report_plots.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CRATERS = 24 };

typedef struct {
    const report_source *source;
    FILE *out;
} page;

/* ---- text ---- */

static void escaped(FILE *out, const char *text)
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

static void heading(const page *p, const char *text)
{
    fprintf(p->out, "<h2>%s</h2>\n", text);
}

static void paragraph(const page *p, const char *class, const char *text)
{
    fprintf(p->out, "<p class=\"%s\">", class);
    escaped(p->out, text);
    fputs("</p>\n", p->out);
}

/* "1.48e+03" is for machines: as many digits as people read. */
static void number(FILE *out, double x, double unit, const char *name)
{
    if (!isfinite(x))
        fputs("&ndash;", out);
    else
        fprintf(out, "%.4g%s%s", x / unit, name[0] ? "&nbsp;" : "", name);
}

typedef struct {
    const char *key, *title;
    double unit;
    const char *name;
} shown;

static void cards(const page *p, const cJSON *object, const shown *list, int n)
{
    fputs("<div class=\"cards\">\n", p->out);
    for (int i = 0; i < n; i++) {
        fprintf(p->out, "<div class=\"card\"><span>%s</span><b>", list[i].title);
        number(p->out, report_number(object, list[i].key), list[i].unit, list[i].name);
        fputs("</b></div>\n", p->out);
    }
    fputs("</div>\n", p->out);
}

static void table_head(const page *p, const shown *list, int n)
{
    fputs("<div class=\"wide\"><table><tr>", p->out);
    for (int i = 0; i < n; i++)
        fprintf(p->out, "<th>%s%s%s%s</th>", list[i].title, list[i].name[0] ? " [" : "", list[i].name,
                list[i].name[0] ? "]" : "");
    fputs("</tr>\n", p->out);
}

/* A row of an object's values; texts that are outcomes get their colour. */
static void table_row(const page *p, const cJSON *object, const shown *list, int n)
{
    fputs("<tr>", p->out);
    for (int i = 0; i < n; i++) {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, list[i].key);
        if (cJSON_IsString(value)) {
            fprintf(p->out, "<td class=\"text\" style=\"color:%s\">", report_colour(value->valuestring));
            escaped(p->out, value->valuestring);
        } else {
            fputs("<td>", p->out);
            if (cJSON_IsBool(value))
                fputs(cJSON_IsTrue(value) ? "yes" : "no", p->out);
            else
                number(p->out, report_number(object, list[i].key), list[i].unit, "");
        }
        fputs("</td>", p->out);
    }
    fputs("</tr>\n", p->out);
}

static void list_table(const page *p, const cJSON *list, const shown *columns, int n)
{
    if (cJSON_GetArraySize(list) == 0) return;
    table_head(p, columns, n);
    const cJSON *item;
    cJSON_ArrayForEach(item, list) table_row(p, item, columns, n);
    fputs("</table></div>\n", p->out);
}

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* ---- verdict ---- */

static void onset_sentence(const page *p, const cJSON *s)
{
    const char *verdict = report_text(s, "verdict");
    FILE *out = p->out;
    if (strcmp(verdict, "gouges") == 0) {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">Gouging begins ", report_colour("gouge"));
        number(out, report_number(s, "onset_position"), 1.0, "m");
        fputs(" from the breech (", out);
        number(out, report_element(s, "onset_interval", 0), 1.0, "");
        fputs(" to ", out);
        number(out, report_element(s, "onset_interval", 1), 1.0, "m");
        fputs("), at ", out);
        number(out, report_number(s, "threshold_velocity"), 1.0, "m/s");
        fputs(" (", out);
        number(out, report_element(s, "threshold_interval", 0), 1.0, "");
        fputs(" to ", out);
        number(out, report_element(s, "threshold_interval", 1), 1.0, "m/s");
        fputs(").</p>\n", out);
    } else if (strcmp(verdict, "no_gouging") == 0) {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">No gouging in this shot.</p>\n",
                report_colour("none"));
    } else {
        fprintf(out, "<p class=\"verdict\" style=\"border-color:%s\">Undecided.</p>\n", report_colour("undecided"));
    }
    if (report_text(s, "reason")[0]) paragraph(p, "reason", report_text(s, "reason"));
}

static void scene_sentence(const page *p, const cJSON *s)
{
    const char *class = report_text(s, "class");
    fprintf(p->out, "<p class=\"verdict\" style=\"border-color:%s\">Damage class: %s.</p>\n", report_colour(class),
            class[0] ? class : "not measured");
    if (report_text(s, "reason")[0]) paragraph(p, "reason", report_text(s, "reason"));
}

/* clang-format off */
static const shown onset_cards[] = { { "threshold_velocity", "threshold velocity", 1.0, "m/s" },
                                     { "onset_position", "onset position", 1.0, "m" },
                                     { "probability_gouge", "probability of a gouge", 1.0, "" },
                                     { "scenes_run", "scenes run", 1.0, "" },
                                     { "scenes_skipped", "scenes skipped", 1.0, "" },
                                     { "wall_seconds", "wall time", 1.0, "s" } };
static const shown shot_cards[] = { { "peak_current", "peak current", 1e3, "kA" },
                                    { "muzzle_velocity", "muzzle velocity", 1.0, "m/s" },
                                    { "muzzle_time", "muzzle time", 1e-3, "ms" },
                                    { "muzzle_energy", "muzzle energy", 1e3, "kJ" },
                                    { "efficiency", "efficiency", 0.01, "%" },
                                    { "peak_acceleration", "peak acceleration", 9806.65, "&times; 1000 g" },
                                    { "exit_current", "exit current", 1e3, "kA" },
                                    { "energy_error", "energy error", 1.0, "" } };
static const shown scene_cards[] = { { "severity", "severity", 1.0, "" },
                                     { "widening", "widening", 1.0, "" },
                                     { "crater_length", "length", 1e-3, "mm" },
                                     { "crater_width", "width", 1e-3, "mm" },
                                     { "crater_depth", "depth", 1e-3, "mm" },
                                     { "crater_volume", "volume", 1e-9, "mm&sup3;" },
                                     { "rim_height", "rim", 1e-3, "mm" },
                                     { "peak_pressure", "peak pressure", 1e9, "GPa" },
                                     { "peak_temperature", "peak temperature", 1.0, "K" },
                                     { "energy_error", "energy error", 1.0, "" },
                                     { "momentum_error", "momentum error", 1.0, "" },
                                     { "wall_seconds", "wall time", 1.0, "s" } };
/* clang-format on */

static void section_verdict(const page *p)
{
    const cJSON *s = p->source->summary;
    const char *kind = report_text(s, "kind"), *state = report_text(s, "status");
    fprintf(p->out, "<h1>");
    escaped(p->out, report_text(s, "case"));
    fprintf(p->out, "</h1>\n<p class=\"sub\">breech %s &middot; %s</p>\n", kind, state);
    if (strcmp(state, "done") != 0) {
        fputs("<p class=\"verdict\" style=\"border-color:#c0392b\">The run ", p->out);
        fputs(strcmp(state, "stopped") == 0 ? "was stopped early; breech --resume goes on with it. " : "failed. ",
              p->out);
        escaped(p->out, report_text(s, "error"));
        fputs("</p>\n", p->out);
    }
    if (strcmp(kind, "onset") == 0) {
        if (strcmp(state, "done") == 0) onset_sentence(p, s);
        cards(p, s, onset_cards, COUNT(onset_cards));
    }
    if (strcmp(kind, "scene") == 0) {
        if (strcmp(state, "done") == 0) scene_sentence(p, s);
        cards(p, s, scene_cards, COUNT(scene_cards));
    }
    const cJSON *shot = cJSON_GetObjectItemCaseSensitive(s, "shot");
    if (strcmp(kind, "shot") == 0) shot = s;
    if (shot) cards(p, shot, shot_cards, COUNT(shot_cards));
}

/* ---- plots ---- */

static void put_plot(const page *p, const char *name, const char *caption)
{
    fputs("<figure>", p->out);
    if (plot_inline(p->source, name, p->out).code != STATUS_OK)
        paragraph(p, "missing", "this plot could not be read back");
    if (caption[0]) fprintf(p->out, "<figcaption>%s</figcaption>", caption);
    fputs("</figure>\n", p->out);
}

static void one_plot(const page *p, status (*draw)(const report_source *, bool *), const char *name,
                     const char *caption)
{
    bool drawn;
    const status s = draw(p->source, &drawn);
    if (drawn)
        put_plot(p, name, caption);
    else if (s.code != STATUS_OK)
        paragraph(p, "missing", s.text);
}

static void section_shot(const page *p)
{
    if (!p->source->history || !h5_exists(p->source->history, "/shot/time")) return;
    heading(p, "The shot");
    one_plot(p, plot_shot, "shot", "Modules in grey: one unit of each group.");
}

/* clang-format off */
static const shown site_columns[] = { { "position", "x", 1.0, "m" },
                                      { "velocity", "v", 1.0, "m/s" },
                                      { "radius", "radius", 1e-3, "mm" },
                                      { "current", "current", 1e3, "kA" },
                                      { "contact_pressure", "contact pressure", 1e6, "MPa" },
                                      { "impact_pressure", "impact pressure", 1e9, "GPa" },
                                      { "screen", "p/H", 1.0, "" },
                                      { "outcome", "outcome", 1.0, "" },
                                      { "scene", "scene", 1.0, "" } };
static const shown scene_columns[] = { { "name", "scene", 1.0, "" },
                                       { "velocity", "v", 1.0, "m/s" },
                                       { "radius", "radius", 1e-3, "mm" },
                                       { "cells_per_radius", "cells per radius", 1.0, "" },
                                       { "class", "class", 1.0, "" },
                                       { "severity", "severity", 1.0, "" },
                                       { "widening", "widening", 1.0, "" },
                                       { "crater_length", "length", 1e-3, "mm" },
                                       { "crater_width", "width", 1e-3, "mm" },
                                       { "crater_depth", "depth", 1e-3, "mm" },
                                       { "rim_height", "rim", 1e-3, "mm" },
                                       { "crater_volume", "volume", 1e-9, "mm&sup3;" },
                                       { "wall_seconds", "time", 1.0, "s" } };
static const shown ranking_columns[] = { { "surface", "surface", 1.0, "" },
                                         { "threshold_velocity", "threshold", 1.0, "m/s" },
                                         { "onset_position", "onset", 1.0, "m" },
                                         { "gouged_volume", "gouged volume", 1e-9, "mm&sup3;" } };
/* clang-format on */

static void section_onset(const page *p)
{
    const cJSON *s = p->source->summary;
    const cJSON *sites = cJSON_GetObjectItemCaseSensitive(s, "sites");
    const cJSON *scenes = cJSON_GetObjectItemCaseSensitive(s, "scenes");
    const cJSON *ranking = cJSON_GetObjectItemCaseSensitive(s, "ranking");
    if (cJSON_GetArraySize(ranking) > 0) {
        heading(p, "Surfaces, best first");
        list_table(p, ranking, ranking_columns, COUNT(ranking_columns));
    }
    if (cJSON_GetArraySize(sites) > 0) {
        heading(p, "Along the barrel");
        one_plot(p, plot_barrel, "barrel",
                 "Shaded: the intervals of the onset position and of the threshold velocity.");
        list_table(p, sites, site_columns, COUNT(site_columns));
    }
    if (cJSON_GetArraySize(scenes) > 0) {
        heading(p, "The threshold");
        one_plot(p, plot_threshold, "threshold", "One point a scene that was run. Shaded: the threshold's interval.");
        list_table(p, scenes, scene_columns, COUNT(scene_columns));
    }
    if (strcmp(report_text(s, "kind"), "inductance") == 0) {
        heading(p, "Inductance and resistance gradients");
        one_plot(p, plot_inductance, "inductance", "");
        heading(p, "Along the surface of a rail");
        one_plot(p, plot_perimeter, "perimeter",
                 "From the middle of the bore face over the edge to the middle of the back.");
    }
}

/* ---- craters ---- */

static void one_crater(const page *p, const char *scene)
{
    char name[160], group[300], reason[256];
    bool map, profile;
    const status drawn_map = plot_crater_map(p->source, scene, &map);
    const status drawn_profile = plot_crater_profile(p->source, scene, &profile);
    fputs("<section class=\"crater\"><h3>", p->out);
    escaped(p->out, scene);
    fputs("</h3>\n", p->out);
    snprintf(group, sizeof group, "/scene/%.150s/crater", scene);
    if (h5_read_attribute_text(p->source->history, group, "reason", reason, sizeof reason).code == STATUS_OK)
        paragraph(p, "reason", reason);
    snprintf(name, sizeof name, "map-%.120s", scene);
    if (map)
        put_plot(p, name, "Depth below the undamaged surface, launch direction to the right.");
    else if (drawn_map.code != STATUS_OK)
        paragraph(p, "missing", drawn_map.text);
    snprintf(name, sizeof name, "profile-%.120s", scene);
    if (profile)
        put_plot(p, name, "Along the middle.");
    else if (drawn_profile.code != STATUS_OK)
        paragraph(p, "missing", drawn_profile.text);
    fputs("</section>\n", p->out);
}

static void section_craters(const page *p)
{
    char *names, group[300];
    if (!p->source->history || h5_list(p->source->history, "/scene", &names).code != STATUS_OK) return;
    int shown_craters = 0, left_out = 0;
    for (char *name = names, *end; (end = strchr(name, '\n')); name = end + 1) {
        *end = '\0';
        snprintf(group, sizeof group, "/scene/%.150s/crater/depth", name);
        if (!name_is_plain(name) || !h5_exists(p->source->history, group)) continue;
        if (shown_craters == 0) heading(p, "Craters");
        if (shown_craters < MAX_CRATERS) one_crater(p, name);
        if (shown_craters++ >= MAX_CRATERS) left_out++;
    }
    if (left_out) fprintf(p->out, "<p class=\"missing\">%d more craters are in history.h5.</p>\n", left_out);
    free(names);
}

/* ---- books, warnings, inputs ---- */

/* Last value of a column, NaN where there is none. */
static double last_of(const report_source *r, const char *path)
{
    double *data, value = NAN;
    size_t dims[H5_MAX_RANK];
    if (h5_read(r->history, path, &data, dims).code != STATUS_OK) return NAN;
    if (dims[0] > 0) value = data[dims[0] - 1];
    free(data);
    return value;
}

static void section_ledger(const page *p)
{
    static const char *const columns[] = { "energy_capacitors", "energy_coils",  "energy_cables", "energy_rails_field",
                                           "energy_kinetic",    "heat_coils",    "heat_cables",   "heat_crowbars",
                                           "heat_rails",        "heat_armature", "heat_contact",  "work_friction",
                                           "work_drag",         "energy_muzzle", "energy_wear",   "energy_jumps" };
    if (!p->source->history || !h5_exists(p->source->history, "/shot/energy_error")) return;
    heading(p, "Where the energy went");
    fputs("<div class=\"wide\"><table><tr><th>place</th><th>[kJ]</th></tr>\n", p->out);
    double sum = 0.0;
    for (int i = 0; i < COUNT(columns); i++) {
        char path[100];
        snprintf(path, sizeof path, "/shot/%s", columns[i]);
        const double value = last_of(p->source, path);
        if (isfinite(value)) sum += value;
        fprintf(p->out, "<tr><td class=\"text\">%s</td><td>%.3f</td></tr>\n", columns[i], 1e-3 * value);
    }
    fprintf(p->out, "<tr><td class=\"text\"><b>sum</b></td><td><b>%.3f</b></td></tr>\n", 1e-3 * sum);
    fprintf(p->out, "<tr><td class=\"text\">error over the start</td><td>%.2e</td></tr>\n</table></div>\n",
            last_of(p->source, "/shot/energy_error"));
}

static void section_rest(const page *p)
{
    const cJSON *warnings = cJSON_GetObjectItemCaseSensitive(p->source->summary, "warnings"), *item;
    heading(p, "Warnings");
    if (cJSON_GetArraySize(warnings) == 0) paragraph(p, "reason", "none");
    fputs("<ul>\n", p->out);
    cJSON_ArrayForEach(item, warnings)
    {
        fputs("<li>", p->out);
        escaped(p->out, cJSON_IsString(item) ? item->valuestring : "");
        fputs("</li>\n", p->out);
    }
    fputs("</ul>\n", p->out);
    heading(p, "Inputs");
    if (p->source->used) {
        fputs("<details><summary>used.yaml</summary><pre>", p->out);
        escaped(p->out, p->source->used);
        fputs("</pre></details>\n", p->out);
    } else {
        paragraph(p, "missing", "used.yaml is not there");
    }
    heading(p, "Versions");
    fputs("<p>Breech ", p->out);
    escaped(p->out, report_text(p->source->summary, "version"));
    fputs(", instruction set ", p->out);
    escaped(p->out, report_text(p->source->summary, "instruction_set"));
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

static void write_page(const page *p)
{
    const report_source *r = p->source;
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>",
          p->out);
    escaped(p->out, report_text(r->summary, "case"));
    fprintf(p->out, " &ndash; Breech</title><style>%s</style></head><body>\n", style);
    section_verdict(p);
    if (!r->gnuplot)
        paragraph(p, "missing", "gnuplot is not installed: the curves are left out; breech report draws them later.");
    if (!r->history) paragraph(p, "missing", "history.h5 is not there: no curves and no craters.");
    section_onset(p);
    section_craters(p);
    section_shot(p);
    section_ledger(p);
    section_rest(p);
    fputs("</body></html>\n", p->out);
}

static status report_page(const report_source *r)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%s/%s", r->dir, OUTDIR_REPORT);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", r->dir);
    file_writer w;
    TRY(file_begin(&w, path));
    write_page(&(page){ r, w.stream });
    return file_end(&w, true);
}

/* The files beside the summary may be missing; the page says so. */
static status report_with(const outdir *d, const cJSON *summary)
{
    char path[OUTDIR_PATH_SIZE], *used = NULL;
    h5_file *history = NULL;
    TRY(outdir_file(d, OUTDIR_HISTORY, path, sizeof path));
    if (file_exists(path)) TRY(h5_open(path, &history));
    if (outdir_file(d, OUTDIR_USED, path, sizeof path).code == STATUS_OK && file_exists(path))
        (void)file_read(path, &used, NULL);
    const report_source source = { d->path, summary, history, used, gnuplot_exists() };
    const status s = report_page(&source);
    h5_close(history);
    free(used);
    return s;
}

status report_write(const char *dir)
{
    outdir d = { .lock = -1 };
    const int n = snprintf(d.path, sizeof d.path, "%s", dir);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_BAD_INPUT, "%.300s: path too long", dir);
    char path[OUTDIR_PATH_SIZE], *text;
    TRY(outdir_file(&d, OUTDIR_SUMMARY, path, sizeof path));
    CHECK(file_exists(path), STATUS_BAD_INPUT, "%.300s: holds no %s; give the output directory of a run", dir,
          OUTDIR_SUMMARY);
    TRY(file_read(path, &text, NULL));
    cJSON *summary = cJSON_Parse(text);
    free(text);
    CHECK(summary, STATUS_BAD_INPUT, "%.300s: is no JSON", path);
    const status s = report_with(&d, summary);
    cJSON_Delete(summary);
    return s;
}
