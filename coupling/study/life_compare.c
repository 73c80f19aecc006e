/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/life_compare.h"

#include "coupling/case/treatment.h"
#include "coupling/gouge/session_shot.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double ALIKE = 0.05; /* of one metal: lives that differ by a smaller share are tied */

void study_life_compare_free(life_ranking *r)
{
    for (int k = 0; r->ranking && k < r->n; k++) study_rail_life_free(&r->ranking[k].is);
    free(r->ranking);
    *r = (life_ranking){ .n = 0 };
}

const life_entry *study_life_compare_find(const life_ranking *r, const char *surface)
{
    for (int k = 0; k < r->n; k++)
        if (strcmp(r->ranking[k].surface, surface) == 0) return &r->ranking[k];
    return NULL;
}

/* ---- one surface ---- */

/* The metal on top, by the constants that its life is asked for with. */
static const mpm_material *metal_of(const case_onset *plain, const case_onset *treated, const case_life *life)
{
    const case_layers *layers = &treated->impact.rail.layers;
    const char *top = layers->n > 0 ? layers->item[layers->n - 1].material : treated->impact.rail.material;
    const bool own = strcmp(top, plain->impact.rail.material) == 0;
    return case_material(&treated->impact.materials, own ? life->material : top);
}

/* The shot of a surface that is not judged. */
static status fly_alone(session *s, const case_onset *c, bool with_history, shot_record *record)
{
    const case_flight flight = case_flight_of(c);
    shot_outcome o;
    TRY(gouge_session_shot(s, &flight, NULL, with_history, &o, record));
    gouge_shot_outcome_free(&o);
    return status_ok();
}

static status run_surface(session *s, const case_onset *plain, const case_onset *treated, const case_life *life,
                          bool with_history, life_entry *e, shot_record *record)
{
    const mpm_material *metal = metal_of(plain, treated, life);
    case_onset flown = *treated;
    flown.launcher.rails.initial_temperature += treated->impact.rail.temperature - plain->impact.rail.temperature;
    snprintf(e->metal, sizeof e->metal, "%s", metal->name);
    e->spread = metal->fatigue_A_spread;
    const status possible = study_rail_life_possible(&flown, life, metal);
    if (possible.code != STATUS_OK) {
        snprintf(e->lacks, sizeof e->lacks, "%.150s", possible.text);
        return record ? fly_alone(s, &flown, with_history, record) : status_ok();
    }
    return study_rail_life_run(s, &flown, life, metal, with_history, &e->is, record);
}

static status run_all(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                      bool with_history, life_ranking *out, shot_record *record)
{
    for (int k = 0; k < out->n; k++) {
        const case_treatment *t = k == 0 ? NULL : &treatments->item[k - 1];
        life_entry *e = &out->ranking[k];
        case_onset treated;
        snprintf(e->surface, sizeof e->surface, "%s", t ? t->name : "untreated");
        status done = case_treat(c, t, &treated);
        if (done.code == STATUS_OK)
            done = run_surface(s, c, &treated, life, with_history && k == 0, e, k == 0 ? record : NULL);
        case_treated_free(&treated);
        TRY(done);
    }
    return status_ok();
}

/* ---- the ranking ---- */

/* NAN: not judged, or nowhere known. */
static double life_of(const life_entry *e)
{
    if (e->lacks[0]) return NAN;
    return isnan(e->is.life) && e->is.lasting ? INFINITY : e->is.life;
}

static bool is_better(const life_entry *a, const life_entry *b)
{
    const double one = life_of(a), two = life_of(b);
    return isnan(two) ? !isnan(one) : one > two;
}

static void sort(life_ranking *r)
{
    for (int k = 1; k < r->n; k++) {
        const life_entry moved = r->ranking[k];
        int at = k;
        for (; at > 0 && is_better(&moved, &r->ranking[at - 1]); at--) r->ranking[at] = r->ranking[at - 1];
        r->ranking[at] = moved;
    }
}

/* That the first lasts longer than the second, which has no longer a life. */
static double chance(const life_entry *a, const life_entry *b)
{
    const double one = life_of(a), two = life_of(b), ratio = log(one / two);
    if (isnan(one) || isnan(two)) return NAN;
    if (isinf(one)) return isinf(two) ? 0.5 : 1.0;
    if (strcmp(a->metal, b->metal) == 0) return ratio > ALIKE ? 1.0 : 0.5;
    const double spread = hypot(a->spread, b->spread);
    return spread > 0.0 ? gsl_cdf_ugaussian_P(ratio / spread) : isnan(spread) ? NAN : ratio > ALIKE ? 1.0 : 0.5;
}

/* Of the surfaces before k that lead a group: the one that lasts longest from which k cannot be told; else k itself. */
static int leader_of(const life_ranking *r, int k)
{
    const bool judged = !isnan(life_of(&r->ranking[k]));
    for (int j = 0; j < k; j++) {
        const life_entry *first = &r->ranking[j];
        const bool leads = first->tied == j + 1, told = chance(first, &r->ranking[k]) >= STUDY_SIGNIFICANT;
        if (leads && !told && isnan(life_of(first)) != judged) return j;
    }
    return k;
}

static void rank(life_ranking *r)
{
    sort(r);
    for (int k = 0; k < r->n; k++) {
        life_entry *e = &r->ranking[k];
        e->better_than_next = k + 1 < r->n ? chance(e, e + 1) : NAN;
        e->significant = e->better_than_next >= STUDY_SIGNIFICANT;
        e->tied = leader_of(r, k) + 1;
    }
}

status study_life_compare_run(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                              bool with_history, life_ranking *out, shot_record *record)
{
    const double since = host_wall_clock();
    *out = (life_ranking){ .n = treatments->n + 1 };
    out->ranking = calloc((size_t)out->n, sizeof *out->ranking);
    CHECK(out->ranking, STATUS_MEMORY, "no memory for %d surfaces", out->n);
    for (int k = 0; k < out->n; k++) out->ranking[k].is = study_rail_life_none();
    TRY(run_all(s, c, treatments, life, with_history, out, record));
    rank(out);
    out->wall_seconds = host_wall_clock() - since;
    return status_ok();
}
