/* SPDX-License-Identifier: BSD-3-Clause */
/* Parameter tables of the shot: every key, unit, default, range and text stands here once. */
#include "circuit/shot.h"

const char *const circuit_shot_friction_law_names[] = { "speed", "film", NULL };

#define BARREL(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_shot_barrel, member, unit, fallback, min, max, doc)
#define ARMATURE(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_shot_armature, member, unit, fallback, min, max, doc)
#define OPTIONS(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_shot_options, member, unit, fallback, min, max, doc)

const base_param circuit_shot_barrel_params[] = {
    BARREL(length, "m", REQUIRED, 1e-3, 1e3, "breech to muzzle"),
    BARREL(start, "m", 0.05, 0.0, 1e3, "position of the armature's current path at t = 0"),
    BARREL(muzzle_resistance, "ohm", 1e-3, 0.0, 1e3,
           "resistance of the shunt or arc that takes the current after exit"),
    BARREL(muzzle_voltage, "V", 0.0, 0.0, 1e5, "constant voltage of the muzzle arc; 0 for a shunt"),
    BARREL(shunt_resistance, "ohm", OPTIONAL, 0.0, 1e3,
           "of a shunt across the muzzle from the start; none if not given"),
    BARREL(shunt_inductance, "H", 1e-7, 1e-12, 1.0, "of that shunt"),
    PARAMS_END
};

const base_param circuit_shot_armature_params[] = {
    ARMATURE(mass, "kg", REQUIRED, 1e-6, 1e4, "mass, payload included"),
    ARMATURE(velocity, "m/s", 0.0, 0.0, 2e4, "velocity at t = 0"),
    ARMATURE(resistance, "ohm", 0.0, 0.0, 1.0, "resistance between the rails, without the contacts"),
    ARMATURE(contact_voltage, "V", 0.0, 0.0, 1e3, "voltage of both contacts together, from rail to rail"),
    PARAM_ENUM(circuit_shot_armature, friction_law, circuit_shot_friction_law_names, CIRCUIT_SHOT_FRICTION_SPEED,
               "speed: the coefficient falls with speed; film: dry until the face has melted, then the melt's shear"),
    ARMATURE(friction_dry, "1", 0.0, 0.0, 10.0, "friction coefficient at rest"),
    ARMATURE(friction_melted, "1", 0.0, 0.0, 10.0, "friction coefficient on a melted film"),
    ARMATURE(friction_speed, "m/s", 100.0, 1e-3, 1e5, "speed over which the coefficient falls to the melted one"),
    ARMATURE(film_viscosity, "Pa s", 1.3e-3, 1e-6, 10.0, "viscosity of the melt, friction_law film"),
    PARAM_BOOL(circuit_shot_armature, velocity_skin, 0,
               "the current crowds to the trailing edge of the contact as speed rises"),
    ARMATURE(preload, "N", 0.0, 0.0, 1e9, "contact force per rail face without current"),
    ARMATURE(spreading, "N/A^2", 0.0, 0.0, 1e-3,
             "spreading force of the legs per whole current squared, per rail face"),
    ARMATURE(bore_area, "m^2", OPTIONAL, 0.0, 100.0, "area the gas acts on; rail separation x height if not given"),
    ARMATURE(gas_pressure, "Pa", 101325.0, 0.0, 1e8, "gas pressure in the barrel"),
    ARMATURE(gas_density, "kg/m^3", 1.204, 0.0, 1e3, "gas density in the barrel; 0 = evacuated"),
    ARMATURE(gas_gamma, "1", 1.4, 1.001, 2.0, "ratio of specific heats of the gas"),
    ARMATURE(wear_fraction, "1", 0.0, 0.0, 1.0,
             "fraction of the contact's heat that melts metal off; at most heat_share"),
    ARMATURE(specific_heat, "J/kg/K", 848.0, 1.0, 1e5, "specific heat"),
    ARMATURE(melting_temperature, "K", 750.0, 200.0, 5000.0, "melting temperature (solidus)"),
    ARMATURE(latent_heat, "J/kg", 390e3, 0.0, 1e8, "latent heat of fusion"),
    ARMATURE(initial_temperature, "K", 293.15, 200.0, 3000.0,
             "before the shot, for the circuit; a case takes `temperature` where it gives that alone"),
    ARMATURE(density, "kg/m^3", 2804.0, 100.0, 3e4, "density, for the temperature of contact and lead face"),
    ARMATURE(thermal_conductivity, "W/m/K", 130.0, 0.1, 1e4, "thermal conductivity"),
    ARMATURE(contact_length, "m", 0.02, 1e-4, 10.0,
             "of one contact face along the rail; not given: that of the leg's foot"),
    ARMATURE(contact_width, "m", OPTIONAL, 1e-4, 10.0, "of one contact face; not given: width, else the rail's height"),
    ARMATURE(heat_share, "1", 0.5, 0.0, 1.0, "fraction of the contact's heat that enters the armature"),
    ARMATURE(resistivity, "ohm m", 5.15e-8, 1e-10, 1e-3,
             "at 293.15 K, for the action that melts it and its lead face; not given: the material's"),
    ARMATURE(resistivity_coefficient, "1/K", 2.0e-3, 0.0, 0.1, "relative rise of the resistivity"),
    ARMATURE(leg_area, "m^2", OPTIONAL, 1e-9, 10.0, "cross-section of one leg: warned about when its metal melts"),
    ARMATURE(throat_area, "m^2", OPTIONAL, 1e-9, 10.0,
             "cross-section of the throat, which the current crosses: warned about alike; tells how warm its lead face "
             "gets"),
    ARMATURE(wear_thickness, "m", OPTIONAL, 1e-6, 1.0,
             "that wear may take off one face, warned about beyond; not given: leg_thickness, if the armature wears"),
    PARAMS_END
};

const base_param circuit_shot_options_params[] = {
    OPTIONS(rtol, "1", 1e-8, 1e-13, 1e-2, "relative tolerance of the integration"),
    OPTIONS(atol, "1", 1e-10, 1e-16, 1e-3, "absolute tolerance as a fraction of each quantity's scale"),
    OPTIONS(max_time, "s", 0.1, 1e-9, 1e3, "the shot is not followed beyond this time"), PARAMS_END
};
