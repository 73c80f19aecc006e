/* The search for a threshold velocity: where the growth of an impact's groove, or its severity, crosses its limit.
 *
 * What is known of the function: nothing but values at velocities we pay for, each at a resolution, each with a class.
 *   1. Coarse: a quarter of the range from both its ends, both in any case (so the other side is looked at once); from
 *      there outwards by a fifth, then as far again as it has come, to a change of side; in between until the bracket
 *      is a fifth of its middle or the wanted interval, whichever is more.  Where there is one resolution only, to the
 *      wanted interval.
 *   2. Fine: one wanted half interval below the coarse root, from there by a wanted interval, then as far again as it
 *      has come, to a change of side; in between to the wanted interval, in velocity and in place, or the grid's step.
 *      In between one scene at a time: where one is enough, there; else at the secant's root, or, where an end is
 *      within a wanted width of it, that width from the end.  (Two at a time took a fifth more scenes.)
 *      No bracket is made narrower than what the resolution leaves open (`resolution`).
 *      Last a coarse scene half way to each end of the range, where that is far and nothing was asked: does the
 *      function turn back?  If scenes run out before it has both sides: the coarse root, moved as far as the fine
 *      scenes' one side drove it.
 *   3. Interval: the fine bracket, by decided scenes (an `undecided` one takes the side of its excess, but does not end
 *      the interval: that ends at the next decided one, or where the line to it leaves the scatter), widened by what
 *      the resolution may change: the shift of the root from coarse to fine, or the plan's share of the threshold if
 *      more; of a threshold outside of the range that share of the end where it was looked for.
 * Monotonicity is checked: a higher velocity on the lower side of a lower one widens the interval over both and warns.
 * Velocities lie on the grid k * step, so that scenes are shared, and none is asked for twice.
 *
 * The search is a continuation.  It begins with a plan, says which scenes it needs, is told their answers in any order
 * and goes on once it has all of them:
 *   study_threshold_begin(&plan, &s);
 *   while ((n = study_threshold_ask(&s, wanted)) > 0) ... study_threshold_tell(&s, &answer of one of them) ...
 *   s.result is the answer
 * A search owns nothing: a copy of the struct is a second search that goes on by itself, so a caller can follow a guess
 * (family_search.c) without touching the real one. */
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
    double velocity;    /* of the crossing, between the bracket's ends by excess; NaN unless found [m/s] */
    double interval[2]; /* where it lies; an end that is not known is NaN [m/s] */
    double bracket[2];  /* of the last stage alone [m/s] */
    double shift;       /* of the root from coarse to fine, at least, NaN if there is only one [m/s] */
    double allowance;   /* for the resolution, on both sides of the interval: the shift or the plan's share [m/s] */
    double cells;       /* a radius, of the last stage [1] */
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
} threshold_search;

/* STATUS_BAD_INPUT: the plan makes no sense. */
status study_threshold_begin(const threshold_plan *plan, threshold_search *out);
/* The scenes that are needed before the search goes on, without those told already; how many.  0: it is over. */
int study_threshold_ask(const threshold_search *s, threshold_wanted out[THRESHOLD_TOGETHER]);
/* The answer of one of them.  STATUS_NUMERICAL: it has no excess; the search is where it was. */
status study_threshold_tell(threshold_search *s, const threshold_sample *answer);

/* Does a sample speak for a gouge?  An undecided one by its excess. */
bool study_threshold_is_upper(const threshold_sample *s);

/* Grid step for a wanted interval around 1.5 km/s: half of it, rounded down to 1, 2.5 or 5 times a power of ten [m/s].
 */
double study_threshold_step(double interval);

#endif
