#include "mpm/crater.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const damage_class_names[] = { "none", "scratch", "gouge", "undecided", NULL };

enum { SAMPLES = 2 /* sample lines a map cell and axis */, MAP_LIMIT = 20000000 /* cells of a map */ };
static const double GAUSS =
    0.21132486540518712;                    /* (1 - 1/sqrt 3)/2: a cell's mean from its lines is exact for a cubic */
static const double GAP = 1.2;              /* of the touching distance: a wider gap ends the rail */
static const double PATCH_SHARE = 0.1;      /* of the main patch's volume: a smaller patch is no part of the crater */
static const double SMOOTH_TO = 1.5;        /* (M-20): full weight from this multiple of d_m */
static const double FOOTPRINT_SLACK = 1e-6; /* of a half length: neighbours overlap rather than part by rounding */

/* ---- the surface ---- */

/* Sample lines: top is the height reached so far, half the half length of the point there. */
typedef struct {
    int nx, nz;
    double x_axis[2], z_axis[2]; /* lowest edge of the map, its cell [m] */
    double *top, *half;          /* nx x nz [m]; half < 0: no point yet */
} sampling;

typedef struct {
    double bottom; /* [m] */
    size_t point;
} layer;

static int by_bottom(const void *a, const void *b)
{
    const layer *p = a, *q = b;
    if (p->bottom != q->bottom) return p->bottom < q->bottom ? -1 : 1;
    return (p->point > q->point) - (p->point < q->point);
}

/* Position of line i of an axis {lowest edge of the map, cell}. */
static double line_at(const double axis[2], int i)
{
    return axis[0] + axis[1] * (i / SAMPLES + (i % SAMPLES ? 1.0 - GAUSS : GAUSS));
}

/* First and last of n lines of one axis within half of the middle; first > last if none. */
static void lines_of(double middle, double half, const double axis[2], int n, int range[2])
{
    const double lo = middle - half * (1.0 + FOOTPRINT_SLACK), hi = middle + half * (1.0 + FOOTPRINT_SLACK);
    const double first_cell = floor((lo - axis[0]) / axis[1]), last_cell = floor((hi - axis[0]) / axis[1]);
    range[0] = (int)fmin(fmax(SAMPLES * first_cell, 0.0), n);
    range[1] = (int)fmax(fmin(SAMPLES * last_cell + SAMPLES - 1.0, n - 1.0), -1.0);
    while (range[0] <= range[1] && line_at(axis, range[0]) < lo) range[0]++;
    while (range[0] <= range[1] && line_at(axis, range[1]) > hi) range[1]--;
}

static void footprint(const crater_points *p, size_t i, const sampling *s, int x_range[2], int z_range[2])
{
    lines_of(p->position[3 * i], p->size[3 * i], s->x_axis, s->nx, x_range);
    lines_of(p->position[3 * i + 2], p->size[3 * i + 2], s->z_axis, s->nz, z_range);
}

static bool is_finite_point(const crater_points *p, size_t i)
{
    double sum = 0.0;
    for (size_t k = 3 * i; k < 3 * i + 3; k++) sum += p->position[k] + p->size[k];
    return isfinite(sum);
}

/* The points that meet any line, lowest first; *layers is malloc'ed. */
static status sort_points(const crater_points *p, const sampling *s, layer **layers, size_t *count)
{
    layer *list = malloc((p->n ? p->n : 1) * sizeof *list);
    CHECK(list, STATUS_MEMORY, "crater: no memory to sort %zu material points", p->n);
    size_t n = 0, i = 0;
    for (; i < p->n && is_finite_point(p, i); i++) {
        int x_range[2], z_range[2];
        footprint(p, i, s, x_range, z_range);
        const double bottom = p->position[3 * i + 1] - p->size[3 * i + 1];
        if (x_range[0] > x_range[1] || z_range[0] > z_range[1]) continue;
        list[n++] = (layer){ bottom, i };
    }
    if (i < p->n) free(list);
    CHECK(i == p->n, STATUS_NUMERICAL, "crater: material point %zu of the rail has no finite position or size", i);
    qsort(list, n, sizeof *list, by_bottom);
    *layers = list;
    *count = n;
    return status_ok();
}

/* One point, the next from below, on one line. */
static void pile_up(double *top, double *half, double bottom, double point_half, bool failed)
{
    if (*half < 0.0) { /* the floor of the line: stands even where all above has failed */
        *top = bottom;
        *half = point_half;
    }
    if (failed || bottom - *top > GAP * (*half + point_half)) return;
    if (bottom + 2.0 * point_half <= *top) return;
    *top = bottom + 2.0 * point_half;
    *half = point_half;
}

/* Lines whose lowest point lies in the upper half of the model are outside the rail and stay empty. */
static status pile_points(const crater_points *p, const crater_spec *spec, sampling *s)
{
    layer *list = NULL;
    size_t n = 0;
    TRY(sort_points(p, s, &list, &n));
    const double floor_limit = n ? spec->surface - 0.5 * (spec->surface - list[0].bottom) : 0.0;
    for (size_t k = 0; k < n; k++) {
        const size_t i = list[k].point;
        int x_range[2], z_range[2];
        footprint(p, i, s, x_range, z_range);
        for (int ix = x_range[0]; ix <= x_range[1]; ix++)
            for (int iz = z_range[0]; iz <= z_range[1]; iz++) {
                const size_t at = (size_t)ix * (size_t)s->nz + (size_t)iz;
                if (s->half[at] < 0.0 && list[k].bottom > floor_limit) continue;
                pile_up(&s->top[at], &s->half[at], list[k].bottom, p->size[3 * i + 1], !(p->damage[i] < 1.0));
            }
    }
    const bool any = n && list[0].bottom < spec->surface;
    free(list);
    CHECK(any, STATUS_BAD_INPUT, "crater: no material point of the rail below y = %g m in the region to map",
          spec->surface);
    return status_ok();
}

/* Height of a line between the lowest and highest of its eight neighbours (those there are, itself at a mirror). */
static double without_spike(const sampling *s, int ix, int iz, bool mirrored)
{
    double lowest = INFINITY, highest = -INFINITY;
    for (int jx = ix - 1; jx <= ix + 1; jx++)
        for (int jz = iz - 1; jz <= iz + 1; jz++) {
            const int kz = mirrored && jz < 0 ? 0 : jz;
            if (jx < 0 || jx >= s->nx || kz < 0 || kz >= s->nz || (jx == ix && jz == iz)) continue;
            const size_t at = (size_t)jx * (size_t)s->nz + (size_t)kz;
            if (s->half[at] < 0.0) continue;
            lowest = fmin(lowest, s->top[at]);
            highest = fmax(highest, s->top[at]);
        }
    const double top = s->top[(size_t)ix * (size_t)s->nz + (size_t)iz];
    return lowest <= highest ? fmin(fmax(top, lowest), highest) : top;
}

static double cell_depth(const sampling *s, int i, int j, const crater_spec *spec)
{
    double sum = 0.0;
    int n = 0;
    for (int ix = SAMPLES * i; ix < SAMPLES * (i + 1); ix++)
        for (int iz = SAMPLES * j; iz < SAMPLES * (j + 1); iz++) {
            if (s->half[(size_t)ix * (size_t)s->nz + (size_t)iz] < 0.0) continue;
            sum += spec->surface - without_spike(s, ix, iz, spec->mirrored);
            n++;
        }
    return n ? sum / n : 0.0;
}

static void fill_map(const sampling *s, const crater_spec *spec, crater *c)
{
    const int nz = s->nz / SAMPLES;
    for (int i = 0; i < c->nx; i++)
        for (int j = 0; j < nz; j++) {
            const double d = cell_depth(s, i, j, spec);
            double *row = c->depth_map + (size_t)i * (size_t)c->nz;
            row[spec->mirrored ? nz + j : j] = d;
            if (spec->mirrored) row[nz - 1 - j] = d;
        }
}

static status make_map(const crater_points *p, const crater_spec *spec, crater *c)
{
    const double z_lo = spec->mirrored ? 0.0 : -spec->z_hi;
    const double wide_x = ceil((spec->x_hi - spec->x_lo) / spec->cell * (1.0 - 1e-9));
    const double wide_z = ceil((spec->z_hi - z_lo) / spec->cell * (1.0 - 1e-9));
    CHECK(wide_x * wide_z <= MAP_LIMIT, STATUS_BAD_INPUT, "crater: a map of %g x %g cells is too large, cell = %g m",
          wide_x, wide_z, spec->cell);
    const int nz = (int)wide_z;
    c->nx = (int)wide_x;
    c->nz = spec->mirrored ? 2 * nz : nz;
    c->dx = (spec->x_hi - spec->x_lo) / wide_x;
    c->dz = (spec->z_hi - z_lo) / wide_z;
    c->x0 = spec->x_lo + 0.5 * c->dx;
    c->z0 = -spec->z_hi + 0.5 * c->dz;
    sampling s = {
        .nx = SAMPLES * c->nx, .nz = SAMPLES * nz, .x_axis = { spec->x_lo, c->dx }, .z_axis = { z_lo, c->dz }
    };
    const size_t lines = (size_t)s.nx * (size_t)s.nz;
    s.top = malloc(lines * sizeof *s.top);
    s.half = malloc(lines * sizeof *s.half);
    c->depth_map = malloc((size_t)c->nx * (size_t)c->nz * sizeof *c->depth_map);
    status done = status_ok();
    if (!s.top || !s.half || !c->depth_map)
        done = status_error(STATUS_MEMORY, "crater: no memory for a map of %d x %d cells", c->nx, c->nz);
    for (size_t k = 0; done.code == STATUS_OK && k < lines; k++) s.half[k] = -1.0;
    if (done.code == STATUS_OK) done = pile_points(p, spec, &s);
    if (done.code == STATUS_OK) fill_map(&s, spec, c);
    free(s.top);
    free(s.half);
    return done;
}

/* ---- what belongs to the crater ---- */

/* (M-20) w(d): 0 up to d_m, 1 from 1.5 d_m, 3 t^2 - 2 t^3 between. */
static double weight(double d, double d_m)
{
    const double t = fmin(fmax((d / d_m - 1.0) / (SMOOTH_TO - 1.0), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/* d > d_m; a layer of points exactly d_m thick is not above it by rounding. */
static bool is_deep(const crater *c, size_t at)
{
    return c->depth_map[at] > c->measuring_depth * (1.0 + 1e-6);
}

/* Labels the patch that holds `seed`; returns its volume above nothing [m3].  stack has room for every cell. */
static double flood(const crater *c, int *label, int mark, size_t seed, size_t *stack)
{
    double volume = 0.0;
    size_t n = 0;
    stack[n++] = seed;
    label[seed] = mark;
    while (n) {
        const size_t at = stack[--n];
        const int i = (int)(at / (size_t)c->nz), j = (int)(at % (size_t)c->nz);
        volume += c->depth_map[at] * c->dx * c->dz;
        for (int k = 0; k < 9; k++) {
            const int u = i + k / 3 - 1, v = j + k % 3 - 1;
            if (u < 0 || u >= c->nx || v < 0 || v >= c->nz) continue;
            const size_t next = (size_t)u * (size_t)c->nz + (size_t)v;
            if (label[next] || !is_deep(c, next)) continue;
            label[next] = mark;
            stack[n++] = next;
        }
    }
    return volume;
}

/* label: patch of each cell, 0 = none; volume[mark] its volume; both with room for every cell + 1.  Returns their count. */
static int label_patches(const crater *c, int *label, double *volume, size_t *stack)
{
    const size_t cells = (size_t)c->nx * (size_t)c->nz;
    int patches = 0;
    for (size_t at = 0; at < cells; at++) label[at] = 0;
    for (size_t at = 0; at < cells; at++)
        if (!label[at] && is_deep(c, at)) {
            patches++;
            volume[patches] = flood(c, label, patches, at, stack);
        }
    return patches;
}

/* *mask (malloc'ed) is true where a cell is part of the crater. */
static status find_crater(const crater *c, bool **mask)
{
    const size_t cells = (size_t)c->nx * (size_t)c->nz;
    int *label = malloc(cells * sizeof *label);
    double *volume = malloc((cells + 1) * sizeof *volume);
    size_t *stack = malloc(cells * sizeof *stack);
    bool *in = malloc(cells * sizeof *in);
    const bool enough = label && volume && stack && in;
    if (enough) {
        const int patches = label_patches(c, label, volume, stack);
        double largest = 0.0;
        for (int k = 1; k <= patches; k++) largest = fmax(largest, volume[k]);
        for (size_t at = 0; at < cells; at++) in[at] = label[at] && volume[label[at]] >= PATCH_SHARE * largest;
    } else
        free(in);
    free(label);
    free(volume);
    free(stack);
    CHECK(enough, STATUS_MEMORY, "crater: no memory for a map of %d x %d cells", c->nx, c->nz);
    *mask = in;
    return status_ok();
}

/* ---- measures ---- */

/* Outline of the crater in a row of cells across the rail; lo, hi [m]; hi < lo if the row has none. */
typedef struct {
    double lo, hi;
    double deepest; /* [m] */
    int first, last;
} section;

typedef struct {
    section *row; /* nx */
    int first, last;
    double x_lo, x_hi, z_lo, z_hi; /* outline [m] */
} outline;

/* Share of the spacing from a cell at depth `in` > d_m towards one at `out` <= d_m at which the depth is d_m. */
static double crossing(double in, double out, double d_m)
{
    return fmin(fmax((in - d_m) / (in - fmin(out, d_m)), 0.0), 1.0);
}

static section section_of(const crater *c, const bool *mask, int i)
{
    const double *depth = c->depth_map + (size_t)i * (size_t)c->nz;
    const bool *in = mask + (size_t)i * (size_t)c->nz;
    section s = { .lo = 0.0, .hi = -1.0, .first = -1, .last = -1 };
    for (int j = 0; j < c->nz; j++) {
        if (!in[j]) continue;
        if (s.first < 0) s.first = j;
        s.last = j;
        s.deepest = fmax(s.deepest, depth[j]);
    }
    if (s.first < 0) return s;
    const int f = s.first, l = s.last;
    const double before = f > 0 ? crossing(depth[f], depth[f - 1], c->measuring_depth) : 0.5;
    const double after = l < c->nz - 1 ? crossing(depth[l], depth[l + 1], c->measuring_depth) : 0.5;
    s.lo = c->z0 + c->dz * (f - before);
    s.hi = c->z0 + c->dz * (l + after);
    return s;
}

/* Share of the spacing by which the crater reaches beyond its row `from` towards the row `to`. */
static double row_crossing(const crater *c, const section *from, int to)
{
    if (to < 0 || to >= c->nx) return 0.5;
    double deepest = -INFINITY;
    const int first = from->first > 0 ? from->first - 1 : 0, last = from->last < c->nz - 1 ? from->last + 1 : c->nz - 1;
    for (int j = first; j <= last; j++) deepest = fmax(deepest, c->depth_map[(size_t)to * (size_t)c->nz + (size_t)j]);
    return crossing(from->deepest, deepest, c->measuring_depth);
}

/* Fills o, whose rows the caller provides; false without a crater. */
static bool trace(const crater *c, const bool *mask, outline *o)
{
    o->first = o->last = -1;
    o->z_lo = INFINITY, o->z_hi = -INFINITY;
    for (int i = 0; i < c->nx; i++) {
        o->row[i] = section_of(c, mask, i);
        if (o->row[i].hi < o->row[i].lo) continue;
        if (o->first < 0) o->first = i;
        o->last = i;
        o->z_lo = fmin(o->z_lo, o->row[i].lo);
        o->z_hi = fmax(o->z_hi, o->row[i].hi);
    }
    if (o->first < 0) return false;
    o->x_lo = c->x0 + c->dx * (o->first - row_crossing(c, &o->row[o->first], o->first - 1));
    o->x_hi = c->x0 + c->dx * (o->last + row_crossing(c, &o->row[o->last], o->last + 1));
    return true;
}

/* Mean width over lo .. hi along x, rows weighted by their overlap with it. */
static double mean_width(const crater *c, const outline *o, double lo, double hi)
{
    double sum = 0.0, length = 0.0;
    for (int i = o->first; i <= o->last; i++) {
        const double x = c->x0 + c->dx * i;
        const double overlap = fmin(x + 0.5 * c->dx, hi) - fmax(x - 0.5 * c->dx, lo);
        if (overlap <= 0.0) continue;
        sum += overlap * fmax(o->row[i].hi - o->row[i].lo, 0.0);
        length += overlap;
    }
    return length > 0.0 ? sum / length : 0.0;
}

/* Highest cell of x >= from within `margin` of the crater [m above the surface, >= 0]; *x where. */
static double highest(const crater *c, const outline *o, double margin, double from, double *x)
{
    double height = 0.0;
    for (int i = 0; i < c->nx; i++) {
        const double at_x = c->x0 + c->dx * i;
        if (at_x < fmax(from, o->x_lo - margin) || at_x > o->x_hi + margin) continue;
        for (int j = 0; j < c->nz; j++) {
            const double z = c->z0 + c->dz * j, h = -c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            if (z < o->z_lo - margin || z > o->z_hi + margin || h <= height) continue;
            height = h;
            *x = at_x;
        }
    }
    return height;
}

/* (M-20) of the cells with |z| > beside; a cell across that line counts by its share outside. */
static double volume_of(const crater *c, double beside)
{
    double volume = 0.0;
    for (int j = 0; j < c->nz; j++) {
        const double z = fabs(c->z0 + c->dz * j);
        const double share = beside > 0.0 ? fmin(fmax((z - beside) / c->dz + 0.5, 0.0), 1.0) : 1.0;
        for (int i = 0; share > 0.0 && i < c->nx; i++) {
            const double d = c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            volume += share * d * weight(d, c->measuring_depth);
        }
    }
    return volume * c->dx * c->dz;
}

static void measure_outline(const crater_spec *spec, const outline *o, crater *c)
{
    c->length = o->x_hi - o->x_lo;
    c->truncated = o->first == 0 || o->last == c->nx - 1;
    for (int i = o->first; i <= o->last; i++) {
        const section *s = &o->row[i];
        if (s->hi < s->lo) continue;
        c->width = fmax(c->width, s->hi - s->lo);
        c->truncated = c->truncated || s->first == 0 || s->last == c->nz - 1;
        if (s->deepest <= c->depth) continue;
        c->depth = s->deepest;
        c->deepest_x = c->x0 + c->dx * i;
    }
    const double upstream = mean_width(c, o, o->x_lo, o->x_lo + c->length / 3.0);
    const double downstream = mean_width(c, o, o->x_hi - c->length / 3.0, o->x_hi);
    c->widening = downstream / fmax(upstream, 0.5 * c->dz); /* a point upstream is no narrower than half a cell */
    c->rim_height = highest(c, o, fmax(c->width, 4.0 * spec->particle_radius), -INFINITY, &c->rim_x);
}

/* How far V leans downstream: 6 <x - x_middle>/length over d w(d), 0 for a constant section, 1 for a wedge that begins at
 * a point, negative for one that dies out. */
static double lean_of(const outline *o, const crater *c)
{
    double moment = 0.0, sum = 0.0;
    for (int i = o->first; i <= o->last; i++)
        for (int j = 0; j < c->nz; j++) {
            const double d = c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            sum += d * weight(d, c->measuring_depth);
            moment += d * weight(d, c->measuring_depth) * (c->x0 + c->dx * i - 0.5 * (o->x_lo + o->x_hi));
        }
    return sum > 0.0 ? 6.0 * moment / (sum * c->length) : 0.0;
}

/* ---- the class ---- */

static void classify(const crater_spec *spec, double rim_downstream, crater *c)
{
    const bool wide = c->widening >= spec->limit_widening, severe = c->severity >= spec->limit_severity;
    const bool rim = rim_downstream > c->measuring_depth;
    if (!severe && !(wide && rim))
        c->class = DAMAGE_SCRATCH;
    else
        c->class = wide && severe && rim ? DAMAGE_GOUGE : DAMAGE_UNDECIDED;
    snprintf(c->reason, sizeof c->reason,
             "widening %.2f %s %.2f, severity %.2f %s %.2f, rim downstream %.3f mm %s %.3f mm%s", c->widening,
             wide ? ">=" : "<", spec->limit_widening, c->severity, severe ? ">=" : "<", spec->limit_severity,
             1e3 * rim_downstream, rim ? ">" : "<=", 1e3 * c->measuring_depth,
             c->truncated ? "; the crater reaches the edge of the map" : "");
}

static void measure(const crater_spec *spec, const bool *mask, outline *o, crater *c)
{
    c->volume = volume_of(c, 0.0);
    c->volume_beside = volume_of(c, spec->particle_radius);
    c->severity = -spec->particle_area * spec->particle_height / spec->particle_volume; /* (M-21) of no crater */
    if (!trace(c, mask, o)) {
        c->class = DAMAGE_NONE;
        snprintf(c->reason, sizeof c->reason, "no depth above the measuring depth of %.3f mm",
                 1e3 * c->measuring_depth);
        return;
    }
    measure_outline(spec, o, c);
    c->lean = lean_of(o, c);
    c->severity += c->lean * c->volume / spec->particle_volume; /* (M-21) */
    const double margin = fmax(c->width, 4.0 * spec->particle_radius);
    double x;
    classify(spec, highest(c, o, margin, 0.5 * (o->x_lo + o->x_hi), &x), c);
}

/* ---- */

static status check_spec(const crater_spec *s)
{
    CHECK(s->cell > 0.0 && s->x_hi > s->x_lo && s->z_hi > 0.0 && isfinite(s->x_hi - s->x_lo) && isfinite(s->z_hi) &&
              isfinite(s->surface),
          STATUS_BAD_INPUT, "crater: the region x %g .. %g m, z up to %g m in cells of %g m is empty", s->x_lo, s->x_hi,
          s->z_hi, s->cell);
    CHECK(s->particle_radius > 0.0 && s->particle_height > 0.0 && s->particle_volume > 0.0 && s->particle_area > 0.0,
          STATUS_BAD_INPUT,
          "crater: the particle's radius %g m, height %g m, volume %g m3 and area %g m2 must be positive",
          s->particle_radius, s->particle_height, s->particle_volume, s->particle_area);
    CHECK(isfinite(s->limit_widening) && isfinite(s->limit_severity), STATUS_BAD_INPUT,
          "crater: limit_widening = %g and limit_severity = %g must be numbers", s->limit_widening, s->limit_severity);
    return status_ok();
}

status crater_measure(const crater_points *points, const crater_spec *spec, crater *out)
{
    assert(points && spec && out);
    *out = (crater){ .class = DAMAGE_NONE };
    TRY(check_spec(spec));
    out->measuring_depth = fmax(0.1 * spec->particle_radius, 0.5 * spec->cell);
    bool *mask = NULL;
    outline o = { .row = NULL };
    status done = make_map(points, spec, out);
    if (done.code == STATUS_OK) done = find_crater(out, &mask);
    if (done.code == STATUS_OK) {
        o.row = malloc((size_t)out->nx * sizeof *o.row);
        if (!o.row) done = status_error(STATUS_MEMORY, "crater: no memory for a map of %d rows", out->nx);
    }
    if (done.code == STATUS_OK)
        measure(spec, mask, &o, out);
    else
        crater_free(out);
    free(o.row);
    free(mask);
    return done;
}

void crater_free(crater *c)
{
    if (!c) return;
    free(c->depth_map);
    c->depth_map = NULL;
}
