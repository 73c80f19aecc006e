/* SPDX-License-Identifier: BSD-3-Clause */
/* The plastic front against a closed answer: metal of known plastic power on known places, looked at as the watch over
 * a gouging scene does. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/gouge/front.h"
#include "mpm/memory/store.h"

#include <math.h>
#include <string.h>

#include "status_common.h"

static const double END = 5.5e-3;             /* of the groove [m] */
static const double H = 0.5e-3;               /* cell [m] */
static const double EDGE = 3e12, MORE = 5e12; /* plastic power densities [W/m3] */

static mpm_material copper(void)
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    strcpy(m.name, "copper");
    m.density = 8960, m.youngs_modulus = 124e9, m.poisson = 0.34, m.specific_heat = 383, m.conductivity = 386;
    m.reference_temperature = 293, m.melting_temperature = 1356;
    m.yield_A = 90e6, m.hardening_B = 292e6, m.hardening_n = 0.31, m.rate_C = 0, m.softening_m = 1, m.rate_0 = 1;
    m.sound_speed = 3940, m.hugoniot_slope = 1.489, m.gruneisen = 2.02;
    return m;
}

static void add_box(mpm_scene *s, const mpm_material *m, const double lo[3], const double hi[3], int group)
{
    mpm_body *b;
    mpm_solid *box;
    OK(mpm_scene_add_body(s, &b));
    OK(mpm_scene_add_solid(s, "box", -1, -1, &box));
    memcpy(mpm_solid_value(box, "lo"), lo, 3 * sizeof *lo);
    memcpy(mpm_solid_value(box, "hi"), hi, 3 * sizeof *hi);
    snprintf(b->name, sizeof b->name, "body %d", s->bodies);
    b->material = m, b->solid = s->solids - 1, b->group = group;
}

/* A rail from x = 0 to 8 mm, y = -2 to -1 mm, a layer on it to y = 0, an armature above; all of z = 0 to 4 mm, of which
 * 3 to 4 mm are the window's side.  The armature is body 0.  Half a model has cells half as large as the grain's. */
static gouge_scene launcher(const mpm_material *m, bool half_model)
{
    static const double lo[3] = { 0, -2e-3, -4e-3 }, hi[3] = { 8e-3, 2e-3, 4e-3 };
    gouge_scene g = {
        .rail = 1, .layers = 1, .grain = GOUGE_PIT, .armature = 0, .cell = H, .gauge_time = { 1e-6, 2e-6 }
    };
    mpm_scene *s = &g.scene;
    mpm_scene_default(s);
    s->levels = 1;
    for (int k = 0; k < 3; k++) {
        const double from = k == 2 && half_model ? 0 : lo[k];
        s->axis[k] = (mpm_axis){ .lo = from,
                                 .hi = hi[k],
                                 .fine_lo = from,
                                 .fine_hi = hi[k],
                                 .fine = half_model ? H / 2 : H,
                                 .coarse = half_model ? H / 2 : H,
                                 .growth = 1,
                                 .boundary = { half_model ? MPM_BOUNDARY_SYMMETRY : MPM_BOUNDARY_FREE } };
    }
    add_box(s, m, (const double[3]){ 0, 0, lo[2] }, hi, 1);
    add_box(s, m, lo, (const double[3]){ 8e-3, -1e-3, 4e-3 }, 0);
    add_box(s, m, (const double[3]){ 0, -1e-3, lo[2] }, (const double[3]){ 8e-3, 0, 4e-3 }, 0);
    return g;
}

/* Of the rail, over the whole width up to x = 6 mm: what the armature's edge takes; a groove from x = 2 to 5.5 mm,
 * |z| < 2.5 mm, takes more.  The armature flows everywhere. */
static double density(const double x[3])
{
    if (x[1] > 0) return 1e15;
    return (x[0] < 6e-3 ? EDGE : 0) + (x[0] > 2e-3 && x[0] < END && fabs(x[2]) < 2.5e-3 ? MORE : 0);
}

static void give_powers(mpm *m)
{
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int b = m->bricks[i].head[c]; b >= 0; b = m->links[b].next)
                for (int l = 0; l < LANES; l++) {
                    block *q = &m->blocks[b];
                    if (!(q->mass[0][l] > 0)) continue;
                    q->s[3][l] = 1e8, q->flow[0][l] = 1e8; /* in shear, it yields */
                    q->L[1][l] = density((const double[3]){ q->x[0][l], q->x[1][l], q->x[2][l] }) / 1e8;
                }
}

/* The power beyond the edge's is the groove's, whole or half a model, on any number of threads. */
static void test_front(void **state)
{
    (void)state;
    const mpm_material metal = copper();
    const double groove =
        MORE * (END - 2e-3) * 2e-3 * 2.5e-3; /* as long as it is, of rail and layer, as wide as half of it */
    for (int half = 0; half < 2; half++) {
        gouge_scene g = launcher(&metal, half);
        gouge_front one = { .peak = 1.0 }, three = { .peak = 1e9 };
        mpm *m;
        OK(mpm_create(&g.scene, 1, &m));
        give_powers(m);
        OK(gouge_front_look(&g, m, &one));
        print_message("power %.9g W of %.9g W, front %.3g mm\n", one.power, (2 - half) * groove, 1e3 * one.front);
        assert_true(fabs(one.power / ((2 - half) * groove) - 1) < 1e-9); /* rounding */
        assert_true(one.peak == one.power);
        /* within the slice, of two cells, in which a twentieth of the groove's 3.5 mm lies ahead */
        assert_true(fabs(remainder(one.front, 2 * H)) < 1e-12);
        assert_true(one.front > END - 0.05 * 3.5e-3 && one.front <= END - 0.05 * 3.5e-3 + 2 * H);
        mpm_set_threads(m, 3);
        OK(gouge_front_look(&g, m, &three));
        assert_true(three.power == one.power && three.front == one.front && three.peak == 1e9);
        mpm_free(m);
        gouge_scene_free(&g);
    }
}

/* Looks: after so many steps of the finest level, once each; none where the groove is not followed. */
static void test_due(void **state)
{
    (void)state;
    static const int levels[] = { 1, 3, 5, 8 }, every[] = { 16, 4, 1, 1 };
    gouge_scene g = { .gauge_time = { 1e-6, 2e-6 } };
    for (int i = 0; i < 4; i++)
        for (int steps = 1; steps < 40; steps++) {
            const mpm_report now = { .time = 1e-9 * steps, .steps = (uint64_t)steps };
            gouge_front before = { .time = 1e-9 * (steps - 1) }, here = { .time = now.time };
            g.scene.levels = levels[i];
            assert_true(gouge_front_is_due(&g, &now, &before) == (steps % every[i] == 0));
            assert_false(gouge_front_is_due(&g, &now, &here));
            assert_false(gouge_front_is_due(&(gouge_scene){ .scene = { .levels = 1 } }, &now, &before));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_front), cmocka_unit_test(test_due) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
