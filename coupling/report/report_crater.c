/* SPDX-License-Identifier: BSD-3-Clause */
/* The craters of the history: from above, aside and along their middle. */
#include "coupling/report/report_page.h"

#include "coupling/host/numbers.h"
#include "coupling/host/outdir.h"
#include "coupling/report/report_relief.h"
#include "coupling/report/report_svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CRATERS = 24 };

/* ---- reading ---- */

typedef struct {
    report_relief map;
    double *height;          /* owned */
    double *x;               /* nx, owned [m] */
    double rim_height;       /* as the summary's, NaN: not known [m] */
    double deepest, highest; /* of the whole map, >= 0 [m] */
    char reason[256], class[40];
    char shape_class[40], shape_reason[256]; /* of the crater by its shape alone */
} crater_picture;

static bool read_part(const report_source *r, const char *scene, const char *part, double **data,
                      size_t dims[H5_MAX_RANK])
{
    char path[300];
    snprintf(path, sizeof path, "/scene/%.150s/crater/%s", scene, part);
    return host_h5_read(r->history, path, data, dims).code == STATUS_OK;
}

static void read_texts(const report_source *r, const char *scene, crater_picture *c)
{
    char group[300];
    const struct {
        const char *name;
        char *to;
        size_t size;
    } texts[] = { { "class", c->class, sizeof c->class },
                  { "reason", c->reason, sizeof c->reason },
                  { "crater_class", c->shape_class, sizeof c->shape_class },
                  { "crater_reason", c->shape_reason, sizeof c->shape_reason } };
    snprintf(group, sizeof group, "/scene/%.150s/crater", scene);
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        if (host_h5_read_attribute_text(r->history, group, texts[k].name, texts[k].to, texts[k].size).code != STATUS_OK)
            texts[k].to[0] = '\0';
    if (host_h5_read_attribute_double(r->history, group, "rim_height_m", &c->rim_height).code != STATUS_OK)
        c->rim_height = NAN;
}

/* Where the darkest colours stand: what a hundredth of the crater and its rim exceeds, so that the hole of a single
 * cell does not leave all else pale. */
static double colour_range(const double *height, size_t n, double largest)
{
    size_t m = 0;
    double *sorted = malloc((n + 1) * sizeof *sorted), range = largest;
    for (size_t k = 0; sorted && k < n; k++)
        if (fabs(height[k]) > 0.04 * largest) sorted[m++] = fabs(height[k]);
    if (m > 0) {
        qsort(sorted, m, sizeof *sorted, host_number_order);
        range = sorted[(size_t)(0.99 * (double)(m - 1))];
    }
    free(sorted);
    return fmax(range, 1e-9);
}

static bool read_crater(const report_source *r, const char *scene, crater_picture *c)
{
    double *z = NULL;
    size_t nx[H5_MAX_RANK], nz[H5_MAX_RANK], dims[H5_MAX_RANK];
    *c = (crater_picture){ .height = NULL };
    const bool there = read_part(r, scene, "depth", &c->height, dims) && read_part(r, scene, "x", &c->x, nx) &&
                       read_part(r, scene, "z", &z, nz) && dims[0] == nx[0] && dims[1] == nz[0] && dims[0] > 2 &&
                       dims[1] > 2;
    if (there) {
        for (size_t k = 0; k < dims[0] * dims[1]; k++) {
            c->height[k] = isfinite(c->height[k]) ? -c->height[k] : 0.0;
            c->deepest = fmax(c->deepest, -c->height[k]);
            c->highest = fmax(c->highest, c->height[k]);
        }
        c->map =
            (report_relief){ .height = c->height,
                             .nx = dims[0],
                             .ny = dims[1],
                             .x0 = c->x[0],
                             .dx = c->x[1] - c->x[0],
                             .y0 = z[0],
                             .dy = z[1] - z[0],
                             .colour_range = colour_range(c->height, dims[0] * dims[1], fmax(c->deepest, c->highest)),
                             .unit = 1e-3,
                             .legend = "height [mm]",
                             .above = "launch direction \342\206\222" };
        read_texts(r, scene, c);
    }
    free(z);
    return there;
}

static void crater_free(crater_picture *c)
{
    free(c->height);
    free(c->x);
}

/* ---- one crater ---- */

/* Height at the map's middle: the two rows beside z = 0 where it lies between them. */
static void draw_profile(const page *p, const crater_picture *c, const report_relief *part, const char *name)
{
    const size_t n = part->nx, a = (c->map.ny - 1) / 2, b = c->map.ny / 2,
                 first = (size_t)lround((part->x0 - c->map.x0) / c->map.dx);
    double *height = malloc(n * sizeof *height);
    if (!height) return;
    for (size_t i = 0; i < n; i++)
        height[i] = 0.5 * (c->height[(first + i) * c->map.ny + a] + c->height[(first + i) * c->map.ny + b]);
    report_chart *chart = report_chart_create((report_axis){ .label = "along the rail", .unit = "m" },
                                              (report_axis){ .label = "height", .unit = "m" });
    report_chart_line(chart, "", "#7a4a1e", c->x + first, height, n);
    report_chart_rule(chart, "", "#888888", 'y', 0.0);
    report_page_chart(p, name, "Along the middle; heights drawn larger than lengths. Dashed: the surface before.",
                      chart);
    free(height);
}

static void draw_map(const page *p, const crater_picture *c, const report_relief *part, const char *name)
{
    char caption[400], deep[REPORT_VALUE_SIZE], high[REPORT_VALUE_SIZE], rim[REPORT_VALUE_SIZE];
    report_value_plain(1e3 * c->deepest, deep);
    report_value_plain(1e3 * c->highest, high);
    report_value_plain(1e3 * c->rim_height, rim);
    int n = snprintf(caption, sizeof caption, "From above: %.40s mm deep, up to %.40s mm high.", deep, high);
    if (c->rim_height > 0.0 && fabs(c->rim_height - c->highest) > 0.005 * c->highest)
        snprintf(caption + n, sizeof caption - (size_t)n,
                 " The rim (rim_height, %.40s mm) is the highest within a crater's width of the crater alone; what "
                 "stands higher lies farther off.",
                 rim);
    report_page_svg(p, name, caption, report_relief_map(part, name));
}

static void draw_aside(const page *p, const report_relief *part, const char *name)
{
    char caption[160];
    double up = 1.0;
    char *svg = report_relief_aside(part, name, &up);
    snprintf(caption, sizeof caption, up > 1.0 ? "Aside; heights %g times as large as lengths." : "Aside, to scale.",
             up);
    report_page_svg(p, name, caption, svg);
}

static void one_crater(const page *p, const char *scene, const crater_picture *c)
{
    char name[160];
    report_relief part = c->map;
    double *memory = report_relief_crop(&part, 0.12 * c->map.colour_range);
    fputs("<section class=\"crater\"><h3>", p->out);
    report_svg_escaped(p->out, scene);
    if (c->class[0]) fprintf(p->out, ": <span style=\"color:%s\">%s</span>", report_colour(c->class), c->class);
    fputs("</h3>\n", p->out);
    const bool said = strcmp(c->reason, report_text(p->source->summary, "reason")) == 0; /* at the page's head */
    if (c->reason[0] && !said) report_page_paragraph(p, "reason", c->reason);
    if (c->shape_reason[0] && strcmp(c->shape_reason, c->reason) != 0) {
        char text[400];
        snprintf(text, sizeof text, "By its shape alone: %s; %s.", c->shape_class, c->shape_reason);
        report_page_paragraph(p, "reason", text);
    }
    if (memory) {
        report_page_plots_begin(p);
        snprintf(name, sizeof name, "map-%.120s", scene);
        draw_map(p, c, &part, name);
        snprintf(name, sizeof name, "aside-%.120s", scene);
        draw_aside(p, &part, name);
        snprintf(name, sizeof name, "profile-%.120s", scene);
        draw_profile(p, c, &part, name);
        report_page_plots_end(p);
    }
    fputs("</section>\n", p->out);
    free(memory);
}

void report_crater_sections(const page *p)
{
    char *names;
    if (!p->source->history || host_h5_list(p->source->history, "/scene", &names).code != STATUS_OK) return;
    int shown = 0, left_out = 0;
    for (char *name = names, *end; (end = strchr(name, '\n')); name = end + 1) {
        crater_picture c;
        *end = '\0';
        if (!host_name_is_plain(name)) continue;
        if (read_crater(p->source, name, &c)) {
            if (shown == 0) report_page_heading(p, "Craters");
            if (shown < MAX_CRATERS) one_crater(p, name, &c);
            left_out += shown++ >= MAX_CRATERS;
        }
        crater_free(&c);
    }
    if (left_out) fprintf(p->out, "<p class=\"missing\">%d more craters are in history.h5.</p>\n", left_out);
    free(names);
}
