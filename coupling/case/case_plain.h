/* Plain structs made from a case, for those who need no more than one of them: SI numbers, nothing of the file.
 *
 * They borrow what they point to from the case and hold until it is changed or freed.  Who varies an input changes the
 * copy in the struct, never the case. */
#ifndef BREECH_COUPLING_CASE_PLAIN_H
#define BREECH_COUPLING_CASE_PLAIN_H

#include "coupling/case/case.h"

/* Supplies, rails, barrel, armature and tolerances, as the circuit takes them; no sites. */
shot_config case_launcher(const breech_case *c);

/* A shot past the grains of the rail. */
typedef struct {
    shot_config launcher;
    const case_projectile *body; /* whose face is pressed on the rail; NULL: the circuit's contact is all there is */
    const case_site *site;       /* n_sites */
    int n_sites;
    double history_interval; /* least time between two samples [s]; NaN: every step */
} case_flight;
case_flight case_flight_of(const breech_case *c);

/* The armature over a grain on the rail: all that decides such a scene.  Of one that a study varies, grain, velocity,
 * contact pressure and resolution are set anew for every scene (gouge_impact_at). */
typedef struct {
    case_rail rail;
    case_projectile armature;
    case_particle particle;
    case_scene scene;
    case_materials materials;   /* all that rail, layers, armature and grains may name */
    int snapshots;              /* of the scene, evenly over its time; where they lie it may end */
    double checkpoint_interval; /* wall time; decides nothing [s] */
} case_impact;
case_impact case_impact_of(const breech_case *c);

/* The case file that `breech scene` computes just this scene from: every value resolved, the constants of the materials
 * named.  Read back it is the same impact, bit for bit. */
status case_impact_write(const case_impact *i, FILE *file);

/* What meets at the rail's surface. */
typedef struct {
    const material *rail, *armature; /* rail: the top layer where there are layers */
    double yield_scale;              /* of the rail's strength and hardness [1] */
    double screen_low;               /* impact pressure over hardness below which no scene is needed [1] */
} case_surface;
case_surface case_surface_of(const breech_case *c);

#endif
