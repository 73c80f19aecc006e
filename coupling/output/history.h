/* SPDX-License-Identifier: BSD-3-Clause */
/* history.h5: time series and maps of a run, every dataset with `units` and `description`.
 *
 *   /shot/<column>                  the shot, a row a sample
 *   /shot/modules/<column>          currents and voltages of the bank's groups
 *   /shot/events/<column>           what happened when
 *   /scene/<name>/<column>          one scene, a row a sample
 *   /scene/<name>/<map>/<value>     a map, with its axes; its numbers as attributes
 * The file on disk is always complete: rows gather in memory, output_history_flush puts the whole file there at once.
 */
#ifndef BREECH_COUPLING_HISTORY_H
#define BREECH_COUPLING_HISTORY_H

#include "base/status.h"
#include "circuit/shot.h"
#include "coupling/host/hdf5_file.h"
#include "mpm/mpm.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct history history; /* owns its file in memory */

typedef struct {
    const char *name, *unit, *description;
} history_column;

/* resume: take up the file that is there (a new one when there is none); else an older file is replaced at the first
 * flush. path NULL: in memory only, never flushed. */
status output_history_open(const char *path, bool resume, history **out);

/* A group of columns ("/shot", "/scene/a"); appended to when it is there.  columns: n, copied.  The first column is the
 * time.  Opening the same group again gives the same series. */
status output_history_series(history *h, const char *group, const history_column *columns, int n, int *series);
/* The same of arrays: column c has width[c] values in every row, a dataset of two dimensions; the time has one. */
status output_history_arrays(history *h, const char *group, const history_column *columns, const int *width, int n,
                             int *series);
/* row: the columns' values, one column after the other. */
status output_history_append(history *h, int series, const double *row);
/* Drops the rows later than `time`: for a run that goes on from a checkpoint. */
status output_history_rewind(history *h, int series, double time);
/* No more rows for this series: its place is free for another. */
status output_history_end(history *h, int series);

status output_history_flush(history *h);
/* Flushes when the last one was five seconds ago and less than a twentieth of the time goes into flushing. */
status output_history_tick(history *h);
/* Flushes and frees; NULL allowed. */
status output_history_close(history *h);

/* /scene/<scene> as the group /scene of another file, and back; no series of it may be open in the one that gets it. */
status output_history_export(history *h, const char *scene, h5_file *to);
status output_history_import(history *h, const char *scene, const h5_file *from);
/* The same from one history to another; nothing where there is none. */
status output_history_copy_scene(history *from, const char *scene, history *to);
bool output_history_has(const history *h, const char *scene);
/* A dataset of a scene, "probes/push/force_x", rows not yet written included; as host_h5_read. */
status output_history_read(history *h, const char *scene, const char *name, double **data, size_t dims[H5_MAX_RANK]);

/* A text of a scene, /scene/<scene>/<name>, a former one replaced; *text is malloc'ed, the caller frees it. */
status output_history_text(history *h, const char *scene, const char *name, const char *description, const char *text);
status output_history_read_text(const history *h, const char *scene, const char *name, char **text);

/* A map over two axes, with numbers and texts as attributes: /scene/<scene>/<name>/{axes, value}.  All borrowed. */
typedef struct {
    const char *name;
    double value;
} history_number;
typedef struct {
    const char *name, *text;
} history_text;
typedef struct {
    const char *name;         /* of the map */
    history_column across[2]; /* its axes */
    history_column value;     /* what it holds over them */
    int n[2];                 /* places along each axis */
    double first[2], step[2]; /* first place and spacing, in the axis's unit */
    const double *values;     /* n[0] x n[1] */
    int numbers, texts;
    const history_number *number;
    const history_text *text;
} history_map;
/* A former one of that name is replaced. */
status output_history_map(history *h, const char *scene, const history_map *map);

/* ---- the rows of Breech's own series ---- */

enum { HISTORY_MAX_COLUMNS = 4096 }; /* of /shot/modules and /scene/<name> */

status output_history_shot(history *h, int *series); /* /shot */
void output_history_shot_row(const circuit_shot_state *s, double *row);
status output_history_events(history *h, int *series); /* /shot/events */
void output_history_event_row(const circuit_shot_event *e, double *row);
status output_history_modules(history *h, const circuit_shot *s,
                              int *series); /* /shot/modules: as many groups as fit */
void output_history_modules_row(const circuit_shot *s, double *row);
/* /scene/<name>, with n more columns of the caller's behind those that every scene has. */
status output_history_scene(history *h, const char *scene, const history_column *more, int n, int *series);
/* force: [3] of contact, on the group that scene_job names [N].  Returns where the caller's values go. */
double *output_history_scene_row(const mpm_report *r, const mpm_ledger *l, const double *force, double *row);

/* The manual's lists of columns, in markdown: one, and those of the series above. */
void output_history_print_columns(const char *group, const history_column *columns, int n, FILE *out);
void output_history_print_all_columns(FILE *out);

#endif
