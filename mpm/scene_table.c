/* SPDX-License-Identifier: BSD-3-Clause */
/* The members of a scene's structs, each once: defaults, ranges, units and names for those who read or print scenes,
 * and the key that says whether two scenes are the same. */
#include "mpm/scene.h"
#include "mpm/law/contact.h"

#include <stdint.h>
#include <string.h>

const char *const mpm_face_names[] = { "-x", "+x", "-y", "+y", "-z", "+z", NULL };
const char *const mpm_axis_names[] = { "x", "y", "z", NULL };
const char *const mpm_boundary_names[] = {
#define BOUNDARY(PLACE, name, after, text) #name,
#include "mpm/law/boundary.def"
    NULL
};
const char *const mpm_boundary_docs[] = {
#define BOUNDARY(PLACE, name, after, text) text,
#include "mpm/law/boundary.def"
    NULL
};
const char *const mpm_transfer_names[] = { [MPM_TRANSFER_TPIC] = "tpic", [MPM_TRANSFER_PIC] = "pic", NULL };
const char *const mpm_basis_names[] = { [MPM_BASIS_GIMP] = "gimp", [MPM_BASIS_BSPLINE] = "bspline", NULL };

/* A row whose key is not its member's name. */
#define ROW(type, key_, member, unit_, kind_, fallback_, min_, max_, doc_)                                        \
    {                                                                                                             \
        .key = (key_), .unit = (unit_), .doc = (doc_), .offset = offsetof(type, member), .fallback = (fallback_), \
        .min = (min_), .max = (max_), .kind = (kind_)                                                             \
    }
#define PASSES(face, key_) \
    ROW(mpm_body, key_, passes[face], "1", BASE_PARAM_FLAG, 0, 0, 1, "that end does not act on it")
#define END_OF_AXIS(end, key_)                                                              \
    {                                                                                       \
        .key = (key_), .unit = "1", .doc = "what acts at that end of the window",           \
        .offset = offsetof(mpm_axis, boundary[end]), .max = 1e9, .kind = BASE_PARAM_CHOICE, \
        .choices = mpm_boundary_names                                                       \
    }
#define CELLS(key_, member, unit_, min_, max_, doc_) \
    ROW(mpm_axis, key_, member, unit_, BASE_PARAM_NUMBER, OPTIONAL, min_, max_, doc_)

const base_param mpm_body_params[] = {
    PARAM_INT(mpm_body, solid, -1, 0, 1e9, "root of its volume among the scene's solids"),
    PARAM_INT(mpm_body, group, 0, 0, 1e9, "bodies of one group share one velocity at every node"),
    PASSES(0, "passes_x_lo"),
    PASSES(1, "passes_x_hi"),
    PASSES(2, "passes_y_lo"),
    PASSES(3, "passes_y_hi"),
    PASSES(4, "passes_z_lo"),
    PASSES(5, "passes_z_hi"),
    /* MPM_BODY_KEYED */
    PARAM_STRING(mpm_body, name, NULL, "its name: letters, digits, - _ ."),
    PARAM_VEC3(mpm_body, velocity, "m/s", 0.0, -1e5, 1e5, "at the start"),
    PARAM_VEC3(mpm_body, spin, "rad/s", 0.0, -1e9, 1e9, "at the start, about its centre of mass"),
    PARAM_DOUBLE(mpm_body, temperature, "K", 293.0, 0.1, 1e5, "at the start"),
    PARAM_DOUBLE(mpm_body, pressure, "Pa", OPTIONAL, -1e12, 1e12,
                 "at the start, from that of the surroundings; not given: that at which its material is at rest"),
    PARAM_VEC3(mpm_body, body_force, "m/s^2", 0.0, -1e15, 1e15, "acceleration of all of it"),
    PARAM_VEC3(mpm_body, traction, "Pa", 0.0, -1e13, 1e13, "on all of its surface that looks towards traction_face"),
    PARAM_ENUM(mpm_body, traction_face, mpm_face_names, 0, "where that surface looks"),
    PARAM_DOUBLE(mpm_body, wave_pressure, "Pa", OPTIONAL, 0.0, 1e12,
                 "of a fluid: first pressure of a plane wave that enters through its surface towards traction_face"),
    PARAM_DOUBLE(mpm_body, wave_decay, "s", OPTIONAL, 1e-9, 1e3,
                 "in which that wave falls to 1/e; not given: it stays"),
    PARAM_DOUBLE(
        mpm_body, piston_mass, "kg/m^2", OPTIONAL, 1e-3, 1e6,
        "in place of wave_pressure: on its area, mass of a piston that sends the wave down a tube of the fluid"),
    PARAM_DOUBLE(mpm_body, piston_velocity, "m/s", OPTIONAL, 1e-3, 1e4, "of that piston at first"),
    PARAM_DOUBLE(mpm_body, tube_length, "m", OPTIONAL, 1e-6, 1e3,
                 "fluid between that piston and the surface through which the wave enters, where it is at time 0"),
    PARAM_BOOL(mpm_body, held, 0, "it never moves: a wall, a clamp; the same for all bodies of a group"),
    PARAM_DOUBLE(mpm_body, yield_scale, "1", 1.0, 1e-3, 1e3, "factor on the yield stress: hardening"),
    PARAM_DOUBLE(mpm_body, cold_work, "1", OPTIONAL, 0.0, 100.0,
                 "plastic strain before the scene, from which its law of strength begins; not given: its material's"),
    PARAM_BOOL(mpm_body, damage, 0, "its material's law of failure acts"),
    PARAMS_END,
};

const base_param mpm_axis_params[] = {
    END_OF_AXIS(0, "boundary_lo"),
    END_OF_AXIS(1, "boundary_hi"),
    ROW(mpm_axis, "boundary_velocity_lo", boundary_velocity[0], "m/s", BASE_PARAM_VECTOR, 0, -1e5, 1e5,
        "if prescribed"),
    ROW(mpm_axis, "boundary_velocity_hi", boundary_velocity[1], "m/s", BASE_PARAM_VECTOR, 0, -1e5, 1e5,
        "if prescribed"),
    /* MPM_AXIS_KEYED */
    CELLS("lo", lo, "m", -1e3, 1e3, "lower end of the window"),
    CELLS("hi", hi, "m", -1e3, 1e3, "upper end of the window"),
    CELLS("fine_lo", fine_lo, "m", -1e3, 1e3, "lower end of the zone of fine cells"),
    CELLS("fine_hi", fine_hi, "m", -1e3, 1e3, "upper end of it"),
    CELLS("cell", fine, "m", 1e-9, 1e2, "cells in that zone"),
    CELLS("coarse_cell", coarse, "m", 1e-9, 1e2, "largest cells outside it"),
    CELLS("growth", growth, "1", 1.0, 2.0, "ratio of neighbouring cells outside it"),
    PARAMS_END,
};

const base_param mpm_pair_params[] = {
    PARAM_INT(mpm_pair, a, 0, 0, 1e9, "group"),
    PARAM_INT(mpm_pair, b, 1, 0, 1e9, "group"),
    PARAM_INT(mpm_pair, normal_of, 0, 0, 1e9, "group whose surface gives the contact normal"),
    PARAMS_END,
};

const base_param mpm_cavity_params[] = {
    PARAM_INT(mpm_cavity, wall, -1, -1, 1e9, "body that holds it in"),
    /* MPM_CAVITY_KEYED */
    PARAM_STRING(mpm_cavity, name, NULL, "its name: letters, digits, - _ ."),
    PARAM_VEC3(mpm_cavity, place, "m", REQUIRED, -1e3, 1e3, "a point in its void at the start"),
    PARAM_DOUBLE(mpm_cavity, pressure, "Pa", 0.0, -1e9, 1e12, "of its gas at the start, above the ambient one"),
    PARAM_DOUBLE(mpm_cavity, ambient, "Pa", 101325.0, 1.0, 1e9,
                 "absolute pressure outside, from which pressures count"),
    PARAM_DOUBLE(mpm_cavity, temperature, "K", 293.15, 1.0, 1e4, "of its gas, for good"),
    PARAM_DOUBLE(mpm_cavity, critical_temperature, "K", OPTIONAL, 1.0, 1e4,
                 "with critical_pressure: Redlich and Kwong; not given: an ideal gas"),
    PARAM_DOUBLE(mpm_cavity, critical_pressure, "Pa", OPTIONAL, 1e3, 1e9, "of the gas"),
    PARAM_DOUBLE(mpm_cavity, feed, "mol/s", 0.0, -1e6, 1e6, "gas that comes into it, of the model as computed"),
    PARAM_DOUBLE(mpm_cavity, hole, "m^2", 0.0, 0.0, 1e4, "area that opens when it bursts; 0: it keeps its gas"),
    PARAM_DOUBLE(mpm_cavity, discharge, "1", 0.8, 1e-3, 1.0, "coefficient of the flow through it"),
    PARAM_DOUBLE(mpm_cavity, molar_mass, "kg/mol", 0.029, 1e-3, 1.0, "of the gas"),
    PARAM_DOUBLE(mpm_cavity, gas_gamma, "1", 1.3, 1.01, 2.0, "ratio of its specific heats"),
    PARAMS_END,
};

const base_param mpm_scene_params[] = {
    PARAM_STRING(mpm_scene, instruction_set, "", "that the kernels run in; empty: the best of this machine"),
    /* MPM_SCENE_KEYED */
    PARAM_DOUBLE(mpm_scene, end_time, "s", OPTIONAL, 1e-12, 1e3,
                 "time that is simulated; may be left out beside strike.travel"),
    /* MPM_SCENE_HASHED */
    PARAM_DOUBLE(mpm_scene, zone_until, "s", OPTIONAL, 0.0, 1e6,
                 "until then cells are small in the zone of the window, with levels; not given: 0 with `refine`"),
    PARAM_DOUBLE(mpm_scene, zone_cell, "m", OPTIONAL, 1e-9, 1e3,
                 "cells that are small enough in that zone, with levels; not given: the finest"),
    PARAM_DOUBLE(mpm_scene, surroundings, "Pa", OPTIONAL, 0.0, 1e12,
                 "absolute pressure around the bodies, from which pressures count; not given: that at which each gas "
                 "is at rest"),
    MPM_METHOD_PARAMS(mpm_scene),
    PARAMS_END,
};

/* ---- the key ---- */

static uint64_t hash(uint64_t h, const void *data, size_t bytes) /* FNV-1a */
{
    const unsigned char *p = data;
    for (size_t i = 0; i < bytes; i++) h = (h ^ p[i]) * 1099511628211ull;
    return h;
}

static size_t size_of(const base_param *p, const char *member)
{
    switch (p->kind) {
    case BASE_PARAM_NUMBER: return sizeof(double);
    case BASE_PARAM_VECTOR: return 3 * sizeof(double);
    case BASE_PARAM_POINTS: return 2 * (size_t)p->room * sizeof(double);
    case BASE_PARAM_FLAG: return sizeof(bool);
    case BASE_PARAM_TEXT: return strnlen(member, BASE_PARAM_TEXT_SIZE);
    case BASE_PARAM_INTEGER:
    case BASE_PARAM_CHOICE: return sizeof(int);
    }
    return 0;
}

static uint64_t hash_members(uint64_t h, const base_param *table, const void *object)
{
    for (const base_param *p = table; p->key; p++) {
        const char *member = (const char *)object + p->offset;
        h = hash(h, member, size_of(p, member));
    }
    return h;
}

static uint64_t hash_contact(uint64_t h, const mpm_contact *c)
{
    h = hash(h, c->law->name, strlen(c->law->name));
    return hash_members(h, c->law->params, c);
}

static uint64_t hash_solid(uint64_t h, const mpm_solid *s)
{
    h = hash(h, s->kind->name, strlen(s->kind->name));
    h = hash(h, s->part, sizeof s->part);
    return hash(h, s->value, sizeof s->value);
}

static uint64_t hash_refine(uint64_t h, const mpm_refine *r)
{
    h = hash(h, r->kind->name, strlen(r->kind->name));
    h = hash(h, &r->body, sizeof r->body);
    h = hash(h, &r->cell, sizeof r->cell);
    return hash(h, r->value, sizeof r->value);
}

uint64_t mpm_scene_hash(const mpm_scene *s)
{
    uint64_t h = hash_members(14695981039346656037ull, &mpm_scene_params[MPM_SCENE_HASHED], s);
    h = hash_contact(h, &s->contact);
    for (int k = 0; k < 3; k++) h = hash_members(h, mpm_axis_params, &s->axis[k]);
    for (int i = 0; i < s->solids; i++) h = hash_solid(h, &s->solid[i]);
    for (int i = 0; i < s->refines; i++) h = hash_refine(h, &s->refine[i]);
    for (int i = 0; i < s->cavities; i++) h = hash_members(h, mpm_cavity_params, &s->cavity[i]);
    for (int i = 0; i < s->bodies; i++) {
        h = hash_members(h, mpm_body_params, &s->body[i]);
        h = hash_members(h, mpm_material_params, s->body[i].material);
    }
    for (int i = 0; i < s->pairs; i++) {
        h = hash_members(h, mpm_pair_params, &s->pair[i]);
        h = hash_contact(h, &s->pair[i].contact);
    }
    return h;
}
