/* SPDX-License-Identifier: BSD-3-Clause */
/* Probes of a scene (mpm_scene.probe) while it runs: a series each, and what it came to.
 *
 * A probe is read at the start and at the end of every piece; one of one row also when a thousandth of the scene's time
 * has gone by since, one that is about a step (mpm_probe_kind.of_step) after every step.
 * History: /scene/<name>/probes/<probe>/time and a dataset a column, of a map (a probe of more rows) an array of times
 * and rows.
 * What a probe came to is read from its series at the end, so that nothing of it is part of a checkpoint. */
#ifndef BREECH_COUPLING_SCENE_PROBE_H
#define BREECH_COUPLING_SCENE_PROBE_H

#include "coupling/output/history.h"
#include "coupling/output/summary.h"
#include "mpm/mpm.h"
#include "mpm/read/probe.h"

enum { SCENE_PROBE_COLUMNS = 16 };

/* Of the quantity that stands for its kind (mpm_probe_kind.main), all NAN for a map and for what was never there. */
typedef struct {
    char name[BASE_PARAM_TEXT_SIZE], kind[BASE_PARAM_TEXT_SIZE];
    char quantity[BASE_PARAM_TEXT_SIZE], unit[BASE_PARAM_TEXT_SIZE];
    double peak, peak_time, least, arrival; /* [unit], [s] */
    double impulse[3];                      /* of a vector all three, of one number the first [unit s] */
    int columns;
    char column[SCENE_PROBE_COLUMNS][BASE_PARAM_TEXT_SIZE];
    double last[SCENE_PROBE_COLUMNS]; /* at the end, in the columns' units */
    double mean[SCENE_PROBE_COLUMNS]; /* over the scene's time */
} scene_probe_result;

extern const summary_key scene_probe_keys[]; /* of scene_probe_result */

typedef struct scene_probes scene_probes; /* records them; owns its rows */

/* history and scene are borrowed.  reached: the time from which the scene goes on, whose rows are there [s]; below 0:
 * from the start. */
status scene_probes_open(history *h, const char *name, const mpm_scene *scene, double reached, scene_probes **out);
/* After every step; shown the same one twice it writes one row. */
status scene_probes_step(scene_probes *p, const mpm *m);
/* At the start, and at the end of every piece. */
status scene_probes_piece(scene_probes *p, const mpm *m);
/* What they came to, into out[scene->probes]; no row may follow. */
status scene_probes_end(scene_probes *p, scene_probe_result *out);
void scene_probes_free(scene_probes *p); /* NULL allowed */

/* The manual's list of what every kind of probe writes, in markdown. */
void scene_probe_print_columns(FILE *out);

#endif
