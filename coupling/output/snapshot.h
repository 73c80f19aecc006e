/* SPDX-License-Identifier: BSD-3-Clause */
/* Scene snapshots for ParaView: VTKHDF 1.0 UnstructuredGrid, one vertex cell a point, extension .hdf.
 *
 * Every entry of PARTICLE_FIELDS (mpm/mpm.h) but the position becomes a point array, float32, with `units` and
 * `description`; the position becomes Points.  DIR/scene-000012.hdf, and DIR/scene.hdf.series lists them with their
 * times: that is the file to open. */
#ifndef BREECH_COUPLING_SNAPSHOT_H
#define BREECH_COUPLING_SNAPSHOT_H

#include "base/status.h"
#include "mpm/mpm.h"

typedef struct snapshots snapshots; /* owns the list of what was written */

/* dir must exist.  resume_time: snapshots of that scene with a time up to it are kept and go on being counted, later
 * ones are removed [s]; a negative one starts anew and removes all. */
status output_snapshots_open(const char *dir, double resume_time, snapshots **out);
/* The same, always anew, but the files are handed to somebody else: on processes that write nothing themselves. */
typedef struct {
    status (*put)(void *user, const char *path, const void *data, size_t bytes); /* path: dir/scene-000012.hdf */
    void *user;                                                                  /* borrowed */
} snapshot_sink;
status output_snapshots_open_sink(const char *dir, const snapshot_sink *sink, snapshots **out);
/* The file and the index that lists it are written while the program goes on: STATUS_IO, disk full, comes from the next
 * call, or from the wait, which must come before what relies on them: a checkpoint, or the scene's end. */
status output_snapshots_write(snapshots *s, const mpm *m);
status output_snapshots_wait(snapshots *s); /* NULL allowed */
int output_snapshots_count(const snapshots *s);
void output_snapshots_close(snapshots *s); /* waits; NULL allowed */

/* What a snapshot holds, without a solver: for tests and other writers. */
typedef struct {
    double time; /* [s] */
    size_t n;
    void (*read)(const void *source, float *const out[MPM_FIELD_COUNT]); /* as mpm_read_all */
    const void *source;                                                  /* borrowed */
} snapshot_source;
status output_snapshots_write_source(snapshots *s, const snapshot_source *source);

#endif
