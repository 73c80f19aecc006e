/* From a site's state to the scene: bodies, contact laws, grid, end time, and what the crater is measured by.
 *
 * x = 0, y = 0, z = 0 is the middle of the grain's foot on the undamaged surface; the armature comes from -x.
 * Bodies, in this order, later ones winning points: rail (box), layers (boxes, the last one's top is y = 0), grain,
 * armature; a pit is a hole in rail and layers in place of a grain.  Rail, layers and grain share a velocity field
 * where they are welded for good; a layer or a grain with a bond strength begins a field of its own, bonded to what
 * lies below it; the armature has the last field.
 * Window: along x the rail fills it and absorbs waves at both ends (a roller or a free end for the armature, which
 * leaves ahead); below the rail a roller; above the middle of the bore, the mirror plane of the launcher; across, z = 0
 * the mirror of a half model, a free side beyond the edges.
 * A node lies on the rail's surface, whatever the case: every fine zone starts a whole number of cells from it.
 * Extents a case leaves out: lay_out in the source, in grain radii; kept inside the rail.
 * The armature starts with its lead face a fine cell short of the grain's upper upstream edge.  It is pressed on by a
 * body force: contact pressure x contact face / mass.  Laws that tests/test_handoff.c checks: no two bodies overlap,
 * the grain's foot is on the surface, masses and the pressing force are those of the case, whatever the case. */
#ifndef BREECH_COUPLING_SCENE_FROM_STATE_H
#define BREECH_COUPLING_SCENE_FROM_STATE_H

#include "coupling/case/case.h"
#include "coupling/gouge/crater.h"
#include "coupling/gouge/site_state.h"
#include "mpm/mpm.h"
#include "mpm/scene.h"

/* state: grain, velocity and contact pressure are used.  The scene borrows its materials from the case.
 * STATUS_BAD_INPUT names what cannot be built and which key to change. */
status gouge_scene_from_state(const breech_case *c, const site_state *state, double cells_per_radius, mpm_scene *out,
                              crater_spec *spec);

/* The same without the spec, which takes some 20 ms: does this case make a scene? */
status gouge_scene_bodies(const breech_case *c, const site_state *state, double cells_per_radius, mpm_scene *out);

/* `breech scene`: the case's own particle, velocity and contact pressure (none where it gives none). */
site_state gouge_state_of_case(const breech_case *c);

/* How long the armature's contact face takes to cross the fine zone, from the scene's start [s]. */
double gouge_crossing_time(const mpm_scene *scene);

/* When the grain, or the pit, lies behind the front end of the contact face, and upstream end of that face at a time
 * [s, m]. */
double gouge_grain_passed(const mpm_scene *scene);
double gouge_face_tail(const mpm_scene *scene, double time);

/* Is such a scene over, and judged, once the growth of its groove is known (scene.stop_when_gauged)?  Only of a groove
 * that is followed. */
bool gouge_is_gauged(const breech_case *c);

/* When it will be over, for all that is known before: at its second gauge, or at its end [s]. */
double gouge_last_time(const breech_case *c, const mpm_scene *scene);

/* Half way between its gauges or later: does the groove's plastic power fall so fast that the rest of the way would not
 * change the answer? */
bool gouge_groove_dies(const breech_case *c, const mpm_scene *scene, const mpm_report *now);

/* A growth [1/s] as e-folds over the way between the two gauges [1]; one that died before the first has the growth NAN
 * and counts as -3, and none as less. */
double gouge_growth_folds(double growth, double radius, double velocity);

/* Does the crater count this body's points (rail and layers; not the grain, not the armature)? */
bool gouge_body_is_rail(const mpm_scene *scene, int body);
int gouge_body_of_armature(const mpm_scene *scene); /* its index */

#endif
