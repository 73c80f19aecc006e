/* SPDX-License-Identifier: BSD-3-Clause */
/* Of the laws whose shear modulus varies what law.c needs of the kernels' own functions. */
#include "mpm/law/law_lanes.h"

double mpm_law_shear(const law *k)
{
    if (k->shear != MPM_SHEAR_VARIES) return k->G;
    return shear_modulus(k, vd_set(0), vd_set(k->rho0), vd_set(k->T_r))[0];
}
