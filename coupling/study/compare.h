/* SPDX-License-Identifier: BSD-3-Clause */
/* Rail surfaces compared: the untreated one and every treatment of the case (case/treatment.h), at the same shot, the
 * same grains, the same random numbers.
 *
 * Ranked by the expected number of gouges a shot, the mean of study.shots of them on the same rail (repeated.h); of
 * equals the one that reaches its threshold later in the first shot is the better.
 * `better_than_next`: share of the worlds (montecarlo.h: what the bands of the thresholds leave open) in which a
 * surface has fewer gouges than the next one, ties half.  The bands hold the place of the grid (search/scatter.h) where
 * that is asked for, and the inputs that are stated as uncertain (search/uncertain.h), each surface's by scenes of its
 * own.  From 95 % on the difference is called significant.
 *
 * Groups: going down the ranking, a surface joins the best group whose first surface it cannot be told from, else it is
 * the first of a new one.  `tied` is the rank of its group's first surface: with `tied` 1 a surface cannot be told from
 * the best.  No chain of neighbours that are alike puts the last beside the first. */
#ifndef BREECH_COUPLING_COMPARE_H
#define BREECH_COUPLING_COMPARE_H

#include "coupling/study/life_compare.h"
#include "coupling/study/onset.h"

typedef struct {
    char surface[SUMMARY_NAME_SIZE];
    char scene_prefix[16];                            /* with which the names of its scenes begin */
    double threshold_velocity, threshold_interval[2]; /* [m/s] */
    double scratch_velocity, scratch_interval[2];     /* [m/s] */
    double onset_position;                            /* [m] */
    double gouged_volume;                             /* [m3] */
    double gouged_volume_interval[2];                 /* [m3] */
    double layer_worn, deposit;            /* of the rail that the last shot finds, as onset_shot has them [m] */
    double threshold_deviation;            /* over study.threshold_ensemble grids; NAN: not known [m/s] */
    double threshold_position;             /* [m] */
    double threshold_position_interval[2]; /* where the ends of the threshold's interval are passed [m] */
    double gouges, gouges_interval[2];     /* a shot, expected: mean of all shots [1] */
    double last_gouges;                    /* the same of the last shot [1] */
    double probability_gouge;              /* of a shot [1] */
    double better_than_next;               /* share of what may be true in which it gouges less than the next one [1] */
    bool significant;       /* that is at least STUDY_SIGNIFICANT, not by the screen alone; of the last: false */
    double worse_than_best; /* share of what may be true in which the best gouges less than it; of the best NAN [1] */
    int tied;               /* rank of the best of its group, from which it cannot be told; from 1 */
    int scenes;             /* its own, those shared with surfaces before it not counted */
    char layer[24];         /* what its layers suffer: none, intact, dented, spalled, sheared off, worn through */
    double layer_failed;    /* share of the layers over the crater that failed [1] */
    double layer_velocity;  /* of the scene that says so [m/s] */
    double life, life_quantiles[3]; /* shots until a crack (life_compare.h); NAN: not asked for or not known [1] */
    bool lasts;                     /* for good: no life is known because it never cracks */
    int life_rank;                  /* tied, by life; 0: not asked for */
    int n_parts;
    const onset_part *part; /* n_parts, of the intervals; borrowed from the surface's answer */
} compare_entry;

typedef struct {
    char verdict[400]; /* which surface is best, and can it be told from the others */
    int n;
    const compare_entry *ranking; /* n, best first, borrowed */
    int n_scenes;
    const onset_scene *scene; /* n_scenes, borrowed */
    int scenes_run, scenes_skipped, scenes_reused;
    int histories, shots;
    double wall_seconds; /* [s] */
} compare_result;

extern const summary_key study_compare_keys[]; /* of compare_result */

typedef struct {
    compare_result result; /* borrows entry and scene */
    int n;
    case_onset *treated;  /* n, each owned; the first is untreated */
    onset_answer *answer; /* n, each owned */
    mc_result drawn;      /* owned */
    mc_mean_shot *mean;   /* n, owned */
    compare_entry *entry; /* owned */
    onset_scene *scene;   /* owned */
    life_ranking life;    /* owned; empty: not asked for */
} compare_answer;

/* By life too where `life` is not NULL.  *out needs study_compare_answer_free even on error; what was reached by then
 * is in it. */
status study_compare_run(session *s, const case_onset *c, const case_treatments *treatments, const case_life *life,
                         compare_answer *out);
/* Writes the verdict of the ranking in *r: the one sentence that report and terminal share. */
void study_compare_conclude(compare_result *r);
void study_compare_print(const void *result, FILE *out); /* of a compare_result */
void study_compare_answer_free(compare_answer *a);

#endif
