/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/vessel/vessel.h"

#include "base/constants.h"
#include "circuit/dae.h"
#include "coupling/vessel/film.h"

#include <math.h>
#include <string.h>

static const double LAST = 1e-3; /* part of a bubble's gas that leaves slower */

/* Unknowns, each over its scale: molar volume, volume inside the film, moles of the bubbles. */
enum { MOLAR, INSIDE, MOLES };

typedef struct {
    const case_vessel *is;
    int dimension, bubbles;
    film film;
    mpm_point_law *film_law, *liquid_law;
    mpm_gas gas;
    double liquid;                    /* its volume without pressure [m3] */
    double molar, inside;             /* scales: at the start [m3/mol, m3] */
    double moles;                     /* the same of all bubbles [mol] */
    double start[VESSEL_MAX_BUBBLES]; /* of each bubble [mol] */
    int largest;                      /* bubble */
    bool burst;
    double at_rupture; /* moles of the largest then [mol] */
} model;

static int dimension_of(const case_vessel *c)
{
    return c->shape == VESSEL_CYLINDER ? 2 : 3;
}

static void model_free(model *m)
{
    vessel_film_free(&m->film);
    mpm_point_law_free(m->film_law);
    mpm_point_law_free(m->liquid_law);
}

static status model_make(const vessel_how *how, model *m)
{
    const case_vessel *c = how->is;
    *m = (model){ .is = c, .dimension = dimension_of(c), .bubbles = c->bubbles.n };
    const int d = m->dimension;
    m->gas = mpm_gas_make(c->temperature, c->critical_temperature, c->critical_pressure);
    TRY(mpm_point_law_make(how->film, c->temperature, &m->film_law));
    TRY(mpm_point_law_make(how->liquid, c->temperature, &m->liquid_law));
    m->inside = vessel_volume(d, c->radius - c->film_thickness);
    TRY(vessel_film_make(m->film_law, d, c->layers, m->inside, vessel_volume(d, c->radius), &m->film));
    m->molar = mpm_gas_molar_volume(&m->gas, c->ambient);
    m->liquid = m->inside;
    for (int k = 0; k < m->bubbles; k++) {
        const double volume = vessel_volume(d, c->bubbles.item[k].radius);
        m->liquid -= volume, m->start[k] = volume / m->molar, m->moles += m->start[k];
        if (m->start[k] > m->start[m->largest]) m->largest = k;
    }
    return status_ok();
}

/* ---- the equations ---- */

static double pressure_of(const model *m, const double *y)
{
    return mpm_gas_pressure(&m->gas, y[MOLAR] * m->molar) - m->is->ambient;
}

static double bubble_radius(const model *m, const double *y, int k)
{
    return vessel_radius(m->dimension, fmax(y[MOLES + k] * m->moles * y[MOLAR] * m->molar, 0.0));
}

/* (G-4); a bubble without a radius does not grow. */
static double growth(const model *m, double radius)
{
    const int d = m->dimension;
    const double rate = 6.0 * m->is->growth * m->is->growth * m->is->diffusivity / PI;
    return radius > 0.0 ? d * vessel_volume(d, radius) / (radius * radius) * rate / m->molar : 0.0;
}

/* (G-5) from the largest bubble with so many moles left, whose last part leaves ever slower; an orifice of a cylinder
 * is a slit as long as that. */
static double vent(const model *m, double pressure, double moles)
{
    const case_vessel *c = m->is;
    const mpm_orifice hole = { m->dimension == 2 ? c->hole : 0.25 * PI * c->hole * c->hole, c->discharge, c->gas_gamma,
                               c->molar_mass };
    const double flow = mpm_gas_flow(&hole, c->temperature, pressure + c->ambient, c->ambient);
    return m->burst && moles > 0.0 ? flow * moles / (moles + LAST * m->at_rupture) : 0.0;
}

static double rate_of(const model *m, const double *y, int k)
{
    return growth(m, bubble_radius(m, y, k)) -
           (k == m->largest ? vent(m, pressure_of(m, y), y[MOLES + k] * m->moles) : 0.0);
}

static double damage_at(const model *m, double t, const double *y)
{
    double damage;
    vessel_film_at(&m->film, t, y[INSIDE] * m->inside, &damage, NULL);
    return damage;
}

static void residual(const void *model_, double t, const double *y, const double *yp, double *r)
{
    const model *m = model_;
    const double p = pressure_of(m, y), inside = y[INSIDE] * m->inside;
    double moles = 0.0;
    for (int k = 0; k < m->bubbles; k++) {
        moles += y[MOLES + k] * m->moles;
        r[MOLES + k] = yp[MOLES + k] - rate_of(m, y, k) / m->moles;
    }
    r[MOLAR] = (p - vessel_film_at(&m->film, t, inside, NULL, NULL)) / m->is->ambient;
    r[INSIDE] =
        (inside - m->liquid / mpm_point_law_compression(m->liquid_law, p) - moles * y[MOLAR] * m->molar) / m->inside;
}

static void roots(const void *model_, double t, const double *y, double *g)
{
    const model *m = model_;
    g[0] = m->burst ? 1.0 : 1.0 - damage_at(m, t, y);
}

/* By differences to the side where the volume goes, up to the rupture and down from there: a film that flows has a bend
 * at the strain it has. */
static void jacobian(const void *model_, double t, double cj, const double *y, arrow *J)
{
    const model *m = model_;
    const int n = MOLES + m->bubbles;
    double at[MOLES + VESSEL_MAX_BUBBLES], here[MOLES + VESSEL_MAX_BUBBLES], r[MOLES + VESSEL_MAX_BUBBLES];
    static const double rest[MOLES + VESSEL_MAX_BUBBLES] = { 0.0 };
    memcpy(at, y, (size_t)n * sizeof *at);
    residual(m, t, at, rest, here);
    for (int j = 0; j < n; j++) {
        const double step = (m->burst ? -1e-7 : 1e-7) * fmax(fabs(y[j]), 1e-3);
        at[j] = y[j] + step;
        residual(m, t, at, rest, r);
        at[j] = y[j];
        for (int i = 0; i < n; i++) J->E[i * n + j] = (r[i] - here[i]) / step;
        if (j >= MOLES) J->E[j * n + j] += cj;
    }
}

/* ---- the run ---- */

static vessel_state state_at(const model *m, double t, const double *y)
{
    const double inside = y[INSIDE] * m->inside, solid = m->film.outer - m->film.inner;
    const int d = m->dimension;
    film_layer next[VESSEL_MAX_LAYERS];
    vessel_film_at(&m->film, t, inside, NULL, next);
    vessel_state s = { .time = t,
                       .swelling = vessel_radius(d, inside + solid) / m->is->radius,
                       .pressure = pressure_of(m, y),
                       .film = vessel_radius(d, inside + solid) - vessel_radius(d, inside),
                       .strain = next[0].flowed,
                       .damage = next[0].damage,
                       .bubble = bubble_radius(m, y, m->largest),
                       .flow = vent(m, pressure_of(m, y), y[MOLES + m->largest] * m->moles) };
    for (int k = 0; k < m->bubbles; k++) s.moles += y[MOLES + k] * m->moles;
    return s;
}

static void accept(model *m, double t, const double *y)
{
    vessel_film_at(&m->film, t, y[INSIDE] * m->inside, NULL, m->film.layer);
    m->film.time = t;
}

static const double RELATIVE = 1e-7, ABSOLUTE = 1e-9;

static status begin(model *m, dae *d, double t)
{
    double *y = circuit_dae_y(d), *yp = circuit_dae_yp(d);
    for (int k = 0; k < MOLES + m->bubbles; k++) {
        circuit_dae_atol(d)[k] = ABSOLUTE;
        circuit_dae_differential(d)[k] = k >= MOLES;
        yp[k] = k >= MOLES ? rate_of(m, y, k - MOLES) / m->moles : 0.0;
    }
    circuit_dae_direction(d)[0] = -1;
    return circuit_dae_restart(d, t, RELATIVE, 0.0);
}

static void note(const vessel_how *how, const model *m, const vessel_state *s, vessel_result *out)
{
    out->steps++;
    out->end = *s;
    out->peak_pressure = fmax(out->peak_pressure, s->pressure);
    const double since = s->time - out->rupture.time;
    if (m->burst && isnan(out->vent_time) && s->pressure <= 0.5 * out->rupture.pressure) out->vent_time = since;
    if (how->step) how->step(how->user, s);
}

/* Until it has burst, then until its pressure is gone or no more gas leaves. */
static status swell(const vessel_how *how, model *m, dae *d, vessel_result *out)
{
    enum { PARTS = 100 };
    static const double GONE = 0.01, STILL = 1e-3; /* of the pressure of rupture; of the first flow */
    const double *y = circuit_dae_y(d), end = how->is->end_time;
    double t = 0.0;
    vessel_state s = state_at(m, t, y);
    note(how, m, &s, out);
    while (t < end &&
           !(m->burst && (s.pressure < GONE * out->rupture.pressure || s.flow < STILL * out->rupture.flow))) {
        dae_outcome outcome;
        CHECK(!how->stop || !how->stop(), STATUS_STOPPED, "at %.4g s of %.4g s", t, end);
        TRY(circuit_dae_step(d, fmin(t + end / PARTS, end), &t, &outcome));
        accept(m, t, y);
        s = state_at(m, t, y);
        if (outcome == DAE_ROOT && !m->burst) {
            out->burst = m->burst = true, m->at_rupture = y[MOLES + m->largest] * m->moles;
            out->rupture = s = state_at(m, t, y); /* gas flows from now on */
            TRY(begin(m, d, t));
        }
        note(how, m, &s, out);
    }
    return status_ok();
}

static vessel_result nothing(void)
{
    const vessel_state none = { NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN };
    return (vessel_result){ .rupture = none, .end = none, .vent_time = NAN };
}

static status integrate(const vessel_how *how, model *m, vessel_result *out)
{
    const int n = MOLES + m->bubbles;
    arrow *matrix = NULL;
    dae *d = NULL;
    status s = circuit_arrow_create(0, n, 0, &matrix);
    const dae_problem problem = {
        .n = n, .n_roots = 1, .residual = residual, .roots = roots, .jacobian = jacobian, .model = m, .matrix = matrix
    };
    if (s.code == STATUS_OK) s = circuit_dae_create(&problem, &d);
    if (s.code == STATUS_OK) {
        double *y = circuit_dae_y(d);
        y[MOLAR] = y[INSIDE] = 1.0;
        for (int k = 0; k < m->bubbles; k++) y[MOLES + k] = m->start[k] / m->moles;
        s = begin(m, d, 0.0);
    }
    if (s.code == STATUS_OK) s = swell(how, m, d, out);
    circuit_dae_free(d);
    circuit_arrow_free(matrix);
    return s;
}

status vessel_run(const vessel_how *how, vessel_result *out)
{
    model m;
    *out = nothing();
    status s = model_make(how, &m);
    for (int k = 0; k < how->is->bubbles.n && s.code == STATUS_OK; k++)
        out->laplace =
            fmax(out->laplace, (m.dimension - 1) * how->is->surface_tension / how->is->bubbles.item[k].radius);
    if (s.code == STATUS_OK) s = integrate(how, &m, out);
    model_free(&m);
    return s;
}

status vessel_film_pressure(const vessel_how *how, double swelling, double *pressure)
{
    enum { STEPS = 100 };
    model m;
    status s = model_make(how, &m);
    for (int i = 1; i <= STEPS && s.code == STATUS_OK; i++) {
        const double radius = how->is->radius * (1.0 + (swelling - 1.0) * i / STEPS);
        const double inside = vessel_volume(m.dimension, radius) - m.film.outer + m.film.inner;
        *pressure = vessel_film_at(&m.film, 0.0, inside, NULL, m.film.layer);
    }
    model_free(&m);
    return s;
}

status vessel_possible(const vessel_how *how)
{
    const case_vessel *c = how->is;
    model m;
    CHECK(c->film_thickness < c->radius, STATUS_BAD_INPUT,
          "vessel.film_thickness = %g mm: must be less than vessel.radius = %g mm, or there is nothing inside",
          1e3 * c->film_thickness, 1e3 * c->radius);
    CHECK(isnan(c->critical_temperature) == isnan(c->critical_pressure), STATUS_BAD_INPUT,
          "vessel.critical_temperature and vessel.critical_pressure go together; without both the gas is ideal");
    CHECK(c->bubbles.n >= 1 && c->bubbles.n <= VESSEL_MAX_BUBBLES, STATUS_BAD_INPUT,
          "vessel.bubbles: %d of them, must be 1 .. %d", c->bubbles.n, VESSEL_MAX_BUBBLES);
    CHECK(mpm_material_shear(how->film) != MPM_SHEAR_NONE, STATUS_BAD_INPUT,
          "vessel.film_material = %s: a fluid has no strength to hold a pressure", how->film->name);
    status s = model_make(how, &m);
    const double most = mpm_gas_condenses(&m.gas);
    if (s.code == STATUS_OK && m.liquid <= 0.0)
        s = base_status_error(STATUS_BAD_INPUT,
                              "vessel.bubbles fill more than there is inside the film, %.4g mm across",
                              2e3 * (c->radius - c->film_thickness));
    if (s.code == STATUS_OK && !(c->ambient < most))
        s = base_status_error(
            STATUS_BAD_INPUT,
            "vessel.ambient = %g Pa: this gas is a liquid above %.4g Pa at %g K: give the pressure at "
            "which its law holds, stresses are counted from there",
            c->ambient, most, c->temperature);
    model_free(&m);
    return s;
}
