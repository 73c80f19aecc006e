/* SPDX-License-Identifier: BSD-3-Clause */
/* What a shot leaves in its rails: heat by place, as a rise of temperature once it has evened out over the section. */
#include "circuit/shot_internal.h"

static shot_heat_instant instant(const circuit_shot *s, const shot_drive *d)
{
    const double *z = circuit_shot_z(s);
    shot_heat_instant now = { .t = s->t, .x = z[Y_X], .v = z[Y_V], .shunt = z[Y_SHUNT] };
    now.contact = (1.0 - s->model.armature.heat_share) * (z[Y_FRICTION] + z[Y_CONTACT]);
    for (int f = 0; f < s->model.reached; f++) now.I[f] = d->I[f] + (f > 0 ? now.I[f - 1] : 0.0);
    return now;
}

status circuit_shot_heat_start(circuit_shot *s, const circuit_shot_config *c)
{
    circuit_rail_section section;
    TRY(circuit_rails_section(&c->rails, &section));
    const shot_drive d = circuit_shot_drive_now(s);
    circuit_rails_heat_start(&s->heat, c->barrel.length);
    s->rail_capacity = c->rails.heat_capacity * section.rails * circuit_section_metal_area(&section);
    s->heat_until = instant(s, &d);
    return status_ok();
}

void circuit_shot_heat_update(circuit_shot *s, const shot_drive *d)
{
    const shot_model *m = &s->model;
    const shot_heat_instant a = s->heat_until, b = instant(s, d);
    for (int f = 0; f < m->reached; f++) {
        const double end = f + 1 < m->feeds ? m->feed[f + 1] : m->barrel.length;
        const circuit_rails_instant from = { a.t, a.x, a.v, a.I[f] }, to = { b.t, b.x, b.v, b.I[f] };
        circuit_rails_heat_carry(&s->heat, &m->rails, circuit_shot_rails_warming(m, f, circuit_shot_z(s)), m->feed[f],
                                 end, &from, &to);
    }
    if (m->shunt) circuit_rails_heat_ahead(&s->heat, &m->rails, b.x, b.t - a.t, a.shunt, b.shunt);
    circuit_rails_heat_slide(&s->heat, a.x, b.x, b.contact - a.contact);
    s->heat_until = b;
}

void circuit_shot_rail_rise(const circuit_shot *s, double rise[CIRCUIT_SHOT_PIECES])
{
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) rise[k] = s->heat.heat[k] / s->rail_capacity;
}
