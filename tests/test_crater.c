/* SPDX-License-Identifier: BSD-3-Clause */
/* The crater's measures on synthetic rails whose surface, and so every measure, is known in closed form.
 *
 * A rail is a lattice of points, some mm deep, whose topmost point in each column is cut to end exactly at the surface.
 * Lengths here are in mm; the rail is handed over in metres. */
#include "base/constants.h"
#include "coupling/gouge/crater.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near_common.h"
#include "random_common.h"

#define MM 1e-3
#define RADIUS 0.5 /* of the particle, a hemisphere; but what measures is taken for one of 6 DEPTH [mm] */
#define DEPTH 0.05 /* at which these craters are measured, as coarser cells allow [mm] */
#define BASE 1.2   /* depth of the rail [mm] */

/* ---- rails ---- */

typedef struct {
    size_t n, room;
    double *position, *size, *damage;
} rail;

typedef double study_surface_at(double x, double z); /* height of the surface [mm], 0 = undamaged */

static void add(rail *r, const double x[3], const double half[3])
{
    if (r->n == r->room) {
        r->room = r->room ? 2 * r->room : 4096;
        r->position = realloc(r->position, 3 * r->room * sizeof(double));
        r->size = realloc(r->size, 3 * r->room * sizeof(double));
        r->damage = realloc(r->damage, r->room * sizeof(double));
        assert_true(r->position && r->size && r->damage);
    }
    for (int k = 0; k < 3; k++) {
        r->position[3 * r->n + (size_t)k] = x[k] * MM;
        r->size[3 * r->n + (size_t)k] = half[k] * MM;
    }
    r->damage[r->n++] = 0.3;
}

static void drop(rail *r)
{
    free(r->position);
    free(r->size);
    free(r->damage);
    *r = (rail){ 0 };
}

/* Points of height `pitch` from -BASE up; the last ends at `top`, at most 1.5 and at least 0.5 of the pitch high. */
static void add_column(rail *r, const double x[2], const double z[2], double pitch, double top)
{
    const int layers = (int)fmax(floor((top + BASE) / pitch + 0.5), 1.0);
    for (int k = 0; k < layers; k++) {
        const double lo = -BASE + pitch * k, hi = k == layers - 1 ? top : lo + pitch;
        add(r, (const double[3]){ 0.5 * (x[0] + x[1]), 0.5 * (lo + hi), 0.5 * (z[0] + z[1]) },
            (const double[3]){ 0.5 * (x[1] - x[0]), 0.5 * (hi - lo), 0.5 * (z[1] - z[0]) });
    }
}

/* Edges of points: pitch in fine[0] .. fine[1], outside growing by `growth` a point until lo and hi are reached. */
static int edges(double *edge, double lo, double hi, const double fine[2], double pitch, double growth)
{
    double left[1000], x = fine[0], step = pitch;
    int n = 0, m = 0;
    for (step *= growth; x > lo; step *= growth) left[m++] = x = fmax(x - step, lo);
    while (m) edge[n++] = left[--m];
    const int count = (int)lround((fine[1] - fine[0]) / pitch);
    for (int k = 0; k <= count; k++) edge[n++] = fine[0] + (fine[1] - fine[0]) * k / count;
    for (x = fine[1], step = pitch * growth; x < hi; step *= growth) edge[n++] = x = fmin(x + step, hi);
    assert_true(n < 1000);
    return n;
}

static rail build(const double *x_edge, int nx, const double *z_edge, int nz, double pitch, study_surface_at *surface)
{
    rail r = { 0 };
    for (int i = 0; i + 1 < nx; i++)
        for (int j = 0; j + 1 < nz; j++)
            add_column(&r, x_edge + i, z_edge + j, pitch,
                       surface(0.5 * (x_edge[i] + x_edge[i + 1]), 0.5 * (z_edge[j] + z_edge[j + 1])));
    return r;
}

/* x from -1 to 7, z from z_lo to 2; points of `pitch` each way. */
static rail uniform(double z_lo, double pitch, study_surface_at *surface)
{
    double x_edge[1000], z_edge[1000];
    const int nx = edges(x_edge, -1.0, 7.0, (const double[2]){ -1.0, 7.0 }, pitch, 1.0);
    const int nz = edges(z_edge, z_lo, 2.0, (const double[2]){ z_lo, 2.0 }, pitch, 1.0);
    return build(x_edge, nx, z_edge, nz, pitch, surface);
}

static crater_spec spec_of(double cell)
{
    return (crater_spec){ .surface = 0.0,
                          .x_lo = -1.0 * MM,
                          .x_hi = 7.0 * MM,
                          .z_hi = 2.0 * MM,
                          .mirrored = false,
                          .cell = cell * MM,
                          .particle_radius = 6.0 * DEPTH * MM,
                          .particle_height = RADIUS * MM,
                          .particle_volume = 2.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS * 1e-9,
                          .particle_area = PI * RADIUS * RADIUS * 1e-6,
                          .limit_widening = 1.5,
                          .limit_severity = 0.0 };
}

static crater measured(const rail *r, const crater_spec *spec)
{
    const crater_points points = { .n = r->n, .position = r->position, .size = r->size, .damage = r->damage };
    crater c;
    const status done = gouge_crater_measure(&points, spec, &c);
    if (done.code != STATUS_OK) fail_msg("%s", done.text);
    return c;
}

/* Builds, measures and drops a rail. */
static crater measured_once(double z_lo, double pitch, study_surface_at *surface, const crater_spec *spec)
{
    rail r = uniform(z_lo, pitch, surface);
    const crater c = measured(&r, spec);
    drop(&r);
    return c;
}

/* (M-20) w(d), written anew from its definition; d, d_m in one unit. */
static double weight(double d, double d_m)
{
    if (d <= d_m) return 0.0;
    if (d >= 1.5 * d_m) return 1.0;
    const double t = (d - d_m) / (0.5 * d_m);
    return 3.0 * t * t - 2.0 * t * t * t;
}

/* ---- surfaces ---- */

static double flat(double x, double z)
{
    (void)x, (void)z;
    return 0.0;
}

/* Dent of a sphere of radius 2, 0.3 deep, at x = 3. */
#define CAP_R 2.0
#define CAP_D 0.3
static double cap(double x, double z)
{
    const double rho2 = (x - 3.0) * (x - 3.0) + z * z, rim2 = CAP_R * CAP_R - (CAP_R - CAP_D) * (CAP_R - CAP_D);
    return rho2 < rim2 ? CAP_R - CAP_D - sqrt(CAP_R * CAP_R - rho2) : 0.0;
}

/* Integral of d w(d) over the cap: with rho^2 = R^2 - (R - D + d)^2, dA = -2 pi (R - D + d) dd. */
static double cap_volume(double d_m)
{
    enum { N = 20000 };
    double sum = 0.0;
    for (int k = 0; k < N; k++) {
        const double d = CAP_D * (k + 0.5) / N;
        sum += d * weight(d, d_m) * 2.0 * PI * (CAP_R - CAP_D + d) * CAP_D / N;
    }
    return sum;
}

/* Groove of parabolic section from x = 0.5 to 5.5, 0.5 wide, 0.2 deep. */
static double groove(double x, double z)
{
    const double t = z / 0.25;
    return x > 0.5 && x < 5.5 && fabs(t) < 1.0 ? -0.2 * (1.0 - t * t) : 0.0;
}

/* The same, 0.8 wide. */
static double wide_groove(double x, double z)
{
    const double t = z / 0.4;
    return x > 0.5 && x < 5.5 && fabs(t) < 1.0 ? -0.2 * (1.0 - t * t) : 0.0;
}

/* Tear-drop from x = 0 to 5: half width 0.3 -> 1.3, depth 0.15 -> 0.5, section parabolic; a rim 0.3 high and 0.4 long.
 */
#define DROP_L 5.0
static double drop_half_width(double x)
{
    return 0.3 + 1.0 * x / DROP_L;
}
static double drop_depth(double x)
{
    return 0.15 + 0.35 * x / DROP_L;
}
static double tear_drop(double x, double z)
{
    if (x > DROP_L && x < DROP_L + 0.4 && fabs(z) < 1.3) return 0.3;
    if (x < 0.0 || x > DROP_L || fabs(z) > drop_half_width(x)) return 0.0;
    const double t = z / drop_half_width(x);
    return -drop_depth(x) * (1.0 - t * t);
}
static double tear_drop_without_rim(double x, double z)
{
    return fmin(tear_drop(x, z), 0.0);
}

/* Volume by midpoints, and the mean width over a .. b of where d > d_m. */
static double drop_volume(double d_m)
{
    enum { N = 1000 };
    double sum = 0.0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const double x = DROP_L * (i + 0.5) / N, z = 1.3 * (j + 0.5) / N, d = -tear_drop(x, z);
            sum += d * weight(d, d_m);
        }
    return 2.0 * sum * DROP_L * 1.3 / N / N;
}
static double drop_width(double d_m, double a, double b)
{
    enum { N = 1000 };
    double sum = 0.0;
    for (int i = 0; i < N; i++) {
        const double x = a + (b - a) * (i + 0.5) / N;
        sum += 2.0 * drop_half_width(x) * sqrt(1.0 - d_m / drop_depth(x)) / N;
    }
    return sum;
}

/* ---- tests ---- */

static void assert_untouched(const crater *c)
{
    assert_int_equal(c->class, DAMAGE_NONE);
    for (int k = 0; k < c->nx * c->nz; k++) assert_near(c->depth_map[k], 0.0, 1e-12); /* rounding of a sum of mm */
    assert_near(c->severity, -1.5, 1e-12);                                            /* - A h / V_p of a hemisphere */
    assert_true(c->volume == 0.0 && c->length == 0.0 && c->width == 0.0 && c->depth == 0.0 && c->rim_height == 0.0);
    assert_non_null(strstr(c->reason, "0.050 mm"));
}

/* Cells of every size, on and off the points' lattice. */
static void test_flat(void **state)
{
    (void)state;
    rail r = uniform(-2.0, 0.1, flat);
    const double cells[] = { 0.05, 0.07, 0.1 };
    for (int k = 0; k < 3; k++) {
        const crater_spec spec = spec_of(cells[k]);
        crater c = measured(&r, &spec);
        assert_untouched(&c);
        assert_near(c.dx * c.nx, 8.0 * MM, 1e-12);
        assert_near(c.z0 + c.dz * (c.nz - 1), -c.z0, 1e-12);
        gouge_crater_free(&c);
    }
    drop(&r);
}

static rail graded(double z_lo, study_surface_at *surface)
{
    double x_edge[1000], z_edge[1000];
    const int nx = edges(x_edge, -3.0, 10.0, (const double[2]){ 0.0, 5.5 }, 0.05, 1.15);
    const int nz = edges(z_edge, z_lo, 6.0, (const double[2]){ z_lo == 0.0 ? 0.0 : -1.4, 1.4 }, 0.05, 1.2);
    return build(x_edge, nx, z_edge, nz, 0.06, surface);
}

static void test_flat_graded(void **state)
{
    (void)state;
    rail r = graded(-6.0, flat);
    const crater_spec spec = spec_of(0.1);
    crater c = measured(&r, &spec);
    assert_untouched(&c);
    gouge_crater_free(&c);
    drop(&r);
}

/* Tolerances: the deepest cell, 0.1 wide, lies beside the middle: (2 x 0.05^2 + 0.1^2/6)/(2 R) = 1.7 um, and the
 * points' own steps as much; the outline is linear between cells, a fifth of a cell; volume 1 %: the edge's share of a
 * cell. */
static void test_cap(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    crater c = measured_once(-2.0, 0.05, cap, &spec);
    const double d_m = 0.05, reach = sqrt(CAP_R * CAP_R - pow(CAP_R - CAP_D + d_m, 2));
    assert_near(c.measuring_depth / MM, d_m, 1e-12);
    assert_near(c.depth / MM, CAP_D, 3.4e-3);
    assert_near(c.deepest_x / MM, 3.0, 0.1);
    assert_near(c.length / MM, 2.0 * reach, 0.02);
    assert_near(c.width / MM, 2.0 * reach, 0.02);
    assert_near(c.volume / 1e-9, cap_volume(d_m), 0.01 * cap_volume(d_m));
    const double whole =
        PI * CAP_D * CAP_D * (3.0 * CAP_R - CAP_D) / 3.0; /* with the shallow edge: d_m counts (d_m/D)^2 */
    assert_in_range((long)(c.volume / 1e-9 / whole * 1000.0), 940, 999);
    assert_near(c.widening, 1.0, 0.02);
    assert_near(c.rim_height, 0.0, 1e-12);
    assert_near(c.lean, 0.0, 0.01); /* symmetric; half a cell of 0.05 over 2 mm, squared by the shallow ends */
    assert_near(c.severity, (c.lean * c.volume / 1e-9 - PI * 0.125) / (2.0 / 3.0 * PI * 0.125), 1e-9);
    assert_false(c.truncated);
    assert_int_equal(c.class, DAMAGE_SCRATCH); /* does not grow downstream */
    assert_non_null(strstr(c.reason, "widening 1.0"));
    gouge_crater_free(&c);
}

static void test_scratch(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.05);
    crater c = measured_once(-2.0, 0.05, groove, &spec);
    assert_int_equal(c.class, DAMAGE_SCRATCH);
    assert_near(c.length / MM, 5.0, 0.05);                         /* a cell: its ends are steps */
    assert_near(c.width / MM, 0.5 * sqrt(1.0 - 0.05 / 0.2), 0.01); /* d = d_m; a fifth of a cell */
    assert_near(c.depth / MM, 0.2, 0.2 * 0.05 * 0.05 / 0.0625); /* the bottom's rise over a cell, with the filter's */
    assert_near(c.widening, 1.0, 1e-6);                         /* all rows are alike */
    assert_near(c.severity, -1.5, 0.02 * 1.5);                  /* lean 0 within a cell of the length */
    gouge_crater_free(&c);
    /* Wider and longer makes a scratch no gouge. */
    c = measured_once(-2.0, 0.05, wide_groove, &spec);
    assert_int_equal(c.class, DAMAGE_SCRATCH);
    assert_near(c.severity, -1.5, 0.05 * 1.5);
    gouge_crater_free(&c);
}

static void assert_tear_drop(const crater *c, double cell)
{
    const double d_m = 0.05, third = DROP_L / 3.0;
    assert_int_equal(c->class, DAMAGE_GOUGE);
    assert_near(c->length / MM, DROP_L, cell); /* both ends are steps */
    assert_near(c->width / MM, 2.0 * drop_half_width(DROP_L) * sqrt(1.0 - d_m / 0.5), 0.5 * cell);
    assert_near(c->depth / MM, 0.5, 0.35 / DROP_L * cell + 0.5 * cell * cell / 1.69); /* slope along, bend across */
    assert_in_range((long)(c->deepest_x / MM * 1000.0), 4850, 5000);
    const double widening = drop_width(d_m, 2.0 * third, DROP_L) / drop_width(d_m, 0.0, third);
    assert_near(c->widening, widening, 0.02 * widening); /* a fifth of a cell of the upstream width */
    assert_near(c->volume / 1e-9, drop_volume(d_m), 0.01 * drop_volume(d_m));
    assert_near(c->rim_height / MM, 0.3, 1e-9);
    assert_in_range((long)(c->rim_x / MM * 1000.0), 5000, 5400);
    assert_false(c->truncated);
}

static void test_gouge(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    crater c = measured_once(-2.0, 0.05, tear_drop, &spec);
    assert_tear_drop(&c, 0.1);
    gouge_crater_free(&c);
    c = measured_once(-2.0, 0.05, tear_drop_without_rim, &spec);
    assert_int_equal(c.class, DAMAGE_UNDECIDED);
    assert_non_null(strstr(c.reason, "rim downstream 0.000 mm <= 0.050 mm"));
    gouge_crater_free(&c);
    crater_spec strict = spec; /* the limits decide */
    strict.limit_widening = 9.0, strict.limit_severity = 99.0;
    c = measured_once(-2.0, 0.05, tear_drop, &strict);
    assert_int_equal(c.class, DAMAGE_SCRATCH);
    gouge_crater_free(&c);
    crater_spec deeper = spec; /* a depth that is given: the tear-drop is narrower there */
    deeper.measuring_depth = 2.0 * spec.cell;
    c = measured_once(-2.0, 0.05, tear_drop, &deeper);
    assert_true(c.measuring_depth == deeper.measuring_depth);
    assert_near(c.width / MM, 2.0 * drop_half_width(DROP_L) * sqrt(1.0 - 0.2 / 0.5), 0.05);
    gouge_crater_free(&c);
    crater_spec cut = spec; /* the map ends within the crater */
    cut.x_hi = 4.0 * MM;
    c = measured_once(-2.0, 0.05, tear_drop, &cut);
    assert_true(c.truncated);
    assert_non_null(strstr(c.reason, "edge of the map"));
    gouge_crater_free(&c);
}

/* The same measures from points that grow away from the crater. */
static void test_graded(void **state)
{
    (void)state;
    rail r = graded(-6.0, tear_drop);
    const crater_spec spec = spec_of(0.1);
    crater c = measured(&r, &spec);
    assert_tear_drop(&c, 0.1);
    gouge_crater_free(&c);
    drop(&r);
}

/* Half a scene gives the full map: the same heights, so the same numbers but for the rounding of the cells' places. */
static void test_mirrored(void **state)
{
    (void)state;
    const crater_spec full_spec = spec_of(0.1);
    crater_spec half_spec = full_spec;
    half_spec.mirrored = true;
    crater full = measured_once(-2.0, 0.05, tear_drop, &full_spec);
    crater half = measured_once(0.0, 0.05, tear_drop, &half_spec);
    assert_int_equal(half.nx, full.nx);
    assert_int_equal(half.nz, full.nz);
    for (int k = 0; k < full.nx * full.nz; k++) assert_near(half.depth_map[k], full.depth_map[k], 1e-12);
    assert_near(half.volume, full.volume, 1e-9 * full.volume);
    assert_near(half.width, full.width, 1e-9 * full.width);
    assert_near(half.length, full.length, 1e-9 * full.length);
    assert_near(half.widening, full.widening, 1e-9 * full.widening);
    assert_near(half.severity, full.severity, 1e-8);
    assert_near(half.rim_height, full.rim_height, 1e-12);
    assert_int_equal(half.class, full.class);
    gouge_crater_free(&full);
    gouge_crater_free(&half);
}

/* A rail of ten layers 0.12 mm high without the points that are left out, all coarser than the map's cells of 0.1 mm or
 * fine across. */
static rail slab(bool coarse, bool (*left_out)(double x, int layer, double z))
{
    const double half[3] = { 0.2, 0.06, coarse ? 0.2 : 0.04 };
    rail r = { 0 };
    for (double x = -1.0 + half[0]; x < 7.0; x += 2.0 * half[0])
        for (double z = -2.0 + half[2]; z < 2.0; z += 2.0 * half[2])
            for (int k = 0; k < 10; k++)
                if (!left_out(x, k, z)) add(&r, (const double[3]){ x, -1.14 + 0.12 * k, z }, half);
    return r;
}

static bool two_layers_out(double x, int layer, double z)
{
    return fabs(x - 3.0) < 0.3 && z > 1.5 && (layer == 5 || layer == 6);
}

/* And a groove three layers deep at the end. */
static bool column_out(double x, int layer, double z)
{
    const bool slit = fabs(x - 2.8) < 0.1 && fabs(z - 0.2) < 0.19, groove = x < 0.1;
    return (slit && layer >= 3 && layer <= 7) || (groove && layer >= 7);
}

/* Merged points far from the groove leave a slit under the surface that is higher than they are, not than they are
 * wide: the rail is whole there.  The same slit under points that are fine in one direction, as those of a groove may
 * be stretched, is the end of the rail. */
static void test_slit_of_merged(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    for (int coarse = 0; coarse < 2; coarse++) {
        rail r = slab(coarse, two_layers_out);
        crater c = measured(&r, &spec);
        if (coarse)
            assert_untouched(&c);
        else
            assert_near(c.depth / MM, 0.6, 1e-9);
        gouge_crater_free(&c);
        drop(&r);
    }
}

/* A slit one merged point wide and five high: metal goes on beside it, so the rail is whole there.  The same one of
 * fine points is the end of the rail, and beside a groove merged points change nothing: its bottom is what lies on a
 * line. */
static void test_column_of_merged(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    for (int coarse = 0; coarse < 2; coarse++) {
        rail r = slab(coarse, column_out);
        crater c = measured(&r, &spec);
        for (int i = 0; i < c.nx; i++) {
            const double x = (c.x0 + i * c.dx) / MM;
            const double depth = c.depth_map[i * c.nz + (int)((0.2 * MM - c.z0) / c.dz)] / MM;
            if (x < 0.1) assert_near(depth, 0.36, 1e-9);
            if (x > 0.4) assert_near(depth, !coarse && fabs(x - 2.8) < 0.2 ? 0.84 : 0.0, 1e-9);
        }
        gouge_crater_free(&c);
        drop(&r);
    }
}

static void add_cluster(rail *r, double x, double y, double z, int n)
{
    for (int k = 0; k < n * n * n; k++)
        add(r, (const double[3]){ x + 0.05 * (k % n), y + 0.05 * (k / n % n), z + 0.05 * (k / n / n) },
            (const double[3]){ 0.025, 0.025, 0.025 });
}

static void assert_same(const crater *a, const crater *b)
{
    assert_int_equal(a->nx * a->nz, b->nx * b->nz);
    assert_memory_equal(a->depth_map, b->depth_map, (size_t)(a->nx * a->nz) * sizeof(double));
    assert_true(a->severity == b->severity && a->length == b->length && a->width == b->width);
    assert_true(a->widening == b->widening && a->rim_height == b->rim_height && a->class == b->class);
}

/* Points and lumps above the surface, over the crater and beyond the rail's end, and far below it, change nothing. */
static void test_debris(void **state)
{
    (void)state;
    rail r = uniform(-2.0, 0.05, tear_drop);
    crater_spec spec = spec_of(0.1);
    spec.x_hi = 9.0 * MM; /* the rail ends at 7 */
    crater clean = measured(&r, &spec);
    uint64_t seed = 5;
    for (int k = 0; k < 400; k++) {
        const double x = random_between(&seed, -1.0, 9.0), z = random_between(&seed, -2.0, 2.0);
        add_cluster(&r, x, random_between(&seed, 0.5, 3.0), z, 1 + k % 3);
    }
    add_cluster(&r, 3.0, 0.15, 0.0, 3);  /* just above the surface, over the crater */
    add_cluster(&r, 6.5, 0.15, 1.5, 10); /* just above the surface where it is whole: a gap of 2.5 points */
    crater dirty = measured(&r, &spec);
    assert_same(&clean, &dirty);
    assert_near(clean.depth_map[(clean.nx - 2) * clean.nz + 3], 0.0, 0.0); /* beyond the end */
    gouge_crater_free(&clean);
    gouge_crater_free(&dirty);
    drop(&r);
}

/* Marks as failed the points of a box; NAN counts as failed too. */
static void fail_box(rail *r, const double lo[3], const double hi[3])
{
    for (size_t i = 0; i < r->n; i++) {
        int in = 1;
        for (size_t k = 0; k < 3; k++)
            in = in && r->position[3 * i + k] > lo[k] * MM && r->position[3 * i + k] < hi[k] * MM;
        if (in) r->damage[i] = i % 7 ? 1.0 : NAN;
    }
}

/* Failed points are removed: a box of 2 x 0.2 x 1 leaves a hole of just that size, its cells being whole.  An intact
 * roof over a failed seam of two layers goes with it, a seam of one is bridged; one failed point leaves no mark. */
static void test_failed(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    rail r = uniform(-2.0, 0.05, flat);
    fail_box(&r, (const double[3]){ 2.0, -0.2, -0.5 }, (const double[3]){ 4.0, 0.0, 0.5 });
    crater box = measured(&r, &spec);
    assert_near(box.depth / MM, 0.2, 1e-9);
    assert_near(box.volume / 1e-9, 0.4, 0.4 * 0.01); /* the filter fills a sample, 0.05^2, in each of four corners */
    assert_near(box.length / MM, 2.0, 0.1);          /* steps: a cell */
    assert_near(box.width / MM, 1.0, 0.1);
    gouge_crater_free(&box);
    drop(&r);

    r = uniform(-2.0, 0.05, flat);
    fail_box(&r, (const double[3]){ 2.0, -0.2, -0.5 }, (const double[3]){ 4.0, -0.1, 0.5 });
    crater roofed = measured(&r, &spec);
    assert_near(roofed.depth / MM, 0.2, 1e-9);
    gouge_crater_free(&roofed);
    drop(&r);

    r = uniform(-2.0, 0.05, flat);
    fail_box(&r, (const double[3]){ 2.0, -0.15, -0.5 }, (const double[3]){ 4.0, -0.1, 0.5 });
    fail_box(&r, (const double[3]){ 3.0, -0.05, 0.5 }, (const double[3]){ 3.05, 0.0, 0.55 });
    crater speck = measured(&r, &spec);
    assert_untouched(&speck);
    gouge_crater_free(&speck);
    drop(&r);

    r = uniform(-2.0, 0.05, flat); /* all of it, down to the floor */
    fail_box(&r, (const double[3]){ 2.0, -2.0, -0.5 }, (const double[3]){ 4.0, 0.0, 0.5 });
    crater hole = measured(&r, &spec);
    assert_near(hole.depth / MM, BASE, 1e-9);
    gouge_crater_free(&hole);
    drop(&r);
}

/* A far speck does not lengthen the crater; a second patch of a tenth of its volume does. */
static void test_patches(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    rail r = uniform(-2.0, 0.05, flat);
    fail_box(&r, (const double[3]){ 0.0, -0.2, -0.5 }, (const double[3]){ 2.0, 0.0, 0.5 });
    fail_box(&r, (const double[3]){ 6.0, -0.2, -0.1 }, (const double[3]){ 6.3, 0.0, 0.1 }); /* 3 % */
    crater alone = measured(&r, &spec);
    assert_near(alone.length / MM, 2.0, 0.1);
    gouge_crater_free(&alone);
    fail_box(&r, (const double[3]){ 5.5, -0.2, -0.2 }, (const double[3]){ 6.5, 0.0, 0.2 }); /* 20 % */
    crater both = measured(&r, &spec);
    assert_near(both.length / MM, 6.5, 0.1);
    gouge_crater_free(&both);
    drop(&r);
}

/* Points shaken by up to 0.15 of their pitch sideways and 0.1 of it upwards: cracks and bumps of the lattice.  A bump
 * of 5 um and a missing or doubled layer in a crack of a third of the samples' borders: 3 % of the volume, 0.03 in
 * depth. */
static void test_noise(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    study_surface_at *const surfaces[] = { flat, cap };
    for (int k = 0; k < 2; k++) {
        rail r = uniform(-2.0, 0.05, surfaces[k]);
        uint64_t seed = 11;
        for (size_t i = 0; i < 3 * r.n; i++) {
            const double share = i % 3 == 1 ? 0.1 : 0.15;
            r.position[i] += random_between(&seed, -share, share) * 0.05 * MM;
        }
        crater c = measured(&r, &spec);
        if (k == 0) {
            assert_int_equal(c.class, DAMAGE_NONE);
        } else {
            assert_near(c.volume / 1e-9, cap_volume(0.05), 0.03 * cap_volume(0.05));
            assert_near(c.depth / MM, CAP_D, 0.03);
        }
        gouge_crater_free(&c);
        drop(&r);
    }
}

/* Rows of points that have moved apart by a quarter of their pitch, across x or across z, in the map and at its edge:
 * one sample line falls through each slit, half a millimetre down. */
static void test_slits(void **state)
{
    (void)state;
    const crater_spec spec = spec_of(0.1);
    for (size_t k = 0; k < 3; k += 2) {
        rail r = uniform(-2.0, 0.1, flat);
        for (size_t i = 0; i < r.n; i++) {
            double *x = &r.position[3 * i + k];
            const bool row = fabs(*x - 0.35 * MM) < 1e-6 || fabs(*x - (k ? 1.95 : 6.95) * MM) < 1e-6;
            if (!row || r.position[3 * i + 1] < -0.5 * MM) continue;
            *x -= 0.02 * MM;
            r.size[3 * i + k] = 0.04 * MM;
        }
        crater c = measured(&r, &spec);
        assert_untouched(&c);
        gouge_crater_free(&c);
        drop(&r);
    }
}

/* Volume against the map's cell with d_m = 0.1 fixed by the particle, radius 0.6, for three, six and twelve cells: at
 * least first order, from 2 % at 0.2, a cell over which the wall of slope 1/2 falls by d_m. */
static void test_convergence(void **state)
{
    (void)state;
    rail r = uniform(-2.0, 0.025, cap);
    const double cells[] = { 0.2, 0.1, 0.05 };
    double error[3];
    for (int k = 0; k < 3; k++) {
        crater_spec spec = spec_of(cells[k]);
        spec.particle_radius = 0.6 * MM;
        crater c = measured(&r, &spec);
        assert_near(c.measuring_depth, 0.1 * MM, 1e-12);
        error[k] = fabs(c.volume / 1e-9 / cap_volume(0.1) - 1.0);
        print_message("cell %.3f mm: volume error %.2e\n", cells[k], error[k]);
        gouge_crater_free(&c);
    }
    for (int k = 0; k < 3; k++) assert_true(error[k] < 0.1 * cells[k]);
    assert_true(error[2] < 0.25 * error[0]);
    drop(&r);
}

/* A flat-bottomed groove of 4 x 1 that sinks by 0.05 d_m at a time: d w(d) rises by at most 4.25 steps in a step (where
 * t = 1/2), while a plain threshold would let 20 steps in at once.  Never falls. */
static double sinking_depth; /* of the groove of the next rail [mm] */
static double sinking(double x, double z)
{
    return x > 1.0 && x < 5.0 && fabs(z) < 0.5 ? -sinking_depth : 0.0;
}
static void test_continuity(void **state)
{
    (void)state;
    const double d_m = 0.05, step = 0.05 * d_m, area = 4.0;
    const crater_spec spec = spec_of(0.1);
    double before = 0.0;
    for (int k = 0; k <= 40; k++) {
        sinking_depth = step * k;
        crater c = measured_once(-2.0, 0.1, sinking, &spec);
        const double volume = c.volume / 1e-9;
        if (volume < before - 1e-12 || volume > before + 4.4 * area * step)
            fail_msg("depth %g mm: volume %g after %g mm3", sinking_depth, volume, before);
        assert_int_equal(c.class == DAMAGE_NONE, k <= 20);
        before = volume;
        gouge_crater_free(&c);
    }
    assert_near(before, area * 2.0 * d_m, 0.02 * area * 2.0 * d_m); /* corners filled by the filter */
}

static void test_refused(void **state)
{
    (void)state;
    rail r = uniform(-2.0, 0.2, flat);
    const crater_points points = { .n = r.n, .position = r.position, .size = r.size, .damage = r.damage };
    const crater_points none = { .n = 0 };
    const crater_spec good = spec_of(0.1);
    crater c;
    assert_int_equal(gouge_crater_measure(&none, &good, &c).code, STATUS_BAD_INPUT);
    crater_spec s = good;
    s.cell = 0.0;
    assert_int_equal(gouge_crater_measure(&points, &s, &c).code, STATUS_BAD_INPUT);
    s = good;
    s.cell = 1e-12;
    assert_non_null(strstr(gouge_crater_measure(&points, &s, &c).text, "too large"));
    s = good;
    s.x_hi = s.x_lo;
    assert_int_equal(gouge_crater_measure(&points, &s, &c).code, STATUS_BAD_INPUT);
    s = good;
    s.particle_volume = NAN;
    assert_int_equal(gouge_crater_measure(&points, &s, &c).code, STATUS_BAD_INPUT);
    s = good;
    s.x_lo = 1.0, s.x_hi = 1.001; /* a metre away */
    assert_non_null(strstr(gouge_crater_measure(&points, &s, &c).text, "no material point"));
    assert_null(c.depth_map);
    r.position[3 * 17] = NAN;
    const status lost = gouge_crater_measure(&points, &good, &c);
    assert_int_equal(lost.code, STATUS_NUMERICAL);
    assert_non_null(strstr(lost.text, "point 17 "));
    drop(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_flat_graded),
        cmocka_unit_test(test_cap),
        cmocka_unit_test(test_scratch),
        cmocka_unit_test(test_gouge),
        cmocka_unit_test(test_graded),
        cmocka_unit_test(test_mirrored),
        cmocka_unit_test(test_slit_of_merged),
        cmocka_unit_test(test_column_of_merged),
        cmocka_unit_test(test_debris),
        cmocka_unit_test(test_failed),
        cmocka_unit_test(test_patches),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_slits),
        cmocka_unit_test(test_convergence),
        cmocka_unit_test(test_continuity),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
