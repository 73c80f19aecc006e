/* Nested grids (mpm/grid/grid.c, seams.c): nothing may tell that two levels meet but the size of the cells.  Tolerances
 * are rounding, as in test_mpm_flight. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

static const double ROUNDING = 1e-12;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * ((double)rand() / RAND_MAX);
}

static int whole(int lo, int hi)
{
    return lo + rand() % (hi - lo + 1);
}

/* ---- the grids ---- */

/* Room between the fine zone and an end of the window that it does not reach: as little as mpm/grid/grid.h says, or
 * more; a whole number of cells or not. */
static double any_room(int levels, double h)
{
    const double least = mpm_grids_margin(levels, h);
    return rand() % 4 ? least + h * (rand() % 2 ? whole(0, 30) : uniform(0, 30)) : least;
}

/* A fine zone of an even number of cells, anywhere or where zero is one of the grid's nodes; now and then it reaches an
 * end of the window, or both. */
static mpm_axis any_axis(int levels)
{
    const double h = uniform(0.1e-3, 1e-3), fine_lo = rand() % 2 ? 2 * h * whole(-10, 10) : uniform(-5e-3, 5e-3);
    const double below = rand() % 3 ? any_room(levels, h) : 0, above = rand() % 3 ? any_room(levels, h) : 0;
    const double length = (below > 0 || above > 0 ? 2 : 4) * h * whole(2, 20); /* it may fill the window */
    return (mpm_axis){ .lo = fine_lo - below,
                       .hi = fine_lo + length + above,
                       .fine_lo = fine_lo,
                       .fine_hi = fine_lo + length,
                       .fine = h,
                       .coarse = 8 * h,
                       .growth = uniform(1.2, 2) };
}

/* Every node of a box lies on one of the coarser grid or half-way between two, and the finest box is the fine zone. */
static void test_nodes(void **state)
{
    (void)state;
    srand(3);
    for (int trial = 0; trial < 2000; trial++) {
        SCENE_LOCAL(s);
        grids g;
        mpm_scene_default(&s);
        s.levels = whole(2, MPM_MAX_LEVELS);
        for (int k = 0; k < 3; k++) s.axis[k] = any_axis(s.levels);
        assert_ok(mpm_grids_make(&s, &g));
        for (int k = 0; k < 3; k++) {
            const axis *fine = &g.level[0].axes[k];
            const double tiny = 1e-9 * s.axis[k].fine;
            assert_near(fine->node[1], s.axis[k].fine_lo, tiny);
            assert_near(fine->node[fine->last], s.axis[k].fine_hi, tiny);
            for (int i = 1; i < fine->last; i++) assert_near(axis_right(fine, i), s.axis[k].fine, tiny);
            for (int i = 0; i + 1 < g.levels; i++) {
                const grid_level *f = &g.level[i];
                const axis *c = &g.level[i + 1].axes[k], *a = &f->axes[k];
                assert_int_equal(f->seam[k][0], f->lo[k] > 1);
                assert_int_equal(f->seam[k][1], f->hi[k] < c->last);
                /* nodes that are followed follow nobody (seams.c) */
                assert_true(i == 0 || !f->seam[k][0] || g.level[i - 1].lo[k] - 1 > 1);
                assert_true(i == 0 || !f->seam[k][1] || g.level[i - 1].hi[k] + 1 < a->last);
                if (f->seam[k][0]) assert_near(a->edge[1], a->node[1], 0); /* a seam cuts the cell of its node */
                if (f->seam[k][1]) assert_near(a->edge[a->last + 1], a->node[a->last], 0);
                for (int n = f->seam[k][0] ? 0 : 1; n <= a->last + f->seam[k][1]; n++) {
                    const int at = f->lo[k] + (n + 1) / 2 - 1; /* at or below it */
                    assert_near(a->node[n], n % 2 ? c->node[at] : 0.5 * (c->node[at] + c->node[at + 1]), tiny);
                }
            }
            assert_near(g.level[g.levels - 1].axes[k].node[1], s.axis[k].lo, 0);
        }
        mpm_grids_free(&g);
    }
}

static void test_refused(void **state)
{
    (void)state;
    SCENE_LOCAL(s);
    grids g;
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++)
        s.axis[k] = scene_graded(scene_axis(0, 40e-3, 1e-3, BOUNDARY_FREE, BOUNDARY_FREE), 16e-3, 24e-3, 4e-3, 1.5);
    s.levels = 2;
    mpm_scene bad[5] = { s, s, s, s, s };
    bad[0].levels = 0, bad[1].levels = MPM_MAX_LEVELS + 1, bad[2].basis = BASIS_BSPLINE;
    bad[3].axis[1].fine_hi = 25e-3, bad[4].axis[2].fine_hi = 18e-3;
    for (int i = 0; i < 5; i++) assert_int_equal(mpm_grids_make(&bad[i], &g).code, STATUS_BAD_INPUT);
    assert_ok(mpm_grids_make(&s, &g));
    mpm_grids_free(&g);
}

/* ---- fields ---- */

static void cube(mpm_scene *s, const material *m, int levels)
{
    mpm_scene_default(s);
    s->levels = levels;
    for (int k = 0; k < 3; k++) {
        s->axis[k] = scene_axis(0, k ? 20e-3 : 40e-3, 0.5e-3, BOUNDARY_FREE, BOUNDARY_FREE);
        s->axis[k] = scene_graded(s->axis[k], k ? 7e-3 : 12e-3, k ? 11e-3 : 18e-3, 4e-3, 2);
    }
    scene_box(s, 3.3e-3, 3.3e-3, 3.3e-3, 9.3e-3, 9.3e-3, 9.3e-3, m);
}

/* A motion that is linear in space, and carried along the boxes meanwhile, stays what it was at all points, with a
 * gradient and no heat, wherever the levels meet: P is exact for it, and so is what a coarser level shows a finer one
 * amid its step. */
static void test_linear(void **state)
{
    (void)state;
    static const double CARRIED = 1000, RATE = 1e3, STEP = 3e-13; /* [m/s, 1/s, s]: it turns and stretches by 3e-10 */
    const material copper = scene_copper();
    for (int levels = 2; levels <= MPM_MAX_LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        s.viscosity_linear = s.viscosity_quadratic = 0; /* else there is stress at once */
        for (int i = 0; i < 3; i++) scene_values(&s, 0)[i] = 1e-3, scene_values(&s, 0)[3 + i] = 19e-3;
        mpm *m = scene_make(&s, 2);
        double L[9], at_level[MPM_MAX_LEVELS] = { 0 };
        srand(4);
        for (int i = 0; i < 9; i++) L[i] = RATE * uniform(-1, 1);
        for (int i = 0; i < m->bricks_used; i++)
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) {
                    block *b = &m->blocks[q];
                    for (int l = 0; l < LANES; l++)
                        for (int k = 0; k < 3; k++) {
                            b->v[k][l] = CARRIED;
                            for (int j = 0; j < 3; j++)
                                b->L[3 * k + j][l] = L[3 * k + j], b->v[k][l] += L[3 * k + j] * b->x[j][l];
                        }
                }
        m->dt = STEP;
        assert_ok(mpm_advance(m, STEP, NULL));
        double worst = 0, worst_L = 0;
        for (int i = 0; i < m->bricks_used; i++)
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) {
                    const block *b = &m->blocks[q];
                    for (int l = 0; l < LANES; l++) {
                        if (!(b->mass[0][l] > 0)) continue;
                        at_level[m->bricks[i].level]++;
                        for (int k = 0; k < 3; k++) {
                            double v = CARRIED;
                            for (int j = 0; j < 3; j++) {
                                v += L[3 * k + j] * b->start[j][l];
                                worst_L = fmax(worst_L, fabs(b->L[3 * k + j][l] - L[3 * k + j]) / RATE);
                            }
                            worst = fmax(worst, fabs(b->v[k][l] - v) / CARRIED);
                        }
                    }
                }
        print_message("%d levels: %.0f, %.0f, %.0f points; linear velocity to %.1e, its gradient to %.1e\n", levels,
                      at_level[0], at_level[1], at_level[2], worst, worst_L);
        for (int i = 0; i < levels; i++) assert_true(at_level[i] > 500);
        assert_below(worst, ROUNDING);
        assert_below(worst_L, 1e-8);
        mpm_free(m);
    }
}

/* Each level makes the steps that its cells allow: a quarter, a half and the whole of the coarsest's. */
static void test_paces(void **state)
{
    (void)state;
    const material copper = scene_copper();
    double dt[MPM_MAX_LEVELS];
    for (int levels = 1; levels <= MPM_MAX_LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        for (int i = 0; i < 3; i++) scene_values(&s, 0)[i] = 1e-3, scene_values(&s, 0)[3 + i] = 19e-3;
        mpm *m = scene_make(&s, 2);
        uint64_t want = 0;
        for (int i = 0; i < m->bricks_used; i++)
            want += (uint64_t)m->bricks[i].particles << (levels - 1 - m->bricks[i].level);
        dt[levels - 1] = mpm_state(m).dt;
        scene_steps(m, 5);
        const mpm_report r = mpm_state(m);
        print_message("%d levels: %zu points, %llu points' steps in 5 of %.3g s\n", levels, r.particles,
                      (unsigned long long)r.particle_steps, dt[levels - 1]);
        assert_int_equal(r.steps, 5);
        assert_int_equal(r.particle_steps, 5 * want); /* nothing moves */
        assert_near(dt[levels - 1], dt[0] * (1 << (levels - 1)), 1e-12 * dt[0]);
        mpm_free(m);
    }
}

/* A cube flies through all levels, in and out again: split and put from one to the other, and nothing else happens to
 * it. */
static void test_flight(void **state)
{
    (void)state;
    const material copper = scene_copper();
    for (int levels = 2; levels <= MPM_MAX_LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        mpm_body *b = &s.body[0];
        b->velocity[0] = 900, b->velocity[1] = 200, b->velocity[2] = -100;
        mpm *m = scene_make(&s, 2);
        const double K0 = mpm_material_bulk_modulus(&copper), x0 = scene_mean(m, MPM_position, 0, -1);
        assert_ok(mpm_advance(m, scene_full() ? 28e-6 : 14e-6, NULL));
        const mpm_ledger l = mpm_balance(m);
        const mpm_report r = mpm_state(m);
        const double way = scene_mean(m, MPM_position, 0, -1) - x0;
        print_message(
            "%d levels: %.1f mm, %llu splits, stress / K0 %.1e, kinetic energy %.1e, momentum %.1e, energy %.1e\n",
            levels, 1e3 * way, (unsigned long long)r.splits, scene_largest(m, MPM_stress) / K0,
            l.kinetic / l.kinetic_start - 1, l.momentum_error, l.energy_error);
        assert_true(r.splits > 1000 && way > 9e-3);
        assert_below(scene_largest(m, MPM_stress) / K0, ROUNDING);
        assert_near(l.kinetic / l.kinetic_start, 1, ROUNDING);
        assert_near(l.mass / l.mass_start, 1, ROUNDING);
        assert_below(l.momentum_error, ROUNDING);
        assert_near(l.energy_error, 0, ROUNDING);
        assert_near(way / (900 * r.time), 1, ROUNDING);
        mpm_free(m);
    }
}

/* Past an end of the window that the boxes reach: what goes out there, out of cells of any size, is booked, and so is
 * what the end does to the rest.  A mirror that does not act on the cube does nothing to it. */
static void test_ends(void **state)
{
    (void)state;
    static const struct {
        boundary_kind kind;
        bool passes;
    } ends[] = { { BOUNDARY_FREE, false },
                 { BOUNDARY_ABSORBING, false },
                 { BOUNDARY_FIXED, false },
                 { BOUNDARY_SYMMETRY, false },
                 { BOUNDARY_SYMMETRY, true } };
    const material copper = scene_copper();
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++)
        for (int levels = 2; levels <= MPM_MAX_LEVELS; levels++) {
            SCENE_LOCAL(s);
            cube(&s, &copper, levels);
            for (int k = 1; k < 3; k++)
                s.axis[k] = scene_graded(s.axis[k], k == 1 ? 0 : 16e-3, k == 1 ? 4e-3 : 20e-3, 4e-3, 2);
            s.axis[1].boundary[0] = s.axis[2].boundary[1] = ends[i].kind;
            s.body[0].passes[2] = s.body[0].passes[5] = ends[i].passes;
            double *box = scene_values(&s, 0);
            box[1] = 0, box[4] = 3e-3, box[2] = 15e-3, box[5] = 20e-3;
            s.body[0].velocity[0] = 900, s.body[0].velocity[1] = -100, s.body[0].velocity[2] = 100;
            mpm *m = scene_make(&s, 2);
            assert_ok(mpm_advance(m, 9e-6, NULL));
            const mpm_ledger l = mpm_balance(m);
            print_message("end %zu, %d levels: %.1e of the mass left, mass %.1e, energy %.1e, momentum %.1e\n", i,
                          levels, l.ejected_mass / l.mass_start, (l.mass + l.ejected_mass) / l.mass_start - 1,
                          l.energy_error, l.momentum_error);
            const bool open = ends[i].kind == BOUNDARY_FREE || ends[i].passes;
            assert_int_equal(l.ejected_mass > 0.01 * l.mass_start, open);
            assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
            assert_below(l.momentum_error, ROUNDING);
            assert_near(l.energy_error, 0, ROUNDING);
            mpm_free(m);
        }
}

/* ---- the gouge ---- */

static void gouge(gouge_scene *g, int levels)
{
    scene_gouge(g, 0.25e-3, 1500);
    mpm_scene *s = &g->scene;
    s->levels = levels;
    s->axis[0] = scene_graded(s->axis[0], -1e-3, 2e-3, 1.5e-3, 1.5);
    s->axis[1] = scene_graded(s->axis[1], -1e-3, 1e-3, 1e-3, 1.5);
    s->axis[2] = scene_graded(scene_axis(0, 6e-3, 0.25e-3, BOUNDARY_SYMMETRY, BOUNDARY_FREE), 0, 1e-3, 1e-3, 1.5);
    scene_values(s, 0)[3] = 40e-3; /* the rail goes on */
    s->body[0].followed = true;
    s->follow.lead = 1.25e-3, s->follow.speed = 1500, s->follow.width = 1.5e-3;
}

/* The zone follows and widens, points go from level to level, are split and merged: the books close. */
static void test_books(void **state)
{
    (void)state;
    for (int levels = 2; levels <= MPM_MAX_LEVELS; levels++) {
        GOUGE_LOCAL(g);
        gouge(&g, levels);
        mpm *m = scene_make(&g.scene, 2);
        const mpm_axis across = mpm_scene_of(m)->axis[2];
        assert_ok(mpm_advance(m, 4e-6, NULL));
        const mpm_ledger l = mpm_balance(m);
        const mpm_report r = mpm_state(m);
        print_message(
            "%d levels: zone 0 .. %.2f mm across, then %.2f, %llu splits, %llu merges, energy %.1e, momentum %.1e\n",
            levels, 1e3 * across.fine_hi, 1e3 * mpm_scene_of(m)->axis[2].fine_hi, (unsigned long long)r.splits,
            (unsigned long long)r.merges, l.energy_error, l.momentum_error);
        assert_true(mpm_scene_of(m)->axis[2].fine_hi > across.fine_hi);
        assert_true(r.splits > 1000);
        assert_true(r.merges > 3500); /* 2700 to 3200 when points are merged only where the zone moves */
        assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, ROUNDING);
        assert_below(l.momentum_error, ROUNDING);
        assert_near(l.energy_error, 0, ROUNDING);
        assert_int_equal(r.particles, mpm_particles(m));
        mpm_free(m);
    }
}

/* A model of both halves widens on both sides, by whole cells, and no further than the nearer end of the window allows.
 */
static void test_widening(void **state)
{
    (void)state;
    static const struct {
        double lo, widest, want; /* [m] */
    } cases[] = {
        { -6e-3, 1.5e-3, 1.5e-3 }, { -6e-3, 1.4e-3, 1e-3 }, { -1.3e-3, 1.5e-3, 1e-3 }, { -2e-3, 1.5e-3, 1.5e-3 }
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        GOUGE_LOCAL(g);
        gouge(&g, 2);
        mpm_axis *z = &g.scene.axis[2];
        z->lo = cases[i].lo, z->fine_lo = -z->fine_hi, z->boundary[0] = BOUNDARY_FREE;
        g.scene.follow.width = cases[i].widest;
        mpm_needs needs;
        assert_ok(mpm_estimate(&g.scene, &needs));
        mpm_scene wide = g.scene;
        wide.axis[2].fine_lo = -cases[i].want, wide.axis[2].fine_hi = cases[i].want;
        mpm *m = scene_make(&wide, 2);
        assert_int_equal(needs.particles[1], mpm_particles(m));
        mpm_free(m);
        m = scene_make(&g.scene, 2);
        assert_int_equal(needs.particles[0], mpm_particles(m));
        double work = 0; /* of the two levels' steps */
        for (int k = 0; k < m->bricks_used; k++) work += m->bricks[k].particles * (m->bricks[k].level ? 0.5 : 1);
        assert_near(needs.work[0] / work, 1, 1e-12);
        assert_true(needs.work[1] >= needs.work[0] && needs.bytes[1] >= needs.bytes[0]);
        assert_ok(mpm_zone_follow(m)); /* nothing yields yet */
        assert_near(mpm_scene_of(m)->axis[2].fine_hi, 1e-3, 0);
        for (int k = 0; k < m->bricks_used; k++) /* all of the rail in the zone yields as far as z = 0.8 mm */
            for (int c = 0; c < BRICK_CELLS; c++)
                for (int q = m->bricks[k].head[c]; q >= 0; q = m->links[q].next)
                    for (int l = 0; l < LANES; l++) {
                        block *b = &m->blocks[q];
                        if (fabs(b->x[2][l]) < 0.8e-3) b->s[3][l] = b->flow[0][l], b->L[1][l] = 1e3;
                    }
        assert_ok(mpm_zone_follow(m));
        const mpm_axis now = mpm_scene_of(m)->axis[2];
        print_message("window from %.1f mm, at most %.1f mm: %.2f .. %.2f mm\n", 1e3 * z->lo, 1e3 * cases[i].widest,
                      1e3 * now.fine_lo, 1e3 * now.fine_hi);
        assert_near(now.fine_hi, cases[i].want, 1e-9);
        assert_near(now.fine_lo, -cases[i].want, 1e-9);
        mpm_free(m);
    }
}

/* Two bodies that meet in the boxes' middle: nodes that both reach have all that contact asks for, whichever level it
 * came from. The flow stress is one everywhere. */
static void test_contact_sums(void **state)
{
    (void)state;
    const material copper = scene_copper();
    for (int i = 0; i < 12; i++) {
        const int levels = 2 + i % 2;
        const double y = 7.25e-3 + 0.3e-3 * i; /* where they meet, among the cells and bricks of the boxes */
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        const double low[6] = { 1e-3, 1e-3, 1e-3, 39e-3, y, 19e-3 }, high[6] = { 1e-3, y, 1e-3, 39e-3, 19e-3, 19e-3 };
        memcpy(scene_values(&s, 0), low, sizeof low);
        scene_box(&s, high[0], high[1], high[2], high[3], high[4], high[5], &copper)->group = 1;
        mpm *m = scene_make(&s, 2);
        m->dt = 1e-15; /* so that nothing moves */
        assert_ok(mpm_advance(m, 1e-15, NULL));
        int shared = 0;
        double worst = 0;
        for (int k = 0; k < m->bricks_used; k++) {
            const brick *b = &m->bricks[k], *other = NULL;
            const int o = brick_at(m, !b->group, b->level, b->at);
            if (o >= 0) other = &m->bricks[o];
            for (int c = 0; c < BRICK_CELLS && b->at_seam && other; c++) {
                const double *line = b->line[c], *extra = b->line[BRICK_CELLS + c];
                if ((b->seam.follow_coarser | b->seam.follow_finer) >> c & 1 || !(line[0] > 0 && other->line[c][0] > 0))
                    continue;
                shared++;
                assert_true(b->across && other->across);
                worst = fmax(worst, fabs(extra[6] / (line[0] * m->laws[b->group].flow_start) - 1));
            }
        }
        print_message("%d levels, meeting at %.2f mm: %d nodes of both, flow stress to %.1e\n", levels, 1e3 * y, shared,
                      worst);
        assert_true(shared > 100);
        assert_below(worst, ROUNDING);
        mpm_free(m);
    }
}

/* Every brick's flags, found out again, are what they were. */
static void hold_known(mpm *m)
{
    const int n = m->bricks_used;
    bool(*was)[2] = calloc((size_t)n, sizeof *was);
    assert_non_null(was);
    for (int i = 0; i < n; i++) was[i][0] = m->bricks[i].contact, was[i][1] = m->bricks[i].across;
    assert_ok(mpm_store_relink(m));
    for (int i = 0; i < n; i++) {
        const brick *b = &m->bricks[i];
        if (was[i][0] != b->contact || was[i][1] != b->across)
            fail_msg("step %d, brick %d of level %d: contact %d, across %d; found out again %d, %d", (int)m->steps, i,
                     b->level, was[i][0], was[i][1], b->contact, b->across);
    }
    free(was);
}

/* What a brick knows of the other groups around it follows from where particles are now, or a run that goes on from a
 * checkpoint would know other things than one without a stop.  A slab flies past a cube, into its bricks' neighbours
 * and out of them. */
static void test_known(void **state)
{
    (void)state;
    const material copper = scene_copper();
    for (int levels = 1; levels <= MPM_MAX_LEVELS; levels++) {
        SCENE_LOCAL(s);
        cube(&s, &copper, levels);
        mpm_body *slab = scene_box(&s, 2e-3, 9.6e-3, 4e-3, 4e-3, 11e-3, 8e-3, &copper);
        slab->group = 1, slab->velocity[0] = 4000;
        mpm *m = scene_make(&s, 2);
        for (int step = 0; step < 120; step++) {
            scene_steps(m, 1);
            hold_known(m);
        }
        const double way = 4000 * mpm_state(m).time;
        print_message("%d levels: %.1f mm past the cube\n", levels, 1e3 * way);
        assert_true(way > 12e-3);
        mpm_free(m);
    }
}

static void test_bits(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    gouge(&g, 3);
    mpm *m = scene_same_bits(&g.scene, 230, 90);
    assert_true(mpm_wake_of(m)->n > 0);
    mpm_free(m);
}

/* The power that ploughs the rail and what the armature has lost, with fine cells all around and with levels. */
static void test_same_groove(void **state)
{
    (void)state;
    double power[MPM_MAX_LEVELS], lost[MPM_MAX_LEVELS];
    for (int levels = 1; levels <= MPM_MAX_LEVELS; levels++) {
        GOUGE_LOCAL(g);
        gouge(&g, levels);
        mpm *m = scene_make(&g.scene, 2);
        assert_ok(mpm_advance(m, 3e-6, NULL));
        power[levels - 1] = mpm_state(m).plastic_power;
        lost[levels - 1] = 1 - scene_mean(m, MPM_velocity, 0, 2) / 1500;
        print_message("%d levels: %zu points, power %.4g W, velocity lost %.4f\n", levels, mpm_particles(m),
                      power[levels - 1], lost[levels - 1]);
        mpm_free(m);
        assert_near(power[levels - 1] / power[0], 1,
                    levels < 3 ? 0.15 : 0.35); /* with three the scene is but a few cells wide */
        assert_near(lost[levels - 1] / lost[0], 1, 0.1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nodes), cmocka_unit_test(test_refused),  cmocka_unit_test(test_linear),
        cmocka_unit_test(test_paces), cmocka_unit_test(test_flight),   cmocka_unit_test(test_ends),
        cmocka_unit_test(test_books), cmocka_unit_test(test_widening), cmocka_unit_test(test_contact_sums),
        cmocka_unit_test(test_known), cmocka_unit_test(test_bits),     cmocka_unit_test(test_same_groove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
