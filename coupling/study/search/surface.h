/* SPDX-License-Identifier: BSD-3-Clause */
/* The threshold surface of a family of grains: the velocity from which a grain of a given size gouges.
 *
 * A family: grains alike in all but size - shape, material, bond, height over radius - on one surface, in one shot.  A
 * scene's contact pressure and the heat of its armature follow from its velocity, so size and velocity are the axes.
 *   1. At the reference size the whole search of threshold.h, coarse and fine.
 *   2. At the other sizes scenes of the last resolution, under two assumptions that are checked, not taken on faith:
 *      what gouges at v gouges at more than v, and where a grain gouges a larger one does.  So one scene that gouges
 *      bounds the threshold of its size and all larger ones from above, one that does not bounds all smaller ones from
 *      below: low(r) <= v_th(r) <= high(r), both falling with r.
 *      The bands of the smallest and the largest size end at scenes of their own, so that a
 *      threshold that rises with size shows; a size's own scenes count before those of others.
 *      Each scene is placed where it is expected to take most off the bands: sum over sizes of weight x width of the
 *      band, as velocity and as place along the barrel.  What it expects (a threshold that falls slowly with size)
 *      decides which scene comes next, never the answer.
 *   3. The search ends when the bands' weighted mean width is the wanted one in velocity and in place, when no size has
 *      a band wider than the grid, or with the budget.  A flat threshold takes four scenes beyond the reference.
 * Interval of a size: its band and on either side the reference's allowance for the resolution.
 * A continuation, begun, asked and told as that of threshold.h. */
#ifndef BREECH_COUPLING_SURFACE_H
#define BREECH_COUPLING_SURFACE_H

#include "coupling/study/search/threshold.h"

enum { SURFACE_MAX_SIZES = 48 };

typedef struct {
    threshold_plan search; /* its max_scenes are those of the whole surface */
    int sizes;
    double size[SURFACE_MAX_SIZES];   /* rising [m] */
    double weight[SURFACE_MAX_SIZES]; /* of each in the answer, >= 0 */
    int reference;                    /* index */
} surface_plan;

typedef struct {
    double radius; /* [m] */
    threshold_sample is;
} surface_sample;

/* A size's answer. */
typedef struct {
    double radius, weight;
    double velocity;    /* [m/s]; NaN: outside of the search */
    double interval[2]; /* an end that is not known is NaN; may begin below 0 (study_surface_at) [m/s] */
    int scenes;         /* of this very size */
} surface_size;

typedef struct {
    threshold_result reference;
    int sizes;
    surface_size size[SURFACE_MAX_SIZES]; /* rising in radius, falling in velocity */
    int inferred;                         /* sizes bounded without a scene of their own */
    bool monotone;
    char warning[THRESHOLD_WARNING_SIZE]; /* "" if none */
    int samples;
    surface_sample sample[THRESHOLD_MAX_SAMPLES]; /* in the order they were asked for */
} surface_result;

/* A scene that the search needs. */
typedef struct {
    double radius, velocity; /* [m, m/s] */
    double cells_per_radius; /* [1] */
} surface_wanted;

/* A search under way.  Others read `result` alone, once the search is over. */
typedef struct {
    const surface_plan *plan; /* borrowed */
    surface_result result;
    threshold_search reference; /* first of all */
    surface_wanted next;        /* then one scene at a time */
    bool over;
} surface_search;

/* STATUS_BAD_INPUT: the plan makes no sense. */
status study_surface_begin(const surface_plan *plan, surface_search *out);
/* The scenes that are needed before the search goes on, without those told already; how many.  0: it is over. */
int study_surface_ask(const surface_search *s, surface_wanted out[THRESHOLD_TOGETHER]);
/* The answer of one of them.  STATUS_NUMERICAL: it has no excess; the search is where it was. */
status study_surface_tell(surface_search *s, const surface_sample *answer);

/* A search that is over: what these n scenes say, without another one. */
status study_surface_conclude(const surface_plan *plan, const surface_sample *list, int n, surface_search *out);

/* The interval at any size without what may move it (reference.allowance); an end that is not known is NaN [m/s]. */
void study_surface_band(const surface_result *s, double radius, double ends[2]);

/* The upper end of a size's interval as it is for cells of the search's size: without what finer ones may raise the
 * threshold by, beyond what they may lower it by [m/s]. */
double study_surface_end_in_cells(const surface_result *s, const surface_size *of);

/* At any size: linear in ln r between sizes, that of the last size beyond the ends; no interval begins below 0. */
surface_size study_surface_at(const surface_result *s, double radius);

#endif
