/* SPDX-License-Identifier: BSD-3-Clause */
/* A grid shifted against the bodies by part of a cell (mpm_scene.grid_shift): the window's ends stay, the planes
 * between them move, and nothing else may tell.  Tolerances are rounding, as in test_mpm_flight. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

static const double ROUNDING = 1e-12;
static const double SHIFTS[][3] = { { 0.25, 0.6, 0.5 }, { 0.9, 0.1, 0.75 }, { 0.5, 1, 0.3 } };
enum { N_SHIFTS = sizeof SHIFTS / sizeof SHIFTS[0] };

/* ---- planes ---- */

/* A window of at least six of the coarsest cells; the fine zone reaches its ends, or not. */
static mpm_axis any_axis(int levels)
{
    const double fine = scene_random(0.1e-3, 1e-3), coarsest = fine * (1 << (levels - 1));
    const double lo = rand() % 2 ? 0 : scene_random(-50e-3, 10e-3), hi = lo + scene_random(16, 40) * coarsest;
    mpm_axis a = scene_axis(lo, hi, fine, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    a.coarse = 4 * fine;
    if (rand() % 2) a.fine_lo = lo + 3 * coarsest;
    a.fine_hi = rand() % 2 ? hi : a.fine_lo + floor((hi - a.fine_lo) / coarsest - 3) * coarsest;
    return a;
}

/* All nodes of the finest level that are further than `margin` from both ends of [lo, hi] lie `by` beside one of the
 * lattice of h through `origin`.  How many. */
static int assert_moved(const axis *a, double lo, double hi, double margin, double origin, double h, double by)
{
    int n = 0;
    for (int i = 1; i <= a->last; i++) {
        if (a->node[i] < lo + margin || a->node[i] > hi - margin) continue;
        const double cells = (a->node[i] - by * h - origin) / h;
        assert_near(cells, round(cells), 1e-7);
        n++;
    }
    return n;
}

/* Node of a grid that is not shifted, amid [lo, hi]. */
static double some_node(const axis *a, double lo, double hi)
{
    return a->node[mpm_axis_locate(a, 0.5 * (lo + hi))];
}

static void test_planes(void **state)
{
    (void)state;
    srand(1);
    for (int trial = 0; trial < 300; trial++) {
        SCENE_LOCAL(s);
        grids still, moved;
        mpm_scene_default(&s);
        s.levels = 1 + trial % 4;
        for (int k = 0; k < 3; k++) s.axis[k] = any_axis(s.levels);
        assert_ok(mpm_grids_make(&s, &still));
        for (int k = 0; k < 3; k++) s.grid_shift[k] = scene_random(0.01, 0.99);
        assert_ok(mpm_grids_make(&s, &moved));
        for (int k = 0; k < 3; k++) {
            const mpm_axis *spec = &s.axis[k];
            const axis *a = &moved.level[0].axes[k], *b = &still.level[0].axes[k];
            const bool zone = s.levels == 1; /* the cells outside of it are graded */
            const double lo = zone ? spec->fine_lo : spec->lo, hi = zone ? spec->fine_hi : spec->hi;
            const double cell = (hi - lo) / round((hi - lo) / spec->fine), h = zone ? cell : spec->fine;
            const double margin = 1.8 * h * (1 << (s.levels - 1));
            for (int i = 0; i < s.levels; i++) { /* exact: boundaries act there */
                const axis *of = &moved.level[i].axes[k];
                assert_near(of->node[1], spec->lo, 0);
                assert_near(of->node[of->last], spec->hi, 0);
            }
            assert_true(assert_moved(a, lo, hi, margin, some_node(b, lo, hi), h, s.grid_shift[k]) > 5);
            assert_true(a->smallest > 0.69 * fmin(b->smallest, h)); /* or its steps would be shorter */
            assert_true(a->last <= b->last + (2 << (s.levels - 1)));
        }
        mpm_grids_free(&still), mpm_grids_free(&moved);
    }
}

static void test_none(void **state)
{
    (void)state;
    srand(2);
    for (int trial = 0; trial < 50; trial++) {
        const mpm_axis spec = any_axis(1);
        axis a, b;
        assert_ok(mpm_axis_make(&spec, 'x', &a));
        assert_ok(mpm_axis_make_shifted(&spec, 0, 'x', &b));
        assert_int_equal(a.last, b.last);
        assert_memory_equal(a.node, b.node, (size_t)(4 * a.bricks) * sizeof *a.node);
        mpm_axis_free(&a), mpm_axis_free(&b);
    }
}

/* By whole cells more the planes lie where they did, in a window that has no room for them too. */
static void test_whole_cells(void **state)
{
    (void)state;
    const mpm_axis spec = scene_axis(0, 5e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    axis a, b;
    assert_ok(mpm_axis_make_shifted(&spec, 0.5, 'x', &a));
    assert_ok(mpm_axis_make_shifted(&spec, 6.5, 'x', &b));
    assert_int_equal(a.last, b.last);
    assert_memory_equal(a.node, b.node, (size_t)(4 * a.bricks) * sizeof *a.node);
    mpm_axis_free(&a), mpm_axis_free(&b);
}

static void test_refused(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    mpm_axis small = scene_axis(0, 2e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    axis a;
    const status few = mpm_axis_make_shifted(&small, 0.5, 'y', &a);
    assert_int_equal(few.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(few.text, "along y"));
    SCENE_LOCAL(s);
    scene_bar(&s, 0, 12e-3, 0.5e-3, 8);
    scene_box(&s, 2e-3, -1, -1, 6e-3, 1, 1, &copper);
    s.grid_shift[1] = 1.01 * (1 << (MPM_MAX_LEVELS - 1)); /* more than the largest cell that there may be */
    mpm *m = NULL;
    const status far = mpm_create(&s, 1, &m);
    assert_int_equal(far.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(far.text, "grid_shift"));
}

/* ---- bodies ---- */

/* Against three mirrors, sliding along two of them or at rest: exact, and its mass and middle are those of the box. */
static void test_at_mirrors(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int trial = 0; trial < N_SHIFTS; trial++)
        for (int moves = 0; moves < 2; moves++) {
            SCENE_LOCAL(s);
            mpm_scene_default(&s);
            s.levels = 1 + trial;
            for (int k = 0; k < 3; k++) {
                s.axis[k] =
                    scene_axis(0, 16e-3, 0.5e-3, k ? MPM_BOUNDARY_SYMMETRY : MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
                s.axis[k] = scene_graded(s.axis[k], 0, 6e-3, 2e-3, 1.5);
            }
            memcpy(s.grid_shift, SHIFTS[trial], sizeof s.grid_shift);
            scene_box(&s, 1e-3, 0, 0, 5e-3, 4e-3, 4.5e-3, &copper)->velocity[0] = moves ? 500 : 0;
            mpm *m = scene_make(&s, 2);
            const double middle[3] = { 3e-3, 2e-3, 2.25e-3 };
            for (int k = 0; k < 3; k++) assert_near(scene_mean(m, MPM_position, k, -1), middle[k], 1e-15);
            scene_steps(m, 40);
            const mpm_ledger l = mpm_balance(m);
            const double K0 = mpm_material_bulk_modulus(&copper);
            assert_near(l.mass, copper.density * 4e-3 * 4e-3 * 4.5e-3, 1e-12 * l.mass);
            assert_below(scene_largest(m, MPM_stress) / K0, ROUNDING);
            assert_below(l.momentum_error, ROUNDING);
            assert_near(scene_mean(m, MPM_velocity, 0, -1), s.body[0].velocity[0], 500 * ROUNDING);
            if (!moves) assert_below(l.kinetic, 1e-20); /* [J]: K0 V is 1e4 */
            mpm_free(m);
        }
}

/* Through all levels, in and out again. */
static void test_flight(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int trial = 0; trial < N_SHIFTS; trial++) {
        SCENE_LOCAL(s);
        mpm_scene_default(&s);
        s.levels = 1 + trial;
        for (int k = 0; k < 3; k++) {
            s.axis[k] = scene_axis(0, k ? 20e-3 : 40e-3, 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
            s.axis[k] = scene_graded(s.axis[k], k ? 7e-3 : 12e-3, k ? 11e-3 : 18e-3, 4e-3, 2);
        }
        memcpy(s.grid_shift, SHIFTS[trial], sizeof s.grid_shift);
        mpm_body *b = scene_box(&s, 3.3e-3, 3.3e-3, 3.3e-3, 9.3e-3, 9.3e-3, 9.3e-3, &copper);
        b->velocity[0] = 900, b->velocity[1] = 200, b->velocity[2] = -100;
        mpm *m = scene_make(&s, 2);
        const double x0 = scene_mean(m, MPM_position, 0, -1);
        assert_ok(mpm_advance(m, 14e-6, NULL));
        const mpm_ledger l = mpm_balance(m);
        const mpm_report r = mpm_state(m);
        print_message("%d levels: %llu splits, kinetic energy %.1e, momentum %.1e, energy %.1e\n", s.levels,
                      (unsigned long long)r.splits, l.kinetic / l.kinetic_start - 1, l.momentum_error, l.energy_error);
        assert_true(r.splits > 100);
        assert_below(scene_largest(m, MPM_stress) / mpm_material_bulk_modulus(&copper), ROUNDING);
        assert_near(l.kinetic / l.kinetic_start, 1, ROUNDING);
        assert_near(l.mass / l.mass_start, 1, ROUNDING);
        assert_below(l.momentum_error, ROUNDING);
        assert_near(l.energy_error, 0, ROUNDING);
        assert_near((scene_mean(m, MPM_position, 0, -1) - x0) / (900 * r.time), 1, ROUNDING);
        mpm_free(m);
    }
}

/* ---- a gouge ---- */

static void gouge(gouge_scene *g, const double shift[3])
{
    scene_gouge(g, 0.25e-3, 1500);
    mpm_scene *s = &g->scene;
    s->levels = 3;
    s->axis[2] =
        scene_graded(scene_axis(0, 6e-3, 0.25e-3, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE), 0, 1e-3, 1e-3, 1.5);
    s->zone_until = 1e-6;
    memcpy(s->grid_shift, shift, sizeof s->grid_shift);
}

/* Other numbers than those of the grid where it was, the books as good, the same on any number of threads and from an
 * image, which a scene with another shift refuses. */
static void test_gouge(void **state)
{
    (void)state;
    static const double NONE[3] = { 0 };
    GOUGE_LOCAL(g);
    gouge(&g, SHIFTS[0]);
    mpm *m = scene_same_bits(&g.scene, 12, 12);
    const mpm_ledger l = mpm_balance(m);
    const mpm_report r = mpm_state(m);
    assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
    assert_below(l.momentum_error, ROUNDING);
    assert_near(l.energy_error, 0, ROUNDING);
    void *image;
    size_t bytes;
    assert_ok(mpm_save(m, &image, &bytes));
    GOUGE_LOCAL(other);
    gouge(&other, NONE);
    mpm *still = scene_make(&other.scene, 2);
    assert_true(mpm_restore(still, image, bytes).code != STATUS_OK);
    assert_ok(mpm_advance(still, r.time, NULL));
    const double here = mpm_balance(still).kinetic;
    print_message("kinetic energy: %.6g J, shifted %.6g J; energy %.1e\n", here, l.kinetic, l.energy_error);
    assert_true(l.kinetic != here);
    assert_near(l.kinetic / here, 1, 0.01);
    free(image);
    mpm_free(m), mpm_free(still);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planes),  cmocka_unit_test(test_none),       cmocka_unit_test(test_whole_cells),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_at_mirrors), cmocka_unit_test(test_flight),
        cmocka_unit_test(test_gouge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
