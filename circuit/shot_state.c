/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading a shot: where its energy is, its state, its summary. */
#include "circuit/shot_internal.h"

#include <assert.h>
#include <math.h>

shot_drive circuit_shot_drive_now(const circuit_shot *s)
{
    return circuit_shot_drive_at(&s->model, s->t, circuit_shot_y(s));
}

shot_forces circuit_shot_forces_now(const circuit_shot *s)
{
    const shot_drive d = circuit_shot_drive_now(s);
    return circuit_shot_forces_at(&s->model, &d, circuit_shot_z(s));
}

static void stores_add(const circuit_shot *s, circuit_shot_ledger *l)
{
    for (int k = 0; k < s->model.n; k++) {
        const supply_group *g = &s->model.groups[k];
        double e[STORE_PLACES] = { 0.0 };
        g->kind->stored(g, circuit_shot_y(s) + g->first, e);
#define SUPPLY_STORED(place, member, column, text) l->member += g->n * e[STORE_##place];
#include "circuit/ledger.def"
    }
}

circuit_shot_ledger circuit_shot_ledger_now(const circuit_shot *s)
{
    const double *z = circuit_shot_z(s);
    const shot_model *m = &s->model;
    const shot_drive d = circuit_shot_drive_now(s);
    circuit_shot_ledger l = { .start = s->start_energy };
    stores_add(s, &l);
    l.rails_field = circuit_shot_rails_field(m, &d, z);
    l.kinetic = m->phase == CIRCUIT_SHOT_LEFT ? s->exit_kinetic : 0.5 * z[Y_MASS] * z[Y_V] * z[Y_V];
#define INTEGRAL(place, member, column, text) l.member = z[Y_##place];
#define GIVEN(place, member, column, text) l.member = z[Y_##place];
#include "circuit/ledger.def"
    l.jumps = s->energy_jumps;
    l.momentum_jumps = s->momentum_jumps;
    l.mass_jumps = s->mass_jumps;
    double stored = 0.0, spent = 0.0, given = l.start;
#define STORED(member, column, text) stored += l.member;
#define SPENT(member, column, text) spent += l.member;
#define GIVEN(place, member, column, text) given += l.member;
#include "circuit/ledger.def"
    l.energy_error = given > 0.0 ? (stored + spent - given) / given : 0.0;
    return l;
}

/* What belongs to the contact, while there is one. */
static void contact_fill(const circuit_shot *s, const shot_forces *f, circuit_shot_state *st)
{
    st->armature_temperature = circuit_shot_face_temperature(s, f);
    st->film_thickness = circuit_shot_film_thickness(s, f, st);
    st->film_temperature = circuit_shot_film_temperature(s, f, st);
    st->contact_spread = s->model.armature.contact_length / circuit_shot_crowding(&s->model, f, st->v);
}

/* What carries the current then is an arc or a shunt: the contact keeps what it had. */
static void contact_keep(const circuit_shot_state *at_exit, circuit_shot_state *st)
{
    st->armature_temperature = at_exit->armature_temperature;
    st->film_thickness = at_exit->film_thickness;
    st->film_temperature = at_exit->film_temperature;
    st->contact_spread = at_exit->contact_spread;
}

circuit_shot_state circuit_shot_now(const circuit_shot *s)
{
    const double *z = circuit_shot_z(s);
    const shot_model *m = &s->model;
    const shot_drive d = circuit_shot_drive_now(s);
    const shot_forces f = circuit_shot_forces_at(m, &d, z);
    circuit_shot_state st = { .t = s->t, .x = z[Y_X], .v = z[Y_V], .current = f.I, .breech_voltage = z[Y_BREECH] };
    st.a = m->phase == CIRCUIT_SHOT_MOVING ? f.net / z[Y_MASS] : 0.0;
    st.shunt_current = f.shunt;
    st.force = f.force;
    st.friction = f.friction;
    st.drag = f.drag;
    st.friction_coefficient = f.mu;
    st.contact_force = f.contact;
    st.contact_pressure = f.contact / m->contact_area;
    st.action = z[Y_ACTION];
    st.mass = z[Y_MASS];
    st.phase = m->phase;
    st.muzzle_voltage = f.voltage;
    st.rail_temperature = s->rail_temperature;
    st.ledger = circuit_shot_ledger_now(s);
    st.lead_face_temperature = circuit_shot_lead_face_temperature(s);
    if (m->phase == CIRCUIT_SHOT_LEFT) {
        contact_keep(&s->at_exit, &st);
    } else {
        contact_fill(s, &f, &st);
    }
    st.rail_behind_temperature = circuit_shot_rail_behind_temperature(s, &f, &st);
    st.rail_flux = circuit_shot_rail_flux(s, &f, &st);
    st.rail_sheet = circuit_shot_rail_sheet(s, &st);
    return st;
}

int circuit_shot_module_count(const circuit_shot *s)
{
    return s->model.n;
}

double circuit_shot_module_current(const circuit_shot *s, int group)
{
    assert(group >= 0 && group < s->model.n);
    return circuit_shot_y(s)[s->model.groups[group].first];
}

double circuit_shot_module_voltage(const circuit_shot *s, int group)
{
    assert(group >= 0 && group < s->model.n);
    const supply_group *g = &s->model.groups[group];
    return g->kind->voltage(g, circuit_shot_y(s) + g->first);
}

/* A current that still rises may yet move an armature that stands; one that falls will not. */
static bool time_ran_out(const circuit_shot *s, const circuit_shot_state *now)
{
    if (s->t + SHOT_INSTANT < s->options.max_time || now->phase == CIRCUIT_SHOT_LEFT) return false;
    const bool moves = now->phase == CIRCUIT_SHOT_MOVING && now->v > 0.0;
    return moves || (now->current != 0.0 && fabs(now->current) >= s->result.peak_current);
}

circuit_shot_summary circuit_shot_result(const circuit_shot *s)
{
    const circuit_shot_state now = circuit_shot_now(s);
    circuit_shot_summary r = s->result;
    r.energy_error = circuit_shot_ledger_now(s).energy_error;
    r.action = s->model.phase == CIRCUIT_SHOT_LEFT ? s->exit_action : circuit_shot_z(s)[Y_ACTION];
    r.end_time = now.t;
    r.end_position = now.x;
    r.end_velocity = now.v;
    r.time_ran_out = time_ran_out(s, &now);
    return r;
}
