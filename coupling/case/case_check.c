/* SPDX-License-Identifier: BSD-3-Clause */
/* What no single value of a case can say. */
#include "coupling/case/case_reader.h"
#include "coupling/case/material_role.h"
#include "mpm/mpm.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* ---- resolving ---- */

static void resolve_text(char *own, const char *shared)
{
    if (own[0] == '\0') memcpy(own, shared, BASE_PARAM_TEXT_SIZE);
}

static bool is_given(const tree_node *map, const char *key)
{
    return host_tree_find(map, key) != NULL;
}

/* Given, and not as `none`. */
static bool has_value(const tree_node *map, const char *key)
{
    const tree_node *node = host_tree_find(map, key);
    return node && !(node->kind == TREE_TEXT && strcmp(node->text, "none") == 0);
}

static void resolve_site(case_site *site, const case_particle *shared, const tree_node *node)
{
    const bool own_radius = !isnan(site->radius);
    if (!own_radius) site->radius = shared->radius;
    if (isnan(site->height)) site->height = own_radius ? site->radius : shared->height;
    resolve_text(site->shape, shared->shape);
    resolve_text(site->material, shared->material);
    if (!is_given(node, "bond_strength")) site->bond_strength = shared->bond_strength;
}

/* ---- what follows from other keys ---- */

static const base_param *row_of(const base_param *table, const char *key)
{
    while (table->key && strcmp(table->key, key) != 0) table++;
    return table->key ? table : NULL;
}

/* `value` for a key that was not given, if there is a value and the key's range holds it. */
static void follow(const tree_node *map, const base_param *table, void *object, const char *key, double value)
{
    const base_param *p = row_of(table, key);
    if (!is_given(map, key) && value >= p->min && value <= p->max) *(double *)((char *)object + p->offset) = value;
}

/* A key of the circuit and the constant of the metal that it is. */
typedef struct {
    const char *key, *constant;
} metal_key;

static const metal_key rail_keys[] = {
    { "resistivity", "resistivity" },
    { "resistivity_coefficient", "resistivity_slope" },
    { "density", "density" },
    { "specific_heat", "specific_heat" },
    { "youngs_modulus", "youngs_modulus" },
    { "thermal_conductivity", "conductivity" },
    { NULL, NULL },
};

static const metal_key armature_keys[] = {
    { "resistivity", "resistivity" },
    { "resistivity_coefficient", "resistivity_slope" },
    { "density", "density" },
    { "specific_heat", "specific_heat" },
    { "thermal_conductivity", "conductivity" },
    { "melting_temperature", "melting_temperature" },
    { "latent_heat", "latent_heat" },
    { NULL, NULL },
};

/* m NULL: no metal is named. */
static void follow_metal(const tree_node *map, const base_param *table, void *object, const metal_key *keys,
                         const mpm_material *m)
{
    for (; m && keys->key; keys++)
        follow(map, table, object, keys->key,
               *(const double *)((const char *)m + row_of(mpm_material_params, keys->constant)->offset));
}

/* Density times specific heat; with pure copper's constants, those of the table, the table's round number. */
static void follow_heat_capacity(const tree_node *map, circuit_shot_rails *r)
{
    const base_param *table = circuit_shot_rails_params;
    circuit_shot_rails copper;
    base_params_default(table, &copper);
    if (r->density != copper.density || r->specific_heat != copper.specific_heat)
        follow(map, table, r, "heat_capacity", r->density * r->specific_heat);
}

bool case_has_body(const breech_case *c)
{
    return c->given.projectile && !isnan(c->projectile.length);
}

/* Lengths of the scene's bodies that the circuit's section gives, then those of the circuit that the bodies give. */
static void follow_lengths(breech_case *c, const tree_node *armature)
{
    case_projectile *p = &c->projectile;
    if (!is_given(armature, "half_bore") && isnan(p->half_bore)) p->half_bore = 0.5 * c->rails.separation;
    if (!is_given(armature, "width") && isnan(p->width)) p->width = c->rails.height;
    if (!case_has_body(c)) return;
    const base_param *table = circuit_shot_armature_params;
    const bool wears = c->armature.wear_fraction > 0.0 || c->armature.friction_law == CIRCUIT_SHOT_FRICTION_FILM;
    follow(armature, table, &c->armature, "contact_length", p->length - p->chamfer_height / tan(p->lead_angle));
    follow(armature, table, &c->armature, "contact_width", p->width);
    follow(armature, table, &c->armature, "wear_thickness", wears ? p->leg_thickness : NAN);
}

/* A rail or an armature that is warm for the scene is so for the circuit. */
static void follow_temperature(const tree_node *map, const base_param *table, void *object, double temperature)
{
    if (is_given(map, "temperature")) follow(map, table, object, "initial_temperature", temperature);
}

void case_resolve(breech_case *c, const tree_node *root)
{
    const tree_node *sites = host_tree_find(root, "sites"), *rail = host_tree_find(root, "rail");
    const tree_node *armature = host_tree_find(root, "armature");
    follow_lengths(c, armature);
    follow_metal(rail, circuit_shot_rails_params, &c->rails, rail_keys, case_material(&c->materials, c->rail.material));
    follow_heat_capacity(rail, &c->rails);
    follow_metal(armature, circuit_shot_armature_params, &c->armature, armature_keys,
                 case_material(&c->materials, c->projectile.material));
    follow_temperature(rail, circuit_shot_rails_params, &c->rails, c->rail.temperature);
    follow_temperature(armature, circuit_shot_armature_params, &c->armature, c->projectile.temperature);
    resolve_text(c->particle.material, c->rail.material);
    if (isnan(c->particle.height)) c->particle.height = c->particle.radius;
    for (int k = 0; k < c->sites.n; k++) resolve_site(&c->sites.item[k], &c->particle, case_entry_node(sites, k));
}

/* ---- sections and keys that the command needs ---- */

typedef struct {
    unsigned need;
    const char *command;
} command_name;

static const command_name commands[] = {
    { CASE_FOR_COMPARE, "breech compare" }, { CASE_FOR_ONSET, "breech onset" },
    { CASE_FOR_STRIKE, "breech strike" },   { CASE_FOR_SHOT, "breech shot" },
    { CASE_FOR_SCENE, "breech scene" },     { CASE_FOR_INDUCTANCE, "breech inductance" },
    { CASE_FOR_SWEEP, "breech sweep" },     { CASE_FOR_LIFE, "breech life" },
    { CASE_FOR_VESSEL, "breech vessel" },   { CASE_FOR_TARGETS, "breech compare" },
};

static const char *command_of(unsigned needs)
{
    for (size_t k = 0; k < sizeof commands / sizeof commands[0]; k++)
        if (commands[k].need & needs) return commands[k].command;
    return "this command";
}

static void check_sections(case_reader *r)
{
    const unsigned needs = r->options->needs;
    for (const case_section *s = case_root.children; s->key; s++) {
        const tree_node *node = host_tree_find(r->root, s->key);
        const bool empty_list =
            s->list && node && ((node->kind == TREE_LIST && node->n == 0) || host_tree_is_empty(node));
        const unsigned needed_for = (s->needed_for | (s->also ? s->also->needed_for : 0u)) & needs;
        if (!needed_for || (node && !empty_list)) continue;
        case_errors_add(r->errors, node ? node : r->root, "section `%s` is %s: `%s` needs it", s->key,
                        node ? "empty" : "missing", command_of(needed_for));
    }
    if ((needs & CASE_FOR_ONSET) && r->out->sites.n == 0 && r->out->populations.n == 0)
        case_errors_add(r->errors, r->root, "section `sites` is missing: `%s` needs it, or `populations`",
                        command_of(needs));
}

/* Something must drive a shot. */
static void check_supplies(case_reader *r)
{
    const unsigned needs = r->options->needs & (CASE_FOR_SHOT | CASE_FOR_ONSET);
    bool given = !needs;
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++) given = given || r->out->supplies[k].n > 0;
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS && !given; k++)
        if (host_tree_find(r->root, circuit_supply_sections[k])) given = r->errors->n > 0; /* its own errors say it */
    if (!given)
        case_errors_add(r->errors, r->root, "section `%s` is missing: `%s` needs it, or another supply",
                        circuit_supply_sections[0], command_of(needs));
}

static void need_key(case_reader *r, const char *section, const char *key, const char *unit)
{
    const tree_node *map = host_tree_find(r->root, section);
    const tree_node *node = host_tree_find(map, key);
    if (map && map->kind == TREE_MAP && !has_value(map, key))
        case_errors_add(r->errors, node ? node : map, "%s.%s is missing [%s]: `breech scene` needs it", section, key,
                        unit);
}

/* ---- lengths that must fit ---- */

/* An error at section.key unless ok; the section alone where the key is a default. */
static void must(case_reader *r, bool ok, const char *section, const char *key, const char *text)
{
    if (ok) return;
    const tree_node *map = host_tree_find(r->root, section);
    const tree_node *node = host_tree_find(map, key);
    case_errors_add(r->errors, node ? node : map, "%s.%s%s" CASE_ECHO ": %s", section, key,
                    node && node->text ? " = " : "", CASE_ECHO_OF(node && node->text ? node->text : ""), text);
}

/* A length of the armature's body that was neither given nor follows from the rail's key `from`. */
static void need_length(case_reader *r, double value, const char *key, const char *from)
{
    const tree_node *map = host_tree_find(r->root, "armature"), *node = host_tree_find(map, key);
    const bool wrong = has_value(map, key) || has_value(host_tree_find(r->root, "rail"), from); /* an error already */
    if (!case_has_body(r->out) || !isnan(value) || wrong) return;
    case_errors_add(r->errors, node ? node : map, "armature.%s is missing [m]: give it, or rail.%s", key, from);
}

/* Comparisons are written so that a NAN, not given or already an error, passes. */
static void check_lengths(case_reader *r)
{
    const breech_case *c = r->out;
    const case_projectile *p = &c->projectile;
    need_length(r, p->half_bore, "half_bore", "separation");
    need_length(r, p->width, "width", "height");
    must(r, !(p->leg_thickness > p->half_bore), "armature", "leg_thickness", "must not exceed half_bore");
    must(r, !(p->head_thickness > p->length), "armature", "head_thickness", "must not exceed length");
    must(r, !(p->chamfer_height > p->half_bore), "armature", "chamfer_height", "must not exceed half_bore");
    must(r, !(p->chamfer_height > p->length * tan(p->lead_angle)), "armature", "chamfer_height",
         "the lead face would be longer than the armature (chamfer_height / tan(lead_angle) > length)");
    must(r, !(c->study.velocity_low >= c->study.velocity_high), "study", "velocity_low",
         "must lie below velocity_high");
    must(r, isnan(c->study.deposit_kept) || !c->given.armature || c->armature.wear_fraction > 0.0, "study",
         "deposit_kept", "the armature leaves no metal: give armature.wear_fraction, above 0");
    must(r, c->study.ensemble != 1, "study", "ensemble", "one grid has no scatter: two at least, or 0");
    must(r, c->study.threshold_ensemble != 1, "study", "threshold_ensemble",
         "one grid has no scatter: two at least, or 0");
    must(r, !(c->study.coarse_cells_per_radius > c->study.fine_cells_per_radius), "study", "coarse_cells_per_radius",
         "must not exceed fine_cells_per_radius");
    must(r, !(c->particle.radius / c->scene.cells_per_radius > c->scene.coarse_cell), "scene", "coarse_cell",
         "must not be smaller than the fine cell, particle.radius / cells_per_radius");
    must(r, !(c->particle.height > p->half_bore), "particle", "height", "must not exceed armature.half_bore");
    must(r, !(c->barrel.start >= c->barrel.length), "barrel", "start", "must lie before the barrel's length");
    const bool flies = c->given.armature && c->given.barrel;
    must(r, !(flies && c->armature.contact_length >= c->barrel.length), "armature", "contact_length",
         "must be shorter than the barrel");
    const bool searches = (r->options->needs & CASE_FOR_ONSET) && c->given.barrel;
    must(r, !(searches && c->study.velocity_high <= c->armature.velocity), "armature", "velocity",
         "the search would end below it: raise study.velocity_high");
}

/* Of scenes that a study makes; of one with bodies the solver's own check says it (case_refused.c). */
static void check_courant(case_reader *r)
{
    const case_scene *s = &r->out->scene;
    const double most = mpm_courant_limit(s->transfer);
    char text[100];
    snprintf(text, sizeof text, "must be in (0, %g], beyond which %s is not stable", most,
             mpm_transfer_names[s->transfer]);
    must(r, r->out->given.bodies || !(s->courant > most), "scene", "courant", text);
}

static void check_site(case_reader *r, const case_site *site, const tree_node *node, int k)
{
    const tree_node *position = host_tree_find(node, "position");
    const char *text = position && position->text ? position->text : "";
    if (r->out->given.barrel && (site->position <= r->out->barrel.start || site->position > r->out->barrel.length))
        case_errors_add(r->errors, position,
                        "sites[%d].position = " CASE_ECHO
                        ": must lie beyond barrel.start = %g m, at barrel.length = %g m at most",
                        k, CASE_ECHO_OF(text), r->out->barrel.start, r->out->barrel.length);
    if (node && node->kind == TREE_MAP && !has_value(node, "radius") &&
        !has_value(host_tree_find(r->root, "particle"), "radius"))
        case_errors_add(r->errors, node,
                        "sites[%d].radius is missing [m]: give it here, or once for all as particle.radius", k);
    if (site->height > r->out->projectile.half_bore)
        case_errors_add(r->errors, node, "sites[%d].height = %g m: must not exceed armature.half_bore", k,
                        site->height);
}

/* ---- materials ---- */

static unsigned material_needs(const case_reader *r, const material_use *use)
{
    const unsigned needs = r->options->needs;
    static const char *const meeting[] = { "rail.material", "armature.material", ".rail_metal.", ".armature_metal." };
    const bool lasts = (needs & CASE_FOR_LIFE) && strcmp(use->key, "life.material") == 0;
    const bool shell = (needs & CASE_FOR_VESSEL) && strcmp(use->key, "vessel.film_material") == 0;
    const bool filling = (needs & CASE_FOR_VESSEL) && strcmp(use->key, "vessel.liquid_material") == 0;
    const unsigned wanted = (lasts ? MPM_MATERIAL_FOR_FATIGUE : 0) |
                            (shell ? MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_DAMAGE : 0) |
                            (filling ? MPM_MATERIAL_FOR_SCENE : 0);
    bool meets = false;
    const bool in_scenes = strcmp(use->key, "life.material") != 0; /* what lasts is asked for its life alone */
    if (!(needs & (CASE_FOR_SCENE | CASE_FOR_ONSET)) || !in_scenes) return wanted;
    for (size_t k = 0; k < sizeof meeting / sizeof meeting[0]; k++)
        meets = meets || ((needs & CASE_FOR_ONSET) && strstr(use->key, meeting[k]));
    return wanted | case_material_needs(r->out->scene.damage, meets);
}

/* A gas has nothing that a rail or an armature could be pressed on: it flies apart, and its cells with it. */
static void check_no_gas(case_reader *r, const material_use *use, const mpm_material *m)
{
    static const char *const solids[] = { "rail.material", "armature.material", "particle.material" };
    for (size_t k = 0; k < sizeof solids / sizeof solids[0]; k++)
        if (strcmp(use->key, solids[k]) == 0 && mpm_material_is_gas(m))
            case_errors_add(r->errors, use->where,
                            "%s = %s: a gas: rail, armature and grain must be solid or liquid; put a gas into "
                            "scene.bodies or scene.cavities",
                            use->key, use->name);
}

static void check_materials(case_reader *r)
{
    for (int k = 0; k < r->n_use; k++) {
        const material_use *use = &r->use[k];
        const mpm_material *m = case_material(&r->out->materials, use->name);
        const unsigned needs = material_needs(r, use);
        if (!m || needs == 0) continue; /* one that could not be loaded is an error already */
        check_no_gas(r, use, m);
        const status s = mpm_material_check(m, needs);
        const bool damage =
            r->out->scene.damage && mpm_material_check(m, needs & ~(unsigned)MPM_MATERIAL_FOR_DAMAGE).code == STATUS_OK;
        if (s.code != STATUS_OK)
            case_errors_add(r->errors, use->where, "%s = %s: %.400s%s", use->key, use->name, s.text,
                            damage ? " (or set scene.damage: no)" : "");
    }
}

/* A temperature that is given must leave the metal solid, where it is known when that melts. */
static void check_solid(case_reader *r, const char *section, const char *key, double temperature, const char *name)
{
    const mpm_material *m = case_material(&r->out->materials, name);
    char text[200];
    if (!m || !(m->melting_temperature > 0.0) || !is_given(host_tree_find(r->root, section), key)) return;
    snprintf(text, sizeof text, "%.60s melts at %g K", name, m->melting_temperature);
    must(r, !(temperature >= m->melting_temperature), section, key, text);
}

static void check_temperatures(case_reader *r)
{
    const breech_case *c = r->out;
    check_solid(r, "rail", "temperature", c->rail.temperature, c->rail.material);
    check_solid(r, "rail", "initial_temperature", c->rails.initial_temperature, c->rail.material);
    check_solid(r, "armature", "temperature", c->projectile.temperature, c->projectile.material);
    check_solid(r, "armature", "initial_temperature", c->armature.initial_temperature, c->projectile.material);
}

static void check_treatments(case_reader *r)
{
    const tree_node *list = host_tree_find(r->root, "treatments");
    const case_treatments *all = &r->out->treatments;
    for (int k = 0; k < all->n; k++) {
        const char *name = all->item[k].name;
        const tree_node *entry = case_entry_node(list, k), *where = host_tree_find(entry, "name");
        if (strcmp(name, "untreated") == 0)
            case_errors_add(r->errors, where ? where : entry,
                            "treatments[%d].name = %s: the rail as it is has this name", k, name);
        for (int i = 0; i < k; i++)
            if (name[0] && strcmp(name, all->item[i].name) == 0)
                case_errors_add(r->errors, where ? where : entry,
                                "treatments[%d].name = %s: the same as treatments[%d]", k, name, i);
    }
}

/* ---- shapes ---- */

/* A grain's shape stands about its middle and is known by its radius. */
static bool is_grain(const mpm_solid_kind *kind)
{
    const mpm_solid s = mpm_solid_make(kind);
    return mpm_solid_get(&s, "center") && mpm_solid_get(&s, "radius");
}

static const char *grain_name(const void *user, int i)
{
    (void)user;
    for (int k = 0; mpm_solid_kind_at(k); k++)
        if (is_grain(mpm_solid_kind_at(k)) && i-- == 0) return mpm_solid_kind_at(k)->name;
    return NULL;
}

static void check_shape(case_reader *r, const tree_node *map, const char *shape, const char *path)
{
    const tree_node *node = host_tree_find(map, "shape");
    const mpm_solid_kind *kind = mpm_solid_kind_find(shape);
    if (!node || shape[0] == '\0' || (kind && is_grain(kind))) return;
    const char *near = host_nearest_name(shape, grain_name, NULL);
    char known[200] = "";
    for (int k = 0; grain_name(NULL, k); k++) {
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", k > 0 ? ", " : "", grain_name(NULL, k));
    }
    case_errors_add(r->errors, node, "%s.shape = %s: must be one of %s%s%s%s", path, shape, known,
                    near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "");
}

bool case_name_has_word(const char *name)
{
    while (*name && !isalnum((unsigned char)*name)) name++;
    return *name != '\0';
}

/* Its output goes to out/<name>. */
static void check_name(case_reader *r)
{
    const tree_node *node = host_tree_find(r->root, "name");
    if (r->out->name[0] && !case_name_has_word(r->out->name))
        case_errors_add(r->errors, node, "name = %.*s: must have a letter or a digit", CASE_SHOWN, r->out->name);
}

/* Measured gradients, or a frequency, beside a level that computes its own: a reader would take them for used. */
static void check_level(case_reader *r)
{
    static const struct {
        const char *key;
        circuit_shot_rail_level level;
    } of[] = { { "inductance_gradient", CIRCUIT_SHOT_RAILS_CONSTANT },
               { "resistance_gradient", CIRCUIT_SHOT_RAILS_CONSTANT },
               { "frequency", CIRCUIT_SHOT_RAILS_SKIN } };
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        const tree_node *map = host_tree_find(r->root, "rail");
        char text[200];
        if (!r->out->given.rails || !has_value(map, of[k].key) || r->out->rails.level == (int)of[k].level) continue;
        snprintf(text, sizeof text, "rail.%s has no effect with rail.level = %s: it is of level %s", of[k].key,
                 circuit_shot_rail_level_names[r->out->rails.level], circuit_shot_rail_level_names[of[k].level]);
        case_warn_at(r, host_tree_find(map, of[k].key), text);
    }
}

void case_check_whole(case_reader *r)
{
    const tree_node *sites = host_tree_find(r->root, "sites");
    check_name(r);
    check_sections(r);
    check_supplies(r);
    if (r->options->needs & CASE_FOR_SCENE) {
        need_key(r, "scene", "velocity", "m/s");
        need_key(r, "particle", "radius", "m");
    }
    check_lengths(r);
    check_level(r);
    check_courant(r);
    check_shape(r, host_tree_find(r->root, "particle"), r->out->particle.shape, "particle");
    for (int k = 0; k < r->out->sites.n; k++) {
        char path[32];
        snprintf(path, sizeof path, "sites[%d]", k);
        check_site(r, &r->out->sites.item[k], case_entry_node(sites, k), k);
        check_shape(r, case_entry_node(sites, k), r->out->sites.item[k].shape, path);
    }
    const tree_node *populations = host_tree_find(r->root, "populations");
    for (int k = 0; k < r->out->populations.n; k++) {
        char path[32];
        snprintf(path, sizeof path, "populations[%d]", k);
        check_shape(r, case_entry_node(populations, k), r->out->populations.item[k].shape, path);
    }
    case_populations_check(r);
    case_strike_check(r);
    case_life_check(r);
    check_materials(r);
    check_temperatures(r);
    check_treatments(r);
}
