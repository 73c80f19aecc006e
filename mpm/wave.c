/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/wave.h"

#include "mpm/tube.h"

#include <math.h>
#include <stdlib.h>

static const double TUBE_CELL = 0.5e-3; /* of a piston's tube, within the next two [m] */
enum { FEWEST_CELLS = 100, MOST_CELLS = 2000 };
static const double FRONT = 0.01;   /* of the acoustic pressure of the piston: less has not arrived */
static const double NOTHING = 1e-4; /* the same: less ends the wave */
static const double LATEST = 20;    /* times theta after the front: so does this */

status mpm_wave_check(const mpm_body *b)
{
    const int piston = !isnan(b->piston_mass) + !isnan(b->piston_velocity) + !isnan(b->tube_length);
    CHECK(isnan(b->wave_pressure) || piston == 0, STATUS_BAD_INPUT,
          "body `%s` has a wave_pressure and a piston: one of them", b->name);
    CHECK(piston == 0 || piston == 3, STATUS_BAD_INPUT,
          "body `%s`: a piston wants all of piston_mass, piston_velocity and tube_length", b->name);
    CHECK(isnan(b->wave_decay) || !isnan(b->wave_pressure), STATUS_BAD_INPUT,
          "body `%s`: wave_decay = %g s, but no wave_pressure", b->name, b->wave_decay);
    CHECK(!mpm_wave_is_wanted(b) || mpm_material_shear(b->material) == SHEAR_NONE, STATUS_BAD_INPUT,
          "body `%s` of %.40s: a wave enters fluids only (strength: none)", b->name, b->material->name);
    return status_ok();
}

/* ---- the wave of a piston ---- */

static status add_row(mpm_wave *w, double t, double p)
{
    if (!(w->n & (w->n - 1))) {
        const size_t room = w->n ? 2 * (size_t)w->n : 1;
        double *time = realloc(w->time, room * sizeof *time);
        if (time) w->time = time;
        double *incident = time ? realloc(w->incident, room * sizeof *incident) : NULL;
        if (incident) w->incident = incident;
        CHECK(incident, STATUS_MEMORY, "no memory for a wave of %d rows", w->n);
    }
    w->time[w->n] = t;
    w->incident[w->n++] = p;
    return status_ok();
}

/* From the front's arrival at the far end until the wave has gone by. */
static status record(mpm_tube *t, double acoustic, double longest, mpm_wave *out)
{
    double arrival = NAN, peak = 0;
    for (;;) {
        mpm_tube_step(t);
        const mpm_tube_state s = mpm_tube_now(t);
        if (isnan(arrival) && s.end_pressure < FRONT * acoustic) continue;
        if (isnan(arrival)) arrival = s.time;
        TRY(add_row(out, s.time - arrival, s.end_pressure));
        peak = fmax(peak, s.end_pressure);
        const bool gone = s.end_pressure < 0.5 * peak && s.end_pressure < NOTHING * acoustic;
        if (gone || s.time > arrival + longest) return status_ok();
    }
}

static status make_piston(const mpm_body *b, const law *k, mpm_wave *out)
{
    const double cells = fmin(fmax(b->tube_length / TUBE_CELL, FEWEST_CELLS), MOST_CELLS);
    const mpm_tube_setup setup = { .fluid = b->material,
                                   .piston_mass = b->piston_mass,
                                   .piston_velocity = b->piston_velocity,
                                   .length = b->tube_length,
                                   .end = TUBE_GOES_ON,
                                   .cells = (int)cells };
    mpm_tube *t;
    TRY(mpm_tube_create(&setup, &t));
    const double Z = sqrt(k->rho0 * k->K0);
    const status done = record(t, Z * b->piston_velocity, LATEST * b->piston_mass / Z, out);
    mpm_tube_free(t);
    return done;
}

status mpm_wave_make(const mpm_body *b, const law *k, mpm_wave *out)
{
    *out = (mpm_wave){ .n = 0 };
    if (!mpm_wave_is_wanted(b)) return status_ok();
    if (!isnan(b->piston_mass)) return make_piston(b, k, out);
    out->pressure = b->wave_pressure;
    out->rate = isnan(b->wave_decay) ? 0 : 1 / b->wave_decay;
    return status_ok();
}

void mpm_wave_free(mpm_wave *w)
{
    free(w->time), free(w->incident);
}

static double incident_pressure(const mpm_wave *w, double t)
{
    if (w->n == 0) return w->pressure * exp(-w->rate * t);
    if (t >= w->time[w->n - 1]) return 0;
    int lo = 0, hi = w->n - 1;
    while (hi - lo > 1) *(w->time[(lo + hi) / 2] > t ? &hi : &lo) = (lo + hi) / 2;
    const double share = (t - w->time[lo]) / (w->time[hi] - w->time[lo]);
    return w->incident[lo] + fmax(share, 0) * (w->incident[hi] - w->incident[lo]);
}

/* u_i of p_i = rho0 (c0 + s u_i) u_i */
static double incident_velocity(double p, double rho0, double c0, double s)
{
    return 2 * p / (rho0 * (c0 + sqrt(c0 * c0 + 4 * s * fmax(p, 0) / rho0)));
}

wave_load mpm_wave_load(const mpm_wave *w, const mpm_body *b, const law *k, double t)
{
    const double p = incident_pressure(w, t), c0 = sqrt(k->K0 / k->rho0), s = mpm_law_slope(k);
    const double u = incident_velocity(p, k->rho0, c0, s), Z = k->rho0 * (c0 + 2 * s * fmax(u, 0));
    return (wave_load){ .on = true,
                        .axis = b->traction_face / 2,
                        .inwards = b->traction_face % 2 ? -1 : 1,
                        .base = p + Z * u,
                        .Z = Z,
                        .least = k->strength.none.least_pressure };
}
