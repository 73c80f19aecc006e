/* SPDX-License-Identifier: BSD-3-Clause */
/* Populations of grains: what presets say, and what no single value can say. */
#include "coupling/case/case_reader.h"

#include <math.h>
#include <string.h>

typedef struct {
    double density, radius_median, radius_spread, aspect;
    const char *shape, *material;
    double bond_strength;
    bool renewed;
} preset;

static const preset presets[POPULATION_PRESETS] = {
    [POPULATION_NONE] = { NAN, NAN, NAN, 1.0, "", "rail", NAN, true },
#define POPULATION(name, density, median, spread, aspect, shape, material, bond, renewed, assumed) \
    [POPULATION_##name] = { density, median, spread, aspect, shape, material, bond, renewed },
#include "coupling/case/population.def"
#undef POPULATION
};

static void fill(double *value, double with)
{
    if (isnan(*value)) *value = with;
}

/* `rail` and `armature` stand for the case's metals. */
static const char *metal(const breech_case *c, const char *name)
{
    if (strcmp(name, "rail") == 0) return c->rail.material;
    if (strcmp(name, "armature") == 0) return c->projectile.material;
    return name;
}

static void resolve(case_reader *r, case_population *p, const tree_node *node, const char *path)
{
    const breech_case *c = r->out;
    const preset *from = &presets[p->preset];
    fill(&p->density, from->density);
    if (p->sizes.n == 0) {
        fill(&p->radius_median, from->radius_median);
        fill(&p->radius_spread, from->radius_spread);
    }
    fill(&p->aspect, from->aspect);
    fill(&p->from, c->barrel.start);
    fill(&p->to, c->barrel.length);
    if (!p->shape[0]) snprintf(p->shape, sizeof p->shape, "%s", from->shape[0] ? from->shape : c->particle.shape);
    if (!host_tree_find(node, "bond_strength")) p->bond_strength = from->bond_strength;
    if (!host_tree_find(node, "renewed")) p->renewed = from->renewed;
    if (p->material[0]) return;
    snprintf(p->material, sizeof p->material, "%s", metal(c, from->material));
    if (p->material[0]) case_note_material(r, p->material, node, path);
}

void case_populations_resolve(case_reader *r)
{
    const tree_node *list = host_tree_find(r->root, "populations");
    for (int k = 0; k < r->out->populations.n; k++) {
        char path[CASE_KEY_SIZE];
        snprintf(path, sizeof path, "populations[%d].material", k);
        resolve(r, &r->out->populations.item[k], case_entry_node(list, k), path);
    }
}

/* ---- checks ---- */

/* A key, or a preset, that is given but could not be read is an error already. */
static void need(case_reader *r, bool there, const tree_node *node, int k, const char *key, const char *unit)
{
    const bool unread = host_tree_find(node, "preset") && r->out->populations.item[k].preset == POPULATION_NONE;
    if (there || host_tree_find(node, key) || unread) return;
    case_errors_add(r->errors, node, "populations[%d].%s is missing%s: give it, or a preset", k, key, unit);
}

static void check_sizes(case_reader *r, const case_population *p, const tree_node *node, int k)
{
    double sum = 0.0;
    if (p->sizes.n > 0 && (!isnan(p->radius_median) || !isnan(p->radius_spread)))
        case_errors_add(r->errors, node, "populations[%d]: either radius_median and radius_spread, or sizes", k);
    for (int i = 0; i < p->sizes.n; i++) {
        sum += p->sizes.item[i].share;
        if (i > 0 && !(p->sizes.item[i].radius > p->sizes.item[i - 1].radius))
            case_errors_add(r->errors, node, "populations[%d].sizes[%d].radius = %g m: sizes must rise", k, i,
                            p->sizes.item[i].radius);
    }
    if (p->sizes.n > 0 && !(sum > 0.0)) case_errors_add(r->errors, node, "populations[%d].sizes: all shares are 0", k);
}

void case_populations_check(case_reader *r)
{
    const tree_node *list = host_tree_find(r->root, "populations");
    const breech_case *c = r->out;
    for (int k = 0; k < c->populations.n; k++) {
        const case_population *p = &c->populations.item[k];
        const tree_node *node = case_entry_node(list, k);
        need(r, !isnan(p->density), node, k, "density", " [1/m]");
        need(r, p->sizes.n > 0 || !isnan(p->radius_median), node, k, "radius_median", " [m]");
        need(r, p->sizes.n > 0 || !isnan(p->radius_spread), node, k, "radius_spread", "");
        check_sizes(r, p, node, k);
        if (p->to <= p->from)
            case_errors_add(r->errors, node, "populations[%d].from = %g m: must lie before `to` = %g m", k, p->from,
                            p->to);
        if (c->given.barrel && (p->from < c->barrel.start || p->to > c->barrel.length))
            case_errors_add(r->errors, node,
                            "populations[%d]: %g .. %g m must lie between barrel.start = %g m and barrel.length = %g m",
                            k, p->from, p->to, c->barrel.start, c->barrel.length);
    }
}
