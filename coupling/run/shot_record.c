/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/shot_record.h"

#include <math.h>

const summary_key run_shot_keys[] = {
    SUMMARY_NUMBER(shot_record, "peak_current", is.peak_current, "A", "largest current in the rails"),
    SUMMARY_NUMBER(shot_record, "muzzle_velocity", is.muzzle_velocity, "m/s",
                   "of the armature at exit; null: it did not leave"),
    SUMMARY_NUMBER(shot_record, "muzzle_time", is.muzzle_time, "s", "when it left"),
    SUMMARY_NUMBER(shot_record, "muzzle_energy", is.muzzle_energy, "J", "kinetic, at exit"),
    SUMMARY_NUMBER(shot_record, "efficiency", is.efficiency, "1",
                   "muzzle energy over the energy stored at the start and supplied since"),
    SUMMARY_NUMBER(shot_record, "action", is.action, "A2 s", "integral of the current's square"),
    SUMMARY_NUMBER(shot_record, "end_time", is.end_time, "s", "as far as the shot was followed"),
    SUMMARY_NUMBER(shot_record, "end_position", is.end_position, "m", "of the armature then; the muzzle once it left"),
    SUMMARY_NUMBER(shot_record, "end_velocity", is.end_velocity, "m/s",
                   "of the armature then; that of its exit once it left"),
    SUMMARY_VALUE(shot_record, KEY_FLAG, "time_ran_out", is.time_ran_out, "",
                  "options.max_time came before the armature had left or come to rest"),
    SUMMARY_NUMBER(shot_record, "peak_acceleration", is.peak_acceleration, "m/s2", "of the armature"),
    SUMMARY_NUMBER(shot_record, "exit_current", is.exit_current, "A", "at the muzzle"),
    SUMMARY_NUMBER(shot_record, "energy_error", is.energy_error, "1",
                   "over the energy stored at the start and supplied since"),
    SUMMARY_NUMBER(shot_record, "contact_ratio", limits.contact_ratio, "1",
                   "least contact force over 1 gram-force per ampere, in motion"),
    SUMMARY_NUMBER(shot_record, "leg_action", limits.leg_action, "1",
                   "action over that which melts the leg; null: armature.leg_area is not given"),
    SUMMARY_NUMBER(shot_record, "throat_action", limits.throat_action, "1",
                   "action over that which melts the throat; null: armature.throat_area is not given"),
    SUMMARY_NUMBER(shot_record, "wear_share", limits.wear_share, "1",
                   "thickness worn off over armature.wear_thickness; null: not given"),
    SUMMARY_NUMBER(shot_record, "transition_position", limits.transition_position, "m",
                   "where the first of these four passes its limit; null: nowhere"),
    SUMMARY_NUMBER(shot_record, "melt_position", limits.melt_position, "m",
                   "where the armature's face melted, friction_law film; null: it did not"),
    SUMMARY_NUMBER(shot_record, "critical_velocity", limits.critical_velocity, "m/s",
                   "of bending waves in the rail; null: rail.backing_stiffness is not given"),
    SUMMARY_NUMBER(shot_record, "critical_position", limits.critical_position, "m",
                   "where the armature first exceeds it; null: nowhere"),
    SUMMARY_NUMBER(shot_record, "rail_rise", rail_rise, "K",
                   "largest rise of temperature that the shot leaves in its rails, once even over the section"),
    SUMMARY_NUMBER(shot_record, "rail_rise_position", rail_rise_position, "m", "where that is"),
    SUMMARY_VALUE(shot_record, KEY_COUNT, "steps", is.steps, "1", "of the integration"),
    SUMMARY_NUMBER(shot_record, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_WITH(shot_record, KEY_INTEGER, "optimise_evaluations", firing.evaluations, "1", "optimise_evaluations",
                 "trials of the search for firing times; 0: none was asked for"),
    SUMMARY_WITH(shot_record, KEY_NUMBER, "optimise_before", firing.before, "", "optimise_evaluations",
                 "its measure at the start: unevenness, or stored energy in joules"),
    SUMMARY_WITH(shot_record, KEY_NUMBER, "optimise_after", firing.after, "", "optimise_evaluations",
                 "and of what was found"),
    SUMMARY_WITH(shot_record, KEY_NUMBER, "charge_scale", firing.charge_scale, "1", "optimise_evaluations",
                 "factor on all charges that it found"),
    SUMMARY_ARRAY(shot_record, "fire_at", fire_at, n_fire_at, "s", "firing times of the bank's groups that it found"),
    SUMMARY_END
};

void run_shot_verdict(const shot_record *r, FILE *out)
{
    const circuit_shot_summary *is = &r->is;
    if (isfinite(is->muzzle_velocity))
        fprintf(out, "leaves the muzzle at %.0f m/s after %.3g ms: %.3g kJ, %.3g %% of the energy spent; ",
                is->muzzle_velocity, 1e3 * is->muzzle_time, 1e-3 * is->muzzle_energy, 1e2 * is->efficiency);
    else if (is->time_ran_out)
        fprintf(out, "still in the barrel when options.max_time ran out after %.3g ms: at x = %.3g m with %.3g m/s; ",
                1e3 * is->end_time, is->end_position, is->end_velocity);
    else
        fprintf(out, "does not leave the muzzle: rests at x = %.3g m; ", is->end_position);
    fprintf(out, "peak current %.3g kA\n", 1e-3 * is->peak_current);
    if (isfinite(r->limits.transition_position))
        fprintf(out, "transition: the sliding contact is past its limits from x = %.3g m on\n",
                r->limits.transition_position);
}
