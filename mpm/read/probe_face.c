/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure over a face or a box: its mean over the part of the material that lies there.  Pressure times the face's
 * area is the force on it, where the box is thin and full. */
#include "mpm/read/probe_kinds.h"

typedef struct {
    double lo[3], hi[3];
} face;

static const base_param params[] = { PROBE_POINT(face, lo, "corner at the lower ends, fixed in space"),
                                     PROBE_POINT(face, hi, "corner at the upper ends"), PARAMS_END };

static status check(const mpm_probe *p, const char *name)
{
    const face *v = PROBE_VALUES(face, p);
    for (int k = 0; k < 3; k++)
        CHECK(v->lo[k] < v->hi[k], STATUS_BAD_INPUT, "%s: hi along %c, %g m, must lie above lo, %g m", name, "xyz"[k],
              v -> hi[k], v -> lo[k]);
    return status_ok();
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const face *v = PROBE_VALUES(face, p);
    mpm_probe_box_mean(m, p->body, v->lo, v->hi, out);
    return status_ok();
}

const mpm_probe_kind mpm_probe_face = { .name = "face",
                                        .doc = "mean pressure and normal stresses over a face or a box",
                                        .params = params,
                                        .columns = mpm_probe_box_columns,
                                        .mains = 1,
                                        .check = check,
                                        .read = read };
