/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/onset.h"

#include "coupling/gouge/screen.h"
#include "coupling/study/feedback.h"
#include "coupling/study/sampling/population.h"
#include "coupling/study/sensitivity.h"
#include "coupling/study/warm_rail.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double SURE = 0.95; /* probability from which a population's verdict is given */

void study_onset_answer_free(onset_answer *a)
{
    study_repeated_free(&a->rail);
    study_uncertain_free(&a->uncertain);
    study_families_free(&a->grains);
    gouge_shot_outcome_free(&a->flown);
    study_mc_free(&a->drawn);
    void *const owned[] = { a->site, a->scene, a->size, a->skip, a->sensitivity, a->repeated, a->part, a->along };
    for (size_t k = 0; k < sizeof owned / sizeof owned[0]; k++) free(owned[k]);
    memset(a, 0, sizeof *a);
}

/* ---- the shot and its sites ---- */

static status fill_site(const case_onset *c, int i, const site_state *from, onset_site *to)
{
    const case_surface surface = case_surface_of(c);
    screen hit = { .impact_pressure = NAN, .ratio = NAN, .probability = NAN };
    if (from->reached) TRY(gouge_screen_impact(&surface, c->sites.item[i].height, from->velocity, &hit));
    *to = (onset_site){ .position = from->grain.position,
                        .radius = from->grain.radius,
                        .time = from->time,
                        .velocity = from->velocity,
                        .current = from->current,
                        .contact_pressure = from->contact_pressure,
                        .lead_face_temperature = from->lead_face_temperature,
                        .impact_pressure = hit.impact_pressure,
                        .screen = hit.ratio,
                        .screen_probability = hit.probability,
                        .threshold_velocity = NAN,
                        .threshold_interval = { NAN, NAN },
                        .scratch_velocity = NAN,
                        .scratch_interval = { NAN, NAN },
                        .gouged_volume = NAN,
                        .outcome = SITE_UNDECIDED };
    if (!from->reached)
        to->outcome = SITE_NOT_REACHED;
    else if (hit.skip)
        to->outcome = SITE_SKIPPED;
    return status_ok();
}

static status list_sites(const case_onset *c, onset_answer *a)
{
    const int n = a->flown.n_sites;
    a->site = calloc((size_t)n + 1, sizeof *a->site);
    CHECK(a->site, STATUS_MEMORY, "no memory for %d sites", n);
    for (int i = 0; i < n; i++) TRY(fill_site(c, i, &a->flown.site[i], &a->site[i]));
    a->result.n_sites = n;
    a->result.site = a->site;
    return status_ok();
}

static void unknown_all(onset_result *r)
{
    r->verdict = VERDICT_UNDECIDED;
    r->probability_gouge = r->threshold_velocity = r->threshold_position = r->onset_position = NAN;
    r->growth_deviation = r->threshold_deviation = NAN;
    r->scratch_velocity = r->scratch_position = r->scratch_deviation = NAN;
    r->muzzle_velocity_feedback = r->expected_gouges = r->expected_gouged_volume = NAN;
    for (int k = 0; k < 2; k++) {
        r->threshold_interval[k] = r->threshold_position_interval[k] = r->onset_interval[k] = NAN;
        r->scratch_interval[k] = r->scratch_position_interval[k] = NAN;
        r->expected_gouges_interval[k] = r->expected_gouged_volume_interval[k] = NAN;
    }
}

status study_onset_begin(session *s, const case_onset *c, const char *prefix, bool first, onset_answer *out)
{
    const case_flight flight = case_flight_of(c);
    memset(out, 0, sizeof *out);
    unknown_all(&out->result);
    out->first = first;
    TRY(gouge_session_shot(s, &flight, NULL, first, &out->flown, &out->shot));
    TRY(list_sites(c, out));
    return study_families_sort(c, &out->flown, prefix, &out->grains);
}

/* ---- random shots ---- */

/* On the rail of shot k where that is changed most, by the same factors as in the random shots. */
static double threshold_of_shot(const onset_answer *a, int k)
{
    double radius;
    const grain_family *f = study_onset_leading_grain(a, &radius);
    const double cold = a->result.threshold_velocity;
    double here = cold;
    for (int i = 0; i < MC_CHANGES && isfinite(cold); i++) {
        const changed_rail *rail = &a->rail.changed[i];
        const grain_family *hot = f && rail->grains.n ? study_family_alike(&rail->grains, f) : NULL;
        if (!hot) continue;
        const double share = fmin(a->rail.shot[k].most[i] / rail->most, 1.0),
                     found = study_surface_at(&hot->surface, radius).velocity,
                     there = isfinite(found) ? found : INFINITY;
        here = study_mc_threshold_changed(here, cold, there, share);
    }
    return isfinite(here) ? here : NAN;
}

static status list_shots(onset_answer *a)
{
    onset_result *r = &a->result;
    const repeated_shot alone = { .muzzle_velocity = a->shot.is.muzzle_velocity, .most = { 0.0, NAN, NAN } };
    a->repeated = calloc((size_t)a->drawn.shots, sizeof *a->repeated);
    CHECK(a->repeated, STATUS_MEMORY, "no memory for %d shots", a->drawn.shots);
    for (int k = 0; k < a->drawn.shots; k++) {
        const mc_shot *from = &a->drawn.of[k];
        const repeated_shot *found = a->rail.shots ? &a->rail.shot[k] : &alone;
        a->repeated[k] = (onset_shot){ .shot = k + 1,
                                       .muzzle_velocity = found->muzzle_velocity,
                                       .rail_rise = found->most[MC_WARMTH],
                                       .layer_worn = found->most[MC_WEAR],
                                       .deposit = found->most[MC_METAL],
                                       .threshold_velocity = threshold_of_shot(a, k),
                                       .probability_gouge = from->probability,
                                       .expected_gouges = from->gouges,
                                       .expected_gouged_volume = from->volume,
                                       .onset_position = from->first[1],
                                       .onset_interval = { from->first[0], from->first[2] } };
    }
    r->shot = a->repeated;
    r->n_shots = a->drawn.shots;
    return status_ok();
}

static status list_along(onset_answer *a, double length)
{
    enum { EVERY = 10, PLACES = MC_BINS / EVERY };
    a->along = malloc(2 * PLACES * sizeof *a->along);
    CHECK(a->along, STATUS_MEMORY, "no memory for a summary");
    for (int k = 0; k < PLACES; k++) {
        a->along[k] = length * (k + 1) / PLACES;
        a->along[PLACES + k] = a->drawn.of[0].before[EVERY * (k + 1) - 1];
    }
    a->result.n_along = PLACES;
    a->result.along = a->along;
    a->result.probability_along = a->along + PLACES;
    return status_ok();
}

static status draw_shots(session *s, onset_answer *a)
{
    const case_onset *c = a->grains.c;
    onset_result *r = &a->result;
    const mc_surface one = study_repeated_surface(&a->rail, &a->grains);
    const mc_plan plan = { .histories = c->study.sampled,
                           .shots = c->study.shots,
                           .seed = c->study.seed,
                           .length = c->launcher.barrel.length,
                           .n = 1,
                           .surface = &one,
                           .stop = s->stop,
                           .progress = &s->progress };
    TRY(study_mc_run(&plan, &a->drawn));
    const mc_shot *first = &a->drawn.of[0];
    r->histories = a->drawn.histories;
    r->monte_carlo_seconds = a->drawn.seconds;
    r->expected_gouges = first->gouges;
    r->expected_gouged_volume = first->volume;
    memcpy(r->expected_gouges_interval, first->gouges_interval, sizeof first->gouges_interval);
    memcpy(r->expected_gouged_volume_interval, first->volume_interval, sizeof first->volume_interval);
    TRY(list_shots(a));
    return list_along(a, c->launcher.barrel.length);
}

static void forget_gouges(onset_result *r)
{
    r->expected_gouges = r->expected_gouged_volume = NAN;
    for (int k = 0; k < 2; k++) r->expected_gouges_interval[k] = r->expected_gouged_volume_interval[k] = NAN;
}

/* Nobody knows how many of such grains gouge and where the first one lies. */
static void forget_undrawn(onset_answer *a)
{
    onset_result *r = &a->result;
    if (!study_onset_is_undrawn(a)) return;
    forget_gouges(r);
    r->n_along = 0;
    for (int k = 0; k < r->n_shots; k++) {
        onset_shot *shot = &a->repeated[k];
        shot->probability_gouge = shot->expected_gouges = shot->expected_gouged_volume = NAN;
        shot->onset_position = shot->onset_interval[0] = shot->onset_interval[1] = NAN;
    }
    if (a->grains.c->populations.n > 0) r->onset_position = r->onset_interval[0] = r->onset_interval[1] = NAN;
}

/* With a population the answer is that of the random shots. */
static void conclude_population(onset_answer *a)
{
    onset_result *r = &a->result;
    const mc_shot *first = &a->drawn.of[0];
    const bool contradicted = study_onset_contradiction(a) != NULL;
    if (a->grains.c->populations.n == 0) return;
    /* grains of which the screen alone speaks are not drawn; those that scenes contradict have no probability */
    const double p = fmax(first->probability, a->grains.screen_probability);
    r->probability_gouge = contradicted && p > 0.0 ? NAN : p;
    r->verdict = p < 1.0 - SURE                                ? VERDICT_NO_GOUGING
                 : first->probability >= SURE && !contradicted ? VERDICT_GOUGES
                                                               : VERDICT_UNDECIDED;
    r->onset_position = first->first[1];
    r->onset_interval[0] = first->first[0];
    r->onset_interval[1] = first->first[2];
    if (!study_onset_is_unseen(a)) return;
    forget_gouges(r);
    r->verdict = VERDICT_UNDECIDED;
    r->probability_gouge = NAN;
}

/* ---- beside it: the null models ---- */

/* Height of the grain that speaks for the case; of the first one where none has scenes; 0: there is none [m]. */
static double leading_height(const onset_answer *a)
{
    const case_onset *c = a->grains.c;
    double radius;
    const grain_family *f = study_onset_leading_grain(a, &radius);
    if (f) return f->aspect * radius;
    if (c->sites.n > 0) return c->sites.item[0].height;
    if (c->populations.n == 0) return 0.0;
    return c->populations.item[0].aspect * study_population_quantile(&c->populations.item[0], 0.5);
}

static status ask_null_models(onset_answer *a)
{
    const case_surface surface = case_surface_of(a->grains.c);
    const double height = leading_height(a);
    null_model found[NULL_MODELS];
    if (!(height > 0.0)) return status_ok();
    TRY(gouge_null_models(&surface, height, found));
    for (int i = 0; i < NULL_MODELS; i++) {
        onset_null_model *to = &a->null_model[i];
        const double v = found[i].threshold_velocity;
        *to = (onset_null_model){ .threshold_velocity = isfinite(v) ? v : NAN,
                                  .threshold_interval = { found[i].threshold_interval[0],
                                                          found[i].threshold_interval[1] },
                                  .threshold_position = gouge_trace_place(&a->flown, v) };
        snprintf(to->name, sizeof to->name, "%s", found[i].name);
        snprintf(to->says, sizeof to->says, "%s", found[i].says);
    }
    a->result.n_null_models = NULL_MODELS;
    a->result.null_model = a->null_model;
    return status_ok();
}

/* ---- in words ---- */

static const onset_site *fastest_site(const onset_answer *a)
{
    const onset_site *fastest = NULL;
    for (int i = 0; i < a->result.n_sites; i++)
        if (isfinite(a->site[i].velocity) && (!fastest || a->site[i].velocity > fastest->velocity))
            fastest = &a->site[i];
    return fastest;
}

/* The site that the verdict rests on: the first that gouges, or is undecided; else the fastest. */
static const onset_site *deciding_site(const onset_answer *a)
{
    const onset_verdict verdict = a->result.verdict;
    const site_outcome of = verdict == VERDICT_GOUGES ? SITE_GOUGE : SITE_UNDECIDED;
    for (int i = 0; verdict != VERDICT_NO_GOUGING && i < a->result.n_sites; i++)
        if (a->site[i].outcome == of) return &a->site[i];
    return fastest_site(a);
}

/* Would a reader of the threshold's line expect another verdict?  That line is of one grain at any speed, the verdict
 * of the sites: each at its own speed, with its own grain's interval. */
static bool seems_contradicted(const onset_answer *a)
{
    const onset_result *r = &a->result;
    const onset_site *fastest = fastest_site(a);
    if (!fastest || a->grains.c->populations.n > 0 || !isfinite(r->threshold_velocity)) return false;
    if (r->verdict == VERDICT_GOUGES) return fastest->velocity < r->threshold_interval[1];
    return fastest->velocity > r->threshold_interval[0] || isfinite(r->threshold_position);
}

static void say(onset_result *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(onset_result *r, const char *format, ...)
{
    va_list args;
    const size_t used = strlen(r->reason);
    va_start(args, format);
    vsnprintf(r->reason + used, sizeof r->reason - used, format, args);
    va_end(args);
}

/* The fastest site; where the verdict seems to contradict the threshold's line, the numbers that it rests on. */
static void say_sites(onset_answer *a)
{
    onset_result *r = &a->result;
    const onset_site *fastest = fastest_site(a);
    if (fastest)
        say(r, "; fastest site %.0f m/s", fastest->velocity);
    else if (r->n_sites > 0)
        say(r, "; no site is reached");
    if (!seems_contradicted(a)) return;
    const onset_site *site = deciding_site(a);
    const double *of = site->threshold_interval;
    if (isnan(of[0]) || isnan(of[1])) return;
    say(r,
        "; the verdict is the sites': the one at %.3f m, passed at %.0f m/s, lies %s its grain's interval, %.0f .. "
        "%.0f m/s",
        site->position, site->velocity,
        site->velocity >= of[1]   ? "above"
        : site->velocity <= of[0] ? "below"
                                  : "inside",
        of[0], of[1]);
}

static void say_velocities(onset_result *r, double velocity, const double interval[2])
{
    say(r, "%.0f m/s (", velocity);
    for (int k = 0; k < 2; k++) {
        if (isnan(interval[k]))
            say(r, "not known");
        else
            say(r, "%.0f", interval[k]);
        say(r, k ? ")" : " .. ");
    }
}

/* With its place; an end of the interval that the armature does not reach has none. */
static void say_threshold(onset_result *r)
{
    const double *v = r->threshold_interval, *x = r->threshold_position_interval;
    say(r, "threshold ");
    say_velocities(r, r->threshold_velocity, v);
    if (isnan(r->threshold_position)) {
        say(r, " is not passed");
        return;
    }
    say(r, " is passed at x = %.3f m (", r->threshold_position);
    if (isnan(x[0]))
        say(r, "not known .. ");
    else
        say(r, "%.3f .. ", x[0]);
    if (isnan(x[1]))
        say(r, isnan(v[1]) ? "not known)" : "the muzzle or not at all)");
    else
        say(r, "%.3f)", x[1]);
}

/* Neither end of the leading grain's interval is known: what its family's own search has seen. */
static void say_nothing_known(onset_result *r, const grain_family *f, double radius)
{
    const surface_result *s = &f->surface;
    const threshold_outcome is = s->reference.outcome;
    const double own = f->plan.size[f->plan.reference];
    if (!s->reference.monotone)
        say(r, "no threshold was found: slow scenes gouge, the fastest does not");
    else if (own != radius && (is == THRESHOLD_BELOW || is == THRESHOLD_ABOVE))
        say(r, "no threshold was found for grains of %.3g mm: those of %.3g mm %s", 1e3 * radius, 1e3 * own,
            is == THRESHOLD_BELOW ? "gouge in the slowest scene" : "do not gouge in the fastest scene");
    else
        say(r, "no threshold was found: no scene of the search decides");
}

static void explain(onset_answer *a)
{
    onset_result *r = &a->result;
    double radius;
    const grain_family *f = study_onset_leading_grain(a, &radius);
    const bool spent = f && f->surface.reference.outcome == THRESHOLD_UNKNOWN;
    const double none[2] = { 0.0, 0.0 }, *allowance = f ? f->surface.reference.allowance : none;
    if (study_onset_is_unseen(a))
        say(r,
            "no scene was run: grains of a population below study.smallest_radius = %g um are taken not to gouge, and "
            "nothing shows it",
            1e6 * a->grains.c->study.smallest_radius);
    else if (a->grains.n == 0 && a->grains.unbacked == 0)
        say(r, "no grain is reached that could be looked at");
    else if (a->grains.n == 0)
        say(r,
            "no scene was run: impact pressure over hardness lies below study.screen_low = %g everywhere, which alone "
            "gives a probability of %.3g",
            a->grains.c->study.screen_low, a->grains.screen_probability);
    else if (isfinite(r->threshold_velocity))
        say_threshold(r);
    else if (f && f->scatter.against > 0.0)
        say(r, "%s on the case's own grid, but on a shifted one the scene at %g m/s does not decide so",
            f->surface.reference.outcome == THRESHOLD_ABOVE ? "no threshold was found" : "all scenes gouge",
            f->scatter.against);
    else if (isnan(r->threshold_interval[0]) && isnan(r->threshold_interval[1]))
        say_nothing_known(r, f, radius);
    else if (isnan(r->threshold_interval[0]))
        say(r, "threshold at or below %.0f m/s, %s", r->threshold_interval[1] - allowance[1],
            spent ? "the slowest of study.max_scenes" : "where the search began");
    else
        say(r, "threshold above %.0f m/s, %s", r->threshold_interval[0] + allowance[0],
            spent ? "the fastest of study.max_scenes" : "where the search ended");
    if (isfinite(r->scratch_velocity)) {
        say(r, "; grooves grow from ");
        say_velocities(r, r->scratch_velocity, r->scratch_interval);
        say(r, " on");
    }
    if (study_onset_contradiction(a)) say(r, "; but whole scenes contradict: %s", study_onset_contradiction(a));
    say_sites(a);
    if (a->grains.c->populations.n > 0 && isfinite(r->expected_gouges))
        say(r, "; %.3g gouges a shot (%.3g .. %.3g)", r->expected_gouges, r->expected_gouges_interval[0],
            r->expected_gouges_interval[1]);
    if (isfinite(r->muzzle_velocity_feedback))
        say(r, "; muzzle velocity %.1f m/s, with the gouges %.1f m/s", a->shot.is.muzzle_velocity,
            r->muzzle_velocity_feedback);
}

/* ---- the whole ---- */

/* By resolution, size, velocity, then name: whatever the order in which several processes brought them. */
static int in_order(const void *left, const void *right)
{
    const onset_scene *a = left, *b = right;
    const double by[][2] = { { a->cells_per_radius, b->cells_per_radius },
                             { a->radius, b->radius },
                             { a->velocity, b->velocity } };
    for (size_t i = 0; i < sizeof by / sizeof *by; i++)
        if (by[i][0] != by[i][1]) return by[i][0] < by[i][1] ? -1 : 1;
    return strcmp(a->name, b->name);
}

status study_onset_list_scenes(session *s, onset_scene **out, int *n, int *run, int *reused)
{
    *n = *run = *reused = 0;
    *out = calloc((size_t)s->n_records + 1, sizeof **out);
    CHECK(*out, STATUS_MEMORY, "no memory for %d scenes", s->n_records);
    for (*n = 0; *n < s->n_records; (*n)++) {
        (*out)[*n] = s->record[*n]->entry;
        *(s->record[*n]->entry.reused ? reused : run) += 1;
    }
    qsort(*out, (size_t)*n, sizeof **out, in_order);
    for (int i = 0; i < *n; i++) run_scenes_warn_of(s, &(*out)[i]);
    return status_ok();
}

status study_onset_possible(const case_onset *c)
{
    const int most = study_family_kinds(c) * (1 + (c->study.judge == JUDGE_GROWTH ? c->study.craters : 0));
    const bool follows = c->study.shots > 1;
    if (!follows && most <= c->study.max_scenes) return status_ok();
    onset_answer a;
    session silent = { .threads = 1 };
    host_progress_open(&silent.progress, stderr, true);
    host_timing_open(&silent.timing);
    status s = study_onset_begin(&silent, c, "", false, &a);
    if (s.code == STATUS_OK && follows) s = study_warm_rail_follows(&silent, c, a.grains.flown);
    study_onset_answer_free(&a);
    return s.code == STATUS_BAD_INPUT ? s : status_ok(); /* the run tells what else may happen */
}

/* What further shots find. */
static status search_repeated(session *s, onset_answer *a)
{
    grain_families *wanted[REPEATED_RAILS];
    int n;
    TRY(study_repeated_want(s, &a->grains, &a->rail, wanted, &n));
    TRY(n > 0 ? study_families_search(s, wanted, n) : status_ok());
    study_repeated_found(&a->rail, &a->grains, &a->uncertain);
    return status_ok();
}

static status study(session *s, const case_onset *c, onset_answer *a)
{
    grain_families *const all[] = { &a->grains };
    TRY(study_onset_begin(s, c, "", true, a));
    study_families_want_scratch(&a->grains);
    TRY(study_repeated_fly(s, &a->grains, &a->shot, &a->rail));
    TRY(study_families_search(s, all, 1));
    TRY(study_scatter_run(s, &a->grains));
    TRY(study_uncertain_run(s, &a->grains, &a->uncertain));
    TRY(study_onset_judge(s, a));
    TRY(search_repeated(s, a));
    TRY(draw_shots(s, a));
    conclude_population(a);
    forget_undrawn(a);
    TRY(study_feedback_shot(s, a));
    TRY(study_sensitivities_run(s, a));
    TRY(ask_null_models(a));
    explain(a);
    return status_ok();
}

status study_onset_run(session *s, const case_onset *c, onset_answer *out)
{
    const status done = study(s, c, out);
    onset_result *r = &out->result;
    const status listed = study_onset_list_scenes(s, &out->scene, &r->n_scenes, &r->scenes_run, &r->scenes_reused);
    r->scene = out->scene;
    r->wall_seconds = run_session_wall(s);
    return done.code == STATUS_OK ? listed : done;
}
