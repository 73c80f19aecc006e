/* SPDX-License-Identifier: BSD-3-Clause */
/* `strike:`, a projectile's arrival at the other bodies of the scene: what no single value can say. */
#include "coupling/case/case_bodies.h"

#include <math.h>
#include <string.h>

static bool says(const tree_node *node, const char *text)
{
    return node && node->kind == TREE_TEXT && strcmp(node->text, text) == 0;
}

/* Is its speed the shot's, or a charge wanted for it?  Then the command needs the shot's sections too. */
static bool wants_shot(const tree_node *root)
{
    const tree_node *speed = host_tree_find(host_tree_find(root, "strike"), "velocity");
    const bool charge = says(host_tree_find(host_tree_find(root, "optimise"), "goal"), "velocity");
    if (speed && !says(speed, "none") && !charge) return false;
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++)
        if (host_tree_find(root, circuit_supply_sections[k])) return true;
    return false;
}

/* `breech compare` of a case with targets and no treatments compares those. */
static unsigned needs_of_targets(const tree_node *root, unsigned needs)
{
    const bool targets = host_tree_find(root, "targets") && !host_tree_find(root, "treatments");
    if (!targets || !(needs & CASE_FOR_COMPARE)) return needs;
    return (needs & ~(unsigned)(CASE_FOR_COMPARE | CASE_FOR_ONSET)) | CASE_FOR_STRIKE | CASE_FOR_TARGETS;
}

unsigned case_strike_needs(const tree_node *root, unsigned needs)
{
    needs = needs_of_targets(root, needs);
    return (needs & CASE_FOR_STRIKE) && wants_shot(root) ? needs | CASE_FOR_SHOT : needs;
}

/* The body that a key names, -1 after an error. */
static int named_body(case_reader *r, const tree_node *map, const char *key, const char *name)
{
    const mpm_scene *s = &r->out->bodies.scene;
    for (int i = 0; i < s->bodies; i++)
        if (strcmp(s->body[i].name, name) == 0) return i;
    case_unknown_name(r, host_tree_find(map, key), "body", "strike", case_body_name, s);
    return -1;
}

static void need_for_flight(case_reader *r, const tree_node *map, const char *key, double value)
{
    if (isnan(value))
        case_errors_add(r->errors, host_tree_find(map, "distance"),
                        "strike.%s is missing: a flight of %g m with drag needs it (or set distance: 0 m)", key,
                        r->out->strike.distance);
}

void case_strike_check(case_reader *r)
{
    const case_strike *k = &r->out->strike;
    const mpm_scene *s = &r->out->bodies.scene;
    const tree_node *map = host_tree_find(r->root, "strike");
    if (!r->out->given.strike || !map || map->kind != TREE_MAP) return;
    if (!r->out->given.bodies) {
        if (r->options->needs & CASE_FOR_STRIKE)
            case_errors_add(r->errors, map,
                            "scene.bodies is missing: `breech strike` needs the projectile and its target");
        return;
    }
    if (!k->projectile[0] || s->bodies == 0) return; /* an error already */
    const int projectile = named_body(r, map, "projectile", k->projectile);
    const int plate = k->plate[0] ? named_body(r, map, "plate", k->plate) : -1;
    if (projectile < 0) return;
    const int group = s->body[projectile].group;
    bool target = false;
    for (int i = 0; i < s->bodies; i++) target = target || s->body[i].group != group;
    if (!target)
        case_errors_add(r->errors, map, "strike: all bodies of the scene are welded to `%s`: there is no target",
                        k->projectile);
    if (plate >= 0 && s->body[plate].group == group)
        case_errors_add(r->errors, host_tree_find(map, "plate"), "strike.plate = %s: that is the projectile", k->plate);
    if (k->distance > 0.0) {
        need_for_flight(r, map, "drag_coefficient", k->drag_coefficient);
        need_for_flight(r, map, "drag_area", k->drag_area);
    }
}
