/* SPDX-License-Identifier: BSD-3-Clause */
/* The output directory: where a run writes, what may be overwritten, and how a file appears there at once.
 *
 * Rules: -o defaults to out/<case>.  A finished result is not overwritten without --force, a stopped one that holds a
 * checkpoint neither (resume it, or --force).  --resume of a finished result has nothing to do, --resume of nothing
 * starts anew: so a scheduler can always pass --resume.  Two runs never write to one directory at a time.
 * In a directory that no run has left, files of these names are replaced with --force alone.
 * Files of a directory: the OUTDIR_ names below, scenes/<name>/scene-000012.hdf with scene.hdf.series, plots as .svg.
 */
#ifndef BREECH_COUPLING_OUTDIR_H
#define BREECH_COUPLING_OUTDIR_H

#include "base/status.h"
#include "coupling/host/file_text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define OUTDIR_SUMMARY "summary.json"
#define OUTDIR_HISTORY "history.h5"
#define OUTDIR_USED "used.yaml"
#define OUTDIR_RUN_BY "# Run by: breech " /* used.yaml begins with it */
#define OUTDIR_CHECKPOINT "checkpoint.bin"
#define OUTDIR_REPORT "report.html"
#define OUTDIR_SWEEP "sweep.csv" /* of `breech sweep`: its runs, in SI units */
#define OUTDIR_STORE "store"     /* scenes by key (run/store.h); stays when a run is overwritten */

enum { OUTDIR_PATH_SIZE = 1024 };

typedef struct {
    bool force;  /* --force: overwrite; the old run's files are removed first */
    bool resume; /* --resume */
} outdir_options;

typedef enum {
    OUTDIR_NEW,     /* empty: start */
    OUTDIR_RESUMED, /* holds a checkpoint: go on from it */
    OUTDIR_FINISHED /* --resume of a finished run: nothing to do, exit 0 */
} outdir_state;

typedef struct {
    char path[OUTDIR_PATH_SIZE];
    outdir_state state;
    int lock; /* descriptor of the locked directory */
} outdir;

/* "out/<name of the case>" into path; the name with anything but letters, digits, - _ . made '-'. */
status host_outdir_default(const char *case_name, char *path, size_t size);

/* Makes the directory (parents too), locks it, applies the rules.  STATUS_BAD_INPUT where a rule forbids the run,
 * STATUS_IO where the directory cannot be made or written.  On error nothing is changed and nothing needs closing. */
status host_outdir_open(const char *path, outdir_options options, outdir *out);
void host_outdir_close(outdir *d);

/* With its parents; fine when it is there. */
status host_folder_make(const char *path);
/* Can files be made in it?  STATUS_IO: no. */
status host_folder_probe(const char *path);
/* DIR/name into path. */
status host_outdir_file(const outdir *d, const char *name, char *path, size_t size);
/* A name that files, HDF5 groups and scripts take as it is: letters, digits, - _ . and no leading dot. */
bool host_name_is_plain(const char *name);
/* DIR/scenes/<scene>, made when missing; scene must be a plain name. */
status host_outdir_scene(const outdir *d, const char *scene, char *path, size_t size);

/* Removes DIR/scenes/<scene> with the snapshots in it, where there is one. */
void host_outdir_drop_scene(const outdir *d, const char *scene);

/* ---- a file appears at once or not at all ---- */

/* Write `bytes` to path: path.part, fsync, rename.  On error path is as it was and no .part is left. */
status host_file_write(const char *path, const void *data, size_t bytes);
/* The same by pieces: begin, fprintf/fwrite to the stream, end.  end with keep = false drops it. */
typedef struct {
    FILE *stream;
    char path[OUTDIR_PATH_SIZE], part[OUTDIR_PATH_SIZE + 8];
} file_writer;
status host_file_begin(file_writer *w, const char *path);
status host_file_end(file_writer *w, bool keep);
/* The whole file, a 0 byte after it; *data is malloc'ed.  bytes may be NULL. */
status host_file_read(const char *path, char **data, size_t *bytes);

/* The word `status` of the summary.json in dir; "" when there is none or it cannot be read. */
void host_outdir_status(const char *dir, char *out, size_t size);

#endif
