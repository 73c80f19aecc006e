/* SPDX-License-Identifier: BSD-3-Clause */
/* The material points of a gouging scene, read for those who look at the rail's surface and at the armature's metal. */
#ifndef BREECH_COUPLING_METAL_H
#define BREECH_COUPLING_METAL_H

#include "coupling/gouge/impact_scene.h"

/* Arrays of n; one block of memory, owned by `position`. */
typedef struct {
    size_t n;
    double *position, *velocity, *size; /* n x 3 [m, m/s, m]; size: half lengths */
    double *damage, *mass, *body;       /* n [1, kg, index] */
} gouge_points;

/* Those of rail and layers over a crater's map, in their order. */
status gouge_points_of_rail(const gouge_scene *s, const crater_spec *map, const mpm *m, gouge_points *p);
void gouge_points_free(gouge_points *p);

/* The armature's sound metal that is not slower than half its first speed; as computed: half a model is half. */
typedef struct {
    double mass, momentum; /* momentum along the rail [kg, kg m/s] */
} gouge_metal;

status gouge_armature_metal(const gouge_scene *s, const mpm *m, gouge_metal *out);

/* Volume of each body's sound metal faster than half the armature's first speed: chips, layers that came off [m3].
 * volume: one a body, full model. */
status gouge_carried_volumes(const gouge_scene *s, const mpm *m, double *volume);

#endif
