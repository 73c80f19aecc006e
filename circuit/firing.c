/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/firing.h"

#include "circuit/shot_model.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>
#include <stdlib.h>
#include <string.h>

static const double EXCESS = 1e4; /* weight of current above the allowed peak */
static const double CHARGE_LIMITS[2] = { 0.02, 5.0 };
static const double NOT_LEFT = 10.0;    /* objective of a shot that stays in the barrel; the distance left is added */
static const double SEARCH_RTOL = 1e-6; /* of the trial shots: their velocity is good to about 1e-6 */
static const double VELOCITY_CLOSE = 1e-5; /* accepted relative error of the velocity [1] */

static const char *const goal_names[] = { "flat", "velocity", NULL };

const base_param circuit_firing_wish_params[] = {
    PARAM_ENUM(circuit_firing_wish, goal, goal_names, CIRCUIT_FIRING_FLAT,
               "flat: the flattest current below peak_current; velocity: muzzle_velocity at the least stored energy"),
    PARAM_DOUBLE(circuit_firing_wish, peak_current, "A", OPTIONAL, 1.0, 1e9, "peak the rails' current should keep to"),
    PARAM_DOUBLE(circuit_firing_wish, muzzle_velocity, "m/s", OPTIONAL, 1.0, 1e5,
                 "wanted muzzle velocity (goal velocity)"),
    PARAM_DOUBLE(circuit_firing_wish, spread, "s", 1e-4, 1e-9, 1.0, "first steps of the search in the firing times"),
    PARAM_DOUBLE(circuit_firing_wish, tolerance, "s", 1e-6, 1e-12, 1.0,
                 "the search ends when its simplex is this small"),
    PARAM_INT(circuit_firing_wish, evaluations, 400, 2, 100000,
              "trials of the search at most, the first and the last with it"),
    PARAMS_END
};

typedef struct {
    circuit_shot_config config;
    circuit_firing_wish wish;
    const circuit_shot_module *given; /* before the search */
    circuit_shot_module *modules;     /* of the trial under way */
    int n, *moved, n_moved;           /* groups; those whose time is moved */
    int most;                         /* trials so far: what is asked for beyond is as bad as can be */
    const circuit_firing_host *host;
    circuit_firing_result *out;
    double scale; /* of the charges, last trial */
    circuit_rails_load load;
    bool fit_again; /* the rails' gradients follow from the firing times */
    status failed;
} search;

/* ---- one shot ---- */

typedef struct {
    double I, x, badness; /* last sample; the integral so far */
    double peak;          /* allowed */
} flatness;

static double unevenness(const flatness *f, double I)
{
    const double off = I / f->peak - 1.0;
    return off > 0.0 ? EXCESS * off * off : off * off;
}

static bool on_sample(void *user, const circuit_shot *s, const circuit_shot_state *st)
{
    flatness *f = user;
    (void)s;
    if (st->phase == CIRCUIT_SHOT_MOVING && !isnan(f->peak))
        f->badness += 0.5 * (unevenness(f, f->I) + unevenness(f, st->current)) * (st->x - f->x);
    f->I = st->current;
    f->x = st->x;
    return st->phase != CIRCUIT_SHOT_LEFT;
}

static void set_charges(search *q, double scale)
{
    for (int k = 0; k < q->n; k++) q->modules[k].charge = scale * q->given[k].charge;
}

/* Ends with STATUS_STOPPED at the muzzle; also where nothing is left of the armature, which result tells.  *travel:
 * fraction of the barrel that was covered. */
static status run(search *q, double scale, flatness *f, circuit_shot_summary *result, double *travel)
{
    const circuit_shot_barrel *b = &q->config.barrel;
    circuit_shot *s = NULL;
    set_charges(q, scale);
    *f = (flatness){ .x = b->start, .peak = q->wish.peak_current };
    const circuit_shot_sink sink = { .sample = on_sample, .user = f };
    q->out->shots++;
    TRY(circuit_shot_create(&q->config, &s));
    const status done = circuit_shot_advance(s, INFINITY, &sink);
    *result = circuit_shot_result(s);
    *travel = (circuit_shot_now(s).x - b->start) / (b->length - b->start);
    f->badness /= b->length - b->start;
    circuit_shot_free(s);
    return done.code == STATUS_STOPPED || result->worn_away ? status_ok() : done;
}

/* ---- objectives ---- */

static status measure_flat(search *q, double *value)
{
    flatness f;
    circuit_shot_summary r;
    double travel;
    TRY(run(q, q->scale, &f, &r, &travel));
    *value = f.badness + (travel < 1.0 ? NOT_LEFT + 1.0 - travel : 0.0);
    return status_ok();
}

/* The next factor to try.  The first step takes velocity as proportional to charge, later ones are secants through the
 * last two trials; all stay inside the bracket. */
static double next_factor(const double at[2], const double off[2], double wanted, double lo, double hi)
{
    if (hi == at[1] && !(off[1] > -wanted)) return 0.5 * (lo + hi); /* nothing was left of it: too much */
    const bool stayed = !(off[1] > -wanted);                        /* the armature did not leave the barrel */
    double next = at[1] * (stayed ? 1.2 : wanted / (wanted + off[1]));
    if (off[0] > -wanted && off[1] > -wanted && off[0] != off[1])
        next = at[1] - off[1] * (at[1] - at[0]) / (off[1] - off[0]);
    return next > lo && next < hi ? next : 0.5 * (lo + hi);
}

/* The charges' factor at which the muzzle velocity is the wanted one. */
static status charge_for(search *q, flatness *f, bool *found)
{
    const double wanted = q->wish.muzzle_velocity;
    double lo = CHARGE_LIMITS[0], hi = CHARGE_LIMITS[1], at[2] = { NAN, q->scale }, off[2] = { -wanted, -wanted },
           travel;
    *found = false;
    for (int k = 0; k < 40 && hi - lo > 1e-12 * hi && !*found; k++) {
        circuit_shot_summary r;
        TRY(run(q, at[1], f, &r, &travel));
        const double now = (isnan(r.muzzle_velocity) ? 0.0 : r.muzzle_velocity) - wanted;
        *found = fabs(now) <= VELOCITY_CLOSE * wanted;
        off[1] = now;
        if (*found) q->scale = at[1];
        if (now < 0.0 && !r.worn_away)
            lo = at[1];
        else
            hi = at[1];
        const double next = next_factor(at, off, wanted, lo, hi);
        at[0] = at[1], off[0] = now;
        at[1] = next;
    }
    return status_ok();
}

static double stored_energy(const search *q)
{
    double E = 0.0;
    for (int k = 0; k < q->n; k++) {
        const circuit_shot_module *m = &q->modules[k];
        E += 0.5 * m->count * m->capacitance * m->charge * m->charge;
    }
    return E;
}

static status measure_velocity(search *q, double *value)
{
    flatness f;
    bool found;
    TRY(charge_for(q, &f, &found));
    if (!found) {
        *value = INFINITY;
        return status_ok();
    }
    double excess = 0.0;
    if (!isnan(
            q->wish.peak_current)) { /* f.badness also counts currents below the peak; only the excess matters here */
        circuit_shot_summary r;
        double travel;
        TRY(run(q, q->scale, &f, &r, &travel));
        excess = fmax(r.peak_current / q->wish.peak_current - 1.0, 0.0);
    }
    *value = stored_energy(q) * (1.0 + EXCESS * excess * excess);
    return status_ok();
}

/* ---- the search ---- */

static const double WORST = 1e300; /* GSL does not accept infinities, but of a search that is to end */

/* One that was run before the search was stopped. */
static double take_known(search *q, const circuit_firing_trial *t)
{
    q->scale = t->charge_scale;
    q->out->shots = (int)t->shots;
    set_charges(q, q->scale);
    return t->value;
}

/* Once for all trials, but where L' and R' are those of the frequency that the firing times give, (C-6). */
static status fit_rails(search *q)
{
    q->config.fitted = NULL;
    TRY(circuit_shot_rails_fit(&q->config, &q->load));
    q->config.fitted = &q->load.ladder;
    return status_ok();
}

static status run_trial(search *q, double *value)
{
    if (q->fit_again) TRY(fit_rails(q));
    TRY(q->wish.goal == CIRCUIT_FIRING_FLAT ? measure_flat(q, value) : measure_velocity(q, value));
    const circuit_firing_trial t = { *value, q->scale, q->out->shots };
    return q->host->keep ? q->host->keep(q->host->user, &t) : status_ok();
}

static double measure(const gsl_vector *times, void *user)
{
    search *q = user;
    double value = INFINITY;
    if (q->failed.code != STATUS_OK) return value;
    if (q->out->evaluations == q->most) return WORST;
    const bool known = q->out->evaluations < q->host->n_known;
    if (!known && q->host->stop && q->host->stop()) {
        q->failed = base_status_error(STATUS_STOPPED, "the search for firing times was stopped");
        return value;
    }
    for (int k = 0; k < q->n_moved; k++) q->modules[q->moved[k]].fire_at = fabs(gsl_vector_get(times, (size_t)k));
    const int trial = q->out->evaluations++;
    if (known)
        value = take_known(q, &q->host->known[trial]);
    else
        q->failed = run_trial(q, &value);
    return isfinite(value) ? value : WORST;
}

static status minimise(search *q, gsl_multimin_fminimizer *simplex, gsl_vector *times, gsl_vector *steps)
{
    gsl_multimin_function f = { measure, (size_t)q->n_moved, q };
    for (int k = 0; k < q->n_moved; k++) gsl_vector_set(times, (size_t)k, q->modules[q->moved[k]].fire_at);
    gsl_vector_set_all(steps, q->wish.spread);
    q->out->before = measure(times, q);
    TRY(q->failed);
    CHECK(q->out->before < WORST, STATUS_NUMERICAL, "no charge within %g .. %g times the given one reaches %g m/s",
          CHARGE_LIMITS[0], CHARGE_LIMITS[1], q->wish.muzzle_velocity);
    const bool started = gsl_multimin_fminimizer_set(simplex, &f, times, steps) == GSL_SUCCESS;
    TRY(q->failed); /* it does not accept the infinity of a trial that failed or was stopped */
    CHECK(started, STATUS_NUMERICAL, "the search for firing times could not be started");
    while (q->failed.code == STATUS_OK && q->out->evaluations < q->most) {
        if (gsl_multimin_fminimizer_iterate(simplex) != GSL_SUCCESS) break;
        if (gsl_multimin_fminimizer_size(simplex) < q->wish.tolerance) break;
    }
    TRY(q->failed);
    q->most++;
    q->out->after =
        measure(gsl_multimin_fminimizer_x(simplex), q); /* evaluated last, so that modules hold the best times */
    q->out->charge_scale = q->scale;
    q->out->stored_energy = stored_energy(q);
    return q->failed;
}

/* No time can move: the charges alone. */
static status charge_alone(search *q)
{
    q->out->before = stored_energy(q);
    q->out->after = measure(NULL, q);
    TRY(q->failed);
    CHECK(q->out->after < WORST, STATUS_NUMERICAL, "no charge within %g .. %g times the given one reaches %g m/s",
          CHARGE_LIMITS[0], CHARGE_LIMITS[1], q->wish.muzzle_velocity);
    q->out->charge_scale = q->scale;
    q->out->stored_energy = stored_energy(q);
    return status_ok();
}

static status search_run(search *q)
{
    const size_t n = (size_t)q->n_moved;
    if (n == 0) return charge_alone(q);
    gsl_multimin_fminimizer *simplex = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, n);
    gsl_vector *times = gsl_vector_alloc(n), *steps = gsl_vector_alloc(n);
    const status done = simplex && times && steps
                            ? minimise(q, simplex, times, steps)
                            : base_status_error(STATUS_MEMORY, "out of memory for %zu firing times", n);
    if (simplex) gsl_multimin_fminimizer_free(simplex);
    gsl_vector_free(times);
    gsl_vector_free(steps);
    return done;
}

static bool some_fires(const circuit_shot_config *c)
{
    const circuit_supply_list *bank = &c->supplies[CIRCUIT_SUPPLY_capacitor];
    const circuit_shot_module *modules = bank->item;
    for (int k = 0; k < bank->n; k++)
        if (modules[k].fire_at <= c->options.max_time && modules[k].charge > 0.0) return true;
    return false;
}

/* Which groups are moved: all that fire at the breech but the first to fire.  moved: [n] of room, or NULL; how many. */
static int choose_moved(const circuit_shot_config *c, int *moved)
{
    const circuit_supply_list *bank = &c->supplies[CIRCUIT_SUPPLY_capacitor];
    const circuit_shot_module *modules = bank->item;
    int first = -1, n = 0;
    for (int k = 0; k < bank->n; k++) {
        const circuit_shot_module *m = &modules[k];
        if (!(m->fire_at <= c->options.max_time) || m->position > 0.0) continue;
        if (first < 0 || m->fire_at < modules[first].fire_at) first = k;
    }
    for (int k = 0; k < bank->n; k++) {
        const circuit_shot_module *m = &modules[k];
        if (k == first || !(m->fire_at <= c->options.max_time) || m->position != 0.0) continue;
        if (moved) moved[n] = k;
        n++;
    }
    return n;
}

status circuit_firing_check(const circuit_shot_config *c, const circuit_firing_wish *wish)
{
    TRY(base_params_check(circuit_firing_wish_params, wish, "optimise"));
    CHECK(wish->goal != CIRCUIT_FIRING_FLAT || choose_moved(c, NULL) > 0, STATUS_BAD_INPUT,
          "optimise.goal: flat needs at least two capacitor groups that fire at the breech");
    CHECK(wish->goal != CIRCUIT_FIRING_VELOCITY || some_fires(c), STATUS_BAD_INPUT,
          "optimise.goal: velocity needs a charged capacitor group that fires (bank)");
    CHECK(wish->goal != CIRCUIT_FIRING_FLAT || !isnan(wish->peak_current), STATUS_BAD_INPUT,
          "optimise.peak_current is missing [A]: goal flat needs it");
    CHECK(wish->goal != CIRCUIT_FIRING_VELOCITY || !isnan(wish->muzzle_velocity), STATUS_BAD_INPUT,
          "optimise.muzzle_velocity is missing [m/s]: goal velocity needs it");
    return status_ok();
}

status circuit_firing_optimise(const circuit_shot_config *c, const circuit_firing_wish *wish, bool (*stop)(void),
                               circuit_shot_module *modules, circuit_firing_result *out)
{
    return circuit_firing_resume(c, wish, &(circuit_firing_host){ .stop = stop }, modules, out);
}

status circuit_firing_resume(const circuit_shot_config *c, const circuit_firing_wish *wish,
                             const circuit_firing_host *host, circuit_shot_module *modules, circuit_firing_result *out)
{
    const circuit_supply_list *bank = &c->supplies[CIRCUIT_SUPPLY_capacitor];
    const size_t n = bank->n > 0 ? (size_t)bank->n : 1;
    *out = (circuit_firing_result){ .before = NAN, .after = NAN };
    TRY(circuit_firing_check(c, wish));
    search q = { .config = *c,
                 .wish = *wish,
                 .given = bank->item,
                 .modules = modules,
                 .n = bank->n,
                 .most = wish->evaluations - 1, /* the last is that of the best times */
                 .host = host,
                 .out = out,
                 .scale = 1.0,
                 .failed = status_ok() };
    if (bank->n > 0) memcpy(modules, bank->item, n * sizeof *modules);
    q.config.supplies[CIRCUIT_SUPPLY_capacitor].item = modules;
    q.config.n_sites = 0;
    q.config.options.rtol = fmax(c->options.rtol, SEARCH_RTOL);
    q.config.options.atol = 0.01 * q.config.options.rtol;
    q.fit_again = !c->fitted && c->rails.level == CIRCUIT_SHOT_RAILS_SKIN && isnan(c->rails.frequency);
    if (!c->fitted && !q.fit_again) TRY(fit_rails(&q));
    q.moved = malloc(n * sizeof *q.moved);
    CHECK(q.moved, STATUS_MEMORY, "out of memory for %zu groups", n);
    q.n_moved = choose_moved(c, q.moved);
    gsl_error_handler_t *old = gsl_set_error_handler_off();
    const status done = search_run(&q);
    gsl_set_error_handler(old);
    free(q.moved);
    return done;
}
