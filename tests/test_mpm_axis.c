/* SPDX-License-Identifier: BSD-3-Clause */
/* One axis of the grid, and the weights on it: laws that hold for any grading.
 *
 * Tolerances are rounding: 2e-16 of the largest number in the sum, which is the position in the window, a few terms. */
#include "mpm_scenes.h"

#include "mpm/kernel/kernels.h"

/* Random specifications that make sense: anything from a few to a few hundred cells. */
static mpm_axis any_axis(void)
{
    const double lo = scene_random(-50e-3, 10e-3), length = scene_random(1e-3, 60e-3),
                 fine = length / scene_random(4, 200);
    const double a = scene_random(0, 0.5) * length, b = scene_random(0.6, 1.0) * length;
    return (mpm_axis){ .lo = lo,
                       .hi = lo + length,
                       .fine_lo = lo + (rand() % 3 ? a : 0),
                       .fine_hi = lo + (rand() % 3 ? b : length),
                       .fine = fine,
                       .coarse = fine * scene_random(1, 8),
                       .growth = scene_random(1.05, 1.3) };
}

static void test_grading(void **state)
{
    (void)state;
    srand(1);
    for (int trial = 0; trial < 400; trial++) {
        const mpm_axis s = any_axis();
        axis a;
        assert_ok(mpm_axis_make(&s, 'x', &a));
        assert_near(a.node[1], s.lo, 0); /* exact: boundaries act there */
        assert_near(a.node[a.last], s.hi, 0);
        assert_true(4 * a.bricks >= a.last + 2);
        double smallest = HUGE_VAL;
        for (int i = 1; i < a.last; i++) {
            const double h = axis_right(&a, i);
            smallest = fmin(smallest, h);
            assert_true(h > 0);
            /* zones are scaled to end on the window: a zone shorter than its last cell shrinks, down to half */
            assert_true(h < 1.51 * s.coarse);
            assert_near(a.edge[i + 1], 0.5 * (a.node[i] + a.node[i + 1]), 1e-14 * (fabs(s.lo) + fabs(s.hi)));
            /* inside the fine zone the cells are as asked for, to the rounding of their number */
            const double middle = a.node[i] + 0.5 * h;
            if (middle > s.fine_lo && middle < s.fine_hi) assert_true(h / s.fine > 0.66 && h / s.fine < 1.5);
        }
        assert_near(a.smallest / smallest, 1, 1e-9);
        mpm_axis_free(&a);
    }
}

/* Neighbouring cells differ by the growth asked for at most, where the zone outside is long enough for its cells: the
 * scaling to the window's end is then below one cell in many.  10 % allows for it from ten cells on. */
static void test_ratio(void **state)
{
    (void)state;
    srand(2);
    for (int trial = 0; trial < 200; trial++) {
        mpm_axis s = any_axis();
        s.fine = (s.hi - s.lo) / 100;
        s.fine_lo = s.lo + 0.4 * (s.hi - s.lo), s.fine_hi = s.lo + 0.6 * (s.hi - s.lo);
        s.coarse = 3 * s.fine;
        axis a;
        assert_ok(mpm_axis_make(&s, 'y', &a));
        for (int i = 2; i < a.last; i++) {
            const double ratio = axis_right(&a, i) / axis_left(&a, i);
            assert_true(fmax(ratio, 1 / ratio) < 1.1 * s.growth);
        }
        mpm_axis_free(&a);
    }
}

static void test_locate(void **state)
{
    (void)state;
    srand(3);
    for (int trial = 0; trial < 200; trial++) {
        const mpm_axis s = any_axis();
        axis a;
        assert_ok(mpm_axis_make(&s, 'z', &a));
        for (int i = 1; i <= a.last; i++) {
            assert_int_equal(mpm_axis_locate(&a, a.node[i]), i);
            assert_int_equal(mpm_axis_locate(&a, a.edge[i]), i); /* a cell holds its lower edge, not its upper */
            assert_int_equal(mpm_axis_locate(&a, nextafter(a.edge[i + 1], -1)), i);
        }
        assert_int_equal(mpm_axis_locate(&a, nextafter(a.edge[1], -1)), 0);
        assert_int_equal(mpm_axis_locate(&a, a.edge[a.last + 1]), a.last + 1);
        assert_int_equal(mpm_axis_locate(&a, NAN), 0);
        assert_true(mpm_axis_locate(&a, s.lo) == 1 &&
                    mpm_axis_locate(&a, s.hi) == a.last); /* the whole window is in some cell */
        for (int q = 0; q < 20; q++) {
            const double x = scene_random(s.lo, s.hi), h = mpm_axis_spacing(&a, x);
            const int i = mpm_axis_locate(&a, x);
            assert_true(h == axis_left(&a, i) || h == axis_right(&a, i));
        }
        mpm_axis_free(&a);
    }
}

static void test_refused(void **state)
{
    (void)state;
    const mpm_axis good = scene_axis(0, 1e-2, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    mpm_axis bad[7];
    for (int i = 0; i < 7; i++) bad[i] = good;
    bad[0].hi = -1, bad[1].fine = 0, bad[2].coarse = 0.5e-3, bad[3].fine_hi = 2e-2, bad[4].growth = 0.9,
    bad[5].fine = 1e-8;
    bad[6].fine_lo = 1e-2;
    for (int i = 0; i < 7; i++) {
        axis a;
        const status s = mpm_axis_make(&bad[i], 'x', &a);
        assert_int_equal(s.code, STATUS_BAD_INPUT);
        assert_non_null(strstr(s.text, " x")); /* names the axis */
    }
}

/* ---- weights ---- */

typedef struct {
    int cell;
    double x[WIDTH], half[WIDTH];
    cell_axis c;
    knots k;
} sample;

/* Particles in one cell; domains within what the solver allows: inside the cells on either side. */
static sample any_sample(const axis *a)
{
    sample s = { .cell = 2 + rand() % (a->last - 2) };
    s.c = cell_axis_at(a, s.cell), s.k = knots_at(a, s.cell);
    for (int l = 0; l < WIDTH; l++) {
        s.x[l] = scene_random(a->edge[s.cell], a->edge[s.cell + 1]);
        s.half[l] = scene_random(0.05, 0.5) * fmin(axis_left(a, s.cell), axis_right(a, s.cell));
    }
    return s;
}

static vd lanes(const double *p)
{
    vd r;
    memcpy(&r, p, sizeof r);
    return r;
}

/* Partition of unity, and a linear field with its slope exact, on any grading; weights not negative. */
static void check_weights(const sample *s, const weights *w)
{
    const double h = s->k.e[2] - s->k.e[1], rounding = 2e-15 * (1 + fmax(fabs(s->k.e[0]), fabs(s->k.e[3])) / h);
    for (int l = 0; l < WIDTH; l++) {
        double one = 0, zero = 0, place = 0, slope = 0;
        for (int i = 0; i < 3; i++) {
            one += w->w[i][l], zero += w->g[i][l];
            place += w->w[i][l] * w->d[i][l];
            slope += w->g[i][l] * w->d[i][l];
            assert_true(w->w[i][l] >= -1e-15);
        }
        assert_near(one, 1, 1e-15);
        assert_near(zero * h, 0, 10 * rounding);
        assert_near(place / h, 0, rounding);  /* sum w (x_i - x) = 0 */
        assert_near(slope, 1, 10 * rounding); /* sum grad w (x_i - x) = 1 */
    }
}

static void test_weights(void **state)
{
    (void)state;
    srand(4);
    for (int trial = 0; trial < 300; trial++) {
        const mpm_axis spec = any_axis();
        axis a;
        assert_ok(mpm_axis_make(&spec, 'x', &a));
        for (int q = 0; q < 40; q++) {
            const sample s = any_sample(&a);
            const weights gimp = weights_gimp(&s.c, s.c.narrowest, lanes(s.x), lanes(s.half));
            const weights spline = weights_bspline(&s.k, lanes(s.x));
            check_weights(&s, &gimp);
            check_weights(&s, &spline);
        }
        mpm_axis_free(&a);
    }
}

/* The derivative is that of the weight: central difference, exact for a piecewise quadratic, so rounding of the
 * position only, 2e-16 x/h over the step of 1e-4. */
static void test_derivative(void **state)
{
    (void)state;
    srand(5);
    const mpm_axis spec = any_axis();
    axis a;
    assert_ok(mpm_axis_make(&spec, 'x', &a));
    for (int q = 0; q < 200; q++) {
        sample s = any_sample(&a), up = s, down = s;
        const double h = s.k.e[2] - s.k.e[1], step = 1e-4 * h;
        for (int l = 0; l < WIDTH; l++) {
            s.half[l] = up.half[l] = down.half[l] = 0.2 * s.c.widest;
            s.x[l] = s.c.x[1] + scene_random(0.3, 0.6) * s.c.widest; /* a piece without a kink for either basis */
            up.x[l] = s.x[l] + step, down.x[l] = s.x[l] - step;
        }
        const double tolerance = 1e-15 * (1 + fabs(s.x[0]) / h) / 1e-4;
        const weights g[3] = { weights_gimp(&s.c, s.c.narrowest, lanes(s.x), lanes(s.half)),
                               weights_gimp(&s.c, s.c.narrowest, lanes(up.x), lanes(s.half)),
                               weights_gimp(&s.c, s.c.narrowest, lanes(down.x), lanes(s.half)) };
        const weights b[3] = { weights_bspline(&s.k, lanes(s.x)), weights_bspline(&s.k, lanes(up.x)),
                               weights_bspline(&s.k, lanes(down.x)) };
        for (int i = 0; i < 3; i++) {
            assert_near(h * g[0].g[i][0], h * (g[1].w[i][0] - g[2].w[i][0]) / (2 * step), tolerance);
            assert_near(h * b[0].g[i][0], h * (b[1].w[i][0] - b[2].w[i][0]) / (2 * step), tolerance);
        }
    }
    mpm_axis_free(&a);
}

/* Continuous where a particle changes cells: the weight of a node is the same from either side of the edge. */
static void test_continuity(void **state)
{
    (void)state;
    srand(6);
    const mpm_axis spec =
        scene_graded(scene_axis(0, 1e-2, 2e-4, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE), 4e-3, 6e-3, 1e-3, 1.25);
    axis a;
    assert_ok(mpm_axis_make(&spec, 'x', &a));
    for (int i = 2; i < a.last - 1; i++) {
        const double x = a.edge[i + 1],
                     half = 0.24 * fmin(axis_right(&a, i), fmin(axis_left(&a, i), axis_right(&a, i + 1)));
        const cell_axis c[2] = { cell_axis_at(&a, i), cell_axis_at(&a, i + 1) };
        const knots k[2] = { knots_at(&a, i), knots_at(&a, i + 1) };
        const weights g[2] = { weights_gimp(&c[0], c[0].narrowest, vd_set(x), vd_set(half)),
                               weights_gimp(&c[1], c[1].narrowest, vd_set(x), vd_set(half)) };
        const weights b[2] = { weights_bspline(&k[0], vd_set(x)), weights_bspline(&k[1], vd_set(x)) };
        for (int n = 0; n < 2; n++) { /* nodes i and i + 1 are seen from both */
            assert_near(g[0].w[1 + n][0], g[1].w[n][0], 1e-13);
            assert_near(b[0].w[1 + n][0], b[1].w[n][0], 1e-13);
        }
        assert_near(g[0].w[0][0], 0, 1e-13); /* and the node that is lost had nothing left */
        assert_near(b[0].w[0][0], 0, 1e-13);
    }
    mpm_axis_free(&a);
}

/* Has brick `group`'s of these three an axis, all there but for some, points in a cell of all their cells? */
static bool holds_points(const mpm *m, const bool *there, int group, const int to[3])
{
    enum { N = 3 * BRICK };
    for (int k = 0; k < 3; k++)
        if (to[k] < 0 || to[k] >= N) return false;
    const int i = (to[2] / BRICK * 3 + to[1] / BRICK) * 3 + to[0] / BRICK + 27 * group;
    return there[i] && m->bricks[i].head[cell_index(to[0] % BRICK, to[1] % BRICK, to[2] % BRICK)] >= 0;
}

static void find_neighbours(brick *b, const bool *there)
{
    for (int step = 0; step < NEIGHBOURS; step++) {
        const int to[3] = { b->at[0] + step % 3 - 1, b->at[1] + step / 3 % 3 - 1, b->at[2] + step / 9 - 1 };
        const int i = (to[2] * 3 + to[1]) * 3 + to[0] + 27 * b->group;
        const bool inside = fmin(to[0], fmin(to[1], to[2])) >= 0 && fmax(to[0], fmax(to[1], to[2])) < 3;
        b->neighbour[step] = inside && there[i] ? i : -1;
    }
}

/* Sides of cells beside which the group has no points. */
static void check_open(const mpm *m, const brick *b, const bool *there)
{
    for (int k = 0; k < 3; k++) {
        uint64_t got[2], want[2] = { 0, 0 };
        mpm_cells_open(m, b, k, got);
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int side = 0; side < 2; side++) {
                int to[3] = { BRICK * b->at[0] + c % BRICK, BRICK * b->at[1] + c / BRICK % BRICK,
                              BRICK * b->at[2] + c / (BRICK * BRICK) };
                to[k] += 2 * side - 1;
                if (!holds_points(m, there, b->group, to)) want[side] |= 1ull << c;
            }
        assert_int_equal(got[0], want[0]);
        assert_int_equal(got[1], want[1]);
    }
}

/* Cells that may share a node with another field, those within two of one of its cells along every axis, and open
 * sides, by looking at all pairs in three bricks an axis. */
static void test_cells_around(void **state)
{
    (void)state;
    enum { N = 3 * BRICK };
    static brick bricks[2][27];
    static int directory[2 * PAGE_PLACES];
    static bool there[2 * 27];
    static mpm m;
    int page = 1; /* all bricks in one */
    grid_level *level = &m.grids.level[0];
    for (int k = 0; k < 3; k++) level->axes[k].bricks = 3, level->pages[k] = 1;
    level->page = &page, m.grids.pages = 1, m.places = PAGE_PLACES;
    m.groups = 2, m.grids.levels = 1, m.directory = directory, m.bricks = bricks[0];
    for (int i = 0; i < 2 * PAGE_PLACES; i++) directory[i] = -1;
    srand(12);
    for (int trial = 0; trial < 200; trial++) {
        memset(bricks, 0, sizeof bricks);
        for (int i = 0; i < 54; i++) {
            there[i] = rand() % 8;
            brick *b = &m.bricks[i];
            *b = (brick){ .group = i / 27, .at = { i % 3, i / 3 % 3, i / 9 % 3 } };
            for (int c = 0; c < BRICK_CELLS; c++) b->head[c] = rand() % 128 ? -1 : c;
            b->occupied = mpm_occupied_cells(b);
            directory[2 * grids_place(&m.grids, 0, b->at) + b->group] = there[i] ? i : -1;
        }
        const int mine = 13 + 27 * (trial % 2),
                  at = trial % 5 ? 13 : rand() % 27; /* the middle one, or one at the rim */
        brick *b = &m.bricks[mine - 13 + at];
        const uint64_t got = mpm_contact_cells(&m, b);
        uint64_t want = 0;
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int other = 0; other < N * N * N; other++) {
                const int to[3] = { other % N, other / N % N, other / (N * N) };
                const int from[3] = { c % BRICK, c / BRICK % BRICK, c / (BRICK * BRICK) };
                bool near = holds_points(&m, there, 1 - b->group, to);
                for (int k = 0; k < 3; k++) near = near && abs(to[k] - BRICK * b->at[k] - from[k]) <= 2;
                if (near) want |= 1ull << c;
            }
        assert_int_equal(got, want);
        find_neighbours(b, there);
        if (there[b - m.bricks]) check_open(&m, b, there);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grading),    cmocka_unit_test(test_ratio),        cmocka_unit_test(test_locate),
        cmocka_unit_test(test_refused),    cmocka_unit_test(test_weights),      cmocka_unit_test(test_derivative),
        cmocka_unit_test(test_continuity), cmocka_unit_test(test_cells_around),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
