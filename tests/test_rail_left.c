/* SPDX-License-Identifier: BSD-3-Clause */
/* What a shot does to the rail's surface (coupling/study/rail_left.h): closed answers of (O-6) and (O-7) on a made-up
 * flight, and layers worn one after the other. */
#include "coupling/study/rail_left.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "status_common.h"

static const double LENGTH = 3.0, START = 0.1, FACE = 0.016, WIDTH = 0.025, FORCE = 2e4, DENSITY = 2700.0;

static case_onset made_up(mpm_material *metal)
{
    case_onset c;
    memset(&c, 0, sizeof c);
    c.launcher.barrel = (circuit_shot_barrel){ .length = LENGTH, .start = START };
    c.launcher.rails.height = WIDTH;
    c.launcher.rails.count = 2;
    c.launcher.armature.contact_width = NAN; /* then the rail's height */
    c.launcher.armature.contact_length = FACE;
    c.launcher.armature.density = 1.0; /* the scenes' metal counts */
    memset(metal, 0, sizeof *metal);
    snprintf(metal->name, sizeof metal->name, "metal");
    metal->density = DENSITY;
    snprintf(c.impact.armature.material, sizeof c.impact.armature.material, "metal");
    c.impact.materials = (case_materials){ 1, metal };
    return c;
}

/* Force as given, 8 g melted evenly from 1 to 2 m and nowhere else; it stops at 2.5 m. */
static void test_made_up_flight(void **state)
{
    (void)state;
    static const double MASS = 8e-3, STOP = 2.5;
    mpm_material metal;
    const case_onset c = made_up(&metal);
    enum { STEPS = 2401 };
    trace_point trace[STEPS];
    for (int i = 0; i < STEPS; i++) {
        const double x = START + (STOP - START) * i / (STEPS - 1);
        trace[i] = (trace_point){ .t = x, .x = x, .v = 1.0, .pressure = FORCE / (FACE * WIDTH) };
        trace[i].melted = MASS * fmin(fmax(x - 1.0, 0.0), 1.0);
    }
    const shot_outcome flown = { .n_trace = STEPS, .trace = trace };
    rail_left *left = malloc(sizeof *left);
    assert_non_null(left);
    study_rail_left_of(&c, &flown, left);
    const double deep = MASS / 1.0 / (2.0 * DENSITY * WIDTH); /* both rails, a metre */
    double sum = 0.0;
    for (int k = 0; k <= MC_PLACES; k++) {
        const double x = LENGTH * k / MC_PLACES, off = fmin(fabs(x - 1.0), fabs(x - 2.0));
        const bool slid = x >= START && x <= STOP;
        assert_true(fabs(left->pressed[k] - (slid ? FORCE / WIDTH : 0.0)) < 1e-9 * FORCE / WIDTH);
        if (off > FACE) assert_true(fabs(left->metal[k] - (x > 1.0 && x < 2.0 ? deep : 0.0)) < 1e-9 * deep);
        sum += left->metal[k] * 2.0 * DENSITY * WIDTH * LENGTH / MC_PLACES;
    }
    assert_true(fabs(sum / MASS - 1.0) < 1e-3); /* ends of 16 mm by places of 3 mm */
    free(left);
}

static void test_layers(void **state)
{
    (void)state;
    case_layer list[3] = { { .thickness = 50e-6, .wear_rate = 1e-13 },
                           { .thickness = 20e-6, .wear_rate = 4e-12 },
                           { .thickness = 10e-6, .wear_rate = 1e-12 } };
    case_layers l = { 3, list }, left;
    static const struct {
        double pressed, gone;
        int layers;
        double top; /* thickness of the highest that is left */
    } all[] = { { 0.0, 0.0, 3, 10e-6 },      { 4e6, 4e-6, 3, 6e-6 },     { 1e7, 10e-6, 2, 20e-6 },
                { 1.25e7, 20e-6, 2, 10e-6 }, { 1.5e7, 30e-6, 1, 50e-6 }, { 1.15e8, 40e-6, 1, 40e-6 },
                { 5.1e8, 79.5e-6, 0, 0.0 }, /* thinner than a case may give */
                { 1e12, 80e-6, 0, 0.0 } };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const double gone = study_layers_worn(&l, all[i].pressed);
        assert_true(fabs(gone - all[i].gone) < 1e-15);
        OK(study_layers_without(&l, gone, &left));
        assert_int_equal(left.n, all[i].layers);
        if (left.n > 0) assert_true(fabs(left.item[left.n - 1].thickness - all[i].top) < 1e-15);
        if (left.n > 1) assert_true(left.item[0].thickness == 50e-6 && left.item[0].wear_rate == 1e-13);
        free(left.item);
    }
    list[1].wear_rate = NAN; /* stays, and keeps what is below it */
    assert_true(study_layers_worn(&l, 1e12) == 10e-6);
    list[2].wear_rate = 0.0;
    assert_true(study_layers_worn(&l, 1e12) == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_made_up_flight), cmocka_unit_test(test_layers) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
