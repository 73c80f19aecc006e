/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/layer_wear.h"

#include "base/constants.h"

#include <math.h>

static const double SUFFERED = 0.1; /* share from which it counts */

layer_wear study_layer_wear_of(const scene_result *r, double thickness, double radius)
{
    const double ellipse = 0.25 * PI * r->crater_length * r->crater_width, grain = PI * radius * radius;
    const double over_crater = thickness * fmax(ellipse, grain);
    if (!(over_crater > 0.0)) return (layer_wear){ 0.0, 0.0 };
    return (layer_wear){ fmin(r->layers_failed_volume / over_crater, 1.0),
                         fmin(r->layers_carried_volume / over_crater, 1.0) };
}

bool study_layer_wear_is_through(double gone, double depth, double thickness)
{
    return depth >= thickness && gone >= SUFFERED;
}

const char *study_layer_wear_word(const layer_wear *w, double depth, double thickness)
{
    if (study_layer_wear_is_through(w->failed + w->carried, depth, thickness)) return "worn through";
    if (w->carried >= SUFFERED) return "sheared off";
    if (w->failed >= SUFFERED) return "spalled";
    return depth >= thickness ? "dented" : "intact";
}
