/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/snapshot.h"

#include "coupling/host/hdf5_file.h"
#include "coupling/host/outdir.h"

#include <cJSON.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define INDEX_NAME "scene.hdf.series"

enum { FILE_SIZE = 32, MAX_WIDTH = 6, VTK_VERTEX = 1 };

struct snapshots {
    char dir[OUTDIR_PATH_SIZE];
    snapshot_sink sink;
    int n, room;
    double *time; /* n, owned [s] */
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

static status put_file(void *user, const char *path, const void *data, size_t bytes)
{
    (void)user;
    return host_file_write(path, data, bytes);
}

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

static status write_index(const snapshots *s)
{
    char path[OUTDIR_PATH_SIZE], *text = NULL;
    size_t bytes = 0;
    TRY(full_path(s, INDEX_NAME, path));
    FILE *out = open_memstream(&text, &bytes);
    CHECK(out, STATUS_MEMORY, "no memory for the list of snapshots");
    print_index(s, out);
    const bool whole = fclose(out) == 0;
    const status done = whole ? s->sink.put(s->sink.user, path, text, bytes)
                              : base_status_error(STATUS_MEMORY, "no memory for the list of snapshots");
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
    if (s->sink.put == put_file) {
        TRY(read_index(s, resume_time));
        remove_others(s);
    }
    return write_index(s);
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
    return open_with(dir, &(snapshot_sink){ put_file, NULL }, resume_time, out);
}

status output_snapshots_open_sink(const char *dir, const snapshot_sink *sink, snapshots **out)
{
    return open_with(dir, sink, -1.0, out);
}

int output_snapshots_count(const snapshots *s)
{
    return s->n;
}

void output_snapshots_close(snapshots *s)
{
    if (!s) return;
    free(s->time);
    free(s);
}

/* ---- one file ---- */

typedef struct {
    mpm_field field;
    const char *name;
    int width;
    const char *unit, *description;
} field_entry;

#define FIELD_ENTRY(name, width, unit, description) { MPM_##name, #name, width, unit, description },
static const field_entry fields[] = { PARTICLE_FIELDS(FIELD_ENTRY) };

typedef struct {
    h5_file *file;
    const snapshot_source *source;
    double *value; /* n x MAX_WIDTH */
    float *single; /* n x MAX_WIDTH */
} writer;

static status write_field(writer *w, const field_entry *f)
{
    const size_t n = w->source->n, values = n * (size_t)f->width;
    char path[100];
    if (f->field == MPM_position)
        snprintf(path, sizeof path, "/VTKHDF/Points");
    else
        snprintf(path, sizeof path, "/VTKHDF/PointData/%s", f->name);
    w->source->read(w->source->source, f->field, w->value);
    for (size_t i = 0; i < values; i++) w->single[i] = (float)w->value[i];
    return host_h5_write(w->file, &(h5_name){ path, f->unit, f->description },
                         &(h5_array){ H5_FLOAT, f->width > 1 ? 2 : 1, { n, (size_t)f->width }, w->single });
}

static status write_ints(writer *w, const char *path, const int64_t *values, size_t n)
{
    return host_h5_write(w->file, &(h5_name){ path, NULL, NULL }, &(h5_array){ H5_INT64, 1, { n }, values });
}

/* One vertex cell a particle: cell i is point i. */
static status write_cells(writer *w)
{
    const size_t n = w->source->n;
    const int64_t count = (int64_t)n;
    int64_t *offset = (int64_t *)(void *)w->value; /* MAX_WIDTH x 8 bytes a particle hold n + 1 of them, n >= 1 */
    uint8_t *kind = (uint8_t *)(void *)w->single;
    for (size_t i = 0; i <= n; i++) offset[i] = (int64_t)i;
    memset(kind, VTK_VERTEX, n);
    TRY(write_ints(w, "/VTKHDF/NumberOfPoints", &count, 1));
    TRY(write_ints(w, "/VTKHDF/NumberOfCells", &count, 1));
    TRY(write_ints(w, "/VTKHDF/NumberOfConnectivityIds", &count, 1));
    TRY(write_ints(w, "/VTKHDF/Offsets", offset, n + 1));
    TRY(write_ints(w, "/VTKHDF/Connectivity", offset, n));
    return host_h5_write(w->file, &(h5_name){ "/VTKHDF/Types", NULL, NULL }, &(h5_array){ H5_UINT8, 1, { n }, kind });
}

static status write_all(writer *w)
{
    const int64_t version[2] = { 1, 0 };
    TRY(host_h5_group(w->file, "/VTKHDF"));
    TRY(host_h5_attribute_ints(w->file, "/VTKHDF", "Version", version, 2));
    TRY(host_h5_attribute_text(w->file, "/VTKHDF", "Type", "UnstructuredGrid"));
    TRY(write_cells(w));
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) TRY(write_field(w, &fields[i]));
    return host_h5_write(w->file, &(h5_name){ "/VTKHDF/FieldData/time", "s", "of the scene" },
                         &(h5_array){ H5_DOUBLE, 1, { 1 }, &w->source->time });
}

static status put_image(const snapshots *s, h5_file *file, const char *path)
{
    void *image;
    size_t bytes;
    TRY(host_h5_image(file, &image, &bytes));
    const status done = s->sink.put(s->sink.user, path, image, bytes);
    free(image);
    return done;
}

status output_snapshots_write_source(snapshots *s, const snapshot_source *source)
{
    char name[FILE_SIZE], path[OUTDIR_PATH_SIZE];
    file_name(s->n, name);
    TRY(full_path(s, name, path));
    const size_t room = (source->n + 1) * MAX_WIDTH;
    writer w = { .source = source, .value = malloc(room * sizeof(double)), .single = malloc(room * sizeof(float)) };
    status result = w.value && w.single
                        ? host_h5_create(&w.file)
                        : base_status_error(STATUS_MEMORY, "no memory for a snapshot of %zu particles", source->n);
    if (result.code == STATUS_OK) result = write_all(&w);
    free(w.value);
    free(w.single);
    if (result.code == STATUS_OK) result = put_image(s, w.file, path);
    host_h5_close(w.file);
    if (result.code != STATUS_OK) return result;
    TRY(add_time(s, source->time));
    return write_index(s);
}
