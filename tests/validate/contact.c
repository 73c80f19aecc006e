/* SPDX-License-Identifier: BSD-3-Clause */
/* V7: a block that slides down an incline, in line with the grid and across it; fast across the grid; a ball that
 * rolls.
 * V8: Hertz. */
#include "valid.h"

typedef struct {
    double last, impulse[3];
} pushing;

static bool watch(void *user, const mpm *m)
{
    pushing *w = user;
    const mpm_report r = mpm_state(m);
    for (int k = 0; k < 3; k++) w->impulse[k] += (r.time - w->last) * mpm_contact_force(m, 1)[k];
    w->last = r.time;
    return true;
}

/* ---- V7: block, 6 x 4 x 1 mm, on a face that is turned from the grid's x axis ---- */

static const double LENGTH = 6e-3, HEIGHT = 4e-3;

/* A block on a face that is turned by `turn` from the grid's x axis, pulled along the face and onto it [m/s2]. */
typedef struct {
    double turn, along, onto, friction, speed, way; /* speed at the start [m/s]; how far the grid reaches [m] */
} sliding;

static mpm *sliding_make(const sliding *b, double h, const valid_scheme *scheme)
{
    const mpm_material m = scene_elastic();
    const double c = cos(b->turn), t = sin(b->turn), x0 = 4e-3, way = b->way;
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.axis[0] = scene_axis(-3e-3, 10e-3 + way, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(-4.185e-3 - (4e-3 + way) * t, 6e-3 + 6e-3 * t, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[2] = scene_axis(0, h, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    /* what lies below is far stiffer than what the block does to it in this time; its ends are held */
    s.axis[0].boundary[0] = s.axis[0].boundary[1] = MPM_BOUNDARY_FIXED;
    s.axis[1].boundary[0] = MPM_BOUNDARY_FIXED;
    const double origin[3] = { x0, -0.37 * h, 0 }; /* off the grid planes */
    for (int i = 0; i < 2; i++) {                  /* below: from the face down */
        const double box[] = { -(i ? 0.5 * LENGTH : 1), i ? 0 : -0.1, -1, i ? 0.5 * LENGTH : 1, i ? HEIGHT : 0, 1 };
        const double turn[] = { 0, 0, 1, -b->turn, 0, 0, 0 };
        mpm_body *body = scene_body(&s, "box", box, 6, &m);
        body->solid = scene_solid(&s, "turn", turn, 7, body->solid, -1);
        body->solid = scene_solid(&s, "move", origin, 3, body->solid, -1);
        body->group = i;
        scene_pass(body, 0, i == 1, i == 1);
        if (i == 0) continue;
        body->body_force[0] = b->along * c - b->onto * t, body->body_force[1] = -b->along * t - b->onto * c;
        body->velocity[0] = b->speed * c, body->velocity[1] = -b->speed * t;
    }
    scene_friction(&s, b->friction);
    return scene_make(&s, 1);
}

/* Along the face, and off it. */
static void turn_to_face(const sliding *b, const double v[2], double *along, double *off)
{
    const double c = cos(b->turn), t = sin(b->turn);
    *along = c * v[0] - t * v[1], *off = t * v[0] + c * v[1];
}

/* Acceleration over g (sin - mu cos), less 1, down a slope of 45 degrees. */
static double incline(double cells, double turn, const valid_scheme *scheme, valid_result *out)
{
    const double pull = 1e6, mu = 0.3, way = 4e-3, slope = SCENE_PI / 4, want = pull * (sin(slope) - mu * cos(slope));
    const sliding b = { turn, pull * sin(slope), pull * cos(slope), mu, 0, way };
    mpm *solver = sliding_make(&b, HEIGHT / cells, scheme);
    const double end = sqrt(2 * way / want);
    pushing w = { .last = 0 };
    assert_ok(mpm_advance(solver, end, &(mpm_sink){ watch, &w }));
    const double mean[2] = { scene_mean(solver, MPM_velocity, 0, 1), scene_mean(solver, MPM_velocity, 1, 1) };
    double speed, along, normal, rise;
    turn_to_face(&b, mean, &speed, &rise);
    turn_to_face(&b, w.impulse, &along, &normal);
    out->figure[1] = -along / normal / mu - 1;
    out->figure[2] = mpm_body_state(solver, 1).peak_plastic_strain;
    valid_finish(solver, out);
    return speed / (want * end) - 1;
}

void valid_block(double cells, const valid_scheme *scheme, valid_result *out)
{
    out->figure[0] = fabs(incline(cells, 0, scheme, out));
}

void valid_tilted(double cells, const valid_scheme *scheme, valid_result *out)
{
    out->figure[0] = fabs(incline(cells, SCENE_PI / 9, scheme, out));
}

/* An armature's slide, 1 km/s and 500 MPa, without friction: what drags it is the grid. */
void valid_fast(double cells, const valid_scheme *scheme, valid_result *out)
{
    const double speed = 1000, pressure = 500e6, density = scene_elastic().density;
    const sliding b = { SCENE_PI / 9, 0, pressure / (density * HEIGHT), 0, speed, 6e-3 };
    mpm *solver = sliding_make(&b, HEIGHT / cells, scheme);
    const double end = b.way / speed;
    pushing w = { .last = 0 };
    assert_ok(mpm_advance(solver, end, &(mpm_sink){ watch, &w }));
    double along, normal;
    turn_to_face(&b, w.impulse, &along, &normal);
    out->figure[0] = fabs(along / normal);
    out->figure[1] = normal / (pressure * LENGTH * HEIGHT / cells * end) - 1;
    valid_finish(solver, out);
}

/* ---- V7: ball on a slope of 45 degrees, mu 0.495: it rolls, a = 5/7 g sin 45 ---- */

static const double BALL_RADIUS = 4e-3;

void valid_rolling(double cells, const valid_scheme *scheme, valid_result *out)
{
    const mpm_material m = scene_elastic();
    const double R = BALL_RADIUS, h = R / cells, way = 6e-3, g = 2e5, side = g * sqrt(0.5);
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.axis[0] = scene_axis(-1.4 * R, way + 1.4 * R, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(-3 * h - 0.37 * h, 2.2 * R, h, MPM_BOUNDARY_FIXED, MPM_BOUNDARY_FREE);
    s.axis[2] = scene_axis(0, 1.2 * R, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE);
    scene_box(&s, -1, -1, -1, 1, 0, 1, &m);
    const double ball[] = { 0, R, 0, R };
    mpm_body *b = scene_body(&s, "sphere", ball, 4, &m);
    b->group = 1;
    b->body_force[0] = side, b->body_force[1] = -side;
    scene_friction(&s, 0.495);
    mpm *solver = scene_make(&s, 1);
    const double want = 5.0 / 7.0 * side, end = sqrt(2 * way / want);
    pushing w = { .last = 0 };
    assert_ok(mpm_advance(solver, end, &(mpm_sink){ watch, &w }));
    out->figure[0] = fabs(scene_mean(solver, MPM_velocity, 0, 1) / (want * end) - 1);
    out->figure[1] = -w.impulse[0] / w.impulse[1]; /* 2/7 when it rolls, 0.495 when it slips */
    out->figure[2] = scene_mean(solver, MPM_position, 0, 1) / way - 1;
    valid_finish(solver, out);
}

/* ---- V8: two equal balls meet slowly.  Hertz's approach 3 P/(4 E' a) is that of points far away, and a ball has none:
 * its middle comes nearer by three quarters of a/R less (point force on a half space), 10 % here.  What holds near the
 * contact, to (a/R)^2, is the way that points on the axis at depth z come nearer to the face under p0 sqrt(1 -
 * r^2/a^2),
 *   u(0) - u(z) = (1 + nu) p0 a/E {atan Z - 2 nu [Z - Z^2/2 acot Z - (Z - atan Z)/2]},   Z = z/a,
 *   a^3 = 3 P R'/(4 E'),   p0 = 3 P/(2 pi a^2),   E' = E/(2 (1 - nu^2)),   R' = R/2.
 * Where the contact begins depends on the cells; how fast the points come nearer with this way must not. ---- */

static const double BALL_E = 1e9, BALL_NU = 0.33, BALL_R = 10e-3,
                    BALL_DEPTH = 2e-3; /* DEPTH: of the points looked at [m] */

/* How much nearer the points of both balls come under a force [m]. */
static double hertz_way(double force)
{
    const double stiff = BALL_E / (2 * (1 - BALL_NU * BALL_NU)), a = cbrt(3 * force * BALL_R / 2 / (4 * stiff));
    const double p0 = 3 * force / (2 * SCENE_PI * a * a), Z = BALL_DEPTH / a;
    const double side = Z - 0.5 * Z * Z * atan(1 / Z) - 0.5 * (Z - atan(Z));
    return 2 * (1 + BALL_NU) * p0 * a / BALL_E * (atan(Z) - 2 * BALL_NU * side);
}

typedef struct {
    double face, spacing; /* where the balls meet, distance of points [m] */
    double last, force, sum[5], largest, smooth;
} pressing;

/* Distance of the points that began near the axis at BALL_DEPTH below either face, interpolated to that depth [m]. */
static double tracer_distance(const mpm *m, const pressing *w)
{
    double *x = scene_read(m, MPM_position), *start = scene_read(m, MPM_start), *body = scene_read(m, MPM_body);
    double at[2] = { 0 };
    for (int b = 0; b < 2; b++) {
        double sum[5] = { 0 };
        for (size_t i = 0; i < mpm_points(m); i++) {
            const double *s = &start[3 * i], deep = (b ? s[1] - w->face : w->face - s[1]) - BALL_DEPTH;
            if ((int)body[i] != b || s[0] > w->spacing || s[2] > w->spacing || fabs(deep) > 2 * w->spacing) continue;
            sum[0] += 1, sum[1] += deep, sum[2] += x[3 * i + 1], sum[3] += deep * deep, sum[4] += deep * x[3 * i + 1];
        }
        const double slope = (sum[0] * sum[4] - sum[1] * sum[2]) / (sum[0] * sum[3] - sum[1] * sum[1]);
        at[b] = (sum[2] - slope * sum[1]) / sum[0];
    }
    free(x), free(start), free(body);
    return at[1] - at[0];
}

static bool press_step(void *user, const mpm *m)
{
    pressing *w = user;
    const mpm_report r = mpm_state(m);
    const double share = 1 - exp(-(r.time - w->last) / w->smooth);
    w->last = r.time;
    w->force += share * (4 * mpm_contact_force(m, 1)[1] - w->force); /* a quarter of it is computed */
    if (w->force > w->largest) w->largest = w->force;
    if (w->force == w->largest && w->force > 0 && r.steps % 10 == 0) {
        const double x = hertz_way(w->force), y = -tracer_distance(m, w);
        w->sum[0] += 1, w->sum[1] += x, w->sum[2] += y, w->sum[3] += x * x, w->sum[4] += x * y;
    }
    return true;
}

void valid_hertz(double cells, const valid_scheme *scheme, valid_result *out)
{
    const double E = BALL_E, nu = BALL_NU, R = BALL_R, h = R / cells, gap = 0.02 * R, speed = 4;
    const mpm_material m = valid_solid(E, nu, 1000);
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.viscosity_linear = s.viscosity_quadratic = 0;
    const double side = 1.1 * R, fine = 0.25 * R;
    s.axis[0] =
        scene_graded(scene_axis(0, side, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE), 0, fine, fmax(R / 12, h), 1.2);
    s.axis[2] = s.axis[0];
    s.axis[1] = scene_graded(scene_axis(-2.1 * R, 2.1 * R, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE), -fine, fine,
                             fmax(R / 12, h), 1.2);
    for (int i = 0; i < 2; i++) {
        const double way = i ? -1 : 1, off = 0.37 * h, ball[] = { 0, off - way * (R + gap / 2), 0, R };
        mpm_body *b = scene_body(&s, "sphere", ball, 4, &m);
        b->velocity[1] = way * speed;
        b->group = i;
    }
    mpm *solver = scene_make(&s, 1);
    /* Hertz: largest approach and half of the time of contact for a meeting at 2 speed */
    const double K = 4.0 / 3.0 * E / (2 * (1 - nu * nu)) * sqrt(R / 2),
                 mass = 0.5 * 1000 * 4.0 / 3.0 * SCENE_PI * R * R * R;
    const double v = 2 * speed, d = pow(1.25 * mass * v * v / K, 0.4), half = 1.47 * d / v;
    pressing w = { .face = 0.37 * h, .spacing = 0.5 * h, .smooth = half / 50 };
    assert_ok(mpm_advance(solver, gap / v + 1.15 * half, &(mpm_sink){ press_step, &w }));
    const double *a = w.sum, slope = (a[0] * a[4] - a[1] * a[2]) / (a[0] * a[3] - a[1] * a[1]);
    out->figure[0] = fabs(slope - 1);
    out->figure[1] = w.largest / (K * pow(d, 1.5)) - 1;
    out->figure[2] = d / h;
    valid_finish(solver, out);
}
