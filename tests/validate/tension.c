/* SPDX-License-Identifier: BSD-3-Clause */
/* V13: mesh dependence of damage.  A notched bar of 7075 is pulled apart by its own motion; an eighth of it.  No closed
 * answer: what breaking it costs, and how much of it fails, is to be compared among cell sizes. */
#include "valid.h"

static const double LENGTH = 6e-3, SIDE = 1e-3,
                    NOTCH = 0.3e-3;           /* of the eighth; depth and half length of the notch [m] */
static const double SPEED = 300, END = 14e-6; /* of its end, growing along it from the notch [m/s]; [s] */

static void pull(void *user, block *q, int lane)
{
    (void)user;
    q->v[0][lane] = SPEED * q->x[0][lane] / LENGTH;
    q->L[0][lane] = SPEED / LENGTH;
}

void valid_tension(double cells, const valid_scheme *scheme, valid_result *out)
{
    const mpm_material m = scene_aluminium();
    const double h = SIDE / cells;
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    valid_apply(scheme, &s);
    s.axis[0] = scene_axis(0, LENGTH + 5e-3, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE);
    s.axis[1] = scene_axis(0, 1.5 * SIDE, h, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FREE);
    s.axis[2] = s.axis[1];
    mpm_body *b = scene_box(&s, 0, 0, 0, LENGTH, SIDE, SIDE, &m);
    b->damage = true;
    const double notch[] = { -NOTCH, SIDE - NOTCH, -1, NOTCH, 1, 1 };
    b->solid = scene_solid(&s, "minus", NULL, 0, b->solid, scene_solid(&s, "box", notch, 6, -1, -1));
    mpm *solver = scene_make(&s, 1);
    valid_each(solver, pull, NULL);
    valid_reopen(solver);
    assert_ok(mpm_advance(solver, END, NULL));
    const mpm_report r = mpm_state(solver);
    const mpm_ledger l = mpm_balance(solver);
    out->figure[0] = 1 - l.kinetic / l.kinetic_start;
    out->figure[1] = 1e9 * r.failed_volume;
    out->figure[2] = r.failed_volume / (SIDE * (SIDE - NOTCH) * h);
    valid_finish(solver, out);
}
