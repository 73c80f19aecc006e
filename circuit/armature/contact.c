/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/armature/contact.h"
#include "base/constants.h"

#include <math.h>

static const double GAMMA_5_2 = 1.32934038817913702;

/* Beyond, only the exponential is left of the series, to 1e-10. */
static const double LONG = 25.0;

/* E_3/2(y) = sum y^k/Gamma(3 k/2 + 1), y = z^(3/2): every second term follows from the last but one by
 * Gamma(a + 3) = a (a + 1) (a + 2) Gamma(a).  Its integral over 0 .. z has z/(3 k/2 + 1) on every term. */
double circuit_contact_evenness(double z)
{
    if (z > LONG) return 1.0 / z;
    double end = 0.0, mean = 0.0, term[2] = { 1.0, z * sqrt(z) / GAMMA_5_2 };
    for (int k = 0; k < 400; k++) {
        const double a = 1.5 * k + 1.0, now = term[k & 1];
        end += now;
        mean += now / a;
        if (k > 1 && now < 1e-17 * end && term[(k + 1) & 1] < 1e-17 * end) break;
        term[k & 1] = now * z * z * z / (a * (a + 1.0) * (a + 2.0));
    }
    return mean / end;
}

double circuit_contact_spread(const circuit_sliding_contact *c, double v, double I)
{
    if (!(c->interface > 0.0)) return c->length;
    const double r_inverse = I / c->interface;
    return c->length * circuit_contact_evenness(c->length * cbrt(MU0 * c->resistivity * v * r_inverse * r_inverse));
}
