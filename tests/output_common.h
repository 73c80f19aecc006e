/* SPDX-License-Identifier: BSD-3-Clause */
/* What the tests of the output share: example results, folders, Python. */
#ifndef BREECH_TESTS_OUTPUT_COMMON_H
#define BREECH_TESTS_OUTPUT_COMMON_H

#include "coupling/study/compare.h"
#include "coupling/study/inductance.h"
#include "coupling/study/life.h"
#include "coupling/study/strike.h"
#include "coupling/study/study.h"
#include "coupling/study/sweep.h"
#include "coupling/study/vessel.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "full_common.h"
#include "status_common.h"

/* An empty folder of that name under the test's own. */
static inline const char *fresh_folder(const char *name)
{
    char command[300];
    snprintf(command, sizeof command, "rm -rf '%s' && mkdir -p '%s'", name, name);
    assert_int_equal(system(command), 0);
    return name;
}

static inline int files_in(const char *dir, const char *suffix)
{
    int n = 0;
    DIR *d = opendir(dir);
    assert_non_null(d);
    for (const struct dirent *e; (e = readdir(d));) {
        const size_t length = strlen(e->d_name), tail = strlen(suffix);
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
        n += length >= tail && strcmp(e->d_name + length - tail, suffix) == 0;
    }
    closedir(d);
    return n;
}

/* A Python that has h5py, NULL when there is none. */
static inline const char *python_with_h5py(void)
{
    static const char *const candidates[] = { "python3", "/usr/bin/python3" };
    for (size_t i = 0; i < sizeof candidates / sizeof *candidates; i++) {
        char command[100];
        snprintf(command, sizeof command, "%s -c 'import h5py' 2>/dev/null", candidates[i]);
        if (system(command) == 0) return candidates[i];
    }
    print_message("python3-h5py is not installed\n");
    return NULL;
}

/* Runs BREECH_TESTS/script with the arguments; skips the test where there is no h5py. */
static inline void run_script(const char *script, const char *arguments)
{
    const char *python = python_with_h5py();
    if (!python) skip();
    char command[1200];
    snprintf(command, sizeof command, "%s '%s/%s' %s", python, BREECH_TESTS, script, arguments);
    assert_int_equal(system(command), 0);
}

/* ---- one result of each kind, every number different ---- */

static inline shot_record example_shot(void)
{
    return (shot_record){ .is = { .peak_current = 1.25e6,
                                  .muzzle_velocity = 2105.0,
                                  .muzzle_time = 4.1e-3,
                                  .muzzle_energy = 443e3,
                                  .efficiency = 0.083,
                                  .action = 2.7e9,
                                  .peak_acceleration = 1.1e6,
                                  .exit_current = 4.4e5,
                                  .energy_error = 3e-9,
                                  .steps = 1234,
                                  .end_time = 0.1,
                                  .end_position = 3.6,
                                  .end_velocity = 2105.0 },
                          .wall_seconds = 0.25 };
}

static inline scene_result example_scene(double severity)
{
    scene_result r;
    memset(&r, 0, sizeof r);
    r.class = severity > 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    snprintf(r.reason, sizeof r.reason, "severity %.2f, widening %.2f <&> \"limits\"", severity, 1.5 + severity);
    r.severity = severity;
    r.widening = 1.5 + severity;
    r.crater_length = 8e-3;
    r.crater_width = 3e-3;
    r.crater_depth = 0.45e-3;
    r.rim_height = 0.2e-3;
    r.crater_volume = 4e-9;
    r.peak_pressure = 12e9;
    r.max_pressure = 21e9;
    r.peak_force[0] = 3e3;
    r.peak_force[1] = -9e3;
    r.peak_temperature = 900.0;
    r.peak_mises_armature = 0.6e9;
    r.peak_mises_rail = 0.5e9;
    r.peak_mises_armature_999 = 0.55e9;
    r.peak_mises_rail_999 = 0.45e9;
    r.peak_pressure_armature_999 = 12e9;
    r.peak_pressure_rail_999 = 11e9;
    r.momentum_error = 1e-14;
    r.energy_error = -2e-3;
    r.bodies = 2;
    strcpy(r.body[0], "rail");
    strcpy(r.body[1], "armature");
    r.failed_volume[0] = 1e-9;
    r.failed_volume[1] = 2e-9;
    r.end_time = 8e-6;
    r.particles = 100000;
    r.steps = 2000;
    r.particle_steps = 150000000;
    r.particle_steps_dense = 200000000;
    r.wall_seconds = 12.0;
    r.threads = 2;
    return r;
}

enum { EXAMPLE_SITES = 6, EXAMPLE_SCENES = 4 };

typedef struct {
    onset_site site[EXAMPLE_SITES];
    onset_scene scene[EXAMPLE_SCENES];
    onset_result result;
} example_study;

static inline void example_onset(example_study *e)
{
    memset(e, 0, sizeof *e);
    for (int i = 0; i < EXAMPLE_SITES; i++)
        e->site[i] = (onset_site){ .position = 0.5 + 0.7 * i,
                                   .radius = 0.5e-3,
                                   .time = 1e-3 * (i + 1),
                                   .velocity = 600.0 + 300.0 * i,
                                   .current = 1e6,
                                   .contact_pressure = 5e7,
                                   .impact_pressure = 1e10 + 2e9 * i,
                                   .screen = 5.0 + i,
                                   .threshold_velocity = 1480.0,
                                   .threshold_interval = { 1450.0, 1510.0 },
                                   .gouged_volume = NAN,
                                   .outcome = (site_outcome)(i % 6) };
    e->site[0].velocity = e->site[0].time = e->site[0].current = NAN; /* not reached */
    for (int i = 0; i < EXAMPLE_SCENES; i++) {
        onset_scene *s = &e->scene[i];
        s->velocity = 1200.0 + 150.0 * i;
        s->radius = s->height = 0.5e-3;
        s->temperature = 300.0;
        s->contact_pressure = 5e7;
        s->cells_per_radius = i < 2 ? 3.0 : 6.0;
        snprintf(s->name, sizeof s->name, "v%.0f", s->velocity);
        strcpy(s->shape, "hemisphere");
        strcpy(s->material, "copper");
        strcpy(s->surface, "bare");
        s->result = example_scene(-0.3 + 0.2 * i);
    }
    e->result = (onset_result){ .verdict = VERDICT_GOUGES,
                                .reason = "bracketed",
                                .probability_gouge = 1.0,
                                .threshold_velocity = 1480.0,
                                .threshold_interval = { 1450.0, 1510.0 },
                                .onset_position = 2.5,
                                .onset_interval = { 2.4, 2.7 },
                                .scenes_run = 4,
                                .scenes_skipped = 2,
                                .n_sites = EXAMPLE_SITES,
                                .n_scenes = EXAMPLE_SCENES,
                                .site = e->site,
                                .scene = e->scene,
                                .wall_seconds = 200.0 };
}

/* What a run of each study may leave, in study.def's order; whoever adds a study adds its example here. */
typedef struct {
    shot_record shot;
    scene_result scene;
    example_study study;
    compare_result compare;
    inductance_result inductance;
    sweep_result sweep;
    strike_result strike;
    life_result life;
    vessel_answer vessel;
    study_answer answer[STUDIES];
} example_results;

static inline compare_result example_compare(void)
{
    static const compare_entry ranking[] = { { .surface = "hardened",
                                               .threshold_velocity = 1700.0,
                                               .threshold_interval = { 1650.0, 1750.0 },
                                               .onset_position = NAN,
                                               .gouged_volume = 0.0 },
                                             { .surface = "bare",
                                               .threshold_velocity = 1480.0,
                                               .threshold_interval = { 1450.0, 1510.0 },
                                               .onset_position = 2.5,
                                               .gouged_volume = 3e-9 } };
    return (compare_result){ .verdict = "fewest gouges: hardened; untreated cannot be told from it",
                             .n = 2,
                             .ranking = ranking };
}

static inline inductance_result example_inductance(void)
{
    static const double frequency[] = { 10.0, 1e3, 1e5 }, gradient[] = { 0.6e-6, 0.55e-6, 0.5e-6 };
    return (inductance_result){ .n = 3,
                                .frequency = frequency,
                                .L_gradient = gradient,
                                .R_gradient = gradient,
                                .L_gradient_high_frequency = 0.49e-6,
                                .n_perimeter = 3,
                                .perimeter = frequency,
                                .perimeter_current = gradient,
                                .perimeter_heat = gradient };
}

static inline sweep_result example_sweep(void)
{
    static const summary_pair unit[] = { { "scene.cells_per_radius", "1", NAN }, { "severity", "1", NAN } },
                              inputs[2][1] = { { { "scene.cells_per_radius", NULL, 2.0 } },
                                               { { "scene.cells_per_radius", NULL, 3.0 } } },
                              outputs[2][1] = { { { "severity", NULL, 0.5 } }, { { "severity", NULL, 0.4 } } },
                              errors[2][1] = { { { "severity", NULL, 0.25 } }, { { "severity", NULL, 0.0 } } };
    static const sweep_run runs[] = { { 1, 1, 1, inputs[0], outputs[0], errors[0], 2.0 },
                                      { 1, 1, 1, inputs[1], outputs[1], errors[1], 7.0 } };
    return (sweep_result){
        .of = "scene", .resolution = "scene.cells_per_radius", .n_units = 2, .n_runs = 2, .units = unit, .run = runs
    };
}

static inline void example_fill(example_results *e)
{
    memset(e, 0, sizeof *e);
    e->shot = example_shot();
    e->scene = example_scene(0.4);
    example_onset(&e->study);
    e->compare = example_compare();
    e->inductance = example_inductance();
    e->sweep = example_sweep();
    e->strike.is = (strike_outcome){ .muzzle_velocity = 1950.0,
                                     .impact_velocity = 1930.0,
                                     .class = STRIKE_PIERCED,
                                     .residual_velocity = 1500.0,
                                     .hole_diameter = NAN,
                                     .gone = true };
    e->life = (life_result){ .peak_pressure = 1e9,
                             .life_first = 5890.0,
                             .crack = { .life = 17900.0, .position = 1.65e-3, .cuts = 3478, .solves = 104 },
                             .first = { .range = 4.9e-3, .position = NAN, .depth = 1e-4, .angle = 0.6 } };
    e->vessel.is = (vessel_result){ .burst = true,
                                    .rupture = { .time = 0.75, .swelling = 1.42, .pressure = 148e3, .damage = 1.0 },
                                    .vent_time = 3e-5,
                                    .steps = 250 };
    e->answer[STUDY_shot].result = &e->shot;
    e->answer[STUDY_scene].result = &e->scene;
    e->answer[STUDY_onset] = (study_answer){ .result = &e->study.result, .shot = &e->shot };
    e->answer[STUDY_compare] = (study_answer){ .result = &e->compare, .shot = &e->shot };
    e->answer[STUDY_inductance].result = &e->inductance;
    e->answer[STUDY_sweep].result = &e->sweep;
    e->answer[STUDY_strike] = (study_answer){ .result = &e->strike, .shot = &e->shot };
    e->answer[STUDY_life].result = &e->life;
    e->answer[STUDY_vessel].result = &e->vessel;
}

#endif
