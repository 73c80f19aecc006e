/* The fine zone that follows the ploughing (mpm/refine/zone.c): nothing is lost, nothing depends on threads or
 * restarts, and the groove is the one of a long zone that stays. */
#include "mpm_scenes.h"

#include "coupling/gouge/crater.h"
#include "mpm/memory/store.h"

static const double H = 0.25e-3, SPEED = 1500, TIME = 4e-6;

static void followed(gouge_scene *g)
{
    scene_gouge(g, H, SPEED);
    scene_values(&g->scene, 0)[3] = 40e-3; /* the rail goes on */
    g->scene.axis[0] = scene_graded(g->scene.axis[0], -1e-3, 1.5e-3, 3 * H, 1.25);
    g->scene.body[0].followed = true;
    g->scene.follow.lead = 1.25e-3;
    g->scene.follow.speed = SPEED;
}

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

static void test_books(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    followed(&g);
    mpm *m = scene_make(&g.scene, 2);
    const double mass = mpm_balance(m).mass, fine_lo = mpm_scene_of(m)->axis[0].fine_lo;
    assert_ok(mpm_advance(m, TIME, NULL));
    const mpm_ledger l = mpm_balance(m);
    const mpm_report r = mpm_state(m);
    print_message("zone from %.2f to %.2f mm, %llu splits, %llu merges, wake %zu, energy %.1e, momentum %.1e\n",
                  1e3 * fine_lo, 1e3 * mpm_scene_of(m)->axis[0].fine_lo, (unsigned long long)r.splits,
                  (unsigned long long)r.merges, mpm_wake_of(m)->n, l.energy_error, l.momentum_error);
    assert_true(mpm_scene_of(m)->axis[0].fine_lo > fine_lo + 1.9e-3);
    assert_true(r.splits > 1000 && r.merges > 300 && mpm_wake_of(m)->n > 1000);
    assert_true(l.mass_start > 1.05 * mass && l.ejected_mass > 0.02 * mass); /* grown in ahead, left behind */
    assert_near((l.mass + l.ejected_mass) / l.mass_start, 1, 1e-12);
    assert_below(l.momentum_error, 1e-12);
    assert_below(fabs(l.energy_error), 1e-12);
    assert_int_equal(r.particles, mpm_particles(m));
    assert_true(r.plastic_time > r.time - 25 * r.dt && r.plastic_time <= r.time); /* looked at every 20 steps */
    assert_true(r.plastic_power > 0 && r.plastic_power <= r.peak_plastic_power);
    const mpm_wake *w = mpm_wake_of(m);
    for (size_t i = 0; i < w->n; i++) assert_true(w->point[i].position[0] - w->point[i].size[0] < w->until);
    mpm_free(m);
}

static void test_bits(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    followed(&g);
    mpm *m = scene_same_bits(&g.scene, 230, 90);
    assert_true(mpm_wake_of(m)->n > 0); /* the zone has moved */
    mpm_free(m);
}

/* What the armature has lost, and the power the rail takes, with a zone that follows and with a long one that stays. */
static void test_same_groove(void **state)
{
    (void)state;
    double lost[2], power[2], front[2];
    for (int i = 0; i < 2; i++) {
        GOUGE_LOCAL(g);
        followed(&g);
        if (i == 1) {
            g.scene.axis[0].hi = 14e-3;
            g.scene.axis[0].fine_hi = 9e-3;
            g.scene.follow.lead = -20e-3; /* looks at the front and stays */
            g.scene.follow.speed = 0;
        }
        mpm *m = scene_make(&g.scene, 2);
        assert_ok(mpm_advance(m, TIME, NULL));
        const double *v = NULL, *mass = NULL, *body = NULL;
        double *fields[3] = { scene_read(m, MPM_velocity), scene_read(m, MPM_mass), scene_read(m, MPM_body) };
        v = fields[0], mass = fields[1], body = fields[2];
        double moving = 0, all = 0;
        for (size_t k = 0; k < mpm_particles(m); k++)
            if (body[k] == 2) moving += mass[k] * v[3 * k], all += mass[k] * SPEED;
        lost[i] = (all - moving) / all;
        power[i] = mpm_state(m).plastic_power, front[i] = mpm_state(m).plastic_front;
        for (int k = 0; k < 3; k++) free(fields[k]);
        mpm_free(m);
    }
    print_message("momentum lost %.4f, %.4f; plastic power %.4g, %.4g W; front %.2f, %.2f mm\n", lost[0], lost[1],
                  power[0], power[1], 1e3 * front[0], 1e3 * front[1]);
    assert_near(lost[0] / lost[1], 1, 0.05);
    assert_near(power[0] / power[1], 1, 0.1);
    assert_near(front[0], front[1], 2 * H);
}

/* The rail's points as a crater is read from them: the wake, then what lies beyond it. */
static crater_points rail_points(const mpm *m)
{
    const mpm_wake *w = mpm_wake_of(m);
    const size_t live = mpm_particles(m), room = live + w->n;
    double *x = scene_read(m, MPM_position), *size = scene_read(m, MPM_size), *damage = scene_read(m, MPM_damage),
           *body = scene_read(m, MPM_body);
    double *all[3] = { malloc(3 * room * sizeof **all), malloc(3 * room * sizeof **all), malloc(room * sizeof **all) };
    size_t n = 0;
    for (size_t i = 0; i < w->n; i++, n++) {
        memcpy(all[0] + 3 * n, w->point[i].position, sizeof w->point[i].position);
        memcpy(all[1] + 3 * n, w->point[i].size, sizeof w->point[i].size);
        all[2][n] = w->point[i].damage;
    }
    for (size_t i = 0; i < live; i++) {
        double mass = 1;
        if (body[i] != 0 || !mpm_cut_at(0, w->until, true, x + 3 * i, size + 3 * i, &mass)) continue;
        memcpy(all[0] + 3 * n, x + 3 * i, 3 * sizeof *x);
        memcpy(all[1] + 3 * n, size + 3 * i, 3 * sizeof *x);
        all[2][n++] = damage[i];
    }
    double *const read[] = { x, size, damage, body };
    for (int k = 0; k < 4; k++) free(read[k]);
    return (crater_points){ .n = n, .position = all[0], .size = all[1], .damage = all[2] };
}

/* The rail moves on beyond a seam of the wake, and no crack may open there: on lines much closer than the cells the
 * groove is as deep as on the cells' own, but for what two neighbouring points differ by. */
static void test_seams(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    followed(&g);
    mpm *m = scene_make(&g.scene, 2);
    assert_ok(mpm_advance(m, TIME, NULL));
    const crater_points rail = rail_points(m);
    crater_spec spec = { .x_lo = -0.5e-3,
                         .x_hi = mpm_scene_of(m)->axis[0].fine_hi,
                         .z_hi = 1e-3,
                         .mirrored = true,
                         .particle_radius = 0.5e-3,
                         .particle_height = 0.5e-3,
                         .particle_volume = 1e-10,
                         .particle_area = 1e-6,
                         .limit_widening = 1.5 };
    double depth[2];
    for (int i = 0; i < 2; i++) {
        crater c;
        spec.cell = i ? H / 16 : H;
        assert_ok(gouge_crater_measure(&rail, &spec, &c));
        depth[i] = c.depth;
        gouge_crater_free(&c);
    }
    print_message("groove %.2f mm deep on lines of the cells, %.2f mm on lines 1/16 as far apart\n", 1e3 * depth[0],
                  1e3 * depth[1]);
    assert_true(mpm_wake_of(m)->n > 0 && depth[1] < depth[0] + 0.5 * H);
    free((void *)rail.position), free((void *)rail.size), free((void *)rail.damage);
    mpm_free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_merge), cmocka_unit_test(test_merge_undoes_halve), cmocka_unit_test(test_books),
        cmocka_unit_test(test_bits),  cmocka_unit_test(test_same_groove),        cmocka_unit_test(test_seams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
