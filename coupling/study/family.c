#include "coupling/study/family.h"

#include "coupling/handoff/screen.h"
#include "coupling/study/population.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PRESSURE_STEP = 5e6; /* [Pa] */
enum { CRATERS = 2 };                    /* whole scenes of a family that gouges, study.judge growth */

void families_free(grain_families *f)
{
    free(f->family);
    free(f->of_site);
    free(f->of_population);
    free(f->probe);
    free(f->whole);
    memset(f, 0, sizeof *f);
}

double flown_place(const shot_outcome *flown, double barrel, double v)
{
    trace_point at;
    return trace_at_velocity(flown, v, &at) ? at.x : barrel;
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
        TRY(screen_impact(f->c, site->velocity, &hit));
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

static double fastest(const shot_outcome *flown)
{
    double v = 0.0;
    for (int i = 0; i < flown->n_trace; i++) v = fmax(v, flown->trace[i].v);
    return v;
}

static status sort_populations(grain_families *f)
{
    const breech_case *c = f->c;
    screen hit;
    for (int i = 0; i < c->populations.n; i++) {
        const case_population *p = &c->populations.item[i];
        double size[SURFACE_MAX_SIZES], number[SURFACE_MAX_SIZES];
        case_site grain = { .position = NAN, .bond_strength = p->bond_strength };
        memcpy(grain.shape, p->shape, sizeof grain.shape);
        memcpy(grain.material, p->material, sizeof grain.material);
        const int n = population_sizes(p, c->study.smallest_radius, SURFACE_MAX_SIZES / 2, size, number);
        TRY(screen_impact(c, fastest(f->flown), &hit));
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
    return flown_place(f->flown, f->c->barrel.length, v);
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
    const bool by_growth = scene_is_gauged(f->probe);
    const int craters = by_growth ? CRATERS * f->n : 0;
    double sure;
    TRY(screen_velocity(f->c, y->screen_low, &sure));
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
                                      .step = threshold_step(y->velocity_interval),
                                      .coarse = y->coarse_cells_per_radius,
                                      .fine = y->fine_cells_per_radius,
                                      .max_scenes = (y->max_scenes - craters) / f->n,
                                      .place = place_of,
                                      .place_user = f,
                                      .place_interval = y->position_interval * f->c->barrel.length };
    }
    return status_ok();
}

void family_probe(const breech_case *c, breech_case *out)
{
    *out = *c;
    out->scene.stop_when_gauged = c->study.judge == JUDGE_GROWTH;
    if (scene_is_gauged(out)) out->output.snapshots = 0;
}

static status make_cases(grain_families *f)
{
    f->probe = malloc(sizeof *f->probe);
    f->whole = malloc(sizeof *f->whole);
    CHECK(f->probe && f->whole, STATUS_MEMORY, "no memory for two cases");
    family_probe(f->c, f->probe);
    *f->whole = *f->c;
    f->whole->scene.stop_when_gauged = false;
    return status_ok();
}

status families_sort(const breech_case *c, const shot_outcome *flown, const char *prefix, grain_families *out)
{
    const size_t sites = (size_t)c->sites.n, populations = (size_t)c->populations.n;
    *out = (grain_families){ .c = c, .flown = flown, .prefix = prefix };
    out->family = calloc(sites + populations + 1, sizeof *out->family);
    out->of_site = calloc(sites + 1, sizeof *out->of_site);
    out->of_population = calloc(populations + 1, sizeof *out->of_population);
    CHECK(out->family && out->of_site && out->of_population, STATUS_MEMORY, "no memory for %zu sites", sites);
    TRY(make_cases(out));
    TRY(sort_sites(out));
    TRY(sort_populations(out));
    return plan_searches(out);
}

/* ---- one search on what is known ---- */

/* A family's search as a function of outcomes: what it finds unknown stands in `wanted`. */
typedef struct {
    session *session;
    const grain_families *of;
    grain_family *family;
    int number;                   /* of the family, from 1 */
    const threshold_sample *sure; /* an outcome to suppose where there is none yet; NULL: none */
    bool wanting, supposed;
    scene_query wanted;
} asker;

static double contact_pressure_at(const grain_families *f, double v)
{
    const shot_outcome *flown = f->flown;
    const double given = f->c->scene.contact_pressure;
    trace_point at = flown->n_trace > 0 ? flown->trace[flown->n_trace - 1] : (trace_point){ .contact_pressure = 0.0 };
    if (!isnan(given)) return given;
    trace_at_velocity(flown, v, &at);
    return PRESSURE_STEP * round(at.contact_pressure / PRESSURE_STEP);
}

static scene_query query_of(const asker *a, bool whole, double radius, double velocity, double cells)
{
    const breech_case *c = whole ? a->of->whole : a->of->probe;
    scene_query q = { .c = c, .cells_per_radius = cells };
    q.state = (site_state){ .grain = a->family->grain,
                            .reached = true,
                            .velocity = velocity,
                            .contact_pressure = contact_pressure_at(a->of, velocity),
                            .rail_temperature = c->rail.temperature,
                            .armature_temperature = c->projectile.temperature };
    q.state.grain.radius = radius;
    q.state.grain.height = a->family->aspect * radius;
    char size[32] = "";
    if (a->family->plan.sizes > 1) snprintf(size, sizeof size, "-r%.6g", 1e3 * radius);
    snprintf(q.name, sizeof q.name, "%.40sg%d%s-v%g-c%g%s", a->of->prefix, a->number, size, velocity, cells,
             scene_is_gauged(c) ? "-growth" : "");
    return q;
}

static const scene_record *known(const grain_family *f, const scene_query *q)
{
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *k = &f->scene[i];
        if (k->radius == q->state.grain.radius && k->velocity == q->state.velocity && k->cells == q->cells_per_radius &&
            k->whole == !scene_is_gauged(q->c))
            return k->record;
    }
    return NULL;
}

/* From the session, kept for the next round; NULL in *out: it is not known yet. */
static status find(asker *a, const scene_query *q, const scene_record **out)
{
    grain_family *f = a->family;
    *out = known(f, q);
    if (*out) return status_ok();
    TRY(scenes_find(a->session, q, out));
    if (*out && f->n_scenes < THRESHOLD_MAX_SAMPLES)
        f->scene[f->n_scenes++] = (family_scene){ q->state.grain.radius, q->state.velocity, q->cells_per_radius,
                                                  !scene_is_gauged(q->c), *out };
    return status_ok();
}

static double excess_of(const breech_case *c, const onset_scene *e)
{
    const scene_result *r = &e->result;
    return e->gauged ? growth_folds(r->groove_growth, e->radius, e->velocity) : r->severity - c->scene.limit_severity;
}

static status outcome_at(void *user, double radius, double velocity, double cells, threshold_sample *out)
{
    asker *a = user;
    const scene_query q = query_of(a, false, radius, velocity, cells);
    const scene_record *record;
    TRY(find(a, &q, &record));
    if (!record && a->sure && !a->supposed) {
        *out = *a->sure;
        a->supposed = true;
        return status_ok();
    }
    if (!record) {
        a->wanting = true;
        a->wanted = q;
        return status_error(STATUS_STOPPED, "a scene is wanted"); /* ends this round of the search */
    }
    *out = (threshold_sample){ .excess = excess_of(a->of->c, &record->entry), .class = record->entry.result.class };
    return status_ok();
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
        if (f->of_population[i] >= 0 && &f->family[f->of_population[i]] == family) v = fmax(v, fastest(f->flown));
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

/* Once the thresholds are known: the whole craters where gouging begins and at the fastest grain. */
static status round_of_craters(asker *a, const surface_result *s)
{
    const surface_plan *p = &a->family->plan;
    const double step = p->search.step, fastest = fastest_grain(a->of, a->family);
    const int k = size_of_craters(p, s, fastest);
    if (!a->family->by_growth || k < 0) return status_ok();
    const double from = k == p->reference ? s->reference.bracket[1] : step * ceil(s->size[k].interval[1] / step);
    const double lowest = fmin(from, on_grid_below(&p->search, p->search.high));
    const double at[CRATERS] = { lowest, fmax(lowest, on_grid_below(&p->search, fastest)) };
    for (int i = 0; i < CRATERS && !a->wanting; i++) {
        const scene_record *record;
        a->wanted = query_of(a, true, p->size[k], at[i], s->reference.cells);
        TRY(find(a, &a->wanted, &record));
        if (!record && a->sure && !a->supposed)
            a->supposed = true;
        else
            a->wanting = !record;
    }
    return status_ok();
}

/* a->wanting: the search cannot go on without a->wanted. */
static status round_of(asker *a, surface_result *out)
{
    const surface_source source = { outcome_at, a };
    a->wanting = a->supposed = false;
    const status done = surface_search(&a->family->plan, &source, out);
    if (a->wanting) return status_ok();
    TRY(done);
    return round_of_craters(a, out);
}

/* ---- all searches ---- */

enum { MAX_QUERIES = 256 };

typedef struct {
    int n, ahead;
    scene_query query[MAX_QUERIES], next[2 * MAX_QUERIES];
} requests;

/* What the search would ask for after its wanted scene, should that gouge or not. */
static status look_ahead(const asker *now, surface_result *scratch, requests *r)
{
    const threshold_sample outcome[2] = { { .excess = 1.0, .class = DAMAGE_GOUGE },
                                          { .excess = -1.0, .class = DAMAGE_SCRATCH } };
    for (int k = 0; k < 2 && r->ahead < 2 * MAX_QUERIES; k++) {
        asker a = *now;
        a.sure = &outcome[k];
        TRY(round_of(&a, scratch));
        if (a.wanting) r->next[r->ahead++] = a.wanted;
    }
    return status_ok();
}

static status gather(session *s, grain_families *const *f, int n, surface_result *scratch, requests *r)
{
    r->n = r->ahead = 0;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < f[i]->n && r->n < MAX_QUERIES; k++) {
            asker a = { .session = s, .of = f[i], .family = &f[i]->family[k], .number = k + 1 };
            TRY(round_of(&a, &f[i]->family[k].surface));
            if (!a.wanting) continue;
            r->query[r->n++] = a.wanted;
            TRY(look_ahead(&a, scratch, r));
        }
    return status_ok();
}

static status search(session *s, grain_families *const *f, int n, surface_result *scratch, requests *r)
{
    do {
        TRY(gather(s, f, n, scratch, r));
        TRY(scenes_ahead(s, r->next, r->ahead));
        TRY(scenes_some(s, r->query, r->n));
    } while (r->n > 0);
    return status_ok();
}

status families_search(session *s, grain_families *const *f, int n)
{
    requests *r = malloc(sizeof *r);
    surface_result *scratch = malloc(sizeof *scratch);
    const status done = r && scratch ? search(s, f, n, scratch, r)
                                     : status_error(STATUS_MEMORY, "no memory for the searches of %d surfaces", n);
    free(r);
    free(scratch);
    return done;
}

bool family_searched(const grain_family *f, const family_scene *scene)
{
    return !(f->by_growth && scene->whole);
}

const family_scene *family_nearest(const grain_family *f, double radius, double velocity)
{
    const family_scene *best = NULL;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (!family_searched(f, a)) continue;
        if (!best) best = a;
        const double far = fabs(log(a->radius / radius)), best_far = fabs(log(best->radius / radius));
        const bool nearer = fabs(a->velocity - velocity) < fabs(best->velocity - velocity);
        if (a->cells != best->cells ? a->cells > best->cells : far != best_far ? far < best_far : nearer) best = a;
    }
    return best;
}
