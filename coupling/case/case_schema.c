/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_schema.h"

#include "coupling/case/treatment.h"
#include "mpm/fatigue.h"
#include "mpm/scene.h"

#include <string.h>

/* The tables.  Ranges catch a wrong unit or a slipped decimal point; what a value means stands in case.h. */

static const char *const judge_names[] = { [JUDGE_GROWTH] = "growth", [JUDGE_SEVERITY] = "severity", NULL };

static const base_param case_params[] = {
    PARAM_STRING(breech_case, name, NULL, "short name of the case: its output goes to out/<name>"),
    PARAM_STRING(breech_case, title, "", "one line for reports"),
    PARAMS_END,
};

static const base_param layer_params[] = {
    PARAM_STRING(case_layer, material, NULL, "the layer's material"),
    PARAM_DOUBLE(case_layer, thickness, "m", REQUIRED, 1e-6, 0.1, "its thickness"),
    PARAM_DOUBLE(case_layer, bond_strength, "Pa", OPTIONAL, 0.0, 1e11,
                 "traction at which it comes off what lies below; not given: never"),
    PARAM_DOUBLE(case_layer, yield_scale, "1", 1.0, 0.01, 100.0, "hardening: factor on the yield stress"),
    PARAM_DOUBLE(case_layer, cold_work, "1", OPTIONAL, 0.0, 100.0,
                 "plastic strain it has had, from which its law of strength begins; not given: its material's"),
    PARAM_DOUBLE(
        case_layer, wear_rate, "m^3/N/m", OPTIONAL, 0.0, 1e-9,
        "volume that a shot's sliding wears off, over contact force and way, with study.shots; not given: only "
        "gouges wear it"),
    PARAMS_END,
};

static const base_param rail_params[] = {
    PARAM_STRING(case_rail, material, NULL, "the rail's material"),
    PARAM_DOUBLE(case_rail, temperature, "K", CASE_ROOM_TEMPERATURE, 4.0, 2000.0,
                 "rail ahead of the armature: initial or preheat"),
    PARAM_DOUBLE(case_rail, yield_scale, "1", 1.0, 0.01, 100.0,
                 "hardening of the whole rail: factor on the yield stress, and on the hardness in the screen"),
    PARAM_DOUBLE(case_rail, cold_work, "1", OPTIONAL, 0.0, 100.0,
                 "plastic strain it has had, from which its law of strength begins; not given: its material's"),
    PARAMS_END,
};

static const base_param projectile_params[] = {
    PARAM_STRING(case_projectile, material, NULL, "the armature's material"),
    PARAM_DOUBLE(case_projectile, lead_angle, "rad", REQUIRED, 0.01, 1.5707963267948966,
                 "between the lead face at the front and the rail's surface"),
    PARAM_DOUBLE(case_projectile, length, "m", REQUIRED, 1e-4, 1.0, "along the rail, head and leg"),
    PARAM_DOUBLE(case_projectile, leg_thickness, "m", REQUIRED, 1e-5, 0.5, "of one leg, normal to the rail"),
    PARAM_DOUBLE(case_projectile, head_thickness, "m", REQUIRED, 1e-5, 1.0,
                 "of the head that joins the legs, along the rail"),
    PARAM_DOUBLE(case_projectile, half_bore, "m", OPTIONAL, 1e-4, 1.0,
                 "from the rail's surface to the middle of the bore; not given: half of rail.separation"),
    PARAM_DOUBLE(case_projectile, width, "m", OPTIONAL, 1e-4, 1.0,
                 "full width across the rail; not given: rail.height"),
    PARAM_DOUBLE(case_projectile, chamfer_height, "m", REQUIRED, 0.0, 1.0,
                 "height of the lead face, normal to the rail; 0 = a square front"),
    PARAM_DOUBLE(case_projectile, temperature, "K", OPTIONAL, 4.0, 5000.0,
                 "of the armature in the scene; not given: its lead face's, as the shot has heated it; 293 K without "
                 "throat_area"),
    PARAM_DOUBLE(case_projectile, yield_scale, "1", 1.0, 0.01, 100.0,
                 "factor on its flow stress, and on the hardness in the screen"),
    PARAMS_END,
};

#define PARTICLE_DOC_SHAPE \
    "hemisphere, cone, ridge, pit, sphere (embedded where lower than twice its radius), or another shape"

static const base_param particle_params[] = {
    PARAM_DOUBLE(case_particle, radius, "m", OPTIONAL, 1e-6, 0.1, "of the grain's foot"),
    PARAM_DOUBLE(case_particle, height, "m", OPTIONAL, 1e-6, 0.1, "above the surface; not given: the radius"),
    PARAM_STRING(case_particle, shape, "hemisphere", PARTICLE_DOC_SHAPE),
    PARAM_STRING(case_particle, material, "", "the grain's material; not given: the rail's"),
    PARAM_DOUBLE(case_particle, bond_strength, "Pa", OPTIONAL, 0.0, 1e11,
                 "traction at which it comes off the rail; not given: never"),
    PARAMS_END,
};

static const base_param site_params[] = {
    PARAM_DOUBLE(case_site, position, "m", REQUIRED, 0.0, 1e3, "along the barrel, from the breech"),
    PARAM_DOUBLE(case_site, radius, "m", OPTIONAL, 1e-6, 0.1, "not given: particle.radius"),
    PARAM_DOUBLE(case_site, height, "m", OPTIONAL, 1e-6, 0.1,
                 "not given: the site's own radius if it has one, else particle.height"),
    PARAM_STRING(case_site, shape, "", "not given: particle.shape"),
    PARAM_STRING(case_site, material, "", "not given: particle.material"),
    PARAM_DOUBLE(case_site, bond_strength, "Pa", OPTIONAL, 0.0, 1e11, "not given: particle.bond_strength"),
    PARAMS_END,
};

static const char *const preset_names[] = { "none",
#define POPULATION(name, ...) #name,
#include "coupling/case/population.def"
#undef POPULATION
                                            NULL };

static const base_param population_params[] = {
    PARAM_ENUM(case_population, preset, preset_names, POPULATION_NONE, "where they come from: gives what is not given"),
    PARAM_DOUBLE(case_population, density, "1/m", OPTIONAL, 0.0, 1e6, "grains on a metre of the rail"),
    PARAM_DOUBLE(case_population, radius_median, "m", OPTIONAL, 1e-6, 0.1,
                 "half of them are larger; none with `sizes`"),
    PARAM_DOUBLE(case_population, radius_spread, "1", OPTIONAL, 0.0, 3.0,
                 "standard deviation of ln radius, log-normal sizes"),
    PARAM_DOUBLE(case_population, aspect, "1", OPTIONAL, 0.01, 10.0, "height over radius; not given: 1"),
    PARAM_DOUBLE(case_population, from, "m", OPTIONAL, 0.0, 1e3, "stretch they lie on; not given: barrel.start"),
    PARAM_DOUBLE(case_population, to, "m", OPTIONAL, 0.0, 1e3, "its end; not given: barrel.length"),
    PARAM_STRING(case_population, shape, "", "not given: particle.shape"),
    PARAM_STRING(case_population, material, "", "not given: the rail's"),
    PARAM_DOUBLE(case_population, bond_strength, "Pa", OPTIONAL, 0.0, 1e11,
                 "traction at which they come off the rail; not given: never"),
    PARAM_BOOL(case_population, renewed, 1, "strewn anew before every shot; no: what one shot has passed is gone"),
    PARAMS_END,
};

static const base_param size_params[] = {
    PARAM_DOUBLE(case_size, radius, "m", REQUIRED, 1e-6, 0.1, "of the grains' foot"),
    PARAM_DOUBLE(case_size, share, "1", REQUIRED, 0.0, 1e9, "of the grains; shares need not add up to 1"),
    PARAMS_END,
};

static const base_param treatment_params[] = {
    PARAM_STRING(case_treatment, name, NULL, "short name of the surface"),
    PARAMS_END,
};

static const base_param scene_params[] = {
    PARAM_DOUBLE(case_scene, velocity, "m/s", OPTIONAL, 1.0, 1e4,
                 "of the armature in `breech scene`; onset takes the shot's"),
    PARAM_DOUBLE(case_scene, contact_pressure, "Pa", OPTIONAL, 0.0, 1e10,
                 "armature on rail; not given: the shot's, or none in `breech scene`"),
    PARAM_DOUBLE(case_scene, friction, "1", REQUIRED, 0.0, 2.0, "Coulomb coefficient between any two bodies"),
    PARAM_DOUBLE(case_scene, shear_limit, "Pa", OPTIONAL, 0.0, 1e11,
                 "upper limit of the friction stress; not given: none"),
    PARAM_DOUBLE(case_scene, cells_per_radius, "1", 5.0, 1.0, 100.0, "fine cell = grain's radius / this"),
    PARAM_DOUBLE(case_scene, cells_per_layer, "1", 0.0, 0.0, 100.0,
                 "cells across each layer of the rail where it flows; 0: those of the grain"),
    PARAM_DOUBLE(case_scene, coarse_cell, "m", 8e-4, 1e-6, 0.1, "largest cell, far from the grain"),
    PARAM_DOUBLE(case_scene, refine_tolerance, "1", 0.035, 1e-4, 1.0,
                 "fraction of the armature's velocity that plastic flow may change across a cell"),
    PARAM_DOUBLE(case_scene, growth, "1", 1.2, 1.0, 2.0,
                 "ratio of neighbouring cells outside the fine zone, one level"),
    PARAM_BOOL(case_scene, follow, 1, "the groove is followed: its growth past the grain is gauged"),
    PARAM_BOOL(
        case_scene, cells_grow, 0,
        "the finest cells double each time a groove that is followed has become twice as wide as at its first gauge"),
    PARAM_DOUBLE(case_scene, rail_ahead, "m", 2e-2, 1e-4, 10.0, "rail modelled downstream of the grain's middle"),
    PARAM_DOUBLE(case_scene, rail_behind, "m", 1e-2, 1e-4, 10.0, "rail modelled upstream of it"),
    PARAM_DOUBLE(case_scene, rail_depth, "m", 1e-2, 1e-4, 1.0, "thickness of the rail modelled"),
    PARAM_DOUBLE(case_scene, rail_width, "m", OPTIONAL, 1e-4, 1.0, "full width of the rail; not given: the armature's"),
    PARAM_DOUBLE(case_scene, end_time, "s", OPTIONAL, 1e-9, 1.0, "not given: from the lengths and the velocity"),
    PARAM_BOOL(case_scene, stop_when_settled, 1, "stop once the crater no longer changes"),
    PARAM_BOOL(case_scene, stop_when_gauged, 0,
               "stop once the growth of a groove that is followed, and with it the class, is known"),
    MPM_METHOD_PARAMS(case_scene),
    PARAM_BOOL(case_scene, damage, 1, "(M-2) Johnson-Cook damage in all bodies"),
    PARAM_BOOL(case_scene, half_model, 1, "compute z >= 0 and mirror it"),
    PARAM_DOUBLE(
        case_scene, measuring_depth, "m", OPTIONAL, 1e-7, 0.01,
        "from which a crater counts: where its outline, length, width and class are taken; not given: a sixth of "
        "the grain's radius, or half a cell if that is more"),
    PARAM_DOUBLE(case_scene, limit_widening, "1", 1.5, 1.0, 10.0,
                 "widening from which a crater is a gouge by its shape"),
    PARAM_DOUBLE(case_scene, limit_severity, "1", 0.0, -10.0, 1e4,
                 "severity from which a crater is a gouge by its shape"),
    PARAM_DOUBLE(case_scene, limit_length_over_width, "1", 4.0, 0.1, 1e3,
                 "length over width up to which a groove that grows is a gouge, at its second gauge"),
    PARAM_DOUBLE(
        case_scene, growth_scatter, "1", 0.2, 0.0, 10.0,
        "growth between the gauges, e-folds either way, that decides nothing; so much of ln(length over width)"),
    PARAMS_END,
};

static const base_param interval_part_params[] = {
    PARAM_STRING(case_interval_part, part, NULL, "what it is, in words"),
    PARAM_DOUBLE(case_interval_part, threshold, "1", 0.0, 0.0, 1.0,
                 "share of the threshold by which it may lie lower or higher"),
    PARAM_DOUBLE(case_interval_part, scratch, "1", 0.0, 0.0, 1.0, "the same of the scratch velocity"),
    PARAM_BOOL(case_interval_part, own, false,
               "`breech compare` draws it for each surface by itself, as the place of the grid; else for all alike"),
    PARAMS_END,
};

static const base_param study_params[] = {
    PARAM_DOUBLE(case_study, velocity_interval, "1", 0.03, 1e-4, 1.0,
                 "wanted width of the threshold's interval over its middle"),
    PARAM_DOUBLE(case_study, position_interval, "1", 0.02, 1e-4, 1.0,
                 "wanted width of the threshold position's interval over the barrel's length"),
    PARAM_DOUBLE(case_study, velocity_low, "m/s", 1000.0, 1.0, 1e4, "no threshold is looked for below"),
    PARAM_DOUBLE(case_study, velocity_high, "m/s", 2000.0, 1.0, 1e4, "no threshold is looked for above"),
    PARAM_ENUM(case_study, judge, judge_names, JUDGE_GROWTH,
               "a threshold is where the groove's growth past the grain (if scene.follow), or the crater's severity, "
               "passes its limit"),
    PARAM_INT(case_study, max_scenes, 16, 1, 100000, "scenes the study may run"),
    PARAM_INT(case_study, ensemble, 0, 0, 1000,
              "grids, each shifted by another part of a cell, on which `breech scene` computes its scene: means and "
              "scatter of its answers; 0: on one alone"),
    PARAM_INT(
        case_study, threshold_ensemble, 0, 0, 1000,
        "grids on which `breech onset` and `breech compare` compute the scene nearest a threshold, judge: "
        "growth, or all of a search that saw one side alone; the interval then holds the scatter; 0: on one alone"),
    PARAM_INT(case_study, craters, 2, 0, 2,
              "whole craters of each kind of grain that gouges, judge: growth: in the middle of the velocities that "
              "gouge; and at the fastest grain; 0: none, so no volumes, rims and feedback"),
    PARAM_BOOL(case_study, scratch, 1,
               "look for the scratch velocity too, judge: growth: from which on a groove grows, gouge or not"),
    PARAM_DOUBLE(case_study, screen_low, "1", 3.0, 0.0, 1e4,
                 "impact pressure over hardness of the harder partner below which no scene is run"),
    PARAM_DOUBLE(case_study, coarse_cells_per_radius, "1", 3.0, 1.0, 100.0, "resolution the bracketing starts with"),
    PARAM_DOUBLE(case_study, fine_cells_per_radius, "1", 5.0, 1.0, 100.0, "resolution near the threshold"),
    PARAM_DOUBLE(case_study, crater_cells_per_radius, "1", OPTIONAL, 1.0, 100.0,
                 "resolution of whole craters; not given: that of the search"),
    PARAM_DOUBLE(
        case_study, resolution_error, "1", 0.1, 0.0, 1.0,
        "fraction of a threshold that finer cells may move it by: its interval allows for that, or for the shift "
        "from coarse to fine cells where that is more"),
    PARAM_DOUBLE(
        case_study, resolution_above, "1", 0.2, 0.0, 10.0,
        "the same upwards where growth is the judge, if it is more: finer cells may raise a threshold further than "
        "they lower it"),
    PARAM_DOUBLE(
        case_study, strength_error, "1", 0.0, 0.0, 1.0,
        "uncertainty of rail.yield_scale, relative: a search more, and the threshold's interval holds it; a known "
        "effect goes into interval_parts"),
    PARAM_DOUBLE(case_study, armature_error, "1", 0.0, 0.0, 1.0, "uncertainty of armature.yield_scale alike"),
    PARAM_DOUBLE(case_study, friction_error, "1", 0.0, 0.0, 10.0, "uncertainty of scene.friction alike"),
    PARAM_BOOL(case_study, feedback, 1, "a gouge's impulse and mass loss go back into the shot"),
    PARAM_BOOL(case_study, sensitivities, 1,
               "what 5 % more would do: of the supplies' charge, of armature.mass, of armature.friction_dry with "
               "friction_melted (law film: film_viscosity), of the grains' size"),
    PARAM_INT(case_study, shots, 1, 1, 1000, "fired one after the other on the same rail"),
    PARAM_DOUBLE(case_study, heat_kept, "1", 1.0, 0.0, 1.0,
                 "fraction of what the shots before have left in the rails that is still there at the next one"),
    PARAM_DOUBLE(case_study, deposit_kept, "1", OPTIONAL, 0.0, 1.0,
                 "fraction of the armature's metal on the rail after a shot, all that armature.wear_fraction melts and "
                 "what lay there before, that the next shot finds; not given: none is carried on"),
    PARAM_INT(case_study, sampled, 100000, 100, 100000000, "histories of the Monte Carlo"),
    PARAM_INT(case_study, seed, 1, 0, 2000000000, "of its random numbers"),
    PARAM_DOUBLE(case_study, smallest_radius, "m", 1e-4, 1e-6, 0.1,
                 "smaller grains of a population are taken not to gouge, no scene is run for them"),
    PARAMS_END,
};

/* Air: ISO 2533, the standard atmosphere at sea level. */
static const base_param strike_params[] = {
    PARAM_STRING(case_strike, projectile, NULL, "the body of scene.bodies that flies, with all of its group"),
    PARAM_STRING(case_strike, plate, "", "a body of the target whose holes are looked for; not given: none"),
    PARAM_DOUBLE(
        case_strike, velocity, "m/s", OPTIONAL, 0.1, 1e5,
        "of the projectile at arrival; not given: the shot's after its flight, without a supply the body's own; with "
        "optimise, goal velocity: the one for which a charge is found"),
    PARAM_DOUBLE(case_strike, distance, "m", 0.0, 0.0, 1e5, "from the muzzle to the target"),
    PARAM_DOUBLE(case_strike, drag_coefficient, "1", OPTIONAL, 0.0, 10.0, "of the flight over that distance"),
    PARAM_DOUBLE(case_strike, drag_area, "m^2", OPTIONAL, 0.0, 10.0, "of the projectile, across its flight"),
    PARAM_DOUBLE(case_strike, air_density, "kg/m^3", 1.225, 0.0, 1e4, "what it flies through"),
    PARAM_DOUBLE(case_strike, discarded_mass, "kg", 0.0, 0.0, 1e3,
                 "of the package that the shot launches, stays behind at the muzzle: armature, sabot"),
    PARAM_DOUBLE(case_strike, travel, "m", OPTIONAL, 1e-6, 1e3,
                 "the scene ends when the projectile would have come so far at its arrival velocity; not given: "
                 "scene.end_time"),
    PARAM_DOUBLE(case_strike, filter, "s", 1e-6, 1e-9, 1.0, "time over which forces are averaged"),
    PARAM_BOOL(case_strike, limit, 0,
               "look for the limit velocity too, in study.velocity_low .. velocity_high, to study.velocity_interval"),
    PARAMS_END,
};

static const char *const life_profile_names[] = {
    [LIFE_HERTZ] = "hertz", [LIFE_UNIFORM] = "uniform", [LIFE_POINTS] = "points", NULL
};
static const char *const life_load_names[] = { [LIFE_WHEEL] = "wheel", [LIFE_ARMATURE] = "armature", NULL };
static const char *const life_state_names[] = {
    [LIFE_FRICTIONLESS] = "frictionless", [LIFE_STICK_SLIP] = "stick_slip", [LIFE_FULL_SLIP] = "full_slip", NULL
};
static const char *const life_cycle_names[] = { [LIFE_PULSE] = "pulse", [LIFE_PASSAGE] = "passage", NULL };

static const char *const life_fan_names[] = { [LIFE_EVEN] = "even", [LIFE_LATTICE] = "lattice", NULL };
static const char *const life_until_names[] = { [LIFE_UNTIL_FIRST] = "first", [LIFE_UNTIL_CRACK] = "crack", NULL };

static const base_param life_params[] = {
    PARAM_STRING(case_life, material, NULL, "the rail's material, with constants of fatigue"),
    PARAM_ENUM(case_life, load, life_load_names, LIFE_WHEEL,
               "wheel: the patch below; armature: what the case's shot presses, drags and heats, study.shots times, "
               "along the barrel"),
    PARAM_INT(case_life, places, 59, 2, 1000, "of load: armature, evenly along the barrel behind its start"),
    PARAM_DOUBLE(case_life, rounding, "1", 0.2, 0.02, 1.0,
                 "of load: armature, the pressure rises over this fraction of half the contact's length at each end"),
    PARAM_BOOL(case_life, heat, 1, "of load: armature, the heat of the passage strains the rail too"),
    PARAM_DOUBLE(case_life, probe_depth, "m", OPTIONAL, 0.0, 1.0,
                 "of load: armature, a depth below the face of which the largest rise of the temperature is told"),
    PARAM_ENUM(case_life, profile, life_profile_names, LIFE_HERTZ,
               "of the pressure over the patch: an ellipse, uniform, or by the list `points`"),
    PARAM_DOUBLE(case_life, wheel_load, "N", OPTIONAL, 1e-3, 1e9,
                 "force on a patch that is an ellipse; not given: `pressure`"),
    PARAM_DOUBLE(case_life, pressure, "Pa", OPTIONAL, 1.0, 1e12,
                 "largest pressure; not given: 3 wheel_load / (2 pi half_length half_width)"),
    PARAM_DOUBLE(case_life, half_length, "m", OPTIONAL, 1e-6, 10.0,
                 "of the patch, along the rail; load: wheel needs it, an armature has its contact_length"),
    PARAM_DOUBLE(case_life, half_width, "m", OPTIONAL, 1e-6, 10.0, "of the patch, across the rail"),
    PARAM_ENUM(case_life, state, life_state_names, LIFE_FULL_SLIP,
               "frictionless: no traction; full_slip: friction times the pressure; stick_slip: Carter's"),
    PARAM_DOUBLE(case_life, friction, "1", 0.3, 0.0, 2.0, "Coulomb coefficient; of no effect where frictionless"),
    PARAM_DOUBLE(case_life, traction_share, "1", 0.5, 0.0, 1.0,
                 "traction over friction times normal force, in stick_slip"),
    PARAM_ENUM(case_life, cycle, life_cycle_names, LIFE_PULSE,
               "pulse: the load comes and goes at one place; passage: it runs over the rail from end to end"),
    PARAM_DOUBLE(case_life, speed, "m/s", 0.0, 0.0, 1e5,
                 "of a passage, with its waves, until: first alone; 0: slow against them"),
    PARAM_ENUM(case_life, measure, mpm_fatigue_measure_names, FATIGUE_BOND,
               "what of a direction's strain takes life: bond: its range whatever the sign; tension; shear across it"),
    PARAM_ENUM(case_life, fan, life_fan_names, LIFE_EVEN,
               "directions of a point: at equal angles, or those of the 28 neighbours within 3.015 spacings of a "
               "square lattice"),
    PARAM_INT(case_life, directions, 36, 3, FATIGUE_MAX_DIRECTIONS, "of an even fan"),
    PARAM_ENUM(case_life, until, life_until_names, LIFE_UNTIL_CRACK,
               "first: the first cut, by the closed field alone; crack: on a grid, cut by cut"),
    PARAM_DOUBLE(case_life, limit_index, "1", 0.5, 0.01, 1.0, "fraction of a point's directions whose loss is a crack"),
    PARAM_DOUBLE(case_life, batch, "1", 0.05, 0.0, 0.2, "cuts within this fraction of the cycles are one step"),
    PARAM_INT(case_life, max_cuts, 1000000, 0, 100000000, "at most; 0: the intact rail on the grid"),
    PARAM_INT(case_life, cells_per_half_length, 20, 4, 400, "cells of the grid in half_length"),
    PARAM_DOUBLE(case_life, grid_half_width, "1", 4.0, 2.0, 100.0,
                 "from the middle of the patch to the grid's ends, over half_length"),
    PARAM_DOUBLE(case_life, grid_depth, "1", 4.0, 2.0, 100.0, "depth of the grid, over half_length"),
    PARAMS_END,
};

bool case_life_has(const void *life, const char *key)
{
    static const char *const of_wheel[] = {
        "profile",         "wheel_load", "pressure", "half_length", "half_width", "state",    "friction",
        "traction_share",  "cycle",      "speed",    "until",       "batch",      "max_cuts", "cells_per_half_length",
        "grid_half_width", "grid_depth", "points",   NULL
    };
    for (int k = 0; of_wheel[k] && ((const case_life *)life)->load == LIFE_ARMATURE; k++)
        if (strcmp(key, of_wheel[k]) == 0) return false;
    return true;
}

static const char *const vessel_shape_names[] = { [VESSEL_CYLINDER] = "cylinder", [VESSEL_SPHERE] = "sphere", NULL };

static const base_param vessel_params[] = {
    PARAM_ENUM(case_vessel, shape, vessel_shape_names, VESSEL_CYLINDER,
               "cylinder: a metre of it in plane strain; sphere"),
    PARAM_DOUBLE(case_vessel, radius, "m", REQUIRED, 1e-7, 100.0, "outer, at the start"),
    PARAM_DOUBLE(case_vessel, film_thickness, "m", REQUIRED, 1e-9, 10.0,
                 "of the shell, at the start; less than radius"),
    PARAM_STRING(case_vessel, film_material, NULL, "of the shell, with strength and failure"),
    PARAM_STRING(case_vessel, liquid_material, NULL, "inside it, about the bubbles"),
    PARAM_INT(case_vessel, layers, 8, 1, 256, "of the film, each with one strain; it bursts when one has failed"),
    PARAM_DOUBLE(case_vessel, ambient, "Pa", 101325.0, 1.0, 1e9, "absolute pressure around it"),
    PARAM_DOUBLE(case_vessel, temperature, "K", 293.15, 1.0, 1e4, "of all of it, for good"),
    PARAM_DOUBLE(case_vessel, critical_temperature, "K", OPTIONAL, 1.0, 1e4,
                 "of the gas, with critical_pressure: Redlich and Kwong; not given: an ideal gas"),
    PARAM_DOUBLE(case_vessel, critical_pressure, "Pa", OPTIONAL, 1e3, 1e9, "of the gas"),
    PARAM_DOUBLE(case_vessel, growth, "1", REQUIRED, 0.0, 1e4,
                 "Jakob number Ja of the bubbles' growth, superheat times heat capacities over latent heat"),
    PARAM_DOUBLE(case_vessel, diffusivity, "m^2/s", REQUIRED, 1e-12, 1.0, "of heat in the liquid"),
    PARAM_DOUBLE(case_vessel, hole, "m", REQUIRED, 1e-9, 10.0,
                 "diameter of the hole that bursts; of a cylinder the width of a slit"),
    PARAM_DOUBLE(case_vessel, discharge, "1", 0.8, 1e-3, 1.0, "coefficient of the flow through it"),
    PARAM_DOUBLE(case_vessel, molar_mass, "kg/mol", 0.029, 1e-3, 1.0, "of the gas that leaves"),
    PARAM_DOUBLE(case_vessel, gas_gamma, "1", 1.3, 1.01, 5.0 / 3.0 + 1e-9, "ratio of its specific heats"),
    PARAM_DOUBLE(case_vessel, surface_tension, "N/m", 0.0, 0.0, 10.0,
                 "of the liquid: its pressure in a bubble is reported and left out"),
    PARAM_DOUBLE(case_vessel, end_time, "s", REQUIRED, 1e-9, 1e9, "where it has not burst and emptied before"),
    PARAMS_END,
};

static const base_param bubble_params[] = {
    PARAM_DOUBLE(case_bubble, radius, "m", REQUIRED, 1e-9, 100.0, "at the start"),
    PARAMS_END,
};

static const base_param life_point_params[] = {
    PARAM_DOUBLE(case_life_point, at, "1", REQUIRED, -1.0, 1.0, "place over half_length"),
    PARAM_DOUBLE(case_life_point, pressure, "1", REQUIRED, 0.0, 1.0, "there, over the largest"),
    PARAM_DOUBLE(case_life_point, traction, "1", OPTIONAL, -2.0, 2.0,
                 "there, over the largest pressure; not given: friction times the pressure there"),
    PARAMS_END,
};

static const base_param output_params[] = {
    PARAM_INT(case_output, snapshots, 20, 0, 10000,
              "of a scene, evenly over its time, from its start to its end; 1: of its end; 0 = none"),
    PARAM_DOUBLE(case_output, history_interval, "s", OPTIONAL, 1e-9, 1.0,
                 "least time between two samples of the shot's history; not given: every step"),
    PARAM_DOUBLE(case_output, checkpoint_interval, "s", 60.0, 1.0, 1e6,
                 "wall time between two checkpoints, at least 20 times what one takes"),
    PARAM_BOOL(case_output, report, 1, "write report.html"),
    PARAMS_END,
};

#define END_OF_SECTIONS \
    {                   \
        .key = NULL     \
    }

static const case_section rail_children[] = {
    { .key = "layers",
      .doc = "Layers on the rail's surface, a list; the first is the lowest.",
      .table = layer_params,
      .offset = offsetof(case_rail, layers),
      .size = sizeof(case_layer),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section life_children[] = {
    { .key = "points",
      .doc = "A tabulated load, a list from end to end with straight lines between.",
      .table = life_point_params,
      .offset = offsetof(case_life, points),
      .size = sizeof(case_life_point),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section study_children[] = {
    { .key = "interval_parts",
      .doc = "What else a threshold's interval has to hold, measured before, a list; no scene is run for it.",
      .table = interval_part_params,
      .offset = offsetof(case_study, interval_parts),
      .size = sizeof(case_interval_part),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section vessel_children[] = {
    { .key = "bubbles",
      .doc = "Bubbles in the liquid, a list; gas leaves through the hole from the largest.",
      .table = bubble_params,
      .offset = offsetof(case_vessel, bubbles),
      .size = sizeof(case_bubble),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section population_children[] = {
    { .key = "sizes",
      .doc = "Tabulated sizes in place of log-normal ones, a list; at most 24 of at least `study.smallest_radius`.",
      .table = size_params,
      .offset = offsetof(case_population, sizes),
      .size = sizeof(case_size),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section treatment_children[] = {
#define TREATMENT_LAYERS(name, doc_)                                     \
    { .key = #name,                                                      \
      .doc = (doc_),                                                     \
      .table = layer_params,                                             \
      .offset = offsetof(case_treatment, kind[TREATMENT_##name].layers), \
      .size = sizeof(case_layer),                                        \
      .given = NO_FLAG,                                                  \
      .list = true },
#define TREATMENT(name, doc_)                                     \
    { .key = #name,                                               \
      .doc = (doc_),                                              \
      .table = case_treatment_##name##_params,                    \
      .offset = offsetof(case_treatment, kind[TREATMENT_##name]), \
      .size = sizeof(treatment_settings),                         \
      .given = NO_FLAG },
#include "coupling/case/treatment.def"
#undef TREATMENT
    END_OF_SECTIONS,
};

static const base_param sweep_params[] = {
    PARAM_STRING(case_sweep, of, "scene", "the study to run: scene, shot, strike, life, vessel, inductance"),
    PARAM_BOOL(case_sweep, together, 0, "the lists of values go on together; no: all combinations"),
    PARAMS_END,
};

static const base_param varied_params[] = {
    PARAM_STRING(case_varied, key, NULL, "key of the case to vary, as --set names it: particle.radius"),
    PARAMS_END,
};

/* A list of words: an entry may stand as the value alone. */
static const base_param word_params[] = {
    PARAM_LONG_STRING(case_word, value, NULL, "as in a case file; a list in quotes, \"[1, 0, 0]\""),
    PARAMS_END,
};

static const case_section varied_children[] = {
    { .key = "values",
      .doc = "Its values, a list.",
      .table = word_params,
      .offset = offsetof(case_varied, values),
      .size = sizeof(case_word),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const case_section sweep_children[] = {
    { .key = "vary",
      .doc = "What is varied, a list of keys with their values.",
      .table = varied_params,
      .children = varied_children,
      .offset = offsetof(case_sweep, vary),
      .size = sizeof(case_varied),
      .given = NO_FLAG,
      .list = true },
    { .key = "read",
      .doc = "Numbers of the run's summary to tabulate, a list; not given: its first six, of a strike what one asks of "
             "it.",
      .table = word_params,
      .offset = offsetof(case_sweep, read),
      .size = sizeof(case_word),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

static const base_param target_params[] = {
    PARAM_STRING(case_target, name, NULL, "of the target"),
    PARAMS_END,
};

static const base_param change_params[] = {
    PARAM_STRING(case_change, key, NULL, "key of the case, as --set names it: scene.bodies[0].material"),
    PARAM_LONG_STRING(
        case_change, value, NULL,
        "of this target, as in a case file; a shape in quotes, \"{box: {lo: 0 -5 -5 mm, hi: 2 5 5 mm}}\""),
    PARAMS_END,
};

static const case_section target_children[] = {
    { .key = "change",
      .doc = "What is otherwise than in the case, a list.",
      .table = change_params,
      .offset = offsetof(case_target, change),
      .size = sizeof(case_change),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

#define PART(key_, member, table_, needed_, doc_)                                             \
    .key = (key_), .doc = (doc_), .table = (table_), .offset = offsetof(breech_case, member), \
    .given = offsetof(breech_case, given.member), .needed_for = (needed_)
#define SECTION(member, table_, needed_, doc_) PART(#member, member, table_, needed_, doc_)

enum { NEED_SHOT = CASE_FOR_SHOT | CASE_FOR_ONSET, NEED_SCENE = CASE_FOR_SCENE | CASE_FOR_ONSET };

static const case_section profile_children[] = {
    { .key = "points",
      .doc = "The table itself where there is no file, a list.",
      .table = circuit_supply_point_params,
      .offset = offsetof(circuit_supply_profile, points),
      .size = sizeof(circuit_supply_point),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

#define SUPPLY(kind, type, section, lists, text)                             \
    { .key = #section,                                                       \
      .doc = (text),                                                         \
      .table = circuit_supply_##kind##_params,                               \
      .children = (lists),                                                   \
      .offset = offsetof(breech_case, supplies[CIRCUIT_SUPPLY_##kind]),      \
      .size = sizeof(type),                                                  \
      .given = offsetof(breech_case, given.supplies[CIRCUIT_SUPPLY_##kind]), \
      .list = true,                                                          \
      .spread = true },

/* What the impact scene takes from sections that the circuit reads too. */
static const case_section rail_in_scene = { PART("rail", rail, rail_params, NEED_SCENE, "As the impact scene sees it."),
                                            .children = rail_children, .size = sizeof(case_rail) };
static const case_section armature_in_scene = { PART("armature", projectile, projectile_params, NEED_SCENE,
                                                     "The body in the impact scene: half a U, one leg on one rail, the "
                                                     "head in front; without legs where head_thickness is length."),
                                                .size = sizeof(case_projectile) };

static const case_section sections[] = {
#include "circuit/supply/supply.def"
#undef SUPPLY
    { PART("rail", rails, circuit_shot_rails_params, NEED_SHOT | CASE_FOR_INDUCTANCE,
           "The rails: two or four equal ones in the circuit, one of them in the impact scene."),
      .also = &rail_in_scene, .size = sizeof(circuit_shot_rails) },
    { SECTION(barrel, circuit_shot_barrel_params, NEED_SHOT, "The barrel."), .size = sizeof(circuit_shot_barrel) },
    { SECTION(armature, circuit_shot_armature_params, NEED_SHOT, "The armature: what the circuit drives."),
      .also = &armature_in_scene, .size = sizeof(circuit_shot_armature) },
    { SECTION(options, circuit_shot_options_params, 0, "Tolerances of the shot's integration."),
      .size = sizeof(circuit_shot_options) },
    { SECTION(optimise, circuit_firing_wish_params, 0,
              "Firing times of the bank that `breech shot` looks for before it shoots."),
      .size = sizeof(circuit_firing_wish) },
    { SECTION(particle, particle_params, CASE_FOR_SCENE, "The grain of `breech scene`, and what a site leaves out."),
      .size = sizeof(case_particle) },
    { SECTION(sites, site_params, 0, "Grains along the barrel, a list; `breech onset` needs these or populations."),
      .size = sizeof(case_site), .list = true },
    { SECTION(populations, population_params, 0, "Grains strewn at random along the barrel, a list."),
      .children = population_children, .size = sizeof(case_population), .list = true },
    { SECTION(treatments, treatment_params, CASE_FOR_COMPARE,
              "Rail surfaces to compare, a list; the untreated one is always compared too."),
      .children = treatment_children, .size = sizeof(case_treatment), .list = true },
    { SECTION(scene, scene_params, NEED_SCENE, "How an impact scene is built and run."), .size = sizeof(case_scene),
      .unless = "bodies" },
    { SECTION(study, study_params, 0, "The search for where gouging begins."), .children = study_children,
      .size = sizeof(case_study) },
    { SECTION(sweep, sweep_params, CASE_FOR_SWEEP, "Runs of another study with other values of some keys."),
      .children = sweep_children, .size = sizeof(case_sweep) },
    { SECTION(strike, strike_params, CASE_FOR_STRIKE,
              "What a launched projectile does to its target, the other bodies of the scene."),
      .size = sizeof(case_strike) },
    { SECTION(targets, target_params, CASE_FOR_TARGETS,
              "Targets to compare, a list; that of the case as it is, named `given`, is always compared too."),
      .children = target_children, .size = sizeof(case_target), .list = true },
    { SECTION(life, life_params, CASE_FOR_LIFE,
              "A load that comes again and again, and how long the rail lasts under it."),
      .children = life_children, .size = sizeof(case_life), .has = case_life_has },
    { SECTION(vessel, vessel_params, CASE_FOR_VESSEL, "Gas in liquid inside a ductile shell, which swells and bursts."),
      .children = vessel_children, .size = sizeof(case_vessel) },
    { SECTION(output, output_params, 0, "What is written."), .size = sizeof(case_output) },
    { .key = "materials",
      .doc = "Materials given in the case itself, a list: used.yaml has them. They come before the files of "
             "cases/materials, where every constant has its source.",
      .table = mpm_material_params,
      .offset = offsetof(breech_case, materials),
      .size = sizeof(mpm_material),
      .given = NO_FLAG,
      .list = true },
    END_OF_SECTIONS,
};

const case_section case_root = { .key = "",
                                 .doc = "The case.",
                                 .table = case_params,
                                 .children = sections,
                                 .size = sizeof(breech_case),
                                 .given = NO_FLAG };

void *case_part_object(const case_section *section, const case_section *part, void *object)
{
    return (char *)object + ((ptrdiff_t)part->offset - (ptrdiff_t)section->offset);
}

case_list case_list_get(const void *parent, const case_section *section)
{
    case_list list;
    memcpy(&list, (const char *)parent + section->offset, sizeof list);
    return list;
}

void case_list_put(void *parent, const case_section *section, case_list list)
{
    memcpy((char *)parent + section->offset, &list, sizeof list);
}
