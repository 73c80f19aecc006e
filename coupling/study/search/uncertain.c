/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/search/uncertain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double NEAR[2] = { 0.6, 1.6 }; /* of the threshold */

void study_uncertain_free(uncertain_inputs *u)
{
    for (int k = 0; k < u->n; k++) {
        study_families_free(&u->of[k].grains);
        free(u->of[k].c);
    }
    memset(u, 0, sizeof *u);
}

/* ---- the inputs ---- */

/* The rail's metal, a skin of it that a treatment has hardened too. */
static void raise_strength(case_onset *c, double factor)
{
    case_rail *rail = &c->impact.rail;
    rail->yield_scale *= factor;
    for (int k = 0; k < rail->layers.n; k++)
        if (strcmp(rail->layers.item[k].material, rail->material) == 0) rail->layers.item[k].yield_scale *= factor;
}

static void raise_armature(case_onset *c, double factor)
{
    c->impact.armature.yield_scale *= factor;
}

static void raise_friction(case_onset *c, double factor)
{
    c->impact.scene.friction *= factor;
}

typedef struct {
    const char *input, *prefix;
    size_t error; /* offset of its relative uncertainty in case_study */
    void (*raise)(case_onset *c, double factor);
} raised;

static const raised inputs[UNCERTAIN_MAX] = {
    { "rail.yield_scale", "strength-", offsetof(case_study, strength_error), raise_strength },
    { "armature.yield_scale", "armature-", offsetof(case_study, armature_error), raise_armature },
    { "scene.friction", "friction-", offsetof(case_study, friction_error), raise_friction },
};

/* ---- their searches ---- */

/* The lowest and the highest of all families' thresholds; false: one of them is not known. */
static bool thresholds_of(const grain_families *g, double *low, double *high)
{
    *low = INFINITY, *high = 0.0;
    for (int k = 0; k < g->n; k++)
        for (int j = 0; j < FAMILY_JUDGES; j++) {
            if (j == JUDGE_OF_SCRATCH && !g->family[k].scratch) continue;
            const double v = study_family_surface(&g->family[k], (family_judge)j)->reference.velocity;
            if (isnan(v)) return false;
            *low = fmin(*low, v), *high = fmax(*high, v);
        }
    return g->n > 0;
}

static status plan(const grain_families *g, const raised *from, double error, uncertain_input *out)
{
    double low, high;
    case_onset *c = malloc(sizeof *c);
    CHECK(c, STATUS_MEMORY, "no memory for a case");
    *c = *g->c;
    *out = (uncertain_input){ .input = from->input, .change = error, .c = c };
    snprintf(out->prefix, sizeof out->prefix, "%s%s", g->prefix, from->prefix);
    from->raise(c, 1.0 + error);
    c->study.craters = 0;
    if (thresholds_of(g, &low, &high)) {
        c->study.velocity_low = NEAR[0] * low;
        c->study.velocity_high = NEAR[1] * high;
    }
    TRY(study_families_sort(c, g->flown, out->prefix, &out->grains));
    if (g->scratch) study_families_want_scratch(&out->grains);
    return status_ok();
}

/* ---- what they move ---- */

/* Where a threshold lies on the search's own grid; where one side alone was seen, as far as that reached. */
static double place_of(const threshold_result *r)
{
    if (!isnan(r->velocity)) return r->velocity - r->more;
    return isnan(r->bracket[0]) ? r->bracket[1] : r->bracket[0];
}

/* How far the raised input moves the threshold of a family; where one of the two lies outside of its range, as far as
 * that reached; NAN: both do, and nothing is known. */
static double off(const uncertain_input *u, grain_family *f, family_judge judge)
{
    const threshold_result *own = &study_family_surface(f, judge)->reference;
    grain_family *as = study_family_alike(&u->grains, f);
    const threshold_result *moved = as ? &study_family_surface(as, judge)->reference : NULL;
    if (!moved || (isnan(own->velocity) && isnan(moved->velocity))) return NAN;
    return place_of(moved) - place_of(own);
}

const char *study_uncertain_input(int k)
{
    return inputs[k].input;
}

double study_uncertain_moved(const uncertain_inputs *u, int k, grain_family *f, family_judge judge)
{
    for (int i = 0; i < u->n; i++)
        if (strcmp(u->of[i].input, inputs[k].input) == 0) return off(&u->of[i], f, judge);
    return NAN;
}

double study_uncertain_stated(const case_interval_part *part, grain_family *f, family_judge judge)
{
    const double share = judge == JUDGE_OF_SCRATCH ? part->scratch : part->threshold;
    return share * place_of(&study_family_surface(f, judge)->reference);
}

/* An end that is not known stays so; one below 0 is cut where it is read (study_surface_at). */
static void move_threshold(double *velocity, double interval[2], double more, const double wider[2])
{
    *velocity += more;
    interval[0] += more - wider[0];
    interval[1] += more + wider[1];
}

/* allowance: below and above. */
static void move_and_widen(surface_result *s, double more, const double allowance[2])
{
    double wider[2];
    for (int side = 0; side < 2; side++) {
        wider[side] = allowance[side] - s->reference.allowance[side];
        s->reference.allowance[side] = allowance[side];
    }
    s->reference.more = more;
    move_threshold(&s->reference.velocity, s->reference.interval, more, wider);
    for (int k = 0; k < s->sizes; k++) move_threshold(&s->size[k].velocity, s->size[k].interval, more, wider);
}

/* Where both were seen from one side alone: no further than the first one's scenes agree on all grids. */
static void end_alike(surface_result *s, const surface_result *first)
{
    const threshold_outcome outcome = first->reference.outcome;
    const int side = outcome == THRESHOLD_ABOVE ? 0 : 1;
    if (s == first || s->reference.outcome != outcome) return;
    s->reference.interval[side] = first->reference.interval[side];
    memcpy(s->reference.allowance, first->reference.allowance, sizeof s->reference.allowance);
    s->reference.own = first->reference.own;
    for (int k = 0; k < s->sizes && k < first->sizes; k++) s->size[k].interval[side] = first->size[k].interval[side];
}

/* One threshold of a family by what was measured of those of f, the grains alike in the study itself (NULL: none), and
 * by what the case states. */
static void widen_threshold(const uncertain_inputs *u, const case_interval_parts *parts, grain_family *f,
                            grain_family *other, family_judge judge)
{
    surface_result *s = study_family_surface(other, judge);
    const family_scatter scatter = f ? *study_family_scatter(f, judge) : (family_scatter){ .more = 0 };
    double squares = 0.0, own = scatter.reach * scatter.reach;
    double allowance[2]; /* of all but the cells, which weigh differently below and above */
    for (int i = 0; f && i < u->n; i++) {
        const double moved = off(&u->of[i], f, judge);
        if (isfinite(moved)) squares += moved * moved;
    }
    for (int i = 0; i < parts->n; i++) {
        const double stated = study_uncertain_stated(&parts->item[i], other, judge);
        *(parts->item[i].own ? &own : &squares) += stated * stated;
    }
    for (int side = 0; side < 2; side++) {
        const double cells = s->reference.allowance[side];
        allowance[side] = sqrt(cells * cells + squares + own);
    }
    s->reference.own = sqrt(own);
    move_and_widen(s, scatter.more, allowance);
    if (scatter.against > 0.0) end_alike(s, study_family_surface(f, judge));
}

/* By so much of all sizes, without a change of the parts that the interval is made of. */
static void move_scratches(surface_result *s, double by)
{
    const double none[2] = { 0.0, 0.0 };
    s->reference.more += by;
    move_threshold(&s->reference.velocity, s->reference.interval, by, none);
    for (int k = 0; k < s->sizes; k++) move_threshold(&s->size[k].velocity, s->size[k].interval, by, none);
}

/* The upper ends of all sizes, by what finer cells may do. */
static void move_upper_ends(surface_result *s, double by)
{
    threshold_result *r = &s->reference;
    const double others = r->allowance[1] * r->allowance[1] - r->of_cells[1] * r->of_cells[1];
    r->interval[1] += by;
    r->allowance[1] = fmax(r->allowance[1] + by, 0.0);
    r->of_cells[1] = sqrt(fmax(r->allowance[1] * r->allowance[1] - others, 0.0));
    for (int k = 0; k < s->sizes; k++) s->size[k].interval[1] += by;
}

/* Of one size: a scratch's threshold is the gouge's at the most, and so are the ends of its interval. */
static void keep_order_of_size(const surface_size *gouge, surface_size *scratch)
{
    if (scratch->velocity > gouge->velocity) scratch->velocity = gouge->velocity;
    for (int side = 0; side < 2; side++)
        if (scratch->interval[side] > gouge->interval[side]) scratch->interval[side] = gouge->interval[side];
}

/* A lower end goes down with what is allowed below it. */
static void lower_end(threshold_result *r, double to)
{
    const double by = r->interval[0] - to;
    if (!(by > 0.0)) return;
    r->interval[0] = to, r->allowance[0] += by, r->of_cells[0] += by;
}

/* What gouges grows.  Where the scratch's threshold comes out above the gouge's, it is the gouge's, and its interval
 * ends with that at the latest.  Without growth nothing gouges, whatever its shape, and cells add to growth: as far up
 * as finer ones may raise the gouge's threshold they may raise the scratch's.  Where no groove was seen to grow, the
 * scratch's interval ends with the gouge's. */
static void keep_order(grain_family *f)
{
    const threshold_result *gouge = &f->surface.reference, *scratch = &f->scratches.reference;
    if (scratch->velocity > gouge->velocity) move_scratches(&f->scratches, gouge->velocity - scratch->velocity);
    const double more = gouge->interval[1] - scratch->interval[1];
    const bool follows = isnan(scratch->bracket[1]) || gouge->allowance[1] > gouge->allowance[0];
    if (more < 0.0 || (more > 0.0 && follows)) move_upper_ends(&f->scratches, more);
    lower_end(&f->scratches.reference, gouge->interval[0]);
    for (int k = 0; k < f->scratches.sizes && k < f->surface.sizes; k++)
        keep_order_of_size(&f->surface.size[k], &f->scratches.size[k]);
}

void study_uncertain_widen(const uncertain_inputs *u, const grain_families *first, grain_families *other)
{
    const case_interval_parts *parts = &first->c->study.interval_parts;
    for (int k = 0; k < other->n; k++) {
        grain_family *f = study_family_alike(first, &other->family[k]);
        widen_threshold(u, parts, f, &other->family[k], JUDGE_OF_GOUGE);
        if (!other->family[k].scratch) continue;
        widen_threshold(u, parts, f, &other->family[k], JUDGE_OF_SCRATCH);
        keep_order(&other->family[k]);
    }
}

/* What further grids make of a threshold they make of it with an input raised too. */
static void move_raised(const grain_families *first, grain_families *with)
{
    for (int k = 0; k < with->n; k++)
        for (int j = 0; j < FAMILY_JUDGES; j++) {
            grain_family *f = study_family_alike(first, &with->family[k]);
            surface_result *to = study_family_surface(&with->family[k], (family_judge)j);
            if (!f || (j == JUDGE_OF_SCRATCH && !with->family[k].scratch)) continue;
            move_and_widen(to, study_family_scatter(f, (family_judge)j)->more, to->reference.allowance);
        }
}

status study_uncertain_run(session *s, grain_families *grains, uncertain_inputs *out)
{
    grain_families *all[UNCERTAIN_MAX];
    memset(out, 0, sizeof *out);
    for (int k = 0; k < UNCERTAIN_MAX; k++) {
        const double error = *(const double *)(const void *)((const char *)&grains->c->study + inputs[k].error);
        if (!(error > 0.0) || grains->n == 0) continue;
        all[out->n] = &out->of[out->n].grains;
        TRY(plan(grains, &inputs[k], error, &out->of[out->n++]));
    }
    if (out->n > 0) TRY(study_families_search(s, all, out->n));
    study_uncertain_widen(out, grains, grains);
    for (int k = 0; k < out->n; k++) {
        move_raised(grains, &out->of[k].grains);
        out->of[k].grains.prefix = ""; /* the answer may be copied */
    }
    return status_ok();
}
