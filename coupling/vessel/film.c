/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/vessel/film.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>

double vessel_volume(int dimension, double radius)
{
    return dimension == 2 ? PI * radius * radius : 4.0 / 3.0 * PI * radius * radius * radius;
}

double vessel_radius(int dimension, double volume)
{
    return dimension == 2 ? sqrt(volume / PI) : cbrt(0.75 * volume / PI);
}

status vessel_film_make(const mpm_point_law *law, int dimension, int layers, double inner, double outer, film *f)
{
    *f = (film){ .law = law, .dimension = dimension, .layers = layers, .inner = inner, .outer = outer };
    f->layer = calloc((size_t)layers, sizeof *f->layer);
    CHECK(f->layer, STATUS_MEMORY, "no memory for %d layers", layers);
    for (int j = 0; j < layers; j++) f->layer[j].before = inner + (outer - inner) * j / layers;
    return status_ok();
}

void vessel_film_free(film *f)
{
    free(f->layer);
    f->layer = NULL;
}

/* The plastic strain that brings the trial stress back to the flow stress,
 *   trial - 3 G more = flow(flowed + more),   by regula falsi (Illinois); 0 where it lies below it. */
static double returned(const film *f, const film_layer *l, double trial, double dt)
{
    enum { ITERATIONS = 60 };
    const double G3 = 3.0 * mpm_point_law_shear(f->law);
    double at[2] = { 0.0, trial / G3 }, off[2] = { 0.0, 0.0 }, more = 0.0;
    int side = 0;
    for (int i = 0; i < ITERATIONS; i++) {
        more = i < 2 ? at[i] : (at[0] * off[1] - at[1] * off[0]) / (off[1] - off[0]);
        const mpm_law_point to = { .strain = l->flowed + more,
                                   .rate = dt > 0.0 ? more / dt : 0.0,
                                   .damage = l->damage };
        const double here = trial - G3 * more - mpm_point_law_flow(f->law, &to);
        if (i == 0 && here <= 0.0) return 0.0;
        if (fabs(here) <= 1e-13 * trial) return more;
        const int is = here > 0.0 ? 0 : 1;
        if (i >= 2 && is == side) off[1 - is] *= 0.5;
        side = is, at[is] = more, off[is] = here;
    }
    return more;
}

double vessel_film_at(const film *f, double time, double inside, double *damage, film_layer *next)
{
    const double factor = f->dimension == 2 ? 2.0 / sqrt(3.0) : 2.0, G3 = 3.0 * mpm_point_law_shear(f->law);
    const double step = (f->outer - f->inner) / f->layers, more = inside - f->inner,
                 share = f->dimension == 2 ? 0.5 * factor : 2.0 / 3.0;
    double pressure = 0.0, worst = 0.0;
    for (int j = f->layers - 1; j >= 0; j--) { /* from outside, where the radial stress is zero */
        film_layer l = f->layer[j];
        const double middle = l.before + 0.5 * step, dt = time - f->time;
        l.strain = factor / f->dimension * log((middle + more) / middle);
        const double trial = G3 * (l.strain - l.plastic), plastic = returned(f, &l, fabs(trial), dt);
        l.plastic += copysign(plastic, trial), l.flowed += plastic;
        l.stress = copysign(fabs(trial) - G3 * plastic, trial);
        const double held = factor * l.stress / f->dimension * log((l.before + step + more) / (l.before + more));
        const mpm_law_point at = { .strain = l.flowed,
                                   .rate = dt > 0.0 ? plastic / dt : 0.0,
                                   .damage = l.damage,
                                   .triaxiality = share - (pressure + 0.5 * held) / (fabs(l.stress) + 1e-300) };
        if (plastic > 0.0) l.damage += mpm_point_law_damage(f->law, &at, plastic);
        pressure += held;
        worst = fmax(worst, l.damage);
        if (next) next[j] = l;
    }
    if (damage) *damage = worst;
    return pressure;
}
