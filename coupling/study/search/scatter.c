#include "coupling/study/search/scatter.h"

#include "coupling/study/sampling/shifts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEAD = -2.999; /* growth of a groove that died before its first gauge, or less [e-folds] */

static const double NEAR = 0.3; /* of the threshold: scenes so near it make the slope */

/* Of the search at the reference size, at the cells of its answer. */
static bool counts(const grain_family *f, const family_scene *scene)
{
    return study_family_searched(f, scene) && scene->radius == f->plan.size[f->plan.reference] &&
           scene->cells == f->surface.reference.cells;
}

/* The scene nearest to the threshold; NULL: there is no threshold. */
static const family_scene *nearest(const grain_family *f)
{
    const double threshold = f->surface.reference.velocity;
    const family_scene *best = NULL;
    for (int i = 0; f->by_growth && !isnan(threshold) && i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (counts(f, a) && (!best || fabs(a->velocity - threshold) < fabs(best->velocity - threshold))) best = a;
    }
    return best;
}

/* Of the growth over velocity, the least squares of the grooves that lived, so far from the threshold at most [m/s];
 * NAN: it does not rise, or there are fewer than two [1/(m/s)]. */
static double slope_within(const case_onset *c, const grain_family *f, double far)
{
    double n = 0, v = 0, g = 0, vv = 0, vg = 0;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        const double off = a->velocity - f->surface.reference.velocity;
        const double growth = study_family_excess(c, &a->record->entry);
        if (!counts(f, a) || growth < DEAD || fabs(off) > far) continue;
        n++, v += off, g += growth, vv += off * off, vg += off * growth;
    }
    const double spread = n * vv - v * v, b = (n * vg - v * g) / spread;
    return n > 1 && spread > 0 && b > 0 ? b : NAN;
}

/* Near the threshold, where growth is nearly a straight line in velocity; where the search has too few scenes there, by
 * all of them. */
static double slope(const case_onset *c, const grain_family *f)
{
    const double near = slope_within(c, f, NEAR * f->surface.reference.velocity);
    return isnan(near) ? slope_within(c, f, INFINITY) : near;
}

/* The scene on the i-th grid. */
static scene_query query_of(const grain_families *g, int family, const family_scene *near, int i)
{
    scene_query q = study_family_query(g, family, near);
    double *shift = q.impact.scene.grid_shift;
    const size_t used = strlen(q.name);
    study_shift_of(i, g->c->impact.scene.grid_shift, shift);
    snprintf(q.name + used, sizeof q.name - used, "-e%d", i + 1);
    return q;
}

static status conclude(session *s, const grain_families *g, grain_family *f, const family_scene *near,
                       const scene_record *const *record, double *growth)
{
    const int n = g->c->study.threshold_ensemble;
    growth[0] = study_family_excess(g->c, &near->record->entry);
    for (int i = 1; i < n; i++) growth[i] = study_family_excess(g->c, &record[i - 1]->entry);
    f->scatter.growth = study_shift_spread(growth, n).deviation;
    f->scatter.threshold = f->scatter.growth / slope(g->c, f);
    if (isnan(f->scatter.threshold))
        run_session_warn(s,
                         "%sgrowth scatters by %.2g e-folds with the place of the grid at %g m/s, but does not rise "
                         "with velocity in the search's scenes: the threshold's interval does not hold that",
                         g->prefix, f->scatter.growth, near->velocity);
    return status_ok();
}

static status measure(session *s, grain_families *g, scene_query *query, const scene_record **record, double *growth)
{
    const int more = g->c->study.threshold_ensemble - 1;
    int n = 0;
    for (int k = 0; k < g->n; k++) {
        const family_scene *near = nearest(&g->family[k]);
        for (int i = 0; near && i < more; i++) query[n++] = query_of(g, k, near, i + 1);
    }
    TRY(run_scenes_all(s, query, n, record));
    for (int k = 0, at = 0; k < g->n; k++) {
        const family_scene *near = nearest(&g->family[k]);
        if (!near) continue;
        TRY(conclude(s, g, &g->family[k], near, record + at, growth));
        at += more;
    }
    return status_ok();
}

status study_scatter_run(session *s, grain_families *grains)
{
    const size_t scenes = (size_t)grains->c->study.threshold_ensemble, all = scenes * (size_t)grains->n;
    if (all == 0) return status_ok();
    scene_query *query = malloc(all * sizeof *query);
    const scene_record **record = malloc(all * sizeof *record);
    double *growth = malloc(scenes * sizeof *growth);
    const status done = query && record && growth
                            ? measure(s, grains, query, record, growth)
                            : base_status_error(STATUS_MEMORY, "no memory for %zu scenes on shifted grids", all);
    free(growth);
    free(record);
    free(query);
    return done;
}
