/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/search/family.h"

#include "coupling/gouge/screen.h"
#include "coupling/study/sampling/population.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void study_families_free(grain_families *f)
{
    free(f->family);
    free(f->of_site);
    free(f->of_population);
    memset(f, 0, sizeof *f);
}

/* ---- who belongs together ---- */

static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* But for their sizes; each with its height over radius. */
static bool alike(const case_site *a, double aspect_a, const case_site *b, double aspect_b)
{
    return fabs(aspect_a - aspect_b) < 1e-9 && strcmp(a->shape, b->shape) == 0 &&
           strcmp(a->material, b->material) == 0 && same_number(a->bond_strength, b->bond_strength);
}

static bool same_family(const grain_family *f, const case_site *grain, double aspect)
{
    return alike(&f->grain, f->aspect, grain, aspect);
}

static int family_for(grain_families *f, const case_site *grain, double aspect)
{
    for (int k = 0; k < f->n; k++)
        if (same_family(&f->family[k], grain, aspect)) return k;
    grain_family *fresh = &f->family[f->n];
    fresh->grain = *grain;
    fresh->aspect = aspect;
    return f->n++;
}

/* One of a population; its size is the family's to say. */
static case_site grain_of(const case_population *p)
{
    case_site grain = { .position = NAN, .bond_strength = p->bond_strength };
    memcpy(grain.shape, p->shape, sizeof grain.shape);
    memcpy(grain.material, p->material, sizeof grain.material);
    return grain;
}

/* The k-th of the sites, then of the populations. */
static case_site grain_at(const case_onset *c, int k, double *aspect)
{
    const bool is_site = k < c->sites.n;
    const case_site grain = is_site ? c->sites.item[k] : grain_of(&c->populations.item[k - c->sites.n]);
    *aspect = is_site ? grain.height / grain.radius : c->populations.item[k - c->sites.n].aspect;
    return grain;
}

static bool is_new_kind(const case_onset *c, int k)
{
    double aspect, former;
    const case_site grain = grain_at(c, k, &aspect);
    for (int i = 0; i < k; i++) {
        const case_site before = grain_at(c, i, &former);
        if (alike(&before, former, &grain, aspect)) return false;
    }
    return true;
}

int study_family_kinds(const case_onset *c)
{
    int kinds = 0;
    for (int k = 0; k < c->sites.n + c->populations.n; k++) kinds += is_new_kind(c, k);
    return kinds;
}

static status add_size(surface_plan *p, double size, double weight)
{
    int k = 0;
    while (k < p->sizes && p->size[k] < size) k++;
    if (k < p->sizes && p->size[k] == size) {
        p->weight[k] += weight;
        return status_ok();
    }
    CHECK(p->sizes < SURFACE_MAX_SIZES, STATUS_BAD_INPUT,
          "sites, populations: more than %d sizes of grains alike in all else; round some", SURFACE_MAX_SIZES);
    memmove(p->size + k + 1, p->size + k, (size_t)(p->sizes - k) * sizeof *p->size);
    memmove(p->weight + k + 1, p->weight + k, (size_t)(p->sizes - k) * sizeof *p->weight);
    p->size[k] = size;
    p->weight[k] = weight;
    p->sizes++;
    return status_ok();
}

/* Of grains of that height over radius, the size under which the rail resists least [m]. */
static status softest_under(const case_surface *s, double aspect, const population_sizes *of, double velocity,
                            screen *out)
{
    for (int k = 0; k < of->n; k++) {
        screen hit;
        TRY(gouge_screen_impact(s, aspect * of->size[k], velocity, &hit));
        if (k == 0 || hit.ratio > out->ratio) *out = hit;
    }
    return status_ok();
}

static status sort_sites(grain_families *f)
{
    const case_surface surface = case_surface_of(f->c);
    for (int i = 0; i < f->c->sites.n; i++) {
        const site_state *site = &f->flown->site[i];
        const case_site *grain = &f->c->sites.item[i]; /* a treatment may have changed it */
        screen hit;
        f->of_site[i] = -1;
        if (!site->reached) continue;
        TRY(gouge_screen_impact(&surface, grain->height, site->velocity, &hit));
        if (hit.skip) {
            f->screened++;
            continue;
        }
        f->of_site[i] = family_for(f, grain, grain->height / grain->radius);
        TRY(add_size(&f->family[f->of_site[i]].plan, grain->radius, 1.0));
    }
    return status_ok();
}

static status sort_populations(grain_families *f)
{
    const case_onset *c = f->c;
    const case_surface surface = case_surface_of(c);
    screen hit = { .skip = false };
    for (int i = 0; i < c->populations.n; i++) {
        const case_population *p = &c->populations.item[i];
        population_sizes sizes;
        const case_site grain = grain_of(p);
        TRY(study_population_sizes(p, c->study.smallest_radius, &sizes));
        f->of_population[i] = -1;
        f->too_small += sizes.n == 0;
        if (sizes.n == 0) continue;
        TRY(softest_under(&surface, p->aspect, &sizes, gouge_trace_fastest(f->flown), &hit));
        if (hit.skip) {
            f->screened++;
            continue;
        }
        f->of_population[i] = family_for(f, &grain, p->aspect);
        surface_plan *plan = &f->family[f->of_population[i]].plan;
        for (int k = 0; k < sizes.n; k++) TRY(add_size(plan, sizes.size[k], sizes.number[k]));
    }
    return status_ok();
}

/* ---- what the screen alone decides ---- */

/* NULL: no grain alike has scenes. */
static const grain_family *family_of_grain(const grain_families *f, const case_site *grain, double aspect)
{
    for (int k = 0; k < f->n; k++)
        if (same_family(&f->family[k], grain, aspect)) return &f->family[k];
    return NULL;
}

int study_family_of_site(const grain_families *f, int site)
{
    const case_site *grain = &f->c->sites.item[site];
    if (f->of_site[site] >= 0 || !f->flown->site[site].reached) return f->of_site[site];
    const grain_family *same = family_of_grain(f, grain, grain->height / grain->radius);
    return same ? (int)(same - f->family) : -1;
}

static void note_unbacked(grain_families *f, const screen *hit)
{
    f->unbacked++;
    f->screen_probability = fmax(f->screen_probability, hit->probability);
}

static status find_unbacked_sites(grain_families *f, const case_surface *surface)
{
    for (int i = 0; i < f->c->sites.n; i++) {
        const site_state *site = &f->flown->site[i];
        screen hit;
        if (!site->reached || study_family_of_site(f, i) >= 0) continue;
        TRY(gouge_screen_impact(surface, f->c->sites.item[i].height, site->velocity, &hit));
        note_unbacked(f, &hit);
    }
    return status_ok();
}

static status find_unbacked_populations(grain_families *f, const case_surface *surface)
{
    for (int i = 0; i < f->c->populations.n; i++) {
        const case_population *p = &f->c->populations.item[i];
        population_sizes sizes;
        const case_site grain = grain_of(p);
        const double any = -expm1(-p->density * (p->to - p->from)); /* that the barrel holds one */
        screen hit;
        TRY(study_population_sizes(p, f->c->study.smallest_radius, &sizes));
        if (sizes.n == 0 || any == 0.0 || f->of_population[i] >= 0 || family_of_grain(f, &grain, p->aspect)) continue;
        TRY(softest_under(surface, p->aspect, &sizes, gouge_trace_fastest(f->flown), &hit));
        hit.probability *= any;
        note_unbacked(f, &hit);
    }
    return status_ok();
}

/* ---- plans ---- */

static double place_of(const void *user, double v)
{
    const grain_families *f = user;
    trace_point at;
    gouge_trace_at_velocity(f->flown, v, &at); /* a velocity never reached: where the shot ends */
    return at.x;
}

/* The size in the middle of the weights. */
static int middle_size(const surface_plan *p)
{
    double all = 0.0, below = 0.0;
    for (int k = 0; k < p->sizes; k++) all += p->weight[k];
    for (int k = 0; k < p->sizes; k++) {
        below += p->weight[k];
        if (below >= 0.5 * all) return k;
    }
    return 0;
}

/* The velocity below which the screen skips every size of a family [m/s]. */
static status slowest_above(const case_surface *s, double aspect, const surface_plan *p, double ratio, double *velocity)
{
    *velocity = INFINITY;
    for (int k = 0; k < p->sizes; k++) {
        double v;
        TRY(gouge_screen_velocity(s, aspect * p->size[k], ratio, &v));
        *velocity = fmin(*velocity, v);
    }
    return status_ok();
}

static status plan_searches(grain_families *f)
{
    const case_study *y = &f->c->study;
    const bool by_growth = case_impact_is_gauged(&f->probe);
    const int craters = by_growth ? y->craters * f->n : 0;
    const case_surface surface = case_surface_of(f->c);
    CHECK(f->n + craters <= y->max_scenes, STATUS_BAD_INPUT,
          "study.max_scenes = %d: for %d kinds of grain, %d whole craters; allow more or make the grains alike",
          y->max_scenes, f->n, craters);
    for (int k = 0; k < f->n; k++) {
        surface_plan *p = &f->family[k].plan;
        double sure;
        TRY(slowest_above(&surface, f->family[k].aspect, p, y->screen_low, &sure));
        p->reference = middle_size(p);
        f->family[k].by_growth = by_growth;
        p->search = (threshold_plan){ .low = fmax(y->velocity_low, fmin(sure, 0.5 * y->velocity_high)),
                                      .high = y->velocity_high,
                                      .interval = y->velocity_interval,
                                      .step = study_threshold_step(y->velocity_interval),
                                      .coarse = y->coarse_cells_per_radius,
                                      .fine = y->fine_cells_per_radius,
                                      .scatter = by_growth ? f->c->impact.scene.growth_scatter : 0.0,
                                      .resolution = y->resolution_error,
                                      .above = by_growth ? y->resolution_above : y->resolution_error,
                                      .max_scenes = (y->max_scenes - craters) / f->n,
                                      .place = place_of,
                                      .place_user = f,
                                      .place_interval = y->position_interval * f->c->launcher.barrel.length };
    }
    return status_ok();
}

void study_families_want_scratch(grain_families *f)
{
    f->scratch = f->c->study.scratch;
    for (int k = 0; k < f->n; k++) {
        grain_family *one = &f->family[k];
        one->scratch = f->scratch && one->by_growth;
        one->scratch_plan = one->plan;
    }
}

surface_result *study_family_surface(grain_family *f, family_judge judge)
{
    return judge == JUDGE_OF_GOUGE ? &f->surface : &f->scratches;
}

family_scatter *study_family_scatter(grain_family *f, family_judge judge)
{
    return judge == JUDGE_OF_GOUGE ? &f->scatter : &f->scratch_scatter;
}

case_impact study_family_probe(const case_onset *c)
{
    case_impact probe = c->impact;
    probe.scene.stop_when_gauged = c->study.judge == JUDGE_GROWTH;
    if (case_impact_is_gauged(&probe)) probe.snapshots = 0;
    return probe;
}

status study_families_sort(const case_onset *c, const shot_outcome *flown, const char *prefix, grain_families *out)
{
    const size_t sites = (size_t)c->sites.n, populations = (size_t)c->populations.n;
    *out = (grain_families){
        .c = c, .probe = study_family_probe(c), .whole = c->impact, .flown = flown, .prefix = prefix
    };
    out->whole.scene.stop_when_gauged = false;
    out->family = calloc(sites + populations + 1, sizeof *out->family);
    out->of_site = calloc(sites + 1, sizeof *out->of_site);
    out->of_population = calloc(populations + 1, sizeof *out->of_population);
    CHECK(out->family && out->of_site && out->of_population, STATUS_MEMORY, "no memory for %zu sites", sites);
    TRY(sort_sites(out));
    TRY(sort_populations(out));
    const case_surface surface = case_surface_of(c);
    TRY(find_unbacked_sites(out, &surface));
    TRY(find_unbacked_populations(out, &surface));
    return plan_searches(out);
}

grain_family *study_family_alike(const grain_families *in, const grain_family *f)
{
    for (int k = 0; k < in->n; k++)
        if (same_family(&in->family[k], &f->grain, f->aspect)) return &in->family[k];
    return NULL;
}

bool study_family_searched(const grain_family *f, const family_scene *scene)
{
    return !(f->by_growth && scene->whole);
}

const family_scene *study_family_nearest(const grain_family *f, double radius, double velocity)
{
    const family_scene *best = NULL;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (!study_family_searched(f, a)) continue;
        if (!best) best = a;
        const double far = fabs(log(a->radius / radius)), best_far = fabs(log(best->radius / radius));
        const bool nearer = fabs(a->velocity - velocity) < fabs(best->velocity - velocity);
        if (a->cells != best->cells ? a->cells > best->cells : far != best_far ? far < best_far : nearer) best = a;
    }
    return best;
}
