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

static bool same_family(const grain_family *f, const case_site *grain, double aspect)
{
    return fabs(f->aspect - aspect) < 1e-9 && strcmp(f->grain.shape, grain->shape) == 0 &&
           strcmp(f->grain.material, grain->material) == 0 && same_number(f->grain.bond_strength, grain->bond_strength);
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

static status sort_sites(grain_families *f)
{
    for (int i = 0; i < f->c->sites.n; i++) {
        const site_state *site = &f->flown->site[i];
        screen hit;
        f->of_site[i] = -1;
        if (!site->reached) continue;
        TRY(gouge_screen_impact(case_surface_of(f->c), site->velocity, &hit));
        if (hit.skip) {
            f->screened++;
            continue;
        }
        const case_site *grain = &f->c->sites.item[i]; /* a treatment may have changed it */
        f->of_site[i] = family_for(f, grain, grain->height / grain->radius);
        TRY(add_size(&f->family[f->of_site[i]].plan, grain->radius, 1.0));
    }
    return status_ok();
}

static status sort_populations(grain_families *f)
{
    const case_onset *c = f->c;
    screen hit;
    for (int i = 0; i < c->populations.n; i++) {
        const case_population *p = &c->populations.item[i];
        double size[SURFACE_MAX_SIZES], number[SURFACE_MAX_SIZES];
        case_site grain = { .position = NAN, .bond_strength = p->bond_strength };
        memcpy(grain.shape, p->shape, sizeof grain.shape);
        memcpy(grain.material, p->material, sizeof grain.material);
        const int n = study_population_sizes(p, c->study.smallest_radius, SURFACE_MAX_SIZES / 2, size, number);
        TRY(gouge_screen_impact(case_surface_of(c), gouge_trace_fastest(f->flown), &hit));
        f->of_population[i] = -1;
        f->screened += hit.skip;
        f->too_small += !hit.skip && n == 0;
        if (hit.skip || n == 0) continue;
        f->of_population[i] = family_for(f, &grain, p->aspect);
        for (int k = 0; k < n; k++) TRY(add_size(&f->family[f->of_population[i]].plan, size[k], number[k]));
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

static status plan_searches(grain_families *f)
{
    const case_study *y = &f->c->study;
    const bool by_growth = case_impact_is_gauged(&f->probe);
    const int craters = by_growth ? y->craters * f->n : 0;
    double sure;
    TRY(gouge_screen_velocity(case_surface_of(f->c), y->screen_low, &sure));
    CHECK(f->n + craters <= y->max_scenes, STATUS_BAD_INPUT,
          "study.max_scenes = %d: for %d kinds of grain, %d whole craters; allow more or make the grains alike",
          y->max_scenes, f->n, craters);
    for (int k = 0; k < f->n; k++) {
        surface_plan *p = &f->family[k].plan;
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
                                      .max_scenes = (y->max_scenes - craters) / f->n,
                                      .place = place_of,
                                      .place_user = f,
                                      .place_interval = y->position_interval * f->c->launcher.barrel.length };
    }
    return status_ok();
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
    return plan_searches(out);
}

const grain_family *study_family_alike(const grain_families *in, const grain_family *f)
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
