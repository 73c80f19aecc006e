/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/growth.h"

#include <math.h>

/* The gauges: the armature's way in grain radii.  Before, the grain itself is still being flattened; later the contact
 * face begins to run out. */
static const double GROWTH_WAY[2] = { 16.0, 28.0 };
static const double DEAD_FOLDS = -3.0; /* of a groove that died before the first gauge, and the least of any */

/* A groove that loses so much from gauge to gauge, more than twice what decides nothing, is known to die half way. */
static const double DYING_FOLDS = -0.5;

void gouge_gauge_times(double radius, double velocity, double time[2])
{
    for (int i = 0; i < 2; i++) time[i] = GROWTH_WAY[i] * radius / velocity;
}

double gouge_gauge_way(void)
{
    return GROWTH_WAY[1];
}

static void note_place(const gouge_front *now, gouge_gauges *g)
{
    if (g->looks > 0.0 && !(now->time > g->last)) return; /* the same look again */
    if (!(g->looks > 0.0)) g->from = now->front;
    const double t = now->time - g->at[0], x = now->front - g->from;
    g->looks += 1.0, g->last = now->time;
    g->t += t, g->x += x, g->tt += t * t, g->tx += t * x;
}

void gouge_gauges_note(const gouge_scene *s, const gouge_front *now, gouge_gauges *g)
{
    const bool before_second = !(g->at[1] > 0.0);
    for (int i = 0; i < 2; i++)
        if (s->gauge_time[i] > 0.0 && !(g->at[i] > 0.0) && now->time >= s->gauge_time[i])
            g->at[i] = now->time, g->power[i] = now->power;
    if (g->at[0] > 0.0 && before_second) note_place(now, g);
    if (g->at[1] > 0.0) g->most = fmax(g->most, now->power);
}

int gouge_finest_level(const gouge_scene *s, const gouge_gauges *g)
{
    int level = 0;
    if (!s->cells_grow || !(g->power[0] > 0.0)) return 0;
    for (double wide = 4.0 * g->power[0]; level < s->scene.levels - 1 && g->most >= wide; wide *= 4.0) level++;
    return level;
}

double gouge_growth(const gouge_gauges *g, const gouge_front *now)
{
    const bool whole = g->at[1] > 0.0;
    const double from = g->at[0], to = whole ? g->at[1] : now->time;
    const double power = fmax(whole ? g->power[1] : now->power, 1e-3 * g->power[0]);
    if (!(from > 0.0 && to > from && g->power[0] > 0.0)) return NAN;
    return log(power / g->power[0]) / (to - from);
}

double gouge_front_speed(const gouge_gauges *g)
{
    const double spread = g->looks * g->tt - g->t * g->t;
    return spread > 0.0 ? (g->looks * g->tx - g->t * g->x) / spread : NAN;
}

double gouge_shortest_groove(double radius, double density_armature, double density_rail)
{
    return (GROWTH_WAY[1] - GROWTH_WAY[0]) * radius / (1.0 + sqrt(density_rail / density_armature));
}

double gouge_growth_folds(double growth, double radius, double velocity)
{
    const double folds = growth * (GROWTH_WAY[1] - GROWTH_WAY[0]) * radius / velocity;
    return folds > DEAD_FOLDS ? folds : DEAD_FOLDS; /* NAN too */
}

double gouge_tear_drop_excess(double folds, double length_over_width, double limit)
{
    return isnan(length_over_width) ? DEAD_FOLDS : fmin(folds, log(limit / length_over_width));
}

bool gouge_groove_dies(const gouge_scene *s, const gouge_gauges *g, const gouge_front *now, double time)
{
    if (!(g->at[0] > 0.0) || time < 0.5 * (s->gauge_time[0] + s->gauge_time[1])) return false;
    const double radius = s->gauge_time[0] * s->velocity / GROWTH_WAY[0];
    return gouge_growth_folds(gouge_growth(g, now), radius, s->velocity) < fmin(DYING_FOLDS, -2.5 * s->growth_scatter);
}
