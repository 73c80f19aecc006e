/* SPDX-License-Identifier: BSD-3-Clause */
/* V12: two elastic plates meet obliquely while both are carried through the grid along all three axes: translation,
 * shock and shear at once, in three dimensions; what a transfer scheme must bear in a scene.
 *
 * In one field, so welded at once.  Behind the fronts that run from the plane of impact at c_l and c_s the relative
 * velocity is zero, normal and tangential; before them it is as at the start.  Compared along the middle, where no edge
 * has been heard of. */
#include "valid.h"

static const double HALF_WIDTH = 0.8;             /* of the plates across, in thicknesses */
static const double TRAVEL = 0.6;                 /* of the fast front, in thicknesses */
static const double SPEED = 10;                   /* each plate, normal; the same tangential [m/s] */
static const double CARRIED[3] = { 1, 0.7, 0.4 }; /* of the fast wave's speed */

typedef struct {
    double front[2], carried[3]; /* of the normal and the tangential velocity [thickness]; [m/s] */
    double error[2];             /* sums of m |v - exact| */
    double mass;
} core;

/* The tangential direction is the diagonal of y and z. */
static void compare(void *user, block *q, int lane)
{
    core *c = user;
    const double depth = q->start[0][lane], m = q->mass[0][lane];
    const double room = HALF_WIDTH - TRAVEL - 0.05;
    if (fabs(q->start[1][lane]) > room || fabs(q->start[2][lane]) > room || fabs(depth) > 0.9) return;
    const double side = depth < 0 ? 1 : -1;
    double v[3];
    for (int k = 0; k < 3; k++) v[k] = q->v[k][lane] - c->carried[k];
    const double relative[2] = { v[0], (v[1] + v[2]) / sqrt(2) };
    for (int i = 0; i < 2; i++) {
        const double exact = fabs(depth) < c->front[i] ? 0 : side * SPEED;
        c->error[i] += m * fabs(relative[i] - exact);
    }
    c->mass += m;
}

/* `carried`: 1, or 0 for plates whose centre of mass stays.  Figures from `first` on: both errors. */
static mpm *impact(double cells, const valid_scheme *scheme, double carried, valid_result *out, int first)
{
    const mpm_material m = valid_solid(1e9, 0.3, 1000);
    const double fast = mpm_material_longitudinal_speed(&m), end = TRAVEL / fast, h = 1 / cells, B = HALF_WIDTH;
    core c = { .front = { TRAVEL, TRAVEL * mpm_material_shear_speed(&m) / fast } };
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    for (int k = 0; k < 3; k++) {
        const double lo = k == 0 ? -1 : -B, way = carried * CARRIED[k] * TRAVEL;
        const double n = ceil((way - 2 * lo) / h) + 4; /* cells, some to spare: nothing leaves */
        c.carried[k] = carried * CARRIED[k] * fast;
        s.axis[k] = scene_axis(lo - 2.3 * h, lo - 2.3 * h + n * h, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    }
    for (int side = -1; side <= 1; side += 2) {
        mpm_body *b = scene_box(&s, side < 0 ? -1 : 0, -B, -B, side < 0 ? 0 : 1, B, B, &m);
        b->velocity[0] = c.carried[0] - side * SPEED;
        for (int k = 1; k < 3; k++) b->velocity[k] = c.carried[k] - side * SPEED / sqrt(2);
    }
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, end, NULL));
    valid_each(solver, compare, &c);
    for (int i = 0; i < 2; i++) out->figure[first + i] = c.error[i] / (c.mass * SPEED);
    return solver;
}

void valid_oblique(double cells, const valid_scheme *scheme, valid_result *out)
{
    valid_finish(impact(cells, scheme, 0, out, 2), out);
    valid_finish(impact(cells, scheme, 1, out, 0), out);
}
