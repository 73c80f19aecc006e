#include "coupling/io/summary.h"

#include "coupling/io/outdir.h"
#include "coupling/io/table.h"

#include <cJSON.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

const char *const site_outcome_names[] = { "not_reached", "skipped", "none", "scratch", "gouge", "undecided", NULL };
const char *const onset_verdict_names[] = { "gouges", "no_gouging", "undecided", NULL };
const char *const run_kind_names[] = { "shot", "scene", "onset", "compare", "inductance", NULL };
const char *const run_status_names[] = { "done", "stopped", "failed", NULL };

const char *breech_version(void)
{
#ifdef BREECH_VERSION
    return BREECH_VERSION;
#else
    return "unknown";
#endif
}

/* ---- the keys: one table a struct ---- */

typedef enum {
    KEY_NUMBER,  /* double [n] */
    KEY_COUNT,   /* uint64_t */
    KEY_INTEGER, /* int */
    KEY_FLAG,    /* bool */
    KEY_TEXT,    /* char[] */
    KEY_NAME,    /* enum, named by `names` */
    KEY_BY_BODY, /* double a body of a scene_result: an object */
    KEY_LIST,    /* objects by `item`, n_member of them */
    KEY_ARRAY    /* const double *, n_member of them */
} key_kind;

typedef struct summary_key {
    const char *name, *unit, *doc;
    key_kind kind;
    size_t offset;
    int n;                          /* KEY_NUMBER: 1, or the length of a vector */
    const char *const *names;       /* KEY_NAME */
    const struct summary_key *item; /* KEY_LIST */
    size_t item_size, n_offset;     /* KEY_LIST, KEY_ARRAY: where the int stands that counts them */
} summary_key;

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
static const summary_key shot_keys[] = {
    NUMBER(shot_record, "peak_current", is.peak_current, "A", "largest current in the rails"),
    NUMBER(shot_record, "muzzle_velocity", is.muzzle_velocity, "m/s", "null: the armature did not leave"),
    NUMBER(shot_record, "muzzle_time", is.muzzle_time, "s", "when it left"),
    NUMBER(shot_record, "muzzle_energy", is.muzzle_energy, "J", "kinetic, at exit"),
    NUMBER(shot_record, "efficiency", is.efficiency, "1", "muzzle energy over the energy stored at the start and supplied since"),
    NUMBER(shot_record, "action", is.action, "A2 s", "integral of the current's square"),
    NUMBER(shot_record, "peak_acceleration", is.peak_acceleration, "m/s2", "of the armature"),
    NUMBER(shot_record, "exit_current", is.exit_current, "A", "at the muzzle"),
    NUMBER(shot_record, "energy_error", is.energy_error, "1", "over the energy stored at the start and supplied since"),
    NUMBER(shot_record, "contact_ratio", limits.contact_ratio, "1", "least contact force over 1 gram-force per ampere, in motion"),
    NUMBER(shot_record, "leg_action", limits.leg_action, "1", "action over that which melts the leg; null: armature.leg_area is not given"),
    NUMBER(shot_record, "throat_action", limits.throat_action, "1", "the throat alike; null: armature.throat_area is not given"),
    NUMBER(shot_record, "wear_share", limits.wear_share, "1", "thickness worn off over armature.leg_thickness; null: not given"),
    NUMBER(shot_record, "transition_position", limits.transition_position, "m", "where the first of these four passes its limit; null: nowhere"),
    NUMBER(shot_record, "melt_position", limits.melt_position, "m", "where the armature's face melted, friction_law film; null: it did not"),
    NUMBER(shot_record, "critical_velocity", limits.critical_velocity, "m/s", "of bending waves in the rail; null: rails.backing_stiffness is not given"),
    NUMBER(shot_record, "critical_position", limits.critical_position, "m", "where the armature first exceeds it; null: nowhere"),
    VALUE(shot_record, KEY_COUNT, "steps", is.steps, "1", "of the integration"),
    NUMBER(shot_record, "wall_seconds", wall_seconds, "s", "time it took"),
    VALUE(shot_record, KEY_INTEGER, "optimise_evaluations", firing.evaluations, "1", "trials of the search for firing times; 0: none was asked for"),
    NUMBER(shot_record, "optimise_before", firing.before, "1", "its measure at the start: unevenness, or stored energy [J]"),
    NUMBER(shot_record, "optimise_after", firing.after, "1", "and of what was found"),
    NUMBER(shot_record, "charge_scale", firing.charge_scale, "1", "factor on all charges that it found"),
    ARRAY(shot_record, "fire_at", fire_at, n_fire_at, "s", "firing times of the bank's groups that it found"),
    KEYS_END
};

static const summary_key scene_keys[] = {
    NAME(scene_result, "class", class, damage_class_names, "none, scratch, gouge, undecided"),
    VALUE(scene_result, KEY_TEXT, "reason", reason, "", "the numbers behind the class"),
    NUMBER(scene_result, "severity", severity, "1", "(lean x volume - plan area x height of the grain) / its volume; gouging grows above 0"),
    NUMBER(scene_result, "groove_growth", groove_growth, "1/s", "rate of ln of the plastic power in the groove, past the grain; null: not followed so far"),
    NUMBER(scene_result, "crater_length", crater_length, "m", "along the rail"),
    NUMBER(scene_result, "crater_width", crater_width, "m", "full width"),
    NUMBER(scene_result, "crater_depth", crater_depth, "m", "deepest"),
    NUMBER(scene_result, "crater_volume", crater_volume, "m3", "below the surface"),
    NUMBER(scene_result, "rim_height", rim_height, "m", "highest above the surface"),
    NUMBER(scene_result, "widening", widening, "1", "width of the downstream third over the upstream third"),
    VALUE(scene_result, KEY_FLAG, "crater_truncated", crater_truncated, "", "reaches the map's edge: length, volume are lower bounds"),
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
    VALUE(scene_result, KEY_BY_BODY, "carried_volume", carried_volume, "m3", "sound metal that goes with the armature at the end, by body, full model"),
    NUMBER(scene_result, "end_time", end_time, "s", "simulated"),
    VALUE(scene_result, KEY_COUNT, "particles", particles, "1", "at the end"),
    VALUE(scene_result, KEY_COUNT, "steps", steps, "1", "of the solver"),
    VALUE(scene_result, KEY_COUNT, "particle_steps", particle_steps, "1", "done"),
    VALUE(scene_result, KEY_COUNT, "particle_steps_dense", particle_steps_dense, "1", "if nothing had been skipped"),
    VALUE(scene_result, KEY_COUNT, "clamps_pressure", clamps_pressure, "1", "pressures held at a limit"),
    VALUE(scene_result, KEY_COUNT, "clamps_compression", clamps_compression, "1", "compressions held at a limit"),
    NUMBER(scene_result, "eroded_mass", eroded_mass, "kg", "vapour and dust taken out, full model"),
    NUMBER(scene_result, "wall_seconds", wall_seconds, "s", "time it took"),
    VALUE(scene_result, KEY_INTEGER, "threads", threads, "1", "used"),
    KEYS_END
};

static const summary_key site_keys[] = {
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
    NAME(onset_site, "outcome", outcome, site_outcome_names, "not_reached, skipped, none, scratch, gouge, undecided"),
    VALUE(onset_site, KEY_TEXT, "scene", scene, "", "that decided, empty if none"),
    KEYS_END
};

/* A scene of a study: what it was given; its result's keys follow in the same object. */
static const summary_key study_scene_keys[] = {
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
    VALUE(onset_scene, KEY_FLAG, "gauged", gauged, "", "over once its groove's growth was known: class by that, crater as far as it was"),
    VALUE(onset_scene, KEY_FLAG, "reused", reused, "", "not computed by this run"),
    KEYS_END
};

static const summary_key surface_keys[] = {
    VALUE(onset_size, KEY_INTEGER, "family", family, "1", "of grains alike in all but size"),
    VALUE(onset_size, KEY_TEXT, "shape", shape, "", "of its grains"),
    VALUE(onset_size, KEY_TEXT, "material", material, "", "of its grains"),
    NUMBER(onset_size, "radius", radius, "m", "of the grain"),
    NUMBER(onset_size, "grains", grains, "1", "this size stands for"),
    NUMBER(onset_size, "threshold_velocity", threshold_velocity, "m/s", "null: outside of the search"),
    VECTOR(onset_size, "threshold_interval", threshold_interval, 2, "m/s", "its band, and the shift from coarse to fine"),
    VALUE(onset_size, KEY_INTEGER, "scenes", scenes, "1", "of this size; 0: bounded by those of other sizes"),
    KEYS_END
};

static const summary_key skip_keys[] = {
    VALUE(onset_skip, KEY_TEXT, "rests_on", rests_on, "", "why no scene was needed"),
    VALUE(onset_skip, KEY_INTEGER, "scenes", scenes, "1", "sites, sizes or populations skipped for it"),
    KEYS_END
};

static const summary_key sensitivity_keys[] = {
    VALUE(onset_sensitivity, KEY_TEXT, "input", input, "", "what is changed, all else as it was"),
    NUMBER(onset_sensitivity, "change", change, "1", "relative"),
    NUMBER(onset_sensitivity, "muzzle_velocity", muzzle_velocity, "m/s", ""),
    NUMBER(onset_sensitivity, "threshold_position", threshold_position, "m", "along the barrel"),
    NUMBER(onset_sensitivity, "expected_gouges", expected_gouges, "1", "a shot"),
    KEYS_END
};

static const summary_key repeated_keys[] = {
    VALUE(onset_shot, KEY_INTEGER, "shot", shot, "1", "from 1, on the same rail"),
    NUMBER(onset_shot, "probability_gouge", probability_gouge, "1", "that it gouges"),
    NUMBER(onset_shot, "expected_gouges", expected_gouges, "1", ""),
    NUMBER(onset_shot, "expected_gouged_volume", expected_gouged_volume, "m3", ""),
    NUMBER(onset_shot, "onset_position", onset_position, "m", "median of the first gouge; null: less than half gouge"),
    VECTOR(onset_shot, "onset_interval", onset_interval, 2, "m", "5 and 95 % of the shots"),
    KEYS_END
};

static const summary_key onset_keys[] = {
    NAME(onset_result, "verdict", verdict, onset_verdict_names, "gouges, no_gouging, undecided"),
    VALUE(onset_result, KEY_TEXT, "reason", reason, "", "of the verdict"),
    NUMBER(onset_result, "probability_gouge", probability_gouge, "1", "that the shot gouges"),
    NUMBER(onset_result, "threshold_velocity", threshold_velocity, "m/s", "at the population's median size for a population"),
    VECTOR(onset_result, "threshold_interval", threshold_interval, 2, "m/s", "bracket, resolution and input uncertainty"),
    NUMBER(onset_result, "onset_position", onset_position, "m", "along the barrel"),
    VECTOR(onset_result, "onset_interval", onset_interval, 2, "m", "of the position"),
    NUMBER(onset_result, "threshold_position", threshold_position, "m", "where the threshold velocity is passed"),
    VECTOR(onset_result, "threshold_position_interval", threshold_position_interval, 2, "m", "where its ends are"),
    NUMBER(onset_result, "muzzle_velocity_feedback", muzzle_velocity_feedback, "m/s", "with what the gouges take; null: nothing taken"),
    VALUE(onset_result, KEY_INTEGER, "gouges", gouges, "1", "sites of the list that gouge"),
    NUMBER(onset_result, "expected_gouges", expected_gouges, "1", "a shot, sites and populations"),
    VECTOR(onset_result, "expected_gouges_interval", expected_gouges_interval, 2, "1", "5 and 95 % of what may be true"),
    NUMBER(onset_result, "expected_gouged_volume", expected_gouged_volume, "m3", "a shot"),
    VECTOR(onset_result, "expected_gouged_volume_interval", expected_gouged_volume_interval, 2, "m3", "5 and 95 %"),
    VALUE(onset_result, KEY_INTEGER, "histories", histories, "1", "of the Monte Carlo"),
    NUMBER(onset_result, "monte_carlo_seconds", monte_carlo_seconds, "s", "time they took"),
    ARRAY(onset_result, "along", along, n_along, "m", "along the barrel"),
    ARRAY(onset_result, "probability_along", probability_along, n_along, "1", "that a gouge lies before it"),
    LIST(onset_result, "surface", surface, n_surface, surface_keys, sizeof(onset_size), "a family and size each, keys below"),
    LIST(onset_result, "skips", skip, n_skips, skip_keys, sizeof(onset_skip), "why scenes were not needed, keys below"),
    LIST(onset_result, "sensitivities", sensitivities, n_sensitivities, sensitivity_keys, sizeof(onset_sensitivity), "keys below"),
    LIST(onset_result, "shots", shot, n_shots, repeated_keys, sizeof(onset_shot), "on the same rail, keys below"),
    VALUE(onset_result, KEY_INTEGER, "scenes_reused", scenes_reused, "1", "taken from the store"),
    VALUE(onset_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    VALUE(onset_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1", "by the screen or shared"),
    LIST(onset_result, "sites", site, n_sites, site_keys, sizeof(onset_site), "a site each, keys below"),
    LIST(onset_result, "scenes", scene, n_scenes, study_scene_keys, sizeof(onset_scene), "a scene each, keys below"),
    NUMBER(onset_result, "wall_seconds", wall_seconds, "s", "time it took"),
    KEYS_END
};

static const summary_key compare_entry_keys[] = {
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
    NUMBER(compare_entry, "better_than_next", better_than_next, "1", "share of what may be true in which it gouges less than the next"),
    VALUE(compare_entry, KEY_FLAG, "significant", significant, "", "better_than_next is at least 0.95"),
    VALUE(compare_entry, KEY_INTEGER, "tied", tied, "1", "rank of the group of surfaces it cannot be told apart from"),
    VALUE(compare_entry, KEY_INTEGER, "scenes", scenes, "1", "its own, shared ones not counted twice"),
    VALUE(compare_entry, KEY_TEXT, "layer", layer, "", "what its layers suffer: none, intact, spalled, sheared off, worn through"),
    NUMBER(compare_entry, "layer_failed", layer_failed, "1", "share of the layers under the crater that failed"),
    NUMBER(compare_entry, "layer_velocity", layer_velocity, "m/s", "of the scene that says so"),
    KEYS_END
};

static const summary_key compare_keys[] = {
    LIST(compare_result, "ranking", ranking, n, compare_entry_keys, sizeof(compare_entry), "a surface each, best first"),
    LIST(compare_result, "scenes", scene, n_scenes, study_scene_keys, sizeof(onset_scene), "a scene each, keys as in onset"),
    VALUE(compare_result, KEY_INTEGER, "scenes_run", scenes_run, "1", "computed"),
    VALUE(compare_result, KEY_INTEGER, "scenes_skipped", scenes_skipped, "1", "by the screen, shared or bounded by others"),
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

static const summary_key *const keys_of_kind[RUN_KINDS] = { shot_keys, scene_keys, onset_keys, compare_keys,
                                                            inductance_keys };

static const void *object_of_kind(const run_summary *s)
{
    const void *const objects[RUN_KINDS] = { s->shot, s->scene, s->onset, s->compare, s->inductance };
    return objects[s->kind];
}

/* ---- JSON ---- */

static cJSON *number_json(double value)
{
    return isfinite(value) ? cJSON_CreateNumber(value) : cJSON_CreateNull();
}

static cJSON *vector_json(const double *value, int n)
{
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < n; i++) cJSON_AddItemToArray(list, number_json(value[i]));
    return list;
}

/* A vector that does not exist (an interval where there is none) is null as a whole. */
static cJSON *vector_or_null(const double *value, int n)
{
    bool any = false;
    for (int i = 0; i < n; i++) any = any || isfinite(value[i]);
    return any ? vector_json(value, n) : cJSON_CreateNull();
}

static cJSON *by_body_json(const scene_result *r, const double *value)
{
    cJSON *object = cJSON_CreateObject();
    for (int b = 0; b < r->bodies && b < MPM_MAX_BODIES; b++)
        cJSON_AddItemToObject(object, r->body[b], number_json(value[b]));
    return object;
}

static void add_keys(cJSON *object, const summary_key *keys, const void *from);

static const scene_result *result_of(const void *scene)
{
    return &((const onset_scene *)scene)->result;
}

static cJSON *list_json(const summary_key *k, const char *base)
{
    const int n = *(const int *)(base + k->n_offset);
    const char *items = *(const char *const *)(base + k->offset);
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < n; i++) {
        const char *item = items + (size_t)i * k->item_size;
        cJSON *object = cJSON_CreateObject();
        add_keys(object, k->item, item);
        if (k->item == study_scene_keys) add_keys(object, scene_keys, result_of(item));
        cJSON_AddItemToArray(list, object);
    }
    return list;
}

static cJSON *value_json(const summary_key *k, const void *from)
{
    const char *base = from;
    const void *member = base + k->offset;
    switch (k->kind) {
    case KEY_NUMBER: return k->n == 1 ? number_json(*(const double *)member) : vector_or_null(member, k->n);
    case KEY_COUNT: return cJSON_CreateNumber((double)*(const uint64_t *)member);
    case KEY_INTEGER: return cJSON_CreateNumber(*(const int *)member);
    case KEY_FLAG: return cJSON_CreateBool(*(const bool *)member);
    case KEY_TEXT: return cJSON_CreateString(member);
    case KEY_NAME: return cJSON_CreateString(k->names[*(const int *)member]);
    case KEY_BY_BODY: return by_body_json(from, (const double *)member);
    case KEY_LIST: return list_json(k, base);
    case KEY_ARRAY:
        return vector_json(*(const double *const *)member, *(const int *)(const void *)(base + k->n_offset));
    }
    return NULL;
}

/* from == NULL: every key, null. */
static void add_keys(cJSON *object, const summary_key *keys, const void *from)
{
    for (const summary_key *k = keys; k->name; k++)
        cJSON_AddItemToObject(object, k->name, from ? value_json(k, from) : cJSON_CreateNull());
}

static cJSON *warnings_json(const char *warnings)
{
    cJSON *list = cJSON_CreateArray();
    for (const char *line = warnings ? warnings : ""; *line;) {
        const size_t n = strcspn(line, "\n");
        char text[1000];
        snprintf(text, sizeof text, "%.*s", (int)(n < sizeof text ? n : sizeof text - 1), line);
        if (n) cJSON_AddItemToArray(list, cJSON_CreateString(text));
        line += n + (line[n] == '\n');
    }
    return list;
}

static void add_common(cJSON *root, const run_summary *s)
{
    cJSON_AddStringToObject(root, "kind", run_kind_names[s->kind]);
    cJSON_AddStringToObject(root, "case", s->case_name ? s->case_name : "");
    cJSON_AddStringToObject(root, "version", breech_version());
    cJSON_AddStringToObject(root, "instruction_set", s->instruction_set ? s->instruction_set : "");
    cJSON_AddStringToObject(root, "status", run_status_names[s->status]);
    if (s->error)
        cJSON_AddStringToObject(root, "error", s->error);
    else
        cJSON_AddNullToObject(root, "error");
    cJSON_AddItemToObject(root, "warnings", warnings_json(s->warnings));
}

/* cJSON writes 15 digits where they are nearly right; numbers here are the shortest text that is exactly right. */
static void make_exact(cJSON *node)
{
    for (cJSON *item = node ? node->child : NULL, *next; item; item = next) {
        char text[32];
        next = item->next;
        make_exact(item);
        if (!cJSON_IsNumber(item)) continue;
        for (int digits = 15; digits <= 17; digits++) {
            snprintf(text, sizeof text, "%.*g", digits, item->valuedouble);
            if (strtod(text, NULL) == item->valuedouble) break;
        }
        cJSON *exact = cJSON_CreateRaw(text);
        if (!exact) continue;
        if (item->string) exact->string = strdup(item->string);
        cJSON_ReplaceItemViaPointer(node, item, exact);
    }
}

char *summary_text(const run_summary *s)
{
    cJSON *root = cJSON_CreateObject();
    if (!root) return NULL;
    add_common(root, s);
    add_keys(root, keys_of_kind[s->kind], object_of_kind(s));
    if (s->kind == RUN_ONSET || s->kind == RUN_COMPARE) {
        cJSON *shot_json = cJSON_CreateObject();
        add_keys(shot_json, shot_keys, s->shot);
        cJSON_AddItemToObject(root, "shot", shot_json);
    }
    make_exact(root);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

status summary_write(const char *dir, const run_summary *s)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%s/%s", dir, OUTDIR_SUMMARY);
    CHECK(n > 0 && (size_t)n < sizeof path, STATUS_IO, "%.300s: path too long", dir);
    char *text = summary_text(s);
    CHECK(text, STATUS_MEMORY, "no memory for the summary");
    file_writer w;
    status result = file_begin(&w, path);
    if (result.code == STATUS_OK) {
        fprintf(w.stream, "%s\n", text);
        result = file_end(&w, true);
    }
    free(text);
    return result;
}

void summary_status(const char *dir, char *out, size_t size)
{
    out[0] = '\0';
    char path[OUTDIR_PATH_SIZE], *text;
    const int n = snprintf(path, sizeof path, "%s/%s", dir, OUTDIR_SUMMARY);
    if (n < 0 || (size_t)n >= sizeof path || file_read(path, &text, NULL).code != STATUS_OK) return;
    cJSON *root = cJSON_Parse(text);
    const char *word = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "status"));
    if (word) snprintf(out, size, "%s", word);
    cJSON_Delete(root);
    free(text);
}

/* ---- one scene as text, and back ---- */

char *summary_scene_text(const onset_scene *s)
{
    cJSON *object = cJSON_CreateObject();
    add_keys(object, study_scene_keys, s);
    add_keys(object, scene_keys, result_of(s));
    make_exact(object);
    char *text = cJSON_PrintUnformatted(object);
    cJSON_Delete(object);
    return text;
}

static int name_index(const char *const *names, const char *name)
{
    for (int i = 0; name && names[i]; i++)
        if (strcmp(names[i], name) == 0) return i;
    return -1;
}

static double number_of(const cJSON *value)
{
    return cJSON_IsNumber(value) ? value->valuedouble : NAN;
}

static bool read_by_body(const cJSON *object, scene_result *r, double *out)
{
    const cJSON *value;
    r->bodies = 0;
    cJSON_ArrayForEach(value, object)
    {
        if (r->bodies == MPM_MAX_BODIES) return false;
        snprintf(r->body[r->bodies], sizeof r->body[0], "%s", value->string);
        out[r->bodies++] = number_of(value);
    }
    return cJSON_IsObject(object);
}

/* The kinds a scene's result has; value_json the other way round. */
static bool read_value(const summary_key *k, const cJSON *value, scene_result *r)
{
    void *member = (char *)r + k->offset;
    double *number = member;
    switch (k->kind) {
    case KEY_NUMBER:
        for (int i = 0; i < k->n; i++) number[i] = number_of(k->n == 1 ? value : cJSON_GetArrayItem(value, i));
        return value != NULL;
    case KEY_COUNT: *(uint64_t *)member = (uint64_t)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_INTEGER: *(int *)member = (int)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_FLAG: *(bool *)member = cJSON_IsTrue(value); return cJSON_IsBool(value);
    case KEY_TEXT: /* the only one of a result is its reason */
        snprintf(member, sizeof r->reason, "%s", cJSON_IsString(value) ? value->valuestring : "");
        return cJSON_IsString(value);
    case KEY_NAME: *(int *)member = name_index(k->names, cJSON_GetStringValue(value)); return *(int *)member >= 0;
    case KEY_BY_BODY: return read_by_body(value, r, member);
    case KEY_LIST:
    case KEY_ARRAY: break;
    }
    return false;
}

status summary_scene_result(const char *text, scene_result *out)
{
    memset(out, 0, sizeof *out);
    cJSON *root = cJSON_Parse(text);
    const char *missing = NULL;
    for (const summary_key *k = scene_keys; k->name && !missing; k++)
        if (!read_value(k, cJSON_GetObjectItemCaseSensitive(root, k->name), out)) missing = k->name;
    cJSON_Delete(root);
    CHECK(!missing, STATUS_IO, "the result of a scene has no `%s`", missing);
    return status_ok();
}

/* ---- for people ---- */

static void value_text(const summary_key *k, const void *from, char *out, size_t size)
{
    cJSON *value = value_json(k, from);
    char *json = value ? cJSON_PrintUnformatted(value) : NULL;
    if (cJSON_IsNumber(value))
        snprintf(out, size, "%.6g", value->valuedouble);
    else if (cJSON_IsString(value))
        snprintf(out, size, "%s", value->valuestring);
    else if (!value || cJSON_IsNull(value))
        snprintf(out, size, "-");
    else
        snprintf(out, size, "%s", json ? json : "-");
    free(json);
    cJSON_Delete(value);
}

/* Short values only: lists are printed by the functions below, reasons by the caller. */
static void print_keys_table(const summary_key *keys, const void *from, FILE *out)
{
    table *t;
    if (!from || table_create("result|value|unit", &t).code != STATUS_OK) return;
    for (const summary_key *k = keys; k->name; k++) {
        char value[400];
        if (k->kind == KEY_LIST || k->kind == KEY_ARRAY || k->kind == KEY_BY_BODY || strcmp(k->name, "reason") == 0)
            continue;
        value_text(k, from, value, sizeof value);
        for (char *c = value; *c; c++)
            if (*c == '|') *c = '/';
        table_row(t, "%s|%.90s|%s", k->name, value, strcmp(k->unit, "1") == 0 ? "" : k->unit);
    }
    table_print(t, out);
    table_free(t);
}

/* x in units of `unit`, "-" where there is none. */
static const char *cell(double x, double unit, const char *format, char text[24])
{
    if (isfinite(x))
        snprintf(text, 24, format, x / unit);
    else
        snprintf(text, 24, "-");
    return text;
}

static void print_sites(const onset_result *o, FILE *out)
{
    table *t;
    if (o->n_sites == 0 || table_create("site|x [m]|v [m/s]|I [kA]|p [GPa]|p/H|outcome|scene", &t).code != STATUS_OK)
        return;
    for (int i = 0; i < o->n_sites; i++) {
        const onset_site *s = &o->site[i];
        char x[24], v[24], current[24], p[24], h[24];
        table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s", i + 1, cell(s->position, 1.0, "%.3f", x),
                  cell(s->velocity, 1.0, "%.0f", v), cell(s->current, 1e3, "%.0f", current),
                  cell(s->impact_pressure, 1e9, "%.2f", p), cell(s->screen, 1.0, "%.1f", h),
                  site_outcome_names[s->outcome], s->scene);
    }
    fputc('\n', out);
    table_print(t, out);
    table_free(t);
}

static void print_scenes(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "scene|v [m/s]|r [mm]|cells/r|severity|growth [1/us]|widening|depth [mm]|class|time [s]";
    if (o->n_scenes == 0 || table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_scenes; i++) {
        const onset_scene *s = &o->scene[i];
        char v[24], r[24], c[24], severity[24], growth[24], widening[24], d[24], w[24];
        table_row(t, "%s|%s|%s|%s|%s|%s|%s|%s|%s|%s", s->name, cell(s->velocity, 1.0, "%.0f", v),
                  cell(s->radius, 1e-3, "%.3g", r), cell(s->cells_per_radius, 1.0, "%.3g", c),
                  cell(s->gauged ? NAN : s->result.severity, 1.0, "%.3f", severity),
                  cell(s->result.groove_growth, 1e6, "%.3f", growth),
                  cell(s->gauged ? NAN : s->result.widening, 1.0, "%.2f", widening),
                  cell(s->gauged ? NAN : s->result.crater_depth, 1e-3, "%.3f", d), damage_class_names[s->result.class],
                  s->reused ? "reused" : cell(s->result.wall_seconds, 1.0, "%.1f", w));
    }
    fputc('\n', out);
    table_print(t, out);
    table_free(t);
}

static void print_ranking(const compare_result *c, FILE *out)
{
    table *t;
    const char *titles = "rank|surface|v_th [m/s]|from|to|x [m]|gouges|from|to|gouged [mm3]|better|layer";
    if (!c || table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        char v[24], lo[24], hi[24], x[24], volume[24], n[24], few[24], many[24], better[24];
        table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s", e->tied ? e->tied : i + 1, e->surface,
                  cell(e->threshold_velocity, 1.0, "%.0f", v), cell(e->threshold_interval[0], 1.0, "%.0f", lo),
                  cell(e->threshold_interval[1], 1.0, "%.0f", hi), cell(e->threshold_position, 1.0, "%.3f", x),
                  cell(e->gouges, 1.0, "%.3g", n), cell(e->gouges_interval[0], 1.0, "%.3g", few),
                  cell(e->gouges_interval[1], 1.0, "%.3g", many), cell(e->gouged_volume, 1e-9, "%.3g", volume),
                  cell(e->better_than_next, 0.01, "%.0f %%", better), e->layer);
    }
    table_print(t, out);
    table_free(t);
}

static void print_inductance(const inductance_result *r, FILE *out)
{
    table *t;
    if (!r || table_create("f [Hz]|L' [uH/m]|R' [mohm/m]", &t).code != STATUS_OK) return;
    for (int i = 0; i < r->n; i++)
        table_row(t, "%.4g|%.4f|%.5g", r->frequency[i], 1e6 * r->L_gradient[i], 1e3 * r->R_gradient[i]);
    table_print(t, out);
    table_free(t);
}

void summary_print(const run_summary *s, FILE *out)
{
    if (s->kind == RUN_ONSET || s->kind == RUN_COMPARE) {
        print_keys_table(shot_keys, s->shot, out);
        fputc('\n', out);
    }
    if (s->kind != RUN_COMPARE) print_keys_table(keys_of_kind[s->kind], object_of_kind(s), out);
    if (s->kind == RUN_ONSET && s->onset) {
        print_sites(s->onset, out);
        print_scenes(s->onset, out);
        if (s->onset->reason[0]) fprintf(out, "\n%s: %s\n", onset_verdict_names[s->onset->verdict], s->onset->reason);
    }
    if (s->kind == RUN_SCENE && s->scene && s->scene->reason[0])
        fprintf(out, "\n%s: %s\n", damage_class_names[s->scene->class], s->scene->reason);
    if (s->kind == RUN_COMPARE) print_ranking(s->compare, out);
    if (s->kind == RUN_INDUCTANCE) print_inductance(s->inductance, out);
    if (s->error) fprintf(out, "\n%s: %s\n", run_status_names[s->status], s->error);
}

static void print_key_list(const char *title, const summary_key *keys, FILE *out)
{
    fprintf(out, "\n### %s\n\n| key | unit | what |\n|---|---|---|\n", title);
    for (const summary_key *k = keys; k->name; k++) {
        char size[16] = "";
        if (k->kind == KEY_NUMBER && k->n > 1) snprintf(size, sizeof size, " [%d]", k->n);
        if (k->kind == KEY_LIST || k->kind == KEY_ARRAY) snprintf(size, sizeof size, " [...]");
        fprintf(out, "| `%s`%s | %s | %s |\n", k->name, size, k->unit, k->doc);
    }
}

void summary_print_keys(FILE *out)
{
    fputs("### all\n\n| key | what |\n|---|---|\n", out);
    fputs("| `kind` | shot, scene, onset, compare, inductance |\n| `case` | its name |\n| `version` | of Breech |\n"
          "| `instruction_set` | of the scenes |\n| `status` | done, stopped, failed |\n| `error` | null when there is "
          "none |\n| `warnings` | a text each |\n",
          out);
    for (int k = 0; k < RUN_KINDS; k++) print_key_list(run_kind_names[k], keys_of_kind[k], out);
    print_key_list("onset: an entry of `sites`", site_keys, out);
    print_key_list("onset: an entry of `scenes`, with all keys of `scene`", study_scene_keys, out);
    print_key_list("onset: an entry of `surface`", surface_keys, out);
    print_key_list("onset: an entry of `skips`", skip_keys, out);
    print_key_list("onset: an entry of `sensitivities`", sensitivity_keys, out);
    print_key_list("onset: an entry of `shots`", repeated_keys, out);
    print_key_list("compare: an entry of `ranking`", compare_entry_keys, out);
}

/* ---- from what the libraries say ---- */

static int body_named(const mpm_scene *scene, const char *name)
{
    for (int b = 0; b < scene->bodies; b++)
        if (strcmp(scene->body[b].name, name) == 0) return b;
    return -1;
}

static double of_body(const double *values, int body)
{
    return body < 0 ? NAN : values[body];
}

static void take_crater(scene_result *r, const crater *c)
{
    r->class = DAMAGE_UNDECIDED;
    r->severity = r->widening = NAN;
    r->crater_length = r->crater_width = r->crater_depth = r->crater_volume = r->rim_height = NAN;
    snprintf(r->reason, sizeof r->reason, "the crater was not measured");
    if (!c) return;
    r->class = c->class;
    snprintf(r->reason, sizeof r->reason, "%s", c->reason);
    r->severity = c->severity;
    r->widening = c->widening;
    r->crater_length = c->length;
    r->crater_width = c->width;
    r->crater_depth = c->depth;
    r->crater_volume = c->volume;
    r->rim_height = c->rim_height;
    r->crater_truncated = c->truncated;
}

/* The mirror half of a half model doubles what acts in its plane and cancels what acts across it. */
static void take_bodies(scene_result *r, const scene_outcome *o)
{
    const double halves = o->mirrored ? 2.0 : 1.0;
    const mpm_report *m = o->report;
    r->peak_force[0] = halves * m->peak_contact_force[0];
    r->peak_force[1] = halves * m->peak_contact_force[1];
    r->peak_force[2] = o->mirrored ? 0.0 : m->peak_contact_force[2];
    r->eroded_mass = halves * m->eroded_mass;
    r->bodies = o->scene->bodies;
    for (int b = 0; b < r->bodies; b++) {
        memcpy(r->body[b], o->scene->body[b].name, sizeof r->body[b]);
        r->failed_volume[b] = halves * m->failed_volume[b];
    }
    const int armature = body_named(o->scene, "armature"), rail = body_named(o->scene, "rail");
    r->peak_mises_armature = of_body(m->peak_mises, armature);
    r->peak_mises_rail = of_body(m->peak_mises, rail);
    r->peak_mises_armature_999 = of_body(m->peak_mises_999, armature);
    r->peak_mises_rail_999 = of_body(m->peak_mises_999, rail);
    r->peak_pressure_armature_999 = of_body(m->peak_pressure_999, armature);
    r->peak_pressure_rail_999 = of_body(m->peak_pressure_999, rail);
}

/* A groove that died between the two gauges: up to its end. */
static double growth_of(const mpm_report *m)
{
    const bool whole = m->gauge_at[1] > 0.0;
    const double from = m->gauge_at[0], to = whole ? m->gauge_at[1] : m->time;
    const double power = fmax(whole ? m->gauge_power[1] : m->plastic_power, 1e-3 * m->gauge_power[0]);
    if (!(from > 0.0 && to > from && m->gauge_power[0] > 0.0)) return NAN;
    return log(power / m->gauge_power[0]) / (to - from);
}

scene_result scene_result_of(const scene_outcome *o)
{
    const mpm_report *m = o->report;
    scene_result r;
    memset(&r, 0, sizeof r);
    take_crater(&r, o->crater);
    take_bodies(&r, o);
    r.groove_growth = growth_of(m);
    r.peak_pressure = m->peak_pressure;
    r.peak_temperature = m->peak_temperature;
    r.momentum_error = o->ledger->momentum_error;
    r.energy_error = o->ledger->energy_error;
    r.end_time = m->time;
    r.particles = m->particles;
    r.steps = m->steps;
    r.particle_steps = m->particle_steps;
    r.particle_steps_dense = m->particle_steps_dense;
    r.clamps_pressure = m->clamps_pressure;
    r.clamps_compression = m->clamps_compression;
    r.wall_seconds = o->wall_seconds;
    r.threads = o->threads;
    return r;
}
