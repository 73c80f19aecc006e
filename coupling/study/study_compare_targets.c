/* SPDX-License-Identifier: BSD-3-Clause */
/* breech compare of a case with `targets`: target_compare.h as a study.
 *
 * A target is the case read again with its changes; `breech strike` of each gives what is ranked.  Every error is told
 * before anything runs. */
#include "coupling/host/progress.h"
#include "coupling/host/table.h"
#include "coupling/report/report_page.h"
#include "coupling/study/reread.h"
#include "coupling/study/strike.h"
#include "coupling/study/target_compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char given_name[] = "given";
static const char *const rank_names[] = { "residual_velocity", "limit_velocity", NULL };

static const summary_key entry_keys[] = {
    SUMMARY_TEXT(target_entry, "target", target, "its name; `given`: that of the case as it is"),
    SUMMARY_VALUE(target_entry, KEY_INTEGER, "tied", tied, "1",
                  "rank of the best of its group, from which it cannot be told: 1, it cannot be told from the best"),
    SUMMARY_NUMBER(target_entry, "limit_velocity", limit, "m/s", "as that of `strike`"),
    SUMMARY_VECTOR(target_entry, "limit_interval", limit_interval, 2, "m/s", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "impact_velocity", is.impact_velocity, "m/s", "as that of `strike`"),
    SUMMARY_CHOICE(target_entry, "class", is.class, strike_class_names, "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "residual_velocity", is.residual_velocity, "m/s", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "energy_absorbed", is.energy_absorbed, "J", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "target_mass", is.target_mass, "kg", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "peak_force", is.peak_force, "N", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "deflection", is.deflection, "m", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "hole_diameter", is.hole_diameter, "m", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "failed_volume", is.failed_volume, "m3", "as that of `strike`"),
    SUMMARY_NUMBER(target_entry, "debris_mass", is.debris_mass, "kg", "as that of `strike`"),
    SUMMARY_END,
};

static const summary_key keys[] = {
    SUMMARY_CHOICE(target_ranking, "ranked_by", by_limit, rank_names,
                   "limit_velocity with strike.limit, else residual_velocity, after whether the target holds"),
    SUMMARY_LIST(target_ranking, "ranking", ranking, n, entry_keys, sizeof(target_entry),
                 "a target each, keys below; the best first"),
    SUMMARY_NUMBER(target_ranking, "wall_seconds", wall_seconds, "s", "time it took"),
    SUMMARY_END,
};

typedef struct {
    target_ranking result;
    int n;
    case_inputs **in;     /* [n] owned one by one, as what follows */
    study_answer *strike; /* [n] */
    char (*prefix)[16];   /* [n] */
} answer;

static bool has_targets(const case_inputs *in)
{
    return in->given.targets && !in->given.treatments;
}

/* Target k of the case, from 0: that of the case as it is is the first. */
static const char *name_of(const case_targets *t, int k)
{
    return k == 0 ? given_name : t->item[k - 1].name;
}

/* ---- before anything is written ---- */

static status read_target(const study_case *of, int k, case_inputs **out)
{
    static const case_changes none = { 0, NULL };
    const case_targets *t = &of->in->targets;
    const case_changes *c = k == 0 ? &none : &t->item[k - 1].change;
    char at[60] = "targets";
    int about;
    const status s = study_reread(of, &study_strike, c->n, c->item, out, &about);
    if (k > 0) snprintf(at, sizeof at, "targets[%d].change", k - 1); /* its place is that of the error */
    if (about >= 0)
        snprintf(at + strlen(at), sizeof at - strlen(at), "[%d].%s", about, study_reread_key(&s) ? "key" : "value");
    CHECK(s.code == STATUS_OK, s.code, "%s: %s: %.400s", at, name_of(t, k), s.text);
    return s;
}

static status check_names(const case_targets *t)
{
    for (int k = 0; k < t->n; k++) {
        CHECK(t->item[k].change.n > 0, STATUS_BAD_INPUT,
              "targets[%d].change is empty: %s would be the target of the case as it is, which is compared anyway", k,
              t->item[k].name);
        for (int i = 0; i <= k; i++)
            CHECK(strcmp(t->item[k].name, name_of(t, i)) != 0, STATUS_BAD_INPUT, "targets[%d].name = %s: %s", k,
                  t->item[k].name, i == 0 ? "the target of the case as it is has this name" : "two have this name");
    }
    return status_ok();
}

static status possible(const study_case *of)
{
    const case_targets *t = &of->in->targets;
    TRY(check_names(t));
    for (int k = 0; k <= t->n; k++) {
        case_inputs *in;
        const status s = read_target(of, k, &in);
        case_inputs_free(in);
        TRY(s);
    }
    return status_ok();
}

/* ---- the run ---- */

static status make_room(const case_targets *t, answer *a)
{
    const size_t n = (size_t)t->n + 1;
    a->in = calloc(n, sizeof *a->in);
    a->strike = calloc(n, sizeof *a->strike);
    a->prefix = calloc(n, sizeof *a->prefix);
    a->result.ranking = calloc(n, sizeof *a->result.ranking);
    CHECK(a->in && a->strike && a->prefix && a->result.ranking, STATUS_MEMORY, "no memory for %zu targets", n);
    a->n = (int)n;
    return status_ok();
}

static status run_target(session *s, const study_case *of, int k, answer *a)
{
    target_entry *e = &a->result.ranking[k];
    snprintf(a->prefix[k], sizeof a->prefix[k], "t%d-", k);
    snprintf(e->target, sizeof e->target, "%s", name_of(&of->in->targets, k));
    TRY(read_target(of, k, &a->in[k]));
    const study_case one = { .in = a->in[k], .one_of_several = true, .prefix = a->prefix[k] };
    const status done = study_strike.run(s, &one, &a->strike[k]);
    CHECK(done.code == STATUS_OK, done.code, "%s: %.500s", e->target, done.text);
    const strike_result *r = a->strike[k].result;
    e->is = r->is;
    e->limit = r->limit.velocity;
    for (int i = 0; i < 2; i++) e->limit_interval[i] = r->limit.interval[i];
    a->result.n = k + 1;
    return status_ok();
}

static status run(session *s, const study_case *of, study_answer *out)
{
    const double since = host_wall_clock();
    answer *a = out->owned = calloc(1, sizeof *a);
    CHECK(a, STATUS_MEMORY, "no memory for an answer");
    TRY(make_room(&of->in->targets, a));
    a->result.by_limit = of->in->strike.limit;
    status done = status_ok();
    for (int k = 0; k < a->n && done.code == STATUS_OK; k++) done = run_target(s, of, k, a);
    study_targets_rank(&a->result);
    a->result.wall_seconds = host_wall_clock() - since;
    out->result = &a->result;
    return done;
}

static void free_owned(void *owned)
{
    answer *a = owned;
    if (!a) return;
    for (int k = 0; k < a->n; k++) study_strike.free(a->strike[k].owned), case_inputs_free(a->in[k]);
    free(a->in);
    free(a->strike);
    free(a->prefix);
    free(a->result.ranking);
    free(a);
}

/* ---- for people ---- */

/* "450 (400 .. 500)", or a dash. */
static void write_limit(const target_entry *e, char *out, size_t size)
{
    char text[3][24];
    output_cell(e->limit, 1.0, "%.4g", text[0]);
    for (int i = 0; i < 2; i++) output_cell(e->limit_interval[i], 1.0, "%.4g", text[i + 1]);
    const bool known = !isnan(e->limit_interval[0]) || !isnan(e->limit_interval[1]);
    if (known)
        snprintf(out, size, "%s (%s .. %s)", text[0], text[1], text[2]);
    else
        snprintf(out, size, "%s", text[0]);
}

static void print(const void *result, FILE *out)
{
    const target_ranking *r = result;
    table *t;
    if (host_table_create("#|target|mass [g]|class|residual [m/s]|absorbed [J]|peak force [kN]|limit [m/s]", &t).code !=
        STATUS_OK)
        return;
    for (int k = 0; k < r->n; k++) {
        const target_entry *e = &r->ranking[k];
        char text[2][24], limit[90];
        write_limit(e, limit, sizeof limit);
        host_table_row(t, "%d|%s|%.4g|%s|%s|%s|%.4g|%s", e->tied, e->target, 1e3 * e->is.target_mass,
                       strike_class_names[e->is.class], output_cell(e->is.residual_velocity, 1.0, "%.4g", text[0]),
                       output_cell(e->is.energy_absorbed, 1.0, "%.4g", text[1]), 1e-3 * e->is.peak_force, limit);
    }
    host_table_print(t, out);
    host_table_free(t);
    fprintf(out, "ranked by %s; what has the same number cannot be told apart\n", rank_names[r->by_limit]);
}

const study study_compare_targets = {
    .name = "compare_targets",
    .doc = "breech compare of a case with targets and no treatments",
    .more = "",
    .takes = has_targets,
    .needs = CASE_FOR_STRIKE | CASE_FOR_TARGETS,
    .many_scenes = true,
    .keys = keys,
    .report = { report_compare_targets_head, report_compare_targets_section },
    .print = print,
    .possible = possible,
    .run = run,
    .free = free_owned,
};
