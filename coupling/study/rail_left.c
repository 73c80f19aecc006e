/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/rail_left.h"

#include <math.h>

static const double THINNEST = 1e-6; /* that a layer of a case may be [m] */

/* Melted off by the time the armature was at x; nothing before it began, no more than all of it behind its end [kg] */
static double melted_at(const shot_outcome *flown, double x)
{
    trace_point at;
    if (flown->n_trace == 0 || x < flown->trace[0].x) return 0.0;
    gouge_trace_at_place(flown, x, &at);
    return at.melted;
}

void study_rail_left_of(const case_onset *c, const shot_outcome *flown, rail_left *out)
{
    const circuit_shot_armature *a = &c->launcher.armature;
    const mpm_material *metal = case_material(&c->impact.materials, c->impact.armature.material);
    const double width = isnan(a->contact_width) ? c->launcher.rails.height : a->contact_width;
    const double length = a->contact_length, density = metal ? metal->density : a->density;
    for (int k = 0; k <= MC_PLACES; k++) {
        const double x = c->launcher.barrel.length * k / MC_PLACES;
        const double melted = melted_at(flown, x + 0.5 * length) - melted_at(flown, x - 0.5 * length);
        trace_point at;
        out->pressed[k] = gouge_trace_at_place(flown, x, &at) ? at.pressure * length : 0.0; /* (O-6) */
        out->metal[k] = melted / (c->launcher.rails.count * density * width * length);      /* (O-7) */
    }
}

double study_layers_worn(const case_layers *l, double pressed)
{
    double gone = 0.0;
    for (int i = l->n - 1; i >= 0; i--) {
        const case_layer *layer = &l->item[i];
        if (!(layer->wear_rate > 0.0)) return gone;
        if (layer->wear_rate * pressed < layer->thickness) return gone + layer->wear_rate * pressed;
        gone += layer->thickness;
        pressed -= layer->thickness / layer->wear_rate;
    }
    return gone;
}

status study_layers_without(const case_layers *l, double gone, case_layers *out)
{
    *out = (case_layers){ 0, NULL };
    for (int i = l->n - 1; i >= 0; i--) {
        case_layer left = l->item[i];
        left.thickness -= fmin(gone, left.thickness);
        gone -= l->item[i].thickness - left.thickness;
        if (left.thickness >= THINNEST) TRY(case_layers_add(out, 0, &left));
    }
    return status_ok();
}
