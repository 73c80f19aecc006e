/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/session_shot.h"

#include <math.h>

static void warn_of_time(session *s, const circuit_shot_summary *is)
{
    if (is->time_ran_out)
        run_session_warn(s,
                         "shot: options.max_time = %.4g ms ran out with the armature at x = %.3g m and %.3g m/s; "
                         "a larger one follows it further",
                         1e3 * is->end_time, is->end_position, is->end_velocity);
}

static void warn_of_limits(session *s, const circuit_shot_limits *l)
{
    const double x = l->transition_position;
    if (l->contact_ratio < 1.0)
        run_session_warn(
            s, "transition: from x = %.3g m on the contact force is below 1 gram-force per ampere (least %.2f)",
            l->contact_position, l->contact_ratio);
    if (l->leg_action > 1.0)
        run_session_warn(s,
                         "transition: the action melts the armature's leg (%.2f of what melts it), from x = %.3g m on",
                         l->leg_action, x);
    if (l->throat_action > 1.0)
        run_session_warn(
            s, "transition: the action melts the armature's throat (%.2f of what melts it), from x = %.3g m on",
            l->throat_action, x);
    if (l->wear_share > 1.0)
        run_session_warn(
            s, "transition: wear takes %.2f times armature.wear_thickness, all of it by x = %.3g m at the earliest",
            l->wear_share, x);
    if (!isnan(l->critical_position))
        run_session_warn(s, "rail: from x = %.3g m on the armature outruns the rail's bending waves, %.0f m/s",
                         l->critical_position, l->critical_velocity);
}

static void warn_of_lead_face(session *s, const shot_outcome *out, const circuit_shot_armature *a)
{
    for (int i = 0; i < out->n_trace; i++) {
        const trace_point *at = &out->trace[i];
        if (!(at->lead_face_temperature >= a->melting_temperature)) continue;
        run_session_warn(s,
                         "transition: the armature's lead face has melted from x = %.3g m, %.0f m/s on: scenes take it "
                         "just below melting, where no law of strength was shown to hold",
                         at->x, at->v);
        return;
    }
}

status gouge_session_shot(session *s, const case_flight *flight, const site_jump *jump, bool with_history,
                          shot_outcome *out, shot_record *record)
{
    const double since = host_wall_clock();
    host_progress_task(&s->progress, jump ? "shot with gouges" : "shot", 0.0, 0);
    const shot_plan plan = {
        .history = with_history ? s->history : NULL, .progress = &s->progress, .jump = jump, .stop = s->stop
    };
    const status done = gouge_shot_run(flight, &plan, out);
    if (s->history && done.code == STATUS_OK) TRY(output_history_tick(s->history));
    host_timing_add(&s->timing, "shot", host_wall_clock() - since);
    int warmest = 0;
    for (int k = 1; k < CIRCUIT_SHOT_PIECES; k++)
        if (out->rail_rise[k] > out->rail_rise[warmest]) warmest = k;
    *record =
        (shot_record){ .is = out->summary,
                       .limits = out->limits,
                       .rail_rise = out->rail_rise[warmest],
                       .rail_rise_position = (warmest + 0.5) * flight->launcher.barrel.length / CIRCUIT_SHOT_PIECES,
                       .wall_seconds = host_wall_clock() - since };
    if (done.code != STATUS_OK || !with_history) return done;
    warn_of_time(s, &out->summary);
    warn_of_limits(s, &out->limits);
    warn_of_lead_face(s, out, &flight->launcher.armature);
    return done;
}
