/* The searches of families: each runs on what is known and says what it wants; what it may want next is found by
 * guessing. */
#include "coupling/study/search/family.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PRESSURE_STEP = 5e6; /* [Pa] */

/* ---- one search on what is known ---- */

enum { TOGETHER = 2 }; /* scenes that a search asks for at a time */

/* Scenes that a search may come to ask for, with the guesses of its threshold under which it does. */
typedef struct {
    int n;
    struct {
        scene_query query;
        int guesses;
    } item[64];
} prospect;

/* A family's search as a function of outcomes: what it finds unknown stands in `wanted`. */
typedef struct {
    session *session;
    const grain_families *of;
    grain_family *family;
    int number;       /* of the family, from 1 */
    prospect *ahead;  /* NULL: an unknown outcome ends the round; else it is noted here, and guessed by */
    double threshold; /* [m/s] */
    int n;
    scene_query wanted[TOGETHER];
    bool has_promised; /* another that will be wanted whatever comes of the next */
    scene_query promised;
} asker;

static double contact_pressure_at(const grain_families *f, double v)
{
    const shot_outcome *flown = f->flown;
    const double given = f->c->scene.contact_pressure;
    trace_point at = flown->n_trace > 0 ? flown->trace[flown->n_trace - 1] : (trace_point){ .contact_pressure = 0.0 };
    if (!isnan(given)) return given;
    gouge_trace_at_velocity(flown, v, &at);
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
             gouge_is_gauged(c) ? "-growth" : "");
    return q;
}

static const scene_record *known(const grain_family *f, const scene_query *q)
{
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *k = &f->scene[i];
        if (k->radius == q->state.grain.radius && k->velocity == q->state.velocity && k->cells == q->cells_per_radius &&
            k->whole == !gouge_is_gauged(q->c))
            return k->record;
    }
    return NULL;
}

/* From the session, kept for the next round; NULL in *out: it is not known yet.  A guess takes nothing from the
 * session: what was computed ahead is nobody's until a search asks for it. */
static status find(asker *a, const scene_query *q, const scene_record **out)
{
    grain_family *f = a->family;
    *out = known(f, q);
    if (*out || a->ahead) return status_ok();
    TRY(run_scenes_find(a->session, q, out));
    if (*out && f->n_scenes < THRESHOLD_MAX_SAMPLES)
        f->scene[f->n_scenes++] = (family_scene){ q->state.grain.radius, q->state.velocity, q->cells_per_radius,
                                                  !gouge_is_gauged(q->c), *out };
    return status_ok();
}

static bool is_listed(const scene_query *list, int n, const scene_query *q)
{
    for (int i = 0; i < n; i++)
        if (strcmp(list[i].name, q->name) == 0) return true;
    return false;
}

static void want(asker *a, const scene_query *q)
{
    if (!is_listed(a->wanted, a->n, q) && a->n < TOGETHER) a->wanted[a->n++] = *q;
}

static void note(prospect *p, const scene_query *q)
{
    int i = 0;
    while (i < p->n && strcmp(p->item[i].query.name, q->name) != 0) i++;
    if (i == (int)(sizeof p->item / sizeof *p->item)) return;
    if (i == p->n) {
        p->item[i].query = *q;
        p->item[i].guesses = 0;
        p->n++;
    }
    p->item[i].guesses++;
}

static double excess_of(const breech_case *c, const onset_scene *e)
{
    const scene_result *r = &e->result;
    return e->gauged ? gouge_growth_folds(r->groove_growth, e->radius, e->velocity)
                     : r->severity - c->scene.limit_severity;
}

/* Linear, an e-fold in 100 m/s. */
static threshold_sample guess(const asker *a, double velocity)
{
    const double excess = 0.01 * (velocity - a->threshold);
    return (threshold_sample){ .excess = excess, .class = excess >= 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH };
}

static status outcome_at(void *user, double radius, double velocity, double cells, threshold_sample *out)
{
    asker *a = user;
    const scene_query q = query_of(a, false, radius, velocity, cells);
    const scene_record *record;
    TRY(find(a, &q, &record));
    if (record) {
        *out = (threshold_sample){ .excess = excess_of(a->of->c, &record->entry), .class = record->entry.result.class };
        return status_ok();
    }
    if (a->ahead) {
        note(a->ahead, &q);
        *out = guess(a, velocity);
        return status_ok();
    }
    want(a, &q);
    if (a->has_promised) want(a, &a->promised);
    return base_status_error(STATUS_STOPPED, "a scene is wanted"); /* ends this round of the search */
}

static void together(void *user, double radius, double velocity, double cells)
{
    asker *a = user;
    const scene_record *record;
    a->promised = query_of(a, false, radius, velocity, cells);
    a->has_promised = !a->ahead && find(a, &a->promised, &record).code == STATUS_OK && !record;
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
            v = fmax(v, study_flown_fastest(f->flown));
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

/* The scene of the search nearest to the middle of the velocities that gouge for sure; of none in their inner two
 * thirds, the middle; where no grain is fast enough for sure, the slowest that gouges. */
static double middle_gouge(const surface_plan *p, const surface_result *s, int k, double fastest)
{
    const double step = p->search.step, low = s->size[k].interval[1], middle = 0.5 * (low + fastest);
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
static status round_of_craters(asker *a, const surface_result *s)
{
    const surface_plan *p = &a->family->plan;
    const double fastest = fastest_grain(a->of, a->family);
    const int k = size_of_craters(p, s, fastest);
    if (!a->family->by_growth || k < 0) return status_ok();
    const double top = on_grid_below(&p->search, p->search.high);
    const double slower = fmin(middle_gouge(p, s, k, on_grid_below(&p->search, fastest)), top);
    const double at[2] = { slower, fmax(slower, on_grid_below(&p->search, fastest)) };
    for (int i = 0; i < a->of->c->study.craters; i++) {
        const scene_query q = query_of(a, true, p->size[k], at[i], s->reference.cells);
        const scene_record *record;
        TRY(find(a, &q, &record));
        if (record) continue;
        if (a->ahead)
            note(a->ahead, &q);
        else
            want(a, &q);
    }
    return status_ok();
}

/* a->n > 0: the search cannot go on without one of a->wanted. */
static status round_of(asker *a, surface_result *out)
{
    const surface_source source = { outcome_at, together, a };
    a->n = 0;
    a->has_promised = false;
    const status done = study_surface_search(&a->family->plan, &source, out);
    if (a->n > 0) return status_ok();
    TRY(done);
    return round_of_craters(a, out);
}

/* ---- all searches ---- */

enum { MAX_QUERIES = 256 };

typedef struct {
    int n, n_next;
    bool level; /* nothing hangs on `query`: all in the order of `next` */
    scene_query query[MAX_QUERIES], next[MAX_QUERIES];
    prospect ahead;
    surface_result scratch;
} requests;

/* The search run to its end with the threshold on both sides of its wanted scenes and at the ends of the range: what it
 * asks for then.  *guesses: how many there were. */
static status guess_on(const asker *now, requests *r, int *guesses)
{
    const threshold_plan *p = &now->family->plan.search;
    double threshold[2 * TOGETHER + 2] = { p->low, p->high };
    *guesses = 2;
    r->ahead.n = 0;
    for (int i = 0; i < now->n; i++)
        for (int side = -1; side <= 1; side += 2)
            threshold[(*guesses)++] = now->wanted[i].state.velocity + 0.5 * side * p->step;
    for (int i = 0; i < *guesses; i++) {
        asker a = *now;
        a.ahead = &r->ahead;
        a.threshold = threshold[i];
        TRY(round_of(&a, &r->scratch));
    }
    return status_ok();
}

static bool is_longer(const scene_query *a, const scene_query *b)
{
    const bool whole[2] = { !gouge_is_gauged(a->c), !gouge_is_gauged(b->c) };
    return whole[0] != whole[1] ? whole[0] : a->cells_per_radius > b->cells_per_radius;
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

/* What the search will ask for after its wanted scenes, first what it asks for in every case, nothing that it asks for
 * in less than two cases of three: lent to a wanted scene, the threads are worth 0.6 of themselves.  Where that is all,
 * nothing hangs on the wanted ones, and they stand among the others: the longest first. */
static status look_ahead(const asker *now, requests *r)
{
    const prospect *p = &r->ahead;
    scene_query *list = r->next + r->n_next;
    int guesses, certain = 0, n = 0;
    TRY(guess_on(now, r, &guesses));
    for (int i = 0; i < p->n; i++) certain += p->item[i].guesses == guesses;
    const bool level = certain == p->n;
    for (int least = guesses; 3 * least >= 2 * guesses; least--)
        for (int i = 0; i < p->n && r->n_next + n < MAX_QUERIES; i++)
            if (p->item[i].guesses == least && (level || !is_listed(now->wanted, now->n, &p->item[i].query)))
                list[n++] = p->item[i].query;
    if (level) sort_longest_first(list, n);
    r->n_next += n;
    r->level = r->level && level;
    return status_ok();
}

static status gather(session *s, grain_families *const *f, int n, requests *r)
{
    r->n = r->n_next = 0;
    r->level = true;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < f[i]->n && r->n + TOGETHER <= MAX_QUERIES; k++) {
            asker a = { .session = s, .of = f[i], .family = &f[i]->family[k], .number = k + 1 };
            TRY(round_of(&a, &f[i]->family[k].surface));
            for (int q = 0; q < a.n; q++) r->query[r->n++] = a.wanted[q];
            if (s->crew && a.n > 0) TRY(look_ahead(&a, r));
        }
    return status_ok();
}

static status search(session *s, grain_families *const *f, int n, requests *r)
{
    do {
        TRY(gather(s, f, n, r));
        TRY(run_scenes_ahead(s, r->next, r->n_next, r->level));
        TRY(run_scenes_some(s, r->query, r->n));
    } while (r->n > 0);
    return status_ok();
}

status study_families_search(session *s, grain_families *const *f, int n)
{
    requests *r = malloc(sizeof *r);
    CHECK(r, STATUS_MEMORY, "no memory for the searches of %d surfaces", n);
    const status done = search(s, f, n, r);
    free(r);
    return done;
}
