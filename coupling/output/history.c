/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/history.h"

#include "coupling/host/hdf5_file.h"
#include "coupling/host/outdir.h"
#include "coupling/host/progress.h"

#include <stdlib.h>
#include <string.h>

#define TICK_INTERVAL 5.0 /* between two flushes by output_history_tick [s] */
#define TICK_SHARE 20.0   /* and at least this many times what the last one took */

enum { BUFFER_ROWS = 256, BUFFER_VALUES = 1 << 20, GROUP_SIZE = 200, PATH_SIZE = 300 };

typedef struct {
    char group[GROUP_SIZE]; /* "" = free */
    int columns;
    char (*name)[96], (*unit)[32], (*description)[160]; /* columns each, owned */
    size_t *width;                                      /* of each column, owned */
    size_t row_width, room;                             /* values a row; rows that there is room for */
    double *row;                                        /* room x row_width, owned */
    double *column;                                     /* room x the widest column, owned */
    size_t rows;                                        /* gathered */
} series_buffer;

struct history {
    char path[OUTDIR_PATH_SIZE];
    h5_file *file;
    int n_series;
    series_buffer *series;         /* [n_series] owned */
    double flushed, flush_seconds; /* wall clock of the last flush, what it took [s] */
    bool changed;
};

status output_history_open(const char *path, bool resume, history **out)
{
    *out = NULL;
    history *h = calloc(1, sizeof *h);
    CHECK(h, STATUS_MEMORY, "no memory for the history");
    const int n = snprintf(h->path, sizeof h->path, "%s", path ? path : "");
    status s =
        (size_t)n < sizeof h->path ? status_ok() : base_status_error(STATUS_IO, "%.200s...: path too long", path);
    if (s.code == STATUS_OK)
        s = resume && path && host_file_exists(path) ? host_h5_open(path, &h->file) : host_h5_create(&h->file);
    if (s.code != STATUS_OK) {
        free(h);
        return s;
    }
    h->flushed = host_wall_clock();
    h->changed = true;
    *out = h;
    return s;
}

static void series_free(series_buffer *b)
{
    free(b->name);
    free(b->unit);
    free(b->description);
    free(b->width);
    free(b->row);
    free(b->column);
    memset(b, 0, sizeof *b);
}

static bool series_allocate(series_buffer *b, const int *width, int n)
{
    const size_t columns = (size_t)n;
    size_t widest = 1;
    b->columns = n;
    b->name = calloc(columns, sizeof *b->name);
    b->unit = calloc(columns, sizeof *b->unit);
    b->description = calloc(columns, sizeof *b->description);
    b->width = calloc(columns, sizeof *b->width);
    if (!b->name || !b->unit || !b->description || !b->width) return false;
    for (int c = 0; c < n; c++) {
        b->width[c] = width ? (size_t)width[c] : 1;
        if (b->width[c] > widest) widest = b->width[c];
        b->row_width += b->width[c];
    }
    b->room = BUFFER_VALUES / b->row_width;
    b->room = b->room < 1 ? 1 : b->room > BUFFER_ROWS ? BUFFER_ROWS : b->room;
    b->row = calloc(b->row_width * b->room, sizeof *b->row);
    b->column = calloc(widest * b->room, sizeof *b->column);
    return b->row && b->column;
}

/* Moves the gathered rows into the file in memory; makes the columns on first use. */
static status gather(history *h, series_buffer *b)
{
    size_t at = 0; /* of the column in a row */
    for (int c = 0; c < b->columns; c++) {
        char path[PATH_SIZE];
        const size_t width = b->width[c];
        snprintf(path, sizeof path, "%s/%s", b->group, b->name[c]);
        for (size_t i = 0; i < b->rows; i++)
            memcpy(b->column + i * width, b->row + i * b->row_width + at, width * sizeof *b->row);
        TRY(host_h5_append(h->file, &(h5_name){ path, b->unit[c], b->description[c] }, b->column, b->rows, width));
        at += width;
    }
    b->rows = 0;
    return status_ok();
}

static status gather_all(history *h)
{
    for (int i = 0; i < h->n_series; i++)
        if (h->series[i].rows > 0) TRY(gather(h, &h->series[i]));
    return status_ok();
}

static int find_series(const history *h, const char *group)
{
    int i = 0;
    while (i < h->n_series && strcmp(h->series[i].group, group) != 0) i++;
    return i;
}

/* A place for one more. */
static status free_series(history *h, int *series)
{
    *series = find_series(h, "");
    if (*series < h->n_series) return status_ok();
    series_buffer *grown = realloc(h->series, ((size_t)h->n_series + 1) * sizeof *grown);
    CHECK(grown, STATUS_MEMORY, "no memory for %d series of the history", h->n_series + 1);
    h->series = grown;
    memset(&h->series[h->n_series++], 0, sizeof *grown);
    return status_ok();
}

status output_history_series(history *h, const char *group, const history_column *columns, int n, int *series)
{
    return output_history_arrays(h, group, columns, NULL, n, series);
}

status output_history_arrays(history *h, const char *group, const history_column *columns, const int *width, int n,
                             int *series)
{
    CHECK(n > 0, STATUS_BAD_INPUT, "history %.100s: %d columns", group, n);
    CHECK(group[0] == '/' && strlen(group) < GROUP_SIZE, STATUS_BAD_INPUT, "history: %.100s is no group's name", group);
    *series = find_series(h, group);
    if (*series < h->n_series) return status_ok();
    TRY(free_series(h, series));
    series_buffer *b = &h->series[*series];
    if (!series_allocate(b, width, n)) {
        series_free(b);
        return base_status_error(STATUS_MEMORY, "no memory for the history of %.100s", group);
    }
    snprintf(b->group, sizeof b->group, "%s", group);
    for (int c = 0; c < n; c++) {
        snprintf(b->name[c], sizeof b->name[c], "%s", columns[c].name);
        snprintf(b->unit[c], sizeof b->unit[c], "%s", columns[c].unit);
        snprintf(b->description[c], sizeof b->description[c], "%s", columns[c].description);
    }
    h->changed = true;
    return gather(h, b);
}

status output_history_append(history *h, int series, const double *row)
{
    series_buffer *b = &h->series[series];
    memcpy(b->row + b->rows * b->row_width, row, b->row_width * sizeof *row);
    b->rows++;
    h->changed = true;
    return b->rows < b->room ? status_ok() : gather(h, b);
}

status output_history_rewind(history *h, int series, double time)
{
    series_buffer *b = &h->series[series];
    TRY(gather(h, b));
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", b->group, b->name[0]);
    double *t;
    size_t dims[H5_MAX_RANK], keep = 0;
    TRY(host_h5_read(h->file, path, &t, dims));
    while (keep < dims[0] && t[keep] <= time) keep++;
    free(t);
    for (int c = 0; c < b->columns; c++) {
        snprintf(path, sizeof path, "%s/%s", b->group, b->name[c]);
        TRY(host_h5_truncate(h->file, path, keep));
    }
    h->changed = true;
    return status_ok();
}

status output_history_end(history *h, int series)
{
    const status s = gather(h, &h->series[series]);
    series_free(&h->series[series]);
    return s;
}

status output_history_flush(history *h)
{
    if (!h->changed || !h->path[0]) return status_ok();
    const double start = host_wall_clock();
    TRY(gather_all(h));
    TRY(host_h5_save(h->file, h->path));
    h->changed = false;
    h->flushed = host_wall_clock();
    h->flush_seconds = h->flushed - start;
    return status_ok();
}

status output_history_tick(history *h)
{
    const double since = host_wall_clock() - h->flushed;
    return since > TICK_INTERVAL && since > TICK_SHARE * h->flush_seconds ? output_history_flush(h) : status_ok();
}

status output_history_close(history *h)
{
    if (!h) return status_ok();
    const status s = output_history_flush(h);
    for (int i = 0; i < h->n_series; i++) series_free(&h->series[i]);
    free(h->series);
    host_h5_close(h->file);
    free(h);
    return s;
}

/* ---- a scene from one file to another ---- */

#define STORED_GROUP "/scene"

static status scene_group(const char *scene, char group[GROUP_SIZE])
{
    const int n = snprintf(group, GROUP_SIZE, "/scene/%s", scene);
    CHECK(n > 0 && n < GROUP_SIZE - 20 && host_name_is_plain(scene), STATUS_BAD_INPUT,
          "scene `%.100s`: letters, digits, - _ . only, at most 170", scene);
    return status_ok();
}

bool output_history_has(const history *h, const char *scene)
{
    char group[GROUP_SIZE];
    return scene_group(scene, group).code == STATUS_OK && host_h5_exists(h->file, group);
}

status output_history_read(history *h, const char *scene, const char *name, double **data, size_t dims[H5_MAX_RANK])
{
    char group[GROUP_SIZE], path[2 * PATH_SIZE];
    *data = NULL;
    TRY(scene_group(scene, group));
    TRY(gather_all(h));
    snprintf(path, sizeof path, "%s/%s", group, name);
    return host_h5_read(h->file, path, data, dims);
}

status output_history_export(history *h, const char *scene, h5_file *to)
{
    char group[GROUP_SIZE];
    TRY(scene_group(scene, group));
    TRY(gather_all(h));
    return host_h5_copy(h->file, group, to, STORED_GROUP);
}

status output_history_copy_scene(history *from, const char *scene, history *to)
{
    char group[GROUP_SIZE];
    TRY(scene_group(scene, group));
    if (!host_h5_exists(from->file, group)) return status_ok();
    TRY(gather_all(from));
    to->changed = true;
    return host_h5_copy(from->file, group, to->file, group);
}

status output_history_import(history *h, const char *scene, const h5_file *from)
{
    char group[GROUP_SIZE];
    TRY(scene_group(scene, group));
    h->changed = true;
    return host_h5_copy(from, STORED_GROUP, h->file, group);
}

status output_history_text(history *h, const char *scene, const char *name, const char *description, const char *text)
{
    char group[GROUP_SIZE], path[2 * PATH_SIZE];
    TRY(scene_group(scene, group));
    snprintf(path, sizeof path, "%s/%s", group, name);
    h->changed = true;
    return host_h5_write_text(h->file, path, description, text);
}

status output_history_read_text(const history *h, const char *scene, const char *name, char **text)
{
    char group[GROUP_SIZE], path[2 * PATH_SIZE];
    *text = NULL;
    TRY(scene_group(scene, group));
    snprintf(path, sizeof path, "%s/%s", group, name);
    return host_h5_read_text(h->file, path, text);
}

/* ---- maps ---- */

static status put_axis(h5_file *file, const char *path, const history_map *map, int k)
{
    const size_t n = (size_t)map->n[k];
    double *x = malloc((n ? n : 1) * sizeof *x);
    CHECK(x, STATUS_MEMORY, "no memory for the map `%s`", map->name);
    for (size_t i = 0; i < n; i++) x[i] = map->first[k] + map->step[k] * (double)i;
    const status s = host_h5_write(file, &(h5_name){ path, map->across[k].unit, map->across[k].description },
                                   &(h5_array){ .type = H5_DOUBLE, .rank = 1, .dims = { n }, .data = x });
    free(x);
    return s;
}

status output_history_map(history *h, const char *scene, const history_map *map)
{
    char group[GROUP_SIZE], all[PATH_SIZE], path[2 * PATH_SIZE];
    TRY(scene_group(scene, group));
    snprintf(all, sizeof all, "%s/%s", group, map->name);
    TRY(host_h5_group(h->file, all));
    for (int k = 0; k < 2; k++) {
        snprintf(path, sizeof path, "%s/%s", all, map->across[k].name);
        TRY(put_axis(h->file, path, map, k));
    }
    snprintf(path, sizeof path, "%s/%s", all, map->value.name);
    TRY(host_h5_write(h->file, &(h5_name){ path, map->value.unit, map->value.description },
                      &(h5_array){ H5_DOUBLE, 2, { (size_t)map->n[0], (size_t)map->n[1] }, map->values }));
    h->changed = true;
    for (int i = 0; i < map->numbers; i++)
        TRY(host_h5_attribute_double(h->file, all, map->number[i].name, map->number[i].value));
    for (int i = 0; i < map->texts; i++)
        TRY(host_h5_attribute_text(h->file, all, map->text[i].name, map->text[i].text));
    return status_ok();
}

/* ---- the rows of Breech's own series: one list makes the columns and the row ---- */

/* clang-format off */
/* Behind these come the places of circuit/ledger.def and the ledger's error. */
#define SHOT_COLUMNS(COLUMN)                                                                            \
    COLUMN(time, "s", "time", s->t)                                                                     \
    COLUMN(position, "m", "armature along the barrel", s->x)                                            \
    COLUMN(velocity, "m/s", "armature", s->v)                                                           \
    COLUMN(acceleration, "m/s^2", "armature", s->a)                                                     \
    COLUMN(current, "A", "rails", s->current)                                                           \
    COLUMN(breech_voltage, "V", "between the rails at the breech", s->breech_voltage)                   \
    COLUMN(muzzle_voltage, "V", "between the rails ahead of the armature", s->muzzle_voltage)           \
    COLUMN(force, "N", "electromagnetic, on the armature", s->force)                                    \
    COLUMN(friction, "N", "all rail faces", s->friction)                                               \
    COLUMN(drag, "N", "gas ahead of the armature", s->drag)                                             \
    COLUMN(contact_force, "N", "per rail face", s->contact_force)                                       \
    COLUMN(contact_pressure, "Pa", "contact force over the nominal contact area", s->contact_pressure)  \
    COLUMN(action, "A^2 s", "integral of the current's square", s->action)                              \
    COLUMN(mass, "kg", "armature", s->mass)                                                             \
    COLUMN(rail_temperature, "K", "just ahead of the armature", s->rail_temperature)                    \
    COLUMN(armature_temperature, "K", "contact face", s->armature_temperature)                          \
    COLUMN(lead_face_temperature, "K", "lead face of the armature", s->lead_face_temperature)           \
    COLUMN(film_temperature, "K", "melt on the contact face", s->film_temperature)                      \
    COLUMN(film_thickness, "m", "melt on one face", s->film_thickness)                                  \
    COLUMN(contact_spread, "m", "of the contact, over which the current enters", s->contact_spread)     \
    COLUMN(friction_coefficient, "1", "of the armature's faces", s->friction_coefficient)               \
    COLUMN(rail_behind_temperature, "K", "rail surface, one contact length behind", s->rail_behind_temperature) \
    COLUMN(shunt_current, "A", "of the muzzle shunt", s->shunt_current)

#define SCENE_COLUMNS(COLUMN)                                                                           \
    COLUMN(time, "s", "time", r->time)                                                                  \
    COLUMN(dt, "s", "step", r->dt)                                                                      \
    COLUMN(steps, "1", "so far", (double)r->steps)                                                      \
    COLUMN(particles, "1", "now", (double)r->particles)                                                 \
    COLUMN(particle_steps, "1", "so far", (double)r->particle_steps)                                    \
    COLUMN(kinetic, "J", "as computed: half a model is half", l->kinetic)                               \
    COLUMN(internal, "J", "work of stress and heat, as computed", l->internal)                          \
    COLUMN(work_ahead, "J", "part of internal, still to be taken from kinetic", l->work_ahead)          \
    COLUMN(heat_friction, "J", "so far, part of internal", l->heat_friction)                            \
    COLUMN(heat_transfer, "J", "so far, part of internal", l->heat_transfer)                            \
    COLUMN(heat_viscous, "J", "so far, part of internal", l->heat_viscous)                              \
    COLUMN(work_boundary, "J", "done on the model so far", l->work_boundary)                            \
    COLUMN(work_external, "J", "done on the model so far", l->work_external)                            \
    COLUMN(momentum_x, "kg m/s", "as computed", l->momentum[0])                                         \
    COLUMN(momentum_y, "kg m/s", "as computed", l->momentum[1])                                         \
    COLUMN(momentum_z, "kg m/s", "as computed", l->momentum[2])                                         \
    COLUMN(ejected_mass, "kg", "left the window so far", l->ejected_mass)                               \
    COLUMN(ejected_energy, "J", "left the window so far", l->ejected_energy)                            \
    COLUMN(energy_error, "1", "ledger's rest over the kinetic energy at the start", l->energy_error)    \
    COLUMN(momentum_error, "1", "over mass times the largest initial speed", l->momentum_error)         \
    COLUMN(contact_force_x, "N", "on the rail, or the first body, and what is welded to it; as computed", force[0]) \
    COLUMN(contact_force_y, "N", "on the rail, or the first body, and what is welded to it; as computed", force[1]) \
    COLUMN(contact_force_z, "N", "on the rail, or the first body, and what is welded to it; as computed", force[2]) \
    COLUMN(peak_pressure, "Pa", "of any point so far: the summary's max_pressure", r->peak_pressure) \
    COLUMN(peak_temperature, "K", "of any point so far", r->peak_temperature)                        \
    COLUMN(failed_volume, "m^3", "of all bodies now, as computed", r->failed_volume)                    \
    COLUMN(clamps_pressure, "1", "so far", (double)r->clamps_pressure)                                  \
    COLUMN(clamps_compression, "1", "so far", (double)r->clamps_compression)                            \
    COLUMN(splits, "1", "points split so far", (double)r->splits)                                    \
    COLUMN(merges, "1", "points merged so far", (double)r->merges)

#define EVENT_COLUMNS(COLUMN)                                                                           \
    COLUMN(time, "s", "time", e->state.t)                                                               \
    COLUMN(kind, "1", "0 fired 1 waiting 2 crowbar 3 blocked 4 released 5 stopped 6 site 7 muzzle "       \
           "8 commutated 9 recharged 10 melted", (double)e->kind)                                       \
    COLUMN(index, "1", "of the group or the site, -1 if neither", (double)e->index)                     \
    COLUMN(position, "m", "armature", e->state.x)                                                       \
    COLUMN(velocity, "m/s", "armature", e->state.v)                                                     \
    COLUMN(current, "A", "rails", e->state.current)
/* clang-format on */

#define COLUMN_ENTRY(name, unit, description, value) { #name, unit, description },
#define COLUMN_VALUE(name, unit, description, value) *row++ = (value);
#define WIDTH(columns) ((int)(sizeof(columns) / sizeof *(columns)))

static const history_column shot_columns[] = {
    SHOT_COLUMNS(COLUMN_ENTRY)
#define STORED(member, column, text) { #column, "J", text },
#define SPENT(member, column, text) { #column, "J", text },
#define GIVEN(place, member, column, text) { #column, "J", text },
#include "circuit/ledger.def"
        { "energy_error", "1", "ledger's rest over the energy at the start and supplied" },
};
static const history_column scene_columns[] = { SCENE_COLUMNS(COLUMN_ENTRY) };
static const history_column event_columns[] = { EVENT_COLUMNS(COLUMN_ENTRY) };

status output_history_shot(history *h, int *series)
{
    return output_history_series(h, "/shot", shot_columns, WIDTH(shot_columns), series);
}

void output_history_shot_row(const circuit_shot_state *s, double *row)
{
    SHOT_COLUMNS(COLUMN_VALUE)
#define STORED(member, column, text) *row++ = s->ledger.member;
#define SPENT(member, column, text) *row++ = s->ledger.member;
#define GIVEN(place, member, column, text) *row++ = s->ledger.member;
#include "circuit/ledger.def"
    *row++ = s->ledger.energy_error;
}

status output_history_events(history *h, int *series)
{
    return output_history_series(h, "/shot/events", event_columns, WIDTH(event_columns), series);
}

void output_history_event_row(const circuit_shot_event *e, double *row){ EVENT_COLUMNS(COLUMN_VALUE) }

status output_history_scene(history *h, const char *scene, const history_column *more, int n, int *series)
{
    char group[GROUP_SIZE];
    TRY(scene_group(scene, group));
    const size_t own = WIDTH(scene_columns);
    CHECK((int)own + n <= HISTORY_MAX_COLUMNS, STATUS_BAD_INPUT, "history of %.100s: %d columns, at most %d", scene,
          (int)own + n, HISTORY_MAX_COLUMNS);
    history_column *all = calloc(own + (size_t)n, sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory for %zu columns of a scene's history", own + (size_t)n);
    memcpy(all, scene_columns, sizeof scene_columns);
    for (int c = 0; c < n; c++) all[own + (size_t)c] = more[c];
    const status done = output_history_series(h, group, all, (int)own + n, series);
    free(all);
    return done;
}

double *output_history_scene_row(const mpm_report *r, const mpm_ledger *l, const double *force, double *row)
{
    SCENE_COLUMNS(COLUMN_VALUE)
    return row;
}

/* ---- the bank's groups: as many columns as the bank has ---- */

static int groups_kept(int groups)
{
    const int room = (HISTORY_MAX_COLUMNS - 1) / 2;
    return groups < room ? groups : room;
}

static status modules_series(history *h, int groups, char (*name)[64], history_column *columns, int *series)
{
    int n = 0;
    columns[n++] = (history_column){ "time", "s", "time" };
    for (int g = 0; g < groups; g++) {
        snprintf(name[n], sizeof *name, "current_%03d", g);
        columns[n] = (history_column){ name[n], "A", "one unit of the group" };
        n++;
        snprintf(name[n], sizeof *name, "voltage_%03d", g);
        columns[n] = (history_column){ name[n], "V", "capacitor, switch or machine of one unit of the group" };
        n++;
    }
    return output_history_series(h, "/shot/modules", columns, n, series);
}

status output_history_modules(history *h, const circuit_shot *s, int *series)
{
    char(*name)[64] = calloc(HISTORY_MAX_COLUMNS, sizeof *name);
    history_column *columns = calloc(HISTORY_MAX_COLUMNS, sizeof *columns);
    const status result = name && columns
                              ? modules_series(h, groups_kept(circuit_shot_module_count(s)), name, columns, series)
                              : base_status_error(STATUS_MEMORY, "no memory for the history of the modules");
    free(columns);
    free(name);
    return result;
}

void output_history_modules_row(const circuit_shot *s, double *row)
{
    const int groups = groups_kept(circuit_shot_module_count(s));
    *row++ = circuit_shot_now(s).t;
    for (int g = 0; g < groups; g++) {
        *row++ = circuit_shot_module_current(s, g);
        *row++ = circuit_shot_module_voltage(s, g);
    }
}

void output_history_print_columns(const char *group, const history_column *columns, int n, FILE *out)
{
    fprintf(out, "\n### %s\n\n| dataset | units | what |\n|---|---|---|\n", group);
    for (int c = 0; c < n; c++)
        fprintf(out, "| `%s` | %s | %s |\n", columns[c].name, columns[c].unit, columns[c].description);
}

void output_history_print_all_columns(FILE *out)
{
    output_history_print_columns("/shot", shot_columns, WIDTH(shot_columns), out);
    output_history_print_columns("/shot/events", event_columns, WIDTH(event_columns), out);
    output_history_print_columns("/scene/<name>", scene_columns, WIDTH(scene_columns), out);
}
