/* The crater: what the rail's surface looks like after the pass, and what class of damage that is (PHYSICS.md). */
#ifndef BREECH_MPM_CRATER_H
#define BREECH_MPM_CRATER_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum { DAMAGE_NONE, DAMAGE_SCRATCH, DAMAGE_GOUGE, DAMAGE_UNDECIDED } damage_class;
extern const char *const damage_class_names[]; /* "none", "scratch", "gouge", "undecided", NULL */

/* The material points of the rail (and welded layers); arrays of n, borrowed. */
typedef struct {
    size_t n;
    const double *position;   /* n x 3 [m] */
    const double *size;       /* n x 3 half lengths [m] */
    const double *damage;     /* n, failed at 1 */
    const double *mass;       /* n [kg] */
    const double *start;      /* n x 3 [m] */
} crater_points;

typedef struct {
    double surface;             /* y of the undamaged rail surface [m] */
    double x_lo, x_hi, z_hi;    /* region to map: x_lo..x_hi, z 0..z_hi (mirrored) or -z_hi..z_hi [m] */
    bool mirrored;              /* the scene is the half z >= 0: the map is doubled */
    double cell;                /* size of a map cell [m] */
    double particle_radius, particle_height, particle_volume, particle_area; /* of the whole grain [m, m, m3, m2] */
    double particle_x;          /* where the grain sat [m] */
    double limit_widening;      /* 1.5 */
    double limit_severity;      /* 0 */
} crater_spec;

typedef struct {
    damage_class class;
    char reason[200];           /* the numbers behind the class, in words */
    double severity, length, width, depth, volume, rim_height, widening; /* severity, widening [1], others [m, m3] */
    double rim_x, deepest_x;    /* [m] */
    int nx, nz;                 /* the map, full width */
    double x0, z0, dx, dz;      /* first map cell's centre and spacing [m] */
    double *depth_map;          /* nx x nz, depth below the surface, rim negative [m]; owned */
} crater;

status crater_measure(const crater_points *points, const crater_spec *spec, crater *out);
void crater_free(crater *c);

#endif
