/* SPDX-License-Identifier: BSD-3-Clause */
/* The main job: where along the rail does gouging begin?
 *
 *   shot -> every site's state at arrival -> screen -> for each family of grains (family.h) the threshold velocity over
 *   size, by scenes -> what else its interval has to hold (scatter.h, uncertain.h) -> sites judged -> what further
 *   shots find (repeated.h) -> populations drawn (montecarlo.h) -> gouges handed back to the shot.
 * A site at v gouges from its interval's upper end on, does not up to its lower end, and is undecided between.
 * `breech compare` does the same for several surfaces with study_onset_begin and study_onset_judge. */
#ifndef BREECH_COUPLING_ONSET_H
#define BREECH_COUPLING_ONSET_H

#include "coupling/gouge/null_model.h"
#include "coupling/gouge/session_shot.h"
#include "coupling/study/repeated.h"
#include "coupling/study/search/scatter.h"
#include "coupling/study/search/uncertain.h"

typedef enum {
    SITE_NOT_REACHED, /* the armature never came there */
    SITE_SKIPPED,     /* the screen says it cannot gouge */
    SITE_NONE,        /* as damage_class: from a scene of its own or from the threshold */
    SITE_SCRATCH,
    SITE_GOUGE,
    SITE_UNDECIDED
} site_outcome;
extern const char *const study_site_outcome_names[]; /* "not_reached", "skipped", "none", ..., NULL */

typedef struct {
    double position;                                  /* along the barrel [m] */
    double radius;                                    /* [m] */
    double time, velocity, current;                   /* at arrival [s, m/s, A]; NaN: not reached */
    double contact_pressure;                          /* [Pa] */
    double lead_face_temperature;                     /* NaN: no armature.throat_area [K] */
    double impact_pressure;                           /* impedance match [Pa] */
    double screen;                                    /* impact pressure over the hardness of the harder partner [1] */
    double screen_probability;                        /* that it gouges, by that number alone [1] */
    double threshold_velocity, threshold_interval[2]; /* of a gouge, for its grain [m/s]; NaN: not looked for */
    double scratch_velocity, scratch_interval[2];     /* of a scratch, the same [m/s] */
    double gouged_volume;                             /* [m3]; NaN: unknown */
    site_outcome outcome;
    char scene[SUMMARY_NAME_SIZE]; /* the scene that decided, "" if none */
} onset_site;

/* The threshold at one size of one family of grains. */
typedef struct {
    int family; /* from 1 */
    char shape[BASE_PARAM_TEXT_SIZE], material[BASE_PARAM_TEXT_SIZE];
    double radius;                                /* [m] */
    double grains;                                /* it stands for [1] */
    double threshold_velocity;                    /* [m/s] */
    double threshold_interval[2];                 /* [m/s] */
    double scratch_velocity, scratch_interval[2]; /* [m/s]; NaN: not looked for */
    int scenes;                                   /* of this size; 0: bounded by other sizes */
} onset_size;

/* One part of an interval: how far it alone would reach below and above the velocity [m/s].  The bracket's reaches are
 * added to the root of the sum of squares of the others; NAN: not asked for, so not in the interval. */
typedef struct {
    char part[BASE_PARAM_TEXT_SIZE];
    double threshold_below, threshold_above;
    double scratch_below, scratch_above;
} onset_part;

/* The parts by their place in the list; after them those of study.interval_parts. */
enum { PART_BRACKET, PART_CELLS, PART_GRID, PART_INPUTS, ONSET_PARTS = PART_INPUTS + UNCERTAIN_MAX };

/* Scenes that were not needed. */
typedef struct {
    char rests_on[120];
    int scenes;
} onset_skip;

/* What a change of one input does, all else as it was. */
typedef struct {
    char input[64];
    double change;             /* of the input, relative [1] */
    double muzzle_velocity;    /* [m/s] */
    double threshold_velocity; /* [m/s] */
    double threshold_position; /* [m] */
    double expected_gouges;    /* [1] */
} onset_sensitivity;

/* One of several shots on the same rail. */
typedef struct {
    int shot;                                                          /* from 1 */
    double probability_gouge, expected_gouges, expected_gouged_volume; /* [1, 1, m3] */
    double onset_position, onset_interval[2];                          /* median, 5 .. 95 % [m] */
    double muzzle_velocity;                                            /* [m/s] */
    double rail_rise; /* left by the shots before, where the armature is fast enough to be looked at: the largest [K] */
    double layer_worn;         /* off its layers by sliding, the same; NAN: not carried on [m] */
    double deposit;            /* armature metal on it, the same [m] */
    double threshold_velocity; /* as the study's, where the rail has come to that [m/s] */
} onset_shot;

/* What one number of the two metals alone would say (coupling/gouge/null_model.h). */
typedef struct {
    char name[8];
    char says[80];
    double threshold_velocity, threshold_interval[2]; /* [m/s] */
    double threshold_position;                        /* where the shot has that velocity; NAN: nowhere [m] */
} onset_null_model;

typedef enum { VERDICT_GOUGES, VERDICT_NO_GOUGING, VERDICT_UNDECIDED } onset_verdict;

typedef struct {
    onset_verdict verdict;
    char reason[500];                                                  /* of the verdict, in words */
    double probability_gouge;                                          /* [1] */
    double threshold_velocity;                                         /* at the median size for a population [m/s] */
    double threshold_interval[2];                                      /* [m/s] */
    double growth_deviation, threshold_deviation;                      /* with the place of the grid [1, m/s] */
    double scratch_velocity, scratch_interval[2];                      /* the same of scratches [m/s] */
    double scratch_deviation;                                          /* [m/s] */
    double scratch_position, scratch_position_interval[2];             /* [m] */
    double onset_position;                                             /* along the barrel [m] */
    double onset_interval[2];                                          /* [m] */
    double threshold_position, threshold_position_interval[2];         /* where the threshold velocity is passed [m] */
    double muzzle_velocity_feedback;                                   /* with what the gouges take [m/s] */
    int gouges;                                                        /* sites of the list that gouge */
    double expected_gouges, expected_gouges_interval[2];               /* a shot, sites and populations [1] */
    double expected_gouged_volume, expected_gouged_volume_interval[2]; /* [m3] */
    int histories;                                                     /* of the Monte Carlo */
    double monte_carlo_seconds;                                        /* [s] */
    int n_along;
    const double *along, *probability_along; /* n_along: P(gouge before x) at x [m, 1], borrowed */
    int n_surface, n_skips, n_sensitivities, n_shots;
    const onset_size *surface;              /* borrowed */
    const onset_skip *skip;                 /* borrowed */
    const onset_sensitivity *sensitivities; /* borrowed */
    const onset_shot *shot;                 /* borrowed */
    int n_parts;
    const onset_part *part; /* n_parts, borrowed */
    int n_null_models;
    const onset_null_model *null_model; /* n_null_models, borrowed */
    int scenes_run, scenes_skipped, scenes_reused;
    int n_sites, n_scenes;
    const onset_site *site;   /* n_sites, borrowed */
    const onset_scene *scene; /* n_scenes, borrowed */
    double wall_seconds;      /* [s] */
} onset_result;

extern const summary_key study_onset_keys[];      /* of onset_result */
extern const summary_key study_onset_part_keys[]; /* of onset_part */

typedef struct {
    onset_result result; /* borrows the arrays below */
    bool first;          /* of the run's surfaces */
    shot_record shot;
    shot_outcome flown;         /* owned */
    grain_families grains;      /* owned; borrows flown, so an answer stays where it is */
    uncertain_inputs uncertain; /* owned, borrows grains */
    repeated_rail rail;         /* of the shots after the first; owned, borrows grains */
    mc_result drawn;            /* owned */
    onset_site *site;           /* owned, as all that follows */
    onset_scene *scene;
    onset_size *size;
    onset_skip *skip;
    onset_sensitivity *sensitivity;
    onset_shot *repeated;
    onset_part *part;
    double *along;
    onset_null_model null_model[NULL_MODELS];
} onset_answer;

/* *out needs study_onset_answer_free even on error, before c goes; what was reached by then is in it. */
status study_onset_run(session *s, const case_onset *c, onset_answer *out);
/* STATUS_BAD_INPUT where a run would say so after its shot; flies that shot where it may decide. */
status study_onset_possible(const case_onset *c);
void study_onset_print(const void *result, FILE *out); /* of an onset_result */
void study_onset_answer_free(onset_answer *a);

/* The shot, its sites and families; prefix names the scenes.  first: of the run's surfaces, the one whose shot writes
 * history and that warns of what holds for all. */
status study_onset_begin(session *s, const case_onset *c, const char *prefix, bool first, onset_answer *out);

/* After study_families_search: every site's outcome, verdict, threshold. */
status study_onset_judge(session *s, onset_answer *a);

/* The grain that speaks for the case: of the median size of the first population with a family, else the onset's site,
 * else the one with the lowest threshold.  NULL: there is none. */
const grain_family *study_onset_leading_grain(const onset_answer *a, double *radius);

/* Where growth says that grains gouge for sure but none of their whole scenes is a gouge: what those are, in words;
 * NULL: nowhere. */
const char *study_onset_contradiction(const onset_answer *a);

/* No grain has a scene, and some are too small for one: whether they gouge nothing says. */
bool study_onset_is_unseen(const onset_answer *a);

/* Grains without a scene are not drawn in random shots.  Are there such of which the number that gouges is not known:
 * those that the screen leaves open, or all there are? */
bool study_onset_is_undrawn(const onset_answer *a);

/* The scenes of the session, as a summary lists them, and what is to be warned of in them; *n of them, the caller
 * frees. */
status study_onset_list_scenes(session *s, onset_scene **out, int *n, int *run, int *reused);

#endif
