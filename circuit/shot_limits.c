/* Temperatures at the contact, and how near armature and rail come to their limits. */
#include "circuit/shot_internal.h"

#include <math.h>

static const double PI = 3.14159265358979324;
static const double MU0 = 1.25663706212e-6;       /* [H/m] */
static const double GRAM_FORCE = 9.80665e-3;      /* [N] */
static const double CURRENT_ON_INNER_FACE = 0.40; /* mean surface current over I/height, weighted with itself [1] */
static const double CURRENT_THAT_COUNTS = 0.1; /* of the peak so far: below, the contact's rule is not asked for [1] */

/* ---- temperatures ---- */

/* Heat into both contact faces together: friction and contact voltage [W]. */
static double contact_power(const shot *s, const shot_state *st)
{
    return st->friction * st->v + s->model.armature.contact_voltage * fabs(st->current - st->shunt_current);
}

/* Half-space heated by flux q that has brought E per area: T = T_0 + 2 sqrt(q E/pi)/sqrt(k rho c); exact for a constant
 * flux, at most melting                                                                    (C-7) [K] */
double shot_face_temperature(const shot *s, const shot_state *st)
{
    const shot_armature *a = &s->model.armature;
    const double share = a->heat_share / (2.0 * s->model.contact_area);
    const double q = share * contact_power(s, st), E = share * (st->ledger.friction + st->ledger.contact_heat);
    const double rise =
        2.0 * sqrt(fmax(q * E, 0.0) / PI) / sqrt(a->thermal_conductivity * a->density * a->specific_heat);
    return fmin(s->armature_temperature + rise, fmax(a->melting_temperature, s->armature_temperature));
}

/* Film of melt under one face, carried at half the speed (Couette): thickness 2 (dm/dt)/(rho width v), and the flux q into
 * the armature has to cross half of it: T = T_m + q thickness/(2 k).  Nothing melted: the face's temperature.  (C-16) [K] */
double shot_film_temperature(const shot *s, const shot_state *st)
{
    const shot_armature *a = &s->model.armature;
    const bool melted = st->armature_temperature >= a->melting_temperature;
    if (!melted || !(st->v > 0.0)) return st->armature_temperature;
    const double q = a->heat_share * contact_power(s, st) / (2.0 * s->model.contact_area);
    const double wear = a->wear_fraction * contact_power(s, st) / (2.0 * s->model.wear_heat);
    const double width = s->model.contact_area / a->contact_length;
    const double thickness = 2.0 * wear / (a->density * width * st->v);
    return a->melting_temperature + 0.5 * q * thickness / a->thermal_conductivity;
}

/* Rail surface one contact length l behind the trailing edge, t = l/v (at most the shot's age) after the passage that took as long.  Its share q of
 * the contact's heat: 2 q (sqrt(2 t) - sqrt(t))/sqrt(pi k rho c).  The current, K = P I/height on the surface from the
 * passage on, heats by int rho J^2 dt = mu0 K^2/pi ln(2 t/t): the integral is cut off at t, under the contact.  (C-17) [K] */
double shot_rail_behind_temperature(const shot *s, const shot_state *st)
{
    const shot_armature *a = &s->model.armature;
    const shot_rails *r = &s->rails;
    if (st->phase != SHOT_MOVING || !(st->v > 0.0)) return s->rail_temperature;
    const double t = fmin(a->contact_length / st->v, s->t),
                 q = (1.0 - a->heat_share) * contact_power(s, st) / (2.0 * s->model.contact_area);
    const double contact =
        2.0 * q * (sqrt(2.0 * t) - sqrt(t)) / sqrt(PI * r->thermal_conductivity * r->density * r->specific_heat);
    const double K = CURRENT_ON_INNER_FACE * st->current / r->height;
    return s->rail_temperature + contact + MU0 * K * K / PI * log(2.0) / (r->density * r->specific_heat);
}

/* ---- limits ---- */

/* Action per area squared from the start to melting, heated evenly and without loss: rho c dT = rho_e j^2 dt gives
 * rho c/(rho_e alpha) ln(1 + alpha (T_m - T_0)), rho_e and alpha at T_0                     (C-18) [A^2 s/m^4] */
static double melt_action(const shot_armature *a)
{
    const double warm = 1.0 + a->resistivity_coefficient * (a->temperature - 293.15);
    const double alpha = a->resistivity_coefficient / warm, rise = a->melting_temperature - a->temperature;
    const double span = alpha > 0.0 ? log1p(alpha * rise) / alpha : rise;
    return a->density * a->specific_heat * span / (a->resistivity * warm);
}

/* A load moving over a beam (bending stiffness E I, mass per length m) on a bed of stiffness k outruns its bending waves at
 * v^2 = 2 sqrt(k E I)/m, I = height thickness^3/12                                          (C-19) [m/s] */
static double critical_velocity(const shot_rails *r)
{
    const double bending = r->youngs_modulus * r->height * r->thickness * r->thickness * r->thickness / 12.0;
    return sqrt(2.0 * sqrt(r->backing_stiffness * bending) / (r->density * r->height * r->thickness));
}

void shot_limits_start(shot *s)
{
    s->limits = (shot_limits){ .contact_ratio = NAN,
                               .leg_action = NAN,
                               .throat_action = NAN,
                               .wear_share = NAN,
                               .critical_velocity = critical_velocity(&s->rails),
                               .contact_position = NAN,
                               .transition_position = NAN,
                               .critical_position = NAN };
}

static void first_place(double *place, bool over, double x)
{
    if (over && isnan(*place)) *place = x;
}

void shot_limits_update(shot *s, const shot_forces *f)
{
    const shot_armature *a = &s->model.armature;
    const double *z = shot_z(s), I = fabs(f->I - f->shunt), x = z[Y_X];
    shot_limits *l = &s->limits;
    if (s->model.phase != SHOT_MOVING) return;
    if (I > CURRENT_THAT_COUNTS * s->result.peak_current) {
        const double ratio = f->contact / (GRAM_FORCE * I);
        l->contact_ratio = fmin(ratio, isnan(l->contact_ratio) ? INFINITY : l->contact_ratio);
        first_place(&l->contact_position, ratio < 1.0, x);
    }
    const double melting = melt_action(a),
                 worn = (a->mass - s->mass_jumps - z[Y_MASS]) / (2.0 * a->density * s->model.contact_area);
    l->leg_action = z[Y_ACTION] / (melting * a->leg_area * a->leg_area);
    l->throat_action = z[Y_ACTION] / (melting * a->throat_area * a->throat_area);
    l->wear_share = worn / a->leg_thickness;
    const bool over = l->contact_ratio < 1.0 || l->leg_action > 1.0 || l->throat_action > 1.0 || l->wear_share > 1.0;
    first_place(&l->transition_position, over, x);
    first_place(&l->critical_position, z[Y_V] > l->critical_velocity, x);
}

shot_limits shot_limits_of(const shot *s)
{
    return s->limits;
}
