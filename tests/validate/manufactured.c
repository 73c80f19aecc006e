/* SPDX-License-Identifier: BSD-3-Clause */
/* V1: manufactured solutions.  The motion is given, the body force that makes it a solution follows from the law in
 * closed form (Kamojjala, Brannon, Sadeghirad, Guilkey 2015: the axis-aligned cube and the vortex), and is given to the
 * points step by step: v += dt b(X, t), what a body force on the nodes would do.  Both motions go with sin(w t), so
 * that neither has an acceleration at t = 0 and the velocities may stand half a step behind. */
#include "valid.h"

typedef struct {
    const mpm_material *m;
    double K, G, rho, omega, size;
    double turn;  /* of the vortex */
    double t, dt; /* of the step to come [s] */
    double error2, scale2, points;
} motion;

static motion motion_of(const mpm_material *m, double omega, double size)
{
    return (motion){ .m = m,
                     .K = mpm_material_bulk_modulus(m),
                     .G = mpm_material_shear_modulus(m),
                     .rho = m->density,
                     .omega = omega,
                     .size = size };
}

/* Steps to `end`, the force before each; leaves the time reached in w->t. */
static void drive(mpm *m, motion *w, valid_visit *force, double end)
{
    while (mpm_state(m).time < end) {
        const mpm_report r = mpm_state(m);
        w->t = r.time, w->dt = r.dt;
        valid_each(m, force, w);
        assert_ok(mpm_advance(m, r.time + r.dt, NULL));
    }
    w->t = mpm_state(m).time;
}

static void compare(mpm *m, motion *w, valid_visit *visit, valid_result *out)
{
    valid_each(m, visit, w);
    out->figure[0] = sqrt(w->error2 / w->scale2);
    valid_finish(m, out);
    out->momentum = out->energy = 0; /* driven from outside */
}

/* ---- cube between six mirrors: x_i = X_i + A_i sin(pi X_i) sin(w t) ---- */

static const double CUBE_A[3] = { 0.04, -0.03, 0.05 };

static void cube_stretch(const motion *w, const block *q, int lane, double sine, double F[3], double dF[3])
{
    for (int i = 0; i < 3; i++) {
        const double X = q->start[i][lane];
        F[i] = 1 + CUBE_A[i] * SCENE_PI * cos(SCENE_PI * X) * sine;
        dF[i] = -CUBE_A[i] * SCENE_PI * SCENE_PI * sin(SCENE_PI * X) * sine;
    }
    (void)w;
}

/* dp/dmu of (M-3) with s = 1/2, g0 = 0 */
static double pressure_slope(const motion *w, double mu)
{
    if (mu < 0) return w->K;
    const double d = 1 + 0.5 * mu;
    return w->K * ((1 + 2 * mu) / (d * d) - mu * (1 + mu) / (d * d * d));
}

/* F diagonal: no spin, so s = 2 G dev ln F, and rho0 (a - b)_i = d/dX_i [(J/F_i)(-p(J) + 2 G (ln F_i - ln J/3))]. */
static void cube_force(void *user, block *q, int lane)
{
    const motion *w = user;
    const double sine = sin(w->omega * w->t);
    double F[3], dF[3];
    cube_stretch(w, q, lane, sine, F, dF);
    const double J = F[0] * F[1] * F[2];
    for (int i = 0; i < 3; i++) {
        const double dP = J / F[i] * (pressure_slope(w, 1 / J - 1) / J + 4.0 / 3.0 * w->G) * dF[i] / F[i];
        const double a = -CUBE_A[i] * w->omega * w->omega * sin(SCENE_PI * q->start[i][lane]) * sine;
        q->v[i][lane] += w->dt * (a - dP / w->rho);
    }
}

static void cube_start(void *user, block *q, int lane)
{
    const motion *w = user;
    for (int i = 0; i < 3; i++) {
        const double X = q->start[i][lane];
        q->v[i][lane] = CUBE_A[i] * w->omega * sin(SCENE_PI * X);
        q->L[4 * i][lane] = CUBE_A[i] * w->omega * SCENE_PI * cos(SCENE_PI * X);
    }
}

static void cube_compare(void *user, block *q, int lane)
{
    motion *w = user;
    const double sine = sin(w->omega * w->t);
    for (int i = 0; i < 3; i++) {
        const double X = q->start[i][lane], u = CUBE_A[i] * sin(SCENE_PI * X) * sine, e = q->x[i][lane] - X - u;
        w->error2 += e * e, w->scale2 += u * u;
    }
}

void valid_cube(double cells, const valid_scheme *scheme, valid_result *out)
{
    const mpm_material m = valid_solid(1.2e9, 0.3, 1000);
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.viscosity_linear = s.viscosity_quadratic = 0;
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 1, 1 / cells, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    scene_box(&s, -1, -1, -1, 2, 2, 2, &m);
    const double omega = SCENE_PI * mpm_material_longitudinal_speed(&m);
    motion w = motion_of(&m, omega, 1);
    mpm *solver = scene_make(&s, 1);
    valid_each(solver, cube_start, &w);
    drive(solver, &w, cube_force, 0.75 * 2 * SCENE_PI / omega);
    compare(solver, &w, cube_compare, out);
}

/* ---- vortex: the ring 0.75 < R < 1.25 turns by alpha = A h(R) sin(w t), h = (1 - 16 (R - 1)^2)^3 ---- */

/* h and its first two derivatives */
static void vortex_profile(double R, double h[3])
{
    const double x = 4 * (R - 1), d = 1 - x * x;
    h[0] = h[1] = h[2] = 0;
    if (d <= 0) return;
    h[0] = d * d * d;
    h[1] = -24 * x * d * d;
    h[2] = -96 * d * d + 384 * x * x * d;
}

/* In the basis that turns with a point the motion is simple shear by g = R alpha', so with the Jaumann rate
 *   s_rt = G sin g, s_tt = -s_rr = G (1 - cos g), p = 0;
 *   rho b_r = -rho R alpha_t^2 - ds_rr/dr - (s_rr - s_tt)/r,   rho b_t = rho R alpha_tt - ds_rt/dr - 2 s_rt/r. */
static void vortex_force(void *user, block *q, int lane)
{
    const motion *w = user;
    const double X = q->start[0][lane], Z = q->start[2][lane], R = hypot(X, Z);
    double h[3];
    vortex_profile(R, h);
    if (h[0] <= 0) return;
    const double sine = sin(w->omega * w->t), turn = w->turn * w->omega * cos(w->omega * w->t) * h[0];
    const double g = R * w->turn * h[1] * sine, dg = w->turn * (h[1] + R * h[2]) * sine;
    const double s_rr = -w->G * (1 - cos(g)), s_rt = w->G * sin(g);
    const double b_r = -R * turn * turn + (w->G * sin(g) * dg - 2 * s_rr / R) / w->rho;
    const double b_t = -R * w->turn * h[0] * w->omega * w->omega * sine - (w->G * cos(g) * dg + 2 * s_rt / R) / w->rho;
    const double angle = atan2(Z, X) + w->turn * h[0] * sine;
    q->v[0][lane] += w->dt * (b_r * cos(angle) - b_t * sin(angle));
    q->v[2][lane] += w->dt * (b_r * sin(angle) + b_t * cos(angle));
}

/* v = W(r) (-z, x), W = alpha_t */
static void vortex_start(void *user, block *q, int lane)
{
    const motion *w = user;
    const double X = q->start[0][lane], Z = q->start[2][lane], R = hypot(X, Z);
    double h[3];
    vortex_profile(R, h);
    const double W = w->turn * w->omega * h[0], dW = w->turn * w->omega * h[1] / R;
    q->v[0][lane] = -W * Z, q->v[2][lane] = W * X;
    q->L[0][lane] = -X * Z * dW, q->L[2][lane] = -W - Z * Z * dW;
    q->L[6][lane] = W + X * X * dW, q->L[8][lane] = X * Z * dW;
}

static void vortex_compare(void *user, block *q, int lane)
{
    motion *w = user;
    const double X = q->start[0][lane], Z = q->start[2][lane], R = hypot(X, Z);
    double h[3];
    vortex_profile(R, h);
    const double angle = atan2(Z, X) + w->turn * h[0] * sin(w->omega * w->t);
    const double x = R * cos(angle), z = R * sin(angle), dx = q->x[0][lane] - x, dz = q->x[2][lane] - z;
    w->error2 += dx * dx + dz * dz;
    w->scale2 += (x - X) * (x - X) + (z - Z) * (z - Z);
}

static void vortex(double turn, double cells, const valid_scheme *scheme, valid_result *out)
{
    const mpm_material m = valid_solid(1.2e9, 0.3, 1000);
    const double h = 2.6 / cells;
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.viscosity_linear = s.viscosity_quadratic = 0;
    s.axis[0] = s.axis[2] = scene_axis(-1.3, 1.3, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(0, h, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    scene_box(&s, -2, -1, -2, 2, 1, 2, &m);
    const double omega = 2 * SCENE_PI * mpm_material_shear_speed(&m);
    motion w = motion_of(&m, omega, 1);
    w.turn = turn;
    mpm *solver = scene_make(&s, 1);
    valid_each(solver, vortex_start, &w);
    drive(solver, &w, vortex_force, 0.75 * 2 * SCENE_PI / omega);
    compare(solver, &w, vortex_compare, out);
}

/* The ring's middle turns by 0.05, its shear is up to 0.34. */
void valid_vortex(double cells, const valid_scheme *scheme, valid_result *out)
{
    vortex(0.05, cells, scheme, out);
}

/* By 0.15, 1.03: domains along the axes no longer fill the space between points. */
void valid_vortex_far(double cells, const valid_scheme *scheme, valid_result *out)
{
    vortex(0.15, cells, scheme, out);
}
