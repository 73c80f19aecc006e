/* SPDX-License-Identifier: BSD-3-Clause */
/* What a crater does to the layers of its rail: one rule for surfaces compared and for shots after shots.
 *
 * Soft rail gives way under a layer, which then lines the dent.  So a crater deeper than the layers has worn them
 * through only where a tenth of them, over the crater, is gone: failed, or carried off with the armature. */
#ifndef BREECH_COUPLING_STUDY_LAYER_WEAR_H
#define BREECH_COUPLING_STUDY_LAYER_WEAR_H

#include "coupling/run/scene_result.h"

/* Fractions of the layers over the crater, or over the grain where that is the larger; 0 without layers [1] */
typedef struct {
    double failed, carried;
} layer_wear;

/* Of layers so thick in all, under a grain of this radius. */
layer_wear study_layer_wear_of(const scene_result *r, double thickness, double radius);
bool study_layer_wear_is_through(double gone, double depth, double thickness);
/* "intact", "dented", "spalled", "sheared off" or "worn through" */
const char *study_layer_wear_word(const layer_wear *w, double depth, double thickness);

#endif
