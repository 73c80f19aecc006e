/* SPDX-License-Identifier: BSD-3-Clause */
/* The search for a threshold velocity: where the growth of an impact's groove, or its severity, crosses its limit.
 *
 * The function is known only at velocities where a scene was computed: its value, at a resolution, and the class.
 *   1. Coarse scenes.  Start a quarter of the range from both its ends; compute both, so that the other side is seen at
 *      once.  If both give the same side, step outwards by a fifth, doubling the step, until the side changes.  Then
 *      narrow the bracket to a fifth of its middle or to the wanted interval, whichever is more; with one resolution
 *      only, to the wanted interval.
 *   2. Fine scenes.  Start half a wanted interval below the coarse root and step by a wanted interval, doubling the
 *      step, until the side changes.  Then narrow the bracket to the wanted interval, in velocity and in place, or to
 *      the grid's step.  Narrowing computes one scene at a time: at a velocity that alone is enough, if there is one;
 *      else at the secant's root or, where an end is within a wanted width of the root, that width from the end.  (Two
 *      scenes at a time took a fifth more of them.)  No bracket is made narrower than the resolution allows
 *      (`resolution`), or than a tenth of its middle where that allows more.
 *      At the end, a coarse scene far out on each side where none was looked at: does the function turn back?  Above
 *      half way to the end of the range; below where a search for a lower threshold would look (2 and 1), so that a
 *      second search from the same range has one scene less to compute.  If scenes run out before both sides are
 *      known, the answer is the coarse root, moved as far as the fine scenes on one side require; on that side the
 *      interval is open.
 *   3. Interval: the fine bracket, between decided scenes.  An `undecided` scene counts on the side of its excess but
 *      does not end the interval; that ends at the next decided scene, or where the line to it leaves the scatter; with
 *      a warning at the furthest scene of its side, if none of them decides.
 *      The interval is widened by what the resolution may change: the shift of the root from coarse to fine, or the
 *      plan's fraction of the threshold if that is more, upwards by a fraction of its own.  For a threshold outside of
 *      the range, it is that fraction of the end where it was looked for.
 * Monotonicity is checked: a scene on the lower side at a higher velocity than one on the upper side widens the
 * interval over both and warns; if it is the fastest of all, the upper end is not known.  Velocities lie on the grid
 * k * step, so that searches share scenes, and none is computed twice.
 *
 * The search is a continuation.  It begins with a plan, names the scenes it needs, is told their answers in any order
 * and continues once it has all of them:
 *   study_threshold_begin(&plan, &s);
 *   while ((n = study_threshold_ask(&s, wanted)) > 0) ... study_threshold_tell(&s, &answer of one of them) ...
 *   s.result is the answer
 * A search owns nothing: a copy of the struct is an independent search, so a caller can try a guess on it
 * (family_search.c) without changing the original. */
#ifndef BREECH_COUPLING_THRESHOLD_H
#define BREECH_COUPLING_THRESHOLD_H

#include "base/status.h"
#include "coupling/run/damage_class.h"

#include <stdbool.h>

enum {
    THRESHOLD_MAX_SAMPLES = 256,
    THRESHOLD_WARNING_SIZE = 400,
    THRESHOLD_TOGETHER = 2 /* most scenes that a search needs at a time */
};

/* One scene's answer. */
typedef struct {
    double velocity;         /* [m/s] */
    double cells_per_radius; /* [1] */
    double excess;           /* severity less its limit, or growth in e-folds: crosses zero at the threshold [1] */
    damage_class class;
} threshold_sample;

typedef struct {
    double low, high;    /* where to look [m/s] */
    double step;         /* of the grid of velocities [m/s] */
    double interval;     /* wanted width of the bracket over its middle [1] */
    double coarse, fine; /* cells a radius; equal: one stage [1] */
    double scatter;      /* |excess| within which a scene is undecided; 0: not known [1] */
    double resolution;   /* share of the threshold that finer cells still may move it by [1] */
    double above;        /* the same upwards, `resolution` at least [1] */
    int max_scenes;
    double (*place)(const void *user, double v); /* where the armature has it [m]; NULL: only velocities count */
    const void *place_user;                      /* borrowed */
    double place_interval;                       /* wanted width of the bracket as places [m] */
} threshold_plan;

typedef enum {
    THRESHOLD_FOUND,
    THRESHOLD_BELOW,  /* gouges at the low end already */
    THRESHOLD_ABOVE,  /* does not at the high end */
    THRESHOLD_UNKNOWN /* max_scenes did not suffice for a change of side */
} threshold_outcome;

typedef struct {
    threshold_outcome outcome;
    double velocity;     /* of the crossing, between the bracket's ends by excess; NaN unless found [m/s] */
    double interval[2];  /* where it lies; an end that is not known is NaN [m/s] */
    double bracket[2];   /* of the last stage alone [m/s] */
    double shift;        /* of the root from coarse to fine, at least, NaN if there is only one [m/s] */
    double of_cells[2];  /* for the resolution, below and above: the shift or the plan's shares [m/s] */
    double allowance[2]; /* that, with what else widened the interval since (uncertain.h) [m/s] */
    double own;   /* of the allowance, what another surface need not share: the place of the grid (uncertain.h) [m/s] */
    double more;  /* of the velocity and the interval: what further grids made of them (uncertain.h) [m/s] */
    double cells; /* a radius, of the last stage [1] */
    bool monotone;
    char warning[THRESHOLD_WARNING_SIZE]; /* "" if none */
    int samples;
    threshold_sample sample[THRESHOLD_MAX_SAMPLES]; /* in the order they were asked for */
} threshold_result;

/* Two ends of a bracket: lo on the lower side, hi on the upper one. */
typedef struct {
    threshold_sample lo, hi;
    bool has_lo, has_hi;
} threshold_bracket;

/* A scene that the search needs. */
typedef struct {
    double velocity;         /* [m/s] */
    double cells_per_radius; /* [1] */
} threshold_wanted;

typedef enum {
    THRESHOLD_START,  /* the first scenes of a pass: coarse two, fine one */
    THRESHOLD_WIDEN,  /* outwards to a change of side */
    THRESHOLD_NARROW, /* within the bracket */
    THRESHOLD_BEYOND, /* far outside of it: does the function turn back? */
    THRESHOLD_OVER
} threshold_stage;

/* A search under way.  Others read `result` alone, once the search is over. */
typedef struct {
    const threshold_plan *plan; /* borrowed */
    threshold_result result;
    threshold_stage stage;
    bool fine;                         /* the second pass, at the plan's fine cells */
    double cells;                      /* of the pass, a radius [1] */
    threshold_bracket coarse, refined; /* of the first pass and of the second */
    double stride, gone;               /* of THRESHOLD_WIDEN: its first step, how far it has come [m/s] */
    int reserved;                      /* scenes of the budget that are still to be asked beyond the bracket */
    int n_beyond;
    double beyond[2];                           /* [m/s] */
    int n_asked;                                /* of the question that is open; 0: the search is over */
    threshold_sample asked[THRESHOLD_TOGETHER]; /* rising in velocity; an answer where it was told */
    bool told[THRESHOLD_TOGETHER];
    bool stopped; /* it asks for nothing more */
} threshold_search;

/* STATUS_BAD_INPUT: the plan makes no sense. */
status study_threshold_begin(const threshold_plan *plan, threshold_search *out);
/* The scenes that are needed before the search goes on, without those told already; how many.  0: it is over. */
int study_threshold_ask(const threshold_search *s, threshold_wanted out[THRESHOLD_TOGETHER]);
/* The answer of one of them.  STATUS_NUMERICAL: it has no excess; the search is where it was. */
status study_threshold_tell(threshold_search *s, const threshold_sample *answer);
/* A search that is over: what these n scenes say, as if max_scenes were spent with them. */
status study_threshold_conclude(const threshold_plan *plan, const threshold_sample *list, int n, threshold_search *out);

/* From an end of a bracket outwards to the first decided scene of its side and cells among these n; where the scatter
 * of the excess is known, only to where the line from the last undecided one leaves it.  NAN: none of them decides
 * [m/s]. */
double study_threshold_decided_end(const threshold_plan *plan, const threshold_sample *list, int n,
                                   const threshold_sample *end);

/* The furthest out of its side and cells, decided or not [m/s]. */
double study_threshold_furthest_end(const threshold_sample *list, int n, const threshold_sample *end);

/* Does a sample speak for a gouge?  An undecided one by its excess. */
bool study_threshold_is_upper(const threshold_sample *s);

/* Grid step for a wanted interval around 1.5 km/s: half of it, rounded down to 1, 2.5 or 5 times a power of ten [m/s].
 */
double study_threshold_step(double interval);

#endif
