/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/compare.h"

#include "coupling/case/treatment.h"
#include "coupling/study/layer_wear.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void study_compare_answer_free(compare_answer *a)
{
    for (int i = 0; i < a->n; i++) {
        study_onset_answer_free(&a->answer[i]);
        case_treated_free(&a->treated[i]);
    }
    study_mc_free(&a->drawn);
    study_life_compare_free(&a->life);
    free(a->treated);
    free(a->answer);
    free(a->mean);
    free(a->entry);
    free(a->scene);
    memset(a, 0, sizeof *a);
}

/* ---- all surfaces ---- */

enum { PREFIX_SIZE = sizeof((compare_entry *)NULL)->scene_prefix };

/* NULL: untreated. */
static const case_treatment *treatment_of(const case_treatments *all, int surface)
{
    return surface == 0 ? NULL : &all->item[surface - 1];
}

static const char *name_of(const case_treatment *t)
{
    return t ? t->name : "untreated";
}

static void prefix_of(int surface, char out[PREFIX_SIZE])
{
    if (surface > 0)
        snprintf(out, PREFIX_SIZE, "t%d-", surface);
    else
        out[0] = '\0';
}

static status make_room(int surfaces, compare_answer *a)
{
    const size_t n = (size_t)surfaces;
    a->treated = calloc(n, sizeof *a->treated);
    a->answer = calloc(n, sizeof *a->answer);
    a->mean = calloc(n, sizeof *a->mean);
    a->entry = calloc(n, sizeof *a->entry);
    CHECK(a->treated && a->answer && a->mean && a->entry, STATUS_MEMORY, "no memory for %zu surfaces", n);
    a->n = (int)n;
    return status_ok();
}

static status begin(session *s, const case_onset *c, const case_treatments *treatments, compare_answer *a,
                    char (*prefix)[PREFIX_SIZE])
{
    for (int i = 0; i < a->n; i++) {
        const case_treatment *t = treatment_of(treatments, i);
        prefix_of(i, prefix[i]);
        TRY(case_treat(c, t, &a->treated[i]));
        const status begun = study_onset_begin(s, &a->treated[i], prefix[i], i == 0, &a->answer[i]);
        snprintf(a->answer[i].grains.surface, sizeof a->answer[i].grains.surface, "%s: ", name_of(t));
        const status flown = begun.code == STATUS_OK
                                 ? study_repeated_fly(s, &a->answer[i].grains, &a->answer[i].shot, &a->answer[i].rail)
                                 : begun;
        CHECK(flown.code == STATUS_OK, flown.code, "%s%s%s%.400s", t ? "treatment `" : "", t ? t->name : "",
              t ? "`: " : "", flown.text);
    }
    return status_ok();
}

/* `all` has room for REPEATED_RAILS of each surface. */
static status search_first(session *s, compare_answer *a, grain_families **all)
{
    for (int i = 0; i < a->n; i++) all[i] = &a->answer[i].grains;
    TRY(study_families_search(s, all, a->n));
    for (int i = 0; i < a->n; i++) {
        TRY(study_scatter_run(s, &a->answer[i].grains));
        TRY(study_uncertain_run(s, &a->answer[i].grains, &a->answer[i].uncertain));
        TRY(study_onset_judge(s, &a->answer[i]));
    }
    return status_ok();
}

/* What further shots find, of all surfaces side by side. */
static status search_repeated(session *s, compare_answer *a, grain_families **all)
{
    int n = 0;
    for (int i = 0; i < a->n; i++) {
        int more;
        TRY(study_repeated_want(s, &a->answer[i].grains, &a->answer[i].rail, all + n, &more));
        n += more;
    }
    if (n == 0) return status_ok();
    TRY(study_families_search(s, all, n));
    for (int i = 0; i < a->n; i++)
        study_repeated_found(&a->answer[i].rail, &a->answer[i].grains, &a->answer[i].uncertain);
    return status_ok();
}

static status search(session *s, compare_answer *a)
{
    grain_families **all = malloc(REPEATED_RAILS * (size_t)a->n * sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory for %d surfaces", a->n);
    status done = search_first(s, a, all);
    if (done.code == STATUS_OK) done = search_repeated(s, a, all);
    free(all);
    return done;
}

static status draw(session *s, const case_onset *c, compare_answer *a)
{
    mc_surface *surface = malloc((size_t)a->n * sizeof *surface);
    CHECK(surface, STATUS_MEMORY, "no memory for %d surfaces", a->n);
    for (int i = 0; i < a->n; i++) {
        surface[i] = study_repeated_surface(&a->answer[i].rail, &a->answer[i].grains);
        surface[i].draws = i;
    }
    const mc_plan plan = { .histories = c->study.sampled,
                           .shots = c->study.shots,
                           .seed = c->study.seed,
                           .length = c->launcher.barrel.length,
                           .n = a->n,
                           .surface = surface,
                           .stop = s->stop,
                           .progress = &s->progress };
    const status done = study_mc_run(&plan, &a->drawn);
    free(surface);
    TRY(done);
    for (int i = 0; i < a->n; i++) study_mc_mean_shot(&a->drawn, i, &a->mean[i]);
    return status_ok();
}

/* ---- what the layers suffer ---- */

static bool gouged(const grain_family *f, const family_scene *a)
{
    const scene_result *r = &a->record->entry.result;
    return (f->by_growth ? r->class : r->crater_class) == DAMAGE_GOUGE;
}

/* The fastest scene of the search that does not gouge: what a layer must bear where it is meant to help; else the
 * slowest of all. */
static const family_scene *telling_scene(const grain_families *g)
{
    const family_scene *best = NULL;
    if (g->n == 0) return NULL;
    const grain_family *f = &g->family[0];
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (a->cells != f->surface.reference.cells || !study_family_searched(f, a)) continue;
        const bool does = gouged(f, a), best_does = best && gouged(f, best);
        if (!best || (best_does && !does) || (does == best_does && (a->velocity > best->velocity) != does)) best = a;
    }
    return best;
}

static void judge_layers(const case_onset *c, const grain_families *g, compare_entry *e)
{
    const double thickness = case_layers_thickness(&c->impact.rail.layers);
    const family_scene *from = telling_scene(g);
    snprintf(e->layer, sizeof e->layer, "none");
    e->layer_failed = e->layer_velocity = NAN;
    if (!(thickness > 0.0) || !from) return;
    const scene_result *r = &from->record->entry.result;
    const layer_wear wear = study_layer_wear_of(r, thickness, from->radius);
    e->layer_velocity = from->velocity;
    e->layer_failed = wear.failed;
    snprintf(e->layer, sizeof e->layer, "%s", study_layer_wear_word(&wear, r->crater_depth, thickness));
}

/* ---- ranking ---- */

static bool has_scene(const grain_families *g, const scene_record *record)
{
    for (int k = 0; k < g->n; k++)
        for (int i = 0; i < g->family[k].n_scenes; i++)
            if (g->family[k].scene[i].record == record) return true;
    return false;
}

/* Scenes of a surface that none before it has. */
static int own_scenes(const compare_answer *a, int surface)
{
    const grain_families *g = &a->answer[surface].grains;
    int n = 0;
    for (int k = 0; k < g->n; k++)
        for (int i = 0; i < g->family[k].n_scenes; i++) {
            int before = 0;
            while (before < surface && !has_scene(&a->answer[before].grains, g->family[k].scene[i].record)) before++;
            n += before == surface;
        }
    return n;
}

/* NULL: not asked for. */
static void fill_life(const life_entry *of, compare_entry *e)
{
    static const double unknown[3] = { NAN, NAN, NAN };
    e->life = of ? of->is.life : NAN;
    memcpy(e->life_quantiles, of ? of->is.quantiles : unknown, sizeof e->life_quantiles);
    e->lasts = of && of->is.lasting;
    e->life_rank = of ? of->tied : 0;
}

/* By the last shot; NAN: not carried on, or there is but one. */
static double last_found(const repeated_rail *r, mc_change change)
{
    return r->shots > 0 ? r->shot[r->shots - 1].most[change] : NAN;
}

static void forget_gouges(compare_entry *e)
{
    e->onset_position = NAN;
    e->gouges = e->last_gouges = e->gouged_volume = NAN;
    for (int k = 0; k < 2; k++) e->gouges_interval[k] = e->gouged_volume_interval[k] = NAN;
}

static void fill_entry(const case_treatments *treatments, const compare_answer *a, int i, compare_entry *e)
{
    const onset_result *r = &a->answer[i].result;
    const mc_shot *first = &a->drawn.of[i * a->drawn.shots], *last = first + a->drawn.shots - 1;
    const mc_mean_shot *mean = &a->mean[i];
    const case_treatment *t = treatment_of(treatments, i);
    snprintf(e->surface, sizeof e->surface, "%s", name_of(t));
    prefix_of(i, e->scene_prefix);
    e->threshold_velocity = r->threshold_velocity;
    memcpy(e->threshold_interval, r->threshold_interval, sizeof e->threshold_interval);
    e->scratch_velocity = r->scratch_velocity;
    memcpy(e->scratch_interval, r->scratch_interval, sizeof e->scratch_interval);
    e->threshold_deviation = r->threshold_deviation;
    e->part = r->part, e->n_parts = r->n_parts;
    e->threshold_position = r->threshold_position;
    memcpy(e->threshold_position_interval, r->threshold_position_interval, sizeof e->threshold_position_interval);
    e->onset_position = a->treated[i].populations.n > 0 ? first->first[1] : r->onset_position;
    if (study_onset_is_undrawn(&a->answer[i])) {
        forget_gouges(e);
    } else {
        e->gouges = mean->gouges;
        memcpy(e->gouges_interval, mean->gouges_interval, sizeof e->gouges_interval);
        e->last_gouges = last->gouges;
        e->gouged_volume = mean->volume;
        memcpy(e->gouged_volume_interval, mean->volume_interval, sizeof e->gouged_volume_interval);
    }
    e->layer_worn = last_found(&a->answer[i].rail, MC_WEAR);
    e->deposit = last_found(&a->answer[i].rail, MC_METAL);
    e->probability_gouge =
        study_onset_is_unseen(&a->answer[i]) ? NAN : fmax(mean->probability, a->answer[i].grains.screen_probability);
    e->scenes = own_scenes(a, i);
    fill_life(study_life_compare_find(&a->life, e->surface), e);
    judge_layers(&a->treated[i], &a->answer[i].grains, e);
}

/* Where gouging begins, for the order: behind the muzzle where it never does, before the breech where all scenes of the
 * search gouge [m]. */
static double place_of_threshold(const onset_result *r)
{
    if (!isnan(r->threshold_position)) return r->threshold_position;
    const bool below = isnan(r->threshold_velocity) && isnan(r->threshold_interval[0]);
    return below && !isnan(r->threshold_interval[1]) ? -INFINITY : INFINITY;
}

/* What ranks a surface; last those with grains that have no scene and that the screen does not call quiet. */
static double gouges_of(const compare_answer *a, int i)
{
    return a->answer[i].grains.screen_probability >= 1.0 - STUDY_SIGNIFICANT ? INFINITY : a->mean[i].gouges;
}

/* Is surface i the better one?  Of equals the later threshold, then the order of the case. */
static bool is_better(const compare_answer *a, int i, int j)
{
    const double gi = gouges_of(a, i), gj = gouges_of(a, j);
    const double xi = place_of_threshold(&a->answer[i].result), xj = place_of_threshold(&a->answer[j].result);
    if (gi != gj) return gi < gj;
    return xi != xj ? xi > xj : i < j;
}

static double share_better(const compare_answer *all, int i, int j)
{
    const double *a = all->mean[i].world_gouges, *b = all->mean[j].world_gouges;
    double wins = 0.0;
    for (int w = 0; w < MC_WORLDS; w++) wins += a[w] < b[w] ? 1.0 : a[w] == b[w] ? 0.5 : 0.0;
    return wins / MC_WORLDS;
}

static void order_of(const compare_answer *a, int *order)
{
    for (int i = 0; i < a->n; i++) {
        int at = i;
        for (; at > 0 && is_better(a, i, order[at - 1]); at--) order[at] = order[at - 1];
        order[at] = i;
    }
}

/* Grains that no scene was run for are not drawn: such a surface has fewer gouges by the screen's word alone, or by
 * that of study.smallest_radius. */
static bool rests_on_no_scene(const compare_answer *a, int surface)
{
    const grain_families *g = &a->answer[surface].grains;
    return g->unbacked > 0 || study_onset_is_unseen(&a->answer[surface]);
}

/* Of the entries before k that lead a group: the best that surface k cannot be told from; else k. */
static int leader_of(const compare_answer *a, const int *order, int k)
{
    for (int j = 0; j < k; j++) {
        const bool leads = a->entry[j].tied == j + 1;
        const bool told = share_better(a, order[j], order[k]) >= STUDY_SIGNIFICANT && !rests_on_no_scene(a, order[j]);
        if (leads && !told) return j;
    }
    return k;
}

static status rank(const case_treatments *treatments, compare_answer *a)
{
    int *order = malloc((size_t)a->n * sizeof *order);
    CHECK(order, STATUS_MEMORY, "no memory for %d surfaces", a->n);
    order_of(a, order);
    for (int k = 0; k < a->n; k++) {
        compare_entry *e = &a->entry[k];
        fill_entry(treatments, a, order[k], e);
        e->better_than_next = k + 1 < a->n ? share_better(a, order[k], order[k + 1]) : NAN;
        e->significant = e->better_than_next >= STUDY_SIGNIFICANT && !rests_on_no_scene(a, order[k]);
        e->worse_than_best = k > 0 ? share_better(a, order[0], order[k]) : NAN;
        const bool undrawn = study_onset_is_undrawn(&a->answer[order[k]]);
        if (undrawn || (k + 1 < a->n && study_onset_is_undrawn(&a->answer[order[k + 1]]))) e->better_than_next = NAN;
        if (undrawn || study_onset_is_undrawn(&a->answer[order[0]])) e->worse_than_best = NAN;
        e->tied = leader_of(a, order, k) + 1;
    }
    free(order);
    a->result.ranking = a->entry;
    a->result.n = a->n;
    a->result.histories = a->drawn.histories;
    a->result.shots = a->drawn.shots;
    study_compare_conclude(&a->result);
    return status_ok();
}

/* ---- the whole ---- */

/* Are surfaces told apart by scenes on one grid alone? */
static void warn_of_one_grid(session *s, const case_onset *c, const compare_result *r)
{
    bool told = false;
    for (int k = 0; k < r->n; k++) told |= r->ranking[k].tied > 1 && r->ranking[k].scenes > 0;
    for (int k = 0; k < c->study.interval_parts.n; k++)
        if (c->study.interval_parts.item[k].own) return; /* stated instead */
    if (!told || c->study.threshold_ensemble >= 2 || c->study.judge != JUDGE_GROWTH) return;
    run_session_warn(s, "thresholds are of one grid each: what the place of the cells may change is not in the ranks; "
                        "study.threshold_ensemble: 3 holds it, by two scenes more a threshold");
}

static status compare(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                      compare_answer *a, char (*prefix)[PREFIX_SIZE])
{
    if (life) TRY(study_life_compare_run(s, c, treatments, life, false, &a->life, NULL));
    TRY(begin(s, c, treatments, a, prefix));
    TRY(search(s, a));
    TRY(draw(s, c, a));
    for (int i = 0; i < a->n; i++) a->result.scenes_skipped += a->answer[i].result.scenes_skipped;
    TRY(rank(treatments, a));
    warn_of_one_grid(s, c, &a->result);
    return status_ok();
}

status study_compare_run(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                         compare_answer *out)
{
    memset(out, 0, sizeof *out);
    TRY(make_room(treatments->n + 1, out));
    char(*prefix)[PREFIX_SIZE] = calloc((size_t)out->n, sizeof *prefix);
    CHECK(prefix, STATUS_MEMORY, "no memory for %d surfaces", out->n);
    const status done = compare(s, c, treatments, life, out, prefix);
    compare_result *r = &out->result;
    const status listed = study_onset_list_scenes(s, &out->scene, &r->n_scenes, &r->scenes_run, &r->scenes_reused);
    r->scene = out->scene;
    r->wall_seconds = run_session_wall(s);
    for (int i = 0; i < out->n; i++) out->answer[i].grains.prefix = "";
    free(prefix);
    return done.code == STATUS_OK ? listed : done;
}
