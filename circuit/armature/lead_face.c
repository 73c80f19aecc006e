/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/armature/lead_face.h"
#include "base/constants.h"

#include <math.h>

circuit_lead_face circuit_lead_face_start(double length, double resistivity)
{
    return (circuit_lead_face){ .length = length, .diffusivity = resistivity / MU0 };
}

void circuit_lead_face_advance(circuit_lead_face *f, double t, double sheet)
{
    const double h = t - f->t;
    if (!(h > 0.0)) return;
    const double slope = (sheet - f->sheet) / h;
    double sum = 0.0;
    for (int n = CIRCUIT_LEAD_FACE_MODES; n >= 1; n--) {
        double *b = &f->mode[n - 1];
        const double k = n * PI / f->length, rate = f->diffusivity * k * k;
        *b = *b * exp(-rate * h) + 2.0 / (n * PI) * slope * expm1(-rate * h) / rate;
        sum += (n % 2 ? -n : n) * PI * *b;
    }
    const double density = (sheet - sum) / f->length;
    f->action += 0.5 * h * (f->density * f->density + density * density);
    f->density = density;
    f->sheet = sheet;
    f->t = t;
}
