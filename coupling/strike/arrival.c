/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/strike/arrival.h"
#include "coupling/scene/scene_fill.h"

#include <math.h>
#include <string.h>

static const double PACKAGE_TOLERANCE = 0.01; /* of the package: how far the masses may differ */
static const double AT_PLANE = 1e-6; /* of the body's extent: nearer than this to a window's end it lies there */

static const char *const end_names[2] = { "lo", "hi" };

/* ---- the projectile ---- */

typedef struct {
    double lo[3], hi[3];
} box;

static bool is_in(const mpm_scene *s, int body, const strike_projectile *p)
{
    return s->body[body].group == p->group;
}

static box box_of(const mpm_scene *s, const strike_projectile *p)
{
    box all = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (int i = 0; i < s->bodies; i++) {
        double lo[3], hi[3];
        if (!is_in(s, i, p)) continue;
        mpm_solid_bounds(&s->solid[s->body[i].solid], lo, hi);
        for (int k = 0; k < 3; k++) all.lo[k] = fmin(all.lo[k], lo[k]), all.hi[k] = fmax(all.hi[k], hi[k]);
    }
    return all;
}

/* Its volume inside the window, by the share of each of N^3 cells that lies on this side of the surface. */
static double volume_of(const mpm_solid *solid, const mpm_axis axis[3])
{
    enum { N = 96 };
    double lo[3], hi[3], h[3], sum = 0.0;
    mpm_solid_bounds(solid, lo, hi);
    for (int k = 0; k < 3; k++) {
        lo[k] = fmax(lo[k], axis[k].lo), hi[k] = fmin(hi[k], axis[k].hi);
        if (!(lo[k] < hi[k])) return 0.0;
        h[k] = (hi[k] - lo[k]) / N;
    }
    const double width = cbrt(h[0] * h[1] * h[2]);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            for (int k = 0; k < N; k++) {
                const double x[3] = { lo[0] + (i + 0.5) * h[0], lo[1] + (j + 0.5) * h[1], lo[2] + (k + 0.5) * h[2] };
                sum += fmin(fmax(0.5 + mpm_solid_inside(solid, x) / width, 0.0), 1.0);
            }
    return sum * h[0] * h[1] * h[2];
}

static void set_direction(const mpm_body *b, strike_projectile *p)
{
    p->piston = !isnan(b->piston_mass);
    if (p->piston) {
        p->speed = b->piston_velocity;
        p->n[b->traction_face / 2] = b->traction_face % 2 ? -1.0 : 1.0;
        return;
    }
    p->speed =
        sqrt(b->velocity[0] * b->velocity[0] + b->velocity[1] * b->velocity[1] + b->velocity[2] * b->velocity[2]);
    for (int k = 0; k < 3; k++) p->n[k] = p->speed > 0.0 ? b->velocity[k] / p->speed : k == 0;
}

/* One end of one axis: is the projectile mirrored there, or does it reach out? */
static status meet_end(const mpm_scene *s, const box *b, int k, int end, strike_projectile *p)
{
    const mpm_axis *a = &s->axis[k];
    const double at = end ? a->hi : a->lo, out = end ? b->hi[k] - at : at - b->lo[k];
    const double tolerance = AT_PLANE * (b->hi[k] - b->lo[k]);
    if (out < -tolerance) return status_ok();
    const char *name = s->body[p->body].name;
    if (a->boundary[end] != MPM_BOUNDARY_SYMMETRY) {
        CHECK(out <= tolerance, STATUS_BAD_INPUT,
              "strike.projectile: %s reaches %.4g m out of the window at scene.window.%s.%s = %g m: move it, or widen "
              "the window",
              name, out, mpm_axis_names[k], end_names[end], at);
        return status_ok();
    }
    CHECK(fabs(p->n[k]) < 1e-9, STATUS_BAD_INPUT,
          "strike.projectile: %s flies into the mirror plane at scene.window.%s.%s = %g m, at which it lies: its "
          "velocity must lie in that plane",
          name, mpm_axis_names[k], end_names[end], at);
    p->parts *= 2.0;
    p->from[k] = at;
    return status_ok();
}

/* Of the face that a wave enters, in the window: by the share of each of N^2 squares just inside it. */
static double face_area(const mpm_scene *s, const strike_projectile *p)
{
    enum { N = 256 };
    const mpm_solid *solid = &s->solid[s->body[p->body].solid];
    double lo[3], hi[3], sum = 0.0;
    int n = 0;
    mpm_solid_bounds(solid, lo, hi);
    while (p->n[n] == 0.0) n++;
    const int u = (n + 1) % 3, v = (n + 2) % 3;
    for (int k = 0; k < 3; k++) lo[k] = fmax(lo[k], s->axis[k].lo), hi[k] = fmin(hi[k], s->axis[k].hi);
    const double a = (hi[u] - lo[u]) / N, b = (hi[v] - lo[v]) / N, depth = 1e-3 * (hi[n] - lo[n]);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double x[3];
            x[n] = p->n[n] > 0.0 ? lo[n] + depth : hi[n] - depth;
            x[u] = lo[u] + (i + 0.5) * a, x[v] = lo[v] + (j + 0.5) * b;
            sum += mpm_solid_inside(solid, x) > 0.0;
        }
    return sum * a * b;
}

/* Cells of an axis where this place is [m] */
static double cell_at(const mpm_axis *a, double x)
{
    return x >= a->fine_lo && x <= a->fine_hi ? a->fine : a->coarse;
}

/* Sums of contact reach over two cells: fluid behind a thinner plate touches what is before it. */
static status check_leak(const mpm_scene *s, const strike_projectile *p)
{
    static const double LEAST = 2.0; /* cells across */
    double lo[3], hi[3];
    int n = 0;
    if (!p->piston || p->plate < 0) return status_ok();
    while (p->n[n] == 0.0) n++;
    mpm_solid_bounds(&s->solid[s->body[p->plate].solid], lo, hi);
    const double thick = hi[n] - lo[n], cell = cell_at(&s->axis[n], 0.5 * (lo[n] + hi[n]));
    CHECK(thick >= LEAST * cell * (1.0 - 1e-9), STATUS_BAD_INPUT,
          "strike.plate: %s is %.4g m thick along %s, %.2g cells of %.4g m there: water leaks through fewer than two: "
          "take cells of %.4g m at most (scene.window.%s.cell, fine_lo, fine_hi)",
          s->body[p->plate].name, thick, mpm_axis_names[n], thick / cell, cell, thick / LEAST, mpm_axis_names[n]);
    return status_ok();
}

/* Its bodies and its direction. */
static void find_projectile(const case_inputs *in, strike_projectile *out)
{
    const mpm_scene *s = &in->bodies.scene;
    *out = (strike_projectile){ .plate = -1, .parts = 1.0 };
    for (int i = 0; i < s->bodies; i++) {
        if (strcmp(s->body[i].name, in->strike.projectile) == 0) out->body = i;
        if (strcmp(s->body[i].name, in->strike.plate) == 0) out->plate = i;
    }
    out->group = s->body[out->body].group;
    set_direction(&s->body[out->body], out);
}

/* ---- what the case leaves to the program ---- */

static const double THICK = 2.0; /* of the projectile's length: a thicker plate is not all in the fine zone */

/* The plate in the fine zone from face to face, where the projectile flies through it along an axis. */
static void add_plate_room(const mpm_scene *s, const strike_projectile *p, const box *b, scene_room *also)
{
    double lo[3], hi[3];
    if (p->plate < 0) return;
    mpm_solid_bounds(&s->solid[s->body[p->plate].solid], lo, hi);
    for (int k = 0; k < 3; k++) {
        if (fabs(p->n[k]) != 1.0 || hi[k] - lo[k] > THICK * (b->hi[k] - b->lo[k])) continue;
        also->fine_lo[k] = lo[k], also->fine_hi[k] = hi[k];
    }
}

status strike_fill(case_inputs *in)
{
    mpm_scene *s = &in->bodies.scene;
    const case_strike *c = &in->strike;
    scene_room also = scene_no_room;
    strike_projectile p;
    find_projectile(in, &p);
    const box b = box_of(s, &p);
    const double speed = isnan(c->velocity) ? p.speed : c->velocity;
    if (isnan(s->end_time) && speed > 0.0) s->end_time = c->travel / speed;
    CHECK(!isnan(s->end_time), STATUS_BAD_INPUT,
          "scene.end_time is missing [s]: strike.travel ends the scene, but with which velocity only the shot says; "
          "give the time for `breech scene` and `breech check`");
    for (int k = 0; k < 3 && !p.piston; k++) {
        if (isnan(c->travel) || p.n[k] == 0.0) continue;
        also.lo[k] = b.lo[k] + p.n[k] * c->travel;
        also.hi[k] = b.hi[k] + p.n[k] * c->travel;
    }
    if (!p.piston) add_plate_room(s, &p, &b, &also);
    return scene_fill_with(s, &also);
}

/* ---- its mass and its way ---- */

status strike_projectile_of(const case_inputs *in, strike_projectile *out)
{
    const mpm_scene *s = &in->bodies.scene;
    find_projectile(in, out);
    const box b = box_of(s, out);
    for (int k = 0; k < 3; k++) out->from[k] = 0.5 * (b.lo[k] + b.hi[k]);
    for (int k = 0; k < 3; k++)
        for (int end = 0; end < 2; end++) TRY(meet_end(s, &b, k, end, out));
    for (int k = 0; k < 3; k++) {
        const double reach = fmax(b.hi[k] - out->from[k], out->from[k] - b.lo[k]);
        out->half_width = fmax(out->half_width, reach * sqrt(fmax(0.0, 1.0 - out->n[k] * out->n[k])));
    }
    TRY(check_leak(s, out));
    if (out->piston) out->mass = out->parts * face_area(s, out) * s->body[out->body].piston_mass;
    for (int i = 0; i < s->bodies && !out->piston; i++)
        if (is_in(s, i, out))
            out->mass += out->parts * s->body[i].material->density * volume_of(&s->solid[s->body[i].solid], s->axis);
    return status_ok();
}

/* ---- flight ---- */

status strike_package_check(const case_strike *s, double mass, double package)
{
    const double launched = mass + s->discarded_mass;
    CHECK(mass <= package * (1.0 + PACKAGE_TOLERANCE), STATUS_BAD_INPUT,
          "strike.projectile: %s of the scene weighs %.4g g, the package that the shot launches %.4g g "
          "(armature.mass): make it lighter, or launch a heavier package",
          s->projectile, 1e3 * mass, 1e3 * package);
    CHECK(fabs(launched - package) <= PACKAGE_TOLERANCE * package, STATUS_BAD_INPUT,
          "strike: %s of the scene, %.4g g, and strike.discarded_mass, %.4g g, make %.4g g, the package that the shot "
          "launches weighs %.4g g (armature.mass): discarded_mass, what stays behind at the muzzle, would be %.4g g",
          s->projectile, 1e3 * mass, 1e3 * s->discarded_mass, 1e3 * launched, 1e3 * package, 1e3 * (package - mass));
    return status_ok();
}

/* k of (A-1) [1/m] */
static double drag(const case_strike *s, double mass)
{
    return s->distance > 0.0 ? 0.5 * s->air_density * s->drag_coefficient * s->drag_area / mass : 0.0;
}

double strike_muzzle_for(const case_strike *s, double mass, double arrival_velocity)
{
    return arrival_velocity * exp(drag(s, mass) * s->distance);
}

strike_flight strike_fly(const case_strike *s, double mass, double muzzle_velocity)
{
    const double L = s->distance, v0 = muzzle_velocity, k = drag(s, mass);
    if (!(L > 0.0)) return (strike_flight){ v0, 0.0 };
    return (strike_flight){ v0 * exp(-k * L), k > 0.0 ? expm1(k * L) / (k * v0) : L / v0 };
}

/* ---- the scene ---- */

static status add_probe(mpm_scene *s, const char *kind, const char *name, int body, mpm_probe **out)
{
    for (int i = 0; i < s->probes; i++)
        CHECK(strcmp(s->probe[i].name, name) != 0, STATUS_BAD_INPUT,
              "scene.probes[%d].name = %s: `breech strike` adds a probe of that name; take another one", i, name);
    TRY(mpm_scene_add_probe(s, kind, name, out));
    (*out)->body = body;
    return status_ok();
}

static status add_way(mpm_scene *s, const strike_projectile *p, double velocity)
{
    mpm_probe *way;
    TRY(add_probe(s, "passage", STRIKE_WAY_PROBE, p->body, &way));
    memcpy(mpm_probe_value(way, "along"), p->n, sizeof p->n);
    memcpy(mpm_probe_value(way, "from"), p->from, sizeof p->from);
    *mpm_probe_value(way, "reach") = 0.5 * p->half_width;
    /* a plate that water drives moves at up to twice the piston's velocity while it bulges */
    *mpm_probe_value(way, "slower") = p->piston ? 4.0 * velocity : fmax(STRIKE_SLOW * velocity, STRIKE_SWINGS);
    return status_ok();
}

/* The plate seen from where the projectile comes from, beside its way; along the flight as far as the projectile is
 * wide, so that a plug that has flown off closes no hole.  Columns of two cells, so that points that are stretched
 * leave no gaps. */
static status add_plate(mpm_scene *s, const strike_projectile *p)
{
    enum { WIDTHS = 3, CELLS = 2 };
    mpm_probe *map;
    double plate[2][3];
    TRY(add_probe(s, "surface", STRIKE_PLATE_PROBE, p->plate, &map));
    mpm_solid_bounds(&s->solid[s->body[p->plate].solid], plate[0], plate[1]);
    double *lo = mpm_probe_value(map, "lo"), *hi = mpm_probe_value(map, "hi"), *along = mpm_probe_value(map, "along");
    for (int k = 0; k < 3; k++) {
        const bool flight = fabs(p->n[k]) == 1.0;
        CHECK(flight || p->n[k] == 0.0, STATUS_BAD_INPUT,
              "strike.plate: holes are looked for along an axis; the projectile flies along [%.4g, %.4g, %.4g]: turn "
              "the plate instead (shape: {turn: {axis: 0 0 1, angle: 30 deg, of: ..}}), or leave out strike.plate",
              p->n[0], p->n[1], p->n[2]);
        const double side = WIDTHS * p->half_width, beyond = 2.0 * p->half_width;
        along[k] = -p->n[k];
        lo[k] = flight ? plate[0][k] - beyond : fmax(fmax(plate[0][k], s->axis[k].lo), p->from[k] - side);
        hi[k] = flight ? plate[1][k] + beyond : fmin(fmin(plate[1][k], s->axis[k].hi), p->from[k] + side);
        CHECK(lo[k] < hi[k], STATUS_BAD_INPUT,
              "strike.plate: %s does not stand in the way of %s along %s: %g .. %g m, the way is %g .. %g m",
              s->body[p->plate].name, s->body[p->body].name, mpm_axis_names[k], plate[0][k], plate[1][k],
              p->from[k] - side, p->from[k] + side);
    }
    double cell = INFINITY;
    for (int k = 0; k < 3; k++)
        if (p->n[k] == 0.0) cell = fmin(cell, s->axis[k].fine);
    *mpm_probe_value(map, "cell") = CELLS * cell;
    return status_ok();
}

static bool has_fluid(const mpm_scene *s)
{
    bool fluid = false;
    for (int i = 0; i < s->bodies; i++) fluid = fluid || mpm_material_shear(s->body[i].material) == MPM_SHEAR_NONE;
    return fluid;
}

status strike_scene(const case_inputs *in, const strike_projectile *p, double velocity, case_bodies *out)
{
    const case_strike *k = &in->strike;
    *out = in->bodies;
    mpm_scene_default(&out->scene); /* of no arrays, lest an error leaves those of the case */
    TRY(mpm_scene_copy(&in->bodies.scene, &out->scene));
    mpm_scene *s = &out->scene;
    mpm_probe *force;
    if (p->piston) s->body[p->body].piston_velocity = velocity;
    for (int i = 0; i < s->bodies && !p->piston; i++)
        for (int q = 0; q < 3 && is_in(s, i, p); q++) s->body[i].velocity[q] = velocity * p->n[q];
    if (!isnan(k->travel)) s->end_time = k->travel / velocity;
    TRY(add_probe(s, "force", STRIKE_FORCE_PROBE, p->body, &force));
    TRY(add_way(s, p, velocity));
    if (has_fluid(s)) TRY(add_probe(s, "cavitation", STRIKE_CAVITY_PROBE, -1, &force));
    return p->plate >= 0 ? add_plate(s, p) : status_ok();
}
