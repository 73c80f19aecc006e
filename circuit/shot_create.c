/* SPDX-License-Identifier: BSD-3-Clause */
/* Making a shot from its configuration. */
#include "circuit/shot_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const void *supply_item(const circuit_supply_list *list, const supply_kind *kind, int k)
{
    return (const char *)list->item + (size_t)k * kind->size;
}

/* ---- checks ---- */

static status supply_check(const circuit_shot_config *c, const supply_kind *kind, const void *p, const char *where)
{
    char copy[SUPPLY_BYTES];
    memcpy(copy, p, kind->size);
    circuit_supply_common at = circuit_supply_common_of(p);
    if (isnan(at.fire_at)) at.fire_at = 0.0; /* never is a value too */
    memcpy(copy, &at, sizeof at);
    TRY(base_params_check(kind->params, copy, where));
    CHECK(at.position < c->barrel.length, STATUS_BAD_INPUT,
          "%s.position = %g m: must be less than barrel.length = %g m", where, at.position, c->barrel.length);
    return kind->check ? kind->check(p, where) : status_ok();
}

static status supplies_check(const circuit_shot_config *c)
{
    int groups = 0;
    for (int s = 0; s < CIRCUIT_SUPPLY_KINDS; s++) {
        const circuit_supply_list *list = &c->supplies[s];
        for (int k = 0; k < list->n; k++, groups++) {
            char where[48];
            snprintf(where, sizeof where, "%s[%d]", circuit_supply_sections[s], k);
            TRY(supply_check(c, circuit_supply_kinds[s], supply_item(list, circuit_supply_kinds[s], k), where));
        }
    }
    CHECK(groups > 0, STATUS_BAD_INPUT, "nothing drives the shot: give at least one group, such as a bank of modules");
    return status_ok();
}

static status armature_check(const circuit_shot_armature *a)
{
    CHECK(a->gas_density == 0.0 || a->gas_pressure > 0.0, STATUS_BAD_INPUT,
          "armature.gas_pressure = 0 Pa with armature.gas_density = %g kg/m^3: give both or none", a->gas_density);
    const bool film = a->friction_law == CIRCUIT_SHOT_FRICTION_FILM;
    CHECK(!film || a->wear_fraction > 0.0, STATUS_BAD_INPUT,
          "armature.friction_law film needs armature.wear_fraction above 0: the fraction of the heat that melts makes "
          "the film");
    CHECK(!a->velocity_skin || a->contact_voltage > 0.0, STATUS_BAD_INPUT,
          "armature.velocity_skin needs armature.contact_voltage above 0 V: nothing else spreads the current");
    CHECK(a->wear_fraction <= a->heat_share, STATUS_BAD_INPUT,
          "armature.wear_fraction = %g: must be at most heat_share = %g, for what melts has entered the armature",
          a->wear_fraction, a->heat_share);
    const bool melts = a->wear_fraction > 0.0 || !isnan(a->leg_area) || !isnan(a->throat_area);
    CHECK(!melts || a->melting_temperature > a->initial_temperature, STATUS_BAD_INPUT,
          "armature.initial_temperature = %g K: must be below melting_temperature = %g K", a->initial_temperature,
          a->melting_temperature);
    const double cold = a->initial_temperature - 293.15;
    CHECK(1.0 + a->resistivity_coefficient * cold > 0.0, STATUS_BAD_INPUT,
          "armature.resistivity_coefficient = %g 1/K: leaves no resistivity at initial_temperature = %g K",
          a->resistivity_coefficient, a->initial_temperature);
    return status_ok();
}

status circuit_shot_check(const circuit_shot_config *c)
{
    TRY(base_params_check(circuit_shot_barrel_params, &c->barrel, "barrel"));
    TRY(base_params_check(circuit_shot_armature_params, &c->armature, "armature"));
    TRY(base_params_check(circuit_shot_options_params, &c->options, "options"));
    CHECK(c->barrel.start < c->barrel.length, STATUS_BAD_INPUT,
          "barrel.start = %g m: must be less than barrel.length = %g m", c->barrel.start, c->barrel.length);
    TRY(armature_check(&c->armature));
    TRY(supplies_check(c));
    for (int k = 0; k < c->n_sites; k++) {
        CHECK(c->sites[k] > c->barrel.start && c->sites[k] <= c->barrel.length, STATUS_BAD_INPUT,
              "sites[%d].position = %g m: must lie beyond barrel.start = %g m, at barrel.length = %g m at most", k,
              c->sites[k], c->barrel.start, c->barrel.length);
    }
    return status_ok();
}

/* ---- groups and feeds ---- */

/* The feed at a position, made where there is none; feeds ascend. */
static status feed_at(shot_model *m, double position)
{
    int f = 0;
    while (f < m->feeds && m->feed[f] < position) f++;
    if (f < m->feeds && m->feed[f] == position) return status_ok();
    CHECK(m->feeds < SHOT_MAX_FEEDS, STATUS_BAD_INPUT,
          "supplies join the rails, and rail.slices end, at more than %d positions", SHOT_MAX_FEEDS);
    memmove(m->feed + f + 1, m->feed + f, (size_t)(m->feeds - f) * sizeof *m->feed);
    m->feed[f] = position;
    m->feeds++;
    return status_ok();
}

static status group_fill(supply_group *g, const supply_kind *kind, const void *p, void *memory)
{
    memcpy(memory, p, kind->size);
    *g = (supply_group){ .kind = kind, .p = memory, .at = circuit_supply_common_of(p), .gate = GATE_UNFIRED };
    g->n = g->at.count;
    g->unknowns = kind->unknowns(p);
    g->reverses = kind->reverses && kind->reverses(p);
    g->pulses = kind->pulses ? kind->pulses(p) - 1 : 0;
    return kind->prepare ? kind->prepare(g) : status_ok();
}

static status groups_fill(circuit_shot *s, const circuit_shot_config *c)
{
    shot_model *m = &s->model;
    m->feeds = 1; /* the breech, at 0 */
    for (int kind = 0, k = 0; kind < CIRCUIT_SUPPLY_KINDS; kind++) {
        for (int j = 0; j < c->supplies[kind].n; j++, k++) {
            supply_group *g = &m->groups[k];
            char *memory = (char *)s->supplies + (size_t)k * SUPPLY_BYTES;
            TRY(group_fill(g, circuit_supply_kinds[kind],
                           supply_item(&c->supplies[kind], circuit_supply_kinds[kind], j), memory));
            g->first = m->start;
            m->start += g->unknowns;
            TRY(feed_at(m, g->at.position));
        }
    }
    for (int k = 1; k < c->rails.slices; k++) TRY(feed_at(m, k * c->barrel.length / c->rails.slices));
    for (int k = 0; k < m->n; k++) {
        while (m->feed[m->groups[k].feed] != m->groups[k].at.position) m->groups[k].feed++;
    }
    while (m->reached < m->feeds && m->feed[m->reached] <= c->barrel.start) m->reached++;
    return status_ok();
}

/* ---- the rest of the model ---- */

static void model_fill(circuit_shot *s, const circuit_shot_config *c)
{
    shot_model *m = &s->model;
    const circuit_shot_armature *a = &c->armature;
    m->barrel = c->barrel;
    m->armature = c->armature;
    m->phase = CIRCUIT_SHOT_HELD;
    m->next_site = INFINITY;
    m->scale = s->scale;
    m->shunt = !isnan(c->barrel.shunt_resistance);
    m->faces = c->rails.count;
    m->contact_area = a->contact_length * (isnan(a->contact_width) ? c->rails.height : a->contact_width);
    m->bore_area = isnan(a->bore_area) ? c->rails.separation * c->rails.height : a->bore_area;
    m->sound_speed = a->gas_density > 0.0 ? sqrt(a->gas_gamma * a->gas_pressure / a->gas_density) : 0.0;
    m->wear_heat = a->specific_heat * (a->melting_temperature - a->initial_temperature) + a->latent_heat;
    m->film = (melt_film){ .viscosity = a->film_viscosity,
                           .density = a->density,
                           .melting = a->density * m->wear_heat,
                           .length = a->contact_length,
                           .share = a->wear_fraction };
}

/* Scales for the absolute tolerances: what each quantity could reach. */
static void scales_fill(circuit_shot *s)
{
    shot_model *m = &s->model;
    double E = 0.0, I = 0.0, V = 1.0;
    bool reverses = m->shunt;
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        supply_scale scale;
        g->kind->start(g->p, circuit_shot_y(s) + g->first, &scale);
        memcpy(s->scale + g->first, scale.y, (size_t)g->unknowns * sizeof(double));
        E += g->n * scale.energy;
        I += g->n * scale.y[0];
        V = fmax(V, scale.voltage);
        reverses = reverses || g->reverses;
    }
    m->knee = reverses ? 1e-5 * I : 0.0;
    double *z = s->scale + m->start;
    const double v0 = m->armature.velocity;
    for (int j = 0; j < m->feeds; j++) z[circuit_shot_feed_unknown(j)] = V;
    for (int j = Y_COIL; j < Y_SUMS; j++) z[j] = fmax(E + 0.5 * m->armature.mass * v0 * v0, 1.0);
    z[Y_X] = m->barrel.length;
    z[Y_V] = fmax(fmax(1.0, v0), 0.1 * sqrt(2.0 * E / m->armature.mass));
    z[Y_MASS] = m->armature.mass;
    z[Y_SHUNT] = I;
    z[Y_ACTION] = 1e-3 * I * I;
    const int first = Y_COUNT + m->feeds - 1, size = circuit_rails_memory_size(&m->rails);
    for (int f = 0; f < m->feeds; f++)
        circuit_rails_memory_scale(&m->rails, m->barrel.length, I, z[Y_RAILS], z + first + f * size);
}

static int by_position(const void *a, const void *b)
{
    const shot_place *p = a, *q = b;
    if (p->position != q->position) return p->position < q->position ? -1 : 1;
    return p->index - q->index;
}

static int groups_of(const circuit_shot_config *c)
{
    int n = 0;
    for (int s = 0; s < CIRCUIT_SUPPLY_KINDS; s++) n += c->supplies[s].n;
    return n;
}

static status memory_take(circuit_shot *s, const circuit_shot_config *c)
{
    const size_t n = (size_t)groups_of(c), sites = (size_t)(c->n_sites > 0 ? c->n_sites : 0);
    s->model.n = (int)n;
    s->n_sites = (int)sites;
    s->capacity = (int)(4 * n + sites + 8);
    s->model.groups = calloc(n, sizeof *s->model.groups);
    s->supplies = calloc(n, SUPPLY_BYTES);
    s->sites = calloc(sites + 1, sizeof *s->sites);
    s->queue = calloc((size_t)s->capacity, sizeof *s->queue);
    s->forced = calloc(3 * n, sizeof *s->forced);
    CHECK(s->model.groups && s->supplies && s->sites && s->queue && s->forced, STATUS_MEMORY,
          "out of memory for a shot of %zu groups", n);
    for (int k = 0; k < s->n_sites; k++) s->sites[k] = (shot_place){ c->sites[k], k };
    qsort(s->sites, sites, sizeof *s->sites, by_position);
    return status_ok();
}

/* More than these is a switch that chatters.  A module that rings opens and closes its crowbar once a period, four
 * rises: that often, four times over, for the rings of modules side by side are faster than their own. */
static int switchings_allowed(const circuit_shot *s)
{
    static const double MOST = 1e6, BY_ARMATURE = 1000.0;
    const shot_model *m = &s->model;
    double allowed = BY_ARMATURE + 8.0 * m->n;
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        allowed += 4.0 * (g->kind->stays ? BY_ARMATURE : g->pulses);
        if (g->reverses) allowed += 2.0 * s->options.max_time / g->kind->rise(g->p);
    }
    return (int)fmin(allowed, MOST);
}

static status solver_take(circuit_shot *s)
{
    shot_model *m = &s->model;
    const int n = circuit_shot_unknowns(m);
    s->scale = calloc((size_t)n, sizeof *s->scale);
    s->later = calloc((size_t)n * 2, sizeof *s->later);
    CHECK(s->scale && s->later, STATUS_MEMORY, "out of memory for a circuit of %d unknowns", n);
    TRY(circuit_arrow_create(m->n, n - m->start, Y_SUMS, &s->matrix));
    s->switchings_limit = switchings_allowed(s);
    for (int k = 0; k < m->n; k++) s->matrix->size[k] = m->groups[k].unknowns;
    const dae_problem problem = { .n = n,
                                  .n_roots = ROOT_GROUPS + 2 * m->n,
                                  .residual = circuit_shot_residual,
                                  .roots = circuit_shot_roots,
                                  .jacobian = circuit_shot_jacobian,
                                  .model = m,
                                  .matrix = s->matrix };
    return circuit_dae_create(&problem, &s->solver);
}

static void state_fill(circuit_shot *s, const circuit_shot_config *c)
{
    shot_model *m = &s->model;
    double *z = circuit_shot_z(s);
    z[Y_X] = c->barrel.start;
    z[Y_V] = c->armature.velocity;
    z[Y_MASS] = c->armature.mass;
    s->rails = c->rails;
    s->rail_temperature = c->rails.initial_temperature;
    s->armature_temperature = c->armature.initial_temperature;
    /* Free at once where nothing holds it: friction then starts at zero with the current, below the force. */
    const bool loose = c->armature.friction_dry * c->armature.preload == 0.0 &&
                       circuit_shot_push(m, 0.0, 1.0) > m->faces * c->armature.friction_dry * c->armature.spreading;
    if (z[Y_V] > 0.0 || loose) m->phase = CIRCUIT_SHOT_MOVING;
    m->next_site = s->n_sites > 0 ? s->sites[0].position : INFINITY;
    circuit_shot_limits_start(s);
    circuit_shot_lead_face_start(s);
    const circuit_shot_ledger l = circuit_shot_ledger_now(s);
    s->start_energy = l.capacitors + l.coils + l.cables + l.rotors + l.kinetic;
    s->result = (circuit_shot_summary){
        .muzzle_velocity = NAN, .muzzle_time = NAN, .muzzle_energy = NAN, .efficiency = NAN, .exit_current = NAN
    };
}

static status fill(circuit_shot *s, const circuit_shot_config *c)
{
    s->options = c->options;
    TRY(circuit_shot_rails_fit(c, &s->model.rails));
    TRY(memory_take(s, c));
    TRY(groups_fill(s, c));
    TRY(solver_take(s));
    model_fill(s, c);
    scales_fill(s);
    state_fill(s, c);
    TRY(circuit_shot_rail_sheet_start(s));
    return circuit_shot_heat_start(s, c);
}

status circuit_shot_create(const circuit_shot_config *config, circuit_shot **out)
{
    *out = NULL;
    TRY(circuit_shot_check(config));
    circuit_shot *s = calloc(1, sizeof *s);
    CHECK(s, STATUS_MEMORY, "out of memory for the shot");
    const status st = fill(s, config);
    if (st.code != STATUS_OK) {
        circuit_shot_free(s);
        return st;
    }
    *out = s;
    return st;
}

void circuit_shot_free(circuit_shot *s)
{
    if (!s) return;
    circuit_dae_free(s->solver);
    circuit_arrow_free(s->matrix);
    for (int k = 0; s->model.groups && k < s->model.n; k++) {
        supply_group *g = &s->model.groups[k];
        if (g->kind && g->kind->release) g->kind->release(g);
    }
    free(s->model.groups);
    free(s->supplies);
    free(s->sites);
    free(s->queue);
    free(s->scale);
    free(s->later);
    free(s->forced);
    free(s);
}
