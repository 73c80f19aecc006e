/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/screen.h"

#include <math.h>

#define FASTEST 2e4 /* [m/s] no launcher comes near */

static const double RATIO_5 = 4.05, RATIO_95 = 10.4; /* gouging begins there (screen.h) */
static const double NORMAL_95 = 1.6449;              /* 95 % of a normal deviate lie below */
static const double LEAST = 0.01;                    /* a rule calibrated on one pair is not surer than that */

double gouge_screen_probability(double ratio)
{
    const double middle = 0.5 * log(RATIO_5 * RATIO_95), width = 0.5 * log(RATIO_95 / RATIO_5) / NORMAL_95;
    if (!(ratio > 0.0)) return LEAST;
    return fmax(0.5 * erfc(-(log(ratio) - middle) / width / sqrt(2.0)), LEAST);
}

/* One metal under the grain, `part` of the depth that counts. */
static status add_metal(const case_surface *s, const char *name, double yield_scale, double part, double velocity,
                        screen *out)
{
    const mpm_material *m = case_material(&s->materials, name);
    double p, u;
    TRY(mpm_material_check(m, MPM_MATERIAL_FOR_SCREEN));
    TRY(mpm_impedance_match(s->armature, m, velocity, &p, &u));
    out->impact_pressure += part * p;
    out->hardness += part * yield_scale * m->hardness;
    out->density += part * m->density;
    return status_ok();
}

/* Means over the rail's metal from its surface to a depth of the grain's height, layer by layer from the top. */
static status average_rail(const case_surface *s, double height, double velocity, screen *out)
{
    const case_layers *layers = &s->rail.layers;
    double left = height;
    for (int i = layers->n - 1; i >= 0 && left > 0.0; i--) {
        const case_layer *layer = &layers->item[i];
        const double depth = fmin(layer->thickness, left);
        TRY(add_metal(s, layer->material, layer->yield_scale, depth / height, velocity, out));
        left -= depth;
    }
    if (!(left > 0.0)) return status_ok();
    return add_metal(s, s->rail.material, s->rail.yield_scale, left / height, velocity, out);
}

status gouge_screen_impact(const case_surface *s, double height, double velocity, screen *out)
{
    *out = (screen){ .impact_pressure = 0.0 };
    CHECK(height > 0.0, STATUS_BAD_INPUT, "screen: a grain of height %g m has none", height);
    TRY(mpm_material_check(s->armature, MPM_MATERIAL_FOR_SCREEN));
    TRY(average_rail(s, height, velocity, out));
    out->ratio = out->impact_pressure / fmax(s->armature_hardness, out->hardness);
    out->probability = gouge_screen_probability(out->ratio);
    out->skip = out->ratio < s->screen_low;
    return status_ok();
}

/* The pressure rises with the velocity, so halving finds the one place. */
status gouge_screen_velocity(const case_surface *s, double height, double ratio, double *velocity)
{
    double lo = 0.0, hi = FASTEST;
    screen now;
    TRY(gouge_screen_impact(s, height, hi, &now));
    *velocity = INFINITY;
    if (now.ratio < ratio) return status_ok();
    while (hi - lo > 1e-3) {
        const double mid = 0.5 * (lo + hi);
        TRY(gouge_screen_impact(s, height, mid, &now));
        if (now.ratio < ratio)
            lo = mid;
        else
            hi = mid;
    }
    *velocity = hi;
    return status_ok();
}
