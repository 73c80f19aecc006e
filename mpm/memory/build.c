/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene's bodies as material points: each body has a lattice of its own, aligned with its faces, as fine as the grid
 * is at the place; later bodies take the points they claim from earlier ones. */
#include "mpm/memory/build.h"
#include "mpm/wave.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int n;
    double *edge; /* n + 1 lattice planes [m], owned */
} ladder;

/* Planes from lo to hi, spaced like the grid over `per_cell`, then scaled to end on hi. */
static status ladder_make(const axis *a, double lo, double hi, int per_cell, ladder *out)
{
    int n = 0;
    for (double x = lo; x < hi * (1 + 1e-12) - 1e-12 && n < 1000000; n++)
        x += mpm_axis_spacing(a, x + 1e-9 * (hi - lo)) / per_cell;
    out->edge = malloc(((size_t)n + 2) * sizeof(double));
    CHECK(out->edge, STATUS_MEMORY, "no memory for a lattice of %d planes", n);
    double x = lo;
    int k = 0;
    out->edge[0] = lo;
    while (x < hi - 1e-6 * mpm_axis_spacing(a, x)) {
        x += mpm_axis_spacing(a, x + 1e-9 * (hi - lo)) / per_cell;
        out->edge[++k] = x;
        if (k > n) break;
    }
    /* the last plane lies at or beyond hi: drop it if the one before is nearer */
    if (k > 1 && hi - out->edge[k - 1] < out->edge[k] - hi) k--;
    const double scale = (hi - lo) / (out->edge[k] - lo);
    for (int i = 1; i <= k; i++) out->edge[i] = lo + scale * (out->edge[i] - lo);
    out->n = k;
    return status_ok();
}

static double depth_in(const mpm_scene *s, int body, const double x[3])
{
    return mpm_solid_inside(&s->solid[s->body[body].solid], x);
}

/* Signed distance to the surface of a body's own volume: its solid less the solids of later bodies. */
static double depth(const mpm_scene *s, int body, const double x[3])
{
    double d = depth_in(s, body, x);
    for (int i = body + 1; i < s->bodies; i++) d = fmin(d, -depth_in(s, i, x));
    return d;
}

static const double ROUNDING = 1e-9; /* of a length */

/* Are all corners of a cube inside?  Then no surface passes through it, however near `depth` says that one is: where
 * parts of a solid touch (copies of a cell, two boxes side by side), it is 0 on the face that they share. */
static bool holds_no_surface(const mpm_scene *s, int body, const double x[3], double edge)
{
    for (int i = 0; i < 8; i++) {
        const double corner[3] = { x[0] + edge * ((i & 1) - 0.5), x[1] + edge * ((i >> 1 & 1) - 0.5),
                                   x[2] + edge * ((i >> 2) - 0.5) };
        if (!(depth(s, body, corner) >= -ROUNDING * edge)) return false;
    }
    return true;
}

/* A box of a body's lattice, or the part of one that lies in the body. */
typedef struct {
    double x[3], size[3], share; /* centroid and lengths [m]; of the box's volume [1] */
} piece;

/* A box that the surface passes through is cut: its part inside is a point at its centroid, with the part's variance
 * along each axis.  With whole boxes alone every face that is oblique to the lattice would be a staircase, and contact
 * normals would be those of its steps (docs/validation/solver.md, V7b). */
static void cut(const mpm_scene *s, int body, piece *p)
{
    enum { PARTS = 4, ALL = PARTS * PARTS * PARTS };         /* an axis; in all */
    const double whole = (1 - 1.0 / (PARTS * PARTS)) / 12.0; /* variance of their middles, box of length 1 */
    const double d = depth(s, body, p->x);
    p->share = d > 0;
    if (fabs(d) >= 0.5 * sqrt(p->size[0] * p->size[0] + p->size[1] * p->size[1] + p->size[2] * p->size[2])) return;
    /* the fraction inside is linear in the depth over the thickness of a part; over more, a box with a face on the
     * surface would lose mass */
    const double part = fmin(p->size[0], fmin(p->size[1], p->size[2])) / PARTS;
    double sum = 0, first[3] = { 0 }, second[3] = { 0 };
    for (int i = 0; i < ALL; i++) {
        const int at[3] = { i % PARTS, i / PARTS % PARTS, i / (PARTS * PARTS) };
        double u[3], x[3];
        for (int q = 0; q < 3; q++) u[q] = p->size[q] * ((at[q] + 0.5) / PARTS - 0.5), x[q] = p->x[q] + u[q];
        const double in = depth(s, body, x) / part;
        const bool seam = in > -ROUNDING && in < 0.5 - ROUNDING && holds_no_surface(s, body, x, part);
        const double w = seam ? 1 : fmin(1, fmax(0, 0.5 + in));
        sum += w;
        for (int q = 0; q < 3; q++) first[q] += w * u[q], second[q] += w * u[q] * u[q];
    }
    p->share = sum / ALL;
    if (p->share > 1 - 1e-9 || !(sum > 0)) return;
    for (int q = 0; q < 3; q++) {
        const double mean = first[q] / sum, variance = fmax(second[q] / sum - mean * mean, 0);
        p->x[q] += mean;
        p->size[q] *= fmax(sqrt(variance / whole) / p->size[q], 0.2);
    }
}

bool mpm_build_is_loaded(const mpm_body *b)
{
    return b->traction[0] != 0 || b->traction[1] != 0 || b->traction[2] != 0 || mpm_wave_is_wanted(b);
}

/* The face that the traction or the wave acts on, where it lies between a box's middle and the next one's: of PARTS x
 * PARTS columns through the box those that leave the solid there, as the box is cut in parts too.  A column's place
 * must be the body's own, that in the next box outside of its solid. */
static double loaded_area(const mpm_scene *s, int body, const double x[3], const double size[3])
{
    enum { PARTS = 4 }; /* an axis */
    const mpm_body *b = &s->body[body];
    if (!mpm_build_is_loaded(b)) return 0;
    const int k = b->traction_face / 2, u = (k + 1) % 3, v = (k + 2) % 3;
    const double tiny = ROUNDING * size[k];
    if (fabs(depth_in(s, body, x)) > size[k] + 0.5 * hypot(size[u], size[v])) return 0; /* no surface near */
    int columns = 0;
    for (int i = 0; i < PARTS * PARTS; i++) {
        double at[3] = { x[0], x[1], x[2] };
        at[u] += size[u] * ((i % PARTS + 0.5) / PARTS - 0.5), at[v] += size[v] * ((i / PARTS + 0.5) / PARTS - 0.5);
        if (!(depth(s, body, at) > -tiny)) continue;
        at[k] += b->traction_face % 2 ? size[k] : -size[k];
        columns += !(depth_in(s, body, at) > -tiny);
    }
    return size[u] * size[v] * ((double)columns / (PARTS * PARTS));
}

/* A body under way. */
typedef struct {
    const mpm_scene *s;
    int body;
    const law *k;
    const grids *g;
    double middle[3]; /* its centre of mass; 0 where it does not spin [m] */
    const build_sink *sink;
    double windows, parts; /* shares that are looked at: of the window's boxes, and of the parts of each */
} building;

static bool spins(const mpm_body *b)
{
    return b->spin[0] != 0 || b->spin[1] != 0 || b->spin[2] != 0;
}

/* v = velocity + spin x (x - middle),  L = grad v,  ka = 1/2 sum_k D_k |L e_k|^2 */
static void set_spin(const building *w, build_point *p)
{
    const mpm_body *b = &w->s->body[w->body];
    const axis *axes = w->g->level[mpm_grids_level(w->g, p->x)].axes;
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        p->v[k] += b->spin[u] * (p->x[v] - w->middle[v]) - b->spin[v] * (p->x[u] - w->middle[u]);
        p->L[3 * k + u] = -b->spin[v];
        p->L[3 * k + v] = b->spin[u];
        const double square = b->spin[u] * b->spin[u] + b->spin[v] * b->spin[v];
        if (w->s->transfer == MPM_TRANSFER_TPIC)
            p->ka += 0.5 * mpm_axis_spread(&axes[k], p->x[k], p->half[k], w->s->basis) * square;
    }
}

static build_point point_of(const building *w, const piece *box, const piece *own)
{
    const mpm_scene *s = w->s;
    const int body = w->body;
    const mpm_body *b = &s->body[body];
    build_point p = { .mass = w->k->rho_start * own->share * box->size[0] * box->size[1] * box->size[2],
                      .area = loaded_area(s, body, box->x, box->size) };
    for (int q = 0; q < 3; q++) {
        p.x[q] = own->x[q];
        p.half[q] = 0.5 * own->size[q];
        p.v[q] = b->velocity[q];
    }
    if (spins(b)) set_spin(w, &p);
    return p;
}

/* A box as wide as the points of a level's cells are apart. */
typedef struct {
    piece box;
    int level;
} level_box;

/* The window's lattice has the coarsest level's boxes.  Of a body that is smaller than one, the box is narrower and
 * passes for a finer level's. */
static level_box level_box_of(const building *w, const piece *window)
{
    level_box c = { .box = *window, .level = w->g->levels - 1 };
    double widest = 0; /* of its axes, over what it would be there */
    for (int q = 0; q < 3; q++) {
        const double full = mpm_axis_spacing(&grids_window(w->g)->axes[q], window->x[q]) / w->s->particles_per_axis;
        widest = fmax(widest, window->size[q] / full);
    }
    while (c.level > 0 && 2 * widest <= 1 + ROUNDING) widest *= 2, c.level--;
    return c;
}

/* Is it larger than a granule of the finest level, and does a finer level than its own reach into it?  As it is no
 * larger than a granule of the next finer one, its corners lie in all of those that it meets. */
static bool is_halved(const building *w, const level_box *c)
{
    if (1 << c->level <= GRANULE * w->s->particles_per_axis) return false;
    for (int i = 0; i < 8; i++) {
        double x[3];
        for (int q = 0; q < 3; q++) x[q] = c->box.x[q] + (i >> q & 1 ? 0.5 : -0.5) * (1 - 1e-6) * c->box.size[q];
        if (mpm_grids_level(w->g, x) < c->level) return true;
    }
    return false;
}

/* A box that is not halved any more is cut along each axis once for every level that its middle is finer: parts along
 * each, one a point. */
static int parts_of(const building *w, const level_box *c)
{
    const int finer = c->level - mpm_grids_level(w->g, c->box.x);
    return finer > 0 ? 1 << finer : 1;
}

/* Part number k of a box that is cut into n along each axis. */
static piece part_of(const piece *whole, int n, int k)
{
    const int at[3] = { k % n, k / n % n, k / (n * n) };
    piece p = *whole;
    for (int q = 0; q < 3; q++) {
        p.size[q] /= n;
        p.x[q] += p.size[q] * (at[q] - 0.5 * (n - 1));
    }
    return p;
}

typedef status level_box_function(const building *w, const level_box *c, uint64_t number, void *user);

/* The boxes that one comes to, each with a number of its own. */
static status each_box(const building *w, const level_box *c, uint64_t number, level_box_function *call, void *user)
{
    if (!is_halved(w, c)) return call(w, c, number, user);
    for (int k = 0; k < 8; k++) {
        const level_box half = { .box = part_of(&c->box, 2, k), .level = c->level - 1 };
        TRY(each_box(w, &half, (number << 3) + (uint64_t)k + 1, call, user));
    }
    return status_ok();
}

/* Evenly distributed from 0 up to 1, the same for the same number. */
static double chance(uint64_t number)
{
    number = (number ^ number >> 31) * UINT64_C(0x9E3779B97F4A7C15);
    number = (number ^ number >> 29) * UINT64_C(0xBF58476D1CE4E5B9);
    return (double)(number >> 32) / 4294967296.0;
}

/* Number k of a sample of n out of `all`: one at random from each of n equal stretches.  A fixed step could fall on one
 * plane of boxes again and again. */
static uint64_t sampled(uint64_t k, uint64_t n, uint64_t all, uint64_t seed)
{
    if (n >= all) return k;
    const uint64_t number = (uint64_t)(((double)k + chance(seed + k)) * ((double)all / (double)n));
    return number < all ? number : all - 1;
}

static status one_box(const building *w, const level_box *c, uint64_t number, void *user)
{
    static const double SLIVER = 0.02; /* of a box: left out (docs/theory/scene-solver.md, Points of a body) */
    const int n = parts_of(w, c);
    (void)user;
    const uint64_t all = (uint64_t)n * (uint64_t)n * (uint64_t)n;
    const uint64_t looked_at = w->parts == 1 ? all : (uint64_t)(w->parts * (double)all + chance(number));
    for (uint64_t k = 0; k < looked_at; k++) {
        const piece box = part_of(&c->box, n, (int)sampled(k, looked_at, all, number << 20));
        piece own = box;
        cut(w->s, w->body, &own);
        if (own.share < SLIVER) continue;
        const build_point p = point_of(w, &box, &own);
        TRY(w->sink->point(w->sink->user, w->body, &p));
    }
    return status_ok();
}

static status walk(const building *w, const ladder l[3], level_box_function *call, void *user)
{
    const uint64_t nx = (uint64_t)l[0].n, ny = (uint64_t)l[1].n, all = nx * ny * (uint64_t)l[2].n;
    const uint64_t looked_at = w->windows == 1 ? all : (uint64_t)(w->windows * (double)all);
    for (uint64_t k = 0; k < looked_at; k++) {
        const uint64_t number = sampled(k, looked_at, all, 0);
        const int at[3] = { (int)(number % nx), (int)(number / nx % ny), (int)(number / (nx * ny)) };
        piece box = { .share = 1 };
        for (int q = 0; q < 3; q++) {
            box.size[q] = l[q].edge[at[q] + 1] - l[q].edge[at[q]];
            box.x[q] = l[q].edge[at[q]] + 0.5 * box.size[q];
        }
        const level_box c = level_box_of(w, &box);
        TRY(each_box(w, &c, number, call, user));
    }
    return status_ok();
}

static status add_parts(const building *w, const level_box *c, uint64_t number, void *user)
{
    const double n = parts_of(w, c);
    (void)number;
    *(double *)user += n * n * n;
    return status_ok();
}

/* The shares of which about `most` boxes are the sample. */
static status set_shares(building *w, const ladder l[3], double most)
{
    double parts = 0;
    w->windows = w->parts = 1;
    if (isinf(most)) return status_ok();
    w->windows = fmin(1, most / ((double)l[0].n * l[1].n * l[2].n));
    TRY(walk(w, l, add_parts, &parts));
    w->parts = fmin(1, most / fmax(parts, 1));
    return status_ok();
}

const build_range mpm_build_everywhere = { 0, -INFINITY, INFINITY };

/* The body's points in a range. */
static status build_between(building *w, const build_range *range, double most)
{
    const mpm_body *b = &w->s->body[w->body];
    const axis *axes = grids_window(w->g)->axes;
    double lo[3], hi[3];
    mpm_solid_bounds(&w->s->solid[b->solid], lo, hi);
    lo[range->along] = fmax(lo[range->along], range->lo), hi[range->along] = fmin(hi[range->along], range->hi);
    ladder l[3] = { { 0 } };
    status r = status_ok();
    for (int q = 0; q < 3 && r.code == STATUS_OK; q++) {
        lo[q] = fmax(lo[q], axes[q].node[1]);
        hi[q] = fmin(hi[q], axes[q].node[axes[q].last]);
        if (hi[q] <= lo[q])
            r = base_status_error(STATUS_BAD_INPUT, "body `%s` lies outside the window along axis %d", b->name, q);
        else
            r = ladder_make(&axes[q], lo[q], hi[q], w->s->particles_per_axis, &l[q]);
    }
    if (r.code == STATUS_OK) r = set_shares(w, l, most);
    if (r.code == STATUS_OK) r = walk(w, l, one_box, NULL);
    for (int q = 0; q < 3; q++) free(l[q].edge);
    return r;
}

typedef struct {
    double mass, first[3]; /* [kg, kg m] */
} moments;

static status add_moments(void *user, int body, const build_point *p)
{
    (void)body;
    moments *sum = user;
    sum->mass += p->mass;
    for (int k = 0; k < 3; k++) sum->first[k] += p->mass * p->x[k];
    return status_ok();
}

status mpm_build_body(const mpm_scene *s, int body, const law *k, const grids *g, const build_range *range,
                      const build_sink *sink)
{
    building w = { .s = s, .body = body, .k = k, .g = g };
    if (spins(&s->body[body])) {
        moments sum = { 0 };
        w.sink = &(build_sink){ add_moments, &sum };
        TRY(build_between(&w, &mpm_build_everywhere, INFINITY));
        for (int q = 0; q < 3 && sum.mass > 0; q++) w.middle[q] = sum.first[q] / sum.mass;
    }
    w.sink = sink;
    return build_between(&w, range, INFINITY);
}

status mpm_build_sample(const mpm_scene *s, int body, const law *k, const grids *g, double most, const build_sink *sink,
                        double *share)
{
    building w = { .s = s, .body = body, .k = k, .g = g, .sink = sink };
    const status done = build_between(&w, &mpm_build_everywhere, most);
    *share = w.windows * w.parts;
    return done;
}

double mpm_build_spin_speed(const mpm_scene *s, int body)
{
    const mpm_body *b = &s->body[body];
    double lo[3], hi[3];
    if (!spins(b)) return 0;
    mpm_solid_bounds(&s->solid[b->solid], lo, hi);
    const double rate = sqrt(b->spin[0] * b->spin[0] + b->spin[1] * b->spin[1] + b->spin[2] * b->spin[2]);
    return 0.5 * rate * hypot(hypot(hi[0] - lo[0], hi[1] - lo[1]), hi[2] - lo[2]);
}
