/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene as a study lists it: what it was given and what came of it. */
#ifndef BREECH_COUPLING_SCENE_ENTRY_H
#define BREECH_COUPLING_SCENE_ENTRY_H

#include "coupling/run/scene_result.h"

/* One scene of a study. */
typedef struct {
    char name[SUMMARY_NAME_SIZE]; /* its folder under scenes/ and its group under /scene */
    double velocity;              /* [m/s] */
    double radius, height;        /* of the grain [m] */
    char shape[BASE_PARAM_TEXT_SIZE], material[BASE_PARAM_TEXT_SIZE], surface[SUMMARY_NAME_SIZE];
    double contact_pressure;      /* [Pa] */
    double temperature;           /* of the rail [K] */
    double lead_face_temperature; /* of the armature, all of it [K] */
    double cells_per_radius;      /* [1] */
    bool gauged;                  /* over once its groove's growth was known: its crater is as far as it was */
    bool reused;                  /* taken from the store, not computed by this run */
    scene_result result;
} onset_scene;

extern const summary_key run_scene_keys[]; /* of onset_scene: what it was given, then those of its result */

#endif
