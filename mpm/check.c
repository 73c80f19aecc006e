/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene is refused for before its points are made, entry by entry of its lists. */
#include "mpm/law/contact.h"
#include "mpm/law/law.h"
#include "mpm/memory/cavities.h"
#include "mpm/read/probe.h"
#include "mpm/refine/refine.h"
#include "mpm/wave.h"

#include <math.h>
#include <string.h>

const mpm_refused mpm_not_refused = { MPM_PART_SCENE, 0, NULL };

/* ---- the scene itself ---- */

/* Where breech-stress and the sweep of docs/notes/solver.md saw scenes blow up. */
double mpm_courant_limit(mpm_transfer_kind transfer)
{
    return transfer == MPM_TRANSFER_PIC ? 0.5 : 0.6;
}

static status check_whole(const mpm_scene *s, const char **key)
{
    const double most = mpm_courant_limit(s->transfer);
    *key = "bodies";
    CHECK(s->bodies >= 1 && s->bodies <= MPM_BODIES_COUNTED, STATUS_BAD_INPUT, "%d bodies: must be 1 .. %d", s->bodies,
          MPM_BODIES_COUNTED);
    *key = "courant";
    CHECK(s->courant > 0 && s->courant <= most, STATUS_BAD_INPUT,
          "courant = %g: must be in (0, %g], beyond which %s is not stable", s->courant, most,
          s->transfer == MPM_TRANSFER_PIC ? "pic"
          : s->basis == MPM_BASIS_BSPLINE ? "bspline"
                                          : "no scheme");
    *key = "cavities";
    CHECK(s->cavities <= MPM_MAX_CAVITIES, STATUS_BAD_INPUT, "%d cavities: at most %d", s->cavities, MPM_MAX_CAVITIES);
    *key = s->refines > 0 ? "refine" : "levels";
    CHECK(s->cavities == 0 || s->levels <= 1, STATUS_BAD_INPUT,
          "a scene with cavities has cells of one size: `levels: 1`, and no `refine`");
    *key = NULL;
    TRY(base_params_check(&mpm_scene_params[MPM_SCENE_HASHED], s, "scene"));
    return mpm_contact_check(&s->contact);
}

/* ---- bodies ---- */

/* The first key that moves a body; NULL: none. */
static const char *key_that_moves(const mpm_body *b)
{
    const struct {
        const char *key;
        const double *of;
    } moves[] = {
        { "velocity", b->velocity }, { "spin", b->spin }, { "body_force", b->body_force }, { "traction", b->traction }
    };
    for (size_t i = 0; i < sizeof moves / sizeof *moves; i++)
        for (int k = 0; k < 3; k++)
            if (moves[i].of[k] != 0) return moves[i].key;
    if (!mpm_wave_is_wanted(b)) return NULL;
    return isnan(b->wave_pressure) ? "piston_mass" : "wave_pressure";
}

static status check_held(const mpm_body *b, const char **key)
{
    if (!b->held) return status_ok();
    *key = key_that_moves(b);
    CHECK(!*key, STATUS_BAD_INPUT,
          "body `%s` is held: it can have no velocity, spin, body_force, traction, wave_pressure or piston", b->name);
    return status_ok();
}

/* Of a wave's keys, the first that is given. */
static const char *key_of_wave(const mpm_body *b)
{
    return !isnan(b->wave_pressure)     ? "wave_pressure"
           : !isnan(b->wave_decay)      ? "wave_decay"
           : !isnan(b->piston_mass)     ? "piston_mass"
           : !isnan(b->piston_velocity) ? "piston_velocity"
                                        : "tube_length";
}

static status check_group(const mpm_scene *s, int i, const char **key)
{
    const mpm_body *b = &s->body[i];
    const int groups = mpm_scene_groups(s);
    *key = "group";
    CHECK(groups <= s->bodies, STATUS_BAD_INPUT, "%d groups of %d bodies: number them from 0 without gaps", groups,
          s->bodies);
    for (int k = 0; k < i; k++)
        CHECK(s->body[k].group != b->group || memcmp(s->body[k].passes, b->passes, sizeof b->passes) == 0,
              STATUS_BAD_INPUT, "bodies `%s` and `%s` are one group, but different boundaries act on them",
              s->body[k].name, b->name);
    for (int k = 0; k < i; k++)
        CHECK(s->body[k].group != b->group || s->body[k].held == b->held, STATUS_BAD_INPUT,
              "bodies `%s` and `%s` are one group, but one of them is held: give it a group of its own and a contact",
              s->body[k].name, b->name);
    return status_ok();
}

/* Its law of material, where it begins. */
static status check_start(const mpm_scene *s, const mpm_body *b, const char **key)
{
    mpm_body at_rest = *b;
    law k;
    at_rest.pressure = NAN;
    *key = mpm_law_make(&at_rest, s, &k).code == STATUS_OK ? "pressure" : "material";
    TRY(mpm_law_make(b, s, &k));
    if (isnan(b->pressure)) *key = "held";
    CHECK(!b->held || k.p_start == 0, STATUS_BAD_INPUT,
          "body `%s` is held: it can have no pressure at the start, and has %g Pa", b->name, k.p_start);
    return status_ok();
}

static status check_body(const mpm_scene *s, int i, const char **key)
{
    const mpm_body *b = &s->body[i];
    TRY(base_params_check(mpm_body_params, b, b->name));
    *key = "material";
    CHECK(b->material, STATUS_BAD_INPUT, "body `%s` lacks a material", b->name);
    *key = "shape";
    CHECK(b->solid >= 0 && b->solid < s->solids, STATUS_BAD_INPUT, "body `%s`: solid %d, the scene has %d", b->name,
          b->solid, s->solids);
    TRY(mpm_solid_check(&s->solid[b->solid], b->solid));
    *key = key_of_wave(b);
    TRY(mpm_wave_check(b));
    TRY(check_held(b, key));
    TRY(check_group(s, i, key));
    return check_start(s, b, key);
}

/* ---- the other lists ---- */

static status check_pair(const mpm_scene *s, int i, const char **key)
{
    const int groups = mpm_scene_groups(s);
    const mpm_pair *p = &s->pair[i];
    *key = "between";
    CHECK(p->a >= 0 && p->a < groups && p->b >= 0 && p->b < groups && p->a != p->b, STATUS_BAD_INPUT,
          "pair %d: groups %d and %d must be two of 0 .. %d", i, p->a, p->b, groups - 1);
    for (int k = 0; k < i; k++)
        CHECK(s->pair[k].a + s->pair[k].b != p->a + p->b || (s->pair[k].a != p->a && s->pair[k].a != p->b),
              STATUS_BAD_INPUT, "pairs %d and %d name the same two groups, %d and %d: one contact is enough for two", k,
              i, p->a, p->b);
    *key = "normal_of";
    CHECK(p->normal_of == p->a || p->normal_of == p->b, STATUS_BAD_INPUT,
          "pair %d: the normal of group %d, which is neither %d nor %d", i, p->normal_of, p->a, p->b);
    *key = "law";
    return mpm_contact_check(&p->contact);
}

static status check_probe(const mpm_scene *s, int i, const char **key)
{
    TRY(mpm_probe_check(&s->probe[i], s->bodies));
    *key = "name";
    for (int k = 0; k < i; k++)
        CHECK(strcmp(s->probe[k].name, s->probe[i].name) != 0, STATUS_BAD_INPUT, "two probes are named `%s`",
              s->probe[i].name);
    return status_ok();
}

/* The void at its place shows once there are points (memory/cavities.c). */
static status check_cavity(const mpm_scene *s, int i, const char **key)
{
    const mpm_cavity *c = &s->cavity[i];
    TRY(base_params_check(mpm_cavity_params, c, c->name));
    *key = "wall";
    CHECK(c->wall < s->bodies, STATUS_BAD_INPUT, "cavity `%s`: its wall is body %d, the scene has %d", c->name, c->wall,
          s->bodies);
    const mpm_gas gas = mpm_gas_make(c->temperature, c->critical_temperature, c->critical_pressure);
    const double absolute = c->pressure + c->ambient;
    *key = "pressure";
    CHECK(absolute > 0 && absolute < mpm_gas_condenses(&gas), STATUS_BAD_INPUT,
          "cavity `%s`: its gas has no pressure of %g Pa at %g K", c->name, absolute, c->temperature);
    return status_ok();
}

/* ---- all of it ---- */

int mpm_part_entries(const mpm_scene *s, mpm_part part)
{
    switch (part) {
    case MPM_PART_SCENE: return 1;
    case MPM_PART_BODY: return s->bodies;
    case MPM_PART_PAIR: return s->pairs;
    case MPM_PART_REFINE: return s->refines;
    case MPM_PART_PROBE: return s->probes;
    case MPM_PART_CAVITY: return s->cavities;
    case MPM_PARTS: break;
    }
    return 0;
}

static status check_entry(const mpm_scene *s, mpm_refused *at)
{
    switch (at->part) {
    case MPM_PART_SCENE: return check_whole(s, &at->key);
    case MPM_PART_BODY: return check_body(s, at->entry, &at->key);
    case MPM_PART_PAIR: return check_pair(s, at->entry, &at->key);
    case MPM_PART_REFINE: return mpm_refine_check(&s->refine[at->entry], s->bodies);
    case MPM_PART_PROBE: return check_probe(s, at->entry, &at->key);
    case MPM_PART_CAVITY: return check_cavity(s, at->entry, &at->key);
    case MPM_PARTS: break;
    }
    return status_ok();
}

status mpm_check_entry(const mpm_scene *s, mpm_part part, int entry, const char **key)
{
    mpm_refused at = { part, entry, NULL };
    mpm_scene whole = *s; /* borrows its arrays */
    mpm_scene_levels_fill(&whole);
    const status checked = check_entry(&whole, &at);
    *key = at.key;
    return checked;
}

status mpm_check(const mpm_scene *s, mpm_refused *at)
{
    for (mpm_part part = MPM_PART_SCENE; part < MPM_PARTS; part++)
        for (int i = 0; i < mpm_part_entries(s, part); i++) {
            *at = (mpm_refused){ part, i, NULL };
            TRY(mpm_check_entry(s, part, i, &at->key));
        }
    *at = mpm_not_refused;
    return status_ok();
}
