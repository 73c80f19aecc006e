/* An ensemble: one scene on several grids, each shifted against the bodies by another part of a cell (study.ensemble).
 *
 * What then differs is what the scene's answers owe to where the cells happen to lie: their scatter.  The first grid
 * is the case's own, the next ones move by a sequence that fills the unit cube evenly whatever its length, so that a
 * larger ensemble takes up the scenes of a smaller one. */
#ifndef BREECH_COUPLING_STUDY_ENSEMBLE_H
#define BREECH_COUPLING_STUDY_ENSEMBLE_H

#include "coupling/study/study.h"

/* The shift of the i-th grid, from 0, of a scene whose own shift is `own`: in 0 .. 1 along each axis [cells]. */
void study_ensemble_shift(int i, const double own[3], double out[3]);

/* Of the numbers that are there; how many of n.  deviation: by one less than these, NAN of fewer than two. */
typedef struct {
    int scenes;
    double mean, deviation, least, largest;
} ensemble_spread;
ensemble_spread study_ensemble_spread(const double *value, int n);

/* A number of the scene's summary. */
typedef struct {
    char name[SUMMARY_PATH_SIZE], unit[PARAM_TEXT_SIZE];
    ensemble_spread spread; /* [unit] */
} ensemble_number;

typedef struct {
    char scene[SUMMARY_NAME_SIZE];
    double shift[3];             /* of its grid [cells] */
    char class[PARAM_TEXT_SIZE]; /* "": such a scene has none */
    int n_values;
    const summary_pair *value; /* n_values, borrowed */
    double wall_seconds;       /* of the scene, in the store's run if it is from there [s] */
} ensemble_scene;

typedef struct {
    char of[PARAM_TEXT_SIZE]; /* the study that was run */
    int n_scenes, n_numbers, n_classes;
    const ensemble_scene *scene;   /* n_scenes, borrowed */
    const ensemble_number *number; /* n_numbers, borrowed */
    const summary_pair *class;     /* n_classes: scenes of each, borrowed */
    double wall_seconds;           /* [s] */
} ensemble_result;

#endif
