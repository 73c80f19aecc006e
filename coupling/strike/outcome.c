/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/strike/outcome.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double AT_REST = 0.02;   /* of the arrival velocity: slower is no motion */
static const double CLEAR = 1e-3;     /* of the projectile's mass: less in its way does not hold it */
static const double LATE = 0.1;       /* of the scene's time: its last part */
static const double STEADY = 0.1;     /* of its speed: it changes by less in that part once nothing holds it */
static const double MOST_LEFT = 0.1;  /* of its mass: a projectile of which more has left is judged before */
static const double ROUNDING = 1e-9;  /* of its mass: sums of its points differ by less */
static const double LEAST_KEPT = 0.1; /* of its mass, intact in the window: with less it is gone */
enum { LEAST_COLUMNS = 4 };           /* of the whole plate's map that make a hole: one of a quarter at its corner */

const char *const strike_class_names[] = { [STRIKE_REBOUND] = "rebound",
                                           [STRIKE_STOPPED] = "stopped",
                                           [STRIKE_PIERCED] = "pierced",
                                           [STRIKE_BULGED] = "bulged",
                                           [STRIKE_TORN] = "torn",
                                           [STRIKE_UNFINISHED] = "unfinished",
                                           NULL };

strike_class strike_class_of(const strike_state *s)
{
    const double u = s->speed - (isnan(s->rest_speed) ? 0.0 : s->rest_speed), slow = AT_REST * s->arrival;
    if (!s->touched || isnan(u)) return STRIKE_UNFINISHED;
    if (s->piston && s->hole >= s->least_hole) return STRIKE_TORN;
    if (s->piston) return s->swelling < STEADY ? STRIKE_BULGED : STRIKE_UNFINISHED;
    if (u > slow && s->ahead < CLEAR * s->mass && s->change < STEADY * u) return STRIKE_PIERCED;
    if (u > slow || s->change > slow) return STRIKE_UNFINISHED;
    if (s->plate) return s->hole >= s->least_hole ? STRIKE_TORN : STRIKE_BULGED;
    return u < -slow ? STRIKE_REBOUND : STRIKE_STOPPED;
}

/* ---- series ---- */

typedef struct {
    double *value;
    size_t n;
} column;

static status read_column(history *h, const char *scene, const char *group, const char *name, column *out)
{
    char path[200];
    size_t dims[H5_MAX_RANK];
    snprintf(path, sizeof path, "%.120s/%.70s", group, name);
    TRY(output_history_read(h, scene, path, &out->value, dims));
    out->n = dims[0];
    return status_ok();
}

/* The columns of one series, its time first. */
enum { MOST_COLUMNS = 8 };
typedef struct {
    column of[MOST_COLUMNS];
    size_t rows;
} series;

static void series_free(series *s)
{
    for (int i = 0; i < MOST_COLUMNS; i++) free(s->of[i].value);
}

static status series_read(history *h, const char *scene, const char *group, const char *const *names, series *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; names[i]; i++) {
        TRY(read_column(h, scene, group, names[i], &out->of[i]));
        CHECK(out->of[i].n > 0 && out->of[i].n == out->of[0].n, STATUS_NUMERICAL,
              "the scene `%s` has no whole series %s/%s", scene, group, names[i]);
    }
    out->rows = out->of[0].n;
    return status_ok();
}

/* ---- force ---- */

/* Impulse that has been given by the time t, by that at the ends of all steps: linear within a step. */
static double impulse_by(const double *time, const double *sum, size_t n, double t)
{
    size_t i = 1;
    if (t <= time[0]) return 0.0;
    while (i < n - 1 && time[i] < t) i++;
    return sum[i - 1] + (sum[i] - sum[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
}

/* A row's force is the mean over the step that ended then. */
static status take_force(const series *force, const strike_projectile *p, double filter, strike_outcome *out)
{
    const double *time = force->of[0].value;
    double *sum = calloc(force->rows, sizeof *sum);
    CHECK(sum, STATUS_MEMORY, "no memory for %zu rows of force", force->rows);
    for (size_t i = 1; i < force->rows; i++) {
        double against = 0.0;
        for (int k = 0; k < 3; k++) against -= p->n[k] * force->of[1 + k].value[i];
        sum[i] = sum[i - 1] + p->parts * against * (time[i] - time[i - 1]);
    }
    out->peak_force = 0.0, out->peak_time = NAN;
    for (size_t i = 1; i < force->rows; i++) {
        const double mean = (sum[i] - impulse_by(time, sum, force->rows, time[i] - filter)) / filter;
        if (mean > out->peak_force) out->peak_force = mean, out->peak_time = time[i];
    }
    out->impulse = sum[force->rows - 1];
    free(sum);
    return status_ok();
}

static status read_force(history *h, const char *scene, const strike_projectile *p, double filter, strike_outcome *out)
{
    static const char *const names[] = { "time", "force_x", "force_y", "force_z", NULL };
    series force;
    status done = series_read(h, scene, "probes/" STRIKE_FORCE_PROBE, names, &force);
    if (done.code == STATUS_OK) done = take_force(&force, p, filter, out);
    series_free(&force);
    return done;
}

/* ---- the way ---- */

enum { WAY_TIME, WAY_SPEED, WAY_AHEAD, WAY_REST, WAY_DEFLECTION, WAY_FLYING, WAY_INTACT, WAY_ROOM };

/* Of the projectile's bodies together, a row a piece. */
typedef struct {
    column time, mass, kinetic;
} body_sums;

static void sums_free(body_sums *b)
{
    free(b->time.value), free(b->mass.value), free(b->kinetic.value);
}

static status add_column(history *h, const char *scene, const char *body, const char *name, column *sum)
{
    char group[200];
    column one;
    snprintf(group, sizeof group, "bodies/%s", body);
    TRY(read_column(h, scene, group, name, &one));
    if (!sum->value) {
        *sum = one;
        return status_ok();
    }
    for (size_t i = 0; i < sum->n && i < one.n; i++) sum->value[i] += one.value[i];
    free(one.value);
    return status_ok();
}

static status sums_read(history *h, const char *scene, const strike_projectile *p, const mpm_scene *s, body_sums *out)
{
    TRY(read_column(h, scene, "bodies", "time", &out->time));
    for (int i = 0; i < s->bodies; i++) {
        if (s->body[i].group != p->group) continue;
        TRY(add_column(h, scene, s->body[i].name, "mass", &out->mass));
        TRY(add_column(h, scene, s->body[i].name, "kinetic", &out->kinetic));
    }
    return status_ok();
}

/* When its intact metal first came as near as this to an end of the window that it moved towards; INFINITY: never. */
static double when_near(const series *way, double near)
{
    for (size_t i = 0; i < way->rows; i++)
        if (way->of[WAY_ROOM].value[i] < near) return way->of[WAY_TIME].value[i];
    return INFINITY;
}

/* The last row of the sums before which no more than MOST_LEFT of the projectile has left the window; kept: of what it
 * had before any of it left, the part that it has then [1]. */
static size_t last_there(const body_sums *b, double leaving, double *kept, strike_outcome *out)
{
    size_t whole = 0, last = b->time.n - 1;
    while (whole < last && b->time.value[whole + 1] <= leaving) whole++;
    const double then = b->mass.value[whole], start = b->mass.value[0];
    const double left = (then - b->mass.value[last]) / start;
    out->left_share = left > ROUNDING ? left : 0.0;
    while (last > whole && b->mass.value[last] < then - MOST_LEFT * start) last--;
    *kept = then > 0.0 ? b->mass.value[last] / then : 1.0;
    return last;
}

/* seen: until when there is enough of the projectile [s] */
static void take_way(const series *way, const strike_projectile *p, double seen, strike_state *state,
                     strike_outcome *out)
{
    const double *time = way->of[WAY_TIME].value, *speed = way->of[WAY_SPEED].value;
    const size_t end = way->rows - 1;
    size_t last = end;
    while (last > 0 && (time[last] > seen || isnan(speed[last]))) last--;
    size_t late = last;
    while (late > 0 && time[late] > (1.0 - LATE) * time[last]) late--;
    state->speed = speed[last];
    state->rest_speed = way->of[WAY_REST].value[last];
    state->change = fabs(speed[last] - speed[late]);
    state->ahead = p->parts * way->of[WAY_AHEAD].value[last];
    const double *deflection = way->of[WAY_DEFLECTION].value, *intact = way->of[WAY_INTACT].value;
    state->swelling = deflection[end] > 0.0 ? 1.0 - deflection[late] / deflection[end] : 0.0;
    out->judged_time = time[last];
    out->gone = intact[end] < LEAST_KEPT * intact[0];
    out->residual_velocity = state->speed;
    out->speed_change = state->change;
    out->ahead = state->ahead;
    out->deflection = way->of[WAY_DEFLECTION].value[end];
    out->debris_mass = p->parts * way->of[WAY_FLYING].value[end];
}

/* What it had when it was judged, `kept` of it and with it what left before then; what it has lost by the end. */
static void take_sums(const body_sums *b, const strike_projectile *p, size_t judged, double kept, strike_outcome *out)
{
    const double *mass = b->mass.value, *kinetic = b->kinetic.value;
    out->projectile_mass = p->piston ? p->mass : p->parts * mass[0];
    out->energy_arrival =
        p->piston ? 0.5 * p->mass * out->impact_velocity * out->impact_velocity : p->parts * kinetic[0];
    out->energy_absorbed = p->parts * (kinetic[0] - kinetic[judged] / kept);
    const double lost = mass[0] - mass[b->mass.n - 1];
    out->lost_mass = lost > ROUNDING * mass[0] ? p->parts * lost : 0.0;
}

static double coarsest_cell(const mpm_scene *s)
{
    return fmax(s->axis[0].coarse, fmax(s->axis[1].coarse, s->axis[2].coarse));
}

static status read_projectile(history *h, const char *scene, const strike_projectile *p, const mpm_scene *s,
                              strike_state *state, strike_outcome *out)
{
    static const char *const names[] = { "time",   "speed",  "ahead", "rest_speed", "deflection",
                                         "flying", "intact", "room",  NULL };
    series way = { 0 };
    body_sums sums = { { 0 }, { 0 }, { 0 } };
    status done = series_read(h, scene, "probes/" STRIKE_WAY_PROBE, names, &way);
    if (done.code == STATUS_OK) done = sums_read(h, scene, p, s, &sums);
    if (done.code == STATUS_OK) {
        double kept;
        const size_t judged = last_there(&sums, when_near(&way, coarsest_cell(s)), &kept, out);
        take_way(&way, p, sums.time.value[judged], state, out);
        take_sums(&sums, p, judged, kept, out);
    }
    sums_free(&sums);
    series_free(&way);
    return done;
}

/* ---- the plate ---- */

/* Columns of the last map without intact metal that had some at the start: the map is the plate's box, of which a disc
 * does not fill the corners, nor a drilled plate its holes. */
static status read_plate(history *h, const char *scene, const strike_projectile *p, const mpm_scene *s,
                         strike_state *state, strike_outcome *out)
{
    size_t dims[H5_MAX_RANK];
    double *x, area = 1.0;
    int k = 0, open = 0;
    const mpm_probe *map = NULL;
    while (p->n[k] == 0.0) k++;
    for (int i = 0; i < s->probes; i++)
        if (strcmp(s->probe[i].name, STRIKE_PLATE_PROBE) == 0) map = &s->probe[i];
    char path[100];
    snprintf(path, sizeof path, "probes/" STRIKE_PLATE_PROBE "/%s", mpm_axis_names[k]);
    TRY(output_history_read(h, scene, path, &x, dims));
    for (size_t i = 0; i < dims[1]; i++) open += !isnan(x[i]) && isnan(x[(dims[0] - 1) * dims[1] + i]);
    free(x);
    mpm_probe own = *map;
    for (int q = 0; q < 3; q++)
        if (q != k) area *= mpm_probe_value(&own, "hi")[q] - mpm_probe_value(&own, "lo")[q];
    const double one = p->parts * area / (double)dims[1];
    state->plate = true;
    state->hole = open * one;
    state->least_hole = LEAST_COLUMNS * one / p->parts;
    out->open = state->hole >= state->least_hole;
    out->hole_diameter = sqrt(4.0 * state->hole / PI);
    return status_ok();
}

/* ---- the target ---- */

static status read_target(history *h, const char *scene, const strike_projectile *p, const mpm_scene *s,
                          const scene_bodies_result *r, strike_outcome *out)
{
    double start = 0.0, kept = 0.0;
    for (int i = 0; i < r->bodies; i++) {
        const scene_body *b = &r->body[i];
        column mass = { NULL, 0 };
        if (s->body[i].group == p->group) continue;
        TRY(add_column(h, scene, b->name, "mass", &mass));
        start += mass.value[0], kept += b->mass, out->failed_volume += p->parts * b->failed_volume;
        free(mass.value);
    }
    out->target_mass = p->parts * start;
    out->debris_mass += p->parts * fmax(0.0, start - kept); /* below 0 by rounding */
    return status_ok();
}

/* The largest of the water that was ever cavitated at once. */
static status read_cavity(history *h, const char *scene, const strike_projectile *p, const mpm_scene *s,
                          strike_outcome *out)
{
    static const char *const names[] = { "time", "volume", NULL };
    bool asked = false;
    out->cavitated_volume = NAN;
    for (int i = 0; i < s->probes; i++) asked = asked || strcmp(s->probe[i].name, STRIKE_CAVITY_PROBE) == 0;
    if (!asked) return status_ok();
    series cavity;
    const status done = series_read(h, scene, "probes/" STRIKE_CAVITY_PROBE, names, &cavity);
    out->cavitated_volume = 0.0;
    for (size_t i = 0; done.code == STATUS_OK && i < cavity.rows; i++)
        out->cavitated_volume = fmax(out->cavitated_volume, p->parts * cavity.of[1].value[i]);
    series_free(&cavity);
    return done;
}

status strike_outcome_read(history *h, const char *scene, const strike_projectile *p, const case_bodies *bodies,
                           double filter, double velocity, const scene_bodies_result *r, strike_outcome *out)
{
    strike_state state = { .arrival = velocity, .piston = p->piston };
    *out = (strike_outcome){
        .muzzle_velocity = NAN, .flight_time = NAN, .impact_velocity = velocity, .hole_diameter = NAN
    };
    TRY(read_projectile(h, scene, p, &bodies->scene, &state, out));
    TRY(read_force(h, scene, p, filter, out));
    TRY(read_target(h, scene, p, &bodies->scene, r, out));
    if (p->piston) out->energy_absorbed = p->parts * r->work_external;
    out->energy_share = out->energy_absorbed / out->energy_arrival;
    TRY(read_cavity(h, scene, p, &bodies->scene, out));
    if (p->plate >= 0) TRY(read_plate(h, scene, p, &bodies->scene, &state, out));
    state.mass = out->projectile_mass;
    state.touched = out->peak_force > 0.0;
    out->class = strike_class_of(&state);
    return status_ok();
}
