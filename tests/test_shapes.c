/* Shapes: the laws of mpm/shape/shape.h over the whole table; one example of each, with its closed volume, in
 * `examples`. */
#include "mpm/shape/shape.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PI 3.14159265358979323846

typedef struct {
    const char *name;
    shape_values s;
    double volume; /* closed formula [m3] */
} example;

/* The armature of the paper's size: 30 mm, lead angle 30 degrees, chamfer 2 mm. */
static const example examples[] = {
    { "box", { { -1.0, 0.5, 2.0, 2.0, 1.75, 4.5 } }, 3.0 * 1.25 * 2.5 },
    { "sphere", { { 1.0, 2.0, 3.0, 0.7 } }, 4.0 / 3.0 * PI * 0.343 },
    { "hemisphere", { { 1e-3, 2e-3, -1e-3, 0.5e-3, 0.5e-3 } }, 2.0 / 3.0 * PI * 0.125e-9 },
    { "hemisphere", { { 1e-3, 2e-3, -1e-3, 0.5e-3, 0.35e-3 } }, 2.0 / 3.0 * PI * 0.25 * 0.35e-9 },
    { "cone", { { 0.1, 0.2, 0.3, 0.5, 0.8 } }, PI / 3.0 * 0.25 * 0.8 },
    { "ridge", { { 0.0, 1.0, 0.0, 0.5, 0.5, 2.0 } }, 0.5 * PI * 0.25 * 4.0 },
    { "ridge", { { 0.0, 1.0, 0.0, 0.5, 0.7, 2.0 } }, 0.5 * PI * 0.5 * 0.7 * 4.0 },
    { "wedge", { { 0.0, 1.0, 0.5, 0.5, 0.4, 2.0 } }, 0.5 * 0.4 * 4.0 },
    { "cylinder", { { 0.0, 0.0, 0.0, 3.81e-3, 25.4e-3 } }, PI * 3.81e-3 * 3.81e-3 * 25.4e-3 },
    { "armature",
      { { 10e-3, 30e-3, 4e-3, 12e-3, 10e-3, 2e-3, PI / 6.0, 9e-3, 0.0 } },
      18e-3 * (30e-3 * 4e-3 + 12e-3 * 6e-3 - 0.5 * 2e-3 * 2e-3 * 1.7320508075688772) },
    { "armature",
      { { 0.0, 30e-3, 4e-3, 12e-3, 10e-3, 0.0, PI / 2.0, 9e-3, 5e-3 } },
      18e-3 * (30e-3 * 4e-3 + 12e-3 * 6e-3) },
    { "pit", { { 1e-3, 2e-3, -1e-3, 0.5e-3, 0.35e-3 } }, 2.0 / 3.0 * PI * 0.25 * 0.35e-9 },
};
enum { EXAMPLES = sizeof examples / sizeof examples[0] };

static double size_of(const double lo[3], const double hi[3])
{
    return fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
}

static double random_between(uint64_t *seed, double lo, double hi)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(*seed >> 11) * 0x1p-53;
}

static void test_table(void **state)
{
    (void)state;
    int n = 0;
    for (const shape_kind *k; (k = mpm_shape_at(n)); n++) {
        assert_ptr_equal(mpm_shape_find(k->name), k);
        assert_true(k->doc && k->doc[0] && k->inside && k->bounds);
        int values = 0, found = 0;
        while (k->value_names[values]) values++;
        assert_in_range(values, 1, sizeof(((shape_values *)0)->value) / sizeof(double));
        for (int e = 0; e < EXAMPLES; e++) found += strcmp(examples[e].name, k->name) == 0;
        if (!found) fail_msg("shape %s has no example in tests/test_shapes.c", k->name);
    }
    assert_true(n >= 8);
    assert_null(mpm_shape_at(-1));
    assert_null(mpm_shape_find("tetrakis"));
    for (int e = 0; e < EXAMPLES; e++) {
        assert_non_null(mpm_shape_find(examples[e].name));
        assert_int_equal(mpm_shape_check(mpm_shape_find(examples[e].name), &examples[e].s).code, STATUS_OK);
    }
}

/* Largest `inside` on the plane x[axis] = at, on a lattice over the box that holds its middle, its edges and corners.
 */
static double largest_on_plane(const shape_kind *k, const shape_values *s, int axis, double at)
{
    enum { N = 200 };
    double lo[3], hi[3], x[3], largest = -INFINITY;
    k->bounds(s, lo, hi);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    x[axis] = at;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            x[u] = lo[u] + (hi[u] - lo[u]) * i / N;
            x[v] = lo[v] + (hi[v] - lo[v]) * j / N;
            largest = fmax(largest, k->inside(s, x));
        }
    return largest;
}

/* The six faces of the bounds touch the shape: nothing of it outside, some of it a hundredth of the size within.
 * 1e-12 of the size: rounding. */
static void test_bounds(void **state)
{
    (void)state;
    for (int e = 0; e < EXAMPLES; e++) {
        const shape_kind *k = mpm_shape_find(examples[e].name);
        double lo[3], hi[3];
        k->bounds(&examples[e].s, lo, hi);
        const double size = size_of(lo, hi);
        for (int f = 0; f < 6; f++) {
            const double face = f % 2 ? hi[f / 2] : lo[f / 2], out = f % 2 ? 1.0 : -1.0;
            const double at = largest_on_plane(k, &examples[e].s, f / 2, face);
            const double outside = largest_on_plane(k, &examples[e].s, f / 2, face + out * 1e-6 * size);
            const double within = largest_on_plane(k, &examples[e].s, f / 2, face - out * 1e-2 * size);
            if (!(fabs(at) <= 1e-12 * size && outside < 0.0 && within > 0.0))
                fail_msg("%s (example %d), face %d: %g outside, %g on it, %g within", k->name, e, f, outside, at,
                         within);
        }
    }
}

/* Counting on 120^3 cells; the error is that of the cells the surface cuts, about (6/120) over the root of their
 * number: below 0.1 %, 0.3 % taken, as faces parallel to the lattice do not average. */
static void test_volume(void **state)
{
    (void)state;
    enum { N = 120 };
    for (int e = 0; e < EXAMPLES; e++) {
        const shape_kind *k = mpm_shape_find(examples[e].name);
        double lo[3], hi[3], x[3];
        k->bounds(&examples[e].s, lo, hi);
        long count = 0;
        for (long c = 0; c < (long)N * N * N; c++) {
            const double f[3] = { ((double)(c % N) + 0.5) / N, ((double)(c / N % N) + 0.5) / N,
                                  ((double)(c / N / N) + 0.5) / N };
            for (int a = 0; a < 3; a++) x[a] = lo[a] + (hi[a] - lo[a]) * f[a];
            count += k->inside(&examples[e].s, x) > 0.0;
        }
        const double box = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
        const double volume = box * (double)count / ((double)N * N * N);
        if (!(fabs(volume / examples[e].volume - 1.0) < 3e-3))
            fail_msg("%s (example %d): counted %.6g, closed %.6g", k->name, e, volume, examples[e].volume);
    }
}

/* Points of the surface: where inside changes sign along the lines of a lattice, by bisection. */
static size_t surface_points(const shape_kind *k, const shape_values *s, double (*out)[3], size_t room)
{
    enum { N = 61 }; /* odd: a line through the tips */
    double lo[3], hi[3];
    size_t n = 0;
    k->bounds(s, lo, hi);
    for (int axis = 0; axis < 3; axis++)
        for (int c = 0; c < N * N * N; c++) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            double a[3], b[3];
            a[u] = b[u] = lo[u] + (hi[u] - lo[u]) * (c % N + 0.5) / N;
            a[v] = b[v] = lo[v] + (hi[v] - lo[v]) * (c / N % N + 0.5) / N;
            const double step = (hi[axis] - lo[axis]) * 1.02 / N, from = lo[axis] - 0.0101 * (hi[axis] - lo[axis]);
            a[axis] = from + step * (c / N / N);
            b[axis] = a[axis] + step;
            const int first = k->inside(s, a) > 0.0;
            if (first == (k->inside(s, b) > 0.0) || n == room) continue;
            for (int i = 0; i < 40; i++) {
                const double middle = 0.5 * (a[axis] + b[axis]);
                double m[3] = { a[0], a[1], a[2] };
                m[axis] = middle;
                if ((k->inside(s, m) > 0.0) == first)
                    a[axis] = middle;
                else
                    b[axis] = middle;
            }
            for (int i = 0; i < 3; i++) out[n][i] = 0.5 * (a[i] + b[i]);
            n++;
        }
    return n;
}

/* Near the surface, within 2 % of the size, |inside| is the distance to the nearest surface point, by search.  The
 * samples lie up to 1.5 % of the size apart, so the search finds up to 0.012 size more, at edges; the
 * ellipsoid's bound is first order, 4 % of d at this distance. */
static void test_distance(void **state)
{
    (void)state;
    enum { ROOM = 200000, TRIES = 4000 };
    double(*surface)[3] = malloc(ROOM * sizeof *surface);
    assert_non_null(surface);
    for (int e = 0; e < EXAMPLES; e++) {
        const shape_kind *k = mpm_shape_find(examples[e].name);
        const shape_values *s = &examples[e].s;
        double lo[3], hi[3];
        k->bounds(s, lo, hi);
        const double size = size_of(lo, hi);
        const size_t n = surface_points(k, s, surface, ROOM);
        assert_in_range(n, 1000, ROOM - 1);
        uint64_t seed = 20170000u + (unsigned)e;
        int near = 0;
        for (int t = 0; t < TRIES && near < 150; t++) {
            double x[3];
            for (int a = 0; a < 3; a++) x[a] = random_between(&seed, lo[a] - 0.02 * size, hi[a] + 0.02 * size);
            const double f = fabs(k->inside(s, x));
            if (f > 0.02 * size) continue;
            double least = INFINITY;
            for (size_t i = 0; i < n; i++) {
                const double dx = x[0] - surface[i][0], dy = x[1] - surface[i][1], dz = x[2] - surface[i][2];
                least = fmin(least, dx * dx + dy * dy + dz * dz);
            }
            least = sqrt(least);
            if (!(f <= 1.04 * least + 1e-9 * size && least <= 1.04 * f + 0.012 * size))
                fail_msg("%s (example %d) at %g %g %g: inside %g, distance %g", k->name, e, x[0], x[1], x[2], f, least);
            near++;
        }
        assert_true(near >= 50);
    }
    free(surface);
}

/* Off an edge or a corner the distance is that to it: 3, 4 -> 5 and 2, 3, 6 -> 7. */
static void test_corners(void **state)
{
    (void)state;
    const struct {
        int example;
        double x[3], want;
    } probes[] = {
        { 0, { 2.3, 2.15, 3.0 }, -0.5 },           { 0, { -1.2, 0.2, 5.1 }, -0.7 },
        { 2, { 1.8e-3, 1.6e-3, -1e-3 }, -0.5e-3 }, { 5, { 0.7, 0.7, 2.6 }, -0.7 },
        { 8, { 6.81e-3, -4e-3, 0.0 }, -5e-3 },     { 9, { 0.0, -3e-3, 13e-3 }, -5e-3 },
    };
    for (size_t i = 0; i < sizeof probes / sizeof probes[0]; i++) {
        const example *e = &examples[probes[i].example];
        const double f = mpm_shape_find(e->name)->inside(&e->s, probes[i].x);
        if (!(fabs(f / probes[i].want - 1.0) < 1e-12))
            fail_msg("%s, probe %zu: %g, want %g", e->name, i, f, probes[i].want);
    }
}

/* The armature's features where they belong: nose in front, legs behind, contact face and lead face. */
static void test_armature(void **state)
{
    (void)state;
    const shape_values s = { { 10e-3, 30e-3, 4e-3, 12e-3, 10e-3, 2e-3, PI / 6.0, 9e-3, 0.0 } };
    const double nose = 10e-3 + 2e-3 * sqrt(3.0), d = 1e-6;
    const struct {
        double x[3];
        int in;
    } probes[] = {
        { { nose - d, 2e-3 + d, 0.0 }, 1 },                         /* tip of the nose, above the chamfer */
        { { nose + d, 5e-3, 0.0 }, 0 },                             /* in front of it */
        { { 10e-3 - d, d / 2, 0.0 }, 1 },                           /* end of the contact face */
        { { 10e-3 + 1e-3, tan(PI / 6.0) * 1e-3 + d * 2, 0.0 }, 1 }, /* just above the lead face */
        { { 10e-3 + 1e-3, tan(PI / 6.0) * 1e-3 - d * 2, 0.0 }, 0 }, /* just below it */
        { { nose - 12e-3 - d, 4e-3 + d, 0.0 }, 0 },                 /* the bore of the U */
        { { nose - 12e-3 + d, 10e-3 - d, 0.0 }, 1 },                /* the head up to the mid plane */
        { { nose - 30e-3 + d, d, 8.9e-3 }, 1 },                     /* the back of the leg */
        { { nose - 30e-3 - d, d, 0.0 }, 0 },                        /* behind it */
        { { 0.0, 2e-3, 9e-3 + d }, 0 },                             /* beside it */
        { { 0.0, -d, 0.0 }, 0 },                                    /* in the rail */
    };
    for (size_t i = 0; i < sizeof probes / sizeof probes[0]; i++)
        if ((mpm_shape_find("armature")->inside(&s, probes[i].x) > 0.0) != probes[i].in) fail_msg("probe %zu", i);
}

static void test_refused(void **state)
{
    (void)state;
    const shape_values good = examples[9].s;
    const shape_kind *armature = mpm_shape_find("armature");
    assert_int_equal(mpm_shape_check(armature, &good).code, STATUS_OK);
    const struct {
        int i;
        double value;
        const char *word;
    } faults[] = {
        { ARMATURE_LENGTH, 0.0, "length" },           { ARMATURE_LEG_THICKNESS, 11e-3, "leg_thickness" },
        { ARMATURE_HEAD_THICKNESS, 31e-3, "head" },   { ARMATURE_CHAMFER_HEIGHT, 11e-3, "chamfer_height" },
        { ARMATURE_LEAD_ANGLE, 0.0, "lead_angle" },   { ARMATURE_LEAD_ANGLE, 1.6, "lead_angle" },
        { ARMATURE_LEAD_ANGLE, 0.06, "lead_angle" },  { ARMATURE_LEG_THICKNESS, -1.0, "leg_thickness" },
        { ARMATURE_HALF_WIDTH, -1e-3, "half_width" }, { ARMATURE_X_FRONT, NAN, "x_front" },
    };
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        shape_values s = good;
        s.value[faults[i].i] = faults[i].value;
        const status refused = mpm_shape_check(armature, &s);
        assert_int_equal(refused.code, STATUS_BAD_INPUT);
        if (!strstr(refused.text, faults[i].word)) fail_msg("%s", refused.text);
    }
    /* a shallow lead face higher than the leg, reaching behind the head */
    shape_values cut = good;
    cut.value[ARMATURE_CHAMFER_HEIGHT] = 9e-3, cut.value[ARMATURE_LEAD_ANGLE] = 0.4,
    cut.value[ARMATURE_LEG_THICKNESS] = 2e-3;
    assert_non_null(strstr(mpm_shape_check(armature, &cut).text, "cuts"));
    for (int e = 0; e < EXAMPLES; e++) {
        shape_values s = examples[e].s;
        const shape_kind *k = mpm_shape_find(examples[e].name);
        s.value[strcmp(k->name, "box") == 0 ? BOX_HI : 3] *= -1.0; /* a radius, or a box inside out */
        assert_int_equal(mpm_shape_check(k, &s).code, STATUS_BAD_INPUT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),    cmocka_unit_test(test_bounds),   cmocka_unit_test(test_volume),
        cmocka_unit_test(test_distance), cmocka_unit_test(test_armature), cmocka_unit_test(test_refused),
        cmocka_unit_test(test_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
