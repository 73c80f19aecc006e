/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/filaments.h"
#include "base/constants.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_LINES = 400, GAUSS = 3, NEAR_POINTS = GAUSS * GAUSS };

/* Filaments whose centres are further apart than this many reaches are seen as four points each: <ln r> to 1e-4. */
static const double FAR = 3.0;

/* ---- mesh ---- */

int circuit_filaments_graded(double length, double first, double growth, int ends, double *size)
{
    const double span = length / ends;
    int n = 0;
    double sum = 0.0, d = first;
    while (sum < span) {
        size[n++] = d;
        sum += d;
        d *= growth;
    }
    for (int k = 0; k < n; k++) size[k] *= span / sum;
    if (ends == 2) {
        for (int k = 0; k < n; k++) size[2 * n - 1 - k] = size[k];
    }
    return ends * n;
}

static circuit_section_point minus(circuit_section_point a, circuit_section_point b)
{
    return (circuit_section_point){ a.x - b.x, a.y - b.y };
}

static double cross(circuit_section_point a, circuit_section_point b)
{
    return a.x * b.y - a.y * b.x;
}

/* Adds area, first and second moments of the triangle from the first corner to m: 1, x, y, xx, xy, yy. */
static void triangle_moments(circuit_section_point a, circuit_section_point b, double m[6])
{
    const double area = 0.5 * cross(a, b);
    m[0] += area;
    m[1] += area * (a.x + b.x) / 3.0;
    m[2] += area * (a.y + b.y) / 3.0;
    m[3] += area * (a.x * a.x + a.x * b.x + b.x * b.x) / 6.0;
    m[4] += area * (2.0 * a.x * a.y + a.x * b.y + b.x * a.y + 2.0 * b.x * b.y) / 12.0;
    m[5] += area * (a.y * a.y + a.y * b.y + b.y * b.y) / 6.0;
}

/* The axes are the sides' halves over sqrt 3 for any parallelogram with two sides along x. */
static filament filament_of(const circuit_section_point corner[4])
{
    filament f = { .reach = 0.0 };
    double m[6] = { 0.0 };
    for (int k = 0; k < 4; k++) f.corner[k] = corner[k];
    triangle_moments(minus(corner[1], corner[0]), minus(corner[2], corner[0]), m);
    triangle_moments(minus(corner[2], corner[0]), minus(corner[3], corner[0]), m);
    f.area = m[0];
    for (int k = 1; k < 6; k++) m[k] /= f.area;
    f.centre = (circuit_section_point){ corner[0].x + m[1], corner[0].y + m[2] };
    const double xx = m[3] - m[1] * m[1], xy = m[4] - m[1] * m[2], yy = m[5] - m[2] * m[2];
    f.axis[1] = (circuit_section_point){ xy / sqrt(yy), sqrt(yy) };
    f.axis[0] = (circuit_section_point){ sqrt(fmax(xx - xy * xy / yy, 0.0)), 0.0 };
    for (int k = 0; k < 4; k++) f.reach = fmax(f.reach, hypot(corner[k].x - f.centre.x, corner[k].y - f.centre.y));
    return f;
}

/* Column lines: places across the thickness at the middle, from the face; in the cladding first. */
typedef struct {
    int n, clad; /* columns, of them in the cladding */
    double at[MAX_LINES + 1];
} columns;

static int lines_add(double from, const double *size, int n, double *at)
{
    for (int k = 0; k < n; k++) at[k + 1] = from += size[k];
    return n;
}

static columns columns_of(const circuit_rail_section *s, double first, double fineness, double growth)
{
    double size[MAX_LINES];
    columns c = { .at = { 0.0 } };
    const double core = s->thickness - s->cladding;
    if (s->cladding > 0.0) {
        const int n = circuit_filaments_graded(s->cladding, fmin(first, s->cladding / fineness), growth, 2, size);
        c.n = c.clad = lines_add(0.0, size, n, c.at);
    }
    const int n = circuit_filaments_graded(core, fmin(first, 0.25 * core / fineness), growth, 2, size);
    c.n += lines_add(s->cladding, size, n, c.at + c.n);
    return c;
}

/* The cladding keeps its thickness, the core is stretched between it and the back. */
static circuit_section_point grid_point(const circuit_rail_section *s, const columns *c, int i, double y)
{
    const double face = circuit_section_face(s, y), at = c->at[i];
    if (i <= c->clad) return (circuit_section_point){ face + at, y };
    const double share = (at - s->cladding) / (s->thickness - s->cladding);
    return (circuit_section_point){ face + s->cladding + share * (circuit_section_back(s, y) - face - s->cladding), y };
}

void circuit_filaments_free(filaments *f)
{
    free(f->cell);
    free(f->R);
    *f = (filaments){ 0 };
}

static int cells_across(double length, double first, double growth)
{
    return (int)(log1p(length * (growth - 1.0) / first) / log(growth)) + 2;
}

status circuit_filaments_create(const circuit_rail_section *s, double depth, double fineness, filaments *out)
{
    *out = (filaments){ .n = 0 };
    const double first = depth / fineness, growth = 1.0 + 1.5 / fineness, half = 0.5 * s->height;
    const double longest = fmax(s->thickness, half),
                 least = fmin(first, 0.25 * fmin(s->thickness - s->cladding, half) / fineness);
    CHECK(4 * cells_across(longest, s->cladding > 0.0 ? fmin(least, s->cladding / fineness) : least, growth) <=
              MAX_LINES,
          STATUS_BAD_INPUT, "a mesh of %g cells a skin depth of %g m needs more than %d lines: ask for less", fineness,
          depth, MAX_LINES);
    double y[CIRCUIT_SECTION_MAX_ROWS + 1];
    const columns c = columns_of(s, first, fineness, growth);
    out->nx = c.n;
    out->ny = circuit_section_rows(s, fmin(first, 0.25 * half / fineness), growth, 0.3 / fineness, y);
    CHECK(out->ny > 0, STATUS_BAD_INPUT,
          "a mesh of %g cells a skin depth of %g m needs more than %d rows: ask for less", fineness, depth,
          CIRCUIT_SECTION_MAX_ROWS);
    out->n = out->nx * out->ny;
    out->cell = malloc((size_t)out->n * sizeof *out->cell);
    out->R = malloc((size_t)out->n * sizeof *out->R);
    CHECK(out->cell && out->R, STATUS_MEMORY, "out of memory for %d rail filaments", out->n);
    for (int j = 0; j < out->ny; j++) {
        for (int i = 0; i < c.n; i++) {
            const circuit_section_point corner[4] = { grid_point(s, &c, i, y[j + 1]),
                                                      grid_point(s, &c, i + 1, y[j + 1]),
                                                      grid_point(s, &c, i + 1, y[j]), grid_point(s, &c, i, y[j]) };
            filament *f = &out->cell[i * out->ny + j];
            *f = filament_of(corner);
            out->R[i * out->ny + j] =
                circuit_section_weight(s) * (i < c.clad ? s->cladding_resistivity : s->resistivity) / f->area;
        }
    }
    return status_ok();
}

/* ---- potential ---- */

/* Integral of ln r over the quadrangle, seen from p: a triangle an edge, 1/2 d [t ln r - 3/2 t + d angle]. */
static double area_log(const filament *q, circuit_section_point p)
{
    double sum = 0.0;
    circuit_section_point a = minus(q->corner[3], p);
    double ln_a = log(a.x * a.x + a.y * a.y);
    for (int k = 0; k < 4; k++) {
        const circuit_section_point b = minus(q->corner[k], p), e = minus(b, a);
        const double ln_b = log(b.x * b.x + b.y * b.y), e2 = e.x * e.x + e.y * e.y;
        if (e2 > 0.0) {
            const double c = cross(a, b), ae = a.x * e.x + a.y * e.y, be = ae + e2;
            sum += 0.5 * c * (0.5 * (be * ln_b - ae * ln_a) / e2 - 1.5 + c / e2 * atan2(c, a.x * b.x + a.y * b.y));
        }
        a = b;
        ln_a = ln_b;
    }
    return sum;
}

/* Gauss points of a quadrangle through its bilinear map, and their weights (sum 1). */
typedef struct {
    circuit_section_point at[NEAR_POINTS];
    double weight[NEAR_POINTS];
} points;

static points points_of(const filament *f)
{
    static const double node[GAUSS] = { 0.11270166537925831, 0.5, 0.88729833462074169 };
    static const double share[GAUSS] = { 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
    const circuit_section_point *c = f->corner;
    points p;
    for (int i = 0; i < GAUSS; i++) {
        for (int j = 0; j < GAUSS; j++) {
            const double u = node[i], v = node[j];
            const circuit_section_point low = { c[0].x + u * (c[1].x - c[0].x), c[0].y + u * (c[1].y - c[0].y) };
            const circuit_section_point high = { c[3].x + u * (c[2].x - c[3].x), c[3].y + u * (c[2].y - c[3].y) };
            const circuit_section_point along = { (1.0 - v) * (c[1].x - c[0].x) + v * (c[2].x - c[3].x),
                                                  (1.0 - v) * (c[1].y - c[0].y) + v * (c[2].y - c[3].y) };
            p.at[GAUSS * i + j] = (circuit_section_point){ low.x + v * (high.x - low.x), low.y + v * (high.y - low.y) };
            p.weight[GAUSS * i + j] = share[i] * share[j] * cross(along, minus(high, low)) / f->area;
        }
    }
    return p;
}

/* Seen from p's points, q exact. */
static double near_log(const points *p, const filament *q, int image)
{
    double sum = 0.0;
    for (int k = 0; k < NEAR_POINTS; k++) sum += p->weight[k] * area_log(q, circuit_section_image(p->at[k], image));
    return sum / q->area;
}

/* Four points each: one logarithm of the product of sixteen distances over `unit`, the distance of the centres. */
static double far_log(const filament *p, const filament *q, int image, double unit)
{
    double product = 1.0;
    for (int k = 0; k < 4; k++) {
        const double s = k & 1 ? 1.0 : -1.0, t = k & 2 ? 1.0 : -1.0;
        const circuit_section_point at =
            circuit_section_image((circuit_section_point){ p->centre.x + s * p->axis[0].x + t * p->axis[1].x,
                                                           p->centre.y + s * p->axis[0].y + t * p->axis[1].y },
                                  image);
        for (int l = 0; l < 4; l++) {
            const double a = l & 1 ? 1.0 : -1.0, b = l & 2 ? 1.0 : -1.0;
            const double dx = (q->centre.x + a * q->axis[0].x + b * q->axis[1].x - at.x) / unit;
            const double dy = (q->centre.y + a * q->axis[0].y + b * q->axis[1].y - at.y) / unit;
            product *= dx * dx + dy * dy;
        }
    }
    return log(product) / 32.0 + log(unit);
}

/* p is the smaller. */
static double potential(const circuit_rail_section *s, const filament *p, const points *from, const filament *q)
{
    double sum = 0.0;
    for (int image = 0; image < circuit_section_images(s); image++) {
        const circuit_section_point apart = minus(circuit_section_image(p->centre, image), q->centre);
        const double r = hypot(apart.x, apart.y);
        const double part = r > FAR * fmax(p->reach, q->reach) ? far_log(p, q, image, r) : near_log(from, q, image);
        sum += circuit_section_image_sign(s, image) * part;
    }
    return -MU0 / (2.0 * PI) * sum;
}

status circuit_filaments_inductance(const circuit_rail_section *s, const filaments *f, double **L)
{
    const size_t n = (size_t)f->n;
    points *from = malloc(n * sizeof *from);
    *L = malloc(n * n * sizeof **L);
    if (!from || !*L) {
        free(from);
        return base_status_error(STATUS_MEMORY, "out of memory for the inductances of %d rail filaments", f->n);
    }
    for (size_t i = 0; i < n; i++) from[i] = points_of(&f->cell[i]);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            const size_t p = f->cell[i].reach < f->cell[j].reach ? i : j, q = i + j - p;
            (*L)[i * n + j] = (*L)[j * n + i] =
                circuit_section_weight(s) * potential(s, &f->cell[p], &from[p], &f->cell[q]);
        }
    }
    free(from);
    return status_ok();
}
