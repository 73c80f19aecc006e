/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/wave.h"

#include <math.h>
#include <stdlib.h>

/* Of a piston's tube: cells of so much, finer for a light piston, whose wave decays over M/rho0. */
static const double TUBE_CELL = 0.5e-3; /* [m] */
enum { CELLS_A_DECAY = 40, FEWEST_CELLS = 100, MOST_CELLS = 10000 };
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
    CHECK(!mpm_wave_is_wanted(b) || mpm_material_shear(b->material) == MPM_SHEAR_NONE, STATUS_BAD_INPUT,
          "body `%s` of %.40s: a wave enters fluids only (strength: none)", b->name, b->material->name);
    return status_ok();
}

/* ---- the wave of a piston ---- */

/* What the tube's end has now. */
static status add_row(mpm_wave *w, double p)
{
    if (!(w->n & (w->n - 1))) {
        const size_t room = w->n ? 2 * (size_t)w->n : 1;
        double *time = realloc(w->time, room * sizeof *time);
        if (time) w->time = time;
        double *incident = time ? realloc(w->incident, room * sizeof *incident) : NULL;
        if (incident) w->incident = incident;
        CHECK(incident, STATUS_MEMORY, "no memory for a wave of %d rows", w->n);
    }
    w->time[w->n] = mpm_tube_time(w->tube) - w->arrival;
    w->incident[w->n++] = p;
    return status_ok();
}

/* Its front comes to the end of the column a little faster than sound.  What a long way through the fluid has worn
 * down to nothing never does. */
static status wait_for_front(mpm_wave *w, const mpm_body *b, double c0)
{
    const double until = 2 * b->tube_length / c0;
    for (;;) {
        mpm_tube_step(w->tube);
        const double p = mpm_tube_pressure(w->tube, b->tube_length);
        w->arrival = mpm_tube_time(w->tube);
        if (p >= FRONT * w->acoustic) return add_row(w, p);
        CHECK(w->arrival < until, STATUS_BAD_INPUT,
              "body `%s`: of the piston's wave not %g %% comes to the end of the tube within %g s; take a shorter "
              "tube_length than %g m or a heavier piston than %g kg/m2",
              b->name, 100 * FRONT, until, b->tube_length, b->piston_mass);
    }
}

static status make_piston(const mpm_body *b, const law *k, mpm_wave *w)
{
    const double Z = sqrt(k->rho0 * k->K0), decay = b->piston_mass / k->rho0; /* of the wave, as a length */
    const double cells = fmax(b->tube_length / fmin(TUBE_CELL, decay / CELLS_A_DECAY), FEWEST_CELLS);
    CHECK(cells <= MOST_CELLS, STATUS_BAD_INPUT,
          "body `%s`: a tube_length of %g m would take %.0f cells, as a piston_mass of %g kg/m2 wants them; at most %d "
          "are computed: take a tube of at most %g m%s",
          b->name, b->tube_length, cells, b->piston_mass, MOST_CELLS, b->tube_length * MOST_CELLS / cells,
          decay / CELLS_A_DECAY < TUBE_CELL ? " or a heavier piston" : "");
    const mpm_tube_setup setup = { .fluid = b->material,
                                   .piston_mass = b->piston_mass,
                                   .piston_velocity = b->piston_velocity,
                                   .length = b->tube_length,
                                   .end = TUBE_GOES_ON,
                                   .cells = (int)cells };
    TRY(mpm_tube_create(&setup, &w->tube));
    w->acoustic = Z * b->piston_velocity, w->longest = LATEST * b->piston_mass / Z, w->length = b->tube_length;
    return wait_for_front(w, b, sqrt(k->K0 / k->rho0));
}

status mpm_wave_reach(mpm_wave *w, double t)
{
    while (w->tube && w->time[w->n - 1] < t) {
        mpm_tube_step(w->tube);
        const double p = mpm_tube_pressure(w->tube, w->length);
        TRY(add_row(w, p));
        w->peak = fmax(w->peak, p);
        const bool gone = p < 0.5 * w->peak && p < NOTHING * w->acoustic;
        if (!gone && w->time[w->n - 1] <= w->longest) continue;
        mpm_tube_free(w->tube), w->tube = NULL;
    }
    return status_ok();
}

status mpm_wave_make(const mpm_body *b, const law *k, mpm_wave *out)
{
    *out = (mpm_wave){ .tube = NULL };
    if (!mpm_wave_is_wanted(b)) return status_ok();
    if (!isnan(b->piston_mass)) return make_piston(b, k, out);
    out->pressure = b->wave_pressure;
    out->rate = isnan(b->wave_decay) ? 0 : 1 / b->wave_decay;
    return status_ok();
}

void mpm_wave_free(mpm_wave *w)
{
    mpm_tube_free(w->tube);
    free(w->time), free(w->incident);
}

static double incident_pressure(const mpm_wave *w, double t)
{
    if (w->n == 0) return w->pressure * exp(-w->rate * t);
    if (!w->tube && t >= w->time[w->n - 1]) return 0;
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
                        .base = k->p_start + p + Z * u,
                        .Z = Z,
                        .least = k->strength.none.least_pressure };
}
