/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/search/scatter.h"

#include "coupling/study/sampling/shifts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEAD = -2.999; /* growth of a groove that died before its first gauge, or less [e-folds] */

static const double NEAR = 0.3; /* of the threshold: scenes so near it make the slope */

/* One threshold of a family, and the search's scenes that are computed on further grids. */
typedef struct {
    grain_family *of;
    int number; /* of the family, from 0 */
    family_judge judge;
    const family_scene *near;          /* the scene nearest to it; NULL: there is no threshold */
    const scene_record *const *record; /* of that scene on the further grids, or of all of the search; borrowed */
} sought;

static const threshold_result *answer_of(const sought *t)
{
    return &study_family_surface(t->of, t->judge)->reference;
}

/* Of the search at the reference size, at the cells of its answer. */
static bool counts(const sought *t, const family_scene *scene)
{
    const grain_family *f = t->of;
    return study_family_searched(f, scene) && scene->radius == f->plan.size[f->plan.reference] &&
           scene->cells == answer_of(t)->cells;
}

static const family_scene *nearest(const sought *t)
{
    const grain_family *f = t->of;
    const double threshold = answer_of(t)->velocity;
    const family_scene *best = NULL;
    for (int i = 0; f->by_growth && !isnan(threshold) && i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (counts(t, a) && (!best || fabs(a->velocity - threshold) < fabs(best->velocity - threshold))) best = a;
    }
    return best;
}

/* Has the search looked at one side alone, up to the end of its range? */
static bool is_one_sided(const sought *t)
{
    const threshold_outcome found = answer_of(t)->outcome;
    return t->of->by_growth && (found == THRESHOLD_ABOVE || found == THRESHOLD_BELOW);
}

/* The two numbers that decide on a gouge, each above zero where it speaks for one: growth in e-folds, and the shape. */
typedef double (*number_of)(const case_onset *c, const onset_scene *e);

static double growth_of(const case_onset *c, const onset_scene *e)
{
    return study_family_sample(c, JUDGE_OF_SCRATCH, e).excess;
}

/* As in gouge_tear_drop_excess; INFINITY: it has none that counts. */
static double shape_of(const case_onset *c, const onset_scene *e)
{
    return log(c->impact.scene.limit_length_over_width / e->result.length_over_width);
}

/* Of one of them over velocity, the least squares of the grooves that lived, so far from the threshold at most [m/s];
 * NAN: it does not rise, or there are fewer than two [1/(m/s)]. */
static double slope_within(const case_onset *c, const sought *t, number_of number, double far)
{
    const grain_family *f = t->of;
    double n = 0, v = 0, g = 0, vv = 0, vg = 0;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        const double off = a->velocity - answer_of(t)->velocity;
        const onset_scene *e = &a->record->entry;
        const double here = number(c, e);
        if (!counts(t, a) || growth_of(c, e) < DEAD || !isfinite(here) || fabs(off) > far) continue;
        n++, v += off, g += here, vv += off * off, vg += off * here;
    }
    const double spread = n * vv - v * v, b = (n * vg - v * g) / spread;
    return n > 1 && spread > 0 && b > 0 ? b : NAN;
}

/* Near the threshold, where growth is nearly a straight line in velocity; where the search has too few scenes there, by
 * all of them. */
static double slope(const case_onset *c, const sought *t, number_of number)
{
    const double near = slope_within(c, t, number, NEAR * answer_of(t)->velocity);
    return isnan(near) ? slope_within(c, t, number, INFINITY) : near;
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

/* Over velocity: of the growth where grooves begin to grow, of the shape where they become tear-drops [1/(m/s)]. */
typedef struct {
    double growth, shape;
} slopes;

static slopes slopes_of(const case_onset *c, const sought *t)
{
    const sought scratch = { .of = t->of, .number = t->number, .judge = JUDGE_OF_SCRATCH };
    const bool known = t->of->scratch && !isnan(answer_of(&scratch)->velocity);
    return (slopes){ slope(c, known ? &scratch : t, growth_of), slope(c, t, shape_of) };
}

/* The nearest scene on the i-th grid. */
static const onset_scene *on_grid(const sought *t, int i)
{
    return &(i ? t->record[i - 1] : t->near->record)->entry;
}

/* How far above the scene's velocity growth passes zero on its grid: on the line to the scene of the family's other
 * threshold on the same grid, if it passes zero between the two; else by the slope, which makes far too much of a
 * groove that dies, since growth falls much steeper below zero than it rises above [m/s]. */
static double zero_off(const case_onset *c, const sought *t, const sought *other, double slope_of_growth, int i)
{
    const double here = growth_of(c, on_grid(t, i));
    if (other && other->near) {
        const double way = other->near->velocity - t->near->velocity, more = growth_of(c, on_grid(other, i)) - here;
        if (here * (here + more) < 0 && more * way > 0) return -here * way / more;
    }
    return -here / slope_of_growth;
}

/* How far above the scene's velocity the threshold of the i-th grid lies, by growth and shape and their own slopes: a
 * gouge needs both, so the later one counts.  Where tear-drops begin growth has levelled off: one slope for the smaller
 * of both would put a groove that dies there off by half the range [m/s]. */
static double threshold_off(const case_onset *c, const sought *t, const sought *other, slopes b, int i)
{
    const double growth = zero_off(c, t, other, b.growth, i), shape = shape_of(c, on_grid(t, i));
    if (t->judge == JUDGE_OF_SCRATCH || isinf(shape)) return growth;
    if (isnan(b.growth)) return NAN;
    /* craters do not become shorter with velocity: where they are short enough growth alone decides */
    if (isnan(b.shape)) return shape <= 0 ? NAN : growth;
    return fmax(growth, -shape / b.shape);
}

/* The search's nearest scene on one side of the threshold that would decide alike on any grid: it lies further from
 * zero than the scatter.  Its distance; to the end of the range where there is none [m/s]. */
static double decided_off(const case_onset *c, const sought *t, double scatter, bool above)
{
    const double threshold = answer_of(t)->velocity;
    double off = above ? c->study.velocity_high - threshold : threshold - c->study.velocity_low;
    for (int i = 0; i < t->of->n_scenes; i++) {
        const family_scene *a = &t->of->scene[i];
        const double way = above ? a->velocity - threshold : threshold - a->velocity;
        const double excess = study_family_sample(c, t->judge, &a->record->entry).excess;
        if (counts(t, a) && way >= 0 && (above ? excess : -excess) > scatter) off = fmin(off, way);
    }
    return fmax(off, 0);
}

/* How far from the threshold a scene lies on either side that decides alike on any grid [m/s]. */
static double reach_of(const case_onset *c, const sought *t, double scatter)
{
    return fmax(decided_off(c, t, scatter, false), decided_off(c, t, scatter, true));
}

/* value: room for as many numbers as there are grids.  other: the family's other threshold; NULL: it has none.
 * A slope that is hardly above zero makes a groove's scatter into a deviation of any size; it cannot exceed the reach,
 * within which all grids have decided. */
static void conclude(session *s, const grain_families *g, const sought *t, const sought *other, double *value)
{
    const int n = g->c->study.threshold_ensemble;
    const slopes b = slopes_of(g->c, t);
    family_scatter *out = study_family_scatter(t->of, t->judge);
    for (int i = 0; i < n; i++) value[i] = study_family_sample(g->c, t->judge, on_grid(t, i)).excess;
    out->excess = study_shift_spread(value, n).deviation;
    for (int i = 0; i < n; i++) value[i] = threshold_off(g->c, t, other, b, i);
    bool known = true;
    for (int i = 0; i < n; i++) known = known && isfinite(value[i]);
    const double reach = reach_of(g->c, t, out->excess);
    const shift_spread places = study_shift_spread(value, n);
    out->threshold = known && places.deviation <= reach ? places.deviation : NAN;
    out->reach = isnan(out->threshold) ? reach : out->threshold;
    out->more = isnan(out->threshold) ? 0 : places.mean - value[0];
    if (!isnan(out->threshold)) return;
    run_session_warn(s,
                     "%swhat decides on a %s scatters by %.2g with the place of the grid at %g m/s, and hardly rises "
                     "with velocity in the search's scenes: the interval is wider by %.0f m/s, as far as scenes that "
                     "decide in spite of it",
                     g->surface, t->judge == JUDGE_OF_GOUGE ? "gouge" : "scratch", out->excess, t->near->velocity,
                     out->reach);
}

/* ---- where there is no threshold ---- */

/* Does the scene decide on the side on which the search saw all of its scenes? */
static bool agrees(const case_onset *c, const sought *t, const onset_scene *e)
{
    const threshold_sample is = study_family_sample(c, t->judge, e);
    const bool upper = answer_of(t)->outcome == THRESHOLD_BELOW;
    return is.class != DAMAGE_UNDECIDED && study_threshold_is_upper(&is) == upper;
}

/* Of the scenes that count, the nearest to the unknown threshold up to which all agree on all grids; NAN: the first one
 * does not.  Sets the nearest that does not, NAN: all agree [m/s]. */
static double agreed_to(const case_onset *c, const sought *t, double *against)
{
    const double up = answer_of(t)->outcome == THRESHOLD_ABOVE ? 1 : -1;
    const int more = c->study.threshold_ensemble - 1;
    double first = INFINITY, last = -INFINITY; /* on the way to the threshold */
    int n = 0;
    for (int i = 0; i < t->of->n_scenes; i++) {
        const family_scene *a = &t->of->scene[i];
        if (!counts(t, a)) continue;
        for (int k = 0; k < more; k++)
            if (!agrees(c, t, &t->record[n + k]->entry)) first = fmin(first, up * a->velocity);
        n += more;
    }
    for (int i = 0; i < t->of->n_scenes; i++) {
        const double way = up * t->of->scene[i].velocity;
        if (counts(t, &t->of->scene[i]) && way < first) last = fmax(last, way);
    }
    *against = isinf(first) ? NAN : up * first;
    return isinf(last) ? NAN : up * last;
}

/* The known end of a threshold's interval, as far as the grids agree: all sizes' with it, and what is allowed for the
 * resolution there.  NAN: nothing is known. */
static void move_end(surface_result *s, int side, double factor)
{
    s->reference.interval[side] *= factor;
    for (int k = 0; k < 2 && !isnan(factor); k++)
        s->reference.allowance[k] *= factor, s->reference.of_cells[k] *= factor;
    for (int k = 0; k < s->sizes; k++) s->size[k].interval[side] *= factor;
}

static void conclude_one_sided(session *s, const grain_families *g, const sought *t)
{
    static const char *const said[FAMILY_JUDGES][2] = { { "leave no gouge", "leave gouges" },
                                                        { "leave grooves that die", "leave grooves that grow" } };
    surface_result *of = study_family_surface(t->of, t->judge);
    const int side = of->reference.outcome == THRESHOLD_ABOVE ? 0 : 1;
    double against;
    const double to = agreed_to(g->c, t, &against);
    if (isnan(against)) return;
    study_family_scatter(t->of, t->judge)->against = against;
    move_end(of, side, to / of->reference.bracket[side]);
    run_session_warn(s,
                     "%sall scenes of the search %s, but on a shifted grid that at %g m/s does not decide so: the "
                     "interval ends before it; more cells a radius would lessen what the place of the cells decides",
                     g->surface, said[t->judge][side], against);
}

/* ---- all of them ---- */

/* All thresholds of all families; how many. */
static int list_sought(grain_families *g, sought *out)
{
    int n = 0;
    for (int k = 0; k < g->n; k++)
        for (int j = 0; j < FAMILY_JUDGES; j++)
            if (j == JUDGE_OF_GOUGE || g->family[k].scratch)
                out[n++] = (sought){ .of = &g->family[k], .number = k, .judge = (family_judge)j };
    return n;
}

static const sought *other_of(const sought *list, int n, const sought *t)
{
    for (int k = 0; k < n; k++)
        if (list[k].of == t->of && list[k].judge != t->judge) return &list[k];
    return NULL;
}

/* The scenes of one threshold on further grids; how many. */
static int ask_for(const grain_families *g, const sought *t, scene_query *out)
{
    const int more = g->c->study.threshold_ensemble - 1;
    int n = 0;
    for (int i = 0; i < t->of->n_scenes; i++) {
        const family_scene *a = &t->of->scene[i];
        if (a != t->near && !(is_one_sided(t) && counts(t, a))) continue;
        for (int k = 0; k < more; k++) out[n++] = query_of(g, t->number, a, k + 1);
    }
    return n;
}

static status measure(session *s, grain_families *g, scene_query *query, const scene_record **record, double *value,
                      sought *list)
{
    const int thresholds = list_sought(g, list);
    int n = 0;
    for (int k = 0; k < thresholds; k++) {
        list[k].near = nearest(&list[k]), list[k].record = record + n;
        n += ask_for(g, &list[k], query + n);
    }
    TRY(run_scenes_all(s, query, n, record));
    for (int k = 0; k < thresholds; k++) {
        if (list[k].near) conclude(s, g, &list[k], other_of(list, thresholds, &list[k]), value);
        if (is_one_sided(&list[k])) conclude_one_sided(s, g, &list[k]);
    }
    return status_ok();
}

/* No more scenes than this on further grids, for all thresholds together. */
static size_t most_scenes(const grain_families *g)
{
    size_t all = 0;
    for (int k = 0; k < g->n; k++) all += (size_t)(g->family[k].n_scenes * FAMILY_JUDGES);
    return all * (size_t)g->c->study.threshold_ensemble;
}

status study_scatter_run(session *s, grain_families *grains)
{
    const size_t scenes = (size_t)grains->c->study.threshold_ensemble, thresholds = (size_t)(FAMILY_JUDGES * grains->n),
                 all = most_scenes(grains);
    if (all == 0) return status_ok();
    scene_query *query = calloc(all, sizeof *query);
    const scene_record **record = malloc(all * sizeof *record);
    double *value = malloc(scenes * sizeof *value);
    sought *list = malloc(thresholds * sizeof *list);
    const status done = query && record && value && list
                            ? measure(s, grains, query, record, value, list)
                            : base_status_error(STATUS_MEMORY, "no memory for %zu scenes on shifted grids", all);
    free(list);
    free(value);
    free(record);
    free(query);
    return done;
}
