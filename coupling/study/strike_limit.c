/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/strike_limit.h"

#include <math.h>
#include <stdlib.h>

static const double STOPPED_EXCESS = -0.05; /* of what does not pierce: as far below as a fifth of v0 is above [1] */
static const double TORN_EXCESS = 0.05;     /* of a plate that water tears: a bracket is halved [1] */

static threshold_plan plan_of(const case_study *c)
{
    const double middle = 0.5 * (c->velocity_low + c->velocity_high), typical = 1500.0; /* of study_threshold_step */
    return (threshold_plan){ .low = c->velocity_low,
                             .high = c->velocity_high,
                             .step = study_threshold_step(c->velocity_interval * middle / typical),
                             .interval = c->velocity_interval,
                             .coarse = 1.0,
                             .fine = 1.0,
                             .max_scenes = c->max_scenes };
}

status study_strike_limit_possible(const case_study *c)
{
    const threshold_plan plan = plan_of(c);
    threshold_search search;
    return study_threshold_begin(&plan, &search);
}

/* The class above the limit.  Water goes nowhere: it tears the plate. */
static strike_class class_above(const strike_projectile *p)
{
    return p->piston ? STRIKE_TORN : STRIKE_PIERCED;
}

static threshold_sample sample_of(double velocity, const strike_projectile *p, const strike_outcome *o)
{
    const double share = o->residual_velocity / velocity;
    const bool above = (strike_class)o->class == class_above(p);
    return (threshold_sample){ .velocity = velocity,
                               .cells_per_radius = 1.0,
                               .excess = !above      ? STOPPED_EXCESS
                                         : p->piston ? TORN_EXCESS
                                                     : share * share,
                               .class = above                           ? DAMAGE_GOUGE
                                        : o->class == STRIKE_UNFINISHED ? DAMAGE_UNDECIDED
                                                                        : DAMAGE_NONE };
}

/* In its place among those that are there; a velocity that is there already keeps its first entry. */
static void insert(strike_limit *l, const strike_arrival *a)
{
    int k = l->arrivals;
    for (int i = 0; i < l->arrivals; i++)
        if (l->arrival[i].is.impact_velocity == a->is.impact_velocity) return;
    for (; k > 0 && l->arrival[k - 1].is.impact_velocity > a->is.impact_velocity; k--)
        l->arrival[k] = l->arrival[k - 1];
    l->arrival[k] = *a;
    l->arrivals++;
}

static status read_arrival(session *s, const study_case *of, const strike_projectile *p, const case_bodies *bodies,
                           double velocity, strike_arrival *a)
{
    scene_bodies_result r;
    status done = scene_bodies_read(s->history, a->scene, &r);
    if (done.code == STATUS_OK)
        done = strike_outcome_read(s->history, a->scene, p, bodies, of->in->strike.filter, velocity, &r, &a->is);
    scene_bodies_free(&r);
    return done;
}

/* The scenes of one question, at once. */
static status answer(session *s, const study_case *of, const strike_projectile *p, threshold_search *search,
                     const threshold_wanted *wanted, int n, strike_limit *l)
{
    scene_query query[THRESHOLD_TOGETHER];
    const scene_record *record[THRESHOLD_TOGETHER];
    case_bodies *bodies = &l->bodies[l->scenes];
    for (int i = 0; i < n; i++) {
        query[i] = (scene_query){ .bodies = case_body_scene_of(of->in) };
        query[i].bodies.bodies = &bodies[i];
        query[i].bodies.snapshots = 0;
        snprintf(query[i].name, sizeof query[i].name, "%.60sv%g", of->prefix, wanted[i].velocity);
        l->scenes++; /* its scene is to be freed whatever comes */
        TRY(strike_scene(of->in, p, wanted[i].velocity, &bodies[i]));
    }
    TRY(run_scenes_all(s, query, n, record));
    for (int i = 0; i < n; i++) {
        strike_arrival a;
        snprintf(a.scene, sizeof a.scene, "%s", record[i]->entry.name);
        TRY(read_arrival(s, of, p, &bodies[i], wanted[i].velocity, &a));
        insert(l, &a);
        const threshold_sample sample = sample_of(wanted[i].velocity, p, &a.is);
        TRY(study_threshold_tell(search, &sample));
    }
    return status_ok();
}

/* Those between the ends that are not decided. */
static void warn_of_undecided(session *s, const strike_projectile *p, const strike_limit *l)
{
    int undecided = 0;
    for (int i = 0; i < l->arrivals; i++) {
        const double v = l->arrival[i].is.impact_velocity;
        undecided += v > l->interval[0] && v < l->interval[1] && l->arrival[i].is.class == STRIKE_UNFINISHED;
    }
    if (undecided > 0)
        run_session_warn(s,
                         "limit_interval: of the arrivals between %g and %g m/s %d %s not decided; a longer scene (%s) "
                         "makes it narrower",
                         l->interval[0], l->interval[1], undecided, undecided == 1 ? "is" : "are",
                         p->piston ? "scene.end_time" : "strike.travel");
}

static void conclude(session *s, const case_study *c, const strike_projectile *p, const threshold_result *r,
                     strike_limit *l)
{
    const char *above = p->piston ? "tears the plate" : "pierces";
    double arrival[THRESHOLD_MAX_SAMPLES + 1], residual[THRESHOLD_MAX_SAMPLES + 1];
    int n = 0;
    const bool monotone = study_strike_limit_ends(l, class_above(p));
    if (r->outcome == THRESHOLD_FOUND && isnan(l->interval[0]))
        run_session_warn(s,
                         "limit_interval has no lower end: no arrival below %g m/s is decided; take a longer scene "
                         "(%s), or a lower study.velocity_low",
                         l->interval[1], p->piston ? "scene.end_time" : "strike.travel");
    warn_of_undecided(s, p, l);
    if (r->outcome == THRESHOLD_BELOW)
        run_session_warn(s, "the limit velocity lies below study.velocity_low = %g m/s: that %s", c->velocity_low,
                         above);
    if (r->outcome == THRESHOLD_ABOVE && !isnan(study_strike_fastest_held(l, class_above(p), c->velocity_high)))
        run_session_warn(s, "the limit velocity lies above study.velocity_high = %g m/s: nothing up to there %s",
                         c->velocity_high, above);
    else if (r->outcome == THRESHOLD_ABOVE)
        run_session_warn(s, "no arrival up to study.velocity_high = %g m/s is decided: take a longer scene (%s)",
                         c->velocity_high, p->piston ? "scene.end_time" : "strike.travel");
    if (r->outcome == THRESHOLD_UNKNOWN)
        run_session_warn(s, "study.max_scenes = %d did not suffice to find a limit velocity", c->max_scenes);
    if (!monotone)
        run_session_warn(s,
                         "the limit turns back: a faster arrival than one that %s does not; limit_interval spans "
                         "both",
                         above);
    for (int i = 0; i < l->arrivals; i++) {
        const strike_outcome *o = &l->arrival[i].is;
        if (o->class != STRIKE_PIERCED) continue;
        arrival[n] = o->impact_velocity, residual[n++] = o->residual_velocity;
    }
    l->fit = strike_recht_ipson(n, arrival, residual);
}

status study_strike_limit_search(session *s, const study_case *of, const strike_projectile *p,
                                 const strike_arrival *first, strike_limit *out)
{
    const case_study *c = &of->in->onset.study;
    const threshold_plan plan = plan_of(c);
    threshold_search search;
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    int n;
    out->arrival = calloc(THRESHOLD_MAX_SAMPLES + 1, sizeof *out->arrival);
    out->bodies = calloc(THRESHOLD_MAX_SAMPLES, sizeof *out->bodies);
    CHECK(out->arrival && out->bodies, STATUS_MEMORY, "no memory for a search of a limit velocity");
    if (first) insert(out, first);
    TRY(study_threshold_begin(&plan, &search));
    while ((n = study_threshold_ask(&search, wanted)) > 0) TRY(answer(s, of, p, &search, wanted, n, out));
    conclude(s, c, p, &search.result, out);
    return status_ok();
}

void study_strike_limit_free(strike_limit *l)
{
    for (int i = 0; i < l->scenes; i++) mpm_scene_free(&l->bodies[i].scene);
    free(l->bodies);
    free(l->arrival);
}
