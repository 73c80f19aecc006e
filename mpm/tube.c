/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/tube.h"

#include "mpm/law/law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CELLS = 1000000 };
static const double COURANT = 0.5;
static const double SILENT = 1e-15; /* of the piston's velocity: what a node may miss of a wave that begins to come */
/* Viscosity as (M-5), for a front of a few cells that does not ring; the material's own is made for the solver. */
static const double LINEAR = 0.1, QUADRATIC = 2.0;

struct mpm_tube {
    mpm_tube_setup is;
    law law;
    double c0, slope; /* us = c0 + slope up */
    double q1, q2;    /* viscosity */
    double least;     /* cavitation pressure [Pa] */
    double mass;      /* of a cell [kg/m2] */
    int n;            /* cells */
    int awake;        /* nodes up to this one move; nothing has reached the others */
    double *x, *v;    /* [n + 1] nodes [m, m/s] */
    double *e, *P;    /* [n] cells: energy, pressure with viscosity [J/kg, Pa] */
    double *x0, *v0;  /* as they were before the step */
    double *e0, *P0;
    double time;
    double impulse, work; /* that the far end has given, along x [N s/m2, J/m2] */
};

static double node_mass(const mpm_tube *t, int i)
{
    const double half = 0.5 * t->mass;
    if (i == 0) return half + t->is.piston_mass;
    if (i == t->n) return half + (t->is.end == TUBE_PLATE ? t->is.plate_mass : 0);
    return t->mass;
}

/* Pressure of what lies behind the far end: fluid that goes on sends nothing back (a simple wave). */
static double pressure_beyond(const mpm_tube *t, double u)
{
    if (t->is.end != TUBE_GOES_ON) return 0;
    return t->law.rho0 * (t->c0 + t->slope * fmax(u, 0)) * u;
}

static double sound_speed(const mpm_tube *t, double p, double rho)
{
    return sqrt(fmax(t->law.K0 + (4 * t->slope - 1) * p, 0.1 * t->law.K0) / rho);
}

static double cell_density(const mpm_tube *t, int j)
{
    return t->mass / (t->x[j + 1] - t->x[j]);
}

/* Cut at the cavitation pressure, with the viscosity of what moves now. */
static double cell_pressure(const mpm_tube *t, int j)
{
    const double rho = cell_density(t, j), squeeze = fmax(t->v[j] - t->v[j + 1], 0);
    const double p = fmax(mpm_law_pressure(&t->law, rho * t->law.volume0 - 1, t->e[j]), t->least);
    return squeeze > 0 ? p + rho * squeeze * (t->q1 * sound_speed(t, p, rho) + t->q2 * squeeze) : p;
}

static status setup_check(const mpm_tube_setup *s)
{
    CHECK(s->length > 0, STATUS_BAD_INPUT, "tube: length = %g m: must be above zero", s->length);
    CHECK(s->piston_mass > 0, STATUS_BAD_INPUT, "tube: piston_mass = %g kg/m2: must be above zero", s->piston_mass);
    CHECK(s->cells >= 2 && s->cells <= MOST_CELLS, STATUS_BAD_INPUT, "tube: %d cells: must be 2 .. %d", s->cells,
          MOST_CELLS);
    CHECK(s->end != TUBE_PLATE || s->plate_mass > 0, STATUS_BAD_INPUT,
          "tube: plate_mass = %g kg/m2: must be above zero", s->plate_mass);
    CHECK(mpm_material_shear(s->fluid) == MPM_SHEAR_NONE, STATUS_BAD_INPUT, "tube: %.40s is no fluid (strength: none)",
          s->fluid->name);
    return status_ok();
}

/* The law of the fluid at rest, as a scene would have it. */
static status set_law(mpm_tube *t)
{
    mpm_scene scene;
    mpm_body body = { .name = "tube", .material = t->is.fluid };
    mpm_scene_default(&scene);
    base_params_default(mpm_body_params, &body);
    TRY(mpm_law_make(&body, &scene, &t->law));
    t->c0 = sqrt(t->law.K0 / t->law.rho0), t->slope = mpm_law_slope(&t->law);
    t->q1 = LINEAR, t->q2 = QUADRATIC;
    t->least = t->law.strength.none.least_pressure;
    return status_ok();
}

static status fill(mpm_tube *t)
{
    const size_t nodes = (size_t)t->is.cells + 1;
    TRY(set_law(t));
    t->n = t->is.cells;
    t->x = calloc(8 * nodes, sizeof *t->x);
    CHECK(t->x, STATUS_MEMORY, "no memory for a tube of %d cells", t->n);
    /* in this order: take_step copies the first four at once */
    t->v = t->x + nodes, t->e = t->v + nodes, t->P = t->e + nodes;
    t->x0 = t->P + nodes, t->v0 = t->x0 + nodes, t->e0 = t->v0 + nodes, t->P0 = t->e0 + nodes;
    t->mass = t->law.rho_start * t->is.length / t->n;
    for (int i = 0; i <= t->n; i++) t->x[i] = t->is.length * i / t->n;
    for (int j = 0; j < t->n; j++) t->e[j] = t->law.e_start, t->P[j] = t->law.p_start;
    t->v[0] = t->is.piston_velocity;
    t->awake = 2;
    return status_ok();
}

status mpm_tube_create(const mpm_tube_setup *setup, mpm_tube **out)
{
    *out = NULL;
    TRY(setup_check(setup));
    mpm_tube *t = calloc(1, sizeof *t);
    CHECK(t, STATUS_MEMORY, "no memory for a tube");
    t->is = *setup;
    const status done = fill(t);
    if (done.code == STATUS_OK)
        *out = t;
    else
        mpm_tube_free(t);
    return done;
}

void mpm_tube_free(mpm_tube *t)
{
    if (!t) return;
    free(t->x);
    free(t);
}

/* ---- a step ---- */

/* (W-1) by the forces of P over the whole step, from the state before it. */
static void stage(mpm_tube *t, double dt, bool last)
{
    for (int i = 0; i <= t->awake; i++) {
        const double from = i > 0 ? t->P[i - 1] : 0, to = i < t->n ? t->P[i] : pressure_beyond(t, t->v0[t->n]);
        const bool held = i == t->n && t->is.end == TUBE_WALL;
        t->v[i] = held ? 0 : t->v0[i] + dt * (from - to) / node_mass(t, i);
        t->x[i] = t->x0[i] + 0.5 * dt * (t->v0[i] + t->v[i]);
        if (!last || i < t->n) continue;
        const double push = held ? -from : -to; /* of the end's surroundings on the fluid */
        t->impulse += dt * push;
        t->work += 0.5 * dt * push * (t->v0[i] + t->v[i]);
    }
    for (int j = 0; j < t->awake && j < t->n; j++) {
        const double stretch = t->v0[j + 1] + t->v[j + 1] - t->v0[j] - t->v[j];
        t->e[j] = t->e0[j] - 0.5 * dt * t->P[j] * stretch / t->mass;
    }
}

static void take_step(mpm_tube *t, double dt)
{
    const size_t nodes = (size_t)t->n + 1;
    const int before = t->awake;
    memcpy(t->x0, t->x, 4 * nodes * sizeof *t->x);
    const int cells = t->awake < t->n ? t->awake : t->n;
    stage(t, dt, false);
    for (int j = 0; j < cells; j++) t->P[j] = 0.5 * (t->P0[j] + cell_pressure(t, j));
    stage(t, dt, true);
    for (int j = 0; j < cells; j++) t->P[j] = cell_pressure(t, j);
    if (t->awake < t->n && fabs(t->v[before - 1]) > SILENT * fabs(t->is.piston_velocity)) t->awake++;
    t->time += dt;
}

static double longest_step(const mpm_tube *t)
{
    double rate = 0;
    for (int j = 0; j < t->awake && j < t->n; j++) {
        const double squeeze = fmax(t->v[j] - t->v[j + 1], 0), rho = cell_density(t, j);
        const double fast = (1 + 2 * t->q1) * sound_speed(t, t->P[j], rho) + 4 * t->q2 * squeeze;
        rate = fmax(rate, fast / (t->x[j + 1] - t->x[j]));
    }
    return COURANT / rate;
}

void mpm_tube_step(mpm_tube *t)
{
    take_step(t, longest_step(t));
}

void mpm_tube_advance(mpm_tube *t, double until)
{
    while (t->time < until) {
        const double dt = longest_step(t);
        if (t->time + dt >= until) {
            take_step(t, until - t->time);
            t->time = until;
        } else {
            take_step(t, dt);
        }
    }
}

/* ---- what it is at ---- */

mpm_tube_state mpm_tube_now(const mpm_tube *t)
{
    const double v = t->is.piston_velocity, energy = 0.5 * node_mass(t, 0) * v * v, momentum = node_mass(t, 0) * v;
    mpm_tube_state s = { .time = t->time,
                         .piston_velocity = t->v[0],
                         .piston_pressure = t->P[0],
                         .end_pressure = t->P[t->n - 1],
                         .end_velocity = t->v[t->n],
                         .end_way = t->x[t->n] - t->is.length,
                         .momentum_error = -momentum - t->impulse,
                         .energy_error = -energy - t->work };
    for (int i = 0; i <= t->n; i++) {
        const double m = node_mass(t, i);
        s.momentum_error += m * t->v[i];
        s.energy_error += 0.5 * m * t->v[i] * t->v[i];
    }
    for (int j = 0; j < t->n; j++) {
        s.energy_error += t->mass * (t->e[j] - t->law.e_start);
        s.void_length += fmax(0, t->x[j + 1] - t->x[j] - t->is.length / t->n);
    }
    s.momentum_error /= momentum, s.energy_error /= energy;
    return s;
}

double mpm_tube_time(const mpm_tube *t)
{
    return t->time;
}

double mpm_tube_pressure(const mpm_tube *t, double x)
{
    const double at = x / t->is.length * t->n - 0.5;
    const int j = at < 0 ? 0 : at > t->n - 2 ? t->n - 2 : (int)at;
    const double share = fmin(fmax(at - j, 0), 1);
    return (1 - share) * t->P[j] + share * t->P[j + 1];
}
