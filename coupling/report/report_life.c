/* SPDX-License-Identifier: BSD-3-Clause */
/* The page of the rail's life.  First after how many loads it cracks, where and how deep; then what the loads have used
 * up, as a map and along the depth. */
#include "coupling/report/report_page.h"

#include "coupling/report/report_relief.h"

#include <math.h>
#include <stdlib.h>

static const double DEGREE = 0.017453292519943295;

/* ---- the head ---- */

static void write_place(const page *p, const char *position_key, const char *depth_key)
{
    const cJSON *s = p->source->summary;
    const double position = report_number(s, position_key), depth = report_number(s, depth_key);
    if (depth == 0.0) {
        fputs("at the face", p->out);
    } else {
        report_page_number(p->out, depth, 1e-3, "mm");
        fputs(" below the face", p->out);
    }
    if (!isfinite(position)) return;
    fputs(", at ", p->out);
    report_page_number(p->out, position, 1e-3, "mm");
    fputs(" along the rail from the middle of the contact", p->out);
}

/* Lives come from a fit of scattered tests: two digits. */
static void write_cycles(const page *p, double cycles)
{
    char text[REPORT_VALUE_SIZE];
    report_value_known(cycles, 0.7 * cycles, 1.3 * cycles, text);
    fprintf(p->out, "%s loads", text);
}

void report_life_head(const page *p)
{
    static const page_column cards[] = { { "peak_pressure", "peak pressure of the contact", 1e6, "MPa", NULL },
                                         { "normal_force", "pressing force a metre", 1e3, "kN/m", NULL },
                                         { "tangential_force", "dragging force a metre", 1e3, "kN/m", NULL },
                                         { "first_range", "strain range, largest", 1e-2, "%", NULL },
                                         { "life_angle", "crack lies across", DEGREE, "&deg;", NULL },
                                         { "moving_factor", "stress over that at rest", 1.0, "", NULL },
                                         { "wall_seconds", "took", 1.0, "s", NULL } };
    const cJSON *s = p->source->summary;
    const double life = report_number(s, "life"), first = report_number(s, "life_first");
    if (report_page_is_done(p)) {
        fputs("<p class=\"verdict\">", p->out);
        if (isfinite(life)) {
            fputs("A crack is there after ", p->out);
            write_cycles(p, life);
            fputs(", ", p->out);
            write_place(p, "life_position", "life_depth");
            fputs(".", p->out);
        } else {
            fputs("No crack was looked for, or none was reached.", p->out);
        }
        fputs("</p>\n", p->out);
        if (isfinite(first)) {
            fputs("<p>The first damage is done after ", p->out);
            write_cycles(p, first);
            fputs(", ", p->out);
            write_place(p, "first_position", "first_depth");
            fputs(".</p>\n", p->out);
        }
    }
    report_page_cards(p, s, cards, PAGE_COUNT(cards));
}

/* ---- the maps ---- */

typedef struct {
    double *value, *x, *z; /* nx x nz, nx, nz, owned */
    size_t nx, nz;
} rail_map;

static void map_free(rail_map *m)
{
    free(m->value);
    free(m->x);
    free(m->z);
}

static bool read_map(const report_source *r, rail_map *m)
{
    size_t dims[H5_MAX_RANK], nx[H5_MAX_RANK], nz[H5_MAX_RANK];
    *m = (rail_map){ .value = NULL };
    if (!r->history || host_h5_read(r->history, "/scene/rail/index/index", &m->value, dims).code != STATUS_OK ||
        host_h5_read(r->history, "/scene/rail/index/x", &m->x, nx).code != STATUS_OK ||
        host_h5_read(r->history, "/scene/rail/index/z", &m->z, nz).code != STATUS_OK)
        return false;
    m->nx = dims[0];
    m->nz = dims[1];
    return dims[0] > 2 && dims[1] > 2 && dims[0] == nx[0] && dims[1] == nz[0];
}

/* Colours by the share that is cut: depths of a relief, seen from aside, the face on top. */
static void draw_map(const page *p, const rail_map *m)
{
    const double position = report_number(p->source->summary, "life_position"),
                 depth = report_number(p->source->summary, "life_depth");
    double *height = malloc(m->nx * m->nz * sizeof *height), largest = 0.0;
    if (!height) return;
    for (size_t i = 0; i < m->nx; i++)
        for (size_t k = 0; k < m->nz; k++) {
            height[i * m->nz + m->nz - 1 - k] = -m->value[i * m->nz + k];
            largest = fmax(largest, m->value[i * m->nz + k]);
        }
    report_relief relief = { .height = height,
                             .nx = m->nx,
                             .ny = m->nz,
                             .x0 = m->x[0],
                             .dx = m->x[1] - m->x[0],
                             .y0 = -m->z[m->nz - 1],
                             .dy = m->z[1] - m->z[0],
                             .colour_range = fmax(largest, 1e-9),
                             .unit = -1.0,
                             .legend = "fraction cut",
                             .above = "face of the rail on top",
                             .marked = isfinite(position) && isfinite(depth),
                             .mark = { position, -depth } };
    double *memory = report_relief_crop(&relief, 0.04 * relief.colour_range);
    if (memory)
        report_page_svg(p, "index",
                        "Share of each point's directions that are used up when the crack is there; the ring is the "
                        "crack.",
                        report_relief_map(&relief, "what the loads have used up"));
    free(memory);
    free(height);
}

/* The largest share at each depth. */
static void draw_depth(const page *p, const rail_map *m)
{
    double *largest = calloc(m->nz, sizeof *largest);
    if (!largest) return;
    size_t n = 1;
    for (size_t i = 0; i < m->nx; i++)
        for (size_t k = 0; k < m->nz; k++) {
            largest[k] = fmax(largest[k], m->value[i * m->nz + k]);
            if (largest[k] > 0.0 && k + 1 > n) n = k + 1;
        }
    n = n + n / 4 + 1 < m->nz ? n + n / 4 + 1 : m->nz; /* a little further than any is cut */
    report_chart *c =
        report_chart_create((report_axis){ .label = "depth below the face", .unit = "m", .from_zero = true },
                            (report_axis){ .label = "largest fraction cut", .unit = "1", .from_zero = true });
    report_chart_line(c, "", report_red, m->z, largest, n);
    report_page_chart(p, "depth", "How deep the loads have used up directions: the largest fraction at each depth.", c);
    free(largest);
}

void report_life_section(const page *p)
{
    rail_map m;
    if (read_map(p->source, &m)) {
        report_page_heading(p, "What the loads have used up");
        report_page_plots_begin(p);
        draw_map(p, &m);
        draw_depth(p, &m);
        report_page_plots_end(p);
    }
    map_free(&m);
}
