/* Driving a shot: switchings, events, summary.  The equations are in circuit/shot_model.c. */
#include "circuit/shot.h"

#include "circuit/dae.h"
#include "circuit/shot_model.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Times closer than this are one instant [s]. */
static const double INSTANT = 1e-12;

typedef struct {
    shot_event_kind kind;
    int index;
} pending;

typedef struct {
    double position;
    int index; /* in the order given */
} shot_place;

struct shot {
    shot_model model;
    shot_options options;
    dae *solver;
    shot_place *sites; /* by position */
    pending *queue;    /* events not yet handed out: queue[head] .. queue[tail - 1] */
    double *scale;     /* of every unknown */
    bool *forced;      /* groups that a root says conduct now */
    int n_sites, passed, head, tail, capacity;
    int switchings, switchings_limit;
    bool restart, started;
    double t, rail_temperature, armature_temperature;
    double start_energy, exit_action;
    double momentum_jumps, mass_jumps, energy_jumps;
    double exit_kinetic, last_current, last_slope, last_t;
    shot_summary result;
};

static double *unknowns(const shot *s)
{
    return dae_y(s->solver);
}

static double *tail_of(const shot *s)
{
    return dae_y(s->solver) + 2 * s->model.n;
}

/* ---- reading ---- */

static shot_ledger ledger_of(const shot *s)
{
    const double *y = unknowns(s), *z = tail_of(s);
    const shot_model *m = &s->model;
    shot_ledger l = { .start = s->start_energy };
    for (int k = 0; k < m->n; k++) {
        const shot_group *g = &m->groups[k];
        const double u = shot_group_voltage(g, y[2 * k]), i = y[2 * k + 1];
        l.capacitors += 0.5 * g->n * g->p.capacitance * u * u;
        l.coils += 0.5 * g->n * g->p.inductance * i * i;
        l.cables += 0.5 * g->n * g->p.cable_inductance * i * i;
    }
    l.rails_field = shot_rails_flow(m, y).field;
    l.kinetic = m->phase == SHOT_LEFT ? s->exit_kinetic : 0.5 * z[Y_MASS] * z[Y_V] * z[Y_V];
    l.coil_heat = z[Y_COIL];
    l.cable_heat = z[Y_CABLE];
    l.crowbar_heat = z[Y_CROWBAR];
    l.rails_heat = z[Y_RAILS];
    l.armature_heat = z[Y_ARMATURE];
    l.contact_heat = z[Y_CONTACT];
    l.friction = z[Y_FRICTION];
    l.drag = z[Y_DRAG];
    l.muzzle = z[Y_MUZZLE];
    l.wear = z[Y_WEAR];
    l.jumps = s->energy_jumps;
    l.momentum_jumps = s->momentum_jumps;
    l.mass_jumps = s->mass_jumps;
    const double stored = l.capacitors + l.coils + l.cables + l.rails_field + l.kinetic;
    const double spent = l.coil_heat + l.cable_heat + l.crowbar_heat + l.rails_heat + l.armature_heat + l.contact_heat +
                         l.friction + l.drag + l.muzzle + l.wear + l.jumps;
    l.energy_error = l.start > 0.0 ? (stored + spent - l.start) / l.start : 0.0;
    return l;
}

/* Half-space heated by flux q that has brought E per area: T = T_0 + 2 sqrt(q E/pi)/sqrt(k rho c); exact for a constant
 * flux, at most melting                                                                    (C-7) [K] */
static double face_temperature(const shot *s, const shot_state *st)
{
    const shot_armature *a = &s->model.armature;
    const double share = a->heat_share / (2.0 * s->model.contact_area);
    const double q = share * (st->friction * st->v + a->contact_voltage * st->current);
    const double E = share * (st->ledger.friction + st->ledger.contact_heat);
    const double rise = 2.0 * sqrt(fmax(q * E, 0.0) / 3.14159265358979323846) /
                        sqrt(a->thermal_conductivity * a->density * a->specific_heat);
    return fmin(s->armature_temperature + rise, fmax(a->melting_temperature, s->armature_temperature));
}

/* The rails' heat over x I^2, direct current's where there is none to see. */
static double resistance_gradient(const shot *s, double I)
{
    const double loss = tail_of(s)[Y_X] * I * I, direct = s->model.rails.ladder.R_dc;
    return loss > 0.0 ? shot_rails_flow(&s->model, unknowns(s)).heat / loss : direct;
}

shot_state shot_now(const shot *s)
{
    const double *z = tail_of(s);
    const shot_model *m = &s->model;
    const shot_forces f = shot_forces_at(m, unknowns(s));
    shot_state st = { .t = s->t, .x = z[Y_X], .v = z[Y_V], .current = f.I, .breech_voltage = z[Y_BREECH] };
    st.a = m->phase == SHOT_MOVING ? f.net / z[Y_MASS] : 0.0;
    st.force = f.force;
    st.friction = f.friction;
    st.drag = f.drag;
    st.friction_coefficient = f.mu;
    st.contact_force = f.contact;
    st.contact_pressure = f.contact / m->contact_area;
    st.action = z[Y_ACTION];
    st.mass = z[Y_MASS];
    st.phase = m->phase;
    if (m->phase == SHOT_LEFT) {
        st.muzzle_voltage = f.I > 0.0 ? m->barrel.muzzle_voltage + m->barrel.muzzle_resistance * f.I : 0.0;
    } else {
        st.muzzle_voltage = f.I > 0.0 ? m->armature.contact_voltage + m->armature.resistance * f.I : 0.0;
    }
    st.inductance_gradient = rails_force_gradient(&m->rails, st.phase == SHOT_HELD ? 0.0 : st.v);
    st.resistance_gradient = resistance_gradient(s, f.I);
    st.rail_temperature = s->rail_temperature;
    st.ledger = ledger_of(s);
    st.armature_temperature = face_temperature(s, &st);
    return st;
}

int shot_module_count(const shot *s)
{
    return s->model.n;
}

double shot_module_current(const shot *s, int group)
{
    assert(group >= 0 && group < s->model.n);
    return unknowns(s)[2 * group + 1];
}

double shot_module_voltage(const shot *s, int group)
{
    assert(group >= 0 && group < s->model.n);
    return shot_group_voltage(&s->model.groups[group], unknowns(s)[2 * group]);
}

shot_summary shot_result(const shot *s)
{
    shot_summary r = s->result;
    r.energy_error = ledger_of(s).energy_error;
    r.action = s->model.phase == SHOT_LEFT ? s->exit_action : tail_of(s)[Y_ACTION];
    return r;
}

static bool any_current(const shot *s)
{
    for (int k = 0; k < s->model.n; k++) {
        if (shot_group_conducts(&s->model.groups[k])) return true;
    }
    return false;
}

static double next_firing(const shot *s)
{
    double t = INFINITY;
    for (int k = 0; k < s->model.n; k++) {
        const shot_group *g = &s->model.groups[k];
        if (g->mode == GROUP_UNFIRED) t = fmin(t, isnan(g->p.fire_at) ? INFINITY : g->p.fire_at);
    }
    return t;
}

bool shot_done(const shot *s)
{
    const bool in_motion = s->model.phase == SHOT_MOVING && tail_of(s)[Y_V] > 0.0;
    return s->started && s->head == s->tail && !in_motion && !any_current(s) && next_firing(s) > s->options.max_time;
}

/* ---- switchings ---- */

static void announce(shot *s, shot_event_kind kind, int index)
{
    assert(s->tail < s->capacity);
    s->queue[s->tail++] = (pending){ kind, index };
}

static void switched(shot *s, shot_event_kind kind, int index)
{
    s->switchings++;
    s->restart = true;
    announce(s, kind, index);
}

static void group_crowbar(shot *s, int k)
{
    shot_group *g = &s->model.groups[k];
    double *y = unknowns(s) + 2 * k;
    const double R_d = g->p.crowbar_resistance;
    y[0] = R_d > 0.0 ? fmin(fmax(-(y[0] + g->p.crowbar_drop) / R_d, 0.0), y[1]) : y[1];
    g->mode = GROUP_CROWBAR;
    switched(s, SHOT_CROWBAR, k);
}

static void group_block(shot *s, int k)
{
    shot_group *g = &s->model.groups[k];
    double *y = unknowns(s) + 2 * k;
    y[0] = shot_group_voltage(g, y[0]);
    y[1] = 0.0;
    g->mode = GROUP_BLOCKED;
    switched(s, SHOT_BLOCKED, k);
}

/* Groups that are due try to conduct together; whichever would carry a negative current then waits.  Taking one away only
 * raises the breech's voltage, so the loop ends after at most n rounds with the one solution. */
static void groups_try(shot *s, const bool *before)
{
    shot_model *m = &s->model;
    for (bool changed = true; changed;) {
        changed = false;
        const double V = shot_breech_voltage(m, unknowns(s));
        for (int k = 0; k < m->n; k++) {
            shot_group *g = &m->groups[k];
            const double u = unknowns(s)[2 * k];
            const bool fresh = g->mode == GROUP_ON && !before[k];
            if (fresh && !s->forced[k] && u - V <= 1e-9 * fmax(fabs(u), 1.0)) {
                g->mode = GROUP_WAITING;
                changed = true;
            }
        }
    }
}

static void groups_fire(shot *s)
{
    shot_model *m = &s->model;
    bool *before = s->forced + m->n, *waiting = s->forced + 2 * m->n;
    for (int k = 0; k < m->n; k++) {
        shot_group *g = &m->groups[k];
        before[k] = g->mode == GROUP_ON;
        waiting[k] = g->mode == GROUP_WAITING;
        const bool due = g->mode == GROUP_UNFIRED && g->p.fire_at <= s->t + INSTANT;
        if (due || waiting[k]) g->mode = GROUP_ON;
    }
    groups_try(s, before);
    for (int k = 0; k < m->n; k++) {
        const group_mode now = m->groups[k].mode;
        if (now == GROUP_ON && !before[k]) switched(s, SHOT_FIRED, k);
        if (now == GROUP_WAITING && !waiting[k]) switched(s, SHOT_WAITING, k);
        s->forced[k] = false;
    }
}

/* Crowbars and blocking that are due now, whether a root was reported for them or for a twin at the same instant. */
static void groups_settle(shot *s, const int *found)
{
    shot_model *m = &s->model;
    for (int k = 0; k < m->n; k++) {
        const int *root = found ? found + ROOT_GROUPS + 2 * k : NULL;
        shot_group *g = &m->groups[k];
        double *y = unknowns(s) + 2 * k;
        if (g->mode == GROUP_WAITING && root && root[0]) s->forced[k] = true;
        const bool ends = y[1] <= 1e-12 * s->scale[2 * k + 1] && dae_yp(s->solver)[2 * k + 1] < 0.0;
        if (shot_group_conducts(g) && ((root && root[1]) || ends)) group_block(s, k);
        const double floor = -g->p.crowbar_drop + 1e-12 * s->scale[2 * k];
        if (g->mode == GROUP_ON && ((root && root[0]) || y[0] <= floor)) group_crowbar(s, k);
    }
}

static void armature_leave(shot *s)
{
    double *z = tail_of(s);
    const double v2 = z[Y_V] * z[Y_V];
    const double I = shot_forces_at(&s->model, unknowns(s)).I;
    z[Y_X] = s->model.barrel.length;
    s->exit_kinetic = 0.5 * z[Y_MASS] * v2;
    s->exit_action = z[Y_ACTION];

    s->result.muzzle_velocity = z[Y_V];
    s->result.muzzle_time = s->t;
    s->result.muzzle_energy = s->exit_kinetic;
    s->result.efficiency = s->start_energy > 0.0 ? s->exit_kinetic / s->start_energy : 0.0;
    s->result.exit_current = I;
    s->model.phase = SHOT_LEFT;
    switched(s, SHOT_MUZZLE, -1);
}

static void armature_settle(shot *s, const int *found)
{
    shot_model *m = &s->model;
    double *z = tail_of(s);
    const double end = m->barrel.length * (1.0 - 1e-14);
    if (m->phase == SHOT_HELD && found && found[ROOT_MOTION]) {
        m->phase = SHOT_MOVING;
        switched(s, SHOT_RELEASED, -1);
    }
    if (m->phase != SHOT_MOVING) return;
    while (s->passed < s->n_sites && (s->sites[s->passed].position <= z[Y_X] ||
                                      (found && found[ROOT_SITE] && m->next_site == s->sites[s->passed].position)))
        announce(s, SHOT_SITE, s->sites[s->passed++].index);
    m->next_site = s->passed < s->n_sites ? s->sites[s->passed].position : INFINITY;
    if ((found && found[ROOT_MUZZLE]) || z[Y_X] >= end) {
        armature_leave(s);
        return;
    }
    const bool at_rest = (found && found[ROOT_MOTION]) || z[Y_V] < 0.0;
    if (!at_rest) return;
    z[Y_V] = 0.0;
    const double I = shot_forces_at(m, unknowns(s)).I;
    s->restart = true;
    s->switchings++;
    if (shot_push(m, 0.0, I) > shot_hold_force(m, I)) return;
    m->phase = SHOT_HELD;
    switched(s, SHOT_STOPPED, -1);
}

static void settle(shot *s, const int *found)
{
    groups_settle(s, found);
    armature_settle(s, found);
    groups_fire(s);
    if (s->restart) groups_settle(s, NULL);
}

/* ---- integration ---- */

static double current_slope(const shot *s)
{
    const double *yp = dae_yp(s->solver);
    double slope = 0.0;
    for (int k = 0; k < s->model.n; k++) {
        if (shot_group_conducts(&s->model.groups[k])) slope += s->model.groups[k].n * yp[2 * k + 1];
    }
    return slope;
}

/* Fills everything the solver needs after a switching: the algebraic unknowns, y', tolerances, root directions. */
static status restart(shot *s)
{
    const shot_model *m = &s->model;
    const int n = shot_unknowns(m);
    double *y = unknowns(s), *yp = dae_yp(s->solver);
    CHECK(s->switchings <= s->switchings_limit, STATUS_NUMERICAL,
          "the circuit switched %d times by t = %.9g s: switches chatter; check preload, spreading and firing times",
          s->switchings, s->t);
    tail_of(s)[Y_BREECH] = shot_breech_voltage(m, y);
    shot_rates(m, y, yp);
    for (int j = 0; j < n; j++) {
        dae_differential(s->solver)[j] = shot_is_algebraic(m, j) ? 0.0 : 1.0;
        dae_atol(s->solver)[j] = s->options.atol * s->scale[j];
        if (shot_is_algebraic(m, j)) yp[j] = 0.0;
    }
    int *direction = dae_direction(s->solver);
    direction[ROOT_MOTION] = m->phase == SHOT_HELD ? 1 : -1;
    direction[ROOT_SITE] = direction[ROOT_MUZZLE] = 1;
    for (int k = 0; k < m->n; k++) {
        const bool crowbar = m->groups[k].mode == GROUP_CROWBAR;
        if (crowbar) dae_atol(s->solver)[2 * k] = s->options.atol * s->scale[2 * k + 1];
        direction[ROOT_GROUPS + 2 * k] = m->groups[k].mode == GROUP_WAITING ? 1 : -1;
        direction[ROOT_GROUPS + 2 * k + 1] = -1;
    }
    s->restart = false;
    s->last_current = shot_forces_at(m, y).I;
    s->last_slope = current_slope(s);
    s->last_t = s->t;
    return dae_restart(s->solver, s->t, s->options.rtol);
}

/* Largest value of the cubic through (I0, slope0) and (I1, slope1) over one step h, where it has its top inside. */
static double cubic_top(double I0, double d0, double I1, double d1, double h)
{
    if (!(d0 > 0.0 && d1 < 0.0)) return fmax(I0, I1);
    const double a = d0 * h, b = 3.0 * (I1 - I0) - (2.0 * d0 + d1) * h, c = (d0 + d1) * h + 2.0 * (I0 - I1);
    const double root = sqrt(fmax(b * b - 3.0 * a * c, 0.0)); /* a + 2 b q + 3 c q^2 = 0 */
    const double q = a / (root - b);
    return q > 0.0 && q < 1.0 ? fmax(fmax(I0, I1), I0 + q * (a + q * (b + q * c))) : fmax(I0, I1);
}

static void peaks_update(shot *s)
{
    const shot_forces f = shot_forces_at(&s->model, unknowns(s));
    const double slope = current_slope(s), h = s->t - s->last_t;
    const double top = cubic_top(s->last_current, s->last_slope, f.I, slope, h);
    s->result.peak_current = fmax(s->result.peak_current, top);
    if (s->model.phase == SHOT_MOVING)
        s->result.peak_acceleration = fmax(s->result.peak_acceleration, f.net / tail_of(s)[Y_MASS]);
    s->last_current = f.I;
    s->last_slope = slope;
    s->last_t = s->t;
}

/* Hands out the queue.  A sink may call shot_jump, which asks for a restart. */
static bool deliver(shot *s, const shot_sink *sink)
{
    while (s->head < s->tail) {
        const pending p = s->queue[s->head++];
        if (!sink || !sink->event) continue;
        const shot_event e = { .kind = p.kind, .index = p.index, .state = shot_now(s) };
        if (!sink->event(sink->user, s, &e)) return false;
    }
    s->head = s->tail = 0;
    return true;
}

static status settle_and_deliver(shot *s, const int *found, const shot_sink *sink)
{
    settle(s, found);
    if (s->restart) TRY(restart(s));
    const bool go_on = deliver(s, sink);
    if (s->restart) TRY(restart(s));
    CHECK(go_on, STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

static status begin(shot *s, const shot_sink *sink)
{
    if (s->started) { /* what an earlier stop left in the queue; a jump made between two calls */
        const bool go_on = deliver(s, sink);
        if (s->restart) TRY(restart(s));
        CHECK(go_on, STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
        return status_ok();
    }
    s->started = s->restart = true;
    TRY(settle_and_deliver(s, NULL, sink));
    if (!sink || !sink->sample) return status_ok();
    const shot_state now = shot_now(s);
    CHECK(sink->sample(sink->user, s, &now), STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

static status step(shot *s, double until, const shot_sink *sink)
{
    dae_outcome outcome = DAE_STEP;
    const double firing = next_firing(s), t0 = s->t;
    TRY(dae_step(s->solver, fmin(until, firing), &s->t, &outcome));
    s->result.steps++;
    const double *z = tail_of(s);
    CHECK(isfinite(z[Y_V]) && isfinite(z[Y_BREECH]), STATUS_NUMERICAL,
          "the circuit's state is not finite at t = %.9g s", s->t);
    CHECK(z[Y_MASS] > 0.01 * s->scale[2 * s->model.n + Y_MASS], STATUS_NUMERICAL,
          "the armature was worn away at t = %.9g s, x = %g m: lower armature.wear_fraction", s->t, z[Y_X]);
    peaks_update(s);
    bool go_on = true;
    if (sink && sink->sample && s->t > t0) {
        const shot_state now = shot_now(s);
        go_on = sink->sample(sink->user, s, &now);
    }
    if (outcome == DAE_ROOT || s->t >= firing) {
        TRY(settle_and_deliver(s, outcome == DAE_ROOT ? dae_found(s->solver) : NULL, sink));
    }
    CHECK(go_on, STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

status shot_advance(shot *s, double until, const shot_sink *sink)
{
    static const uint64_t STEPS_LIMIT = 5000000;
    const double end = fmin(until, s->options.max_time);
    CHECK(!isnan(until), STATUS_BAD_INPUT, "the time to advance the shot to is not a number");
    TRY(begin(s, sink));
    while (s->t + INSTANT < end && !shot_done(s)) {
        CHECK(s->result.steps < STEPS_LIMIT, STATUS_NUMERICAL,
              "the circuit took %llu steps by t = %.9g s: try a larger options.rtol",
              (unsigned long long)s->result.steps, s->t);
        TRY(step(s, end, sink));
    }
    return status_ok();
}

status shot_jump(shot *s, double impulse, double mass_loss)
{
    double *z = tail_of(s);
    CHECK(impulse >= 0.0 && isfinite(impulse), STATUS_BAD_INPUT, "a gouge's impulse of %g N s: must be 0 or more",
          impulse);
    CHECK(mass_loss >= 0.0 && mass_loss < z[Y_MASS], STATUS_BAD_INPUT,
          "a gouge's mass loss of %g kg: must be 0 or more and less than the armature's %g kg", mass_loss, z[Y_MASS]);
    CHECK(s->model.phase == SHOT_MOVING, STATUS_BAD_INPUT, "a gouge's impulse on an armature that is not in motion");
    const double mass = z[Y_MASS] - mass_loss;
    const double v = fmax(z[Y_V] - impulse / mass, 0.0);
    s->momentum_jumps += mass * (z[Y_V] - v);
    s->mass_jumps += mass_loss;
    s->energy_jumps += 0.5 * z[Y_MASS] * z[Y_V] * z[Y_V] - 0.5 * mass * v * v;
    z[Y_MASS] = mass;
    z[Y_V] = v;
    if (v == 0.0) {
        const double I = shot_forces_at(&s->model, unknowns(s)).I;
        if (shot_push(&s->model, 0.0, I) <= shot_hold_force(&s->model, I)) {
            s->model.phase = SHOT_HELD;
            switched(s, SHOT_STOPPED, -1);
        }
    }
    s->restart = true;
    return status_ok();
}

/* ---- creation ---- */

static status config_check(const shot_config *c)
{
    CHECK(c->n_modules >= 1 && c->modules, STATUS_BAD_INPUT, "the bank has no modules: give at least one group");
    for (int k = 0; k < c->n_modules; k++) {
        shot_module p = c->modules[k];
        if (isnan(p.fire_at)) p.fire_at = 0.0; /* never is a value too */
        char section[32];
        snprintf(section, sizeof section, "bank[%d]", k);
        TRY(params_check(shot_module_params, &p, section));
        CHECK(p.inductance + p.cable_inductance > 0.0, STATUS_BAD_INPUT,
              "bank[%d]: inductance + cable_inductance = 0 H: must be positive", k);
    }
    TRY(params_check(shot_barrel_params, &c->barrel, "barrel"));
    TRY(params_check(shot_armature_params, &c->armature, "armature"));
    TRY(params_check(shot_options_params, &c->options, "options"));
    CHECK(c->barrel.start < c->barrel.length, STATUS_BAD_INPUT,
          "barrel.start = %g m: must be less than barrel.length = %g m", c->barrel.start, c->barrel.length);
    CHECK(c->armature.gas_density == 0.0 || c->armature.gas_pressure > 0.0, STATUS_BAD_INPUT,
          "armature.gas_pressure = 0 Pa with armature.gas_density = %g kg/m^3: give both or none",
          c->armature.gas_density);
    CHECK(c->armature.wear_fraction == 0.0 || c->armature.melting_temperature > c->armature.temperature,
          STATUS_BAD_INPUT, "armature.temperature = %g K: must be below melting_temperature = %g K",
          c->armature.temperature, c->armature.melting_temperature);
    for (int k = 0; k < c->n_sites; k++) {
        CHECK(c->sites[k] > c->barrel.start && c->sites[k] < c->barrel.length, STATUS_BAD_INPUT,
              "sites[%d].position = %g m: must lie between barrel.start = %g m and barrel.length = %g m", k,
              c->sites[k], c->barrel.start, c->barrel.length);
    }
    return status_ok();
}

static void model_fill(shot *s, const shot_config *c)
{
    shot_model *m = &s->model;
    m->barrel = c->barrel;
    m->armature = c->armature;
    m->phase = SHOT_HELD;
    m->next_site = INFINITY;
    const double width = isnan(c->armature.contact_width) ? c->rails.height : c->armature.contact_width;
    m->contact_area = c->armature.contact_length * width;
    m->bore_area = isnan(c->armature.bore_area) ? c->rails.separation * c->rails.height : c->armature.bore_area;
    m->sound_speed = c->armature.gas_density > 0.0
                         ? sqrt(c->armature.gas_gamma * c->armature.gas_pressure / c->armature.gas_density)
                         : 0.0;
    m->wear_heat = c->armature.specific_heat * (c->armature.melting_temperature - c->armature.temperature) +
                   c->armature.latent_heat;
    for (int k = 0; k < m->n; k++) {
        const shot_module *p = &c->modules[k];
        m->groups[k] = (shot_group){ *p, p->inductance + p->cable_inductance, p->resistance + p->cable_resistance,
                                     p->count, GROUP_UNFIRED };
    }
}

/* Scales for the absolute tolerances: what each quantity could reach. */
static void scales_fill(shot *s)
{
    shot_model *m = &s->model;
    double E = 0.0, I = 0.0, V = 1.0;
    for (int k = 0; k < m->n; k++) {
        const shot_module *p = &m->groups[k].p;
        const double i = p->charge * sqrt(p->capacitance / m->groups[k].L);
        s->scale[2 * k] = fmax(p->charge, 1.0);
        s->scale[2 * k + 1] = fmax(i, 1.0);
        E += 0.5 * m->groups[k].n * p->capacitance * p->charge * p->charge;
        I += m->groups[k].n * fmax(i, 1.0);
        V = fmax(V, p->charge);
    }
    double *z = s->scale + 2 * m->n;
    const double v0 = m->armature.velocity;
    s->start_energy = E + 0.5 * m->armature.mass * v0 * v0;
    for (int j = Y_COIL; j < Y_COUNT; j++) z[j] = fmax(s->start_energy, 1.0);
    z[Y_BREECH] = V;
    z[Y_X] = m->barrel.length;
    z[Y_V] = fmax(fmax(1.0, v0), 0.1 * sqrt(2.0 * E / m->armature.mass));
    z[Y_MASS] = m->armature.mass;
    z[Y_ACTION] = 1e-3 * I * I;
    for (int k = 0; k < m->rails.ladder.n; k++) {
        z[Y_COUNT + 2 * k] = m->barrel.length * I;
        z[Y_COUNT + 2 * k + 1] = m->barrel.length * I * I;
    }
}

static int by_position(const void *a, const void *b)
{
    const shot_place *p = a, *q = b;
    if (p->position != q->position) return p->position < q->position ? -1 : 1;
    return p->index - q->index;
}

static status memory_take(shot *s, const shot_config *c)
{
    const size_t n = (size_t)c->n_modules, sites = (size_t)(c->n_sites > 0 ? c->n_sites : 0);
    s->model.n = c->n_modules;
    s->n_sites = (int)sites;
    s->capacity = (int)(4 * n + sites + 8);
    s->switchings_limit = 8 * c->n_modules + 1000;
    s->model.groups = calloc(n, sizeof *s->model.groups);
    s->sites = calloc(sites + 1, sizeof *s->sites);
    s->queue = calloc((size_t)s->capacity, sizeof *s->queue);
    s->scale = calloc((size_t)shot_unknowns(&s->model), sizeof *s->scale);
    s->forced = calloc(3 * n, sizeof *s->forced);
    CHECK(s->model.groups && s->sites && s->queue && s->scale && s->forced, STATUS_MEMORY,
          "out of memory for a shot of %d groups", c->n_modules);
    for (int k = 0; k < s->n_sites; k++) s->sites[k] = (shot_place){ c->sites[k], k };
    qsort(s->sites, sites, sizeof *s->sites, by_position);
    const dae_problem problem = { .n = shot_unknowns(&s->model),
                                  .n_roots = ROOT_GROUPS + 2 * s->model.n,
                                  .residual = shot_residual,
                                  .roots = shot_roots,
                                  .model = &s->model };
    return dae_create(&problem, &s->solver);
}

static void state_fill(shot *s, const shot_config *c)
{
    shot_model *m = &s->model;
    double *z = tail_of(s);
    for (int k = 0; k < m->n; k++) unknowns(s)[2 * k] = m->groups[k].p.charge;
    z[Y_X] = c->barrel.start;
    z[Y_V] = c->armature.velocity;
    z[Y_MASS] = c->armature.mass;
    s->rail_temperature = c->rails.temperature;
    s->armature_temperature = c->armature.temperature;
    /* Free at once where nothing holds it: friction then starts at zero with the current, below the force. */
    const bool loose = c->armature.friction_dry * c->armature.preload == 0.0 &&
                       shot_push(m, 0.0, 1.0) > 2.0 * c->armature.friction_dry * c->armature.spreading;
    if (z[Y_V] > 0.0 || loose) m->phase = SHOT_MOVING;
    m->next_site = s->n_sites > 0 ? s->sites[0].position : INFINITY;
    s->result = (shot_summary){
        .muzzle_velocity = NAN, .muzzle_time = NAN, .muzzle_energy = NAN, .efficiency = NAN, .exit_current = NAN
    };
}

status shot_create(const shot_config *config, shot **out)
{
    *out = NULL;
    TRY(config_check(config));
    shot *s = calloc(1, sizeof *s);
    CHECK(s, STATUS_MEMORY, "out of memory for the shot");
    s->options = config->options;
    status st = shot_rails_fit(config, &s->model.rails);
    if (st.code == STATUS_OK) st = memory_take(s, config);
    if (st.code != STATUS_OK) {
        shot_free(s);
        return st;
    }
    model_fill(s, config);
    scales_fill(s);
    state_fill(s, config);
    *out = s;
    return st;
}

void shot_free(shot *s)
{
    if (!s) return;
    dae_free(s->solver);
    free(s->model.groups);
    free(s->sites);
    free(s->queue);
    free(s->scale);
    free(s->forced);
    free(s);
}
