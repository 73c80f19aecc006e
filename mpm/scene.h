/* A scene: what the material-point solver is given.  Bodies with shapes and materials, a graded grid, boundaries,
 * contact laws.  SI units.  x = launch direction, y = normal to the contact face (rail below, armature above), z =
 * across.
 *
 * The scene borrows its materials; mpm_create copies all it needs. */
#ifndef BREECH_MPM_SCENE_H
#define BREECH_MPM_SCENE_H

#include "base/status.h"
#include "mpm/material.h"
#include "mpm/shape/solid.h"

#include <stdbool.h>

enum { MPM_MAX_BODIES = 8, MPM_MAX_FIELDS = 4, MPM_MAX_LEVELS = 3, MPM_MAX_SOLIDS = 64 };

/* ---- bodies ---- */

typedef struct {
    char name[PARAM_TEXT_SIZE];
    const material *material;
    int solid;            /* its volume: root of a tree in mpm_scene.solid */
    int field;            /* velocity field: bodies of one field are welded together, different fields touch by contact.
                                When several bodies of one field claim a point, the later body gets it. */
    double velocity[3];   /* at the start [m/s] */
    double temperature;   /* at the start [K] */
    double body_force[3]; /* acceleration on the whole body (J x B, pressing) [m/s2] */
    double traction[3];   /* on all of its surface that looks towards `traction_face` [Pa]; zero = none */
    int traction_face;    /* 0..5 = -x +x -y +y -z +z */
    double yield_scale;   /* factor on the yield stress (hardened skin), 1 = none */
    bool damage;          /* Johnson-Cook damage on */
} mpm_body;

/* ---- grid: rectilinear, each axis graded on its own ---- */

typedef enum {
    BOUNDARY_FREE,      /* nothing; particles that leave are booked as ejected */
    BOUNDARY_SYMMETRY,  /* mirror plane, ghost nodes folded; also a roller */
    BOUNDARY_FIXED,     /* no motion */
    BOUNDARY_ABSORBING, /* viscous, both wave speeds */
    BOUNDARY_PRESCRIBED /* mpm_axis.boundary_velocity */
} boundary_kind;

typedef struct {
    double lo, hi;                  /* window [m]; a boundary condition acts at lo and at hi */
    double fine_lo, fine_hi;        /* zone of cells of size `fine` [m] */
    double fine, coarse;            /* cell size in the zone, largest cell size outside [m] */
    double growth;                  /* ratio of neighbouring cells outside the zone, 1 .. 2 */
    boundary_kind boundary[2];      /* at lo, at hi */
    double boundary_velocity[2][3]; /* BOUNDARY_PRESCRIBED [m/s] */
    unsigned boundary_fields[2];    /* bit f set: the boundary acts on field f; 0 = on all */
} mpm_axis;

/* ---- contact between two fields ---- */

typedef struct {
    double friction;      /* Coulomb coefficient [1] */
    double shear_limit;   /* upper limit of the friction stress [Pa], INFINITY = none */
    double bond_strength; /* welded until the traction exceeds it [Pa], 0 = never bonded */
} contact_law;

typedef enum { TRANSFER_TPIC, TRANSFER_PIC } transfer_kind; /* with and without the velocity gradient */
typedef enum { BASIS_GIMP, BASIS_BSPLINE } basis_kind; /* GIMP whose domains follow the stretch; quadratic B-spline */

typedef struct {
    int bodies;
    mpm_body body[MPM_MAX_BODIES];
    int solids;
    mpm_solid solid[MPM_MAX_SOLIDS]; /* trees of all bodies' volumes (shape/solid.h) */
    mpm_axis axis[3];
    /* Of nested grids (grid.h).  1: the axes' grid.  More: in the box of the three fine zones cells of size `fine`;
     * outside it, for 2, cells twice as large from which the axes grow, for 3 four times, with cells of twice the size
     * between. */
    int levels;
    unsigned follow_bodies; /* bit i: the fine zone along x goes with the plastic front of body i; 0: it stays */
    double follow_lead;     /* from that front to the zone's upper end [m] */
    double
        follow_speed; /* of the window along x while it follows: the bodies followed grow in at its upper end, as they
                               were at the start, and what falls behind is booked as ejected [m/s] */
    double follow_width;  /* half width that the fine zone across may grow to with the groove [m]; 0: it stays */
    double gauge_time[2]; /* when the plastic power of the bodies followed is noted, in order; 0: not [s] */
    contact_law contact[MPM_MAX_FIELDS][MPM_MAX_FIELDS]; /* symmetric */
    double contact_gap;     /* fields touch when the distance of their points' means at a node is below this [cells] */
    int particles_per_axis; /* material points a cell and axis, 2 or 3 */
    double courant;         /* of c + |v|, on each level by its own steps and cells */
    double end_time;        /* [s] */
    double viscosity_linear, viscosity_quadratic; /* (M-5) [1] */
    transfer_kind transfer;
    basis_kind basis;
    bool heat_by_plastic_work;             /* option `plastic` of (M-4); default false: by energy */
    char instruction_set[PARAM_TEXT_SIZE]; /* "" = the best this machine has */
} mpm_scene;

/* All members at their defaults, no bodies. */
void mpm_scene_default(mpm_scene *s);

/* One more node behind the others: of a kind by name, its values at their defaults, made of the nodes a and b (-1:
 * none).  *added is valid until the next is added; its place is s->solids - 1. */
status mpm_scene_add_solid(mpm_scene *s, const char *kind, int a, int b, mpm_solid **added);

#endif
