/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/armature/lead_face.h"
#include "base/constants.h"

#include <math.h>

enum { CELLS = CIRCUIT_LEAD_FACE_CELLS, MOST_STEPS = 1000 };

static const double LONGEST_STEP = 1e-3; /* of the time in which the current comes through, mu0 l^2/rho */

circuit_lead_face circuit_lead_face_start(const circuit_lead_face_metal *metal, double length)
{
    circuit_lead_face f = { .metal = *metal, .length = length };
    for (int i = 0; i < CELLS; i++) f.temperature[i] = metal->start;
    return f;
}

static double resistivity_of(const circuit_lead_face_metal *m, double T)
{
    return m->resistivity * (1.0 + m->coefficient * (T - m->start));
}

/* H_i - share_i-1 (H_i-1 - H_i) + share_i (H_i - H_i+1) = H_i before, by elimination from the rear on. */
static void diffuse(double *H, const double *share, double sheet)
{
    double above[CELLS]; /* H_i = H_i + above_i H_i+1 */
    H[0] = sheet;
    above[0] = 0.0;
    for (int i = 1; i < CELLS; i++) {
        const double pivot = 1.0 + share[i] + share[i - 1] * (1.0 - above[i - 1]);
        H[i] = (H[i] + share[i - 1] * H[i - 1]) / pivot;
        above[i] = share[i] / pivot;
    }
    H[CELLS] = 0.0;
    for (int i = CELLS - 1; i > 0; i--) H[i] += above[i] * H[i + 1];
}

/* One implicit step of h [s], K = sheet at its end. */
static void step(circuit_lead_face *f, double h, double sheet)
{
    const circuit_lead_face_metal *m = &f->metal;
    const double dx = f->length / CELLS;
    double resistivity[CELLS], share[CELLS];
    for (int i = 0; i < CELLS; i++) {
        resistivity[i] = resistivity_of(m, f->temperature[i]);
        share[i] = h * resistivity[i] / (MU0 * dx * dx);
    }
    diffuse(f->field, share, sheet);
    for (int i = 0; i < CELLS; i++) {
        const double J = (f->field[i] - f->field[i + 1]) / dx;
        f->temperature[i] = fmin(f->temperature[i] + h * resistivity[i] * J * J / m->heat_capacity, m->melting);
    }
}

void circuit_lead_face_advance(circuit_lead_face *f, double t, double sheet)
{
    const double from = f->field[0], longest = LONGEST_STEP * MU0 * f->length * f->length / f->metal.resistivity;
    const double way = t - f->t;
    if (!(way > 0.0)) return;
    const int steps = (int)fmin(ceil(way / longest), MOST_STEPS);
    for (int n = 1; n <= steps; n++) step(f, way / steps, from + (sheet - from) * n / steps);
    f->t = t;
}
