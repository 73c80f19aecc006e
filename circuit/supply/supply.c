/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of supplies, and what is common to all of them. */
#include "circuit/supply/supply_kind.h"

#include <string.h>

#define SUPPLY(kind, type, section, lists, text)                                              \
    extern const supply_kind circuit_kind_##kind;                                             \
    _Static_assert(offsetof(type, count) == offsetof(circuit_supply_common, count) &&         \
                       offsetof(type, fire_at) == offsetof(circuit_supply_common, fire_at) && \
                       offsetof(type, position) == offsetof(circuit_supply_common, position), \
                   "the struct of " #kind " begins with SUPPLY_COMMON");                      \
    _Static_assert(sizeof(type) <= SUPPLY_BYTES, "SUPPLY_BYTES hold the struct of " #kind);
#include "circuit/supply/supply.def"
#undef SUPPLY

#define SUPPLY(kind, type, section, lists, text) &circuit_kind_##kind,
const supply_kind *const circuit_supply_kinds[] = {
#include "circuit/supply/supply.def"
};
#undef SUPPLY

#define SUPPLY(kind, type, section, lists, text) #section,
const char *const circuit_supply_sections[] = {
#include "circuit/supply/supply.def"
    NULL
};
#undef SUPPLY

size_t circuit_supply_size(circuit_supply_kind_index kind)
{
    return circuit_supply_kinds[kind]->size;
}

void circuit_supply_recharge(circuit_supply_kind_index kind, void *item, int n, double factor)
{
    const supply_kind *k = circuit_supply_kinds[kind];
    for (int i = 0; i < n; i++) {
        char *unit = (char *)item + (size_t)i * k->size;
        *(double *)(void *)(unit + k->charge) *= factor;
        if (k->battery) *(double *)(void *)(unit + k->battery) *= factor;
    }
}

circuit_supply_common circuit_supply_common_of(const void *p)
{
    circuit_supply_common at;
    memcpy(&at, p, sizeof at);
    return at;
}

bool circuit_supply_conducts(const supply_group *g)
{
    return g->gate == GATE_ON;
}

bool circuit_supply_blocks(const supply_group *g)
{
    return circuit_supply_conducts(g) && !g->reverses && !g->kind->source;
}

bool circuit_supply_algebraic(const supply_group *g, int j)
{
    return g->kind->algebraic && g->kind->algebraic(g, j);
}

void circuit_supply_rates(const supply_group *g, double t, const double *y, double V, double *d, supply_flow *f)
{
    *f = (supply_flow){ .push = 0.0 };
    const int n = g->unknowns;
    for (int j = 0; j < n; j++) d[j] = 0.0;
    if (g->gate == GATE_BLOCKED) return;
    g->kind->flow(g, t, y, f);
    for (int j = 1; j < n; j++) d[j] = f->rate[j];
    if (!circuit_supply_conducts(g)) return;
    d[0] = circuit_supply_algebraic(g, 0) ? f->rate[0] : f->push - f->pull * V;
}

double circuit_supply_stage_root(const supply_group *g, double t, const double *y)
{
    return g->kind->root && g->gate != GATE_BLOCKED ? g->kind->root(g, t, y) : 1.0;
}
