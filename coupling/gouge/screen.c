#include "coupling/gouge/screen.h"

#include <math.h>

#define FASTEST 2e4 /* [m/s] no launcher comes near */

/* What the armature meets, and the factor of its hardening. */
static const material *surface_of(const breech_case *c, double *scale)
{
    const case_layers *layers = &c->rail.layers;
    const bool layered = layers->n > 0;
    *scale = layered ? layers->item[layers->n - 1].yield_scale : c->rail.yield_scale;
    return case_material(c, layered ? layers->item[layers->n - 1].material : c->rail.material);
}

status gouge_screen_impact(const breech_case *c, double velocity, screen *out)
{
    double scale, u;
    const material *rail = surface_of(c, &scale), *armature = case_material(c, c->projectile.material);
    TRY(mpm_material_check(rail, MATERIAL_FOR_SCREEN));
    TRY(mpm_material_check(armature, MATERIAL_FOR_SCREEN));
    TRY(mpm_impedance_match(armature, rail, velocity, &out->impact_pressure, &u));
    out->ratio = out->impact_pressure / fmax(armature->hardness, scale * rail->hardness);
    out->skip = out->ratio < c->study.screen_low;
    return status_ok();
}

/* The pressure rises with the velocity, so halving finds the one place. */
status gouge_screen_velocity(const breech_case *c, double ratio, double *velocity)
{
    double lo = 0.0, hi = FASTEST;
    screen s;
    TRY(gouge_screen_impact(c, hi, &s));
    *velocity = INFINITY;
    if (s.ratio < ratio) return status_ok();
    while (hi - lo > 1e-3) {
        const double mid = 0.5 * (lo + hi);
        TRY(gouge_screen_impact(c, mid, &s));
        if (s.ratio < ratio)
            lo = mid;
        else
            hi = mid;
    }
    *velocity = hi;
    return status_ok();
}
