/* SPDX-License-Identifier: BSD-3-Clause */
/* The shot's rails: their keys, and the ladder that stands for them at each level. */
#include "base/constants.h"
#include "circuit/rails/inductance.h"
#include "circuit/shot_model.h"

const char *const circuit_shot_rail_level_names[] = { "constant", "skin", "diffusing", NULL };

#define RAILS(member, unit, fallback, min, max, doc) \
    PARAM_DOUBLE(circuit_shot_rails, member, unit, fallback, min, max, doc)

const base_param circuit_shot_rails_params[] = {
    PARAM_ENUM(
        circuit_shot_rails, level, circuit_shot_rail_level_names, CIRCUIT_SHOT_RAILS_DIFFUSING,
        "constant: gradients as given; skin: of the cross-section at one frequency; diffusing: of every slice by its "
        "own history"),
    RAILS(height, "m", REQUIRED, 1e-4, 10.0, "height of a rail, across the bore"),
    RAILS(thickness, "m", REQUIRED, 1e-4, 10.0, "thickness of a rail"),
    RAILS(separation, "m", REQUIRED, 1e-4, 10.0, "separation of the facing rail surfaces"),
    PARAM_INT(circuit_shot_rails, count, 2, 2, 4,
              "2: a pair; 4: two facing ones carry the current, the other two bring it back"),
    RAILS(face_crown, "m", 0.0, 0.0, 10.0, "sagitta of the bore face's arc; 0 = flat"),
    RAILS(back_crown, "m", 0.0, 0.0, 10.0, "sagitta of the back's arc; half the height makes a D; 0 = flat"),
    RAILS(cladding, "m", 0.0, 0.0, 10.0, "thickness of a layer of another metal on the bore face; 0 = none"),
    RAILS(cladding_resistivity, "ohm m", 1.72e-8, 1e-10, 1e-3, "of that layer, at the rails' temperature"),
    RAILS(resistivity, "ohm m", 1.72e-8, 1e-10, 1e-3, "resistivity at 293.15 K; not given: the material's"),
    RAILS(resistivity_coefficient, "1/K", 3.93e-3, 0.0, 0.1, "relative rise of the resistivity"),
    RAILS(initial_temperature, "K", 293.15, 200.0, 3000.0,
          "before the shot, for the circuit; a case takes `temperature` where it gives that alone"),
    RAILS(inductance_gradient, "H/m", OPTIONAL, 0.0, 1e-4, "inductance gradient of the pair (level constant)"),
    RAILS(resistance_gradient, "ohm/m", OPTIONAL, 0.0, 10.0, "resistance gradient of the pair (level constant)"),
    RAILS(frequency, "Hz", OPTIONAL, 1e-3, 1e9, "frequency of the gradients (level skin); from the pulse if not given"),
    RAILS(density, "kg/m^3", 8960.0, 100.0, 3e4, "density"),
    RAILS(specific_heat, "J/kg/K", 385.0, 1.0, 1e5, "specific heat"),
    RAILS(thermal_conductivity, "W/m/K", 391.0, 0.1, 1e4, "thermal conductivity"),
    RAILS(youngs_modulus, "Pa", 124e9, 1e6, 1e13, "Young's modulus, for bending waves"),
    RAILS(backing_stiffness, "Pa", OPTIONAL, 1e3, 1e13,
          "of the rail's bed, force per length and deflection: the speed of bending waves is warned about"),
    RAILS(ladder_error, "1", 1e-2, 1e-6, 0.3,
          "largest error of the ladder that stands for the diffusing rails, over its band"),
    RAILS(ladder_frequency, "Hz", OPTIONAL, 1.0, 1e9,
          "top of the ladder's band; from bank energy, armature and contact length if not given"),
    PARAM_INT(circuit_shot_rails, slices, 0, 0, 32,
              "parts of the barrel whose resistance follows their own temperature; 0: it stays as before the shot"),
    RAILS(heat_capacity, "J/m^3/K", 3.45e6, 1e5, 1e7,
          "of the rails' metal: slices, and what a shot leaves; not given: density times specific heat, in a case"),
    RAILS(fineness, "1", INDUCTANCE_FINENESS, 1.0, 20.0, "filaments over the skin depth at the highest frequency"),
    PARAMS_END
};

/* f = 1/(4 t_r), t_r = spread of the firing times + mean rise time of the units that fire                 (C-6) */
double circuit_shot_effective_frequency(const circuit_shot_config *c)
{
    double first = INFINITY, last = -INFINITY, rise = 0.0, count = 0.0;
    for (int s = 0; s < CIRCUIT_SUPPLY_KINDS; s++) {
        const supply_kind *kind = circuit_supply_kinds[s];
        for (int k = 0; k < c->supplies[s].n; k++) {
            const void *p = (const char *)c->supplies[s].item + (size_t)k * kind->size;
            const circuit_supply_common at = circuit_supply_common_of(p);
            if (!(at.fire_at <= c->options.max_time)) continue;
            first = fmin(first, at.fire_at);
            last = fmax(last, at.fire_at);
            rise += at.count * kind->rise(p);
            count += at.count;
        }
    }
    const double in = count > 0.0 ? last - first + rise / count : 0.0; /* 0: a coil without current */
    return in > 0.0 ? 0.25 / in : NAN;
}

/* What the supplies hold at t = 0, or will have been charged with [J]. */
static double supplies_energy(const circuit_shot_config *c)
{
    double E = 0.0;
    for (int s = 0; s < CIRCUIT_SUPPLY_KINDS; s++) {
        for (int k = 0; k < c->supplies[s].n; k++) {
            const void *p = (const char *)c->supplies[s].item + (size_t)k * circuit_supply_kinds[s]->size;
            double y[SUPPLY_UNKNOWNS];
            supply_scale scale;
            circuit_supply_kinds[s]->start(p, y, &scale);
            E += circuit_supply_common_of(p).count * scale.energy;
        }
    }
    return E;
}

status circuit_rails_section(const circuit_shot_rails *rails, circuit_rail_section *out)
{
    TRY(base_params_check(circuit_shot_rails_params, rails, "rail"));
    const double warm = 1.0 + rails->resistivity_coefficient * (rails->initial_temperature - 293.15);
    CHECK(warm > 0.0, STATUS_BAD_INPUT, "rail.initial_temperature = %g K makes rail.resistivity negative",
          rails->initial_temperature);
    *out = (circuit_rail_section){ .height = rails->height,
                                   .thickness = rails->thickness,
                                   .separation = rails->separation,
                                   .face_crown = rails->face_crown,
                                   .back_crown = rails->back_crown,
                                   .cladding = rails->cladding,
                                   .resistivity = rails->resistivity * warm,
                                   .cladding_resistivity = rails->cladding_resistivity,
                                   .rails = rails->count };
    return circuit_section_check(out);
}

status circuit_rails_check(const circuit_shot_rails *rails)
{
    circuit_rail_section section;
    if (rails->level != CIRCUIT_SHOT_RAILS_CONSTANT) return circuit_rails_section(rails, &section);
    CHECK(!isnan(rails->inductance_gradient) && !isnan(rails->resistance_gradient), STATUS_BAD_INPUT,
          "rail.level constant needs rail.inductance_gradient [H/m] and rail.resistance_gradient [ohm/m]");
    return base_params_check(circuit_shot_rails_params, rails, "rail");
}

status circuit_rails_impedance(const circuit_shot_rails *rails, double f, double *inductance, double *resistance)
{
    CHECK(f >= 0.0, STATUS_BAD_INPUT, "frequency %g Hz: must be 0 or more", f);
    TRY(circuit_rails_check(rails));
    if (rails->level == CIRCUIT_SHOT_RAILS_CONSTANT) {
        *inductance = rails->inductance_gradient;
        *resistance = rails->resistance_gradient;
        return status_ok();
    }
    circuit_rail_section section;
    TRY(circuit_rails_section(rails, &section));
    if (isinf(f)) {
        *resistance = INFINITY;
        return circuit_inductance_limit(&section, inductance);
    }
    return circuit_inductance_at(&section, f, rails->fineness, inductance, resistance);
}

status circuit_rails_ladder(const circuit_shot_rails *rails, double f_top, circuit_ladder *out)
{
    *out = (circuit_ladder){ 0 };
    if (rails->level != CIRCUIT_SHOT_RAILS_DIFFUSING)
        return circuit_rails_impedance(rails, f_top, &out->L_inf, &out->R_dc);
    circuit_rail_section section;
    TRY(circuit_rails_section(rails, &section));
    circuit_impedance z;
    status st = circuit_inductance_response(&section, f_top, rails->fineness, &z);
    if (st.code == STATUS_OK) st = circuit_ladder_fit(&z, 2.0 * PI * f_top, rails->ladder_error, out);
    circuit_impedance_free(&z);
    return st;
}

/* No armature gets faster than sqrt(2 E/m + v0^2), so no slice of rail gets its current in less than the contact's
 * length over that; nor does the bank change its current faster than a quarter of a sine (C-6) does.      (C-13) */
static double band_top(const circuit_shot_config *c)
{
    const double f_pulse = circuit_shot_effective_frequency(c);
    const double v0 = c->armature.velocity, v2 = v0 * v0 + 2.0 * supplies_energy(c) / c->armature.mass;
    const double f_contact = sqrt(v2) / (2.0 * PI * c->armature.contact_length);
    return fmax(f_contact, 10.0 * (isnan(f_pulse) ? 100.0 : f_pulse));
}

/* The slices' warming (C-24): nothing where none are asked for. */
static status warming_fit(const circuit_shot_rails *rails, circuit_rails_load *out)
{
    if (rails->slices == 0) return status_ok();
    circuit_rail_section section;
    TRY(circuit_rails_section(rails, &section));
    out->heat_capacity = rails->heat_capacity * section.rails * circuit_section_metal_area(&section);
    if (rails->level == CIRCUIT_SHOT_RAILS_SKIN) out->even_resistance = circuit_section_resistance(&section);
    out->coefficient =
        rails->resistivity_coefficient / (1.0 + rails->resistivity_coefficient * (rails->initial_temperature - 293.15));
    return status_ok();
}

/* With a velocity skin effect the current spreads by the contact voltage, over the metal of the bore face: half of it
 * lies on each of the faces that carry 2/count of the current, side by side. */
static void contact_fit(const circuit_shot_config *c, circuit_sliding_contact *out)
{
    const circuit_shot_armature *a = &c->armature;
    const circuit_shot_rails *r = &c->rails;
    const double width = isnan(a->contact_width) ? r->height : a->contact_width;
    const double warm = 1.0 + r->resistivity_coefficient * (r->initial_temperature - 293.15);
    out->length = a->contact_length;
    out->interface = a->velocity_skin ? 0.25 * r->count * a->contact_voltage * a->contact_length * width : 0.0;
    out->resistivity = r->cladding > 0.0 ? r->cladding_resistivity : r->resistivity * warm;
}

status circuit_shot_rails_fit(const circuit_shot_config *c, circuit_rails_load *out)
{
    contact_fit(c, &out->contact);
    TRY(warming_fit(&c->rails, out));
    if (c->fitted) {
        out->ladder = *c->fitted;
        return status_ok();
    }
    const bool diffusing = c->rails.level == CIRCUIT_SHOT_RAILS_DIFFUSING;
    double f = diffusing ? c->rails.ladder_frequency : c->rails.frequency;
    if (isnan(f)) f = diffusing ? band_top(c) : circuit_shot_effective_frequency(c);
    return circuit_rails_ladder(&c->rails, isnan(f) ? 1000.0 : f, &out->ladder);
}
