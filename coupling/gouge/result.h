/* A gouging scene's result, full model, from what the solver and the watch over it say. */
#ifndef BREECH_COUPLING_GOUGE_RESULT_H
#define BREECH_COUPLING_GOUGE_RESULT_H

#include "coupling/gouge/watch.h"
#include "coupling/output/summary.h"

/* One scene, full model: forces and volumes with the mirror half. */
typedef struct {
    damage_class class;
    char reason[200];
    double severity, widening; /* [1] */
    double groove_growth;      /* of the plastic power in a groove that is followed, NaN if it was not gauged [1/s] */
    double crater_length, crater_width, crater_depth, rim_height; /* [m] */
    double crater_volume;                                         /* [m3] */
    double peak_pressure;                                         /* of any particle [Pa] */
    double peak_force[3];                                         /* on the rail [N] */
    double peak_temperature;                                      /* [K] */
    double peak_mises_armature, peak_mises_rail;                  /* [Pa] */
    double peak_mises_armature_999, peak_mises_rail_999;          /* 99.9th percentiles by mass [Pa] */
    double peak_pressure_armature_999, peak_pressure_rail_999;    /* [Pa] */
    bool crater_truncated; /* the crater reaches the edge of its map: length and volume are lower bounds */
    double momentum_error, energy_error; /* [1] */
    int bodies;
    char body[GOUGE_BODIES][PARAM_TEXT_SIZE];
    double failed_volume[GOUGE_BODIES];  /* [m3] */
    double carried_volume[GOUGE_BODIES]; /* sound and faster than half the armature's speed at the end [m3] */
    double layers_failed_volume, layers_carried_volume; /* the same, of the rail's layers together [m3] */
    double end_time;                                    /* [s] */
    uint64_t particles, steps, particle_steps, particle_steps_dense;
    uint64_t clamps_pressure, clamps_compression;
    double eroded_mass;  /* [kg] */
    double wall_seconds; /* [s] */
    int threads;
} scene_result;

extern const summary_key gouge_result_keys[]; /* of scene_result */

/* w after its scene is over. */
scene_result gouge_result(const gouge_scene *s, const gouge_watch *w, const scene_outcome *o);

#endif
