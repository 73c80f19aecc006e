#include "coupling/gouge/screen.h"

#include <math.h>

#define FASTEST 2e4 /* [m/s] no launcher comes near */

status gouge_screen_impact(case_surface s, double velocity, screen *out)
{
    double u;
    TRY(mpm_material_check(s.rail, MATERIAL_FOR_SCREEN));
    TRY(mpm_material_check(s.armature, MATERIAL_FOR_SCREEN));
    TRY(mpm_impedance_match(s.armature, s.rail, velocity, &out->impact_pressure, &u));
    out->ratio = out->impact_pressure / fmax(s.armature->hardness, s.yield_scale * s.rail->hardness);
    out->skip = out->ratio < s.screen_low;
    return status_ok();
}

/* The pressure rises with the velocity, so halving finds the one place. */
status gouge_screen_velocity(case_surface s, double ratio, double *velocity)
{
    double lo = 0.0, hi = FASTEST;
    screen now;
    TRY(gouge_screen_impact(s, hi, &now));
    *velocity = INFINITY;
    if (now.ratio < ratio) return status_ok();
    while (hi - lo > 1e-3) {
        const double mid = 0.5 * (lo + hi);
        TRY(gouge_screen_impact(s, mid, &now));
        if (now.ratio < ratio)
            lo = mid;
        else
            hi = mid;
    }
    *velocity = hi;
    return status_ok();
}
