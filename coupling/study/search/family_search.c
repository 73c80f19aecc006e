/* SPDX-License-Identifier: BSD-3-Clause */
/* The searches of families, all of them side by side.  Each is told what is known and says what it needs next; what it
 * may need after that is found by following a copy of it through guesses. */
#include "coupling/study/search/family.h"

#include "coupling/gouge/growth.h"
#include "coupling/gouge/impact_scene.h"
#include "coupling/host/numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PRESSURE_STEP = 5e6; /* that of the shot is rounded, so that searches share scenes [Pa] */

/* ---- one search ---- */

enum { TOGETHER = THRESHOLD_TOGETHER }; /* most scenes that a search needs at a time */

/* A scene that it needs. */
typedef struct {
    surface_wanted at;
    bool whole; /* to its end, for its crater */
} family_wanted;

/* A family's search: its thresholds, of the gouge and, where it has one, of the scratch, then the whole craters of what
 * gouges.  The second search takes the scenes of the first at no cost: velocities lie on one grid.  A copy goes on by
 * itself. */
typedef struct {
    const grain_families *of; /* borrowed */
    grain_family *family;     /* borrowed; has its scenes as they come, its thresholds at the end */
    int number;               /* of the family, from 1 */
    family_judge judge;       /* whose search is under way */
    surface_search surface[FAMILY_JUDGES];
    int lent; /* scenes that the second search has beyond study.max_scenes until it finds as many of the first's */
    bool in_craters;
    int n_craters; /* not known yet */
    family_wanted crater[TOGETHER];
} family_search;

scene_query study_family_query(const grain_families *f, int k, const family_scene *scene)
{
    const case_impact *from = scene->whole ? &f->whole : &f->probe;
    const grain_family *family = &f->family[k];
    trace_point shot;
    gouge_trace_at_velocity(f->flown, scene->velocity, &shot); /* a velocity never reached: where the shot ends */
    const double pressure = PRESSURE_STEP * round(shot.contact_pressure / PRESSURE_STEP);
    const double lead_face = GOUGE_TEMPERATURE_STEP * round(shot.lead_face_temperature / GOUGE_TEMPERATURE_STEP);
    site_state state = { .grain = family->grain,
                         .reached = true,
                         .velocity = scene->velocity,
                         .contact_pressure = host_number_or(from->scene.contact_pressure, pressure),
                         .lead_face_temperature = lead_face };
    state.grain.radius = scene->radius;
    state.grain.height = family->aspect * scene->radius;
    scene_query q = { .impact = gouge_impact_at(from, &state, scene->cells) };
    char size[32] = "";
    if (family->plan.sizes > 1) snprintf(size, sizeof size, "-r%.6g", 1e3 * scene->radius);
    snprintf(q.name, sizeof q.name, "%.40sg%d%s-v%g-c%g%s", f->prefix, k + 1, size, scene->velocity, scene->cells,
             case_impact_is_gauged(from) ? "-growth" : "");
    return q;
}

static scene_query query_of(const family_search *s, const family_wanted *w)
{
    const family_scene scene = { w->at.radius, w->at.velocity, w->at.cells_per_radius, w->whole, NULL };
    return study_family_query(s->of, s->number - 1, &scene);
}

/* Does the groove grow?  Its shape does not count; one that dies has its scene's class, which leaves open whether it
 * died of itself. */
static damage_class class_by_growth(double folds, double scatter, damage_class class)
{
    if (fabs(folds) < scatter) return DAMAGE_UNDECIDED;
    return folds > 0.0 ? DAMAGE_GOUGE : class == DAMAGE_GOUGE ? DAMAGE_SCRATCH : class;
}

threshold_sample study_family_sample(const case_onset *c, family_judge judge, const onset_scene *e)
{
    const scene_result *r = &e->result;
    const case_scene *limits = &c->impact.scene;
    threshold_sample is = { e->velocity, e->cells_per_radius, r->severity - limits->limit_severity, r->crater_class };
    if (!e->gauged) return is;
    const double folds = gouge_growth_folds(r->groove_growth, e->radius, e->velocity);
    if (judge == JUDGE_OF_GOUGE) {
        is.excess = gouge_tear_drop_excess(folds, r->length_over_width, limits->limit_length_over_width);
        is.class = r->class;
    } else {
        is.excess = folds;
        is.class = class_by_growth(folds, limits->growth_scatter, r->class);
    }
    return is;
}

static double on_grid_below(const threshold_plan *p, double v)
{
    return p->step * floor(fmin(v, p->high) / p->step + 1e-9);
}

/* Of the grains of one family [m/s]. */
static double fastest_grain(const grain_families *f, const grain_family *family)
{
    double v = 0.0;
    for (int i = 0; i < f->c->sites.n; i++)
        if (f->of_site[i] >= 0 && &f->family[f->of_site[i]] == family) v = fmax(v, f->flown->site[i].velocity);
    for (int i = 0; i < f->c->populations.n; i++)
        if (f->of_population[i] >= 0 && &f->family[f->of_population[i]] == family)
            v = fmax(v, gouge_trace_fastest(f->flown));
    return v;
}

/* May a grain of this size that comes with v gouge, for all that is known? */
static bool may_gouge(const surface_size *t, double v)
{
    return !isnan(t->interval[1]) && !(v <= t->interval[0]);
}

/* The size whose craters count: the reference if it may gouge at v, else the largest that may; -1: none. */
static int size_of_craters(const surface_plan *p, const surface_result *s, double v)
{
    if (may_gouge(&s->size[p->reference], v)) return p->reference;
    int k = s->sizes - 1;
    while (k >= 0 && !may_gouge(&s->size[k], v)) k--;
    return k;
}

/* The scene of the search nearest to the middle of the velocities that gouge for sure in its cells; of none in their
 * inner two thirds, the middle; where no grain is fast enough for sure, the slowest that gouges. */
static double middle_gouge(const surface_plan *p, const surface_result *s, int k, double fastest)
{
    const double step = p->search.step, low = study_surface_end_in_cells(s, &s->size[k]),
                 middle = 0.5 * (low + fastest);
    double best = NAN, off = (fastest - low) / 3.0;
    if (low >= fastest) return k == p->reference ? s->reference.bracket[1] : step * ceil(low / step);
    for (int i = 0; i < s->samples; i++) {
        const surface_sample *a = &s->sample[i];
        const double v = a->is.velocity;
        if (a->radius != p->size[k] || a->is.cells_per_radius != s->reference.cells ||
            !study_threshold_is_upper(&a->is) || fabs(v - middle) > off)
            continue;
        best = v, off = fabs(v - middle);
    }
    return isnan(best) ? step * ceil(middle / step) : best;
}

/* Once the thresholds are known: whole craters of what gouges, in the middle of its velocities and at the fastest
 * grain.  Where gouging begins a groove is longest, costs most, and hangs on the resolution. */
static void ask_for_craters(family_search *s)
{
    const surface_plan *p = &s->family->plan;
    const surface_result *r = &s->surface[JUDGE_OF_GOUGE].result;
    const double fastest = fastest_grain(s->of, s->family), own = s->of->c->study.crater_cells_per_radius,
                 cells = isnan(own) ? r->reference.cells : own;
    const int k = size_of_craters(p, r, fastest);
    s->in_craters = true;
    if (!s->family->by_growth || k < 0) return;
    const double top = on_grid_below(&p->search, p->search.high);
    const double slower = fmin(middle_gouge(p, r, k, on_grid_below(&p->search, fastest)), top);
    const double at[TOGETHER] = { slower, fmax(slower, on_grid_below(&p->search, fastest)) };
    for (int i = 0; i < s->of->c->study.craters; i++)
        if (i == 0 || at[i] != at[0]) s->crater[s->n_craters++] = (family_wanted){ { p->size[k], at[i], cells }, true };
}

static status begin_search(const grain_families *of, int k, family_search *out)
{
    *out = (family_search){ .of = of, .family = &of->family[k], .number = k + 1 };
    return study_surface_begin(&of->family[k].plan, &out->surface[JUDGE_OF_GOUGE]);
}

/* The first search has left no scene to the second: that one says what those of the first do. */
static status conclude_scratches(family_search *s)
{
    const grain_family *f = s->family;
    surface_sample known[THRESHOLD_MAX_SAMPLES];
    int n = 0;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *e = &f->scene[i];
        if (e->whole) continue;
        const threshold_sample is = study_family_sample(s->of->c, JUDGE_OF_SCRATCH, &e->record->entry);
        if (isfinite(is.excess)) known[n++] = (surface_sample){ e->radius, is };
    }
    return study_surface_conclude(&f->scratch_plan, known, n, &s->surface[JUDGE_OF_SCRATCH]);
}

/* What study.max_scenes leaves to the second search: scenes of the first that it finds are given back (go_on).  It
 * begins with the two that the first began with, so those are lent where fewer are left. */
static status begin_scratches(family_search *s)
{
    surface_plan *p = &s->family->scratch_plan;
    const int left = s->family->plan.search.max_scenes - s->surface[JUDGE_OF_GOUGE].result.samples;
    s->judge = JUDGE_OF_SCRATCH;
    s->lent = left < TOGETHER ? TOGETHER - left : 0;
    p->search.max_scenes = left + s->lent;
    if (left <= 0) return conclude_scratches(s);
    return study_surface_begin(p, &s->surface[JUDGE_OF_SCRATCH]);
}

/* The search under way has come to its end: on to the next one, or to the craters. */
static status next_stage(family_search *s)
{
    if (s->judge == JUDGE_OF_GOUGE && s->family->scratch) TRY(begin_scratches(s));
    if (!s->surface[s->judge].over) return status_ok();
    ask_for_craters(s);
    return status_ok();
}

/* The scenes that the search needs all of before it goes on; how many.  0: it is over. */
static int ask(const family_search *s, family_wanted out[TOGETHER])
{
    surface_wanted at[THRESHOLD_TOGETHER];
    if (s->in_craters) {
        memcpy(out, s->crater, sizeof s->crater);
        return s->n_craters;
    }
    const int n = study_surface_ask(&s->surface[s->judge], at);
    for (int i = 0; i < n; i++) out[i] = (family_wanted){ at[i], false };
    return n;
}

static bool same_wanted(const family_wanted *a, const family_wanted *b)
{
    return a->whole == b->whole && a->at.radius == b->at.radius && a->at.velocity == b->at.velocity &&
           a->at.cells_per_radius == b->at.cells_per_radius;
}

/* One of them is known.  Of a whole crater nothing is asked but that it is there. */
static status tell(family_search *s, const family_wanted *w, const threshold_sample *is)
{
    if (!s->in_craters) {
        surface_search *now = &s->surface[s->judge];
        TRY(study_surface_tell(now, &(surface_sample){ w->at.radius, *is }));
        return now->over ? next_stage(s) : status_ok();
    }
    int left = 0;
    for (int i = 0; i < s->n_craters; i++)
        if (!same_wanted(&s->crater[i], w)) s->crater[left++] = s->crater[i];
    s->n_craters = left;
    return status_ok();
}

/* ---- what it may need later ---- */

/* Scenes that a search may come to need, with the guesses of its threshold under which it does. */
typedef struct {
    int n;
    struct {
        family_wanted is;
        int guesses;
    } item[64];
} prospect;

static void note(prospect *p, const family_wanted *w)
{
    int i = 0;
    while (i < p->n && !same_wanted(&p->item[i].is, w)) i++;
    if (i == (int)(sizeof p->item / sizeof *p->item)) return;
    if (i == p->n) {
        p->item[i].is = *w;
        p->item[i].guesses = 0;
        p->n++;
    }
    p->item[i].guesses++;
}

/* Follows a copy of the search to its end; every scene answers as if the threshold were this, an e-fold in 100 m/s. */
static status follow_guess(const family_search *now, double threshold, family_search *copy, prospect *out)
{
    family_wanted needed[TOGETHER];
    int n;
    *copy = *now;
    while ((n = ask(copy, needed)) > 0)
        for (int i = 0; i < n; i++) {
            const double excess = 0.01 * (needed[i].at.velocity - threshold);
            const threshold_sample is = { needed[i].at.velocity, needed[i].at.cells_per_radius, excess,
                                          excess >= 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH };
            note(out, &needed[i]);
            TRY(tell(copy, &needed[i], &is));
        }
    return status_ok();
}

/* Guesses: the threshold on both sides of every needed scene and at the ends of the range; how many, in *guesses. */
static status guess_on(const family_search *now, family_search *copy, prospect *out, int *guesses)
{
    const threshold_plan *p = &now->family->plan.search;
    family_wanted needed[TOGETHER];
    const int n = ask(now, needed);
    double threshold[2 * TOGETHER + 2] = { p->low, p->high };
    *guesses = 2;
    out->n = 0;
    for (int i = 0; i < n; i++)
        for (int side = -1; side <= 1; side += 2)
            threshold[(*guesses)++] = needed[i].at.velocity + 0.5 * side * p->step;
    for (int i = 0; i < *guesses; i++) TRY(follow_guess(now, threshold[i], copy, out));
    return status_ok();
}

/* ---- all searches ---- */

enum { MAX_QUERIES = 256 };

/* What all searches ask of run/ in one round. */
typedef struct {
    int n_needed, n_next;
    bool any_order; /* as run_scenes_ahead has it */
    scene_query needed[MAX_QUERIES], next[MAX_QUERIES];
    prospect ahead;
    family_search copy;
} requests;

static bool is_longer(const scene_query *a, const scene_query *b)
{
    const bool whole[2] = { !case_impact_is_gauged(&a->impact), !case_impact_is_gauged(&b->impact) };
    return whole[0] != whole[1] ? whole[0] : a->impact.scene.cells_per_radius > b->impact.scene.cells_per_radius;
}

static void sort_longest_first(scene_query *list, int n)
{
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && is_longer(&list[k], &list[k - 1]); k--) {
            const scene_query longer = list[k];
            list[k] = list[k - 1];
            list[k - 1] = longer;
        }
}

static bool is_needed(const family_search *s, const family_wanted *w)
{
    family_wanted needed[TOGETHER];
    const int n = ask(s, needed);
    for (int i = 0; i < n; i++)
        if (same_wanted(&needed[i], w)) return true;
    return false;
}

/* What the search may need after its needed scenes, first what it needs in every case, nothing that it needs in less
 * than two cases of three: lent to a needed scene, the threads are worth 0.6 of themselves.  Where every scene to come
 * is certain, all may run in any order, and the needed ones stand among the others: the longest first. */
static status look_ahead(const family_search *now, requests *r)
{
    const prospect *p = &r->ahead;
    scene_query *list = r->next + r->n_next;
    int guesses, certain = 0, n = 0;
    TRY(guess_on(now, &r->copy, &r->ahead, &guesses));
    for (int i = 0; i < p->n; i++) certain += p->item[i].guesses == guesses;
    const bool any_order = certain == p->n;
    for (int least = guesses; 3 * least >= 2 * guesses; least--)
        for (int i = 0; i < p->n && r->n_next + n < MAX_QUERIES; i++)
            if (p->item[i].guesses == least && (any_order || !is_needed(now, &p->item[i].is)))
                list[n++] = query_of(now, &p->item[i].is);
    if (any_order) sort_longest_first(list, n);
    r->n_next += n;
    r->any_order = r->any_order && any_order;
    return status_ok();
}

/* Into the family's list; false: it has that scene. */
static bool keep(grain_family *f, const family_wanted *w, const scene_record *record)
{
    for (int i = 0; i < f->n_scenes; i++)
        if (f->scene[i].record == record && f->scene[i].whole == w->whole) return false;
    if (f->n_scenes < THRESHOLD_MAX_SAMPLES)
        f->scene[f->n_scenes++] =
            (family_scene){ w->at.radius, w->at.velocity, w->at.cells_per_radius, w->whole, record };
    return true;
}

/* What gouges grows: where the second search saw no groove grow, it does so at the latest where gouges begin. */
static void bound_scratches(grain_family *f)
{
    surface_result *scratch = &f->scratches;
    const surface_result *gouge = &f->surface;
    if (isnan(scratch->reference.interval[1])) {
        scratch->reference.interval[1] = gouge->reference.interval[1];
        scratch->reference.allowance[1] = gouge->reference.allowance[1];
        scratch->reference.of_cells[1] = gouge->reference.of_cells[1];
    }
    for (int k = 0; k < scratch->sizes; k++)
        if (isnan(scratch->size[k].interval[1])) scratch->size[k].interval[1] = gouge->size[k].interval[1];
}

/* Tells the search all that is known, until it needs what is not: n scenes of needed. */
static status go_on(session *s, family_search *search, scene_query needed[TOGETHER], int *n)
{
    family_wanted wanted[TOGETHER];
    int asked;
    do {
        asked = ask(search, wanted);
        *n = 0;
        for (int i = 0; i < asked; i++) {
            const scene_record *record;
            needed[*n] = query_of(search, &wanted[i]);
            TRY(run_scenes_find(s, &needed[*n], &record));
            if (!record) {
                (*n)++;
                continue;
            }
            const threshold_sample is = study_family_sample(search->of->c, search->judge, &record->entry);
            const bool fresh = keep(search->family, &wanted[i], record);
            if (!fresh && search->judge == JUDGE_OF_SCRATCH && search->lent-- <= 0)
                search->family->scratch_plan.search.max_scenes++;
            TRY(tell(search, &wanted[i], &is));
        }
    } while (*n < asked);
    if (*n > 0) return status_ok();
    search->family->surface = search->surface[JUDGE_OF_GOUGE].result;
    if (search->family->scratch) {
        search->family->scratches = search->surface[JUDGE_OF_SCRATCH].result;
        bound_scratches(search->family);
    }
    return status_ok();
}

/* All searches as far as they come; r: what they need and may need. */
static status go_on_all(session *s, family_search *search, int n, requests *r)
{
    r->n_needed = r->n_next = 0;
    r->any_order = true;
    for (int i = 0; i < n && r->n_needed + TOGETHER <= MAX_QUERIES; i++) {
        int needed;
        TRY(go_on(s, &search[i], r->needed + r->n_needed, &needed));
        r->n_needed += needed;
        if (s->crew && needed > 0) TRY(look_ahead(&search[i], r));
    }
    return status_ok();
}

static status search_all(session *s, grain_families *const *f, int n, family_search *search, requests *r)
{
    int searches = 0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < f[i]->n; k++) TRY(begin_search(f[i], k, &search[searches++]));
    do {
        TRY(go_on_all(s, search, searches, r));
        TRY(run_scenes_ahead(s, r->next, r->n_next, r->any_order));
        TRY(run_scenes_some(s, r->needed, r->n_needed));
    } while (r->n_needed > 0);
    return status_ok();
}

status study_families_search(session *s, grain_families *const *f, int n)
{
    size_t families = 1;
    for (int i = 0; i < n; i++) families += (size_t)f[i]->n;
    requests *r = malloc(sizeof *r);
    family_search *search = malloc(families * sizeof *search);
    const status done = r && search ? search_all(s, f, n, search, r)
                                    : base_status_error(STATUS_MEMORY, "no memory for the searches of %d surfaces", n);
    free(r);
    free(search);
    return done;
}
