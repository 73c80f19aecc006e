/* SPDX-License-Identifier: BSD-3-Clause */
/* What the integrator holds: all unknowns, and those of the shot behind the supplies'. */
#include "circuit/shot_internal.h"

double *circuit_shot_y(const circuit_shot *s)
{
    return circuit_dae_y(s->solver);
}

double *circuit_shot_z(const circuit_shot *s)
{
    return circuit_dae_y(s->solver) + s->model.start;
}
