/* SPDX-License-Identifier: BSD-3-Clause */
/* The armature: what pushes and holds it, what its contact costs.  Equations (C-3) .. (C-7), (C-20) .. (C-22):
 * docs/theory/circuit.md. */
#include "base/constants.h"
#include "circuit/shot_model.h"

#include <math.h>

/* mu(v) = mu1 + (mu0 - mu1) exp(-v/v_f)                                                   (C-4) */
static double friction_coefficient(const circuit_shot_armature *a, double v)
{
    return a->friction_melted + (a->friction_dry - a->friction_melted) * exp(-fmax(v, 0.0) / a->friction_speed);
}

/* Drag of the shocked gas ahead, p0 behind:  rho0 u_s v A,
 * u_s = (g + 1)/4 v + sqrt(((g + 1) v/4)^2 + a^2)                                         (C-5) [N] */
static double gas_drag(const shot_model *m, double v)
{
    const double half = 0.25 * (m->armature.gas_gamma + 1.0) * v;
    return m->armature.gas_density * (half + sqrt(half * half + m->sound_speed * m->sound_speed)) * v * m->bore_area;
}

double circuit_shot_hold_force(const shot_model *m, double I)
{
    return m->faces * m->armature.friction_dry * (m->armature.preload + m->armature.spreading * I * I);
}

double circuit_shot_push(const shot_model *m, double v, double I)
{
    return 0.5 * circuit_rails_force_gradient(&m->rails, fmax(v, 0.0), I) * I * I;
}

/* Contact voltage U I/sqrt(I^2 + knee^2): its sign follows the current where that can reverse. */
static double contact_voltage(const shot_model *m, double U, double I)
{
    return m->knee > 0.0 ? U * I / sqrt(I * I + m->knee * m->knee) : U;
}

double circuit_shot_crowding(const shot_model *m, const shot_forces *f, double v)
{
    return m->armature.contact_length / circuit_contact_spread(&m->rails.contact, fmax(v, 0.0), f->I - f->shunt);
}

double circuit_shot_friction_heat(const shot_model *m, const shot_forces *f, double v)
{
    return f->friction * v / (m->faces * m->contact_area);
}

double circuit_shot_current_heat(const shot_model *m, const shot_forces *f)
{
    return m->armature.contact_voltage * fabs(f->I - f->shunt) / (m->faces * m->contact_area);
}

/* Solid until its face has melted; then the melt's shear, unless the solid's is less.                   (C-20), (C-21)
 */
static void film_friction(const shot_model *m, double v, shot_forces *f)
{
    f->mu = m->armature.friction_dry;
    if (!m->melted || !(f->contact > 0.0)) return;
    const double P = f->contact / m->contact_area;
    const melt_flow melt = circuit_melt_film_at(&m->film, v, P, circuit_shot_current_heat(m, f));
    f->film = melt.thickness;
    f->mu = fmin(f->mu, melt.shear / P);
}

double circuit_shot_total_current(const shot_drive *d, const shot_model *m)
{
    double I = 0.0;
    for (int f = 0; f < m->reached; f++) I += d->I[f];
    return I;
}

/* m dv/dt = F - n mu(v) N - drag on n faces,  N = preload + k I^2                                     (C-3)
 * with a shunt F = F(I) - 1/2 L_inf i_m^2: its current i_m flows ahead of the armature, which carries I - i_m
 * (C-15) */
shot_forces circuit_shot_forces_at(const shot_model *m, const shot_drive *d, const double *z)
{
    const bool left = m->phase == CIRCUIT_SHOT_LEFT;
    shot_forces f = { .I = circuit_shot_total_current(d, m), .shunt = z[Y_SHUNT] };
    const double v = z[Y_V], I = f.I - f.shunt;
    f.R = left ? m->barrel.muzzle_resistance : m->armature.resistance;
    f.drop = contact_voltage(m, left ? m->barrel.muzzle_voltage : m->armature.contact_voltage, I);
    if (!d->any && !m->shunt) f.drop = 0.0;
    f.voltage = f.R * I + f.drop;
    if (left) return f;
    f.force = circuit_shot_push(m, v, f.I) - 0.5 * m->rails.ladder.L_inf * f.shunt * f.shunt;
    f.contact = m->armature.preload + m->armature.spreading * I * I;
    f.mu = m->phase == CIRCUIT_SHOT_HELD ? m->armature.friction_dry : friction_coefficient(&m->armature, v);
    if (m->phase == CIRCUIT_SHOT_HELD) {
        f.friction = fmin(fmax(f.force, 0.0), circuit_shot_hold_force(m, I));
        return f;
    }
    if (m->armature.friction_law == CIRCUIT_SHOT_FRICTION_FILM) film_friction(m, v, &f);
    f.friction = m->faces * f.mu * f.contact;
    f.drag = gas_drag(m, v);
    f.net = f.force - f.friction - f.drag;
    return f;
}

void circuit_shot_armature_rates(const shot_model *m, const double *z, const shot_forces *f, double *q)
{
    const double I = f->I - f->shunt, v = m->phase == CIRCUIT_SHOT_MOVING ? z[Y_V] : 0.0;
    q[Y_ARMATURE] = f->R * I * I;
    q[Y_CONTACT] = f->drop * I;
    if (m->phase != CIRCUIT_SHOT_MOVING) return;
    q[Y_X] = v;
    q[Y_V] = f->net / z[Y_MASS];
    q[Y_FRICTION] = f->friction * v;
    q[Y_DRAG] = f->drag * v;
    const bool solid = m->armature.friction_law == CIRCUIT_SHOT_FRICTION_FILM && !m->melted;
    const double wear = solid ? 0.0 : m->armature.wear_fraction * (q[Y_FRICTION] + q[Y_CONTACT]) / m->wear_heat;
    q[Y_MASS] = -wear;
    q[Y_WEAR] = 0.5 * wear * v * v; /* melt leaves at the armature's speed and takes its motion along */
}

/* Half-space heated by flux q that has brought E per area: rise 2 sqrt(q E/pi)/sqrt(k rho c); exact for a constant
 * flux.  With a
 * velocity skin effect E counts the current's heat as if it had always been as crowded as now.          (C-7) */
double circuit_shot_face_rise(const shot_model *m, const shot_forces *f, const double *z)
{
    const circuit_shot_armature *a = &m->armature;
    const double v = z[Y_V], crowding = circuit_shot_crowding(m, f, v);
    const double q = a->heat_share * (circuit_shot_friction_heat(m, f, v) + crowding * circuit_shot_current_heat(m, f));
    const double E = a->heat_share * (z[Y_FRICTION] + crowding * z[Y_CONTACT]) / (m->faces * m->contact_area);
    return 2.0 * sqrt(fmax(q * E, 0.0) / PI) / sqrt(a->thermal_conductivity * a->density * a->specific_heat);
}

double circuit_shot_melting(const shot_model *m, const shot_forces *f, const double *z)
{
    static const double CREEP = 1e-3; /* [m/s] */
    const double to_melting = m->armature.melting_temperature - m->armature.initial_temperature;
    return fmin(circuit_shot_face_rise(m, f, z) / to_melting - 1.0, z[Y_V] / CREEP - 1.0);
}
