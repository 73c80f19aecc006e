/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocity of sound of a body as it begins, by the code that the kernels use. */
#include "mpm/law/law_lanes.h"

#include <math.h>

double mpm_law_start_sound(const law *k)
{
    const double volume = 1 / k->rho_start, shear = 4.0 / 3.0 * mpm_law_shear(k) * volume;
    const double start =
        sqrt(wave_speed_square(k, law_form_of(k, k->kernel), vd_set(volume), vd_set(k->p_start), vd_set(shear))[0]);
    return start > 1.1 * k->sound ? start : k->sound;
}
