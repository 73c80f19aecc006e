/* SPDX-License-Identifier: BSD-3-Clause */
/* Driving a shot: integration between switchings, events, summary.  Equations: circuit/shot_model.c. */
#include "circuit/shot_internal.h"

#include <math.h>

/* Waits for its own voltage to come round again, whatever the rails do. */
static bool comes_again(const supply_group *g)
{
    return g->gate == GATE_WAITING && g->kind->pulses;
}

bool circuit_shot_done(const circuit_shot *s)
{
    const shot_model *m = &s->model;
    const bool in_motion = m->phase == CIRCUIT_SHOT_MOVING && circuit_shot_z(s)[Y_V] > 0.0;
    bool busy = !s->started || s->head != s->tail || in_motion || circuit_shot_any_current(s);
    for (int k = 0; k < m->n && !busy; k++) busy = comes_again(&m->groups[k]);
    return !busy && circuit_shot_next_firing(s) > s->options.max_time;
}

/* Fills everything the solver needs after a switching: the algebraic unknowns, y', tolerances, root directions. */
static void set_tolerances(circuit_shot *s)
{
    const shot_model *m = &s->model;
    const int n = circuit_shot_unknowns(m);
    for (int j = 0; j < n; j++) circuit_dae_atol(s->solver)[j] = s->options.atol * s->scale[j];
    for (int k = 0; k < m->n; k++) {
        const supply_group *g = &m->groups[k];
        for (int j = 0; j < g->unknowns; j++) {
            const double scale = g->kind->scale ? g->kind->scale(g, j) : s->scale[g->first + j];
            circuit_dae_atol(s->solver)[g->first + j] = s->options.atol * scale;
        }
    }
}

static void set_directions(circuit_shot *s)
{
    const shot_model *m = &s->model;
    int *direction = circuit_dae_direction(s->solver);
    direction[ROOT_MOTION] = m->phase == CIRCUIT_SHOT_HELD ? 1 : -1;
    direction[ROOT_MELT] = direction[ROOT_SITE] = direction[ROOT_MUZZLE] = direction[ROOT_FEED] = 1;
    for (int k = 0; k < m->n; k++) {
        direction[ROOT_GROUPS + 2 * k] = -1;
        direction[ROOT_GROUPS + 2 * k + 1] = m->groups[k].gate == GATE_WAITING ? 1 : -1;
    }
}

static void note_current(circuit_shot *s, const shot_drive *d)
{
    s->last_current = circuit_shot_total_current(d, &s->model);
    s->last_slope = circuit_shot_current_slope(&s->model, d, circuit_shot_z(s));
    s->last_t = s->t;
}

/* Largest |x_j| over its weight rtol |y_j| + atol_j, of what is not algebraic. */
static double weighted(const circuit_shot *s, const double *x)
{
    const double *y = circuit_shot_y(s), *atol = circuit_dae_atol(s->solver),
                 *differential = circuit_dae_differential(s->solver);
    double most = 0.0;
    for (int j = 0, n = circuit_shot_unknowns(&s->model); j < n; j++)
        most = fmax(most, differential[j] * fabs(x[j]) / (s->options.rtol * fabs(y[j]) + atol[j]));
    return most;
}

/* A first step of order 1 is off by 1/2 h^2 y'', which may be one weight: y'' from the rates half a weight later.
 * IDA's own choice is that half weight itself: ten doublings and more that do nothing.  0 where nothing moves. */
static double first_step(circuit_shot *s)
{
    const shot_model *m = &s->model;
    const int n = circuit_shot_unknowns(m);
    const double *y = circuit_shot_y(s), *yp = circuit_dae_yp(s->solver), speed = weighted(s, yp);
    double *later = s->later, *bend = s->later + n;
    if (!(speed > 0.0)) return 0.0;
    const double h = 0.5 / speed;
    for (int j = 0; j < n; j++) later[j] = y[j] + h * yp[j];
    const shot_drive d = circuit_shot_drive_at(m, s->t + h, later);
    circuit_shot_voltages(m, &d, later + m->start);
    circuit_shot_rates(m, s->t + h, later, bend);
    for (int j = 0; j < n; j++) bend[j] = (bend[j] - yp[j]) / h;
    return fmax(h, sqrt(2.0 / weighted(s, bend)));
}

static status restart(circuit_shot *s)
{
    const shot_model *m = &s->model;
    const int n = circuit_shot_unknowns(m);
    double *y = circuit_shot_y(s), *yp = circuit_dae_yp(s->solver);
    CHECK(s->switchings <= s->switchings_limit, STATUS_NUMERICAL,
          "the circuit switched %d times by t = %.9g s: switches chatter; check preload, spreading and firing times",
          s->switchings, s->t);
    const shot_drive d = circuit_shot_drive_now(s);
    circuit_shot_voltages(m, &d, circuit_shot_z(s));
    circuit_shot_rates(m, s->t, y, yp);
    for (int j = 0; j < n; j++) {
        const bool algebraic = circuit_shot_is_algebraic(m, j);
        circuit_dae_differential(s->solver)[j] = algebraic ? 0.0 : 1.0;
        if (algebraic) yp[j] = 0.0;
    }
    set_tolerances(s);
    set_directions(s);
    s->restart = false;
    note_current(s, &d);
    return circuit_dae_restart(s->solver, s->t, s->options.rtol, first_step(s));
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

static void peaks_update(circuit_shot *s)
{
    const shot_drive d = circuit_shot_drive_now(s);
    const double I = s->last_current, slope = s->last_slope, h = s->t - s->last_t;
    note_current(s, &d);
    circuit_shot_heat_update(s, &d);
    const double top = cubic_top(I, slope, s->last_current, s->last_slope, h);
    const double bottom = cubic_top(-I, -slope, -s->last_current, -s->last_slope, h);
    s->result.peak_current = fmax(s->result.peak_current, fmax(top, bottom));
    if (s->model.phase == CIRCUIT_SHOT_LEFT) return;
    const shot_forces f = circuit_shot_forces_at(&s->model, &d, circuit_shot_z(s));
    circuit_shot_lead_face_update(s, &f);
    circuit_shot_limits_update(s, &f);
    if (s->model.phase == CIRCUIT_SHOT_HELD) return;
    s->result.peak_acceleration = fmax(s->result.peak_acceleration, f.net / circuit_shot_z(s)[Y_MASS]);
}

/* A site at the very end is passed in the barrel, though the armature has left by the time this is handed out. */
static circuit_shot_state state_of(const circuit_shot *s, const pending *p)
{
    const bool at_end = p->kind == CIRCUIT_SHOT_SITE && s->model.phase == CIRCUIT_SHOT_LEFT;
    return at_end ? s->at_exit : circuit_shot_now(s);
}

/* Hands out the queue.  A sink may call circuit_shot_jump, which asks for a restart. */
static bool deliver(circuit_shot *s, const circuit_shot_sink *sink)
{
    while (s->head < s->tail) {
        const pending p = s->queue[s->head++];
        if (!sink || !sink->event) continue;
        const circuit_shot_event e = { .kind = p.kind, .index = p.index, .state = state_of(s, &p) };
        if (!sink->event(sink->user, s, &e)) return false;
    }
    s->head = s->tail = 0;
    return true;
}

static status settle_and_deliver(circuit_shot *s, const int *found, const circuit_shot_sink *sink)
{
    circuit_shot_settle(s, found);
    if (s->restart) TRY(restart(s));
    const bool go_on = deliver(s, sink);
    if (s->restart) TRY(restart(s));
    CHECK(go_on, STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

static status begin(circuit_shot *s, const circuit_shot_sink *sink)
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
    const circuit_shot_state now = circuit_shot_now(s);
    CHECK(sink->sample(sink->user, s, &now), STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

/* Where a given current has its next point: a stop, so that no short pulse is stepped over.  Nor is the half wave for
 * which a machine waits: at most a quarter of a wave a step. */
static double next_knot(const circuit_shot *s)
{
    double t = INFINITY;
    for (int k = 0; k < s->model.n; k++) {
        const supply_group *g = &s->model.groups[k];
        if (g->kind->knot && circuit_supply_conducts(g)) t = fmin(t, g->kind->knot(g, s->t + SHOT_INSTANT));
        if (comes_again(g)) t = fmin(t, s->t + g->kind->rise(g->p));
    }
    return t;
}

static status step(circuit_shot *s, double until, const circuit_shot_sink *sink)
{
    dae_outcome outcome = DAE_STEP;
    const double firing = circuit_shot_next_firing(s), t0 = s->t;
    TRY(circuit_dae_step(s->solver, fmin(fmin(until, firing), next_knot(s)), &s->t, &outcome));
    s->result.steps++;
    const double *z = circuit_shot_z(s);
    CHECK(isfinite(z[Y_V]) && isfinite(z[Y_BREECH]), STATUS_NUMERICAL,
          "the circuit's state is not finite at t = %.9g s", s->t);
    s->result.worn_away = !(z[Y_MASS] > 0.01 * s->scale[s->model.start + Y_MASS]);
    CHECK(!s->result.worn_away, STATUS_NUMERICAL,
          "the armature was worn away at t = %.9g s, x = %g m: lower armature.wear_fraction", s->t, z[Y_X]);
    peaks_update(s);
    bool go_on = true;
    if (sink && sink->sample && s->t > t0) {
        const circuit_shot_state now = circuit_shot_now(s);
        go_on = sink->sample(sink->user, s, &now);
    }
    if (outcome == DAE_ROOT || s->t >= firing) {
        TRY(settle_and_deliver(s, outcome == DAE_ROOT ? circuit_dae_found(s->solver) : NULL, sink));
    }
    CHECK(go_on, STATUS_STOPPED, "the shot was stopped at t = %.9g s", s->t);
    return status_ok();
}

status circuit_shot_advance(circuit_shot *s, double until, const circuit_shot_sink *sink)
{
    static const uint64_t STEPS_LIMIT = 5000000;
    const double end = fmin(until, s->options.max_time);
    CHECK(!isnan(until), STATUS_BAD_INPUT, "the time to advance the shot to = %g s: must be a number", until);
    TRY(begin(s, sink));
    while (s->t + SHOT_INSTANT < end && !circuit_shot_done(s)) {
        CHECK(s->result.steps < STEPS_LIMIT, STATUS_NUMERICAL,
              "the circuit took %llu steps by t = %.9g s: try a larger options.rtol",
              (unsigned long long)s->result.steps, s->t);
        TRY(step(s, end, sink));
    }
    return status_ok();
}

status circuit_shot_jump(circuit_shot *s, double impulse, double mass_loss)
{
    double *z = circuit_shot_z(s);
    CHECK(impulse >= 0.0 && isfinite(impulse), STATUS_BAD_INPUT, "a gouge's impulse of %g N s: must be 0 or more",
          impulse);
    CHECK(mass_loss >= 0.0 && mass_loss < z[Y_MASS], STATUS_BAD_INPUT,
          "a gouge's mass loss of %g kg: must be 0 or more and less than the armature's %g kg", mass_loss, z[Y_MASS]);
    CHECK(s->model.phase == CIRCUIT_SHOT_MOVING, STATUS_BAD_INPUT,
          "a gouge's impulse on an armature that is not in motion");
    const double mass = z[Y_MASS] - mass_loss;
    const double v = fmax(z[Y_V] - impulse / mass, 0.0);
    s->momentum_jumps += mass * (z[Y_V] - v);
    s->mass_jumps += mass_loss;
    s->energy_jumps += 0.5 * z[Y_MASS] * z[Y_V] * z[Y_V] - 0.5 * mass * v * v;
    z[Y_MASS] = mass;
    z[Y_V] = v;
    if (v == 0.0) circuit_shot_come_to_rest(s);
    s->restart = true;
    return status_ok();
}
