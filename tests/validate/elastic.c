/* SPDX-License-Identifier: BSD-3-Clause */
/* V2: an elastic bar that rings.  V6: two elastic disks that meet. */
#include "valid.h"

/* ---- V2: x = 0 held by a mirror, x = L free, no strain across: quarter wave, f = c_l / (4 L), ten periods ---- */

static const double BAR_LENGTH = 0.1, BAR_SPEED = 1; /* [m, m/s] */
enum { BAR_PERIODS = 10 };

typedef struct {
    double length, last_time, last, first_crossing, crossings, last_crossing;
} ringing;

static void ring_start(void *user, block *q, int lane)
{
    (void)user;
    const double k = SCENE_PI / (2 * BAR_LENGTH), X = q->start[0][lane];
    q->v[0][lane] = BAR_SPEED * sin(k * X);
    q->L[0][lane] = BAR_SPEED * k * cos(k * X);
}

/* Amplitude of the first mode in the velocities */
static void ring_amplitude(void *user, block *q, int lane)
{
    double *sum = user;
    const double shape = sin(SCENE_PI * q->start[0][lane] / (2 * BAR_LENGTH));
    sum[0] += q->mass[0][lane] * shape * q->v[0][lane];
    sum[1] += q->mass[0][lane] * shape * shape;
}

/* Mean frequency over `periods` from the first and the last fall through zero; the peak of the last period. */
static void ring(double cells, double viscosity, const valid_scheme *scheme, double *frequency, double *kept,
                 valid_result *out)
{
    const mpm_material m = valid_solid(1.2e9, 0.3, 1000);
    const double h = BAR_LENGTH / cells, c = mpm_material_longitudinal_speed(&m), period = 4 * BAR_LENGTH / c;
    SCENE_LOCAL(s);
    scene_bar(&s, 0, BAR_LENGTH + 4 * h, h, 1);
    valid_apply(scheme, &s);
    s.viscosity_linear = 0.2 * viscosity, s.viscosity_quadratic = 2.0 * viscosity;
    s.axis[0].boundary[0] = MPM_BOUNDARY_SYMMETRY;
    scene_box(&s, 0, -1, -1, BAR_LENGTH, 1, 1, &m);
    mpm *solver = scene_make(&s, 1);
    valid_each(solver, ring_start, NULL);
    valid_reopen(solver);
    double last = 1, last_time = 0, first_zero = 0, zero = 0, peak = 0;
    int zeros = 0;
    while (mpm_state(solver).time < (BAR_PERIODS + 0.3) * period) {
        const mpm_report r = mpm_state(solver);
        assert_ok(mpm_advance(solver, r.time + r.dt, NULL));
        double sum[2] = { 0, 0 };
        valid_each(solver, ring_amplitude, sum);
        const double now = sum[0] / sum[1] / BAR_SPEED, time = mpm_state(solver).time;
        if (last > 0 && now <= 0) {
            zero = last_time + (time - last_time) * last / (last - now);
            if (zeros++ == 0) first_zero = zero;
        }
        if (time > (BAR_PERIODS - 0.5) * period) peak = fmax(peak, now);
        last = now, last_time = time;
    }
    *frequency = (zeros - 1) / (zero - first_zero) * period - 1;
    *kept = peak * peak;
    valid_finish(solver, out);
}

void valid_bar(double cells, const valid_scheme *scheme, valid_result *out)
{
    double frequency, kept, damped;
    ring(cells, 0, scheme, &frequency, &kept, out);
    out->figure[0] = fabs(frequency);
    out->figure[1] = 1 - kept;
    ring(cells, 1, scheme, &frequency, &damped, out);
    out->figure[2] = 1 - damped;
}

/* ---- V6: 20 mm across, 1 GPa, nu 0.33, 10 m/s towards each other, plane strain, one half by a mirror ---- */

static const double DISK_RADIUS = 10e-3, DISK_SPEED = 10;

/* Share of the kinetic energy that has become heat when they have parted. */
static double collide(double cells, bool contact, const valid_scheme *scheme, valid_result *out)
{
    const mpm_material m = valid_solid(1e9, 0.33, 1000);
    const double R = DISK_RADIUS, h = 2 * R / cells, gap = 2.5 * h, side = 2.2 * R;
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.axis[0] = scene_axis(-side - gap - 8 * h, side + gap + 8 * h, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(0, h, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY);
    s.axis[2] = scene_axis(0, 1.1 * R + 3 * h, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE);
    for (int i = 0; i < 2; i++) {
        const double way = i ? -1 : 1, disk[] = { -way * (R + gap / 2), -1, 0, R, 2 };
        mpm_body *b = scene_body(&s, "cylinder", disk, 5, &m);
        b->velocity[0] = way * DISK_SPEED;
        b->group = contact ? i : 0;
    }
    mpm *solver = scene_make(&s, 1);
    /* they fly to each other, press for about 6 R / c, and part by as much again */
    const double end = gap / DISK_SPEED + 10 * R / mpm_material_longitudinal_speed(&m);
    assert_ok(mpm_advance(solver, end, NULL));
    const mpm_ledger l = mpm_balance(solver);
    assert_true(scene_mean(solver, MPM_velocity, 0, 0) < 0); /* they did turn */
    const double heat = (l.heat_friction + l.heat_transfer + l.heat_viscous) / l.kinetic_start;
    out->figure[2] = 1 - l.kinetic / l.kinetic_start;
    valid_finish(solver, out);
    return heat;
}

void valid_disks(double cells, const valid_scheme *scheme, valid_result *out)
{
    out->figure[1] = collide(cells, false, scheme, out);
    out->figure[0] = collide(cells, true, scheme, out);
}
