/* SPDX-License-Identifier: BSD-3-Clause */
/* A current that is given: i = I(t - fire_at), algebraic, I the monotone cubic (Steffen 1990) through the points; its
 * slope drives the rails' inductance.  The power V i that this takes is booked as supplied.  y = i. */
#include "circuit/supply/supply_kind.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>

enum { MAX_POINTS = 5000 };
static const double REST = 0.05; /* of the peak: a measured current may end with it, and falls to 0 in an interval */

const base_param circuit_supply_profile_params[] = {
    PARAM_INT(circuit_supply_profile, count, 1, 1, 1e6, "factor on the current"),
    PARAM_DOUBLE(circuit_supply_profile, scale, "1", 1.0, 1e-6, 1e6, "factor on the currents of its points"),
    PARAM_LONG_STRING(circuit_supply_profile, file, "",
                      "table of time [s] and current [A], a row a point; looked for beside the case"),
    PARAM_DOUBLE(circuit_supply_profile, fire_at, "s", 0.0, 0.0, INFINITY,
                 "instant at which the profile's time is 0; beyond options.max_time = never"),
    SUPPLY_POSITION(circuit_supply_profile),
    PARAMS_END
};

const base_param circuit_supply_point_params[] = {
    PARAM_DOUBLE(circuit_supply_point, time, "s", REQUIRED, 0.0, 1e3, "from fire_at"),
    PARAM_DOUBLE(circuit_supply_point, current, "A", REQUIRED, -1e9, 1e9, "current then"), PARAMS_END
};

typedef struct {
    gsl_interp *interp;
    int n;
    double *t, *i; /* n each, in one piece */
} profile_curve;

static double peak_of(const circuit_supply_profile *p)
{
    double peak = 1.0;
    for (int k = 0; k < p->points.n; k++) peak = fmax(peak, fabs(p->scale * p->points.item[k].current));
    return peak;
}

static status check(const void *params, const char *where)
{
    const circuit_supply_profile *p = params;
    const int n = p->points.n;
    CHECK(n >= 3 && n <= MAX_POINTS, STATUS_BAD_INPUT, "%s: %d points: needs 3 .. %d; give `file` or `points`", where,
          n, MAX_POINTS);
    const circuit_supply_point *q = p->points.item;
    const double rest = fabs(p->scale * q[n - 1].current);
    CHECK(q[0].time == 0.0 && q[0].current == 0.0 && rest <= REST * peak_of(p), STATUS_BAD_INPUT,
          "%s: runs from %g A at %g s to %g A: the first point must be 0 A at 0 s, the last within 5 %% of the peak",
          where, q[0].current, q[0].time, q[n - 1].current);
    for (int k = 1; k < n; k++) {
        CHECK(q[k].time > q[k - 1].time && isfinite(q[k].current), STATUS_BAD_INPUT,
              "%s: point %d, %g s %g A: times must ascend, currents be finite", where, k, q[k].time, q[k].current);
    }
    return status_ok();
}

static void release(supply_group *g)
{
    profile_curve *c = g->curve;
    if (!c) return;
    gsl_interp_free(c->interp);
    free(c->t);
    free(c);
}

static status prepare(supply_group *g)
{
    const circuit_supply_profile *p = g->p;
    const circuit_supply_point *point = p->points.item;
    const int last = p->points.n - 1;
    const size_t given = (size_t)p->points.n, n = given + (point[last].current != 0.0);
    profile_curve *c = g->curve = calloc(1, sizeof *c);
    CHECK(c, STATUS_MEMORY, "out of memory for a current profile");
    c->n = (int)n;
    c->t = malloc(2 * n * sizeof *c->t);
    gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own ends the program */
    c->interp = gsl_interp_alloc(gsl_interp_steffen, n);
    gsl_set_error_handler(handler);
    CHECK(c->t && c->interp, STATUS_MEMORY, "out of memory for a current profile of %d points", c->n);
    c->i = c->t + n;
    for (size_t k = 0; k < given; k++) c->t[k] = point[k].time, c->i[k] = p->scale * point[k].current;
    if (n > given) c->t[given] = 2.0 * point[last].time - point[last - 1].time, c->i[given] = 0.0;
    CHECK(gsl_interp_init(c->interp, c->t, c->i, n) == GSL_SUCCESS, STATUS_NUMERICAL,
          "a current profile of %d points fits no curve", c->n);
    return status_ok();
}

static int unknowns(const void *p)
{
    (void)p;
    return 1;
}

static bool reverses(const void *params)
{
    const circuit_supply_profile *p = params;
    for (int k = 0; k < p->points.n; k++)
        if (p->points.item[k].current < 0.0) return true;
    return false;
}

static double rise(const void *params)
{
    const circuit_supply_profile *p = params;
    const double peak = peak_of(p);
    int k = 0;
    while (k < p->points.n && fabs(p->scale * p->points.item[k].current) < peak) k++;
    return k < p->points.n ? p->points.item[k].time : p->points.item[p->points.n - 1].time;
}

static void start(const void *params, double *y, supply_scale *scale)
{
    const double peak = peak_of(params);
    (void)y;
    /* what a metre or two of rails takes in field and motion */
    *scale = (supply_scale){ .y = { peak }, .voltage = 1.0, .energy = 1e-6 * peak * peak };
}

static bool algebraic(const supply_group *g, int j)
{
    return j == 0 && g->gate == GATE_ON;
}

static void flow(const supply_group *g, double t, const double *y, supply_flow *f)
{
    const profile_curve *c = g->curve;
    (void)y;
    const double since = fmin(fmax(t - g->at.fire_at, 0.0), c->t[c->n - 1]);
    f->rate[0] = gsl_interp_eval(c->interp, c->t, c->i, since, NULL);
    f->push = gsl_interp_eval_deriv(c->interp, c->t, c->i, since, NULL);
}

static double knot(const supply_group *g, double t)
{
    const profile_curve *c = g->curve;
    const double since = t - g->at.fire_at;
    const size_t k = gsl_interp_bsearch(c->t, fmax(since, 0.0), 0, (size_t)c->n - 1);
    return g->at.fire_at + c->t[since < 0.0 ? 0 : k + 1];
}

static double root(const supply_group *g, double t, const double *y)
{
    const profile_curve *c = g->curve;
    (void)y;
    if (g->gate != GATE_ON) return 1.0;
    return (g->at.fire_at + c->t[c->n - 1] - t) / c->t[c->n - 1];
}

static circuit_shot_event_kind next(supply_group *g, double *y)
{
    y[0] = 0.0;
    g->gate = GATE_BLOCKED;
    return CIRCUIT_SHOT_BLOCKED;
}

static void stored(const supply_group *g, const double *y, double *e)
{
    (void)g;
    (void)y;
    (void)e;
}

static double voltage(const supply_group *g, const double *y)
{
    (void)g;
    (void)y;
    return 0.0;
}

const supply_kind circuit_kind_profile = {
    .name = "profile",
    .params = circuit_supply_profile_params,
    .size = sizeof(circuit_supply_profile),
    .charge = offsetof(circuit_supply_profile, scale),
    .source = true,
    .check = check,
    .prepare = prepare,
    .release = release,
    .unknowns = unknowns,
    .reverses = reverses,
    .rise = rise,
    .start = start,
    .flow = flow,
    .algebraic = algebraic,
    .knot = knot,
    .root = root,
    .next = next,
    .stored = stored,
    .voltage = voltage,
};
