/* SPDX-License-Identifier: BSD-3-Clause */
/* Temperatures at the contact, and how near armature and rail come to their limits. */
#include "base/constants.h"
#include "circuit/rails/perimeter.h"
#include "circuit/shot_internal.h"

#include <math.h>

static const double GRAM_FORCE = 9.80665e-3;   /* [N] */
static const double CURRENT_THAT_COUNTS = 0.1; /* of the peak so far: below, the contact's rule is not asked for [1] */

/* ---- temperatures ---- */

double circuit_shot_face_temperature(const circuit_shot *s, const shot_forces *f)
{
    const double melting = fmax(s->model.armature.melting_temperature, s->armature_temperature);
    return fmin(s->armature_temperature + circuit_shot_face_rise(&s->model, f, circuit_shot_z(s)), melting);
}

/* The metal's resistivity and its rise at the temperature before the shot [ohm m, 1/K]. */
typedef struct {
    double resistivity, rise;
} before_shot;

static before_shot before(const circuit_shot_armature *a)
{
    const double warm = 1.0 + a->resistivity_coefficient * (a->initial_temperature - 293.15);
    return (before_shot){ a->resistivity * warm, a->resistivity_coefficient / warm };
}

/* ---- the lead face ---- */

/* Of the armature across the rails, that of its contact [m]. */
static double width_of(const circuit_shot *s)
{
    return s->model.contact_area / s->model.armature.contact_length;
}

void circuit_shot_lead_face_start(circuit_shot *s)
{
    const circuit_shot_armature *a = &s->model.armature;
    const before_shot metal = before(a);
    const circuit_lead_face_metal m = { .resistivity = metal.resistivity,
                                        .coefficient = metal.rise,
                                        .heat_capacity = a->density * a->specific_heat,
                                        .start = a->initial_temperature,
                                        .melting = fmax(a->melting_temperature, a->initial_temperature) };
    if (!isnan(a->throat_area)) s->lead_face = circuit_lead_face_start(&m, a->throat_area / width_of(s));
}

void circuit_shot_lead_face_update(circuit_shot *s, const shot_forces *f)
{
    if (isnan(s->model.armature.throat_area)) return;
    circuit_lead_face_advance(&s->lead_face, s->t, (f->I - f->shunt) / width_of(s));
}

double circuit_shot_lead_face_temperature(const circuit_shot *s)
{
    return isnan(s->model.armature.throat_area) ? NAN : s->lead_face.temperature[CIRCUIT_LEAD_FACE_CELLS - 1];
}

/* ---- the contact ---- */

/* Heat per area of one face, both bodies' shares together [W/m^2]. */
static double contact_heat(const circuit_shot *s, const shot_forces *f, double v)
{
    return circuit_shot_friction_heat(&s->model, f, v) + circuit_shot_current_heat(&s->model, f);
}

/* Of one face's melt: that of friction_law film, else what wear leaves behind, carried at half the speed (Couette):
 * 2 w l/v, w the speed at which the face recedes [m] */
double circuit_shot_film_thickness(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st)
{
    const circuit_shot_armature *a = &s->model.armature;
    const bool melted = st->armature_temperature >= a->melting_temperature;
    if (a->friction_law == CIRCUIT_SHOT_FRICTION_FILM) return f->film;
    if (!melted || !(st->v > 0.0)) return 0.0;
    const double w = a->wear_fraction * contact_heat(s, f, st->v) / (a->density * s->model.wear_heat);
    return 2.0 * w * a->contact_length / st->v;
}

/* The flux q into the armature has to cross half of the film: T = T_m + q thickness/(2 k).  No film: the face's
 * temperature. (C-16) [K] */
double circuit_shot_film_temperature(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st)
{
    const circuit_shot_armature *a = &s->model.armature;
    if (!(st->film_thickness > 0.0)) return st->armature_temperature;
    const double q = a->heat_share * contact_heat(s, f, st->v);
    return a->melting_temperature + 0.5 * q * st->film_thickness / a->thermal_conductivity;
}

double circuit_shot_rail_flux(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st)
{
    return st->phase == CIRCUIT_SHOT_MOVING ? (1.0 - s->model.armature.heat_share) * contact_heat(s, f, st->v) : 0.0;
}

status circuit_shot_rail_sheet_start(circuit_shot *s)
{
    circuit_rail_section section;
    TRY(circuit_rails_section(&s->rails, &section));
    return circuit_perimeter_sheet(&section, &s->sheet);
}

double circuit_shot_rail_sheet(const circuit_shot *s, const circuit_shot_state *st)
{
    return s->sheet * st->current / s->rails.height;
}

/* Rail surface one contact length l behind the trailing edge, t = l/v (at most the shot's age) after the passage that
 * took as long.  Its share q of the contact's heat: 2 q (sqrt(2 t) - sqrt(t))/sqrt(pi k rho c).  The current, K = P
 * I/height on the surface from the passage on, heats by int rho J^2 dt = mu0 K^2/pi ln(2 t/t): the integral is cut off
 * at t, under the contact.  (C-17) [K] */
double circuit_shot_rail_behind_temperature(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st)
{
    const circuit_shot_armature *a = &s->model.armature;
    const circuit_shot_rails *r = &s->rails;
    if (st->phase != CIRCUIT_SHOT_MOVING || !(st->v > 0.0)) return s->rail_temperature;
    const double t = fmin(a->contact_length / st->v, s->t), q = circuit_shot_rail_flux(s, f, st);
    const double contact =
        2.0 * q * (sqrt(2.0 * t) - sqrt(t)) / sqrt(PI * r->thermal_conductivity * r->density * r->specific_heat);
    const double K = circuit_shot_rail_sheet(s, st);
    return s->rail_temperature + contact + MU0 * K * K / PI * log(2.0) / (r->density * r->specific_heat);
}

/* ---- limits ---- */

/* Action per area squared from the start to melting, heated evenly and without loss: rho c dT = rho_e j^2 dt gives
 * rho c/(rho_e alpha) ln(1 + alpha (T_m - T_0)), rho_e and alpha at T_0                     (C-18) [A^2 s/m^4] */
static double melt_action(const circuit_shot_armature *a)
{
    const before_shot metal = before(a);
    const double rise = a->melting_temperature - a->initial_temperature;
    const double span = metal.rise > 0.0 ? log1p(metal.rise * rise) / metal.rise : rise;
    return a->density * a->specific_heat * span / metal.resistivity;
}

/* A load moving over a beam (bending stiffness E I, mass per length m) on a bed of stiffness k outruns its bending
 * waves at
 * v^2 = 2 sqrt(k E I)/m, I = height thickness^3/12                                          (C-19) [m/s] */
static double critical_velocity(const circuit_shot_rails *r)
{
    const double bending = r->youngs_modulus * r->height * r->thickness * r->thickness * r->thickness / 12.0;
    return sqrt(2.0 * sqrt(r->backing_stiffness * bending) / (r->density * r->height * r->thickness));
}

void circuit_shot_limits_start(circuit_shot *s)
{
    s->limits = (circuit_shot_limits){ .contact_ratio = NAN,
                                       .leg_action = NAN,
                                       .throat_action = NAN,
                                       .wear_share = NAN,
                                       .melt_position = NAN,
                                       .critical_velocity = critical_velocity(&s->rails),
                                       .contact_position = NAN,
                                       .transition_position = NAN,
                                       .critical_position = NAN };
}

static void first_place(double *place, bool over, double x)
{
    if (over && isnan(*place)) *place = x;
}

/* Thickness worn off one face where it is most: all of what friction melts, and what the current does at the trailing
 * edge.  A worn face is even without a velocity skin effect: then the mass tells. */
static double worn_thickness(circuit_shot *s, const shot_forces *f)
{
    const circuit_shot_armature *a = &s->model.armature;
    const double *z = circuit_shot_z(s);
    if (!a->velocity_skin)
        return (a->mass - s->mass_jumps - z[Y_MASS]) / (s->model.faces * a->density * s->model.contact_area);
    const bool solid = a->friction_law == CIRCUIT_SHOT_FRICTION_FILM && !s->model.melted;
    const double q = circuit_shot_friction_heat(&s->model, f, z[Y_V]) +
                     circuit_shot_crowding(&s->model, f, z[Y_V]) * circuit_shot_current_heat(&s->model, f);
    const double rate = solid ? 0.0 : a->wear_fraction * q / (a->density * s->model.wear_heat);
    s->worn += 0.5 * (rate + s->wear_rate) * (s->t - s->worn_until); /* trapezes over the integrator's own steps */
    s->wear_rate = rate;
    s->worn_until = s->t;
    return s->worn;
}

void circuit_shot_limits_update(circuit_shot *s, const shot_forces *f)
{
    const circuit_shot_armature *a = &s->model.armature;
    const double part = 2.0 / s->model.faces; /* of the current, on one face and in its leg */
    const double *z = circuit_shot_z(s), I = fabs(f->I - f->shunt), x = z[Y_X];
    circuit_shot_limits *l = &s->limits;
    const double melting = melt_action(a);
    l->leg_action = part * part * z[Y_ACTION] / (melting * a->leg_area * a->leg_area);
    l->throat_action = z[Y_ACTION] / (melting * a->throat_area * a->throat_area);
    first_place(&l->transition_position, l->leg_action > 1.0 || l->throat_action > 1.0, x);
    if (s->model.phase != CIRCUIT_SHOT_MOVING) return; /* held, it melts all the same */
    if (I > CURRENT_THAT_COUNTS * s->result.peak_current) {
        const double ratio = f->contact / (GRAM_FORCE * part * I);
        l->contact_ratio = fmin(ratio, isnan(l->contact_ratio) ? INFINITY : l->contact_ratio);
        first_place(&l->contact_position, ratio < 1.0, x);
    }
    l->wear_share = worn_thickness(s, f) / a->wear_thickness;
    first_place(&l->transition_position, l->contact_ratio < 1.0 || l->wear_share > 1.0, x);
    first_place(&l->critical_position, z[Y_V] > l->critical_velocity, x);
}

circuit_shot_limits circuit_shot_limits_of(const circuit_shot *s)
{
    return s->limits;
}
