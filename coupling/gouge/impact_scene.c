/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/impact_scene.h"

#include "coupling/gouge/armature.h"
#include "coupling/gouge/growth.h"
#include "coupling/host/numbers.h"
#include "coupling/run/scene_result.h"
#include "mpm/grid/grid.h"
#include "mpm/law/contact.h"
#include "mpm/shape/solid.h"

#include <math.h>
#include <string.h>

/* Of the time in which the contact face crosses what is looked at, where the groove's growth is not. */
static const double END_FACTOR = 1.1;

/* Speed of a groove's front over the armature's, at most: a scene ends when the contact face has passed it. */
static const double FRONT_SPEED = 0.7;

/* The finest cells at the start, around the grain, in its radii; later the metal's flow asks for them. */
static const double START_BEHIND = 3.0, START_AHEAD = 3.0, START_DEPTH = 2.0, START_BESIDE = 1.5;
/* On one level: how far ahead of the grain's middle and beside it all cells are fine, in radii. */
static const double ZONE_AHEAD = 26.0, ZONE_BESIDE = 8.0;
static const double MAP_BESIDE = 24.0; /* half width of the crater's map in radii, at most */

/* Length across the rail of shapes that have one. */
#define RIDGE_LENGTH 4.0 /* half of it, in radii */

bool gouge_is_layer(const gouge_scene *s, int body)
{
    return body > s->rail && body <= s->rail + s->layers;
}

bool gouge_counts_as_rail(const gouge_scene *s, int body)
{
    return body == s->rail || gouge_is_layer(s, body);
}

/* No scene has a molten armature: a step below its melting point is the most [K]. */
static double solid_below(const case_impact *c, double temperature)
{
    const mpm_material *metal = case_material(&c->materials, c->armature.material);
    const double most = metal && metal->melting_temperature > 0.0 ? metal->melting_temperature : INFINITY;
    double T = host_number_or(temperature, CASE_ROOM_TEMPERATURE);
    while (T >= most) T -= GOUGE_TEMPERATURE_STEP;
    return T;
}

case_impact gouge_impact_at(const case_impact *from, const site_state *state, double cells_per_radius)
{
    const case_site *g = &state->grain;
    case_impact at = *from;
    at.particle = (case_particle){ .radius = g->radius, .height = g->height, .bond_strength = g->bond_strength };
    memcpy(at.particle.shape, g->shape, sizeof g->shape);
    memcpy(at.particle.material, g->material, sizeof g->material);
    at.scene.velocity = state->velocity;
    at.scene.contact_pressure = state->contact_pressure;
    at.scene.cells_per_radius = cells_per_radius;
    if (isnan(at.armature.temperature)) at.armature.temperature = solid_below(&at, state->lead_face_temperature);
    return at;
}

/* ---- lengths ---- */

/* Everything along x, y, z that more than one part of the scene needs [m]. */
typedef struct {
    int levels;
    double fine, coarse;                /* cell at the grain, largest cell */
    int halvings;                       /* of `fine` that make the smallest cell, which a layer asks for */
    double x_front;                     /* front end of the armature's contact face at the start */
    double run;                         /* length of the lead face along x */
    double zone_lo[3], zone_hi[3];      /* of the finest cells at the start */
    double behind, ahead;               /* ends of the window, both positive */
    double reach;                       /* downstream end of what is looked at */
    double passage;                     /* way of the armature until the scene is over, where the groove is followed */
    double rail_half_width, half_width; /* of the rail, of the window */
    double layers;                      /* thickness of all layers */
} layout;

/* A whole number of cells that covers `length`. */
static double cells_over(double length, double cell)
{
    return cell * ceil(length / cell * (1.0 - 1e-9));
}

/* Half of the grain's extent across the rail. */
static double half_across(const case_particle *g)
{
    const mpm_solid_kind *k = mpm_solid_kind_find(g->shape);
    if (!k) return g->radius;
    const mpm_solid s = mpm_solid_make(k);
    return mpm_solid_get(&s, "half_length") ? RIDGE_LENGTH * g->radius : g->radius;
}

/* As many as a doubling of the finest cells makes of the coarsest, or as the case says. */
static int levels_of(const case_scene *s, double fine)
{
    int levels = s->levels;
    if (s->basis != MPM_BASIS_GIMP) return 1;
    if (levels == 0)
        for (levels = 1; levels < MPM_MAX_LEVELS && fine * (1 << levels) <= s->coarse_cell * (1.0 + 1e-9);) levels++;
    return levels;
}

int gouge_layer_halvings(const case_scene *s, double fine, double thickness)
{
    const int levels = levels_of(s, fine), most = levels > 1 ? MPM_MAX_LEVELS - levels : 0;
    const double wanted = s->cells_per_layer > 0.0 ? GOUGE_ALMOST * thickness / s->cells_per_layer : INFINITY;
    int n = 0;
    while (n <= most && fine / (1 << n) > wanted) n++;
    return n <= most ? n : 0;
}

double gouge_cells_across(const case_scene *s, double fine, double thickness)
{
    return thickness / fine * (1 << gouge_layer_halvings(s, fine, thickness));
}

/* On one level the zone of fine cells must hold all that happens. */
static void lay_zone(const case_impact *c, layout *l)
{
    const case_particle *g = &c->particle;
    const bool one = l->levels == 1;
    const double radius = g->radius, across = half_across(g) + START_BESIDE * radius;
    const double room = one ? 3.0 * l->coarse : 2.0 * l->fine;
    const double to[5] = { START_BEHIND * radius, (one ? ZONE_AHEAD : START_AHEAD) * radius, START_DEPTH * radius,
                           fmax(1.5 * radius, g->height + 0.5 * radius),
                           one ? fmax(across, ZONE_BESIDE * radius) : across };
    const double most[5] = { l->behind, l->ahead, c->scene.rail_depth, c->armature.half_bore, l->half_width };
    double end[5];
    for (int i = 0; i < 5; i++) end[i] = cells_over(fmin(to[i], most[i] - room), l->fine);
    for (int k = 0; k < 3; k++) l->zone_lo[k] = -end[k < 2 ? 2 * k : 4], l->zone_hi[k] = end[k < 2 ? 2 * k + 1 : 4];
    if (c->scene.half_model) l->zone_lo[2] = 0.0;
}

static layout lay_out(const case_impact *c)
{
    const case_scene *s = &c->scene;
    const case_particle *g = &c->particle;
    const case_projectile *p = &c->armature;
    layout l = { .fine = g->radius / s->cells_per_radius };
    l.levels = levels_of(s, l.fine);
    l.coarse = l.levels > 1 ? l.fine * (1 << (l.levels - 1)) : fmax(s->coarse_cell, l.fine);
    l.run = p->chamfer_height / tan(p->lead_angle);
    l.x_front = -g->radius - fmin(g->height, p->chamfer_height) / tan(p->lead_angle) - l.fine;
    l.behind = fmax(s->rail_behind, p->length - l.run - l.x_front + 2.0 * l.coarse);
    l.passage = s->follow ? (p->length - l.run) / (1.0 - FRONT_SPEED) : 0.0;
    l.ahead = s->rail_ahead + FRONT_SPEED * l.passage; /* the same whether it is over at a gauge or not */
    l.reach = s->follow && l.levels > 1 ? l.ahead - 3.0 * l.coarse : fmin(ZONE_AHEAD * g->radius, 0.8 * l.ahead);
    l.rail_half_width = 0.5 * host_number_or(s->rail_width, p->width);
    l.half_width = fmax(l.rail_half_width, 0.5 * p->width) + (l.levels > 1 ? l.coarse : 3.0 * l.coarse);
    l.layers = case_layers_thickness(&c->rail.layers);
    for (int i = 0; i < c->rail.layers.n; i++) {
        const int own = gouge_layer_halvings(s, l.fine, c->rail.layers.item[i].thickness);
        l.halvings = own > l.halvings ? own : l.halvings;
    }
    lay_zone(c, &l);
    return l;
}

static status check_layout(const case_impact *c, const layout *l)
{
    const case_particle *g = &c->particle;
    CHECK(
        l->zone_hi[0] > g->radius && -l->zone_lo[0] > g->radius, STATUS_BAD_INPUT,
        "scene: the window, %g m behind to %g m ahead of the grain, must hold the grain of radius %g m and fine cells "
        "around it: lengthen scene.rail_ahead or rail_behind",
        l->behind, l->ahead, g->radius);
    CHECK(
        l->zone_hi[1] > 0.0 && l->zone_lo[1] < 0.0 && l->zone_hi[2] > g->radius, STATUS_BAD_INPUT,
        "scene: no room for fine cells %g m above, %g m below and %g m beside the grain: smaller scene.coarse_cell, or "
        "larger rail_depth, rail_width, armature.half_bore",
        l->zone_hi[1], -l->zone_lo[1], l->zone_hi[2]);
    CHECK(l->layers < c->scene.rail_depth - l->coarse, STATUS_BAD_INPUT,
          "scene.rail_depth = %g m: must exceed the layers' thickness of %g m by more than a coarse cell",
          c->scene.rail_depth, l->layers);
    CHECK(strcmp(g->shape, "pit") != 0 || g->height < -l->zone_lo[1], STATUS_BAD_INPUT,
          "particle.height = %g m: a pit may be %g m deep, %g radii", g->height, -l->zone_lo[1], START_DEPTH);
    CHECK(-l->x_front < l->behind, STATUS_BAD_INPUT,
          "scene: the armature would start %g m behind the grain, outside the window, which begins %g m behind it: "
          "lengthen scene.rail_behind",
          -l->x_front, l->behind);
    return status_ok();
}

/* A layer that may come off touches what lies below it: a body of less than a cell cannot. */
static status check_layers(const case_impact *c, const layout *l)
{
    for (int i = 0; i < c->rail.layers.n; i++) {
        const case_layer *layer = &c->rail.layers.item[i];
        CHECK(
            isnan(layer->bond_strength) || layer->thickness >= l->fine * (1.0 - 1e-9), STATUS_BAD_INPUT,
            "rail.layers[%d]: %g m of %s with a bond of its own, in cells of %g m: at least one cell across; take %.3g "
            "cells a radius, or weld it (bond_strength: none)",
            i, layer->thickness, layer->material, l->fine, c->particle.radius / layer->thickness);
    }
    return status_ok();
}

/* ---- bodies ---- */

/* *added is valid until the next is added. */
static status add_body(mpm_scene *s, const char *name, const mpm_material *m, int group, mpm_body **added)
{
    TRY(mpm_scene_add_body(s, added));
    snprintf((*added)->name, sizeof(*added)->name, "%s", name);
    (*added)->material = m;
    (*added)->group = group;
    return status_ok();
}

static status make_box(mpm_scene *s, mpm_body *b, const layout *l, double bottom, double top)
{
    const double lo[3] = { -l->behind, bottom, -l->rail_half_width }, hi[3] = { l->ahead, top, l->rail_half_width };
    mpm_solid *box;
    TRY(mpm_scene_add_solid(s, "box", -1, -1, &box));
    memcpy(mpm_solid_value(box, "lo"), lo, sizeof lo);
    memcpy(mpm_solid_value(box, "hi"), hi, sizeof hi);
    b->solid = s->solids - 1;
    return status_ok();
}

/* *group: that of what lies below; then its own, bonded to it, or the same where it is welded. */
static status next_group(mpm_scene *s, double bond_strength, int *group)
{
    mpm_pair *bond;
    if (isnan(bond_strength)) return status_ok();
    TRY(mpm_scene_add_pair(s, *group, *group + 1, &bond));
    bond->contact.value[COULOMB_BOND_STRENGTH] = bond_strength;
    ++*group;
    return status_ok();
}

static status add_rail(const case_impact *c, const layout *l, gouge_scene *g, int *group)
{
    mpm_body *rail, *b;
    mpm_scene *s = &g->scene;
    g->rail = s->bodies;
    g->layers = c->rail.layers.n;
    TRY(add_body(s, "rail", case_material(&c->materials, c->rail.material), *group, &rail));
    TRY(make_box(s, rail, l, -c->scene.rail_depth, -l->layers));
    rail->yield_scale = c->rail.yield_scale, rail->cold_work = c->rail.cold_work;
    double bottom = -l->layers;
    for (int i = 0; i < c->rail.layers.n; i++) {
        const case_layer *layer = &c->rail.layers.item[i];
        char name[BASE_PARAM_TEXT_SIZE];
        snprintf(name, sizeof name, "layer_%d", i + 1);
        TRY(next_group(s, layer->bond_strength, group));
        TRY(add_body(s, name, case_material(&c->materials, layer->material), *group, &b));
        const bool last = i == c->rail.layers.n - 1;
        TRY(make_box(s, b, l, bottom, last ? 0.0 : bottom + layer->thickness));
        b->yield_scale = layer->yield_scale, b->cold_work = layer->cold_work;
        bottom += layer->thickness;
    }
    return status_ok();
}

static bool is_pit(const case_particle *g)
{
    return strcmp(g->shape, "pit") == 0;
}

/* Those values of a grain's shape that it has; its middle stays at 0. */
static void set_grain(const case_particle *g, mpm_solid *solid)
{
    const struct {
        const char *name;
        double value;
    } all[] = { { "radius", g->radius }, { "height", g->height }, { "half_length", RIDGE_LENGTH * g->radius } };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        double *value = mpm_solid_value(solid, all[i].name);
        if (value) *value = all[i].value;
    }
    if (strcmp(g->shape, "sphere") == 0) /* the rest of it lies in the rail */
        mpm_solid_value(solid, "center")[1] = g->height - g->radius;
}

/* A pit is a hole in rail and layers, no body. */
static status add_grain(const case_impact *c, gouge_scene *out, int *group)
{
    mpm_body *b;
    const case_particle *g = &c->particle;
    mpm_scene *s = &out->scene;
    mpm_solid *solid;
    double lo[3], hi[3];
    TRY(mpm_scene_add_solid(s, g->shape, -1, -1, &solid));
    set_grain(g, solid);
    mpm_solid_bounds(solid, lo, hi);
    const int place = s->solids - 1;
    out->grain = is_pit(g) ? GOUGE_PIT : s->bodies;
    out->grain_end = hi[0];
    if (!is_pit(g)) {
        TRY(next_group(s, g->bond_strength, group));
        TRY(add_body(s, "particle", case_material(&c->materials, g->material), *group, &b));
        b->solid = place;
    }
    for (int i = 0; is_pit(g) && i < s->bodies; i++) {
        TRY(mpm_scene_add_solid(s, "minus", s->body[i].solid, place, &solid));
        s->body[i].solid = s->solids - 1;
    }
    return status_ok();
}

static status add_armature(const case_impact *c, const layout *l, int group, gouge_scene *g)
{
    mpm_body *b;
    const case_projectile *p = &c->armature;
    mpm_scene *s = &g->scene;
    g->armature = s->bodies;
    TRY(add_body(s, "armature", case_material(&c->materials, p->material), group, &b));
    b->yield_scale = p->yield_scale;
    const gouge_armature shape = { .front = l->x_front,
                                   .length = p->length,
                                   .leg_thickness = p->leg_thickness,
                                   .head_thickness = p->head_thickness,
                                   .half_bore = p->half_bore,
                                   .chamfer_height = p->chamfer_height,
                                   .lead_angle = p->lead_angle,
                                   .half_width = 0.5 * p->width };
    CHECK(b->material, STATUS_BAD_INPUT, "scene: body `%s` has no material", b->name);
    mpm_solid *prism;
    TRY(gouge_armature_check(&shape));
    TRY(mpm_scene_add_solid(s, "prism", -1, -1, &prism));
    gouge_armature_fill(&shape, prism);
    b->solid = s->solids - 1;
    const double mass = b->material->density * gouge_armature_section(&shape) * p->width;
    b->velocity[0] = c->scene.velocity;
    b->body_force[1] = -host_number_or(c->scene.contact_pressure, 0.0) * gouge_face_area(p) / mass;
    g->velocity = c->scene.velocity;
    g->face_front = l->x_front;
    g->face_tail = l->x_front + l->run - p->length;
    return status_ok();
}

static status add_bodies(const case_impact *c, const layout *l, gouge_scene *g)
{
    mpm_scene *s = &g->scene;
    int group = 0;
    CHECK(c->rail.layers.n + 3 <= RESULT_BODIES, STATUS_BAD_INPUT,
          "rail.layers: %d layers, a scene takes %d at most: make one of neighbours that are alike", c->rail.layers.n,
          RESULT_BODIES - 3);
    TRY(add_rail(c, l, g, &group));
    TRY(add_grain(c, g, &group));
    TRY(add_armature(c, l, group + 1, g));
    for (int i = 0; i < s->bodies; i++) {
        mpm_body *b = &s->body[i];
        CHECK(b->material, STATUS_BAD_INPUT, "scene: body `%s` has no material", b->name);
        TRY(mpm_solid_check(&s->solid[b->solid], b->solid));
        b->temperature =
            i == g->armature ? host_number_or(c->armature.temperature, CASE_ROOM_TEMPERATURE) : c->rail.temperature;
        b->damage = c->scene.damage;
    }
    return status_ok();
}

static void set_contacts(const case_impact *c, mpm_scene *s)
{
    s->contact.value[COULOMB_FRICTION] = c->scene.friction;
    s->contact.value[COULOMB_SHEAR_LIMIT] = host_number_or(c->scene.shear_limit, CONTACT_NO_LIMIT);
}

/* ---- grid ---- */

/* What shares no group with the rail or a layer leaves through the window's ends along x. */
static void free_ends(gouge_scene *g)
{
    mpm_scene *s = &g->scene;
    for (int i = 0; i < s->bodies; i++) {
        bool held = false;
        for (int k = 0; k < s->bodies; k++)
            held = held || (s->body[k].group == s->body[i].group && gouge_counts_as_rail(g, k));
        s->body[i].passes[0] = s->body[i].passes[1] = !held;
    }
}

static void set_axes(const case_impact *c, const layout *l, gouge_scene *g)
{
    mpm_scene *s = &g->scene;
    const bool half = c->scene.half_model;
    const double lo[3] = { -l->behind, -c->scene.rail_depth, half ? 0.0 : -l->half_width };
    const double hi[3] = { l->ahead, c->armature.half_bore, l->half_width };
    const mpm_boundary_kind kind[3][2] = { { MPM_BOUNDARY_ABSORBING, MPM_BOUNDARY_ABSORBING },
                                           { MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY },
                                           { half ? MPM_BOUNDARY_SYMMETRY : MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE } };
    for (int k = 0; k < 3; k++) {
        mpm_axis *a = &s->axis[k];
        a->lo = lo[k], a->hi = hi[k];
        a->fine_lo = l->zone_lo[k], a->fine_hi = l->zone_hi[k];
        a->fine = l->fine / (1 << l->halvings), a->coarse = l->coarse;
        a->growth = c->scene.growth;
        for (int e = 0; e < 2; e++) a->boundary[e] = kind[k][e];
    }
    g->cell = l->fine;
    g->reach = l->reach, g->beside = l->rail_half_width;
    free_ends(g);
}

bool gouge_is_followed(const gouge_scene *s)
{
    return s->gauge_time[1] > 0.0;
}

double gouge_crossing_time(const gouge_scene *s)
{
    return (s->reach - s->face_front) / s->velocity;
}

double gouge_grain_passed(const gouge_scene *s)
{
    return (s->grain_end - s->face_front) / s->velocity;
}

double gouge_face_tail(const gouge_scene *s, double time)
{
    return s->face_tail + s->velocity * time;
}

double gouge_last_time(const gouge_scene *s)
{
    return s->gauged ? s->gauge_time[1] : s->scene.end_time;
}

static status add_plastic(gouge_scene *g, double jump, double cell, int body)
{
    mpm_refine *plastic;
    TRY(mpm_scene_add_refine(&g->scene, "plastic", &plastic));
    *mpm_refine_value(plastic, "jump") = jump;
    plastic->cell = cell, plastic->body = body;
    return status_ok();
}

/* Fine cells around the grain until it has been passed, then where metal flows; where a layer does, its own. */
static status set_refinement(const case_impact *c, gouge_scene *g)
{
    const double radius = c->particle.radius;
    const double jump = c->scene.refine_tolerance * g->velocity;
    mpm_scene *s = &g->scene;
    if (c->scene.follow) gouge_gauge_times(radius, g->velocity, g->gauge_time);
    if (s->levels == 1) return status_ok();
    s->zone_until = gouge_grain_passed(g) + radius / g->velocity;
    s->zone_cell = g->cell;
    TRY(add_plastic(g, jump, g->cell, -1));
    for (int i = 0; i < g->layers; i++) {
        const int own = gouge_layer_halvings(&c->scene, g->cell, c->rail.layers.item[i].thickness);
        if (own > 0) TRY(add_plastic(g, jump, g->cell / (1 << own), g->rail + 1 + i));
    }
    return status_ok();
}

static void set_method(const case_impact *c, const layout *l, gouge_scene *g)
{
    const case_scene *from = &c->scene;
    mpm_scene *s = &g->scene;
    s->particles_per_axis = from->particles_per_axis;
    s->courant = from->courant;
    s->viscosity_linear = from->viscosity_linear;
    s->viscosity_quadratic = from->viscosity_quadratic;
    s->transfer = from->transfer;
    s->basis = from->basis;
    s->levels = l->levels + l->halvings;
    for (int k = 0; k < 3; k++) s->grid_shift[k] = from->grid_shift[k] * (1 << l->halvings);
    s->heat_by_plastic_work = from->heat_by_plastic_work;
    const double passage = gouge_crossing_time(g) + c->armature.length / g->velocity;
    s->end_time = host_number_or(from->end_time, from->follow ? l->passage / g->velocity
                                                              : fmin(END_FACTOR * gouge_crossing_time(g), passage));
}

static void set_rules(const case_impact *c, gouge_scene *g)
{
    g->friction = c->scene.friction;
    g->gauged = case_impact_is_gauged(c);
    g->stop_when_settled = c->scene.stop_when_settled;
    g->cells_grow = c->scene.cells_grow;
    g->limit_length_over_width = c->scene.limit_length_over_width;
    g->growth_scatter = c->scene.growth_scatter;
}

/* A scene that ends before its second gauge would pass for a groove that died. */
static status reaches_gauge(const gouge_scene *g)
{
    CHECK(!g->gauged || g->scene.end_time >= g->gauge_time[1], STATUS_BAD_INPUT,
          "scene: over after %.3g s, before the growth of its groove is known, %.3g s: a longer scene.end_time, a "
          "contact face of more than %.3g grain radii, or study.judge: severity (for `breech scene`, no "
          "scene.stop_when_gauged)",
          g->scene.end_time, g->gauge_time[1], gouge_gauge_way() * (1.0 - FRONT_SPEED));
    return status_ok();
}

/* ---- the crater ---- */

/* Plan area and volume of the part above y = 0, of a pit of all of it, by the middles of N_PLAN x N_UP x N_PLAN cells
 * of its box. */
static void measure_grain(const case_particle *g, double *area, double *volume)
{
    enum { N_PLAN = 128, N_UP = 48 };
    mpm_solid shape = mpm_solid_make(mpm_solid_kind_find(g->shape));
    double lo[3], hi[3], h[3];
    int columns = 0, cells = 0;
    set_grain(g, &shape);
    mpm_solid_bounds(&shape, lo, hi);
    if (!is_pit(g)) lo[1] = fmax(lo[1], 0.0);
    for (int k = 0; k < 3; k++) h[k] = (hi[k] - lo[k]) / (k == 1 ? N_UP : N_PLAN);
    for (int ix = 0; ix < N_PLAN; ix++)
        for (int iz = 0; iz < N_PLAN; iz++) {
            const double foot[3] = { lo[0] + (ix + 0.5) * h[0], lo[1] + 1e-6 * h[1], lo[2] + (iz + 0.5) * h[2] };
            int within = 0;
            for (int iy = 0; iy < N_UP; iy++) {
                const double x[3] = { foot[0], lo[1] + (iy + 0.5) * h[1], foot[2] };
                within += mpm_solid_inside(&shape, x) > 0.0;
            }
            cells += within;
            columns += within > 0 || mpm_solid_inside(&shape, foot) > 0.0;
        }
    *area = columns * h[0] * h[2];
    *volume = cells * h[0] * h[1] * h[2];
}

static crater_spec spec_of(const case_impact *c, const gouge_scene *of)
{
    const case_particle *g = &c->particle;
    const mpm_scene *s = &of->scene;
    crater_spec spec = { .surface = 0.0,
                         .x_lo = s->axis[0].fine_lo,
                         .x_hi = of->reach,
                         .z_hi = fmin(of->beside, MAP_BESIDE * g->radius),
                         .mirrored = c->scene.half_model,
                         .cell = of->cell,
                         .measuring_depth = host_number_or(c->scene.measuring_depth, 0.0),
                         .particle_radius = g->radius,
                         .particle_height = g->height,
                         .limit_widening = c->scene.limit_widening,
                         .limit_severity = c->scene.limit_severity };
    measure_grain(g, &spec.particle_area, &spec.particle_volume);
    return spec;
}

static status fill_scene(const case_impact *c, gouge_scene *out)
{
    CHECK(c->scene.velocity > 0.0 && isfinite(c->scene.velocity), STATUS_BAD_INPUT,
          "scene: the armature's velocity is %g m/s: must be positive", c->scene.velocity);
    const layout l = lay_out(c);
    TRY(check_layout(c, &l));
    TRY(check_layers(c, &l));
    set_contacts(c, &out->scene);
    TRY(add_bodies(c, &l, out));
    set_axes(c, &l, out);
    set_method(c, &l, out);
    TRY(set_refinement(c, out));
    set_rules(c, out);
    return reaches_gauge(out);
}

status gouge_scene_bodies(const case_impact *c, gouge_scene *out)
{
    memset(out, 0, sizeof *out);
    mpm_scene_default(&out->scene);
    const status s = fill_scene(c, out);
    if (s.code != STATUS_OK) gouge_scene_free(out);
    return s;
}

void gouge_scene_free(gouge_scene *s)
{
    mpm_scene_free(&s->scene);
}

status gouge_scene_make(const case_impact *c, gouge_scene *out)
{
    TRY(gouge_scene_bodies(c, out));
    out->crater = spec_of(c, out);
    return status_ok();
}
