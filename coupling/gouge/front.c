/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/front.h"

#include <math.h>
#include <stdlib.h>

enum { ALONG = 0, ACROSS = 2, LOOK_EVERY = 16 }; /* axes; steps of the finest level between two looks */
static const double POWER_AHEAD = 0.05;          /* of the power lies ahead of the front */
static const double SIDES = 0.75;                /* of the window's half width; beyond it lie its sides */
static const double SLICE = 2.0;                 /* width of a slice along the rail, in cells at the grain */

bool gouge_front_is_due(const gouge_scene *s, const mpm_report *now, const gouge_front *f)
{
    const int every = LOOK_EVERY >> (s->scene.levels - 1); /* steps of the coarsest level, which the report counts */
    return gouge_is_followed(s) && now->time > f->time && now->steps % (uint64_t)(every > 1 ? every : 1) == 0;
}

/* The window's extent across: of a half model from its mirror on. */
static mpm_slices slices_of(const gouge_scene *g)
{
    const mpm_scene *s = &g->scene;
    const mpm_axis *along = &s->axis[ALONG], *across = &s->axis[ACROSS];
    const bool half_model = across->boundary[0] == MPM_BOUNDARY_SYMMETRY;
    mpm_slices p = { .along = ALONG, .across = ACROSS, .lo = along->lo, .width = SLICE * g->cell, .sides = SIDES };
    p.n = (int)((along->hi - along->lo) / p.width) + 1;
    p.middle = half_model ? across->lo : 0.5 * (across->lo + across->hi);
    p.half = across->hi - p.middle;
    return p;
}

/* Of a slice, beyond what metal takes at the window's sides. */
static double excess(const mpm_plastic_sum slice[2])
{
    const mpm_plastic_sum *middle = &slice[0], *sides = &slice[1];
    return fmax(middle->power - (sides->volume > 0.0 ? sides->power * middle->volume / sides->volume : 0.0), 0.0);
}

static void find_front(const mpm_slices *p, const mpm_plastic_sum *sums, gouge_front *f)
{
    double ahead = 0.0;
    int front = p->n - 1;
    f->power = 0.0;
    for (int i = 0; i < p->n; i++) f->power += excess(&sums[2 * i]);
    for (; front > 0; front--) {
        if (ahead + excess(&sums[2 * front]) >= POWER_AHEAD * f->power) break;
        ahead += excess(&sums[2 * front]);
    }
    f->front = p->lo + p->width * (front + 1);
    f->peak = fmax(f->peak, f->power);
}

status gouge_front_look(const gouge_scene *s, const mpm *m, gouge_front *f)
{
    const mpm_slices p = slices_of(s);
    mpm_plastic_sum *sums = calloc(2 * (size_t)p.n, sizeof *sums);
    bool *counts = calloc((size_t)s->scene.bodies, sizeof *counts);
    status done = base_status_error(STATUS_MEMORY, "no memory to find the plastic front in %d slices", p.n);
    if (sums && counts) {
        for (int i = 0; i < s->scene.bodies; i++) counts[i] = gouge_counts_as_rail(s, i);
        done = mpm_plastic_profile(m, counts, &p, sums);
    }
    if (done.code == STATUS_OK) {
        f->time = mpm_glance(m).time;
        find_front(&p, sums, f);
    }
    free(counts);
    free(sums);
    return done;
}
