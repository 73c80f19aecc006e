/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/life/first.h"

#include "base/constants.h"

#include <math.h>

/* Where it is looked for, in half lengths of the patch. */
static const double STEP = 0.025, WIDE = 1.6, DEEP = 1.5;
enum { PLACES = 140 }; /* of a passage, on either side: 3.5 half lengths and the square of what is beyond two */
static const double PLACE = 1e-5; /* how well the place is found, in half lengths */

typedef struct {
    const contact_load *load;
    const life_first_how *how;
    contact_speed speed; /* where it moves */
} search;

static void strain_at(const search *s, double x, double z, double strain[3])
{
    double stress[3];
    if (s->how->speed > 0.0) {
        life_contact_moving(s->load, &s->speed, x, z, strain);
        return;
    }
    life_contact_stress(s->load, x, z, stress);
    life_contact_strain(stress, s->how->youngs, s->how->poisson, strain);
}

/* ---- a pulse: all directions at once, by the principal axes ---- */

/* The direction whose strain takes most life at this place. */
static life_first at_place(const search *s, double x, double z)
{
    double e[3];
    strain_at(s, x, z, e);
    const double middle = 0.5 * (e[0] + e[1]), radius = hypot(0.5 * (e[0] - e[1]), 0.5 * e[2]);
    double angle = 0.5 * atan2(e[2], e[0] - e[1]), strain = middle + radius;
    if (s->how->measure == FATIGUE_SHEAR) {
        strain = 2.0 * radius / (1.0 + s->how->poisson);
        angle += 0.75 * PI; /* across the largest strain's bisector, where the shear is positive */
    } else if (s->how->measure == FATIGUE_BOND && middle < 0.0) {
        strain = middle - radius;
        angle += 0.5 * PI;
    }
    return (life_first){ .range = mpm_fatigue_range(s->how->measure, strain, strain),
                         .least = fmin(strain, 0.0),
                         .largest = fmax(strain, 0.0),
                         .position = x,
                         .depth = z,
                         .angle = fmod(angle + PI, PI) };
}

static life_first pulse(const search *s)
{
    const double a = s->load->half_length, wide = WIDE * a;
    life_first best = { .range = -1.0 };
    for (int j = 0; j * STEP < DEEP; j++)
        for (double x = -wide; x <= wide; x += STEP * a) {
            const life_first here = at_place(s, x, j * STEP * a);
            if (here.range > best.range) best = here;
        }
    for (double step = STEP * a; step > PLACE * a; step *= 0.5)
        for (int better = 1; better;) {
            static const int way[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
            better = 0;
            for (int k = 0; k < 4; k++) {
                const double x = best.position + way[k][0] * step, z = best.depth + way[k][1] * step;
                const life_first here = at_place(s, x, fmax(z, 0.0));
                if (here.range > best.range) best = here, better = 1;
            }
        }
    return best;
}

/* ---- a passage: every direction from end to end ---- */

/* Place number k along the rail: dense about the patch, further apart beyond two half lengths, where all is smooth. */
static double place(int k, double a)
{
    const double x = k * STEP, beyond = fmax(0.0, fabs(x) - 2.0);
    return a * (x + copysign(4.0 * beyond * beyond, x));
}

static void take_place(const search *s, const fatigue_fan *fan, double x, double z, fatigue_extremes *of)
{
    double strain[3];
    strain_at(s, x, z, strain);
    mpm_fatigue_take(fan, s->how->measure, s->how->poisson, strain, of);
}

static life_first at_depth(const search *s, const fatigue_fan *fan, double z)
{
    const contact_load *l = s->load;
    fatigue_extremes of = { { 0.0 }, { 0.0 } };
    life_first best = { .range = -1.0, .position = NAN, .depth = z };
    for (int k = -PLACES; k <= PLACES; k++) take_place(s, fan, place(k, l->half_length), z, &of);
    for (int k = 0; k < l->n; k++) { /* on the face the strain has its peaks at ends of pieces */
        take_place(s, fan, l->piece[k].from, z, &of);
        take_place(s, fan, l->piece[k].to, z, &of);
    }
    for (int k = 0; k < fan->n; k++) {
        const double range = mpm_fatigue_range(s->how->measure, of.least[k], of.largest[k]);
        if (range <= best.range) continue;
        best.range = range, best.least = of.least[k], best.largest = of.largest[k];
        best.angle = fan->angle[k];
    }
    return best;
}

static life_first passage(const search *s)
{
    const double a = s->load->half_length;
    const fatigue_fan fan = mpm_fatigue_fan_even(FATIGUE_MAX_DIRECTIONS);
    life_first best = { .range = -1.0 };
    for (double z = 0.0; z < DEEP * a; z += 4.0 * STEP * a) {
        const life_first here = at_depth(s, &fan, z);
        if (here.range > best.range) best = here;
    }
    for (double step = 2.0 * STEP * a; step > 0.1 * STEP * a; step *= 0.5)
        for (int way = -1; way <= 1; way += 2) {
            const life_first here = at_depth(s, &fan, fmax(best.depth + way * step, 0.0));
            if (here.range > best.range) best = here;
        }
    return best;
}

life_first life_first_cut(const contact_load *l, const life_first_how *how)
{
    const search s = { l, how, life_contact_speed(how->youngs, how->poisson, how->density, how->speed) };
    return how->cycle == LIFE_PASSAGE ? passage(&s) : pulse(&s);
}
