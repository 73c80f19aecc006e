/* SPDX-License-Identifier: BSD-3-Clause */
/* From an impact to its scene: bodies, contact laws, grid, end time, and what the crater is measured by.
 *
 * x = 0, y = 0, z = 0 is the middle of the grain's foot on the undamaged surface; the armature comes from -x.
 * Bodies, in this order, later ones winning points: rail (box), layers (boxes, the last one's top is y = 0), grain,
 * armature; a pit is a hole in rail and layers in place of a grain.  Rail, layers and grain share a group
 * where they are welded for good; a layer or a grain with a bond strength begins a group of its own, bonded to what
 * lies below it; the armature has the last group.
 * Window: along x the rail fills it and absorbs waves at both ends (a roller or a free end for the armature, which
 * leaves ahead); below the rail a roller; above the middle of the bore, the mirror plane of the launcher; across, z = 0
 * the mirror of a half model, a free side beyond the edges.
 * A node lies on the rail's surface, whatever the case: every fine zone starts a whole number of cells from it.
 * Extents a case leaves out: lay_out in the source, in grain radii; kept inside the rail.
 * The armature starts with its lead face a fine cell short of the grain's upper upstream edge.  It is pressed on by a
 * body force: contact pressure x contact face / mass.  Laws that tests/test_handoff.c checks: no two bodies overlap,
 * the grain's foot is on the surface, masses and the pressing force are those of the case, whatever the case. */
#ifndef BREECH_COUPLING_IMPACT_SCENE_H
#define BREECH_COUPLING_IMPACT_SCENE_H

#include "coupling/gouge/crater.h"
#include "coupling/gouge/site_state.h"
#include "mpm/mpm.h"
#include "mpm/scene.h"

/* A scene, which of its bodies is what, and the numbers by which it is watched and judged.  The roles are said here
 * alone: nobody looks a body up by its name or counts on its place. */
typedef struct {
    mpm_scene scene;      /* borrows its materials from the case */
    int rail, layers;     /* body of the rail; its layers are the so many bodies after it, from the bottom up */
    int grain;            /* GOUGE_PIT: none, but a hole in rail and layers */
    int armature;         /* the body */
    double velocity;      /* of the armature at the start [m/s] */
    double friction;      /* Coulomb coefficient between all of them [1] */
    double cell;          /* at the grain; layers may have smaller ones [m] */
    double face_front;    /* of the armature's contact face at the start: its downstream end, */
    double face_tail;     /*   its upstream end [m] */
    double grain_end;     /* downstream end of grain or pit [m] */
    double reach, beside; /* downstream end of what is looked at; half width of the rail [m] */
    double gauge_time[2]; /* when the growth of the groove is gauged; 0: never, it is not followed [s] */
    bool gauged;          /* over, and judged, once that growth is known */
    bool stop_when_settled;
    bool cells_grow;                /* with the groove, past its second gauge (growth.h) */
    double limit_length_over_width; /* of a gouge at its second gauge [1] */
    double growth_scatter;          /* e-folds between the gauges within which growth decides nothing [1] */
    crater_spec crater;
} gouge_scene;

enum { GOUGE_PIT = -1 };

/* Cells across a layer that resolve its bending and shear: two, or almost, for cells can only be halved.  With less
 * than one it is a film, strained as its cell is (docs/theory/onset.md). */
#define GOUGE_RESOLVED_LAYER 1.8
#define GOUGE_ALMOST 1.1 /* a layer's cells may be so much larger than asked for: they can only be halved */

/* An impact decides its scene; a contact pressure that it does not give is none, a temperature of its armature
 * CASE_ROOM_TEMPERATURE.  The caller frees the scene; after an error it is empty.  STATUS_BAD_INPUT names what cannot
 * be built and which key to change. */
status gouge_scene_make(const case_impact *c, gouge_scene *out);

void gouge_scene_free(gouge_scene *s);

/* How often a layer of that thickness has the grain's cells, of `fine` [m], halved where it flows, to have as many
 * across as the case says; 0 also where that would take more levels than there may be. */
int gouge_layer_halvings(const case_scene *s, double fine, double thickness);

/* Cells that a layer then has across. */
double gouge_cells_across(const case_scene *s, double fine, double thickness);

/* The same without what the crater is measured by, which takes some 20 ms: does this case make a scene? */
status gouge_scene_bodies(const case_impact *c, gouge_scene *out);

/* What a shot makes its armature's lead face is taken in steps of this, so that searches share scenes [K]. */
#define GOUGE_TEMPERATURE_STEP 5.0

/* The impact with this state's grain, velocity and contact pressure, at that resolution; where the impact gives the
 * armature no temperature, with that of the state's lead face, below melting. */
case_impact gouge_impact_at(const case_impact *from, const site_state *state, double cells_per_radius);

/* Does the crater count this body's points: the rail or one of its layers? */
bool gouge_counts_as_rail(const gouge_scene *s, int body);
bool gouge_is_layer(const gouge_scene *s, int body);

/* Is its groove followed: its plastic front looked for, its growth gauged? */
bool gouge_is_followed(const gouge_scene *s);

/* How long the armature's contact face takes to cross what is looked at, from the scene's start [s]. */
double gouge_crossing_time(const gouge_scene *s);

/* When the grain, or the pit, lies behind the front end of the contact face, and upstream end of that face at a time
 * [s, m]. */
double gouge_grain_passed(const gouge_scene *s);
double gouge_face_tail(const gouge_scene *s, double time);

/* When it will be over, for all that is known before: at its second gauge, or at its end [s]. */
double gouge_last_time(const gouge_scene *s);

#endif
