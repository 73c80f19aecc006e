/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/rails_heat.h"

#include <math.h>
#include <string.h>

void circuit_rails_heat_start(circuit_rails_heat *h, double length)
{
    memset(h, 0, sizeof *h);
    h->piece = length / CIRCUIT_RAILS_PIECES;
}

/* int I^2 dt of a current that goes linearly. */
static double action(double I0, double I1, double dt)
{
    return (I0 * I0 + I0 * I1 + I1 * I1) / 3.0 * dt;
}

/* Piece k over dt, exposed all the time. */
static void pass(circuit_rails_heat *h, const circuit_rails_load *r, double warm, int k, double dt, double I0,
                 double I1)
{
    const circuit_ladder *l = &r->ladder;
    double heat = warm * l->R_dc * action(I0, I1, dt);
    for (int n = 0; n < l->n && dt > 0.0; n++) {
        const double R = warm * l->R[n], tau = l->L[n] / R;
        const double steady = (I1 - I0) / dt * tau, off = I0 - h->j[k][n] - steady, fallen = -expm1(-dt / tau);
        heat += R * (steady * steady * dt + tau * off * fallen * (2.0 * steady + off * (1.0 - 0.5 * fallen)));
        h->j[k][n] = I1 - steady - off * (1.0 - fallen);
    }
    h->heat[k] += heat;
}

/* The armature, at v, comes past the middle of piece k. */
static void expose(circuit_rails_heat *h, const circuit_rails_load *r, int k, double v, double I)
{
    const circuit_ladder *l = &r->ladder;
    const double rate = l->n > 0 ? v / circuit_contact_spread(&r->contact, v, I) : 0.0;
    for (int n = 0; n < l->n; n++) {
        const double theta = rate * l->L[n] / l->R[n], a = circuit_rails_share_at_birth(theta);
        h->heat[k] += 0.5 * l->L[n] * (a * (2.0 - a) - circuit_rails_share_of_force(theta)) * I * I;
        h->j[k][n] = a * I;
    }
}

void circuit_rails_heat_carry(circuit_rails_heat *h, const circuit_rails_load *r, double warm, double from, double to,
                              const circuit_rails_instant *a, const circuit_rails_instant *b)
{
    for (int k = 0; k < CIRCUIT_RAILS_PIECES; k++) {
        const double x = (k + 0.5) * h->piece;
        if (x < from || x >= to || x > b->x) continue;
        const double share = x > a->x ? (x - a->x) / (b->x - a->x) : 0.0; /* of the step before it is exposed */
        const double I = a->I + share * (b->I - a->I);
        if (x > a->x) expose(h, r, k, a->v + share * (b->v - a->v), I);
        pass(h, r, warm, k, (1.0 - share) * (b->t - a->t), I, b->I);
    }
}

void circuit_rails_heat_ahead(circuit_rails_heat *h, const circuit_rails_load *r, double x, double dt, double i0,
                              double i1)
{
    for (int k = 0; k < CIRCUIT_RAILS_PIECES; k++)
        if ((k + 0.5) * h->piece > x) h->heat[k] += r->ladder.R_dc * action(i0, i1, dt);
}

void circuit_rails_heat_slide(circuit_rails_heat *h, double x0, double x1, double E)
{
    const int first = (int)fmin(x0 / h->piece, CIRCUIT_RAILS_PIECES - 1),
              last = (int)fmin(x1 / h->piece, CIRCUIT_RAILS_PIECES - 1);
    for (int k = first; k <= last; k++) {
        const double length = fmin(x1, (k + 1) * h->piece) - fmax(x0, k * h->piece);
        const double share = first == last ? 1.0 : length / (x1 - x0);
        h->heat[k] += share * E / h->piece;
    }
}
