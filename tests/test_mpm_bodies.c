/* SPDX-License-Identifier: BSD-3-Clause */
/* Many bodies in many groups: how many there may be is memory's to say.  Motions that are known, the same bits on any
 * number of threads and across save and restore. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"

enum { GROUPS = 6, BODIES = 2 * GROUPS };

static const double H = 0.5e-3, LENGTH = 4e-3;

/* ---- blocks that fly side by side and never meet ---- */

static void flight(double velocity[3], int group)
{
    velocity[0] = 100 + 40 * group, velocity[1] = 10 * group, velocity[2] = group % 2 ? 25 : -25;
}

/* Each of two bodies, of two metals, welded together. */
static void flying_blocks(mpm_scene *s, const mpm_material *copper, const mpm_material *aluminium)
{
    mpm_scene_default(s);
    s->axis[0] = scene_axis(0, 8e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[1] = scene_axis(0, 4e-3 * GROUPS, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[2] = scene_axis(-2e-3, 3e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    for (int g = 0; g < GROUPS; g++)
        for (int half = 0; half < 2; half++) {
            const double x = 1e-3 + 1e-3 * half, y = 1e-3 + 4e-3 * g;
            mpm_body *b = scene_box(s, x, y, 0, x + 1e-3, y + 1e-3, 1e-3, half ? aluminium : copper);
            b->group = g;
            flight(b->velocity, g);
        }
}

static void test_flight(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper(), aluminium = scene_aluminium();
    SCENE_LOCAL(s);
    flying_blocks(&s, &copper, &aluminium);
    mpm *m = scene_same_bits(&s, 30, 30);
    const double time = mpm_state(m).time;
    for (int i = 0; i < BODIES; i++) {
        double v[3], volumes[BODIES];
        flight(v, i / 2);
        for (int k = 0; k < 3; k++) {
            const double start = scene_mean(m, MPM_start, k, i);
            assert_near(scene_mean(m, MPM_velocity, k, i), v[k], 1e-9 * v[0]); /* rounding, as all here */
            assert_near(scene_mean(m, MPM_position, k, i), start + v[k] * time, 1e-12 * LENGTH);
            assert_true(mpm_contact_force(m, i / 2)[k] == 0);
        }
        mpm_failed_volumes(m, volumes);
        assert_true(volumes[i] == 0 && mpm_body_state(m, i).peak_plastic_strain == 0);
        assert_below(mpm_body_state(m, i).peak_mises, 1e3); /* of a modulus of 7e10 Pa */
    }
    assert_below(fabs(mpm_balance(m).energy_error), 1e-12);
    mpm_free(m);
}

/* ---- a cradle: bars in a row, the first hits the others ---- */

typedef struct {
    double impulse[GROUPS], smooth[GROUPS], peak[GROUPS], all, largest, last;
} pushes;

static bool push(void *user, const mpm *m)
{
    pushes *p = user;
    const double now = mpm_glance(m).time;
    double sum = 0;
    for (int g = 0; g < GROUPS; g++) {
        const double force = mpm_contact_force(m, g)[0];
        p->impulse[g] += force * (now - p->last);
        p->smooth[g] += (1 - exp(-(now - p->last) / 0.2e-6)) * (force - p->smooth[g]); /* as mpm.h has it */
        p->peak[g] = fmax(p->peak[g], fabs(p->smooth[g]));
        p->largest = fmax(p->largest, fabs(force));
        sum += force;
    }
    p->all = fmax(p->all, fabs(sum));
    p->last = now;
    return true;
}

/* Each bar is two bodies, welded. */
static void cradle(mpm_scene *s, const mpm_material *m, double speed)
{
    scene_bar(s, -8e-3, GROUPS * LENGTH + 8e-3, H, 2);
    for (int i = 0; i < BODIES; i++) {
        mpm_body *b = scene_box(s, 0.5 * LENGTH * i, -1, -1, 0.5 * LENGTH * (i + 1), 1, 1, m);
        b->group = i / 2;
        b->velocity[0] = i < 2 ? speed : 0;
    }
}

/* Equal elastic bars: the pulse, two bars long, goes through, and the last bar flies off with the first one's velocity
 * while the others stay.  Bars of eight cells spread the pulse: the last one but one keeps a sixth of it. */
static void test_cradle(void **state)
{
    (void)state;
    const mpm_material m = scene_elastic();
    const double speed = 10;
    SCENE_LOCAL(s);
    cradle(&s, &m, speed);
    mpm *solver = scene_make(&s, 2);
    pushes p = { .last = 0 };
    assert_ok(mpm_advance(solver, 10e-6, &(mpm_sink){ push, &p }));
    const mpm_ledger l = mpm_balance(solver);
    const double bar = l.mass / GROUPS;
    double v[GROUPS];
    for (int g = 0; g < GROUPS; g++) {
        v[g] = 0.5 * (scene_mean(solver, MPM_velocity, 0, 2 * g) + scene_mean(solver, MPM_velocity, 0, 2 * g + 1));
        print_message("bar %d: %.3f m/s\n", g, v[g]);
        assert_near(p.impulse[g] / (bar * speed), (v[g] - (g == 0 ? speed : 0)) / speed, 1e-9);
        assert_near(mpm_peak_contact_force(solver, g)[0] / p.peak[g], 1, 1e-9); /* rounding of the time */
    }
    assert_near(v[GROUPS - 1], speed, 0.2 * speed);
    for (int g = 0; g < GROUPS - 2; g++) assert_near(v[g], 0, 0.01 * speed);
    assert_below(p.all, 1e-12 * p.largest); /* action and reaction */
    assert_below(l.momentum_error, 1e-12);
    assert_below(fabs(l.energy_error), 1e-12);
    mpm_free(solver);
    mpm_free(scene_same_bits(&s, 60, 60));
}

/* ---- more bodies than a byte can count ---- */

static void test_row(void **state)
{
    (void)state;
    enum { N = 300 };
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    scene_bar(&s, 0, N * H, H, 1);
    for (int i = 0; i < N; i++) scene_box(&s, i * H, -1, -1, (i + 1) * H, 1, 1, &m)->velocity[0] = i < N / 2 ? 50 : -50;
    mpm *solver = scene_same_bits(&s, 3, 3);
    double *body = scene_read(solver, MPM_body), *start = scene_read(solver, MPM_start), points = 0;
    for (size_t i = 0; i < mpm_points(solver); i++) {
        assert_int_equal((int)body[i], (int)(start[3 * i] / H));
        points += (int)body[i] == N - 1;
    }
    assert_true(points == 8);
    /* the two in the middle hit each other, those at the ends do not know yet */
    assert_true(mpm_body_state(solver, N / 2).peak_pressure > 1e9);
    assert_true(mpm_body_state(solver, 0).peak_pressure < 1e3 && mpm_body_state(solver, N - 1).peak_pressure < 1e3);
    free(body), free(start);
    mpm_free(solver);
}

/* ---- several materials in one group ---- */

/* Heat of a contact that changes no motion: no Grueneisen coefficient. */
static mpm_material conductor(double conductivity)
{
    mpm_material m = scene_elastic();
    m.gruneisen = 0, m.conductivity = conductivity;
    return m;
}

/* A block slides over a plate whose sides, z < 0 and z > 0, are of two metals. */
static mpm *rubbed(const mpm_material *left, const mpm_material *right, const mpm_material *slider)
{
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    s.axis[0] = scene_axis(0, 8e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(-1e-3, 2e-3, H, MPM_BOUNDARY_FIXED, MPM_BOUNDARY_FREE);
    s.axis[2] = scene_axis(-3e-3, 3e-3, H, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    scene_box(&s, 0, -1e-3, -4e-3, 8e-3, 0, 0, left);
    scene_box(&s, 0, -1e-3, 0, 8e-3, 0, 4e-3, right);
    mpm_body *b = scene_box(&s, 2e-3, 0, -4e-3, 5e-3, 1.5e-3, 4e-3, slider);
    b->group = 1;
    b->velocity[0] = 50;
    b->body_force[1] = -1e7;
    scene_friction(&s, 0.3);
    mpm *m = scene_make(&s, 2);
    scene_steps(m, 40);
    return m;
}

/* Internal energy of the point that started there [J/kg]. */
static double energy_of(const mpm *m, const double start[3])
{
    double *x = scene_read(m, MPM_start), *e = scene_read(m, MPM_energy), found = NAN;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (fabs(x[3 * i] - start[0]) + fabs(x[3 * i + 1] - start[1]) + fabs(x[3 * i + 2] - start[2]) < 1e-9)
            found = e[i];
    free(x), free(e);
    return found;
}

/* Two cells and more from where they meet, each metal has the share of the heat, and leaves the block that, as where
 * the whole plate is of it. */
static void test_heat_by_material(void **state)
{
    (void)state;
    const mpm_material good = conductor(400), poor = conductor(4), slider = conductor(100);
    mpm *mixed = rubbed(&good, &poor, &slider), *all_good = rubbed(&good, &good, &slider),
        *all_poor = rubbed(&poor, &poor, &slider);
    const double n = 0.5 * H; /* points' distance */
    double apart = 0, largest = 0;
    for (int side = 0; side < 2; side++)
        for (int above = 0; above < 2; above++) {
            const double start[3] = { 3e-3 + 0.5 * n, (above ? 0.5 : -0.5) * n, (side ? 1 : -1) * (2e-3 + 0.5 * n) };
            const double e[3] = { energy_of(mixed, start), energy_of(all_good, start), energy_of(all_poor, start) };
            print_message("%s of the %s plate: %.6g J/kg; all good %.6g, all poor %.6g\n", above ? "block" : "plate",
                          side ? "poor" : "good", e[0], e[1], e[2]);
            assert_near(e[0], e[1 + side], 1e-9 * fabs(e[1 + side]));
            apart = fmax(apart, fabs(e[1] - e[2])), largest = fmax(largest, fabs(e[1]));
        }
    assert_true(apart > 0.2 * largest); /* or nothing was tried */
    mpm_free(mixed), mpm_free(all_good), mpm_free(all_poor);
}

/* Bars of two metals that fly against an absorbing wall, in one group or in two. */
static void against_wall(mpm_scene *s, const mpm_material *copper, const mpm_material *aluminium, bool together)
{
    mpm_scene_default(s);
    s->axis[0] = scene_axis(-6e-3, 6e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_ABSORBING);
    s->axis[1] = scene_axis(-2e-3, 10e-3, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s->axis[2] = scene_axis(-1e-3, 1e-3, H, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    scene_box(s, 0, 0, -2e-3, 6e-3, 1e-3, 2e-3, copper)->velocity[0] = 1;
    mpm_body *b = scene_box(s, 0, 7e-3, -2e-3, 6e-3, 8e-3, 2e-3, aluminium);
    b->velocity[0] = 1;
    b->group = !together;
}

/* The wall takes from each bar what it takes where the other is of another group. */
static void test_wall_by_material(void **state)
{
    (void)state;
    const mpm_material copper = scene_elastic();
    mpm_material aluminium = scene_aluminium();
    aluminium.yield_A = 1e10, aluminium.hardening_B = 0, aluminium.rate_C = 0;
    double v[2][2];
    for (int together = 0; together < 2; together++) {
        SCENE_LOCAL(s);
        against_wall(&s, &copper, &aluminium, together);
        mpm *m = scene_make(&s, 2);
        scene_steps(m, 60);
        for (int i = 0; i < 2; i++) v[together][i] = scene_mean(m, MPM_velocity, 0, i);
        mpm_free(m);
    }
    print_message("after the wall: %.4f, %.4f m/s apart, %.4f, %.4f in one group\n", v[0][0], v[0][1], v[1][0],
                  v[1][1]);
    for (int i = 0; i < 2; i++) {
        assert_true(fabs(v[0][i]) < 0.7); /* it was felt */
        assert_near(v[1][i], v[0][i], 1e-12);
    }
}

static void test_refused(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    mpm *solver = NULL;
    scene_bar(&s, 0, 4 * H, H, 1);
    assert_int_equal(mpm_create(&s, 1, &solver).code, STATUS_BAD_INPUT); /* no body */
    const double one[] = { 0, -1, -1, H, 1, 1 };
    const int solid = scene_solid(&s, "box", one, 6, -1, -1);
    for (int i = 0; i <= MPM_BODIES_COUNTED; i++) {
        mpm_body *b;
        assert_ok(mpm_scene_add_body(&s, &b));
        strcpy(b->name, "one");
        b->material = &m, b->solid = solid;
    }
    assert_int_equal(mpm_create(&s, 1, &solver).code, STATUS_BAD_INPUT); /* one more than are told apart */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flight),
        cmocka_unit_test(test_cradle),
        cmocka_unit_test(test_row),
        cmocka_unit_test(test_heat_by_material),
        cmocka_unit_test(test_wall_by_material),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
