/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure at a point: the mean over a cube of half width `reach` about it, a cell of the grid if none is given. */
#include "mpm/read/probe_kinds.h"

typedef struct {
    double at[3], reach;
} pressure;

static const base_param params[] = { PROBE_POINT(pressure, at, "the point, fixed in space"),
                                     PARAM_DOUBLE(pressure, reach, "m", OPTIONAL, 1e-9, PROBE_FARTHEST,
                                                  "half width of the cube; not given: half a cell there"),
                                     PARAMS_END };

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const pressure *v = PROBE_VALUES(pressure, p);
    const axis *axes = m->grids.level[mpm_grids_level(&m->grids, v->at)].axes;
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        const double reach = isnan(v->reach) ? 0.5 * mpm_axis_spacing(&axes[k], v->at[k]) : v->reach;
        lo[k] = v->at[k] - reach, hi[k] = v->at[k] + reach;
    }
    mpm_probe_box_mean(m, p->body, lo, hi, out);
    return status_ok();
}

const mpm_probe_kind mpm_probe_pressure = { .name = "pressure",
                                            .doc = "pressure and normal stresses at a point",
                                            .params = params,
                                            .columns = mpm_probe_box_columns,
                                            .mains = 1,
                                            .read = read };
