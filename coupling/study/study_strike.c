/* SPDX-License-Identifier: BSD-3-Clause */
/* breech strike: what the projectile does to its target, at a given velocity or at that of the case's shot.
 * With `optimise` the bank is fired as that finds it; goal velocity: so that the projectile arrives with
 * strike.velocity, or, with strike.limit and without strike.velocity, with the limit velocity; else muzzle_velocity. */
#include "coupling/gouge/session_shot.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/scene/scene_possible.h"
#include "coupling/study/firing_found.h"
#include "coupling/study/scene_doubts.h"
#include "coupling/study/strike.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const summary_key arrival_keys[] = {
    SUMMARY_TEXT(strike_arrival, "scene", scene, "its name"),
    SUMMARY_NUMBER(strike_arrival, "impact_velocity", is.impact_velocity, "m/s", "of arrival"),
    SUMMARY_CHOICE(strike_arrival, "class", is.class, strike_class_names, "as that of `strike`"),
    SUMMARY_NUMBER(strike_arrival, "residual_velocity", is.residual_velocity, "m/s", "as that of `strike`"),
    SUMMARY_NUMBER(strike_arrival, "energy_absorbed", is.energy_absorbed, "J", "as that of `strike`"),
    SUMMARY_NUMBER(strike_arrival, "peak_force", is.peak_force, "N", "as that of `strike`"),
    SUMMARY_END,
};

static const summary_key result_keys[] = {
    SUMMARY_NUMBER(strike_result, "muzzle_velocity", is.muzzle_velocity, "m/s",
                   "of the case's shot; null: none was fired"),
    SUMMARY_NUMBER(strike_result, "flight_time", is.flight_time, "s", "from the muzzle to the target; null: no shot"),
    SUMMARY_WITH(strike_result, KEY_NUMBER, "charge_scale", firing.charge_scale, "1", "charge_scale",
                 "with `optimise`: factor on all charges of the bank that was found"),
    SUMMARY_WITH(strike_result, KEY_NUMBER, "stored_energy", firing.stored_energy, "J", "charge_scale",
                 "of the bank, charged so"),
    SUMMARY_NUMBER(strike_result, "impact_velocity", is.impact_velocity, "m/s", "of the projectile at arrival"),
    SUMMARY_NUMBER(strike_result, "projectile_mass", is.projectile_mass, "kg", "of the whole projectile"),
    SUMMARY_CHOICE(strike_result, "class", is.class, strike_class_names,
                   "what became of it: pierced, else torn or bulged with strike.plate, else rebound or stopped, or "
                   "unfinished where the scene is too short to tell"),
    SUMMARY_NUMBER(strike_result, "residual_velocity", is.residual_velocity, "m/s",
                   "along the flight, of the projectile's intact metal at judged_time"),
    SUMMARY_NUMBER(strike_result, "energy_arrival", is.energy_arrival, "J", "of the projectile's motion at arrival"),
    SUMMARY_NUMBER(strike_result, "energy_absorbed", is.energy_absorbed, "J",
                   "of that, what it has lost by judged_time"),
    SUMMARY_NUMBER(strike_result, "energy_share", is.energy_share, "1", "energy_absorbed over energy_arrival"),
    SUMMARY_NUMBER(strike_result, "peak_force", is.peak_force, "N",
                   "on the projectile, against its flight: largest mean over strike.filter"),
    SUMMARY_NUMBER(strike_result, "time_of_peak", is.peak_time, "s", "when that ended"),
    SUMMARY_NUMBER(strike_result, "impulse", is.impulse, "N s", "of contact on the projectile, against its flight"),
    SUMMARY_NUMBER(strike_result, "deflection", is.deflection, "m",
                   "farthest along the flight that intact metal of the target has gone that does not fly: slower than "
                   "20 m/s, or than a tenth of impact_velocity; null: there is none"),
    SUMMARY_NUMBER(strike_result, "hole_diameter", is.hole_diameter, "m",
                   "of a circle with the area of the holes in strike.plate; null: no plate is named"),
    SUMMARY_NUMBER(strike_result, "target_mass", is.target_mass, "kg", "of the target in the window, at the start"),
    SUMMARY_NUMBER(strike_result, "failed_volume", is.failed_volume, "m3", "of the target"),
    SUMMARY_NUMBER(
        strike_result, "cavitated_volume", is.cavitated_volume, "m3",
        "largest of any time, of fluid thinner than at rest by a thousandth or more; null: there is no fluid"),
    SUMMARY_NUMBER(strike_result, "debris_mass", is.debris_mass, "kg",
                   "of the target: what flies, has left the window or was eroded"),
    SUMMARY_NUMBER(strike_result, "ahead", is.ahead, "kg",
                   "intact metal of the target in the projectile's way at the end: before it and slower than half its "
                   "speed; 0: its way is free"),
    SUMMARY_NUMBER(strike_result, "speed_change", is.speed_change, "m/s",
                   "of the projectile in the last tenth of the scene"),
    SUMMARY_NUMBER(strike_result, "lost_mass", is.lost_mass, "kg",
                   "of the projectile: left through the window's ends, or was eroded"),
    SUMMARY_NUMBER(strike_result, "left_share", is.left_share, "1",
                   "of the projectile's mass, that left through the window's ends"),
    SUMMARY_NUMBER(strike_result, "judged_time", is.judged_time, "s",
                   "of which class and residual_velocity are: the end, or the last time at which no more than a tenth "
                   "of the projectile had left the window and some of it was intact"),
    SUMMARY_VALUE(strike_result, KEY_FLAG, "gone", is.gone, "",
                  "at the end the window holds less than a tenth of the projectile's metal intact: it left, or failed "
                  "as a whole"),
    SUMMARY_NUMBER(
        strike_result, "limit_velocity", limit.velocity, "m/s",
        "middle between the fastest arrival that is stopped and the slowest that pierces, of a piston's water "
        "that tears; null: not asked for, or one of the two is not known"),
    SUMMARY_VECTOR(strike_result, "limit_interval", limit.interval, 2, "m/s", "those two; null: not known"),
    SUMMARY_NUMBER(strike_result, "recht_ipson_factor", limit.fit.factor, "1", "k in (A-2), of all that pierced"),
    SUMMARY_NUMBER(strike_result, "recht_ipson_limit", limit.fit.limit, "m/s", "v50 in (A-2)"),
    SUMMARY_NUMBER(strike_result, "recht_ipson_error", limit.fit.error, "1",
                   "largest deviation of a residual velocity from (A-2), over itself; null: fewer than three pierced"),
    SUMMARY_LIST(strike_result, "arrivals", limit.arrival, limit.arrivals, arrival_keys, sizeof(strike_arrival),
                 "of the search and of the strike itself, rising in velocity, keys below; empty: no limit was asked "
                 "for"),
    SUMMARY_PART(strike_result, "bodies", scene, scene_bodies_keys),
    SUMMARY_END,
};

typedef struct {
    strike_result result;
    strike_projectile projectile;
    shot_record shot;    /* borrows from `firing` */
    firing_found firing; /* with `optimise` */
    case_bodies bodies;  /* of the scene; owned */
} strike_answer;

/* Is a charge wanted for a velocity? */
static bool wants_charge(const case_inputs *in)
{
    return in->given.optimise && in->optimise.goal == CIRCUIT_FIRING_VELOCITY;
}

/* Is it to arrive with the limit velocity? */
static bool aims_at_limit(const case_inputs *in)
{
    return wants_charge(in) && in->strike.limit && isnan(in->strike.velocity);
}

static bool takes_shot(const case_inputs *in)
{
    bool supply = false;
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++) supply = supply || in->given.supplies[k];
    return supply && (isnan(in->strike.velocity) || wants_charge(in));
}

/* The case's wish, its muzzle velocity that for this arrival; NAN: as it stands. */
static circuit_firing_wish wish_for(const case_inputs *in, double mass, double arrival)
{
    circuit_firing_wish w = in->optimise;
    if (wants_charge(in) && !isnan(arrival)) w.muzzle_velocity = strike_muzzle_for(&in->strike, mass, arrival);
    return w;
}

/* ---- before anything is written ---- */

static status possible(const study_case *of)
{
    const case_inputs *in = of->in;
    strike_projectile p;
    case_bodies bodies;
    TRY(strike_projectile_of(in, &p));
    const bool fired = takes_shot(in);
    CHECK(fired || in->strike.velocity > 0.0 || p.speed > 0.0, STATUS_BAD_INPUT,
          "strike.velocity is missing [m/s]: %s is at rest in scene.bodies, and the case has no shot",
          in->strike.projectile);
    if (fired) TRY(study_possible(in, CASE_FOR_SHOT, NULL));
    if (fired) TRY(strike_package_check(&in->strike, p.mass, in->onset.launcher.armature.mass));
    if (fired && in->given.optimise) {
        const case_flight flight = case_flight_of(&in->onset);
        const circuit_firing_wish wish =
            wish_for(in, p.mass, aims_at_limit(in) ? in->onset.study.velocity_low : in->strike.velocity);
        TRY(circuit_firing_check(&flight.launcher, &wish));
    }
    if (in->strike.limit) TRY(study_strike_limit_possible(&in->onset.study));
    status made = strike_scene(in, &p, 1.0, &bodies);
    if (made.code == STATUS_OK) made = scene_possible(&bodies.scene);
    mpm_scene_free(&bodies.scene);
    return made;
}

/* ---- the run ---- */

/* The velocity of arrival; of a shot its record too.  wanted: arrival for which `optimise` finds a charge [m/s]. */
static status arrive(session *s, const study_case *of, double wanted, strike_answer *a, strike_flight *flight,
                     double *muzzle)
{
    const case_inputs *in = of->in;
    *muzzle = NAN;
    if (!takes_shot(in)) {
        *flight = (strike_flight){ isnan(in->strike.velocity) ? a->projectile.speed : in->strike.velocity, NAN };
        return status_ok();
    }
    case_flight launched = case_flight_of(&in->onset);
    const circuit_firing_wish wish = wish_for(in, a->projectile.mass, wanted);
    shot_outcome o;
    if (in->given.optimise) TRY(study_firing_find(s, &wish, of->prefix, &launched, &a->firing));
    const status done = gouge_session_shot(s, &launched, NULL, !of->one_of_several, &o, &a->shot);
    gouge_shot_outcome_free(&o);
    TRY(done);
    if (in->given.optimise) study_firing_record(s, &wish, &a->firing, &a->shot);
    a->result.firing = a->firing.is;
    *muzzle = a->shot.is.muzzle_velocity;
    CHECK(
        *muzzle > 0.0, STATUS_NUMERICAL,
        "the shot does not leave the muzzle, so nothing strikes: raise bank.charge, shorten barrel.length of %g m, or "
        "give strike.velocity",
        launched.launcher.barrel.length);
    *flight = strike_fly(&in->strike, a->projectile.mass, *muzzle);
    return status_ok();
}

static const double SETTLED = 0.01; /* of its velocity: it may lose so much in the last tenth of the scene */

/* There is a plate, without a hole that counts. */
static bool is_shut(const strike_outcome *o)
{
    return !isnan(o->hole_diameter) && !o->open;
}

static void warn(session *s, const strike_result *r)
{
    const strike_outcome *o = &r->is;
    if (o->class == STRIKE_UNFINISHED && !(o->peak_force > 0.0))
        run_session_warn(s, "the projectile has not met its target: a longer scene (strike.travel, scene.end_time), or "
                            "a nearer one");
    else if (o->class == STRIKE_UNFINISHED)
        run_session_warn(s,
                         "unfinished: the projectile goes on at %.4g m/s, %.4g m/s less than a tenth of the scene "
                         "before, with %.3g g of intact metal in its way: a longer scene (strike.travel, "
                         "scene.end_time)",
                         o->residual_velocity, o->speed_change, 1e3 * o->ahead);
    if (o->class == STRIKE_PIERCED && (o->speed_change > SETTLED * o->residual_velocity || is_shut(o)))
        run_session_warn(s,
                         "pierced, but %s: what is behind the plate, and how fast, is not yet all that will be; a "
                         "longer scene (strike.travel, scene.end_time)",
                         is_shut(o) ? "the plate has no hole that counts" : "the projectile still loses speed");
    if (o->left_share > 0.0 && o->judged_time < r->scene.end_time)
        run_session_warn(s,
                         "%.0f %% of the projectile left the window before the scene's end: judged %.4g us after the "
                         "start, when nearly all of it was there; move the end of scene.window that it flies to, or "
                         "take a shorter strike.travel",
                         100.0 * o->left_share, 1e6 * o->judged_time);
    else if (o->gone)
        run_session_warn(s,
                         "less than a tenth of the projectile is intact at the end: class and residual_velocity are "
                         "those of the rest that was intact %.4g us after the start",
                         1e6 * o->judged_time);
    run_scenes_warn_of_energy(s, "", r->scene.energy_error);
}

/* One that is wanted with its snapshots is computed where they are to lie. */
static scene_query query_of(const study_case *of, const case_bodies *bodies, const char *name)
{
    scene_query q = { .bodies = case_body_scene_of(of->in),
                      .anew = !of->one_of_several && of->in->output.snapshots > 0 };
    q.bodies.bodies = bodies;
    snprintf(q.name, sizeof q.name, "%.60s%.30s", of->prefix, name);
    return q;
}

/* The limit velocity alone, for which a charge is to be found. */
static status aim_at_limit(session *s, const study_case *of, strike_answer *a, double *wanted)
{
    strike_limit *l = &a->result.limit;
    TRY(study_strike_limit_search(s, of, &a->projectile, NULL, l));
    CHECK(!isnan(l->velocity), STATUS_NUMERICAL,
          "no limit velocity between study.velocity_low = %g m/s and velocity_high = %g m/s: nothing to find a charge "
          "for",
          of->in->onset.study.velocity_low, of->in->onset.study.velocity_high);
    *wanted = l->velocity;
    return status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const case_inputs *in = of->in;
    const scene_record *done;
    double wanted = in->strike.velocity;
    strike_flight flight = { NAN, NAN };
    double muzzle;
    CHECK(
        in->onset.study.ensemble == 0, STATUS_BAD_INPUT,
        "study.ensemble = %d: a strike is computed on one grid; 0, and vary scene.grid_shift by a sweep of strikes, or "
        "`breech scene`",
        in->onset.study.ensemble);
    strike_answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    strike_result *r = &a->result;
    r->limit.velocity = r->limit.interval[0] = r->limit.interval[1] = NAN;
    r->limit.fit = (strike_fit){ NAN, NAN, NAN };
    study_scene_doubts_warn(s, of);
    TRY(strike_projectile_of(in, &a->projectile));
    if (aims_at_limit(in)) TRY(aim_at_limit(s, of, a, &wanted));
    TRY(arrive(s, of, wanted, a, &flight, &muzzle));
    if (!isnan(muzzle)) out->shot = &a->shot;
    TRY(strike_scene(in, &a->projectile, flight.velocity, &a->bodies));
    const scene_query query = query_of(of, &a->bodies, "scene");
    TRY(run_scenes_all(s, &query, 1, &done));
    TRY(scene_bodies_read(s->history, done->entry.name, &r->scene));
    TRY(strike_outcome_read(s->history, done->entry.name, &a->projectile, &a->bodies, in->strike.filter,
                            flight.velocity, &r->scene, &r->is));
    r->is.muzzle_velocity = muzzle;
    r->is.flight_time = flight.time;
    warn(s, r);
    out->result = r;
    if (!in->strike.limit || aims_at_limit(in)) return status_ok();
    strike_arrival first = { .is = r->is };
    snprintf(first.scene, sizeof first.scene, "%s", done->entry.name);
    return study_strike_limit_search(s, of, &a->projectile, &first, &r->limit);
}

static void free_owned(void *owned)
{
    strike_answer *a = owned;
    if (!a) return;
    scene_bodies_free(&a->result.scene);
    study_strike_limit_free(&a->result.limit);
    mpm_scene_free(&a->bodies.scene);
    study_firing_free(&a->firing);
    free(a);
}

/* ---- for people ---- */

static void print_arrivals(const strike_limit *l, FILE *out)
{
    table *t;
    if (l->arrivals == 0 ||
        host_table_create("arrival [m/s]|class|residual [m/s]|absorbed [J]|peak force [kN]", &t).code != STATUS_OK)
        return;
    for (int i = 0; i < l->arrivals; i++) {
        const strike_outcome *o = &l->arrival[i].is;
        host_table_row(t, "%.5g|%s|%.4g|%.4g|%.4g", o->impact_velocity, strike_class_names[o->class],
                       o->residual_velocity, o->energy_absorbed, 1e-3 * o->peak_force);
    }
    host_table_print(t, out);
    host_table_free(t);
    fputc('\n', out);
}

static void print(const void *result, FILE *out)
{
    const strike_result *r = result;
    output_keys_print(&(summary_object){ result_keys, r }, out);
    fputs("masses, energies, forces and volumes above are those of the whole, mirror parts included\n\n", out);
    print_arrivals(&r->limit, out);
    study_bodies.print(&r->scene, out);
}

static const char *const usual[] = {
    "impact_velocity", "residual_velocity", "energy_share", "peak_force", "deflection", "hole_diameter", NULL
};

const study study_strike = {
    .name = "strike",
    .doc = "what the launched projectile does to its target",
    .more = "Needs the sections strike and scene, with bodies; without strike.velocity, what `breech shot` needs.",
    .example = "breech strike cases/sphere_plate --set \"strike.velocity=1 km/s\" -o out/slower",
    .needs = CASE_FOR_STRIKE,
    .many_scenes = true,
    .keys = result_keys,
    .shows_shot = true,
    .usual = usual,
    .can_vary = true,
    .report = { report_strike_head, report_strike_section },
    .print = print,
    .possible = possible,
    .run = run,
    .free = free_owned,
};
