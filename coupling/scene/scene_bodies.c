/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the bodies now ---- */

static void add_point(scene_body *b, double mass, const double x[3], const double v[3], double energy)
{
    b->mass += mass;
    b->internal += mass * energy;
    for (int k = 0; k < 3; k++) {
        b->position[k] += mass * x[k];
        b->velocity[k] += mass * v[k];
        b->kinetic += 0.5 * mass * v[k] * v[k];
    }
}

static void add_extent(scene_body *b, const double x[3], const double half[3])
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = fmin(b->lo[k], x[k] - half[k]); /* NAN: none so far */
        b->hi[k] = fmax(b->hi[k], x[k] + half[k]);
    }
}

static status add_points(const mpm *m, scene_body *out)
{
    enum { COLUMNS = 13 };
    const size_t n = mpm_points(m);
    double *all = malloc((n ? n : 1) * COLUMNS * sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory to read %zu material points", n);
    double *x = all, *v = all + 3 * n, *mass = all + 6 * n, *energy = all + 7 * n, *body = all + 8 * n;
    double *half = all + 9 * n, *damage = all + 12 * n;
    mpm_read(m, MPM_position, x);
    mpm_read(m, MPM_velocity, v);
    mpm_read(m, MPM_mass, mass);
    mpm_read(m, MPM_energy, energy);
    mpm_read(m, MPM_body, body);
    mpm_read(m, MPM_size, half);
    mpm_read(m, MPM_damage, damage);
    for (size_t i = 0; i < n; i++) {
        scene_body *b = &out[(int)body[i]];
        add_point(b, mass[i], x + 3 * i, v + 3 * i, energy[i]);
        if (damage[i] < 1.0) add_extent(b, x + 3 * i, half + 3 * i);
    }
    free(all);
    return status_ok();
}

/* All bodies as they are now, into out[scene->bodies]. */
static status bodies_now(const mpm_scene *scene, const mpm *m, scene_body *out)
{
    memset(out, 0, (size_t)scene->bodies * sizeof *out);
    for (int i = 0; i < scene->bodies; i++)
        for (int k = 0; k < 3; k++) out[i].lo[k] = out[i].hi[k] = NAN;
    TRY(add_points(m, out));
    double *failed = malloc((size_t)scene->bodies * sizeof *failed);
    CHECK(failed, STATUS_MEMORY, "no memory for %d bodies", scene->bodies);
    mpm_failed_volumes(m, failed);
    for (int i = 0; i < scene->bodies; i++) {
        const mpm_body_report so_far = mpm_body_state(m, i);
        scene_body *b = &out[i];
        snprintf(b->name, sizeof b->name, "%s", scene->body[i].name);
        for (int k = 0; k < 3; k++) b->position[k] /= b->mass, b->velocity[k] /= b->mass; /* NAN: nothing is left */
        b->failed_volume = failed[i];
        b->peak_pressure = so_far.peak_pressure_999;
        b->max_pressure = so_far.peak_pressure;
        b->peak_mises = so_far.peak_mises;
    }
    free(failed);
    return status_ok();
}

/* ---- their series ---- */

/* clang-format off */
#define BODY_COLUMNS(COLUMN)                                               \
    COLUMN("mass", "kg", "in the window", b->mass)                         \
    COLUMN("position_x", "m", "mean over its mass", b->position[0])        \
    COLUMN("position_y", "m", "mean over its mass", b->position[1])        \
    COLUMN("position_z", "m", "mean over its mass", b->position[2])        \
    COLUMN("velocity_x", "m/s", "mean over its mass", b->velocity[0])      \
    COLUMN("velocity_y", "m/s", "mean over its mass", b->velocity[1])      \
    COLUMN("velocity_z", "m/s", "mean over its mass", b->velocity[2])      \
    COLUMN("kinetic", "J", "as computed: half a model is half", b->kinetic) \
    COLUMN("internal", "J", "as computed", b->internal)                    \
    COLUMN("failed_volume", "m^3", "as computed", b->failed_volume)
/* clang-format on */

static const history_column columns[] = {
#define COLUMN(name, unit, description, value) { name, unit, description },
    BODY_COLUMNS(COLUMN)
#undef COLUMN
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void row_of(const scene_body *b, double row[COLUMNS])
{
#define COLUMN(name, unit, description, value) *row++ = (value);
    BODY_COLUMNS(COLUMN)
#undef COLUMN
}

typedef struct {
    const mpm_scene *scene;
    history *history;
    int series;
    scene_body *body;     /* as they were last; [scene->bodies] */
    double *row;          /* [1 + COLUMNS x bodies] */
    scene_probes *probes; /* owned */
} recorder;

typedef struct {
    char text[BASE_PARAM_TEXT_SIZE + 20]; /* "ball/velocity_x" */
} column_name;

static status open_named(recorder *r, const char *group, history_column *column, column_name *name)
{
    int n = 0;
    column[n++] = (history_column){ "time", "s", "time" };
    for (int i = 0; i < r->scene->bodies; i++)
        for (int c = 0; c < COLUMNS; c++, n++) {
            snprintf(name[n].text, sizeof name[n].text, "%s/%s", r->scene->body[i].name, columns[c].name);
            column[n] = (history_column){ name[n].text, columns[c].unit, columns[c].description };
        }
    return output_history_series(r->history, group, column, n, &r->series);
}

/* Rows later than the time reached are written anew. */
static status open_series(recorder *r, const scene_job *job)
{
    char group[200];
    const size_t n = 1 + (size_t)COLUMNS * (size_t)r->scene->bodies;
    snprintf(group, sizeof group, "/scene/%.150s/bodies", job->name);
    history_column *column = calloc(n, sizeof *column);
    column_name *name = calloc(n, sizeof *name);
    status done = column && name ? open_named(r, group, column, name)
                                 : base_status_error(STATUS_MEMORY, "no memory for %zu columns", n);
    free(column);
    free(name);
    TRY(done);
    const double reached = job->resume.image ? job->resume.time * (1.0 + 1e-9) : -1.0;
    TRY(output_history_rewind(r->history, r->series, reached));
    return scene_probes_open(r->history, job->name, r->scene, job->resume.image ? job->resume.time : -1.0, &r->probes);
}

/* A row of the probes: the watch's part after every step. */
static status read_probes(void *user, const mpm *m, const mpm_report *now, bool *ends)
{
    const recorder *r = user;
    (void)now, (void)ends;
    return scene_probes_step(r->probes, m);
}

/* A row of all bodies: the watch's part after every piece. */
static status record(void *user, const mpm *m, bool *over)
{
    recorder *r = user;
    (void)over; /* it goes to its end */
    TRY(bodies_now(r->scene, m, r->body));
    TRY(scene_probes_piece(r->probes, m));
    r->row[0] = mpm_glance(m).time;
    for (int i = 0; i < r->scene->bodies; i++) row_of(&r->body[i], r->row + 1 + i * COLUMNS);
    return output_history_append(r->history, r->series, r->row);
}

/* ---- the run ---- */

static void take(const scene_outcome *o, scene_bodies_result *r)
{
    const mpm_report *m = &o->report;
    const mpm_ledger *l = &o->ledger;
    r->end_time = m->time;
    r->max_pressure = m->peak_pressure;
    for (int i = 0; i < r->bodies; i++) r->peak_pressure = fmax(r->peak_pressure, r->body[i].peak_pressure);
    r->peak_temperature = m->peak_temperature;
    r->kinetic = l->kinetic;
    r->internal = l->internal;
    r->heat_friction = l->heat_friction;
    r->work_boundary = l->work_boundary;
    r->work_external = l->work_external;
    r->ejected_mass = l->ejected_mass;
    r->eroded_mass = m->eroded_mass;
    r->momentum_error = l->momentum_error;
    r->energy_error = l->energy_error;
#define WORK(member, text) r->member = m->member;
#include "coupling/scene/scene_work.def"
    r->wall_seconds = o->wall;
    r->threads = o->threads;
}

static status write_result(history *h, const char *name, const scene_bodies_result *r)
{
    char *text = output_object_text(&(summary_object){ scene_bodies_keys, r });
    CHECK(text, STATUS_MEMORY, "no memory for a scene's result");
    const status done =
        output_history_text(h, name, "result", "the scene's result: JSON, keys as in summary.json", text);
    free(text);
    return done;
}

status scene_bodies_read(const history *h, const char *name, scene_bodies_result *out)
{
    char *text;
    memset(out, 0, sizeof *out);
    TRY(output_history_read_text(h, name, "result", &text));
    const status done = output_object_read(text, scene_bodies_keys, out);
    free(text);
    return done;
}

static status run_recorded(const scene_job *job, const scene_host *host, recorder *r, scene_bodies_result *out)
{
    const scene_watch watch = { .due = job->scene->probes > 0 ? read_probes : NULL, .piece = record, .user = r };
    scene_job watched = *job;
    scene_outcome o;
    watched.watch = &watch;
    watched.whole = true;
    TRY(open_series(r, job));
    TRY(scene_run(&watched, host, &o));
    take(&o, out);
    TRY(scene_probes_end(r->probes, out->probe));
    TRY(output_history_end(r->history, r->series));
    return write_result(r->history, job->name, out);
}

status scene_bodies_run(const scene_job *job, const scene_host *host, scene_bodies_result *out)
{
    const size_t n = (size_t)job->scene->bodies, probes = (size_t)job->scene->probes;
    history *own = NULL;
    memset(out, 0, sizeof *out);
    out->bodies = job->scene->bodies, out->probes = job->scene->probes;
    out->body = calloc(n, sizeof *out->body);
    out->probe = calloc(probes + 1, sizeof *out->probe);
    recorder r = {
        .scene = job->scene, .history = host->history, .body = out->body, .row = calloc(1 + COLUMNS * n, sizeof *r.row)
    };
    status done = base_status_error(STATUS_MEMORY, "no memory for %zu bodies and %zu probes", n, probes);
    if (out->body && out->probe && r.row) done = r.history ? status_ok() : output_history_open(NULL, false, &own);
    if (own) r.history = own;
    if (done.code == STATUS_OK) done = run_recorded(job, host, &r, out);
    scene_probes_free(r.probes);
    output_history_close(own);
    free(r.row);
    return done;
}

void scene_bodies_free(scene_bodies_result *r)
{
    free(r->body);
    free(r->probe);
    r->body = NULL;
    r->probe = NULL;
}
