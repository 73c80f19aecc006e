/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/snapshot.h"

#include "coupling/host/background.h"
#include "coupling/host/hdf5_file.h"
#include "coupling/host/outdir.h"

#include <cJSON.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define INDEX_NAME "scene.hdf.series"

#define PLUS_WIDTH(name, width, unit, description) +width
enum { FILE_SIZE = 32, VTK_VERTEX = 1, VALUES = PARTICLE_FIELDS(PLUS_WIDTH) /* of a point */ };

/* What is being written in the background: a snapshot, then the index that lists it. */
typedef struct {
    background files;
    char path[OUTDIR_PATH_SIZE], index_path[OUTDIR_PATH_SIZE];
    h5_file *file; /* owned */
    char *index;   /* owned */
} snapshot_order;

struct snapshots {
    char dir[OUTDIR_PATH_SIZE];
    snapshot_sink sink; /* put NULL: the files are ours to write */
    int n, room;
    double *time; /* n, owned [s] */
    size_t points;
    float *value; /* VALUES x points of them, owned; taken once, as most snapshots need as much as the last */
    snapshot_order order;
};

static void file_name(int i, char name[FILE_SIZE])
{
    snprintf(name, FILE_SIZE, "scene-%06d.hdf", i);
}

static status full_path(const snapshots *s, const char *name, char path[OUTDIR_PATH_SIZE])
{
    const int n = snprintf(path, OUTDIR_PATH_SIZE, "%s/%s", s->dir, name);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE, STATUS_IO, "%.300s: path too long", s->dir);
    return status_ok();
}

static status add_time(snapshots *s, double time)
{
    if (s->n == s->room) {
        const int room = 2 * s->room + 16;
        double *grown = realloc(s->time, (size_t)room * sizeof *grown);
        CHECK(grown, STATUS_MEMORY, "no memory for %d snapshot times", room);
        s->time = grown;
        s->room = room;
    }
    s->time[s->n++] = time;
    return status_ok();
}

/* ---- the index, and what an earlier run left ---- */

static void print_index(const snapshots *s, FILE *out)
{
    fputs("{ \"file-series-version\": \"1.0\",\n  \"files\": [", out);
    for (int i = 0; i < s->n; i++) {
        char name[FILE_SIZE];
        file_name(i, name);
        fprintf(out, "%s\n    { \"name\": \"%s\", \"time\": %.17g }", i ? "," : "", name, s->time[i]);
    }
    fputs("\n  ] }\n", out);
}

static status make_index(const snapshots *s, char **text, size_t *bytes)
{
    FILE *out = open_memstream(text, bytes);
    CHECK(out, STATUS_MEMORY, "no memory for the list of snapshots");
    print_index(s, out);
    if (fclose(out) == 0) return status_ok();
    free(*text);
    *text = NULL;
    return base_status_error(STATUS_MEMORY, "no memory for the list of snapshots");
}

static status write_first_index(const snapshots *s)
{
    char path[OUTDIR_PATH_SIZE], *text;
    size_t bytes;
    TRY(full_path(s, INDEX_NAME, path));
    TRY(make_index(s, &text, &bytes));
    const status done = s->sink.put ? s->sink.put(s->sink.user, path, text, bytes) : host_file_write(path, text, bytes);
    free(text);
    return done;
}

/* Snapshots are numbered from 0 without gaps and in order of time: those to keep are the first ones. */
static status keep_until(snapshots *s, const cJSON *root, double resume_time)
{
    const cJSON *entry;
    cJSON_ArrayForEach(entry, cJSON_GetObjectItemCaseSensitive(root, "files"))
    {
        char name[FILE_SIZE], path[OUTDIR_PATH_SIZE];
        const cJSON *time = cJSON_GetObjectItemCaseSensitive(entry, "time");
        file_name(s->n, name);
        TRY(full_path(s, name, path));
        if (!cJSON_IsNumber(time) || time->valuedouble > resume_time || !host_file_exists(path)) break;
        TRY(add_time(s, time->valuedouble));
    }
    return status_ok();
}

static status read_index(snapshots *s, double resume_time)
{
    char path[OUTDIR_PATH_SIZE], *text;
    TRY(full_path(s, INDEX_NAME, path));
    if (resume_time < 0.0 || !host_file_exists(path)) return status_ok();
    TRY(host_file_read(path, &text, NULL));
    cJSON *root = cJSON_Parse(text);
    free(text);
    const status result = keep_until(s, root, resume_time);
    cJSON_Delete(root);
    return result;
}

static void remove_others(const snapshots *s)
{
    DIR *d = opendir(s->dir);
    if (!d) return;
    for (const struct dirent *e; (e = readdir(d));) {
        int number, length = 0;
        char path[OUTDIR_PATH_SIZE];
        if (sscanf(e->d_name, "scene-%6d.hdf%n", &number, &length) != 1 || length == 0) continue;
        const bool ours = e->d_name[length] == '\0' || strcmp(e->d_name + length, ".part") == 0;
        if (ours && (number >= s->n || e->d_name[length]) && full_path(s, e->d_name, path).code == STATUS_OK)
            unlink(path);
    }
    closedir(d);
}

static status open_list(snapshots *s, double resume_time)
{
    if (!s->sink.put) {
        TRY(read_index(s, resume_time));
        remove_others(s);
    }
    return write_first_index(s);
}

static status open_with(const char *dir, const snapshot_sink *sink, double resume_time, snapshots **out)
{
    *out = NULL;
    snapshots *s = calloc(1, sizeof *s);
    CHECK(s, STATUS_MEMORY, "no memory for the snapshots");
    snprintf(s->dir, sizeof s->dir, "%s", dir);
    s->sink = *sink;
    const status result = open_list(s, resume_time);
    if (result.code == STATUS_OK)
        *out = s;
    else
        output_snapshots_close(s);
    return result;
}

status output_snapshots_open(const char *dir, double resume_time, snapshots **out)
{
    return open_with(dir, &(snapshot_sink){ NULL, NULL }, resume_time, out);
}

status output_snapshots_open_sink(const char *dir, const snapshot_sink *sink, snapshots **out)
{
    return open_with(dir, sink, -1.0, out);
}

/* One that could not be written is none. */
status output_snapshots_wait(snapshots *s)
{
    if (!s) return status_ok();
    snapshot_order *o = &s->order;
    const status done = host_background_wait(&o->files);
    if (done.code != STATUS_OK) s->n--;
    host_h5_close(o->file);
    free(o->index);
    o->file = NULL, o->index = NULL;
    return done;
}

int output_snapshots_count(const snapshots *s)
{
    return s->n;
}

void output_snapshots_close(snapshots *s)
{
    if (!s) return;
    output_snapshots_wait(s);
    free(s->time);
    free(s->value);
    free(s);
}

/* ---- one file ---- */

static status write_field(h5_file *file, mpm_field field, size_t n, const float *value)
{
    const mpm_field_info *f = &mpm_field_table[field];
    char path[100];
    if (field == MPM_position)
        snprintf(path, sizeof path, "/VTKHDF/Points");
    else
        snprintf(path, sizeof path, "/VTKHDF/PointData/%s", f->name);
    return host_h5_write(file, &(h5_name){ path, f->unit, f->doc },
                         &(h5_array){ H5_FLOAT, f->width > 1 ? 2 : 1, { n, (size_t)f->width }, value });
}

static status write_fields(h5_file *file, const snapshot_source *source, float *value)
{
    float *at[MPM_FIELD_COUNT];
    for (int f = 0; f < MPM_FIELD_COUNT; f++) {
        at[f] = value;
        value += source->n * (size_t)mpm_field_table[f].width;
    }
    source->read(source->source, at);
    for (int f = 0; f < MPM_FIELD_COUNT; f++) TRY(write_field(file, (mpm_field)f, source->n, at[f]));
    return status_ok();
}

static status write_ints(h5_file *file, const char *path, const int64_t *values, size_t n)
{
    return host_h5_write(file, &(h5_name){ path, NULL, NULL }, &(h5_array){ H5_INT64, 1, { n }, values });
}

/* One vertex cell a point: cell i is point i.  room: VALUES x 4 bytes a point hold n + 1 numbers, and n kinds. */
static status write_cells(h5_file *file, size_t n, void *room)
{
    const int64_t count = (int64_t)n;
    int64_t *offset = room;
    uint8_t *kind = (uint8_t *)(offset + n + 1);
    for (size_t i = 0; i <= n; i++) offset[i] = (int64_t)i;
    memset(kind, VTK_VERTEX, n);
    TRY(write_ints(file, "/VTKHDF/NumberOfPoints", &count, 1));
    TRY(write_ints(file, "/VTKHDF/NumberOfCells", &count, 1));
    TRY(write_ints(file, "/VTKHDF/NumberOfConnectivityIds", &count, 1));
    TRY(write_ints(file, "/VTKHDF/Offsets", offset, n + 1));
    TRY(write_ints(file, "/VTKHDF/Connectivity", offset, n));
    return host_h5_write(file, &(h5_name){ "/VTKHDF/Types", NULL, NULL }, &(h5_array){ H5_UINT8, 1, { n }, kind });
}

static status write_all(h5_file *file, const snapshot_source *source, float *room)
{
    const int64_t version[2] = { 1, 0 };
    TRY(host_h5_group(file, "/VTKHDF"));
    TRY(host_h5_attribute_ints(file, "/VTKHDF", "Version", version, 2));
    TRY(host_h5_attribute_text(file, "/VTKHDF", "Type", "UnstructuredGrid"));
    TRY(write_cells(file, source->n, room));
    TRY(write_fields(file, source, room));
    return host_h5_write(file, &(h5_name){ "/VTKHDF/FieldData/time", "s", "of the scene" },
                         &(h5_array){ H5_DOUBLE, 1, { 1 }, &source->time });
}

/* For one point at least: the offsets of no cells are one number. */
static status make_room(snapshots *s, size_t points)
{
    if (s->value && points <= s->points) return status_ok();
    if (points == 0) points = 1;
    free(s->value);
    s->value = malloc(points * VALUES * sizeof *s->value);
    s->points = s->value ? points : 0;
    CHECK(s->value, STATUS_MEMORY, "no memory for a snapshot of %zu points", points);
    return status_ok();
}

static status hand_to_sink(const snapshots *s, const background_file file[BACKGROUND_FILES])
{
    for (int i = 0; i < BACKGROUND_FILES; i++)
        TRY(s->sink.put(s->sink.user, file[i].path, file[i].data, file[i].bytes));
    return status_ok();
}

/* Of the order's file, which counts as written from here on. */
static status hand_over(snapshots *s, double time)
{
    char name[FILE_SIZE];
    snapshot_order *o = &s->order;
    background_file file[BACKGROUND_FILES] = { { .path = o->path }, { .path = o->index_path } };
    file_name(s->n, name);
    TRY(full_path(s, name, o->path));
    TRY(full_path(s, INDEX_NAME, o->index_path));
    TRY(host_h5_image(o->file, &file[0].data, &file[0].bytes));
    TRY(add_time(s, time));
    status done = make_index(s, &o->index, &file[1].bytes);
    file[1].data = o->index;
    if (done.code == STATUS_OK && s->sink.put) done = hand_to_sink(s, file);
    if (done.code != STATUS_OK)
        s->n--;
    else if (!s->sink.put)
        host_background_start(&o->files, file);
    return done;
}

/* The next one is made while the last one is still being written: two are in memory at most. */
status output_snapshots_write_source(snapshots *s, const snapshot_source *source)
{
    h5_file *file;
    TRY(make_room(s, source->n));
    TRY(host_h5_create(&file));
    status result = write_all(file, source, s->value);
    if (result.code == STATUS_OK) result = output_snapshots_wait(s);
    if (result.code != STATUS_OK) {
        host_h5_close(file);
        return result;
    }
    s->order.file = file;
    return hand_over(s, source->time);
}
