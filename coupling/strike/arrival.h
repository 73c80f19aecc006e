/* SPDX-License-Identifier: BSD-3-Clause */
/* From the muzzle to the target: the projectile of a scene of bodies, its flight, the scene that it arrives in.
 *
 * The projectile is all bodies of the group of `strike.projectile`; all others are its target.  It flies along its own
 * velocity in scene.bodies, along +x where that is zero, and arrives with
 *   strike.velocity, where that is given (with `optimise`, goal velocity, by a charge that is found for it);
 *   else what drag leaves of the shot's muzzle velocity, where the case has a shot;
 *   else the speed it has in scene.bodies.
 * Where `strike.projectile` is a body of fluid with a piston (mpm_body.piston_mass), what flies drives that piston: the
 * arrival velocity is the piston's, its mass the piston's on the area of the face that the wave enters.
 * Flight with a constant drag coefficient, straight, without gravity:
 *   dv/dx = - rho Cd A v / (2 m)    v(L) = v0 exp(-k L)    t = (exp(k L) - 1) / (k v0)    k = rho Cd A / (2 m)  
 * A scene may be cut by mirror planes: masses and energies here are those of the whole. */
#ifndef BREECH_COUPLING_STRIKE_ARRIVAL_H
#define BREECH_COUPLING_STRIKE_ARRIVAL_H

#include "coupling/case/case_plain.h"

/* Names of the probes that are added to the scene. */
#define STRIKE_FORCE_PROBE "projectile_force"
#define STRIKE_WAY_PROBE "projectile_way"
#define STRIKE_PLATE_PROBE "plate_surface"
#define STRIKE_CAVITY_PROBE "cavitated"

/* Metal of the target that is slower than this part of the arrival velocity, or than this velocity where that is more,
 * stays where it is: a panel that swings after a slow arrival does not fly [1, m/s]. */
#define STRIKE_SLOW 0.1
#define STRIKE_SWINGS 20.0

typedef struct {
    int body, group, plate; /* of scene.bodies; plate -1: none */
    double n[3];            /* direction of flight, a unit vector [1] */
    double from[3];         /* its middle at the start, on the mirror planes that cut it [m] */
    double half_width;      /* how far it reaches to the side of the line through there [m] */
    double parts;           /* the whole over what is computed: 2 for each mirror plane that it lies at [1] */
    double mass;            /* of the whole [kg] */
    double speed;           /* that it has in scene.bodies [m/s] */
    bool piston;            /* it is not in the scene, but drives a piston: `body` is the fluid that its wave enters */
} strike_projectile;

/* scene_fill for a case with a strike: the window holds the projectile until its strike.travel is over, the fine zone
 * the plate through which it flies along an axis, unless that is thicker than twice the projectile is long; an end_time
 * that is not given is that of the travel.  STATUS_BAD_INPUT as scene_fill, and where that end is not known. */
status strike_fill(case_inputs *in);

/* STATUS_BAD_INPUT: it reaches out of the window, or flies into a mirror plane; fluid would leak through the plate. */
status strike_projectile_of(const case_inputs *in, strike_projectile *out);

/* What flies on and what stays behind at the muzzle must be what the shot launches, `package` [kg].  STATUS_BAD_INPUT
 * names all three. */
status strike_package_check(const case_strike *s, double mass, double package);

typedef struct {
    double velocity; /* at arrival [m/s] */
    double time;     /* [s] */
} strike_flight;
/* of a projectile of so much mass. */
strike_flight strike_fly(const case_strike *s, double mass, double muzzle_velocity);
/* The muzzle velocity with which it arrives so fast [m/s]. */
double strike_muzzle_for(const case_strike *s, double mass, double arrival_velocity);

/* The case's scene with the projectile at this speed, its probes and its end; out->scene is for mpm_scene_free.
 * STATUS_BAD_INPUT: a probe has one of the names above; the plate is not seen along an axis. */
status strike_scene(const case_inputs *in, const strike_projectile *p, double velocity, case_bodies *out);

#endif
