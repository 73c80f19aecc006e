/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/scene_doubts.h"

#include "coupling/gouge/impact_scene.h"
#include "coupling/scene/few_cells.h"
#include "coupling/scene/probe_place.h"
#include "coupling/scene/scene_window.h"

#include <math.h>
#include <string.h>

typedef void doubt_sink(void *user, const char *text);

/* The scene of a grain: it has as many cells across as its radius says. */
static void doubt_grain(const case_inputs *in, doubt_sink *say, void *user)
{
    const case_impact *c = &in->onset.impact;
    char text[400];
    if (!in->onset.has_body || isnan(c->scene.velocity) || isnan(c->particle.radius)) return;
    if (!(2.0 * c->scene.cells_per_radius < SCENE_FEW_CELLS)) return;
    snprintf(text, sizeof text,
             "particle: %.2g cells across it: with fewer than %g the scene does not resolve what becomes of it "
             "(scene.cells_per_radius)",
             2.0 * c->scene.cells_per_radius, SCENE_FEW_CELLS);
    say(user, text);
}

/* The crater of a scene, measured where its cells hardly show it. */
static void doubt_depth(const case_inputs *in, doubt_sink *say, void *user)
{
    const case_impact *c = &in->onset.impact;
    const double cell = c->particle.radius / c->scene.cells_per_radius;
    char text[400];
    if (!in->onset.has_body || isnan(cell) || !(c->scene.measuring_depth < 0.25 * cell)) return;
    snprintf(text, sizeof text,
             "scene.measuring_depth = %g um: less than a quarter of a cell of %.3g um, whose own unevenness may count",
             1e6 * c->scene.measuring_depth, 1e6 * cell);
    say(user, text);
}

/* A layer of the rail that cannot have the cells of its own that the case asks for. */
static void doubt_layers(const case_inputs *in, doubt_sink *say, void *user)
{
    const case_impact *c = &in->onset.impact;
    const double wanted = c->scene.cells_per_layer, fine = c->particle.radius / c->scene.cells_per_radius;
    char text[400];
    if (!in->onset.has_body || isnan(c->scene.velocity) || isnan(fine)) return;
    for (int i = 0; i < c->rail.layers.n; i++) {
        const case_layer *layer = &c->rail.layers.item[i];
        const double across = gouge_cells_across(&c->scene, fine, layer->thickness);
        if (!(GOUGE_ALMOST * across < wanted)) continue;
        snprintf(
            text, sizeof text,
            "rail.layers[%d]: %.2g cells across %g um of %s, not %g (scene.cells_per_layer): that takes more levels "
            "of cells than there may be; smaller scene.coarse_cell leaves room",
            i, across, 1e6 * layer->thickness, layer->material, wanted);
        say(user, text);
    }
}

/* A force on one body is that on all that are welded to it. */
static bool reads_others(const mpm_scene *s, int probe, char text[400])
{
    const mpm_probe *p = &s->probe[probe];
    if (strcmp(p->kind->name, "force") != 0) return false;
    int n = snprintf(text, 400, "probe %.60s: the force is that on the whole group of %.60s:", p->name,
                     s->body[p->body].name);
    const int alone = n;
    for (int i = 0; i < s->bodies && n < 300; i++)
        if (i != p->body && s->body[i].group == s->body[p->body].group)
            n += snprintf(text + n, (size_t)(400 - n), "%s %.60s", n > alone ? "," : " with", s->body[i].name);
    return n > alone;
}

static void doubt(const case_inputs *in, doubt_sink *say, void *user)
{
    char text[400];
    const mpm_scene *s = &in->bodies.scene;
    if (!in->given.bodies) {
        doubt_grain(in, say, user);
        doubt_layers(in, say, user);
        doubt_depth(in, say, user);
        return;
    }
    for (int i = 0; i < s->bodies; i++)
        if (scene_few_cells(s, i, text)) say(user, text);
    for (int i = 0; i < s->bodies; i++)
        if (scene_window_cuts(s, i, text)) say(user, text);
    for (int i = 0; i < s->probes; i++)
        if (scene_probe_is_empty(s, i, text) || reads_others(s, i, text)) say(user, text);
}

static void print_doubt(void *out, const char *text)
{
    fprintf(out, "warning: %s\n", text);
}

void study_scene_doubts_print(const case_inputs *in, FILE *out)
{
    doubt(in, print_doubt, out);
}

static void warn_of_doubt(void *s, const char *text)
{
    run_session_warn(s, "%s", text);
}

void study_scene_doubts_warn(session *s, const study_case *of)
{
    if (!of->one_of_several) doubt(of->in, warn_of_doubt, s);
}
