/* SPDX-License-Identifier: BSD-3-Clause */
/* Plain structs made from a case, for those who need no more than one of them: SI numbers, nothing of the file.
 *
 * They borrow what they point to from the case and hold until it is changed or freed.  Who varies an input changes the
 * copy in the struct, never the case. */
#ifndef BREECH_COUPLING_CASE_PLAIN_H
#define BREECH_COUPLING_CASE_PLAIN_H

#include "coupling/case/case_sections.h"
#include "mpm/mpm.h"

#include <stdio.h>

struct breech_case; /* case.h */

/* The armature over a grain on the rail: all that decides such a scene.  Of one that a study varies, grain, velocity,
 * contact pressure, the armature's heat and resolution are set anew for every scene (gouge_impact_at). */
typedef struct {
    case_rail rail;
    case_projectile armature;
    case_particle particle;
    case_scene scene;
    case_materials materials;   /* all that rail, layers, armature and grains may name */
    int snapshots;              /* of the scene, evenly over its time; where they lie it may end */
    double checkpoint_interval; /* wall time; decides nothing [s] */
} case_impact;

/* Is its scene over, and judged, once the growth of its groove is known?  Only a groove that is followed has one. */
bool case_impact_is_gauged(const case_impact *i);

/* The case file that `breech scene` computes just this scene from: every value resolved, the constants of the materials
 * named.  Read back it is the same impact, bit for bit. */
status case_impact_write(const case_impact *i, FILE *file);

/* A scene whose bodies stand in the case: all that decides it. */
typedef struct {
    const case_bodies *bodies; /* NULL: none */
    const case_materials *materials;
    int snapshots;
    double checkpoint_interval; /* wall time; decides nothing [s] */
} case_body_scene;
/* The same as case_impact_write for it: with a window that is chosen (scene_fill). */
status case_body_scene_write(const case_body_scene *s, FILE *file);

/* A shot over grains on the rail: the launcher, the grains, what their scenes are made of, how thresholds are looked
 * for.  What studies of onset vary. */
typedef struct {
    circuit_shot_config launcher; /* supplies, rails, barrel, armature and tolerances; no sites */
    double history_interval;      /* of the shot: least time between two samples [s]; NaN: every step */
    case_sites sites;
    case_populations populations;
    bool has_body; /* impact.armature is given; else the circuit's contact is all there is */
    case_impact impact;
    case_study study;
} case_onset;

/* A shot past the grains of the rail. */
typedef struct {
    circuit_shot_config launcher;
    const case_projectile *body; /* whose face is pressed on the rail; NULL: the circuit's contact is all there is */
    const case_site *site;       /* n_sites */
    int n_sites;
    double history_interval; /* as case_onset has it */
} case_flight;
case_flight case_flight_of(const case_onset *c);

/* What meets at the rail's surface: the armature, and the rail with its layers.  What it points to is borrowed. */
typedef struct {
    const mpm_material *armature;
    double armature_hardness; /* its material's by its yield_scale [Pa] */
    case_rail rail;
    case_materials materials;
    double screen_low; /* impact pressure over hardness below which no scene is needed [1] */
} case_surface;
case_surface case_surface_of(const case_onset *c);

/* All that a case gives. */
typedef struct {
    const char *name, *title, *path;
    const char *warnings; /* a line each */
    case_given given;
    case_onset onset;
    circuit_firing_wish optimise;
    case_treatments treatments;
    case_bodies bodies;
    case_sweep sweep;
    case_strike strike;
    case_targets targets;
    case_life life;
    case_vessel vessel;
    case_output output;
    const struct breech_case *file; /* what it was made from; for this folder alone */
} case_inputs;
case_inputs case_inputs_of(const struct breech_case *c);
case_body_scene case_body_scene_of(const case_inputs *in); /* borrows of *in */

/* As case_read and case_read_memory; case_inputs_free frees *out and all that it borrows. */
status case_inputs_read(const char *path, const char *const *sets, int n_sets, const case_options *options,
                        case_inputs **out, char **errors);
status case_inputs_read_memory(const case_text *text, const case_options *options, case_inputs **out, char **errors);
void case_inputs_free(case_inputs *in); /* NULL allowed */

/* Pressure in the patch's middle under load: wheel, (6) of ma2020 where the wheel's load is given [Pa]. */
double case_life_peak(const case_life *c);
/* The largest pressure that a metal's face carries (L-11): its hardness; else three times its flow stress at a strain
 * of 8 %, which is what hardness is; else 0.04 of Young's modulus, which bearing steel has (8 of 210 GPa).  *by: which,
 * in words.  [Pa] */
double case_life_carried(const mpm_material *m, const char **by);

/* The place in the case of what a message is about, before the message: case_place.h. */
void case_inputs_place(const case_inputs *in, const char *message, char *out, size_t size);

/* What the solver refuses of a scene of bodies, said of the case's keys: "scene.bodies[1].held: why". */
void case_refused_text(const mpm_refused *at, const char *why, char *out, size_t size);

/* used.yaml: case_write_used, with what the program has decided of the bodies' scene since. */
status case_inputs_write(const case_inputs *in, FILE *file);

/* A case of this scene: case_write_scene. */
status case_inputs_write_scene(const case_inputs *in, const mpm_scene *s, FILE *file);

/* The manual's key list, in markdown. */
void case_print_keys(FILE *file);

#endif
