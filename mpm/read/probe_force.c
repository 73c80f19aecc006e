/* SPDX-License-Identifier: BSD-3-Clause */
/* Force: what contact with all other groups did to a body's group in the last step, as its mean.  Times that step it is
 * the impulse, so their sum over all steps is the impulse of the whole time. */
#include "mpm/read/probe_kinds.h"

static const base_param params[] = { PARAMS_END };

static const mpm_column columns[] = { { "force_x", "N", "contact force on the body's group, mean of the last step" },
                                      { "force_y", "N", "the same along y" },
                                      { "force_z", "N", "the same along z" },
                                      { NULL, NULL, NULL } };

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const double *force = mpm_contact_force(m, m->scene.body[p->body].group);
    for (int k = 0; k < 3; k++) out[k] = force[k];
    return status_ok();
}

const mpm_probe_kind mpm_probe_force = { .name = "force",
                                         .doc = "contact force on a body's group",
                                         .params = params,
                                         .columns = columns,
                                         .mains = 3,
                                         .of_step = true,
                                         .of_body = true,
                                         .read = read };
