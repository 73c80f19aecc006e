/* SPDX-License-Identifier: BSD-3-Clause */
/* A rail whose threshold surface is known, for random shots over it. */
#ifndef BREECH_TESTS_RAIL_COMMON_H
#define BREECH_TESTS_RAIL_COMMON_H

#include "coupling/study/sampling/montecarlo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRACE = 200 };
static const double LENGTH = 3.0, MUZZLE = 2100.0;

/* v = MUZZLE x / LENGTH; one population, one family: the threshold v_th (r / 0.5 mm)^-slope in a band +- half. */
typedef struct {
    case_onset c;
    case_population population;
    case_site site[3];
    trace_point trace[TRACE];
    shot_outcome flown;
    grain_family *family;
    int of_population[1], of_site[3];
    grain_families grains;
    scene_record record[2];
} rail;

static inline void make_rail(rail *r, double density, double median, double spread, double threshold, double slope,
                             double half)
{
    memset(r, 0, sizeof *r);
    r->population = (case_population){ .density = density,
                                       .radius_median = median,
                                       .radius_spread = spread,
                                       .aspect = 1.0,
                                       .from = 0.0,
                                       .to = LENGTH,
                                       .renewed = true };
    r->c.populations = (case_populations){ 1, &r->population };
    r->c.study.smallest_radius = 1e-4;
    for (int i = 0; i < TRACE; i++) {
        const double f = (double)i / (TRACE - 1);
        r->trace[i] = (trace_point){ .t = f, .x = LENGTH * f, .v = MUZZLE * f };
    }
    r->flown.trace = r->trace;
    r->flown.n_trace = TRACE;
    r->family = calloc(1, sizeof *r->family);
    r->family->aspect = 1.0;
    surface_result *s = &r->family->surface;
    s->sizes = 9;
    s->reference.shift = NAN;
    s->reference.cells = 3.0;
    for (int k = 0; k < 9; k++) {
        const double radius = 1e-4 * pow(10.0, 0.15 * k), v = threshold * pow(radius / 0.5e-3, -slope);
        s->size[k] = (surface_size){ .radius = radius, .velocity = v, .interval = { v - half, v + half } };
    }
    for (int k = 0; k < 2; k++) { /* crater 10 r^3 at 1000 m/s, 30 r^3 at 2000 */
        scene_result *hit = &r->record[k].entry.result;
        hit->class = hit->crater_class = DAMAGE_GOUGE;
        hit->crater_volume = (10.0 + 20.0 * k) * 0.125e-9;
        hit->rim_height = 0.25e-3;
        hit->crater_length = 4e-3;
        r->family->scene[k] = (family_scene){ 0.5e-3, 1000.0 + 1000.0 * k, 3.0, true, &r->record[k] };
    }
    r->family->n_scenes = 2;
    r->grains = (grain_families){ .c = &r->c,
                                  .flown = &r->flown,
                                  .prefix = "",
                                  .n = 1,
                                  .family = r->family,
                                  .of_site = r->of_site,
                                  .of_population = r->of_population };
}

static inline mc_surface as_new(const rail *r, int draws, double size_factor)
{
    return (mc_surface){ .grains = &r->grains, .draws = draws, .size_factor = size_factor };
}

#endif
