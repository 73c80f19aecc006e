/* SPDX-License-Identifier: BSD-3-Clause */
/* breech life of a case with load: armature: rail_life.h as a study. */
#include "coupling/study/study.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/study/rail_life.h"
#include "coupling/study/warm_rail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const summary_key place_keys[] = {
    SUMMARY_NUMBER(rail_life_place, "position", position, "m", "along the barrel, from the breech"),
    SUMMARY_NUMBER(rail_life_place, "velocity", velocity, "m/s",
                   "of the armature there, in the first shot as all below"),
    SUMMARY_NUMBER(rail_life_place, "pressure", pressure, "Pa", "mean of the contact"),
    SUMMARY_NUMBER(rail_life_place, "friction", friction, "1", "coefficient"),
    SUMMARY_NUMBER(rail_life_place, "moving_factor", moving_factor, "1", "K of (L-7)"),
    SUMMARY_NUMBER(rail_life_place, "rise", rise, "K", "of the rail's face when the contact leaves it, (L-9)"),
    SUMMARY_NUMBER(rail_life_place, "flux_rise", flux_rise, "K",
                   "the same by the contact's heat alone, without a film"),
    SUMMARY_NUMBER(rail_life_place, "probe_rise", probe_rise, "K",
                   "largest rise at life.probe_depth until the armature leaves the muzzle; null: not asked for"),
    SUMMARY_NUMBER(rail_life_place, "life", life, "1", "shots until a crack; null: never, or not known"),
    SUMMARY_VECTOR(rail_life_place, "life_interval", interval, 2, "1", "5 and 95 % of what may be true of A"),
    SUMMARY_NUMBER(rail_life_place, "life_first", first, "1", "shots until the first direction is cut"),
    SUMMARY_NUMBER(rail_life_place, "depth", depth, "m", "of the crack, below the face"),
    SUMMARY_NUMBER(rail_life_place, "angle", angle, "rad", "of the first direction cut there, as life_angle"),
    SUMMARY_NUMBER(rail_life_place, "range", range, "1", "largest of the strain of a direction at that depth"),
    SUMMARY_NUMBER(rail_life_place, "without_heat", without_heat, "1", "life if heat strained nothing, of like shots"),
    SUMMARY_NUMBER(rail_life_place, "depth_without_heat", depth_without_heat, "m", "of that crack"),
    SUMMARY_CHOICE(rail_life_place, "cause", cause, study_rail_life_cause_names, "as life_cause"),
    SUMMARY_END,
};

static const summary_key keys[] = {
    SUMMARY_NUMBER(
        rail_life_result, "life", life, "1",
        "shots until a crack at the weakest place along the barrel; below 1: in the first shot; null: never, "
        "or not known"),
    SUMMARY_VECTOR(
        rail_life_result, "life_quantiles", quantiles, 3, "1",
        "shots by which that crack is there with 5, 50 and 95 %; null: no place has a life, or the material no "
        "fatigue_A_spread"),
    SUMMARY_NUMBER(rail_life_result, "life_first", first, "1", "shots until the first direction is cut there"),
    SUMMARY_NUMBER(rail_life_result, "life_position", position, "m", "of that place along the barrel, from the breech"),
    SUMMARY_NUMBER(rail_life_result, "life_depth", depth, "m", "of the crack, below the face"),
    SUMMARY_NUMBER(rail_life_result, "life_angle", angle, "rad",
                   "of the first direction cut at that depth, from the rail's direction towards the depth"),
    SUMMARY_NUMBER(rail_life_result, "life_range", range, "1", "largest strain range of a direction at that depth"),
    SUMMARY_CHOICE(rail_life_result, "life_cause", cause, study_rail_life_cause_names,
                   "what strains the rail more there, each by itself: contact, heat; none: it lasts for good; not "
                   "reached, faster than Rayleigh waves: why no place has a life"),
    SUMMARY_VECTOR(rail_life_result, "crack_depths", depths, 2, "m",
                   "shallowest and deepest of the cracks of all places"),
    SUMMARY_NUMBER(rail_life_result, "life_without_heat", without_heat, "1",
                   "shots until a crack if heat strained nothing, of like shots"),
    SUMMARY_NUMBER(rail_life_result, "without_heat_position", without_heat_position, "m", "where that is"),
    SUMMARY_NUMBER(rail_life_result, "without_heat_depth", without_heat_depth, "m", "how deep"),
    SUMMARY_NUMBER(rail_life_result, "probability_cracked", probability, "1",
                   "that a crack is there after study.shots; null: no place has a life, or the material no "
                   "fatigue_A_spread"),
    SUMMARY_VALUE(rail_life_result, KEY_INTEGER, "shots", shots, "1",
                  "fired one after the other; more are like the last"),
    SUMMARY_VALUE(rail_life_result, KEY_INTEGER, "flights", flights, "1",
                  "of those computed: one for all that are alike"),
    SUMMARY_VALUE(rail_life_result, KEY_INTEGER, "film_limited", film_limited, "1",
                  "places whose face the contact's heat alone would make warmer than the armature's film"),
    SUMMARY_NUMBER(rail_life_result, "rayleigh_speed", rayleigh_speed, "m/s", "of Rayleigh waves in the rail"),
    SUMMARY_NUMBER(rail_life_result, "rayleigh_position", rayleigh_position, "m",
                   "from where on the armature is faster, so that no life is known; null: nowhere"),
    SUMMARY_LIST(rail_life_result, "life_along", place, n, place_keys, sizeof(rail_life_place),
                 "places along the barrel, keys below"),
    SUMMARY_NUMBER(rail_life_result, "wall_seconds", wall_seconds, "s", "wall time of the study"),
    SUMMARY_END,
};

typedef struct {
    rail_life_result result;
    shot_record shot;
} answer;

static const mpm_material *metal_of(const case_inputs *in)
{
    return case_material(&in->onset.impact.materials, in->life.material);
}

static bool is_armature(const case_inputs *in)
{
    return in->given.life && in->life.load == LIFE_ARMATURE;
}

static status possible(const study_case *of)
{
    TRY(study_possible(of->in, CASE_FOR_SHOT, NULL));
    TRY(study_rail_life_possible(&of->in->onset, &of->in->life, metal_of(of->in)));
    return study_warm_rail_possible(&of->in->onset);
}

/* Where it presses hardest. */
static void warn_of_pressure(session *s, const rail_life_result *r, const mpm_material *metal)
{
    const char *by;
    const double most = case_life_carried(metal, &by);
    const rail_life_place *at = NULL;
    for (int k = 0; k < r->n; k++)
        if (r->place[k].pressure > (at ? at->pressure : most)) at = &r->place[k];
    if (at)
        run_session_warn(s,
                         "the armature presses on the rail with %.3g GPa at x = %.3g m, more than %s carries, %.3g GPa "
                         "(%s): its face would flow away, and the life there has no meaning; are preload and "
                         "contact_length right?",
                         1e-9 * at->pressure, at->position, metal->name, 1e-9 * most, by);
}

static void warn(session *s, const rail_life_result *r, const mpm_material *metal)
{
    warn_of_pressure(s, r, metal);
    if (!isnan(r->rayleigh_position))
        run_session_warn(
            s,
            "from x = %.3g m on the armature is faster than Rayleigh waves in %s, %.0f m/s: no steady field, "
            "no life is known there",
            r->rayleigh_position, metal->name, r->rayleigh_speed);
    if (r->cause == RAIL_LIFE_UNREACHED)
        run_session_warn(s, "no place along the barrel is passed by a moving armature: the rail's life is not judged");
    if (r->life < 1.0) run_session_warn(s, "the rail cracks in the first shot: the law is asked beyond what it is for");
}

static status run(session *s, const study_case *of, study_answer *out)
{
    answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    const mpm_material *metal = metal_of(of->in);
    TRY(study_rail_life_run(s, &of->in->onset, &of->in->life, metal, !of->one_of_several, &a->result, &a->shot));
    warn(s, &a->result, metal);
    out->result = &a->result;
    out->shot = &a->shot;
    return status_ok();
}

static void print(const void *result, FILE *out)
{
    enum { ROWS = 12 };
    const rail_life_result *r = result;
    output_keys_print(&(summary_object){ keys, r }, out);
    table *t;
    const char *titles = "x [m]|v [m/s]|p [MPa]|mu|K|rise [K]|range [%]|depth [mm]|shots|without heat|by";
    if (host_table_create(titles, &t).code != STATUS_OK) return;
    const int step = (r->n + ROWS - 1) / ROWS;
    for (int k = 0; k < r->n; k += step) {
        const rail_life_place *p = &r->place[k];
        char text[8][24];
        host_table_row(
            t, "%.3f|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s", p->position, output_cell(p->velocity, 1.0, "%.0f", text[0]),
            output_cell(p->pressure, 1e6, "%.1f", text[1]), output_cell(p->friction, 1.0, "%.3f", text[2]),
            output_cell(p->moving_factor, 1.0, "%.2f", text[3]), output_cell(p->rise, 1.0, "%.0f", text[4]),
            output_cell(p->range, 0.01, "%.3f", text[5]), output_cell(p->depth, 1e-3, "%.3f", text[6]),
            output_cell(p->life, 1.0, "%.3g", text[7]), output_cell(p->without_heat, 1.0, "%.3g", (char[24]){ 0 }),
            study_rail_life_cause_names[p->cause]);
    }
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

static void free_owned(void *owned)
{
    answer *a = owned;
    if (a) study_rail_life_free(&a->result);
    free(a);
}

const study study_rail_life = {
    .name = "rail_life",
    .doc = "breech life of a case with load: armature",
    .more = "",
    .takes = is_armature,
    .needs = CASE_FOR_LIFE,
    .keys = keys,
    .shows_shot = true,
    .can_vary = true,
    .report = { report_rail_life_head, report_rail_life_section },
    .print = print,
    .possible = possible,
    .run = run,
    .free = free_owned,
};
