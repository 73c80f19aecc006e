/* SPDX-License-Identifier: BSD-3-Clause */
/* Where cells are small (mpm/refine): rules, levels that nest, points that go from level to level and outlive cells. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

/* ---- the level of a cell ---- */

/* The coarsest whose cells are no larger along any axis. */
static void test_level_for(void **state)
{
    (void)state;
    mpm_scene s;
    mpm_scene_default(&s);
    s.levels = 4;
    for (int wide = -1; wide < 3; wide++) {
        for (int k = 0; k < 3; k++) s.axis[k].fine = k == wide ? 2e-3 : 1e-3;
        const double fine = wide < 0 ? 1e-3 : 2e-3;
        assert_int_equal(mpm_grids_level_for(&s, 0.5 * fine), 0); /* none is as small */
        for (int level = 0; level < 6; level++)
            assert_int_equal(mpm_grids_level_for(&s, fine * (1 << level)), level < 3 ? level : 3);
        assert_int_equal(mpm_grids_level_for(&s, 3.9 * fine), 1);
    }
}

/* ---- merging and splitting ---- */

/* Any two neighbours in one: mass, volume, momentum and energy stay. */
static void test_merge(void **state)
{
    (void)state;
    const double dt = 0.3;
    srand(11);
    for (int trial = 0; trial < 300; trial++) {
        double q[2][BLOCK_DOUBLES], volume = 0;
        departure before = { .count = 0 }, after = before;
        for (int p = 0; p < 2; p++) {
            for (int i = 0; i < BLOCK_DOUBLES; i++) q[p][i] = 0.1 + (double)rand() / RAND_MAX;
            volume += q[p][FIRST_mass] / q[p][FIRST_rho];
            mpm_point_departure(q[p], dt, &before);
        }
        const int k = trial % 3;
        const double length = q[0][FIRST_half + k] + q[1][FIRST_half + k];
        mpm_point_merge(q[0], q[1], k, dt);
        mpm_point_departure(q[0], dt, &after);
        assert_near(after.mass / before.mass, 1, 1e-14);
        assert_near(q[0][FIRST_mass] / q[0][FIRST_rho] / volume, 1, 1e-14);
        for (int i = 0; i < 3; i++) assert_near(after.momentum[i] / before.momentum[i], 1, 1e-14);
        assert_near(after.energy / before.energy, 1, 1e-13);
        assert_near(q[0][FIRST_half + k], length, 1e-15);
    }
}

/* Halves of one particle give it back. */
static void test_merge_undoes_halve(void **state)
{
    (void)state;
    srand(12);
    for (int trial = 0; trial < 300; trial++) {
        double whole[BLOCK_DOUBLES], a[BLOCK_DOUBLES], b[BLOCK_DOUBLES];
        for (int i = 0; i < BLOCK_DOUBLES; i++) whole[i] = 0.1 + (double)rand() / RAND_MAX;
        whole[FIRST_ka] += 10; /* else the halves' motion comes out of e */
        memcpy(a, whole, sizeof a);
        mpm_point_halve(a, b, trial % 3);
        mpm_point_merge(a, b, trial % 3, 1e-9);
        for (int i = 0; i < BLOCK_DOUBLES; i++) assert_near(a[i] / whole[i], 1, 1e-14);
    }
}

/* ---- rules ---- */

/* Some seconds into a gouge, or what a rule might see of one: any block of a moving, flowing body. */
static mpm *flowing(const mpm_material *copper, mpm_scene *s)
{
    mpm_scene_default(s);
    for (int k = 0; k < 3; k++) s->axis[k] = scene_axis(0, 8e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(s, 2e-3, 2e-3, 2e-3, 6e-3, 6e-3, 6e-3, copper);
    mpm *m = scene_make(s, 1);
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES; l++) {
                    block *b = &m->blocks[q];
                    b->s[3][l] = b->flow[0][l], b->L[1][l] = 1e5, b->L[0][l] = -3e4; /* it yields and is compressed */
                }
    return m;
}

static int any_block(const mpm *m)
{
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            if (m->bricks[i].head[c] >= 0) return m->bricks[i].head[c];
    fail();
    return -1;
}

/* Every kind has a table whose values can be found, is checked, and asks for cells; half of a tolerance (m/s) asks for
 * cells half as large. */
static void test_kinds(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    mpm *m = flowing(&copper, &s);
    int n = 0;
    for (const mpm_refine_kind *k; (k = mpm_refine_kind_at(n)); n++) {
        assert_ptr_equal(mpm_refine_kind_find(k->name), k);
        mpm_refine r = mpm_refine_make(k);
        double cell[2][LANES];
        assert_int_equal(mpm_refine_check(&r, 1).code, k->of_body ? STATUS_BAD_INPUT : STATUS_OK);
        r.body = 0, r.cell = 0.5e-3;
        assert_ok(mpm_refine_check(&r, 1));
        r.body = 1;
        assert_int_equal(mpm_refine_check(&r, 1).code, STATUS_BAD_INPUT);
        r.body = 0;
        k->cells(m, &r, any_block(m), cell[0]);
        bool tolerance = false;
        for (const base_param *p = k->params; p->key; p++) {
            assert_non_null(mpm_refine_value(&r, p->key));
            if (strcmp(p->unit, "m/s") != 0) continue;
            tolerance = true;
            *mpm_refine_value(&r, p->key) *= 0.5;
        }
        k->cells(m, &r, any_block(m), cell[1]);
        for (int l = 0; l < LANES; l++) {
            assert_true(cell[0][l] > 0 && isfinite(cell[0][l]));
            assert_near(cell[1][l] / cell[0][l], tolerance ? 0.5 : 1, 1e-12);
        }
        print_message("%s: cells of %.3g mm\n", k->name, 1e3 * cell[0][0]);
    }
    assert_true(n >= 3);
    assert_null(mpm_refine_kind_at(-1));
    assert_null(mpm_refine_kind_find("nowhere"));
    mpm_free(m);
}

/* A block of copper at rest in cells of 1 mm with finer levels for a rule, and all its points elastic. */
static mpm *quiet(const mpm_material *copper, mpm_scene *s, double jump, bool fine)
{
    mpm_refine *plastic;
    mpm_scene_default(s);
    s->levels = 3, s->zone_until = fine ? 1 : 0;
    for (int k = 0; k < 3; k++) s->axis[k] = scene_axis(0, 64e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(s, 8e-3, 8e-3, 8e-3, 56e-3, 56e-3, 56e-3, copper);
    assert_ok(mpm_scene_add_refine(s, "plastic", &plastic));
    *mpm_refine_value(plastic, "jump") = jump;
    return scene_make(s, 1);
}

/* The zone has the finest cells, or such as `zone_cell` lets be. */
static void test_zone_cell(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    for (int level = 0; level < 3; level++) {
        SCENE_LOCAL(s);
        mpm *m = quiet(&copper, &s, 10, true);
        mpm_free(m);
        s.zone_cell = level > 0 ? 1.01e-3 * (1 << level) : NAN;
        m = scene_make(&s, 1);
        assert_ok(mpm_refine_look(m));
        for (int i = 0; i < m->bricks_used; i++)
            if (m->bricks[i].particles > 0) assert_int_equal(m->bricks[i].level, level);
        mpm_free(m);
    }
}

/* Every n-th of the points of a brick's cells lo .. hi along each axis flows with a rate [1/s]. */
static void flow(mpm *m, brick *b, int lo, int hi, int n, double rate)
{
    int i = 0;
    for (int c = 0; c < BRICK_CELLS; c++) {
        const int at[3] = { c % BRICK, c / BRICK % BRICK, c / (BRICK * BRICK) };
        bool in = true;
        for (int k = 0; k < 3; k++) in = in && at[k] >= lo && at[k] <= hi;
        for (int q = b->head[c]; in && q >= 0; q = m->links[q].next)
            for (int l = 0; l < LANES; l++) {
                block *p = &m->blocks[q];
                if (!(p->mass[0][l] > 0) || i++ % n) continue;
                p->s[3][l] = p->flow[0][l]; /* s : D = s L_xy */
                p->L[1][l] = rate;
            }
    }
}

/* How many granules of a level are active after a look at which points of one brick flow: from large cells, or from
 * small ones of which nothing asks for any more but that brick. */
static int active_after(bool fine, int lo, int hi, int n, double rate)
{
    static const double JUMP = 10; /* [m/s] so 1e4/s asks for 1 mm, 5e3/s for 2 mm */
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    mpm *m = quiet(&copper, &s, JUMP, fine);
    int active = 0, chosen = -1;
    bool changed;
    m->scene.zone_until = 0;
    for (int i = 0; i < m->bricks_used && chosen < 0; i++) /* one that is full, deep in the block */
        if (m->bricks[i].level == (fine ? 0 : 2) && m->bricks[i].particles == 512) chosen = i;
    assert_true(chosen >= 0);
    for (int look = 0; look < 1 + GRANULE_LIFE; look++) {
        flow(m, &m->bricks[chosen], lo, hi, n, rate);
        assert_ok(mpm_refine_flags(m, &changed));
    }
    for (int i = 0; i < grids_flags(&m->grids); i++)
        active += m->grids.active[i] > 0 && m->grids.page[i / PAGE_FLAGS].level == 0;
    mpm_free(m);
    return active;
}

/* Where points flow now and then it is their mean that counts: one of the 64 of a cell twice as wide keeps nothing
 * small, all of a cell do, though they are an eighth of it, if they flow fast enough; a large cell asks by itself. */
static void test_mean(void **state)
{
    (void)state;
    const int one = active_after(true, 0, 0, 64, 5e4), all = active_after(true, 0, 3, 1, 1.1e4 / 2);
    const int slow = active_after(true, 0, 3, 1, 0.9e4 / 2), cell = active_after(true, 1, 1, 1, 8 * 1.1e4 / 2);
    const int less = active_after(true, 1, 1, 1, 8 * 0.9e4 / 2), large = active_after(false, 1, 1, 1, 1.1e4 / 2);
    print_message(
        "granules that stay: %d for a point, %d and %d for all points, %d and %d for a cell's; that come: %d\n", one,
        all, slow, cell, less, large);
    assert_int_equal(one, 0);
    assert_int_equal(slow, 0);
    assert_int_equal(less, 0);
    assert_true(all >= 8 && all <= 64);
    assert_true(cell >= 8 && cell <= 27);
    assert_true(large >= 8); /* one of 4 mm and what is around it */
}

/* ---- levels that nest ---- */

static bool node_has(const mpm *m, int level, const int node[3], int which)
{
    uint8_t foreign[BRICK_CELLS];
    const int at[3] = { node[0] / BRICK, node[1] / BRICK, node[2] / BRICK };
    const interface_nodes s = mpm_interface_nodes(m, level, at, foreign);
    const uint64_t set = which == 0 ? s.follow_coarser : which == 1 ? s.follow_finer : s.lead_finer;
    return set >> cell_index(node[0] % BRICK, node[1] % BRICK, node[2] % BRICK) & 1;
}

/* A constrained node of a level: those that it depends on are none, and take what it hands on. */
static void check_node(const mpm *m, int level, const int n[3])
{
    if (node_has(m, level, n, 1)) {
        const int f[3] = { 2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1 };
        assert_false(node_has(m, level, n, 0));
        assert_false(node_has(m, level - 1, f, 0));
        assert_false(node_has(m, level - 1, f, 1));
    }
    if (level == m->grids.levels - 1 || !node_has(m, level, n, 0)) return;
    for (int i = 0; i < 8; i++) { /* a node between two coarse ones depends on both */
        const int c[3] = { (n[0] + 1 + i % 2) / 2, (n[1] + 1 + i / 2 % 2) / 2, (n[2] + 1 + i / 4) / 2 };
        assert_false(node_has(m, level + 1, c, 1));
    }
}

/* Any granules of any levels, and what they need around them: constrained nodes never depend on constrained ones, and a
 * point belongs to the finest level that is active where it is. */
static void test_nesting(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    srand(5);
    for (int trial = 0; trial < 12; trial++) {
        SCENE_LOCAL(s);
        mpm_scene_default(&s);
        s.levels = 2 + trial % 3, s.zone_until = 0;
        for (int k = 0; k < 3; k++)
            s.axis[k] = scene_axis(0, scene_random(16e-3, 24e-3), 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        scene_box(&s, 1e-3, 1e-3, 1e-3, 2e-3, 2e-3, 2e-3, &copper);
        mpm *m = scene_make(&s, 1);
        for (int i = 0; i < 12; i++) {
            double lo[3], hi[3];
            for (int k = 0; k < 3; k++) lo[k] = scene_random(0, 20e-3), hi[k] = lo[k] + scene_random(0, 3e-3);
            assert_ok(mpm_grids_activate(&m->grids, rand() % (s.levels - 1), lo, hi));
        }
        assert_ok(mpm_grids_nest(&m->grids));
        int constrained = 0;
        for (int level = 0; level < s.levels; level++) {
            const axis *a = m->grids.level[level].axes;
            for (int i = 0; i < 10000; i++) {
                const int n[3] = { 1 + rand() % a[0].last, 1 + rand() % a[1].last, 1 + rand() % a[2].last };
                /* a node that no point of its level comes near may be anything */
                const double x[3] = { a[0].node[n[0]], a[1].node[n[1]], a[2].node[n[2]] };
                if (mpm_grids_level(&m->grids, x) > level) continue;
                check_node(m, level, n);
                constrained += node_has(m, level, n, 0) || node_has(m, level, n, 1);
            }
        }
        for (int i = 0; i < 3000; i++) {
            const double x[3] = { scene_random(0, 16e-3), scene_random(0, 16e-3), scene_random(0, 16e-3) };
            const int level = mpm_grids_level(&m->grids, x);
            double lo[3], hi[3];
            for (int k = 0; k < 3; k++) lo[k] = x[k] - 1e-6, hi[k] = x[k] + 1e-6;
            if (level == 0) continue;
            assert_ok(mpm_grids_activate(&m->grids, level - 1, lo, hi)); /* one finer, and it is */
            assert_int_equal(mpm_grids_level(&m->grids, x), level - 1);
        }
        print_message("%d levels: %d constrained nodes of %d\n", s.levels, constrained, 10000 * s.levels);
        assert_true(constrained > 20);
        mpm_free(m);
    }
}

/* ---- scenes ---- */

/* Two small bodies in a large one, all welded, with fine cells around the small ones alone: a motion that is linear in
 * space and carried along stays what it was at all points, whatever shape the region of fine cells has. */
static void test_linear(void **state)
{
    (void)state;
    static const double CARRIED = 1000, RATE = 1e3, STEP = 3e-13;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    s.levels = 4, s.zone_until = 0;
    s.viscosity_linear = s.viscosity_quadratic = 0; /* else there is stress at once */
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 24e-3, 0.25e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 1e-3, 1e-3, 1e-3, 23e-3, 23e-3, 23e-3, &copper);
    scene_box(&s, 8e-3, 8e-3, 8e-3, 9e-3, 9e-3, 9e-3, &copper);
    scene_box(&s, 10e-3, 10e-3, 8e-3, 13e-3, 11e-3, 9e-3, &copper);
    for (int i = 1; i < 3; i++) {
        mpm_refine *r;
        assert_ok(mpm_scene_add_refine(&s, "around", &r));
        r->body = i, *mpm_refine_value(r, "within") = 0.3e-3;
    }
    mpm *m = scene_make(&s, 2);
    double L[9], at_level[MPM_MAX_LEVELS] = { 0 }, worst = 0;
    srand(4);
    for (int i = 0; i < 9; i++) L[i] = RATE * scene_random(-1, 1);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < m->bricks_used; i++)
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                    for (int l = 0; l < LANES; l++) {
                        block *b = &m->blocks[q];
                        if (!(b->mass[0][l] > 0)) continue;
                        for (int k = 0; k < 3; k++) {
                            double v = CARRIED;
                            for (int j = 0; j < 3; j++) {
                                v += L[3 * k + j] * (pass ? b->start[j][l] : b->x[j][l]);
                                if (!pass) b->L[3 * k + j][l] = L[3 * k + j];
                            }
                            if (!pass) b->v[k][l] = v;
                            worst = fmax(worst, fabs(b->v[k][l] - v) / CARRIED);
                        }
                        at_level[m->bricks[i].level] += pass;
                    }
        if (pass) break;
        m->dt = STEP;
        assert_ok(mpm_advance(m, STEP, NULL));
    }
    print_message("%.0f, %.0f, %.0f, %.0f points; linear velocity to %.1e\n", at_level[0], at_level[1], at_level[2],
                  at_level[3], worst);
    for (int i = 0; i < s.levels; i++) assert_true(at_level[i] > 500);
    assert_below(worst, 1e-12);
    mpm_free(m);
}

/* What a scene takes is told with the small cells that a rule asks for around a body at the start. */
static void test_estimate(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    mpm_refine *r;
    mpm_needs needs, large;
    mpm_scene_default(&s);
    s.levels = 3, s.zone_until = 0;
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 16e-3, 0.25e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 1e-3, 1e-3, 1e-3, 15e-3, 9e-3, 15e-3, &copper);
    scene_box(&s, 7e-3, 9e-3, 7e-3, 9e-3, 11e-3, 9e-3, &copper);
    assert_ok(mpm_estimate(&s, &large));
    assert_ok(mpm_scene_add_refine(&s, "around", &r));
    r->body = 1, *mpm_refine_value(r, "within") = 0.5e-3;
    assert_ok(mpm_estimate(&s, &needs));
    mpm *m = scene_make(&s, 2);
    print_message("%zu points told, %zu made, %zu in large cells\n", needs.particles, mpm_points(m), large.particles);
    assert_true(needs.particles > 1.5 * (double)large.particles && needs.work > large.work);
    assert_near((double)needs.particles / (double)mpm_points(m), 1, 0.02); /* levels are asked for in passes there */
    mpm_free(m);
}

static void gouge(gouge_scene *g, double jump)
{
    scene_gouge(g, 0.25e-3, 1500);
    mpm_scene *s = &g->scene;
    mpm_refine *plastic;
    s->levels = 3;
    s->axis[0] = scene_graded(s->axis[0], -1.5e-3, 1.5e-3, 1e-3, 1.5);
    s->axis[1] = scene_graded(s->axis[1], -1e-3, 1e-3, 1e-3, 1.5);
    s->axis[2] =
        scene_graded(scene_axis(0, 6e-3, 0.25e-3, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE), 0, 1e-3, 1e-3, 1.5);
    scene_values(s, 0)[3] = 40e-3; /* the rail goes on */
    s->zone_until = 0.5e-6;
    assert_ok(mpm_scene_add_refine(s, "plastic", &plastic));
    *mpm_refine_value(plastic, "jump") = jump;
}

/* Same bits on any number of threads, and on from a checkpoint. */
static void test_bits(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    gouge(&g, 75);
    mpm *m = scene_same_bits(&g.scene, 60, 25);
    assert_true(mpm_state(m).splits > 1000 && mpm_state(m).merges > 100);
    mpm_free(m);
}

static int at_level(const mpm *m, int level)
{
    int n = 0;
    for (int i = 0; i < m->bricks_used; i++) n += m->bricks[i].level == level ? m->bricks[i].particles : 0;
    return n;
}

/* A level that is given up empties within a few looks and stays empty, on from a checkpoint too; the books close. */
static void test_finest(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    gouge(&g, 75);
    mpm *m = scene_make(&g.scene, 2), *on = scene_make(&g.scene, 1);
    assert_ok(mpm_advance(m, 0.8e-6, NULL));
    assert_true(at_level(m, 0) > 1000);
    mpm_set_finest(m, 1);
    void *image;
    size_t bytes;
    assert_ok(mpm_save(m, &image, &bytes));
    assert_ok(mpm_restore(on, image, bytes));
    free(image);
    scene_picture p[2];
    for (int i = 0; i < 2; i++) {
        mpm *each = i ? on : m;
        assert_ok(mpm_advance(each, 3.2e-6, NULL));
        assert_int_equal(at_level(each, 0), 0);
        assert_true(at_level(each, 1) > 100);
        p[i] = scene_picture_of(each);
    }
    scene_assert_same(p[0], p[1], "from an image");
    const mpm_ledger l = mpm_balance(m);
    assert_true(fabs(l.energy_error) < 1e-9 && fabs(l.momentum_error) < 1e-12);
    for (int i = 0; i < 2; i++) free(p[i].data);
    mpm_free(m), mpm_free(on);
}

/* Points at a surface outlive the cells that they came from; below it they are joined. */
static void test_surface(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    s.levels = 3, s.zone_until = 1e-9; /* which is over at the first look */
    for (int k = 0; k < 3; k++) {
        s.axis[k] = scene_axis(0, 16e-3, 0.25e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        s.axis[k].fine_lo = 6e-3, s.axis[k].fine_hi = 10e-3;
    }
    scene_box(&s, 2e-3, 2e-3, 2e-3, 14e-3, 8.2e-3, 14e-3, &copper); /* its upper face in the zone's middle */
    mpm *m = scene_make(&s, 2);
    const size_t before = mpm_points(m);
    assert_ok(mpm_advance(m, 6e-6, NULL));
    int fine_up = 0, fine_deep = 0;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES; l++) {
                    const block *b = &m->blocks[q];
                    const bool inside = fabs(b->x[0][l] - 8e-3) < 1.5e-3 && fabs(b->x[2][l] - 8e-3) < 1.5e-3;
                    if (!(b->mass[0][l] > 0) || !inside) continue;
                    assert_int_equal(m->bricks[i].level, 2); /* nothing asks for small cells any more */
                    fine_up += b->x[1][l] > 8e-3 && b->half[1][l] < 0.1e-3;
                    fine_deep += b->x[1][l] < 7e-3 && b->half[1][l] < 0.1e-3;
                }
    print_message("%zu points, then %zu: %d small ones at the surface, %d below\n", before, mpm_points(m), fine_up,
                  fine_deep);
    assert_true(fine_up > 500 && fine_deep < 200);
    assert_true(mpm_points(m) < before);
    const mpm_ledger l = mpm_balance(m);
    assert_near(l.mass / l.mass_start, 1, 1e-12);
    mpm_free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_level_for), cmocka_unit_test(test_merge),    cmocka_unit_test(test_merge_undoes_halve),
        cmocka_unit_test(test_kinds),     cmocka_unit_test(test_mean),     cmocka_unit_test(test_zone_cell),
        cmocka_unit_test(test_nesting),   cmocka_unit_test(test_estimate), cmocka_unit_test(test_linear),
        cmocka_unit_test(test_bits),      cmocka_unit_test(test_finest),   cmocka_unit_test(test_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
