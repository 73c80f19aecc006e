/* Probes of a scene: what is followed step by step, a series each and what it has come to.
 *
 * A probe of a force feels what the body's group gets from all groups that it touches, mean over a step.
 * History: /scene/<name>/probes/<probe>/force_x, _y, _z, a row a step. */
#ifndef BREECH_COUPLING_SCENE_PROBE_H
#define BREECH_COUPLING_SCENE_PROBE_H

#include "coupling/output/history.h"
#include "coupling/output/summary.h"
#include "mpm/mpm.h"

typedef struct {
    char name[PARAM_TEXT_SIZE];
    int group; /* whose force it feels */
} scene_probe;

typedef struct {
    int n;
    const scene_probe *item; /* borrowed */
} scene_probes;

/* Plain bytes: part of a checkpoint.  All zero but arrival = NAN at first. */
typedef struct {
    double peak, peak_time; /* of the force's size; when [N, s] */
    double arrival;         /* when it was first not zero; NAN: never [s] */
    double impulse[3];      /* [N s] */
} scene_probe_state;

typedef struct {
    char name[PARAM_TEXT_SIZE];
    scene_probe_state is;
} scene_probe_result;

extern const summary_key scene_probe_keys[]; /* of scene_probe_result */

/* The series of all probes; its rows later than `reached` are dropped [s]. */
status scene_probe_series(history *h, const char *scene, const scene_probes *probes, double reached, int *series);
/* A step has ended that began at `since` [s]: adds it to the state and fills the row, 1 + 3 n numbers. */
void scene_probe_step(const scene_probes *probes, double since, const mpm_report *now, scene_probe_state *state,
                      double *row);

#endif
