#include "coupling/study/onset.h"

#include "coupling/handoff/screen.h"
#include "coupling/study/scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PRESSURE_STEP = 5e6; /* [Pa] */
static const double TRUSTED_CELLS = 5.0; /* a radius: below, the threshold hangs on the resolution (NUMERICS.md) */

void onset_answer_free(onset_answer *a)
{
    free(a->site);
    free(a->scene);
    free(a->kind);
    free(a->kind_of);
    memset(a, 0, sizeof *a);
}

/* ---- sites and kinds ---- */

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static bool same_kind(const case_site *a, const case_site *b)
{
    return a->radius == b->radius && a->height == b->height && strcmp(a->shape, b->shape) == 0 &&
           strcmp(a->material, b->material) == 0 && same_number(a->bond_strength, b->bond_strength);
}

static status fill_site(const breech_case *c, const site_state *from, onset_site *to)
{
    screen hit = { NAN, NAN, false, false };
    if (from->reached) TRY(screen_impact(c, from->velocity, &hit));
    *to = (onset_site){ .position = from->grain.position,
                        .radius = from->grain.radius,
                        .time = from->time,
                        .velocity = from->velocity,
                        .current = from->current,
                        .contact_pressure = from->contact_pressure,
                        .impact_pressure = hit.impact_pressure,
                        .screen = hit.ratio,
                        .threshold_velocity = NAN,
                        .threshold_interval = { NAN, NAN },
                        .gouged_volume = NAN,
                        .outcome = SITE_UNDECIDED };
    if (!from->reached)
        to->outcome = SITE_NOT_REACHED;
    else if (hit.skip)
        to->outcome = SITE_SKIPPED;
    return status_ok();
}

static int kind_for(onset_answer *a, const case_site *grain)
{
    for (int k = 0; k < a->kinds; k++)
        if (same_kind(&a->kind[k].grain, grain)) return k;
    a->kind[a->kinds].grain = *grain;
    return a->kinds++;
}

static status sort_sites(const session *s, const shot_outcome *flown, onset_answer *a)
{
    const size_t n = (size_t)flown->n_sites;
    a->site = calloc(n + 1, sizeof *a->site);
    a->kind = calloc(n + 1, sizeof *a->kind);
    a->kind_of = calloc(n + 1, sizeof *a->kind_of);
    CHECK(a->site && a->kind && a->kind_of, STATUS_MEMORY, "no memory for %zu sites", n);
    for (size_t i = 0; i < n; i++) {
        TRY(fill_site(s->c, &flown->site[i], &a->site[i]));
        a->kind_of[i] = a->site[i].outcome == SITE_UNDECIDED ? kind_for(a, &flown->site[i].grain) : -1;
        if (a->kind_of[i] >= 0) a->kind[a->kind_of[i]].sites++;
    }
    a->result.n_sites = (int)n;
    a->result.site = a->site;
    return status_ok();
}

/* ---- a scene of a kind at a velocity ---- */

typedef struct {
    session *session;
    const shot_outcome *flown;
    grain_kind *kind;
    int number; /* of the kind, from 1 */
} scene_source;

static double contact_pressure_at(const scene_source *from, double v)
{
    const shot_outcome *flown = from->flown;
    const double given = from->session->c->scene.contact_pressure;
    trace_point at = flown->n_trace > 0 ? flown->trace[flown->n_trace - 1] : (trace_point){ .contact_pressure = 0.0 };
    if (!isnan(given)) return given;
    trace_at_velocity(flown, v, &at);
    return PRESSURE_STEP * round(at.contact_pressure / PRESSURE_STEP);
}

static status run_at(void *user, double velocity, double cells_per_radius, threshold_sample *out)
{
    scene_source *from = user;
    const breech_case *c = from->session->c;
    const scene_record *done;
    scene_query query = { .c = c,
                          .cells_per_radius = cells_per_radius,
                          .state = { .grain = from->kind->grain,
                                     .reached = true,
                                     .velocity = velocity,
                                     .contact_pressure = contact_pressure_at(from, velocity),
                                     .rail_temperature = c->rail.temperature,
                                     .armature_temperature = c->projectile.temperature } };
    snprintf(query.name, sizeof query.name, "g%d-v%g-c%g", from->number, velocity, cells_per_radius);
    TRY(scenes_all(from->session, &query, 1, &done));
    const scene_result *r = &done->entry.result;
    *out = (threshold_sample){ .excess = r->severity - c->scene.limit_severity, .class = r->class };
    return status_ok();
}

/* ---- the searches ---- */

static status plan_search(const session *s, threshold_plan *plan)
{
    const case_study *y = &s->c->study;
    double sure;
    TRY(screen_velocity(s->c, y->screen_low, &sure));
    *plan = (threshold_plan){ .low = fmax(y->velocity_low, fmin(sure, 0.5 * y->velocity_high)),
                              .high = y->velocity_high,
                              .interval = y->velocity_interval,
                              .step = threshold_step(y->velocity_interval),
                              .coarse = y->coarse_cells_per_radius,
                              .fine = y->fine_cells_per_radius,
                              .max_scenes = y->max_scenes };
    return status_ok();
}

static status search_all(session *s, const shot_outcome *flown, onset_answer *a)
{
    threshold_plan plan;
    int left = s->c->study.max_scenes;
    TRY(plan_search(s, &plan));
    for (int k = 0; k < a->kinds; k++) {
        CHECK(left > 0, STATUS_BAD_INPUT,
              "study.max_scenes = %d: spent on %d of %d kinds of grain; allow more or make the sites alike",
              plan.max_scenes, k, a->kinds);
        scene_source from = { s, flown, &a->kind[k], k + 1 };
        plan.max_scenes = left;
        TRY(threshold_search(&plan, &(threshold_source){ run_at, &from }, &a->kind[k].threshold));
        left -= a->kind[k].threshold.samples;
        if (a->kind[k].threshold.warning[0]) session_warn(s, "%s", a->kind[k].threshold.warning);
    }
    if (a->kinds && plan.fine < TRUSTED_CELLS)
        session_warn(
            s,
            "thresholds at %g cells a radius: below %g they still depend on the resolution; the interval holds the "
            "shift from %g to %g cells, not what finer cells would add",
            plan.fine, TRUSTED_CELLS, plan.coarse, plan.fine);
    return status_ok();
}

/* ---- judging the sites ---- */

/* The scene of the kind that is nearest in velocity, among those of its best resolution. */
static const scene_record *nearest_scene(const session *s, int kind, double velocity)
{
    char prefix[24];
    const scene_record *best = NULL;
    snprintf(prefix, sizeof prefix, "g%d-", kind + 1);
    for (int i = 0; i < s->n_records; i++) {
        const scene_record *a = s->record[i];
        if (strncmp(a->entry.name, prefix, strlen(prefix)) != 0) continue;
        const bool finer = best && a->entry.cells_per_radius > best->entry.cells_per_radius;
        const bool coarser = best && a->entry.cells_per_radius < best->entry.cells_per_radius;
        const bool nearer = !best || fabs(a->entry.velocity - velocity) < fabs(best->entry.velocity - velocity);
        if (finer || (!coarser && nearer)) best = a;
    }
    return best;
}

static site_outcome outcome_at(const threshold_result *t, double v, const scene_record *near)
{
    if (!isnan(t->interval[1]) && v >= t->interval[1]) return SITE_GOUGE;
    if (isnan(t->interval[0]) || v > t->interval[0]) return SITE_UNDECIDED;
    return near && near->entry.result.class == DAMAGE_NONE ? SITE_NONE : SITE_SCRATCH;
}

/* Where v lies in the interval, 0 below, 1 above; NaN where an end is unknown and v beyond the known one. */
static double probability_at(const threshold_result *t, double v)
{
    const double lo = t->interval[0], hi = t->interval[1];
    if (!isnan(hi) && v >= hi) return 1.0;
    if (!isnan(lo) && v <= lo) return 0.0;
    return (v - lo) / (hi - lo);
}

static void judge_sites(const session *s, onset_answer *a)
{
    for (int i = 0; i < a->result.n_sites; i++) {
        onset_site *site = &a->site[i];
        if (a->kind_of[i] < 0) continue;
        const threshold_result *t = &a->kind[a->kind_of[i]].threshold;
        const scene_record *near = nearest_scene(s, a->kind_of[i], site->velocity);
        site->threshold_velocity = t->velocity;
        site->threshold_interval[0] = t->interval[0];
        site->threshold_interval[1] = t->interval[1];
        site->outcome = outcome_at(t, site->velocity, near);
        if (near) memcpy(site->scene, near->entry.name, sizeof site->scene);
        if (site->outcome != SITE_GOUGE) continue;
        a->gouges++;
        if (near) site->gouged_volume = near->entry.result.crater_volume;
    }
}

/* ---- the verdict ---- */

/* First site along the barrel, of those with an answer to be had, whose velocity has passed `end` of its kind's threshold:
 * 0, 1 the interval's ends, 2 the threshold itself.  -1 if none. */
static int first_site(const onset_answer *a, int end)
{
    int first = -1;
    for (int i = 0; i < a->result.n_sites; i++) {
        if (a->kind_of[i] < 0) continue;
        const threshold_result *t = &a->kind[a->kind_of[i]].threshold;
        const double v = a->site[i].velocity, at = end < 2 ? t->interval[end] : t->velocity;
        const bool passed = end == 0 ? !(v <= at) : v >= (isnan(at) ? t->interval[1] : at);
        if (passed && (first < 0 || a->site[i].position < a->site[first].position)) first = i;
    }
    return first;
}

static double position_of(const onset_answer *a, int site)
{
    return site < 0 ? NAN : a->site[site].position;
}

static double largest_probability(const onset_answer *a)
{
    double p = 0.0;
    bool unknown = false;
    for (int i = 0; i < a->result.n_sites; i++) {
        if (a->kind_of[i] < 0) continue;
        const double here = probability_at(&a->kind[a->kind_of[i]].threshold, a->site[i].velocity);
        unknown = unknown || isnan(here);
        if (here > p) p = here;
    }
    return unknown && p < 1.0 ? NAN : p;
}

/* The kind that speaks for the case: that of the onset, else the one with the lowest threshold. */
static int leading_kind(const onset_answer *a, int onset_site_index)
{
    if (onset_site_index >= 0) return a->kind_of[onset_site_index];
    int best = a->kinds > 0 ? 0 : -1;
    for (int k = 1; k < a->kinds; k++)
        if (a->kind[k].threshold.velocity < a->kind[best].threshold.velocity) best = k;
    return best;
}

static double place_of(const shot_outcome *flown, double v)
{
    trace_point at;
    return v > 0.0 && trace_at_velocity(flown, v, &at) ? at.x : NAN;
}

static void set_threshold(const shot_outcome *flown, onset_answer *a, int kind)
{
    onset_result *r = &a->result;
    r->threshold_velocity = r->threshold_interval[0] = r->threshold_interval[1] = NAN;
    for (int k = 0; k < 3; k++) a->threshold_position[k] = NAN;
    if (kind < 0) return;
    const threshold_result *t = &a->kind[kind].threshold;
    const double v[3] = { t->velocity, t->interval[0], t->interval[1] };
    r->threshold_velocity = v[0];
    r->threshold_interval[0] = v[1];
    r->threshold_interval[1] = v[2];
    for (int k = 0; k < 3; k++) a->threshold_position[k] = place_of(flown, v[k]);
}

static void conclude(const shot_outcome *flown, onset_answer *a)
{
    onset_result *r = &a->result;
    const int at = first_site(a, 2), possible = first_site(a, 0), sure = first_site(a, 1);
    r->verdict = sure >= 0 ? VERDICT_GOUGES : possible >= 0 ? VERDICT_UNDECIDED : VERDICT_NO_GOUGING;
    r->probability_gouge = largest_probability(a);
    r->onset_position = position_of(a, at);
    r->onset_interval[0] = position_of(a, possible);
    r->onset_interval[1] = position_of(a, sure);
    set_threshold(flown, a, leading_kind(a, at));
}

static double fastest_site(const onset_answer *a)
{
    double v = NAN;
    for (int i = 0; i < a->result.n_sites; i++) v = fmax(v, a->site[i].velocity);
    return v;
}

static void explain(onset_answer *a)
{
    onset_result *r = &a->result;
    const double *x = a->threshold_position;
    char text[160];
    if (a->kinds == 0)
        snprintf(text, sizeof text, "no site is reached fast enough to gouge (screen)");
    else if (isfinite(r->threshold_velocity))
        snprintf(text, sizeof text, "threshold %.0f m/s (%.0f .. %.0f) is passed at x = %.3f m (%.3f .. %.3f)",
                 r->threshold_velocity, r->threshold_interval[0], r->threshold_interval[1], x[0], x[1], x[2]);
    else if (isnan(r->threshold_interval[0]))
        snprintf(text, sizeof text, "threshold at or below %.0f m/s, where the search began", r->threshold_interval[1]);
    else
        snprintf(text, sizeof text, "threshold above %.0f m/s, where the search ended", r->threshold_interval[0]);
    int n = snprintf(r->reason, sizeof r->reason, "%s; fastest site %.0f m/s", text, fastest_site(a));
    if (isfinite(a->muzzle_velocity_fed) && n > 0 && (size_t)n < sizeof r->reason)
        snprintf(r->reason + n, sizeof r->reason - (size_t)n, "; muzzle velocity %.1f m/s, with %d gouges %.1f m/s",
                 a->shot.is.muzzle_velocity, a->gouges, a->muzzle_velocity_fed);
}

/* ---- back into the shot ---- */

/* Each gouge takes what the scene nearest in velocity took, unscaled. */
static status feed_back(session *s, onset_answer *a)
{
    a->muzzle_velocity_fed = NAN;
    if (!s->c->study.feedback || a->gouges == 0) return status_ok();
    site_jump *jump = calloc((size_t)a->result.n_sites, sizeof *jump);
    CHECK(jump, STATUS_MEMORY, "no memory for %d sites", a->result.n_sites);
    for (int i = 0; i < a->result.n_sites; i++) {
        const scene_record *near = a->kind_of[i] < 0 ? NULL : nearest_scene(s, a->kind_of[i], a->site[i].velocity);
        if (near && a->site[i].outcome == SITE_GOUGE) jump[i] = (site_jump){ near->impulse, near->mass_loss };
    }
    shot_outcome again;
    shot_record record;
    const status done = session_shot(s, jump, false, &again, &record);
    a->muzzle_velocity_fed = record.is.muzzle_velocity;
    shot_outcome_free(&again);
    free(jump);
    return done;
}

/* ---- the whole ---- */

static status list_scenes(const session *s, onset_answer *a)
{
    a->scene = calloc((size_t)s->n_records + 1, sizeof *a->scene);
    CHECK(a->scene, STATUS_MEMORY, "no memory for %d scenes", s->n_records);
    for (int i = 0; i < s->n_records; i++) a->scene[i] = s->record[i]->entry;
    a->result.scene = a->scene;
    a->result.n_scenes = s->n_records;
    for (int i = 0; i < s->n_records; i++) a->result.scenes_run += !s->record[i]->entry.reused;
    for (int i = 0; i < a->result.n_sites; i++) a->result.scenes_skipped += a->site[i].outcome == SITE_SKIPPED;
    for (int k = 0; k < a->kinds; k++) a->result.scenes_skipped += a->kind[k].sites - 1; /* share their kind's */
    return status_ok();
}

static status study(session *s, const shot_outcome *flown, onset_answer *a)
{
    TRY(sort_sites(s, flown, a));
    TRY(search_all(s, flown, a));
    judge_sites(s, a);
    conclude(flown, a);
    TRY(feed_back(s, a));
    explain(a);
    return status_ok();
}

status onset_run(session *s, onset_answer *out)
{
    shot_outcome flown;
    memset(out, 0, sizeof *out);
    out->result.verdict = VERDICT_UNDECIDED;
    out->result.probability_gouge = out->result.threshold_velocity = out->result.onset_position = NAN;
    for (int k = 0; k < 2; k++) out->result.threshold_interval[k] = out->result.onset_interval[k] = NAN;
    status done = session_shot(s, NULL, true, &flown, &out->shot);
    if (done.code == STATUS_OK) done = study(s, &flown, out);
    const status listed = list_scenes(s, out);
    out->result.wall_seconds = session_wall(s);
    shot_outcome_free(&flown);
    return done.code == STATUS_OK ? listed : done;
}
