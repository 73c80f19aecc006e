/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/armature/film.h"

#include <math.h>

/* (C-21) at a given recession w > 0 */
static melt_flow flow_at(const melt_film *f, double v, double P, double w)
{
    const double wl = w * f->length, Re = 2.0 * f->density * wl / f->viscosity;
    const double eta = f->viscosity * (1.0 + 0.0012 * pow(Re, 0.94));
    const double squeezed = cbrt(P / (eta * wl * f->length)), dragged = v / wl; /* 1/h_s, v/(w l) */
    melt_flow m = { .recession = w };
    if (dragged > squeezed) {
        m.thickness = 2.0 / (squeezed + dragged);
        m.shear = eta * wl / (m.thickness * m.thickness);
    } else {
        m.thickness = 1.0 / squeezed;
        m.shear = eta * v * squeezed;
    }
    return m;
}

/* ln w less the ln of what (C-20) makes of it: its slope in ln w is between 0.7 and 2, so the secant is safe. */
static double off(const melt_film *f, double v, double P, double q, double ln_w)
{
    const melt_flow m = flow_at(f, v, P, exp(ln_w));
    return ln_w - log(f->share * (m.shear * v + q) / f->melting);
}

melt_flow circuit_melt_film_at(const melt_film *f, double v, double P, double q)
{
    const double by_current = f->share * q / f->melting;
    if (!(v > 0.0)) return (melt_flow){ .recession = by_current };
    const double by_shear = sqrt(f->share * f->viscosity * v * v * v / (4.0 * f->length * f->melting));
    double a = log(by_current + by_shear), off_a = off(f, v, P, q, a);
    double b = a - off_a;
    for (int k = 0; k < 60 && b != a; k++) {
        const double off_b = off(f, v, P, q, b);
        const double next = off_b == off_a ? b : b - off_b * (b - a) / (off_b - off_a);
        a = b;
        off_a = off_b;
        b = next;
        if (fabs(b - a) < 1e-13) break;
    }
    return flow_at(f, v, P, exp(b));
}
