/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene: what the material-point solver is given.  Bodies with shapes and materials, a graded grid, boundaries,
 * contact laws.  SI units.
 *
 *   mpm_scene s;                                   mpm_body *b;
 *   mpm_scene_default(&s);                         TRY(mpm_scene_add_body(&s, &b));
 *   s.axis[0] = ...                                b->solid = ..., b->material = ..., b->velocity[0] = 1500;
 *   mpm_create(&s, threads, &m), mpm_scene_free(&s);
 *
 * The scene owns its arrays and borrows its materials; mpm_create copies all it needs.  An assignment `a = b` copies
 * no array: use mpm_scene_copy where both go on.  How many bodies, groups and pairs there may be is memory's to say. */
#ifndef BREECH_MPM_SCENE_H
#define BREECH_MPM_SCENE_H

#include "base/status.h"
#include "mpm/cavity.h"
#include "mpm/material.h"
#include "mpm/read/probe.h"
#include "mpm/refine/refine.h"
#include "mpm/shape/solid.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MPM_MAX_LEVELS = 8, MPM_FACES = 6, MPM_CONTACT_VALUES = 8 };

/* ---- bodies ---- */

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    const mpm_material *material;
    int solid; /* its volume: root of a tree in mpm_scene.solid; -1 at first */
    int group; /* bodies of one group share one velocity at every node: they are welded.  Groups touch by contact.
                           Numbered from 0 without gaps.  Where bodies of any group overlap, the later body has the
                           points. */
    double velocity[3];   /* of its centre of mass at the start [m/s] */
    double spin[3];       /* at the start: v = velocity + spin x (x - centre of mass) [rad/s] */
    double temperature;   /* at the start [K] */
    double pressure;      /* at the start, from that of the surroundings; NAN: that at rest [Pa] */
    double body_force[3]; /* acceleration on the whole body (J x B, pressing) [m/s2] */
    double traction[3];   /* on all of its surface that looks towards `traction_face` [Pa]; zero = none */
    int traction_face;    /* 0..5 = -x +x -y +y -z +z */
    /* A plane pressure wave that enters a fluid through its surface that looks towards `traction_face`, from time 0 on,
     * and lets pass what comes back (wave.h).  NAN: none.  Either one that falls like an exponential .. */
    double wave_pressure; /* at first [Pa] */
    double wave_decay;    /* exp(-t/wave_decay); NAN: it stays [s] */
    /* .. or what a piston sends down a tube of this fluid (tube.h); its front is at the surface at time 0 */
    double piston_mass;     /* on the tube's area, with what drives it [kg/m2] */
    double piston_velocity; /* at the start [m/s] */
    double tube_length;     /* from the piston to this surface [m] */
    bool held;              /* never moves: a wall, a clamp; the same for all bodies of a group */
    double yield_scale;     /* factor on the yield stress (hardened skin), 1 = none */
    double cold_work; /* plastic strain before the scene, where the law of strength begins; NAN: the material's [1] */
    bool damage;      /* Johnson-Cook damage on */
    bool
        passes[MPM_FACES]; /* the window's ends -x +x -y +y -z +z whose boundary does not act on this body; the same for
                               all bodies of a group */
} mpm_body;

/* ---- grid: rectilinear, each axis graded on its own ---- */

/* What acts at an end of the window: one file a boundary, one line in law/boundary.def.  MPM_BOUNDARY_FREE, .. */
typedef enum {
#define BOUNDARY(PLACE, name, after, text) MPM_BOUNDARY_##PLACE,
#include "mpm/law/boundary.def"
    MPM_BOUNDARIES
} mpm_boundary_kind;

typedef struct {
    double lo, hi;                  /* window [m]; a boundary condition acts at lo and at hi */
    double fine_lo, fine_hi;        /* zone of cells of size `fine` [m] */
    double fine, coarse;            /* cell size in the zone, largest cell size outside [m] */
    double growth;                  /* ratio of neighbouring cells outside the zone, 1 .. 2 */
    mpm_boundary_kind boundary[2];  /* at lo, at hi */
    double boundary_velocity[2][3]; /* MPM_BOUNDARY_PRESCRIBED [m/s] */
} mpm_axis;

/* ---- contact between two groups: one file a law, one line in law/contact.def (law/contact.h) ---- */

typedef struct mpm_contact_law mpm_contact_law;

typedef struct {
    const mpm_contact_law *law;
    double value[MPM_CONTACT_VALUES]; /* meaning, units, defaults and ranges: the law's parameter table */
} mpm_contact;

/* How two groups touch.  The contact normal is that of the surface of `normal_of`, one of the two.  Take the body that
 * keeps its shape: at the edge of the other a mean of both normals tilts, and sliding reads as approach. */
typedef struct {
    int a, b;
    mpm_contact contact;
    int normal_of;
} mpm_pair;

typedef enum { MPM_TRANSFER_TPIC, MPM_TRANSFER_PIC } mpm_transfer_kind; /* with and without the velocity gradient */
typedef enum {
    MPM_BASIS_GIMP,
    MPM_BASIS_BSPLINE
} mpm_basis_kind; /* GIMP whose domains follow the stretch; quadratic B-spline */

typedef struct {
    int bodies, solids, pairs, probes, refines, cavities;
    mpm_body *body;      /* [bodies] owned; later bodies have the points that several claim */
    mpm_solid *solid;    /* [solids] owned; trees of the bodies' volumes (shape/solid.h) */
    mpm_pair *pair;      /* [pairs] owned; each two groups at most once */
    mpm_probe *probe;    /* [probes] owned; what is read while the scene runs, which changes nothing of it */
    mpm_refine *refine;  /* [refines] owned; rules that say where cells are small, with several levels */
    mpm_cavity *cavity;  /* [cavities] owned; gas between bodies */
    mpm_contact contact; /* of two groups that no pair names, with the normal of the lower one */
    mpm_axis axis[3];
    /* Of the grid (grid/grid.h).  1: the axes' grid.  More: cells of `fine` where the fine zones of all axes meet,
     * until `zone_until`, or larger ones if `zone_cell` says so, and where the rules ask for them; elsewhere cells
     * twice, four times, ... as large.  0: mpm_scene_levels_fill says how many. */
    int levels;
    double zone_until; /* NAN: 0 with rules, else for good [s] */
    double zone_cell;  /* largest cell of that zone; NAN: `fine` [m] */
    /* The planes of the grid, of all levels, moved along each axis by a share of the finest cell; the window's ends and
     * the bodies stay where they are [1] */
    double grid_shift[3];
    int particles_per_axis;                       /* material points a cell and axis, 2 or 3 */
    double courant;                               /* of c + |v|, on each level by its own steps and cells */
    double end_time;                              /* of the run, for whoever calls mpm_advance; NAN: not said [s] */
    double viscosity_linear, viscosity_quadratic; /* (M-5) [1] */
    double surroundings; /* absolute pressure around the bodies; NAN: that at which each gas is at rest [Pa] */
    mpm_transfer_kind transfer;
    mpm_basis_kind basis;
    bool heat_by_plastic_work;                  /* option `plastic` of (M-4); default false: by energy */
    char instruction_set[BASE_PARAM_TEXT_SIZE]; /* "" = the best this machine has */
} mpm_scene;

/* All members at their defaults, frictionless contact, no bodies.  What `s` held before is not freed. */
void mpm_scene_default(mpm_scene *s);

/* The grid's levels, and until when the zone keeps its cells, where the scene leaves them open: as many levels as a
 * doubling of the finest cells makes of the coarsest where there are rules, else one. */
void mpm_scene_levels_fill(mpm_scene *s);

/* One more body, solid or pair, at its defaults, behind the others.  *added is valid until the next of its kind.
 * A solid is made of those at the places a and b (-1: none); its own place is s->solids - 1. */
base_status mpm_scene_add_body(mpm_scene *s, mpm_body **added);
base_status mpm_scene_add_solid(mpm_scene *s, const char *kind, int a, int b, mpm_solid **added);
/* One more probe, with its values at their defaults, of no body. */
base_status mpm_scene_add_probe(mpm_scene *s, const char *kind, const char *name, mpm_probe **added);
/* One more rule of refinement, with its values at their defaults, of no body. */
base_status mpm_scene_add_refine(mpm_scene *s, const char *kind, mpm_refine **added);
/* One more cavity at its defaults, of that name. */
base_status mpm_scene_add_cavity(mpm_scene *s, const char *name, mpm_cavity **added);
base_status mpm_scene_add_pair(mpm_scene *s, int a, int b, mpm_pair **added); /* as the scene's default contact */

/* How these two groups touch: the scene's pair, or what holds for those without one. */
mpm_pair mpm_scene_contact(const mpm_scene *s, int a, int b);

/* Every member of a scene's structs once: name, unit, default, range, offset.  Solids' values and contacts' are in
 * their kinds' and laws' tables, materials in mpm_material_params.  From row MPM_.._KEYED on, the rows are the keys of
 * a case file too.  The members before MPM_SCENE_HASHED change nothing of what a scene is at a time: they are not in
 * its hash. */
enum { MPM_BODY_KEYED = 8, MPM_AXIS_KEYED = 4, MPM_SCENE_KEYED = 1, MPM_SCENE_HASHED = 2 };
/* The rows of the numerical method, for every struct that has members of these names: a scene, and whatever a scene is
 * made from. */
/* clang-format off */
#define MPM_METHOD_PARAMS(type)                                                                                   \
    PARAM_INT(type, levels, 0, 0, MPM_MAX_LEVELS,                                                                 \
              "of the grid, each with cells twice as large; 0: as coarse_cell allows, without rules of `refine` 1"), \
    PARAM_VEC3(type, grid_shift, "1", 0.0, 0.0, 1 << (MPM_MAX_LEVELS - 1),                                        \
               "of the grid's planes along x, y, z, in finest cells; the window's ends and the bodies stay"),     \
    PARAM_DOUBLE(type, courant, "1", 0.4, 0.01, 0.6,                                                              \
                 "Courant number of c + |v|; it smears points at a surface"),                  \
    PARAM_DOUBLE(type, viscosity_linear, "1", 0.2, 0.0, 2.0, "(M-5) linear coefficient"),                         \
    PARAM_DOUBLE(type, viscosity_quadratic, "1", 2.0, 0.0, 10.0, "(M-5) quadratic coefficient"),                  \
    PARAM_INT(type, particles_per_axis, 2, 2, 3, "material points a cell and axis"),                              \
    PARAM_ENUM(type, transfer, mpm_transfer_names, MPM_TRANSFER_TPIC, "how velocity goes between points and grid"),   \
    PARAM_ENUM(type, basis, mpm_basis_names, MPM_BASIS_GIMP, "shape functions"),                                      \
    PARAM_BOOL(type, heat_by_plastic_work, 0, "(M-4) temperature by plastic work; no: by energy")
/* clang-format on */

extern const base_param mpm_body_params[], mpm_axis_params[], mpm_pair_params[], mpm_scene_params[];
/* Names of choices, NULL at the end: -x +x -y +y -z +z; x y z; and of the enumerators above. */
extern const char *const mpm_face_names[], *const mpm_axis_names[];
extern const char *const mpm_boundary_names[], *const mpm_transfer_names[], *const mpm_basis_names[];
extern const char *const mpm_boundary_docs[]; /* by kind: what it does */

uint64_t mpm_scene_hash(const mpm_scene *s); /* of every member but the run's; needs all materials, kinds and laws */

int mpm_scene_groups(const mpm_scene *s); /* one more than the highest group of a body */

base_status mpm_scene_copy(const mpm_scene *from, mpm_scene *to); /* arrays of its own; the same borrowed materials */
void mpm_scene_free(mpm_scene *s); /* of one that mpm_scene_default began or of zero bytes; leaves an empty one */

#ifdef __cplusplus
}
#endif

#endif
