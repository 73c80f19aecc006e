/* SPDX-License-Identifier: BSD-3-Clause */
/* An ensemble: one scene on several grids, each shifted against the bodies by another part of a cell (study.ensemble).
 * sampling/shifts.h has the shifts. */
#ifndef BREECH_COUPLING_STUDY_ENSEMBLE_H
#define BREECH_COUPLING_STUDY_ENSEMBLE_H

#include "coupling/study/sampling/shifts.h"
#include "coupling/study/study.h"

/* A number of the scene's summary. */
typedef struct {
    char name[SUMMARY_PATH_SIZE], unit[BASE_PARAM_TEXT_SIZE];
    shift_spread spread; /* [unit] */
} ensemble_number;

typedef struct {
    char scene[SUMMARY_NAME_SIZE];
    double shift[3];                  /* of its grid [cells] */
    char class[BASE_PARAM_TEXT_SIZE]; /* "": such a scene has none */
    int n_values;
    const summary_pair *value; /* n_values, borrowed */
    double wall_seconds;       /* of the scene, in the store's run if it is from there [s] */
} ensemble_scene;

typedef struct {
    char of[BASE_PARAM_TEXT_SIZE]; /* the study that was run */
    int n_scenes, n_numbers, n_classes;
    const ensemble_scene *scene;   /* n_scenes, borrowed */
    const ensemble_number *number; /* n_numbers, borrowed */
    const summary_pair *class;     /* n_classes: scenes of each, borrowed */
    double wall_seconds;           /* [s] */
} ensemble_result;

#endif
