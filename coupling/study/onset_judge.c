/* SPDX-License-Identifier: BSD-3-Clause */
/* What a study's thresholds say of its sites, and of the case. */
#include "coupling/study/onset.h"
#include "coupling/gouge/impact_scene.h"
#include "coupling/study/sampling/gouge_law.h"
#include "coupling/study/sampling/population.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DOUBT = 0.05;        /* probability from which the screen alone leaves it open */
static const double ORDERED_CELLS = 2.0; /* a radius; below, not even the order of surfaces was looked at */
static const double TRUSTED_CELLS = 3.0; /* a radius; below, cells decide the threshold (docs/notes/thresholds.md) */

/* ---- a grain's threshold at a velocity ---- */

/* From which velocity on a grain counts as above: the threshold itself; where all that the search saw is above, the end
 * of what it saw [m/s]. */
static double counts_from(const surface_result *s, const surface_size *of)
{
    return isnan(of->velocity) ? study_surface_end_in_cells(s, of) : of->velocity;
}

/* gouge, scratch: its two thresholds; without the second one what the nearest scene has left is the class below the
 * first.  scratch_from: from where on it counts as one, NAN: nowhere. */
static site_outcome outcome_at(const surface_size *gouge, const surface_size *scratch, double scratch_from, double v,
                               const family_scene *near)
{
    if (!isnan(gouge->interval[1]) && v >= gouge->interval[1]) return SITE_GOUGE;
    if (isnan(gouge->interval[0]) || v > gouge->interval[0]) return SITE_UNDECIDED;
    if (!isnan(scratch_from)) return v >= scratch_from ? SITE_SCRATCH : SITE_NONE;
    if (scratch && !isnan(scratch->interval[0])) return SITE_NONE; /* nowhere in the range */
    return near && near->record->entry.result.class == DAMAGE_NONE ? SITE_NONE : SITE_SCRATCH;
}

/* Where v lies in the interval, 0 below, a half at the threshold, 1 above; NaN where an end is unknown and v beyond the
 * known one. */
static double probability_at(const surface_size *t, double v)
{
    const double lo = t->interval[0], hi = t->interval[1], at = t->velocity;
    if (!isnan(hi) && v >= hi) return 1.0;
    if (!isnan(lo) && v <= lo) return 0.0;
    if (!(lo < at && at < hi)) return (v - lo) / (hi - lo);
    return v < at ? 0.5 * (v - lo) / (at - lo) : 0.5 + 0.5 * (v - at) / (hi - at);
}

static const grain_family *family_of(const onset_answer *a, int site)
{
    const int k = study_family_of_site(&a->grains, site);
    return k < 0 ? NULL : &a->grains.family[k];
}

static surface_size threshold_of(const onset_answer *a, int site)
{
    return study_surface_at(&family_of(a, site)->surface, a->grains.c->sites.item[site].radius);
}

/* NaN where it was not looked for. */
static surface_size scratch_at(const grain_family *f, double radius)
{
    if (!f->scratch) return (surface_size){ .velocity = NAN, .interval = { NAN, NAN } };
    return study_surface_at(&f->scratches, radius);
}

/* ---- do whole scenes agree? ---- */

/* Does growth, in cells of the search's size, say that this whole scene gouges for sure? */
static bool is_sure(const grain_family *f, const family_scene *s)
{
    const surface_size t = study_surface_at(&f->surface, s->radius);
    return f->by_growth && s->whole && s->velocity >= study_surface_end_in_cells(&f->surface, &t);
}

/* Its class, but a scratch where its crater at the end is longer for its width than a gouge is. */
static damage_class left_by(const scene_result *r, double limit)
{
    return r->class == DAMAGE_GOUGE && r->length_over_width > limit ? DAMAGE_SCRATCH : r->class;
}

static damage_class shaped_by(const scene_result *r, double limit)
{
    (void)limit;
    return r->crater_class;
}

/* What the whole scenes that gouge for sure are by another measure, if one of them is no gouge by it and none is one;
 * else "". */
static void find_others(const grain_family *f, damage_class (*by)(const scene_result *r, double limit), double limit,
                        char out[WHOLE_SCENES_SIZE])
{
    int gouges = 0, others = 0;
    out[0] = '\0';
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *s = &f->scene[i];
        if (!is_sure(f, s)) continue;
        const damage_class class = by(&s->record->entry.result, limit);
        const size_t used = strlen(out);
        gouges += class == DAMAGE_GOUGE;
        others += class == DAMAGE_NONE || class == DAMAGE_SCRATCH || (by == shaped_by && class == DAMAGE_UNDECIDED);
        snprintf(out + used, WHOLE_SCENES_SIZE - used, "%s%s at %g m/s", used ? ", " : "", run_damage_names[class],
                 s->velocity);
    }
    if (gouges > 0 || others == 0) out[0] = '\0';
}

const char *study_onset_contradiction(const onset_answer *a)
{
    for (int k = 0; k < a->grains.n; k++)
        if (a->grains.family[k].contradicted[0]) return a->grains.family[k].contradicted;
    return NULL;
}

static void find_contradictions(session *s, onset_answer *a)
{
    const double limit = a->grains.c->impact.scene.limit_length_over_width;
    for (int k = 0; k < a->grains.n; k++) {
        grain_family *f = &a->grains.family[k];
        char shapes[WHOLE_SCENES_SIZE];
        find_others(f, left_by, limit, f->contradicted);
        find_others(f, shaped_by, limit, shapes);
        if (f->contradicted[0])
            run_session_warn(s, "%sgrains of kind %d gouge by the growth of their grooves, but not by whole scenes: %s",
                             a->grains.surface, k + 1, f->contradicted);
        else if (shapes[0])
            run_session_warn(s,
                             "%sgrains of kind %d gouge by growth and by length over width, but not by the shape of "
                             "their whole craters alone (crater_class): %s",
                             a->grains.surface, k + 1, shapes);
    }
}

/* ---- judging the sites ---- */

static void judge_sites(onset_answer *a)
{
    for (int i = 0; i < a->result.n_sites; i++) {
        onset_site *site = &a->site[i];
        const grain_family *f = family_of(a, i);
        if (!f) continue;
        const surface_size t = threshold_of(a, i), scratch = scratch_at(f, site->radius);
        const family_scene *near = study_family_nearest(f, site->radius, site->velocity);
        gouge_mark mark;
        site->scratch_velocity = scratch.velocity;
        memcpy(site->scratch_interval, scratch.interval, sizeof scratch.interval);
        site->threshold_velocity = t.velocity;
        memcpy(site->threshold_interval, t.interval, sizeof t.interval);
        const double scratch_from = f->scratch ? counts_from(&f->scratches, &scratch) : NAN;
        const site_outcome is = outcome_at(&t, f->scratch ? &scratch : NULL, scratch_from, site->velocity, near);
        if (site->outcome == SITE_SKIPPED && is != SITE_GOUGE && is != SITE_UNDECIDED) continue;
        site->outcome = is;
        if (near) memcpy(site->scene, near->record->entry.name, sizeof site->scene);
        if (site->outcome == SITE_GOUGE && f->contradicted[0]) site->outcome = SITE_UNDECIDED;
        if (site->outcome != SITE_GOUGE) continue;
        a->result.gouges++;
        if (study_gouge_mark_at(f, &a->grains.c->impact, site->velocity, &mark))
            site->gouged_volume = mark.volume * pow(site->radius, 3.0);
    }
}

/* ---- the verdict of a list ---- */

/* Skipped, with no scenes of grains alike: the screen alone speaks for it. */
static bool is_unbacked(const onset_answer *a, int site)
{
    return a->site[site].outcome == SITE_SKIPPED && !family_of(a, site);
}

static bool may_gouge_by_screen(const onset_answer *a, int site)
{
    return is_unbacked(a, site) && a->site[site].screen_probability >= DOUBT;
}

/* Are there grains of which the screen alone speaks, and which it does not call quiet? */
static bool screen_leaves_open(const onset_answer *a)
{
    return a->grains.unbacked > 0 && a->grains.screen_probability >= DOUBT;
}

bool study_onset_is_unseen(const onset_answer *a)
{
    return a->grains.n == 0 && a->grains.too_small > 0;
}

bool study_onset_is_undrawn(const onset_answer *a)
{
    return screen_leaves_open(a) || study_onset_is_unseen(a) || (a->grains.n == 0 && a->grains.unbacked > 0);
}

/* First site along the barrel, of those with an answer to be had, whose velocity has passed `end` of its threshold:
 * 0, 1 the interval's ends, 2 the threshold itself.  -1 if none. */
static int first_site(const onset_answer *a, int end)
{
    int first = -1;
    for (int i = 0; i < a->result.n_sites; i++) {
        bool passed = may_gouge_by_screen(a, i) && end == 0;
        if (family_of(a, i)) {
            const surface_size t = threshold_of(a, i);
            const double v = a->site[i].velocity;
            passed = end == 0   ? !(v <= t.interval[0])
                     : end == 1 ? v >= t.interval[1]
                                : v >= counts_from(&family_of(a, i)->surface, &t);
            if (end == 1 && family_of(a, i)->contradicted[0]) passed = false;
        }
        if (passed && (first < 0 || a->site[i].position < a->site[first].position)) first = i;
    }
    return first;
}

static double position_of(const onset_answer *a, int site)
{
    return site < 0 ? NAN : a->site[site].position;
}

/* That it gouges; NaN: not known, also where whole scenes contradict its threshold. */
static double site_probability(const onset_answer *a, int site)
{
    const grain_family *f = family_of(a, site);
    if (a->site[site].outcome == SITE_NOT_REACHED) return 0.0;
    if (!f) return a->site[site].screen_probability;
    const surface_size t = threshold_of(a, site);
    const double p = probability_at(&t, a->site[site].velocity);
    return f->contradicted[0] && p > 0.0 ? NAN : p;
}

static double largest_probability(const onset_answer *a)
{
    double p = 0.0;
    bool unknown = false;
    for (int i = 0; i < a->result.n_sites; i++) {
        const double here = site_probability(a, i);
        unknown = unknown || isnan(here);
        if (here > p) p = here;
    }
    return unknown && p < 1.0 ? NAN : p;
}

static void conclude_list(onset_answer *a)
{
    onset_result *r = &a->result;
    const int at = first_site(a, 2), possible = first_site(a, 0), sure = first_site(a, 1);
    r->verdict = sure >= 0 ? VERDICT_GOUGES : possible >= 0 ? VERDICT_UNDECIDED : VERDICT_NO_GOUGING;
    r->probability_gouge = largest_probability(a);
    r->onset_position = position_of(a, at);
    r->onset_interval[0] = position_of(a, possible);
    r->onset_interval[1] = position_of(a, sure);
}

/* ---- the threshold that speaks for the case ---- */

const grain_family *study_onset_leading_grain(const onset_answer *a, double *radius)
{
    const case_onset *c = a->grains.c;
    const int site = first_site(a, 2);
    const grain_family *lowest = NULL;
    double v = NAN;
    for (int k = 0; k < c->populations.n; k++) {
        if (a->grains.of_population[k] < 0) continue;
        *radius = study_population_quantile(&c->populations.item[k], 0.5);
        return &a->grains.family[a->grains.of_population[k]];
    }
    if (site >= 0) {
        *radius = c->sites.item[site].radius;
        return family_of(a, site);
    }
    for (int k = 0; k < a->grains.n; k++) {
        const surface_result *s = &a->grains.family[k].surface;
        const surface_size *largest = &s->size[s->sizes - 1];
        if (lowest && !(largest->velocity < v) && !(isnan(v) && !isnan(largest->velocity))) continue;
        lowest = &a->grains.family[k];
        v = largest->velocity;
        *radius = largest->radius;
    }
    return lowest;
}

/* ---- what its intervals hold ---- */

/* How far a part lets a velocity lie lower and higher [m/s]; NAN: not in the interval. */
typedef struct {
    double reach[2];
} part_reach;

/* Part i of one threshold of the family, t at the size that counts. */
static part_reach reach_of(const onset_answer *a, int i, grain_family *f, family_judge judge, const surface_size *t)
{
    const threshold_result *r = &study_family_surface(f, judge)->reference;
    const family_scatter *scatter = study_family_scatter(f, judge);
    double band[2];
    study_surface_band(study_family_surface(f, judge), t->radius, band);
    const double below = t->velocity - band[0], above = band[1] - t->velocity;
    if (i == PART_BRACKET)
        return (part_reach){ { isnan(below) ? NAN : fmax(below, 0.0), isnan(above) ? NAN : fmax(above, 0.0) } };
    if (i == PART_CELLS) return (part_reach){ { r->of_cells[0], r->of_cells[1] } };
    double same;
    if (i == PART_GRID)
        same = scatter->excess > 0.0 ? scatter->reach : NAN;
    else if (i < ONSET_PARTS)
        same = fabs(study_uncertain_moved(&a->uncertain, i - PART_INPUTS, f, judge));
    else
        same = study_uncertain_stated(&a->grains.c->study.interval_parts.item[i - ONSET_PARTS], f, judge);
    return (part_reach){ { same, same } };
}

static const char *name_of_part(const onset_answer *a, int i)
{
    static const char *const names[] = { "bracket of the search", "cells", "place of the grid" };
    if (i < PART_INPUTS) return names[i];
    return i < ONSET_PARTS ? study_uncertain_input(i - PART_INPUTS)
                           : a->grains.c->study.interval_parts.item[i - ONSET_PARTS].part;
}

static status list_parts(onset_answer *a, grain_family *f, const surface_size *gouge, const surface_size *scratch)
{
    const part_reach none = { { NAN, NAN } };
    const int n = ONSET_PARTS + a->grains.c->study.interval_parts.n;
    const bool has_gouge = !isnan(gouge->velocity), has_scratch = f->scratch && !isnan(scratch->velocity);
    if (isnan(gouge->velocity) && isnan(scratch->velocity)) return status_ok();
    a->part = calloc((size_t)n, sizeof *a->part);
    CHECK(a->part, STATUS_MEMORY, "no memory for a summary");
    for (int i = 0; i < n; i++) {
        const part_reach g = has_gouge ? reach_of(a, i, f, JUDGE_OF_GOUGE, gouge) : none,
                         s = has_scratch ? reach_of(a, i, f, JUDGE_OF_SCRATCH, scratch) : none;
        a->part[i] = (onset_part){ .threshold_below = g.reach[0],
                                   .threshold_above = g.reach[1],
                                   .scratch_below = s.reach[0],
                                   .scratch_above = s.reach[1] };
        snprintf(a->part[i].part, sizeof a->part[i].part, "%s", name_of_part(a, i));
    }
    a->result.part = a->part, a->result.n_parts = n;
    return status_ok();
}

/* ---- and the threshold itself ---- */

static status set_threshold(onset_answer *a)
{
    onset_result *r = &a->result;
    double radius;
    const grain_family *f = study_onset_leading_grain(a, &radius);
    if (!f) return status_ok();
    const surface_size t = study_surface_at(&f->surface, radius);
    r->threshold_velocity = t.velocity;
    const surface_size scratch = scratch_at(f, radius);
    if (f->scatter.excess > 0.0) {
        r->growth_deviation = f->scatter.excess;
        r->threshold_deviation = f->scatter.threshold;
    }
    if (f->scratch_scatter.excess > 0.0) r->scratch_deviation = f->scratch_scatter.threshold;
    r->threshold_position = gouge_trace_place(&a->flown, t.velocity);
    r->scratch_velocity = scratch.velocity;
    r->scratch_position = gouge_trace_place(&a->flown, scratch.velocity);
    for (int k = 0; k < 2; k++) {
        r->scratch_interval[k] = scratch.interval[k];
        r->scratch_position_interval[k] = gouge_trace_place(&a->flown, scratch.interval[k]);
        r->threshold_interval[k] = t.interval[k];
        r->threshold_position_interval[k] = gouge_trace_place(&a->flown, t.interval[k]);
    }
    return list_parts(a, &a->grains.family[f - a->grains.family], &t, &scratch);
}

/* ---- what was skipped, and why ---- */

static status add_skip(onset_answer *a, int scenes, const char *rests_on)
{
    onset_result *r = &a->result;
    if (scenes == 0) return status_ok();
    onset_skip *more = realloc(a->skip, ((size_t)r->n_skips + 1) * sizeof *more);
    CHECK(more, STATUS_MEMORY, "no memory for a summary");
    a->skip = more;
    r->skip = more;
    r->scenes_skipped += scenes;
    more[r->n_skips].scenes = scenes;
    snprintf(more[r->n_skips++].rests_on, sizeof more->rests_on, "%s", rests_on);
    return status_ok();
}

static status count_skips(onset_answer *a)
{
    int shared = 0, inferred = 0;
    for (int i = 0; i < a->result.n_sites; i++) shared += a->grains.of_site[i] >= 0;
    for (int k = 0; k < a->grains.n; k++) {
        const grain_family *f = &a->grains.family[k];
        inferred += f->surface.inferred;
        for (int j = 0; j < f->surface.sizes; j++)
            for (int i = 0; i < a->result.n_sites; i++)
                if (a->grains.of_site[i] == k && a->grains.c->sites.item[i].radius == f->surface.size[j].radius) {
                    shared--; /* one site of each size is what the search is for */
                    break;
                }
    }
    TRY(add_skip(a, a->grains.screened, "screen: impact pressure over hardness below study.screen_low"));
    TRY(add_skip(a, shared, "shared: a site of the same grain has them"));
    TRY(add_skip(a, inferred, "monotone: a size bounded by the scenes of smaller and larger ones"));
    return add_skip(a, a->grains.too_small, "size: a population below study.smallest_radius");
}

static status list_surface(onset_answer *a)
{
    int n = 0;
    for (int k = 0; k < a->grains.n; k++) n += a->grains.family[k].surface.sizes;
    a->size = calloc((size_t)n + 1, sizeof *a->size);
    CHECK(a->size, STATUS_MEMORY, "no memory for %d sizes", n);
    a->result.surface = a->size;
    for (int k = 0; k < a->grains.n; k++)
        for (int j = 0; j < a->grains.family[k].surface.sizes; j++) {
            const grain_family *f = &a->grains.family[k];
            const surface_size from = study_surface_at(&f->surface, f->surface.size[j].radius);
            onset_size *to = &a->size[a->result.n_surface++];
            *to = (onset_size){ .family = k + 1,
                                .radius = from.radius,
                                .grains = from.weight,
                                .threshold_velocity = from.velocity,
                                .threshold_interval = { from.interval[0], from.interval[1] },
                                .scenes = from.scenes };
            const surface_size scratch = scratch_at(f, from.radius);
            to->scratch_velocity = scratch.velocity;
            memcpy(to->scratch_interval, scratch.interval, sizeof scratch.interval);
            memcpy(to->shape, f->grain.shape, sizeof to->shape);
            memcpy(to->material, f->grain.material, sizeof to->material);
        }
    return status_ok();
}

/* With less than two cells across bending and shear in a layer are not resolved (docs/theory/onset.md). */
static void warn_of_thin_layers(session *s, const onset_answer *a)
{
    const case_impact *c = &a->grains.c->impact;
    for (int k = 0; k < a->grains.n; k++) {
        const surface_plan *p = &a->grains.family[k].plan;
        const double cell = p->size[p->reference] / p->search.fine;
        for (int i = 0; i < c->rail.layers.n; i++) {
            const case_layer *layer = &c->rail.layers.item[i];
            const double across = gouge_cells_across(&c->scene, cell, layer->thickness);
            if (across < GOUGE_RESOLVED_LAYER)
                run_session_warn(
                    s, "%srail.layers[%d]: %g um of %s has %.2g cells across: what it does inside is not resolved",
                    a->grains.surface, i, 1e6 * layer->thickness, layer->material, across);
        }
    }
}

static void warn_of_thresholds(session *s, const onset_answer *a)
{
    const case_study *y = &a->grains.c->study;
    for (int k = 0; k < a->grains.n; k++) {
        const grain_family *f = &a->grains.family[k];
        if (f->surface.warning[0]) run_session_warn(s, "%s%s", a->grains.surface, f->surface.warning);
        if (f->scratch && f->scratches.warning[0])
            run_session_warn(s, "%sscratches: %s", a->grains.surface, f->scratches.warning);
    }
    if (a->grains.n && y->fine_cells_per_radius < TRUSTED_CELLS && a->first)
        run_session_warn(
            s,
            "thresholds at %g cells a radius: below %g they come out up to twice too high, by more than the interval "
            "allows for (docs/theory/onset.md)%s",
            y->fine_cells_per_radius, TRUSTED_CELLS,
            y->fine_cells_per_radius < ORDERED_CELLS ? "; nor does the order of surfaces count below 2: a try alone"
                                                     : "");
}

/* A search that ended below a gouge says nothing of faster grains. */
static void warn_of_range(session *s, const onset_answer *a)
{
    const case_study *y = &a->grains.c->study;
    const double fastest = gouge_trace_fastest(&a->flown);
    bool ended = false;
    for (int k = 0; k < a->grains.n; k++)
        ended = ended || a->grains.family[k].surface.reference.outcome == THRESHOLD_ABOVE;
    if (!ended || fastest <= y->velocity_high) return;
    run_session_warn(s,
                     "%sthe armature reaches %.0f m/s, the search ended at study.velocity_high = %g m/s without a "
                     "gouge: raise that to learn of grains that are passed faster",
                     a->grains.surface, fastest, y->velocity_high);
}

static void warn_of_screen(session *s, const onset_answer *a)
{
    const grain_families *g = &a->grains;
    if (g->n == 0 && g->too_small > 0)
        run_session_warn(s,
                         "%sno scene was run: its grains are smaller than study.smallest_radius = %g um and taken not "
                         "to gouge, which nothing shows",
                         g->surface, 1e6 * g->c->study.smallest_radius);
    if (g->unbacked == 0) return;
    run_session_warn(s,
                     "%s%d sites and populations rest on the screen alone, impact pressure over hardness below "
                     "study.screen_low = %g: no scene was run for their grains (study.screen_low: 0 runs them)",
                     a->grains.surface, a->grains.unbacked, a->grains.c->study.screen_low);
}

status study_onset_judge(session *s, onset_answer *a)
{
    warn_of_thresholds(s, a);
    warn_of_range(s, a);
    warn_of_thin_layers(s, a);
    warn_of_screen(s, a);
    find_contradictions(s, a);
    judge_sites(a);
    conclude_list(a);
    TRY(set_threshold(a));
    TRY(list_surface(a));
    return count_skips(a);
}
