/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/hdf5_file.h"

#include "coupling/host/outdir.h"

#include <H5public.h>
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GROWTH = 1 << 20, CHUNK_ROWS = 1024, COMPRESS_FROM = 1024, CHUNK_VALUES = 1 << 16 };

struct h5_file {
    hid_t id;
    char name[200]; /* for messages */
};

/* Breech says itself what went wrong; HDF5's own stack would go to stderr. */
static void be_quiet(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static hid_t memory_access(void)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0) H5Pset_fapl_core(access, GROWTH, false);
    return access;
}

/* Never reaches the disk under this name (no backing store), but HDF5 tells files in memory apart by it: the address is
 * the file's own as long as it is open. */
static status allocate(const char *path, h5_file **out, char *name, size_t size)
{
    h5_file *f = malloc(sizeof *f);
    CHECK(f, STATUS_MEMORY, "%.200s: no memory", path);
    snprintf(f->name, sizeof f->name, "%s", path);
    snprintf(name, size, "breech-memory-%p.h5", (void *)f);
    *out = f;
    return status_ok();
}

status host_h5_create(h5_file **out)
{
    *out = NULL;
    be_quiet();
    h5_file *f = NULL;
    char name[64];
    TRY(allocate("new HDF5 file", &f, name, sizeof name));
    const hid_t access = memory_access();
    f->id = H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    H5Pclose(access);
    if (f->id < 0) {
        free(f);
        return base_status_error(STATUS_MEMORY, "an HDF5 file cannot be made in memory");
    }
    *out = f;
    return status_ok();
}

static hid_t open_memory(const char *name, const void *image, size_t bytes)
{
    if (bytes == 0) return -1;
    const hid_t access = memory_access();
    H5Pset_file_image(access, (void *)image, bytes); /* copied */
    const hid_t id = H5Fopen(name, H5F_ACC_RDWR, access);
    H5Pclose(access);
    return id;
}

status host_h5_open_image(const char *what, const void *image, size_t bytes, h5_file **out)
{
    char name[64];
    *out = NULL;
    be_quiet();
    h5_file *f = NULL;
    TRY(allocate(what, &f, name, sizeof name));
    f->id = open_memory(name, image, bytes);
    if (f->id < 0) {
        free(f);
        return base_status_error(STATUS_IO, "%.300s: is not an HDF5 file, or a damaged one (%zu bytes)", what, bytes);
    }
    *out = f;
    return status_ok();
}

status host_h5_open(const char *path, h5_file **out)
{
    char *image;
    size_t bytes;
    *out = NULL;
    TRY(host_file_read(path, &image, &bytes));
    const status s = host_h5_open_image(path, image, bytes, out);
    free(image);
    return s;
}

/* The superblock, version 0 or 1, of a file that is open says so in its consistency flags, for which nobody asks; those
 * of a whole file are 0.  "HDF5 file format specification", II.A. */
static void clear_flags(uint8_t *image)
{
    enum { VERSION = 8, FLAGS = 20, FLAGS_SIZE = 4 };
    if (image[VERSION] <= 1) memset(image + FLAGS, 0, FLAGS_SIZE);
}

/* The core driver's handle is its pointer to the file's bytes; a flush makes them as long as the file.
 * H5Fget_file_image would copy them. */
status host_h5_image(h5_file *f, const void **image, size_t *bytes)
{
    void *handle = NULL;
    *image = NULL;
    *bytes = 0;
    CHECK(H5Fflush(f->id, H5F_SCOPE_GLOBAL) >= 0, STATUS_IO, "%.300s: HDF5 cannot complete it", f->name);
    const ssize_t size = H5Fget_file_image(f->id, NULL, 0);
    CHECK(size > 0 && H5Fget_vfd_handle(f->id, H5P_DEFAULT, &handle) >= 0, STATUS_IO,
          "%.300s: HDF5 cannot tell its size or place", f->name);
    clear_flags(*(void **)handle);
    *image = *(void **)handle;
    *bytes = (size_t)size;
    return status_ok();
}

status host_h5_save(h5_file *f, const char *path)
{
    const void *image;
    size_t bytes;
    TRY(host_h5_image(f, &image, &bytes));
    return host_file_write(path, image, bytes);
}

void host_h5_close(h5_file *f)
{
    if (!f) return;
    H5Fclose(f->id);
    free(f);
}

/* ---- names and groups ---- */

/* Calls H5Lexists for every part of the path: HDF5 wants the parents to be there first. */
bool host_h5_exists(const h5_file *f, const char *path)
{
    char part[400];
    snprintf(part, sizeof part, "%s", path);
    for (char *c = part + 1;; c++) {
        if (*c != '/' && *c != '\0') continue;
        const char kept = *c;
        *c = '\0';
        if (part[1] && H5Lexists(f->id, part, H5P_DEFAULT) <= 0) return false;
        if (!kept) return true;
        *c = kept;
    }
}

static hid_t link_with_parents(void)
{
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    if (links >= 0) H5Pset_create_intermediate_group(links, 1);
    return links;
}

status host_h5_group(h5_file *f, const char *path)
{
    if (host_h5_exists(f, path)) return status_ok();
    const hid_t links = link_with_parents();
    const hid_t group = H5Gcreate2(f->id, path, links, H5P_DEFAULT, H5P_DEFAULT);
    H5Pclose(links);
    CHECK(group >= 0, STATUS_IO, "%.150s: the group %.150s cannot be made", f->name, path);
    H5Gclose(group);
    return status_ok();
}

/* A group or dataset; nothing when it is not there.  Its room in the file is not given back. */
static void remove_path(h5_file *f, const char *path)
{
    if (host_h5_exists(f, path)) H5Ldelete(f->id, path, H5P_DEFAULT);
}

status host_h5_copy(const h5_file *from, const char *path, h5_file *to, const char *to_path)
{
    CHECK(host_h5_exists(from, path), STATUS_IO, "%.150s: holds no %.150s", from->name, path);
    remove_path(to, to_path);
    const hid_t links = link_with_parents();
    const herr_t done = H5Ocopy(from->id, path, to->id, to_path, H5P_DEFAULT, links);
    H5Pclose(links);
    CHECK(done >= 0, STATUS_IO, "%.150s: %.150s cannot be copied into %.150s", from->name, path, to->name);
    return status_ok();
}

static herr_t add_name(hid_t group, const char *name, const H5L_info_t *info, void *user)
{
    (void)group;
    (void)info;
    fprintf(user, "%s\n", name);
    return 0;
}

status host_h5_list(const h5_file *f, const char *group, char **names)
{
    size_t bytes;
    *names = NULL;
    FILE *out = open_memstream(names, &bytes);
    CHECK(out, STATUS_MEMORY, "no memory for a list of names");
    const hid_t id = host_h5_exists(f, group) ? H5Gopen2(f->id, group, H5P_DEFAULT) : -1;
    if (id >= 0) {
        H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, NULL, add_name, out);
        H5Gclose(id);
    }
    fclose(out);
    CHECK(*names, STATUS_MEMORY, "no memory for a list of names");
    return status_ok();
}

/* ---- attributes ---- */

static status put_attribute(h5_file *f, const char *path, const char *name, hid_t type, hid_t space, const void *value)
{
    const hid_t object = H5Oopen(f->id, path, H5P_DEFAULT);
    herr_t done = -1;
    if (object >= 0) {
        if (H5Aexists(object, name) > 0) H5Adelete(object, name);
        const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
        done = attribute >= 0 ? H5Awrite(attribute, type, value) : -1;
        if (attribute >= 0) H5Aclose(attribute);
        H5Oclose(object);
    }
    CHECK(done >= 0, STATUS_IO, "%.150s: attribute %.60s of %.150s cannot be written", f->name, name, path);
    return status_ok();
}

status host_h5_attribute_text(h5_file *f, const char *path, const char *name, const char *text)
{
    const size_t n = strlen(text);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, n > 0 ? n : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_ASCII);
    const status s = put_attribute(f, path, name, type, space, text);
    H5Sclose(space);
    H5Tclose(type);
    return s;
}

status host_h5_attribute_double(h5_file *f, const char *path, const char *name, double value)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    const status s = put_attribute(f, path, name, H5T_NATIVE_DOUBLE, space, &value);
    H5Sclose(space);
    return s;
}

status host_h5_attribute_ints(h5_file *f, const char *path, const char *name, const int64_t *values, size_t n)
{
    const hsize_t size = n;
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const status s = put_attribute(f, path, name, H5T_NATIVE_INT64, space, values);
    H5Sclose(space);
    return s;
}

static hid_t open_attribute(const h5_file *f, const char *path, const char *name)
{
    const hid_t object = host_h5_exists(f, path) || strcmp(path, "/") == 0 ? H5Oopen(f->id, path, H5P_DEFAULT) : -1;
    const hid_t attribute = object >= 0 && H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1;
    if (object >= 0) H5Oclose(object);
    return attribute;
}

static bool read_text(hid_t attribute, char *out, size_t size)
{
    const hid_t type = H5Aget_type(attribute);
    const size_t n = H5Tget_size(type);
    const bool fits = H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) && n < size;
    if (fits) memset(out, 0, size);
    const bool done = fits && H5Aread(attribute, type, out) >= 0;
    H5Tclose(type);
    return done;
}

status host_h5_read_attribute_text(const h5_file *f, const char *path, const char *name, char *out, size_t size)
{
    out[0] = '\0';
    const hid_t attribute = open_attribute(f, path, name);
    const bool done = attribute >= 0 && read_text(attribute, out, size);
    if (attribute >= 0) H5Aclose(attribute);
    CHECK(done, STATUS_IO, "%.150s: %.150s has no text attribute %.60s", f->name, path, name);
    return status_ok();
}

static bool is_single(hid_t attribute)
{
    const hid_t space = H5Aget_space(attribute);
    const bool single = H5Sget_simple_extent_npoints(space) == 1;
    H5Sclose(space);
    return single;
}

status host_h5_read_attribute_double(const h5_file *f, const char *path, const char *name, double *out)
{
    const hid_t attribute = open_attribute(f, path, name);
    const bool done = attribute >= 0 && is_single(attribute) && H5Aread(attribute, H5T_NATIVE_DOUBLE, out) >= 0;
    if (attribute >= 0) H5Aclose(attribute);
    CHECK(done, STATUS_IO, "%.150s: %.150s has no number %.60s", f->name, path, name);
    return status_ok();
}

static status put_names(h5_file *f, const h5_name *name)
{
    if (name->unit) TRY(host_h5_attribute_text(f, name->path, "units", name->unit));
    if (name->description) TRY(host_h5_attribute_text(f, name->path, "description", name->description));
    return status_ok();
}

/* ---- datasets ---- */

static hid_t native(h5_type type)
{
    switch (type) {
    case H5_DOUBLE: return H5T_NATIVE_DOUBLE;
    case H5_FLOAT: return H5T_NATIVE_FLOAT;
    case H5_INT64: return H5T_NATIVE_INT64;
    case H5_UINT8: return H5T_NATIVE_UINT8;
    }
    return -1;
}

static hid_t chunked(int rank, const hsize_t *chunk, bool compress)
{
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, rank, chunk);
    if (compress) {
        H5Pset_shuffle(creation);
        H5Pset_deflate(creation, 1);
    }
    return creation;
}

/* Chunks of whole rows, about CHUNK_VALUES values each. */
static hid_t creation_for(const h5_array *a, const hsize_t *dims)
{
    size_t values = 1;
    for (int i = 0; i < a->rank; i++) values *= a->dims[i];
    const bool compress = a->type != H5_FLOAT && values * H5Tget_size(native(a->type)) >= COMPRESS_FROM;
    if (!compress) return H5Pcreate(H5P_DATASET_CREATE);
    hsize_t chunk[H5_MAX_RANK] = { dims[0], a->rank > 1 ? dims[1] : 1 };
    const hsize_t row = a->rank > 1 ? dims[1] : 1, rows = CHUNK_VALUES / row > 0 ? CHUNK_VALUES / row : 1;
    if (chunk[0] > rows) chunk[0] = rows;
    return chunked(a->rank, chunk, true);
}

status host_h5_write(h5_file *f, const h5_name *name, const h5_array *a)
{
    remove_path(f, name->path);
    const hsize_t dims[H5_MAX_RANK] = { a->dims[0], a->rank > 1 ? a->dims[1] : 1 };
    const hid_t space = H5Screate_simple(a->rank, dims, NULL), links = link_with_parents(),
                kind = creation_for(a, dims);
    const hid_t set = H5Dcreate2(f->id, name->path, native(a->type), space, links, kind, H5P_DEFAULT);
    const bool empty = a->dims[0] == 0 || (a->rank > 1 && a->dims[1] == 0);
    herr_t done = set < 0 ? -1 : empty ? 0 : H5Dwrite(set, native(a->type), H5S_ALL, H5S_ALL, H5P_DEFAULT, a->data);
    if (set >= 0 && H5Dclose(set) < 0) done = -1;
    H5Pclose(kind);
    H5Pclose(links);
    H5Sclose(space);
    CHECK(done >= 0, STATUS_MEMORY, "%.150s: %.150s cannot be written (no memory?)", f->name, name->path);
    return put_names(f, name);
}

/* Rows of one value: a line; of more: two dimensions. */
static status make_series(h5_file *f, const h5_name *name, size_t width)
{
    const int rank = width > 1 ? 2 : 1;
    const hsize_t none[H5_MAX_RANK] = { 0, width }, any[H5_MAX_RANK] = { H5S_UNLIMITED, width };
    const hsize_t rows = width > 1 && CHUNK_VALUES / width < CHUNK_ROWS ? CHUNK_VALUES / width : CHUNK_ROWS;
    const hsize_t chunk[H5_MAX_RANK] = { rows > 0 ? rows : 1, width };
    const hid_t space = H5Screate_simple(rank, none, any), links = link_with_parents(),
                kind = chunked(rank, chunk, true);
    const hid_t set = H5Dcreate2(f->id, name->path, H5T_NATIVE_DOUBLE, space, links, kind, H5P_DEFAULT);
    if (set >= 0) H5Dclose(set);
    H5Pclose(kind);
    H5Pclose(links);
    H5Sclose(space);
    CHECK(set >= 0, STATUS_IO, "%.150s: %.150s cannot be made", f->name, name->path);
    return put_names(f, name);
}

/* Rows and width of an open dataset; false when it has more dimensions. */
static bool extent_of(hid_t set, hsize_t extent[H5_MAX_RANK])
{
    const hid_t space = H5Dget_space(set);
    const int rank = H5Sget_simple_extent_ndims(space);
    extent[1] = 1;
    const bool plain = rank >= 1 && rank <= H5_MAX_RANK && H5Sget_simple_extent_dims(space, extent, NULL) == rank;
    H5Sclose(space);
    return plain;
}

static herr_t extend(hid_t set, const double *values, hsize_t rows, hsize_t width)
{
    hsize_t grown[H5_MAX_RANK];
    if (!extent_of(set, grown) || grown[1] != width) return -1;
    const hsize_t from[H5_MAX_RANK] = { grown[0], 0 }, added[H5_MAX_RANK] = { rows, width };
    grown[0] += rows;
    if (H5Dset_extent(set, grown) < 0) return -1;
    const hid_t where = H5Dget_space(set), what = H5Screate_simple(width > 1 ? 2 : 1, added, NULL);
    H5Sselect_hyperslab(where, H5S_SELECT_SET, from, NULL, added, NULL);
    const herr_t done = H5Dwrite(set, H5T_NATIVE_DOUBLE, what, where, H5P_DEFAULT, values);
    H5Sclose(what);
    H5Sclose(where);
    return done;
}

status host_h5_append(h5_file *f, const h5_name *name, const double *values, size_t rows, size_t width)
{
    if (!host_h5_exists(f, name->path)) TRY(make_series(f, name, width));
    const hid_t set = H5Dopen2(f->id, name->path, H5P_DEFAULT);
    herr_t done = set < 0 ? -1 : rows == 0 ? 0 : extend(set, values, rows, width);
    if (set >= 0 && H5Dclose(set) < 0) done = -1;
    CHECK(done >= 0, STATUS_IO, "%.150s: %.150s cannot be appended to", f->name, name->path);
    return status_ok();
}

status host_h5_truncate(h5_file *f, const char *path, size_t rows)
{
    const hid_t set = host_h5_exists(f, path) ? H5Dopen2(f->id, path, H5P_DEFAULT) : -1;
    hsize_t extent[H5_MAX_RANK] = { 0 };
    const bool plain = set >= 0 && extent_of(set, extent), enough = rows >= extent[0];
    if (!enough) extent[0] = rows;
    const bool done = plain && (enough || H5Dset_extent(set, extent) >= 0);
    if (set >= 0) H5Dclose(set);
    CHECK(done, STATUS_IO, "%.150s: %.150s cannot be cut to %zu rows", f->name, path, rows);
    return status_ok();
}

static status read_set(hid_t set, double **data, size_t dims[H5_MAX_RANK])
{
    hsize_t size[H5S_MAX_RANK] = { 1, 1 };
    const hid_t space = H5Dget_space(set);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank >= 0 && rank <= H5_MAX_RANK) H5Sget_simple_extent_dims(space, size, NULL);
    H5Sclose(space);
    CHECK(rank >= 0 && rank <= H5_MAX_RANK, STATUS_IO, "an array of %d dimensions, at most %d", rank, H5_MAX_RANK);
    dims[0] = rank > 0 ? (size_t)size[0] : 1;
    dims[1] = rank > 1 ? (size_t)size[1] : 1;
    CHECK(dims[1] == 0 || dims[0] < ((size_t)1 << 40) / dims[1], STATUS_IO, "%zu x %zu values are too many", dims[0],
          dims[1]);
    const size_t n = dims[0] * dims[1];
    *data = malloc((n ? n : 1) * sizeof **data);
    CHECK(*data, STATUS_MEMORY, "no memory for %zu values", n);
    if (n == 0 || H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, *data) >= 0) return status_ok();
    free(*data);
    *data = NULL;
    return base_status_error(STATUS_IO, "its values cannot be read");
}

status host_h5_read(const h5_file *f, const char *path, double **data, size_t dims[H5_MAX_RANK])
{
    *data = NULL;
    const hid_t set = host_h5_exists(f, path) ? H5Dopen2(f->id, path, H5P_DEFAULT) : -1;
    CHECK(set >= 0, STATUS_IO, "%.150s: holds no %.150s", f->name, path);
    const status s = read_set(set, data, dims);
    H5Dclose(set);
    CHECK(s.code == STATUS_OK, s.code, "%.100s: %.100s: %.200s", f->name, path, s.text);
    return s;
}

status host_h5_write_text(h5_file *f, const char *path, const char *description, const char *text)
{
    return host_h5_write(f, &(h5_name){ path, "1", description },
                         &(h5_array){ .type = H5_UINT8, .rank = 1, .dims = { strlen(text) }, .data = text });
}

static bool are_bytes(const double *value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!(value[i] >= 0.0 && value[i] <= UINT8_MAX)) return false;
    return true;
}

status host_h5_read_text(const h5_file *f, const char *path, char **text)
{
    double *bytes;
    size_t dims[H5_MAX_RANK];
    *text = NULL;
    TRY(host_h5_read(f, path, &bytes, dims));
    const bool is_text = dims[1] == 1 && are_bytes(bytes, dims[0]);
    if (is_text) *text = malloc(dims[0] + 1);
    for (size_t i = 0; *text && i < dims[0]; i++) (*text)[i] = (char)(unsigned char)bytes[i];
    if (*text) (*text)[dims[0]] = '\0';
    free(bytes);
    CHECK(is_text, STATUS_IO, "%.150s: %.150s is no text", f->name, path);
    CHECK(*text, STATUS_MEMORY, "no memory for a text of %zu bytes", dims[0]);
    return status_ok();
}
