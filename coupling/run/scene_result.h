/* SPDX-License-Identifier: BSD-3-Clause */
/* What came of an impact's scene, full model: plain bytes, so that a checkpoint takes them as they are. */
#ifndef BREECH_COUPLING_SCENE_RESULT_H
#define BREECH_COUPLING_SCENE_RESULT_H

#include "base/param.h"
#include "coupling/output/summary.h"
#include "coupling/run/damage_class.h"

#include <stdint.h>

/* Bodies of an impact's scene, at most: rail, grain, armature and 29 layers.  A number, not memory: records go as plain
 * bytes into checkpoints and from process to process.  A stack of coatings has a handful of layers, and each body must
 * be a cell thick to be more than a film; more are refused before the scene is made (gouge_scene_make).  Scenes of
 * bodies have results of their own, without a limit (scene_bodies.h). */
enum { RESULT_BODIES = 32 };

/* One scene, full model: forces and volumes with the mirror half. */
typedef struct {
    damage_class class; /* by growth and shape at the second gauge where the groove is followed, else crater_class */
    damage_class crater_class; /* of the crater at the end, by its shape alone (crater.h) */
    char reason[200], crater_reason[200];
    double severity, widening; /* [1] */
    /* Of the plastic power in a groove that is followed, in time and over the armature's way; NaN if it was not gauged
     * [1/s, 1/m]. */
    double groove_growth, growth_per_way;
    double front_speed_ratio;       /* speed of its front between the gauges over the armature's, NaN as before [1] */
    double length_over_width;       /* of the crater, NaN without one [1] */
    double gauge_length_over_width; /* of the crater as it was at the second gauge; NaN: not gauged, no crater [1] */
    double crater_length, crater_width, crater_depth, rim_height; /* [m] */
    double crater_volume;                                         /* [m3] */
    double peak_pressure;    /* the larger of the 99.9th percentiles by mass of armature and rail, intact points [Pa] */
    double max_pressure;     /* of any intact point [Pa] */
    double peak_force[3];    /* on the rail [N] */
    double peak_temperature; /* [K] */
    double peak_mises_armature, peak_mises_rail;               /* [Pa] */
    double peak_mises_armature_999, peak_mises_rail_999;       /* 99.9th percentiles by mass [Pa] */
    double peak_pressure_armature_999, peak_pressure_rail_999; /* [Pa] */
    bool crater_truncated; /* the crater reaches the edge of its map: length and volume are lower bounds */
    double momentum_error, energy_error; /* [1] */
    int bodies;
    char body[RESULT_BODIES][BASE_PARAM_TEXT_SIZE];
    double failed_volume[RESULT_BODIES];  /* [m3] */
    double carried_volume[RESULT_BODIES]; /* sound and faster than half the armature's speed at the end [m3] */
    double layers_failed_volume, layers_carried_volume; /* the same, of the rail's layers together [m3] */
    double end_time;                                    /* [s] */
#define WORK(member, text) uint64_t member;
#include "coupling/scene/scene_work.def"
    double eroded_mass;  /* [kg] */
    double wall_seconds; /* [s] */
    int threads;
} scene_result;

extern const summary_key run_result_keys[]; /* of scene_result */

#endif
