/* SPDX-License-Identifier: BSD-3-Clause */
/* HDF5 behind one file: a tree of datasets held in memory, saved whole.
 *
 * A file lives in memory until host_h5_save writes it: NAME.part, fsync, rename.  So whatever happens to the process,
 * NAME is always a complete file in the default format, and others may read it while the run goes on.  Memory: the size
 * of the file. Paths are absolute inside the file ("/shot/time"); missing groups are made.  Every dataset carries
 * `units` and `description`.  Errors: STATUS_IO (files), STATUS_MEMORY; the text names the file or the dataset. */
#ifndef BREECH_COUPLING_HDF5_FILE_H
#define BREECH_COUPLING_HDF5_FILE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct h5_file h5_file; /* owns its memory */

enum { H5_MAX_RANK = 2 };

typedef enum { H5_DOUBLE, H5_FLOAT, H5_INT64, H5_UINT8 } h5_type;

/* What a dataset is called and means.  unit and description may be NULL (none written). */
typedef struct {
    const char *path, *unit, *description;
} h5_name;

/* An array of `rank` dimensions, the last one fastest; data borrowed. */
typedef struct {
    h5_type type;
    int rank;
    size_t dims[H5_MAX_RANK];
    const void *data;
} h5_array;

status host_h5_create(h5_file **out);
status host_h5_open(const char *path, h5_file **out); /* a copy in memory; the file itself is not kept open */
status host_h5_save(h5_file *f, const char *path);
/* The file as bytes, borrowed until it is changed or closed; and back.  what: names it in messages. */
status host_h5_image(h5_file *f, const void **image, size_t *bytes);
status host_h5_open_image(const char *what, const void *image, size_t bytes, h5_file **out);
void host_h5_close(h5_file *f); /* NULL allowed; saves nothing */

bool host_h5_exists(const h5_file *f, const char *path);
status host_h5_group(h5_file *f, const char *path);

/* Copies a group or dataset with all below it into another file; what was there under the new path goes. */
status host_h5_copy(const h5_file *from, const char *path, h5_file *to, const char *to_path);

/* Writes a whole dataset (an older one of that name goes); deflate 1 + shuffle from 1 KiB on.  Not floats: those of
 * snapshots would shrink by a third, for three quarters of the time that a snapshot takes. */
status host_h5_write(h5_file *f, const h5_name *name, const h5_array *array);

/* Appends `rows` rows of `width` values to a dataset of doubles, made when missing; of one dimension where width is 1.
 */
status host_h5_append(h5_file *f, const h5_name *name, const double *values, size_t rows, size_t width);
/* Cuts a dataset that was appended to to its first rows. */
status host_h5_truncate(h5_file *f, const char *path, size_t rows);

/* Reads a dataset as doubles; *data is malloc'ed, the caller frees it; dims past the rank are 1. */
status host_h5_read(const h5_file *f, const char *path, double **data, size_t dims[H5_MAX_RANK]);

/* Names in a group, sorted, '\n' after each; malloc'ed, the caller frees it. "" when there is no such group. */
status host_h5_list(const h5_file *f, const char *group, char **names);

/* A text of any length as a dataset of bytes; *text is malloc'ed, the caller frees it. */
status host_h5_write_text(h5_file *f, const char *path, const char *description, const char *text);
status host_h5_read_text(const h5_file *f, const char *path, char **text);

status host_h5_attribute_text(h5_file *f, const char *path, const char *name,
                              const char *text); /* fixed length, ASCII */
status host_h5_attribute_double(h5_file *f, const char *path, const char *name, double value);
status host_h5_attribute_ints(h5_file *f, const char *path, const char *name, const int64_t *values, size_t n);
status host_h5_read_attribute_double(const h5_file *f, const char *path, const char *name, double *out);
/* STATUS_IO when it is missing or longer than size - 1. */
status host_h5_read_attribute_text(const h5_file *f, const char *path, const char *name, char *out, size_t size);

#endif
