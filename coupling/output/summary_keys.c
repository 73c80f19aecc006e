#include "coupling/output/summary_keys.h"

#define NUMBER(type, key, member, unit_, doc_)                                                                      \
    {                                                                                                               \
        .name = (key), .unit = (unit_), .doc = (doc_), .kind = KEY_NUMBER, .offset = offsetof(type, member), .n = 1 \
    }
#define VECTOR(type, key, member, n_, unit_, doc_)                                                                     \
    {                                                                                                                  \
        .name = (key), .unit = (unit_), .doc = (doc_), .kind = KEY_NUMBER, .offset = offsetof(type, member), .n = (n_) \
    }
#define VALUE(type, kind_, key, member, unit_, doc_)                                                     \
    {                                                                                                    \
        .name = (key), .unit = (unit_), .doc = (doc_), .kind = (kind_), .offset = offsetof(type, member) \
    }
#define NAME(type, key, member, names_, doc_)                                                         \
    {                                                                                                 \
        .name = (key), .unit = "", .doc = (doc_), .kind = KEY_NAME, .offset = offsetof(type, member), \
        .names = (names_)                                                                             \
    }
#define LIST(type, key, member, count, item_, item_size_, doc_)                                       \
    {                                                                                                 \
        .name = (key), .unit = "", .doc = (doc_), .kind = KEY_LIST, .offset = offsetof(type, member), \
        .n_offset = offsetof(type, count), .item = (item_), .item_size = (item_size_)                 \
    }
#define ARRAY(type, key, member, count, unit_, doc_)                                                        \
    {                                                                                                       \
        .name = (key), .unit = (unit_), .doc = (doc_), .kind = KEY_ARRAY, .offset = offsetof(type, member), \
        .n_offset = offsetof(type, count)                                                                   \
    }
#define KEYS_END     \
    {                \
        .name = NULL \
    }

/* clang-format off */
const summary_key output_summary_shot_keys[] = {
    NUMBER(shot_record, "peak_current", is.peak_current, "A", "largest current in the rails"),
    NUMBER(shot_record, "muzzle_velocity", is.muzzle_velocity, "m/s", "null: the armature did not leave"),
    NUMBER(shot_record, "muzzle_time", is.muzzle_time, "s", "when it left"),
    NUMBER(shot_record, "muzzle_energy", is.muzzle_energy, "J", "kinetic, at exit"),
    NUMBER(shot_record, "efficiency", is.efficiency, "1",
           "muzzle energy over the energy stored at the start and supplied since"),
    NUMBER(shot_record, "action", is.action, "A2 s", "integral of the current's square"),
    NUMBER(shot_record, "peak_acceleration", is.peak_acceleration, "m/s2", "of the armature"),
    NUMBER(shot_record, "exit_current", is.exit_current, "A", "at the muzzle"),
    NUMBER(shot_record, "energy_error", is.energy_error, "1", "over the energy stored at the start and supplied since"),
    NUMBER(shot_record, "contact_ratio", limits.contact_ratio, "1",
           "least contact force over 1 gram-force per ampere, in motion"),
    NUMBER(shot_record, "leg_action", limits.leg_action, "1",
           "action over that which melts the leg; null: armature.leg_area is not given"),
    NUMBER(shot_record, "throat_action", limits.throat_action, "1",
           "the throat alike; null: armature.throat_area is not given"),
    NUMBER(shot_record, "wear_share", limits.wear_share, "1",
           "thickness worn off over armature.leg_thickness; null: not given"),
    NUMBER(shot_record, "transition_position", limits.transition_position, "m",
           "where the first of these four passes its limit; null: nowhere"),
    NUMBER(shot_record, "melt_position", limits.melt_position, "m",
           "where the armature's face melted, friction_law film; null: it did not"),
    NUMBER(shot_record, "critical_velocity", limits.critical_velocity, "m/s",
           "of bending waves in the rail; null: rails.backing_stiffness is not given"),
    NUMBER(shot_record, "critical_position", limits.critical_position, "m",
           "where the armature first exceeds it; null: nowhere"),
    NUMBER(shot_record, "rail_rise", rail_rise, "K",
           "largest rise of temperature that the shot leaves in its rails, once even over the section"),
    NUMBER(shot_record, "rail_rise_position", rail_rise_position, "m", "where that is"),
    VALUE(shot_record, KEY_COUNT, "steps", is.steps, "1", "of the integration"),
    NUMBER(shot_record, "wall_seconds", wall_seconds, "s", "time it took"),
    VALUE(shot_record, KEY_INTEGER, "optimise_evaluations", firing.evaluations, "1",
           "trials of the search for firing times; 0: none was asked for"),
    NUMBER(shot_record, "optimise_before", firing.before, "1",
           "its measure at the start: unevenness, or stored energy [J]"),
    NUMBER(shot_record, "optimise_after", firing.after, "1", "and of what was found"),
    NUMBER(shot_record, "charge_scale", firing.charge_scale, "1", "factor on all charges that it found"),
    ARRAY(shot_record, "fire_at", fire_at, n_fire_at, "s", "firing times of the bank's groups that it found"),
    KEYS_END
};

const summary_key output_summary_scene_keys[] = {
    NAME(scene_result, "class", class, gouge_class_names, "none, scratch, gouge, undecided"),
    VALUE(scene_result, KEY_TEXT, "reason", reason, "", "the numbers behind the class"),
    NUMBER(scene_result, "severity", severity, "1",
           "(lean x volume - plan area x height of the grain) / its volume; gouging grows above 0"),
    NUMBER(scene_result, "groove_growth", groove_growth, "1/s",
           "rate of ln of the plastic power in the groove, past the grain; null: not followed so far"),
    NUMBER(scene_result, "crater_length", crater_length, "m", "along the rail"),
    NUMBER(scene_result, "crater_width", crater_width, "m", "full width"),
    NUMBER(scene_result, "crater_depth", crater_depth, "m", "deepest"),
    NUMBER(scene_result, "crater_volume", crater_volume, "m3", "below the surface"),
    NUMBER(scene_result, "rim_height", rim_height, "m", "highest above the surface"),
    NUMBER(scene_result, "widening", widening, "1", "width of the downstream third over the upstream third"),
    VALUE(scene_result, KEY_FLAG, "crater_truncated", crater_truncated, "",
           "reaches the map's edge: length, volume are lower bounds"),
    NUMBER(scene_result, "peak_pressure", peak_pressure, "Pa", "of any intact point at any time"),
    VECTOR(scene_result, "peak_force", peak_force, 3, "N", "on the rail, full model"),
    NUMBER(scene_result, "peak_temperature", peak_temperature, "K", "of any intact point at any time"),
    NUMBER(scene_result, "peak_mises_armature", peak_mises_armature, "Pa", "von Mises stress of any of its particles"),
    NUMBER(scene_result, "peak_mises_rail", peak_mises_rail, "Pa", "von Mises stress of any of its particles"),
    NUMBER(scene_result, "peak_mises_armature_999", peak_mises_armature_999, "Pa", "99.9th percentile by mass"),
    NUMBER(scene_result, "peak_mises_rail_999", peak_mises_rail_999, "Pa", "99.9th percentile by mass"),
    NUMBER(scene_result, "peak_pressure_armature_999", peak_pressure_armature_999, "Pa", "99.9th percentile by mass"),
    NUMBER(scene_result, "peak_pressure_rail_999", peak_pressure_rail_999, "Pa", "99.9th percentile by mass"),
    NUMBER(scene_result, "momentum_error", momentum_error, "1", "over mass times the largest initial speed"),
    NUMBER(scene_result, "energy_error", energy_error, "1", "over the kinetic energy the scene starts with"),
    VALUE(scene_result, KEY_BY_BODY, "failed_volume", failed_volume, "m3", "by body, full model"),
    VALUE(scene_result, KEY_BY_BODY, "carried_volume", carried_volume, "m3",
           "sound metal that goes with the armature at the end, by body, full model"),
    NUMBER(scene_result, "layers_failed_volume", layers_failed_volume, "m3", "of the rail's layers, full model"),
    NUMBER(scene_result, "layers_carried_volume", layers_carried_volume, "m3",
           "of the rail's layers, carried along by the armature, full model"),
    NUMBER(scene_result, "end_time", end_time, "s", "simulated"),
    VALUE(scene_result, KEY_COUNT, "particles", particles, "1", "at the end"),
    VALUE(scene_result, KEY_COUNT, "steps", steps, "1", "of the solver"),
    VALUE(scene_result, KEY_COUNT, "particle_steps", particle_steps, "1", "done"),
    VALUE(scene_result, KEY_COUNT, "particle_steps_dense", particle_steps_dense, "1", "if nothing had been skipped"),
    VALUE(scene_result, KEY_COUNT, "clamps_pressure", clamps_pressure, "1", "pressures held at a limit"),
    VALUE(scene_result, KEY_COUNT, "clamps_compression", clamps_compression, "1", "compressions held at a limit"),
    NUMBER(scene_result, "eroded_mass", eroded_mass, "kg", "vapour and dust taken out, full model"),
    NUMBER(scene_result, "wall_seconds", wall_seconds, "s", "time it took"),
    VALUE(scene_result, KEY_INTEGER, "threads", threads, "1", "of its process; others may have lent theirs"),
    KEYS_END
};

const summary_key output_summary_site_keys[] = {
    NUMBER(onset_site, "position", position, "m", "along the barrel"),
    NUMBER(onset_site, "radius", radius, "m", "of the grain"),
    NUMBER(onset_site, "time", time, "s", "of the armature's arrival; null: not reached"),
    NUMBER(onset_site, "velocity", velocity, "m/s", "at arrival"),
    NUMBER(onset_site, "current", current, "A", "at arrival"),
    NUMBER(onset_site, "contact_pressure", contact_pressure, "Pa", "at arrival"),
    NUMBER(onset_site, "impact_pressure", impact_pressure, "Pa", "by impedance match"),
    NUMBER(onset_site, "screen", screen, "1", "impact pressure over hardness"),
    NUMBER(onset_site, "threshold_velocity", threshold_velocity, "m/s", "for its grain"),
    VECTOR(onset_site, "threshold_interval", threshold_interval, 2, "m/s", "for its grain"),
    NUMBER(onset_site, "gouged_volume", gouged_volume, "m3", "of its crater"),
    NAME(onset_site, "outcome", outcome, output_site_outcome_names,
           "not_reached, skipped, none, scratch, gouge, undecided"),
    VALUE(onset_site, KEY_TEXT, "scene", scene, "", "that decided, empty if none"),
    KEYS_END
};

/* A scene of a study: what it was given; its result's keys follow in the same object. */
const summary_key output_summary_study_scene_keys[] = {
    VALUE(onset_scene, KEY_TEXT, "name", name, "", "folder under scenes/, group under /scene of history.h5"),
    NUMBER(onset_scene, "velocity", velocity, "m/s", "of the armature"),
    NUMBER(onset_scene, "radius", radius, "m", "of the grain"),
    NUMBER(onset_scene, "height", height, "m", "of the grain"),
    VALUE(onset_scene, KEY_TEXT, "shape", shape, "", "of the grain"),
    VALUE(onset_scene, KEY_TEXT, "material", material, "", "of the grain"),
    VALUE(onset_scene, KEY_TEXT, "surface", surface, "", "of the rail"),
    NUMBER(onset_scene, "contact_pressure", contact_pressure, "Pa", "pressing the armature on"),
    NUMBER(onset_scene, "temperature", temperature, "K", "of the rail"),
    NUMBER(onset_scene, "cells_per_radius", cells_per_radius, "1", "resolution"),
    VALUE(onset_scene, KEY_FLAG, "gauged", gauged, "",
           "over once its groove's growth was known: class by that, crater as far as it was"),
    VALUE(onset_scene, KEY_FLAG, "reused", reused, "", "not computed by this run"),
    KEYS_END
};

const summary_key output_summary_surface_keys[] = {
    VALUE(onset_size, KEY_INTEGER, "family", family, "1", "of grains alike in all but size"),
    VALUE(onset_size, KEY_TEXT, "shape", shape, "", "of its grains"),
    VALUE(onset_size, KEY_TEXT, "material", material, "", "of its grains"),
    NUMBER(onset_size, "radius", radius, "m", "of the grain"),
    NUMBER(onset_size, "grains", grains, "1", "this size stands for"),
    NUMBER(onset_size, "threshold_velocity", threshold_velocity, "m/s", "null: outside of the search"),
    VECTOR(onset_size, "threshold_interval", threshold_interval, 2, "m/s",
           "its band, and the shift from coarse to fine"),
    VALUE(onset_size, KEY_INTEGER, "scenes", scenes, "1", "of this size; 0: bounded by those of other sizes"),
    KEYS_END
};

const summary_key output_summary_skip_keys[] = {
    VALUE(onset_skip, KEY_TEXT, "rests_on", rests_on, "", "why no scene was needed"),
    VALUE(onset_skip, KEY_INTEGER, "scenes", scenes, "1", "sites, sizes or populations skipped for it"),
    KEYS_END
};

const summary_key output_summary_sensitivity_keys[] = {
    VALUE(onset_sensitivity, KEY_TEXT, "input", input, "", "what is changed, all else as it was"),
    NUMBER(onset_sensitivity, "change", change, "1", "relative"),
    NUMBER(onset_sensitivity, "muzzle_velocity", muzzle_velocity, "m/s", ""),
    NUMBER(onset_sensitivity, "threshold_velocity", threshold_velocity, "m/s", "of the grain that speaks for the case"),
    NUMBER(onset_sensitivity, "threshold_position", threshold_position, "m", "along the barrel"),
    NUMBER(onset_sensitivity, "expected_gouges", expected_gouges, "1", "a shot"),
    KEYS_END
};

const summary_key output_summary_repeated_keys[] = {
    VALUE(onset_shot, KEY_INTEGER, "shot", shot, "1", "from 1, on the same rail"),
    NUMBER(onset_shot, "probability_gouge", probability_gouge, "1", "that it gouges"),
    NUMBER(onset_shot, "expected_gouges", expected_gouges, "1", ""),
    NUMBER(onset_shot, "expected_gouged_volume", expected_gouged_volume, "m3", ""),
    NUMBER(onset_shot, "onset_position", onset_position, "m", "median of the first gouge; null: less than half gouge"),
    VECTOR(onset_shot, "onset_interval", onset_interval, 2, "m", "5 and 95 % of the shots"),
    NUMBER(onset_shot, "muzzle_velocity", muzzle_velocity, "m/s", "through rails as warm as they are in the mean"),
    NUMBER(onset_shot, "rail_rise", rail_rise, "K", "of the rail before it: the largest from study.velocity_low on"),
    NUMBER(onset_shot, "threshold_velocity", threshold_velocity, "m/s", "as the study's, where the rail is that warm"),
    KEYS_END
};

static const summary_key onset_keys[] = {
    NAME(onset_result, "verdict", verdict, output_onset_verdict_names, "gouges, no_gouging, undecided"),
    VALUE(onset_result, KEY_TEXT, "reason", reason, "", "of the verdict"),
    NUMBER(onset_result, "probability_gouge", probability_gouge, "1", "that the shot gouges"),
    NUMBER(onset_result, "threshold_velocity", threshold_velocity, "m/s",
           "at the population's median size for a population"),
    VECTOR(onset_result, "threshold_interval", threshold_interval, 2, "m/s",
           "bracket, resolution and input uncertainty"),
    NUMBER(onset_result, "onset_position", onset_position, "m", "along the barrel"),
    VECTOR(onset_result, "onset_interval", onset_interval, 2, "m", "of the position"),
    NUMBER(onset_result, "threshold_position", threshold_position, "m", "where the threshold velocity is passed"),
    VECTOR(onset_result, "threshold_position_interval", threshold_position_interval, 2, "m", "where its ends are"),
    NUMBER(onset_result, "muzzle_velocity_feedback", muzzle_velocity_feedback, "m/s",
           "with what the gouges take; null: nothing taken"),
    VALUE(onset_result, KEY_INTEGER, "gouges", gouges, "1", "sites of the list that gouge"),
    NUMBER(onset_result, "expected_gouges", expected_gouges, "1", "a shot, sites and populations"),
    VECTOR(onset_result, "expected_gouges_interval", expected_gouges_interval, 2, "1",
           "5 and 95 % of what may be true"),
    NUMBER(onset_result, "expected_gouged_volume", expected_gouged_volume, "m3", "a shot"),
    VECTOR(onset_result, "expected_gouged_volume_interval", expected_gouged_volume_interval, 2, "m3", "5 and 95 %"),
    VALUE(onset_result, KEY_INTEGER, "histories", histories, "1", "of the Monte Carlo"),
    NUMBER(onset_result, "monte_carlo_seconds", monte_carlo_seconds, "s", "time they took"),
    ARRAY(onset_result, "along", along, n_along, "m", "along the barrel"),
    ARRAY(onset_result, "probability_along", probability_along, n_along, "1", "that a gouge lies before it"),
    LIST(onset_result, "surface", surface, n_surface, output_summary_surface_keys, sizeof(onset_size),
           "a family and size each, keys below"),
    LIST(onset_result, "skips", skip, n_skips, output_summary_skip_keys, sizeof(onset_skip),
           "why scenes were not needed, keys below"),
    LIST(onset_result, "sensitivities", sensitivities, n_sensitivities, output_summary_sensitivity_keys,
         sizeof(onset_sensitivity),
           "keys below"),
    LIST(onset_result, "shots", shot, n_shots, output_summary_repeated_keys, sizeof(onset_shot),
           "on the same rail, keys below"),
    VALUE(onset_result, KEY_INTEGER, "scenes_reused", scenes_reused, "1", "taken from the store"),
    VALUE(onset_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    VALUE(onset_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1", "by the screen or shared"),
    LIST(onset_result, "sites", site, n_sites, output_summary_site_keys, sizeof(onset_site), "a site each, keys below"),
    LIST(onset_result, "scenes", scene, n_scenes, output_summary_study_scene_keys, sizeof(onset_scene),
           "a scene each, keys below"),
    NUMBER(onset_result, "wall_seconds", wall_seconds, "s", "time it took"),
    KEYS_END
};

const summary_key output_summary_compare_entry_keys[] = {
    VALUE(compare_entry, KEY_TEXT, "surface", surface, "", "of the rail"),
    NUMBER(compare_entry, "threshold_velocity", threshold_velocity, "m/s", ""),
    VECTOR(compare_entry, "threshold_interval", threshold_interval, 2, "m/s", ""),
    NUMBER(compare_entry, "onset_position", onset_position, "m", "along the barrel; null: no gouging"),
    NUMBER(compare_entry, "gouged_volume", gouged_volume, "m3", "of the whole shot"),
    VECTOR(compare_entry, "gouged_volume_interval", gouged_volume_interval, 2, "m3", "5 and 95 % of what may be true"),
    NUMBER(compare_entry, "threshold_position", threshold_position, "m", "where the threshold velocity is passed"),
    NUMBER(compare_entry, "gouges", gouges, "1", "a shot, expected: what ranks"),
    VECTOR(compare_entry, "gouges_interval", gouges_interval, 2, "1", "5 and 95 % of what may be true"),
    NUMBER(compare_entry, "probability_gouge", probability_gouge, "1", "that a shot gouges"),
    NUMBER(compare_entry, "better_than_next", better_than_next, "1",
           "share of what may be true in which it gouges less than the next"),
    VALUE(compare_entry, KEY_FLAG, "significant", significant, "", "better_than_next is at least 0.95"),
    VALUE(compare_entry, KEY_INTEGER, "tied", tied, "1", "rank of the group of surfaces it cannot be told apart from"),
    VALUE(compare_entry, KEY_INTEGER, "scenes", scenes, "1", "its own, shared ones not counted twice"),
    VALUE(compare_entry, KEY_TEXT, "layer", layer, "",
           "what its layers suffer: none, intact, spalled, sheared off, worn through"),
    NUMBER(compare_entry, "layer_failed", layer_failed, "1", "share of the layers under the crater that failed"),
    NUMBER(compare_entry, "layer_velocity", layer_velocity, "m/s", "of the scene that says so"),
    KEYS_END
};

static const summary_key compare_keys[] = {
    LIST(compare_result, "ranking", ranking, n, output_summary_compare_entry_keys, sizeof(compare_entry),
           "a surface each, best first"),
    LIST(compare_result, "scenes", scene, n_scenes, output_summary_study_scene_keys, sizeof(onset_scene),
           "a scene each, keys as in onset"),
    VALUE(compare_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    VALUE(compare_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1",
           "by the screen, shared or bounded by others"),
    VALUE(compare_result, KEY_INTEGER, "scenes_reused", scenes_reused, "1", "taken from the store"),
    VALUE(compare_result, KEY_INTEGER, "histories", histories, "1", "of the Monte Carlo"),
    NUMBER(compare_result, "wall_seconds", wall_seconds, "s", "time it took"),
    KEYS_END
};

static const summary_key inductance_keys[] = {
    ARRAY(inductance_result, "frequency", frequency, n, "Hz", ""),
    ARRAY(inductance_result, "L_gradient", L_gradient, n, "H/m", "of the pair, over frequency"),
    ARRAY(inductance_result, "R_gradient", R_gradient, n, "ohm/m", "of the pair, over frequency"),
    NUMBER(inductance_result, "L_gradient_high_frequency", L_gradient_high_frequency, "H/m", "limit"),
    NUMBER(inductance_result, "L_gradient_direct_current", L_gradient_direct_current, "H/m", "limit"),
    NUMBER(inductance_result, "R_gradient_direct_current", R_gradient_direct_current, "ohm/m", "limit"),
    NUMBER(inductance_result, "L_gradient_kerrisk", L_gradient_kerrisk, "H/m",
           "Kerrisk's formula for the high-frequency limit; null: not two flat rails"),
    NUMBER(inductance_result, "kerrisk_error", kerrisk_error, "1", "of that formula, over L_gradient_high_frequency"),
    NUMBER(inductance_result, "perimeter_frequency", perimeter_frequency, "Hz", "of the three that follow"),
    ARRAY(inductance_result, "perimeter", perimeter, n_perimeter, "m",
          "along the surface, middle of the bore face to middle of the back"),
    ARRAY(inductance_result, "perimeter_current", perimeter_current, n_perimeter, "1/m2",
          "current density there over the rail's current"),
    ARRAY(inductance_result, "perimeter_heat", perimeter_heat, n_perimeter, "ohm/m3",
          "heating there over the rail's current squared, W/m3 per A2"),
    KEYS_END
};
/* clang-format on */

const summary_key *const output_summary_keys_of_kind[RUN_KINDS] = { output_summary_shot_keys, output_summary_scene_keys,
                                                                    onset_keys, compare_keys, inductance_keys };

const void *output_summary_object_of_kind(const run_summary *s)
{
    const void *const objects[RUN_KINDS] = { s->shot, s->scene, s->onset, s->compare, s->inductance };
    return objects[s->kind];
}
