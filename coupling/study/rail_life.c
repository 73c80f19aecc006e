/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/rail_life.h"

#include "coupling/study/warm_rail.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double FIVE_PERCENT = 0.05;

const char *const study_rail_life_cause_names[] = {
    [RAIL_LIFE_CONTACT] = "contact",       [RAIL_LIFE_HEAT] = "heat",
    [RAIL_LIFE_ENDLESS] = "none",          [RAIL_LIFE_TOO_FAST] = "faster than Rayleigh waves",
    [RAIL_LIFE_UNREACHED] = "not reached", NULL
};

/* All that is flown and what each flight takes. */
typedef struct {
    session *s;
    const case_onset *c;
    const case_life *life;
    const mpm_material *metal;
    life_rail rail;
    double rayleigh;
    size_t size;   /* of a place's rates */
    int *flight;   /* of each shot; owned */
    int flights;   /* flown */
    double **rate; /* of a flight: n places x size; owned */
    double *alone; /* of the first: by contact, then by heat, n x size each; owned */
} work;

void study_rail_life_free(rail_life_result *r)
{
    free(r->place);
    *r = (rail_life_result){ .n = 0 };
}

static void work_free(work *w)
{
    for (int k = 0; w->rate && k < w->flights; k++) free(w->rate[k]);
    free(w->rate);
    free(w->flight);
    free(w->alone);
}

status study_rail_life_possible(const case_onset *c, const case_life *life, const mpm_material *metal)
{
    const double length = c->launcher.barrel.length - c->launcher.barrel.start;
    TRY(mpm_material_check(metal, MPM_MATERIAL_FOR_FATIGUE));
    CHECK(metal->density > 0.0, STATUS_BAD_INPUT, "life.material: %s lacks its density", metal->name);
    CHECK(!life->heat || !isnan(metal->expansion), STATUS_BAD_INPUT,
          "life.material: %s lacks its thermal expansion (or set life.heat: no)", metal->name);
    CHECK(c->launcher.armature.contact_length < length, STATUS_BAD_INPUT,
          "armature.contact_length = %g m: must be shorter than the armature's way, %g m, for life.load: armature",
          c->launcher.armature.contact_length, length);
    return status_ok();
}

/* ---- what a shot does at a place ---- */

static double known_or(double x, double fallback)
{
    return isnan(x) ? fallback : x;
}

/* Of the circuit's rail; another metal than the case asks for has its own constants where they are known. */
static life_heat_metal heat_metal_of(const work *w)
{
    const circuit_shot_rails *r = &w->c->launcher.rails;
    const double warm = 1.0 + r->resistivity_coefficient * (r->initial_temperature - 293.15);
    life_heat_metal heat = { .conductivity = r->thermal_conductivity,
                             .heat_capacity = r->density * r->specific_heat,
                             .resistivity = r->resistivity * warm };
    if (strcmp(w->metal->name, w->life->material) == 0) return heat;
    heat.conductivity = known_or(w->metal->conductivity, heat.conductivity);
    heat.heat_capacity = known_or(w->metal->density * w->metal->specific_heat, heat.heat_capacity);
    heat.resistivity = known_or(w->metal->resistivity, heat.resistivity);
    return heat;
}

/* The first place has had the whole contact run over it, the last is the muzzle. */
static double position_of(const case_onset *c, int k, int n)
{
    const double from = c->launcher.barrel.start + c->launcher.armature.contact_length, to = c->launcher.barrel.length;
    return from + (to - from) * k / (n - 1);
}

static life_passage passage_of(const work *w, const trace_point *at, double exit)
{
    const life_heat_metal metal = heat_metal_of(w);
    const double dwell = w->c->launcher.armature.contact_length / at->v;
    return (life_passage){ .velocity = at->v,
                           .pressure = at->pressure,
                           .friction = at->friction,
                           .heat = life_heat_of(&metal, dwell, at->rail_flux, at->rail_sheet, at->film_rise),
                           .until = exit - at->t + dwell };
}

static void note_place(const work *w, const trace_point *at, const life_passage *p, rail_life_place *out)
{
    const life_heat_metal metal = heat_metal_of(w);
    const contact_speed speed = life_contact_speed(w->rail.youngs, w->rail.poisson, w->rail.density, at->v);
    out->velocity = at->v, out->pressure = at->pressure, out->friction = at->friction;
    out->moving_factor = life_contact_factor(&speed);
    out->rise = p->heat.rise;
    if (!isnan(w->life->probe_depth))
        out->probe_rise = life_heat_largest_rise(&p->heat, w->life->probe_depth, p->until);
    out->flux_rise = life_heat_flux_rise(&metal, p->heat.dwell, at->rail_flux);
}

/* Rates of one flight at every place; of the first also by each cause alone, and what the places are. */
static status take_flight(work *w, const shot_outcome *o, rail_life_result *r)
{
    double *rate = calloc((size_t)r->n * w->size, sizeof *rate);
    CHECK(rate, STATUS_MEMORY, "no memory for %d places", r->n);
    const double exit = o->n_trace > 0 ? o->trace[o->n_trace - 1].t : 0.0;
    double *spare = w->alone + 2 * (size_t)r->n * w->size; /* of causes that are not kept */
    for (int k = 0; k < r->n; k++) {
        trace_point at;
        rail_life_place *p = &r->place[k];
        const bool first = w->flights == 0;
        if (!gouge_trace_at_place(o, p->position, &at) || !(at.v > 0.0))
            p->cause = RAIL_LIFE_UNREACHED;
        else if (at.v >= w->rayleigh)
            p->cause = RAIL_LIFE_TOO_FAST, p->velocity = at.v;
        if (p->cause == RAIL_LIFE_UNREACHED || p->cause == RAIL_LIFE_TOO_FAST) continue;
        const life_passage passage = passage_of(w, &at, exit);
        double *const causes[LIFE_CAUSES] = { [LIFE_BY_BOTH] = rate + (size_t)k * w->size,
                                              [LIFE_BY_CONTACT] = first ? w->alone + (size_t)k * w->size : spare,
                                              [LIFE_BY_HEAT] =
                                                  first ? w->alone + (size_t)(r->n + k) * w->size : spare };
        life_along_passage(&w->rail, &passage, causes);
        if (first) note_place(w, &at, &passage, p);
    }
    w->rate[w->flights++] = rate;
    return status_ok();
}

/* ---- the shots ---- */

static status fly_first(work *w, bool with_history, shot_outcome *flown, rail_life_result *r, shot_record *record)
{
    const case_flight flight = case_flight_of(w->c);
    TRY(gouge_session_shot(w->s, &flight, NULL, with_history, flown, record));
    return take_flight(w, flown, r);
}

static status fly_all(work *w, bool with_history, rail_life_result *r, shot_record *record)
{
    shot_outcome flown;
    shot_record own;
    status done = fly_first(w, with_history, &flown, r, record ? record : &own);
    warm_rail rail = study_warm_rail_begin(w->c, &flown);
    gouge_shot_outcome_free(&flown);
    for (int n = 1; done.code == STATUS_OK && n < r->shots; n++) {
        bool is_flown;
        TRY(study_warm_rail_shoot(w->s, &rail, &is_flown, &flown, &own));
        if (is_flown) {
            done = take_flight(w, &flown, r);
            gouge_shot_outcome_free(&flown);
        }
        w->flight[n] = w->flights - 1;
    }
    r->flights = w->flights;
    return done;
}

/* ---- lives ---- */

static double finite_or_nan(double x)
{
    return isfinite(x) ? x : NAN;
}

static double largest_of(const double *rate, int n)
{
    double most = 0.0;
    for (int k = 0; k < n; k++) most = fmax(most, rate[k]);
    return most;
}

static life_place lives_at(const work *w, const double *const *of, int shots, const int *flight, double factor)
{
    const life_shots all = { .shots = shots, .flight = flight, .rate = of };
    return life_along_place(&w->rail, &all, factor);
}

/* Probability that a place is cracked that has spent so much of its life: where A times its unknown factor spends as
 * much as A times `spent` = 1 would; NaN where the factor's spread is not known. */
static double cracked(double spent, double spread)
{
    if (isnan(spread)) return NAN;
    if (!(spent > 0.0)) return 0.0;
    return spread > 0.0 ? gsl_cdf_ugaussian_P(log(spent) / spread) : spent >= 1.0;
}

static void judge_place(const work *w, int k, const double **of, double spread, rail_life_result *r)
{
    static const int alike = 0;
    rail_life_place *p = &r->place[k];
    if (p->cause == RAIL_LIFE_UNREACHED || p->cause == RAIL_LIFE_TOO_FAST) return;
    for (int n = 0; n < w->flights; n++) of[n] = w->rate[n] + (size_t)k * w->size;
    const double *contact = w->alone + (size_t)k * w->size, *heat = w->alone + (size_t)(r->n + k) * w->size;
    const life_place is = lives_at(w, of, r->shots, w->flight, 1.0);
    const life_place cold = lives_at(w, &contact, 1, &alike, 1.0);
    const size_t depth = (size_t)is.depth_number * (size_t)w->rail.fan.n;
    p->life = finite_or_nan(is.life), p->first = finite_or_nan(is.first);
    p->without_heat = finite_or_nan(cold.life), p->depth_without_heat = cold.depth;
    p->depth = is.depth, p->angle = is.angle;
    p->cause = RAIL_LIFE_ENDLESS;
    r->probability = fmax(r->probability, cracked(is.spent, spread));
    if (isnan(p->life)) return;
    const double by_contact = largest_of(contact + depth, w->rail.fan.n),
                 by_heat = largest_of(heat + depth, w->rail.fan.n);
    p->cause = by_heat > by_contact ? RAIL_LIFE_HEAT : RAIL_LIFE_CONTACT;
    p->range = pow(largest_of(of[0] + depth, w->rail.fan.n) / w->rail.law.A, 1.0 / w->rail.law.m);
    for (int q = 0; q < 2 && !isnan(spread); q++) {
        const double factor = exp((q ? -1.0 : 1.0) * gsl_cdf_ugaussian_Qinv(FIVE_PERCENT) * spread);
        p->interval[q] = lives_at(w, of, r->shots, w->flight, factor).life;
    }
}

static void choose_weakest(rail_life_result *r)
{
    const rail_life_place *weakest = NULL, *cold = NULL;
    for (int k = 0; k < r->n; k++) {
        const rail_life_place *p = &r->place[k];
        if (p->cause == RAIL_LIFE_TOO_FAST && isnan(r->rayleigh_position)) r->rayleigh_position = p->position;
        r->film_limited += p->flux_rise > p->rise;
        if (!isnan(p->without_heat) && (!cold || p->without_heat < cold->without_heat)) cold = p;
        r->lasting = r->lasting || p->cause == RAIL_LIFE_ENDLESS;
        if (isnan(p->life)) continue;
        r->depths[0] = fmin(p->depth, isnan(r->depths[0]) ? INFINITY : r->depths[0]);
        r->depths[1] = fmax(p->depth, isnan(r->depths[1]) ? 0.0 : r->depths[1]);
        if (!weakest || p->life < weakest->life) weakest = p;
    }
    if (cold)
        r->without_heat = cold->without_heat, r->without_heat_position = cold->position,
        r->without_heat_depth = cold->depth_without_heat;
    r->lasting = r->lasting && !weakest && isnan(r->rayleigh_position);
    if (!weakest && !r->lasting) r->probability = NAN;
    if (r->lasting)
        r->cause = RAIL_LIFE_ENDLESS;
    else if (!isnan(r->rayleigh_position))
        r->cause = RAIL_LIFE_TOO_FAST;
    if (!weakest) return;
    r->life = weakest->life, r->first = weakest->first, r->position = weakest->position;
    r->depth = weakest->depth, r->angle = weakest->angle, r->range = weakest->range, r->cause = weakest->cause;
    const double quantiles[3] = { weakest->interval[0], isnan(weakest->interval[0]) ? NAN : weakest->life,
                                  weakest->interval[1] };
    memcpy(r->quantiles, quantiles, sizeof quantiles);
}

/* ---- the whole ---- */

rail_life_result study_rail_life_none(void)
{
    return (rail_life_result){ .life = NAN,
                               .quantiles = { NAN, NAN, NAN },
                               .first = NAN,
                               .position = NAN,
                               .depth = NAN,
                               .angle = NAN,
                               .range = NAN,
                               .cause = RAIL_LIFE_UNREACHED,
                               .depths = { NAN, NAN },
                               .without_heat = NAN,
                               .without_heat_position = NAN,
                               .without_heat_depth = NAN,
                               .probability = NAN,
                               .rayleigh_position = NAN };
}

static status make_room(work *w, rail_life_result *r)
{
    const size_t n = (size_t)r->n, shots = (size_t)r->shots;
    r->place = calloc(n, sizeof *r->place);
    w->flight = calloc(shots, sizeof *w->flight);
    w->rate = calloc(shots, sizeof *w->rate);
    w->alone = calloc((2 * n + 1) * w->size, sizeof *w->alone);
    CHECK(r->place && w->flight && w->rate && w->alone, STATUS_MEMORY, "no memory for %d places and %d shots", r->n,
          r->shots);
    for (int k = 0; k < r->n; k++)
        r->place[k] = (rail_life_place){ .position = position_of(w->c, k, r->n),
                                         .velocity = NAN,
                                         .pressure = NAN,
                                         .friction = NAN,
                                         .moving_factor = NAN,
                                         .rise = NAN,
                                         .flux_rise = NAN,
                                         .probe_rise = NAN,
                                         .life = NAN,
                                         .interval = { NAN, NAN },
                                         .first = NAN,
                                         .depth = NAN,
                                         .angle = NAN,
                                         .range = NAN,
                                         .without_heat = NAN,
                                         .depth_without_heat = NAN };
    return status_ok();
}

static status judge(const work *w, double spread, rail_life_result *r)
{
    const double **of = malloc((size_t)w->flights * sizeof *of);
    CHECK(of, STATUS_MEMORY, "no memory for %d flights", w->flights);
    for (int k = 0; k < r->n; k++) judge_place(w, k, of, spread, r);
    free(of);
    choose_weakest(r);
    return status_ok();
}

status study_rail_life_run(session *s, const case_onset *c, const case_life *life, const mpm_material *metal,
                           bool with_history, rail_life_result *out, shot_record *record)
{
    const double since = host_wall_clock();
    work w = { .s = s, .c = c, .life = life, .metal = metal };
    *out = study_rail_life_none();
    w.rail = (life_rail){ .youngs = metal->youngs_modulus,
                          .poisson = metal->poisson,
                          .density = metal->density,
                          .expansion = life->heat ? metal->expansion : NAN,
                          .law = mpm_fatigue_law(metal),
                          .fan = life->fan == LIFE_LATTICE ? mpm_fatigue_fan_lattice()
                                                           : mpm_fatigue_fan_even(life->directions),
                          .measure = life->measure,
                          .limit = life->limit_index,
                          .half_length = 0.5 * c->launcher.armature.contact_length,
                          .rounding = life->rounding };
    w.rayleigh = out->rayleigh_speed = life_contact_rayleigh(w.rail.youngs, w.rail.poisson, w.rail.density);
    w.size = (size_t)LIFE_DEPTHS * (size_t)w.rail.fan.n;
    out->n = life->places, out->shots = c->study.shots;
    status done = make_room(&w, out);
    if (done.code == STATUS_OK) done = fly_all(&w, with_history, out, record);
    if (done.code == STATUS_OK) done = judge(&w, metal->fatigue_A_spread, out);
    work_free(&w);
    out->wall_seconds = host_wall_clock() - since;
    return done;
}
