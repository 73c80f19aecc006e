/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/site_state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double gouge_face_area(const case_projectile *p)
{
    return (p->length - p->chamfer_height / tan(p->lead_angle)) * p->width;
}

void gouge_shot_outcome_free(shot_outcome *o)
{
    if (!o) return;
    free(o->site);
    free(o->trace);
    memset(o, 0, sizeof *o);
}

/* Between two steps, a share of the way from a to b. */
static trace_point between(const trace_point *a, const trace_point *b, double share)
{
#define BETWEEN(member) .member = a->member + share * (b->member - a->member)
    return (trace_point){ BETWEEN(t),
                          BETWEEN(x),
                          BETWEEN(v),
                          BETWEEN(contact_pressure),
                          BETWEEN(lead_face_temperature),
                          BETWEEN(pressure),
                          BETWEEN(friction),
                          BETWEEN(rail_flux),
                          BETWEEN(rail_sheet),
                          BETWEEN(film_rise),
                          BETWEEN(melted) };
#undef BETWEEN
}

static bool end_of_trace(const shot_outcome *o, trace_point *at)
{
    *at = o->n_trace > 0 ? o->trace[o->n_trace - 1] : (trace_point){ .t = 0.0 };
    return false;
}

bool gouge_trace_at_velocity(const shot_outcome *o, double v, trace_point *at)
{
    int i = 0;
    while (i < o->n_trace && o->trace[i].v < v) i++;
    if (i == o->n_trace) return end_of_trace(o, at);
    const trace_point *b = &o->trace[i];
    *at = i == 0 ? *b : between(b - 1, b, (v - b[-1].v) / (b->v - b[-1].v));
    if (i > 0) at->v = v;
    return true;
}

/* x never falls along the trace, so the step is found by halving. */
bool gouge_trace_at_place(const shot_outcome *o, double x, trace_point *at)
{
    int low = 0, high = o->n_trace; /* trace[low - 1].x < x <= trace[high].x */
    while (low < high) {
        const int half = low + (high - low) / 2;
        if (o->trace[half].x < x)
            low = half + 1;
        else
            high = half;
    }
    if (low == o->n_trace || (low == 0 && x < o->trace[0].x)) return end_of_trace(o, at);
    const trace_point *b = &o->trace[low];
    *at = low == 0 ? *b : between(b - 1, b, (x - b[-1].x) / (b->x - b[-1].x));
    return true;
}

double gouge_trace_place(const shot_outcome *o, double v)
{
    trace_point at;
    return v > 0.0 && gouge_trace_at_velocity(o, v, &at) ? at.x : NAN;
}

double gouge_trace_velocity(const shot_outcome *o, double x)
{
    trace_point at;
    return gouge_trace_at_place(o, x, &at) ? at.v : 0.0;
}

double gouge_trace_fastest(const shot_outcome *o)
{
    double v = 0.0;
    for (int i = 0; i < o->n_trace; i++) v = fmax(v, o->trace[i].v);
    return v;
}

/* ---- the sinks ---- */

typedef struct {
    const case_flight *flight;
    const shot_plan *plan;
    shot_outcome *out;
    double face_area;   /* [m2] */
    double last_sample; /* of the history [s] */
    int rows[3];        /* series: shot, modules, events */
    status error;       /* of the sinks, reported when the shot has stopped */
} recorder;

static bool keep(recorder *r, status s)
{
    if (s.code != STATUS_OK && r->error.code == STATUS_OK) r->error = s;
    return r->error.code == STATUS_OK;
}

static double pressure_of(const recorder *r, const circuit_shot_state *s)
{
    return s->contact_force / r->face_area;
}

static void arrive(recorder *r, const circuit_shot_event *e)
{
    site_state *s = &r->out->site[e->index];
    s->reached = true;
    s->time = e->state.t;
    s->velocity = e->state.v;
    s->current = e->state.current;
    s->contact_pressure = pressure_of(r, &e->state);
    s->lead_face_temperature = e->state.lead_face_temperature;
}

/* Of an armature that has left at this very site, or that an earlier gouge here has stopped, nothing can be taken. */
static bool takes(const circuit_shot *s, const site_jump *j)
{
    return (j->impulse > 0.0 || j->mass_loss > 0.0) && circuit_shot_now(s).phase == CIRCUIT_SHOT_MOVING;
}

static bool on_event(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    recorder *r = user;
    if (r->plan->history) {
        double row[HISTORY_MAX_COLUMNS];
        output_history_event_row(e, row);
        if (!keep(r, output_history_append(r->plan->history, r->rows[2], row))) return false;
    }
    if (e->kind != CIRCUIT_SHOT_SITE) return true;
    arrive(r, e);
    const site_jump *j = r->plan->jump ? &r->plan->jump[e->index] : NULL;
    return !j || !takes(s, j) || keep(r, circuit_shot_jump(s, j->impulse, j->mass_loss));
}

static status keep_trace(recorder *r, const circuit_shot_state *s)
{
    shot_outcome *o = r->out;
    if (s->phase == CIRCUIT_SHOT_LEFT || (o->n_trace > 0 && s->t <= o->trace[o->n_trace - 1].t)) return status_ok();
    if (o->n_trace == o->trace_room) {
        const int room = o->trace_room ? 2 * o->trace_room : 1024;
        trace_point *more = realloc(o->trace, (size_t)room * sizeof *more);
        CHECK(more, STATUS_MEMORY, "no memory for %d steps of the shot", room);
        o->trace = more;
        o->trace_room = room;
    }
    o->trace[o->n_trace++] =
        (trace_point){ .t = s->t,
                       .x = s->x,
                       .v = s->v,
                       .contact_pressure = pressure_of(r, s),
                       .lead_face_temperature = s->lead_face_temperature,
                       .pressure = s->contact_pressure,
                       .friction = s->friction_coefficient,
                       .rail_flux = s->rail_flux,
                       .rail_sheet = s->rail_sheet,
                       .film_rise = s->film_temperature - s->rail_temperature,
                       .melted = r->flight->launcher.armature.mass - s->mass - s->ledger.mass_jumps };
    return status_ok();
}

static status write_rows(recorder *r, const circuit_shot *s, const circuit_shot_state *state)
{
    double row[HISTORY_MAX_COLUMNS];
    const double interval = r->flight->history_interval;
    if (!r->plan->history || (interval > 0.0 && state->t < r->last_sample + interval)) return status_ok();
    r->last_sample = state->t;
    output_history_shot_row(state, row);
    TRY(output_history_append(r->plan->history, r->rows[0], row));
    output_history_modules_row(s, row);
    return output_history_append(r->plan->history, r->rows[1], row);
}

static bool on_sample(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    recorder *r = user;
    const double length = r->flight->launcher.barrel.length, start = r->flight->launcher.barrel.start;
    if (r->plan->progress) host_progress_update(r->plan->progress, (state->x - start) / (length - start), 0);
    if (r->plan->stop && r->plan->stop()) keep(r, base_status_error(STATUS_STOPPED, "stopped at t = %g s", state->t));
    return keep(r, keep_trace(r, state)) && keep(r, write_rows(r, s, state));
}

/* ---- the run ---- */

static status open_series(recorder *r, const circuit_shot *s)
{
    history *h = r->plan->history;
    if (!h) return status_ok();
    TRY(output_history_shot(h, &r->rows[0]));
    TRY(output_history_modules(h, s, &r->rows[1]));
    TRY(output_history_events(h, &r->rows[2]));
    for (int k = 0; k < 3; k++)
        TRY(output_history_rewind(h, r->rows[k], -1.0)); /* a shot is rerun, not taken up again */
    return status_ok();
}

static status close_series(recorder *r)
{
    for (int k = 0; r->plan->history && k < 3; k++) TRY(output_history_end(r->plan->history, r->rows[k]));
    return status_ok();
}

static status run(recorder *r, circuit_shot *s)
{
    TRY(open_series(r, s));
    const circuit_shot_sink sink = { on_event, on_sample, r };
    const status done = circuit_shot_advance(s, INFINITY, &sink);
    if (r->error.code != STATUS_OK) return r->error;
    TRY(done);
    r->out->summary = circuit_shot_result(s);
    r->out->limits = circuit_shot_limits_of(s);
    circuit_shot_rail_rise(s, r->out->rail_rise);
    return close_series(r);
}

static status prepare(const case_flight *f, shot_outcome *out, double **positions)
{
    const size_t n = f->n_sites > 0 ? (size_t)f->n_sites : 1;
    out->site = malloc(n * sizeof *out->site);
    *positions = malloc(n * sizeof **positions);
    CHECK(out->site && *positions, STATUS_MEMORY, "no memory for %d sites", f->n_sites);
    out->n_sites = f->n_sites;
    for (int i = 0; i < f->n_sites; i++) {
        (*positions)[i] = f->site[i].position;
        out->site[i] = (site_state){ f->site[i], false, NAN, NAN, NAN, NAN, NAN };
    }
    return status_ok();
}

/* Of the face that is pressed on the rail [m2]. */
static double face_area(const case_flight *f)
{
    const circuit_shot_armature *a = &f->launcher.armature;
    const double width = isnan(a->contact_width) ? f->launcher.rails.height : a->contact_width;
    return f->body ? gouge_face_area(f->body) : a->contact_length * width;
}

status gouge_shot_run(const case_flight *f, const shot_plan *plan, shot_outcome *out)
{
    memset(out, 0, sizeof *out);
    double *positions = NULL;
    circuit_shot *s = NULL;
    recorder r = { .flight = f, .plan = plan, .out = out, .last_sample = -INFINITY, .error = status_ok() };
    r.face_area = face_area(f);
    status done = prepare(f, out, &positions);
    if (done.code == STATUS_OK) {
        circuit_shot_config config = f->launcher;
        config.sites = positions;
        config.n_sites = f->n_sites;
        done = circuit_shot_create(&config, &s);
    }
    if (done.code == STATUS_OK) done = run(&r, s);
    circuit_shot_free(s);
    free(positions);
    return done;
}
