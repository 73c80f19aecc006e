/* SPDX-License-Identifier: BSD-3-Clause */
/* `life:`, a load that comes again and again: what no single value can say. */
#include "base/constants.h"
#include "coupling/case/case_place.h"
#include "coupling/case/case_plain.h"
#include "coupling/case/case_reader.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static void add(case_reader *r, const tree_node *where, const char *text)
{
    case_errors_add(r->errors, where, "life: %s", text);
}

/* Of a key without a value: it is there, and not as `none`, so its own error says what is wrong. */
static bool is_wrong(const tree_node *node)
{
    return node && !(node->kind == TREE_TEXT && strcmp(node->text, "none") == 0);
}

static void check_points(case_reader *r, const tree_node *map)
{
    const case_life_points *p = &r->out->life.points;
    const tree_node *list = host_tree_find(map, "points");
    if (r->out->life.profile != LIFE_POINTS) {
        if (list) add(r, list, "points are read with profile: points alone");
        return;
    }
    if (p->n < 2) add(r, list ? list : map, "profile: points needs the list `points`, of two at least");
    for (int k = 1; k < p->n; k++)
        if (!(p->item[k].at > p->item[k - 1].at))
            case_errors_add(r->errors, case_entry_node(list, k),
                            "life.points[%d].at = %g: must lie beyond the point before, at %g", k, p->item[k].at,
                            p->item[k - 1].at);
}

/* A traction that jumps makes the strain infinite at the jump. */
static void check_jumps(case_reader *r, const tree_node *map)
{
    const case_life *k = &r->out->life;
    const double mu = k->state == LIFE_FRICTIONLESS ? 0.0 : k->friction;
    bool jumps = k->profile == LIFE_UNIFORM && mu > 0.0;
    for (int i = 0; k->profile == LIFE_POINTS && i<k->points.n; i += k->points.n> 1 ? k->points.n - 1 : 1) {
        const case_life_point *p = &k->points.item[i];
        jumps = jumps || (isnan(p->traction) ? mu * p->pressure : p->traction) != 0.0;
    }
    if (jumps)
        add(r, host_tree_find(map, "profile"),
            "a traction that jumps at the patch's end makes the strain there infinite: let it fall to zero over "
            "some length (profile: points), or take state: frictionless");
}

static bool has_entries(const tree_node *root, const char *list)
{
    const tree_node *node = host_tree_find(root, list);
    return node && !host_tree_is_empty(node) && !(node->kind == TREE_LIST && node->n == 0);
}

unsigned case_life_needs(const tree_node *root, unsigned needs)
{
    const tree_node *load = host_tree_find(host_tree_find(root, "life"), "load");
    const bool armature = load && load->kind == TREE_TEXT && strcmp(load->text, "armature") == 0;
    if (!armature || !(needs & (CASE_FOR_LIFE | CASE_FOR_COMPARE))) return needs;
    if ((needs & CASE_FOR_COMPARE) && !has_entries(root, "sites") && !has_entries(root, "populations"))
        needs &= ~(unsigned)CASE_FOR_ONSET; /* ranked by life alone */
    return needs | CASE_FOR_LIFE | CASE_FOR_SHOT;
}

/* An armature's load is the shot's. */
static void check_armature(case_reader *r, const tree_node *map)
{
    for (int k = 0; k < map->n; k++)
        if (!case_life_has(&r->out->life, map->key[k]->text))
            case_errors_add(r->errors, map->item[k],
                            "life.%s is that of load: wheel; of load: armature the shot says what it is",
                            map->key[k]->text);
}

/* A key of friction that this state of the contact does not read has its value of no effect, in used.yaml too; another
 * one that the case gives is a warning. */
static void settle(case_reader *r, const char *key, double *value, double idle)
{
    const tree_node *node = host_tree_find(host_tree_find(r->root, "life"), key);
    const char *state = r->out->life.state == LIFE_FRICTIONLESS ? "frictionless" : "full_slip";
    char text[200];
    snprintf(text, sizeof text, "life.%s = %g has no effect with life.state = %s", key, *value, state);
    if (node && *value != idle) case_warn_at(r, node, text);
    *value = idle;
}

/* ---- more than a metal carries ---- */

double case_life_carried(const mpm_material *m, const char **by)
{
    static const double TABOR = 3.0, TABOR_STRAIN = 0.08, HARDEST = 0.04; /* [1] */
    const double flow = m->yield_A + m->hardening_B * pow(TABOR_STRAIN, m->hardening_n);
    *by = "its hardness";
    if (m->hardness > 0.0) return m->hardness;
    *by = "three times its flow stress at 8 %";
    if (m->strength == MPM_STRENGTH_johnson_cook && flow > 0.0) return TABOR * flow;
    *by = "0.04 of its Young's modulus, as the hardest metals";
    return HARDEST * m->youngs_modulus;
}

double case_life_peak(const case_life *c)
{
    return isnan(c->pressure) ? 3.0 * c->wheel_load / (2.0 * PI * c->half_length * c->half_width) : c->pressure;
}

/* A slip of a unit gives a life too, of a fraction of a cycle. */
static void warn_of_pressure(case_reader *r, const tree_node *map)
{
    const case_life *k = &r->out->life;
    const mpm_material *m = case_material(&r->out->materials, k->material);
    const char *key = isnan(k->pressure) ? "wheel_load" : "pressure", *by;
    const tree_node *node = host_tree_find(map, key);
    char text[400];
    if (!m || !node) return;
    const double peak = case_life_peak(k), most = case_life_carried(m, &by);
    if (!(peak > most)) return; /* NAN: the metal lacks it, which is an error of its own */
    snprintf(text, sizeof text,
             "life.%s: %.3g GPa at the middle of the patch is more than %.60s carries, %.3g GPa (%s): its face would "
             "flow away, and the life has no meaning; is the unit right?",
             key, 1e-9 * peak, m->name, 1e-9 * most, by);
    case_warn_at(r, node, text);
}

void case_life_check(case_reader *r)
{
    case_life *k = &r->out->life;
    const tree_node *map = host_tree_find(r->root, "life");
    if (!r->out->given.life || !map || map->kind != TREE_MAP) return;
    if (k->load == LIFE_ARMATURE) {
        check_armature(r, map);
        return;
    }
    const tree_node *length = host_tree_find(map, "half_length");
    if (isnan(k->half_length) && !is_wrong(length))
        add(r, length ? length : map, "half_length is missing [m]: half of the patch, along the rail");
    const tree_node *pressure = host_tree_find(map, "pressure"), *wheel = host_tree_find(map, "wheel_load");
    if (isnan(k->pressure) && isnan(k->wheel_load) && !is_wrong(pressure) && !is_wrong(wheel))
        add(r, map, "how large is the load? Give wheel_load [N], or pressure [Pa]");
    if (!isnan(k->pressure) && !isnan(k->wheel_load)) add(r, pressure, "wheel_load and pressure exclude each other");
    if (!isnan(k->wheel_load) && isnan(k->half_width)) add(r, wheel, "wheel_load needs half_width [m] of the patch");
    if (!isnan(k->wheel_load) && k->profile != LIFE_HERTZ)
        add(r, wheel, "wheel_load is that of profile: hertz; give pressure for the others");
    if (k->state == LIFE_STICK_SLIP && k->profile != LIFE_HERTZ)
        add(r, host_tree_find(map, "state"), "stick_slip is Carter's solution for profile: hertz");
    if (k->speed > 0.0 && (k->cycle != LIFE_PASSAGE || k->until != LIFE_UNTIL_FIRST))
        add(r, host_tree_find(map, "speed"),
            "speed is that of cycle: passage, until: first; the grid of until: crack is at rest");
    check_points(r, map);
    check_jumps(r, map);
    warn_of_pressure(r, map);
    if (k->state == LIFE_FRICTIONLESS) settle(r, "friction", &k->friction, 0.0);
    if (k->state != LIFE_STICK_SLIP) settle(r, "traction_share", &k->traction_share, k->state == LIFE_FULL_SLIP);
}
