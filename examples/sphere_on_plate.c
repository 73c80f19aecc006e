/* SPDX-License-Identifier: BSD-3-Clause */
/* A copper ball of 4 mm hits a copper plate at 800 m/s; a quarter is computed. */
#include "mpm/mpm.h"

#include <stdio.h>

/* A body of its own group, whose shape's values are still to be given. */
static base_status add(mpm_scene *s, const mpm_material *metal, const char *name, const char *shape, mpm_body **b,
                       mpm_solid **solid)
{
    const base_status done = mpm_scene_add_body(s, b);
    if (done.code != BASE_STATUS_OK) return done;
    snprintf((*b)->name, sizeof(*b)->name, "%s", name);
    (*b)->material = metal, (*b)->group = s->bodies - 1, (*b)->solid = s->solids;
    return mpm_scene_add_solid(s, shape, -1, -1, solid);
}

int main(void)
{
    mpm_material copper;
    base_params_default(mpm_material_params, &copper);
    snprintf(copper.name, sizeof copper.name, "copper");
    copper.density = 8960, copper.youngs_modulus = 124e9, copper.poisson = 0.34, copper.specific_heat = 383;
    copper.reference_temperature = 293, copper.melting_temperature = 1356, copper.taylor_quinney = 0.9;
    copper.sound_speed = 3940, copper.hugoniot_slope = 1.489, copper.gruneisen = 2.02, copper.rate_0 = 1;
    copper.yield_A = 90e6, copper.hardening_B = 292e6, copper.hardening_n = 0.31, copper.rate_C = 0.025,
    copper.softening_m = 1.09;
    mpm_scene s;
    mpm *m = NULL;
    mpm_body *plate, *ball;
    mpm_solid *box, *sphere;
    mpm_scene_default(&s);
    base_status done = add(&s, &copper, "plate", "box", &plate, &box);
    for (int d = 0; d < 3 && done.code == BASE_STATUS_OK;
         d++) { /* x from -4.5 to 4 mm, y and z from their mirrors to 6 mm */
        mpm_solid_value(box, "lo")[d] = d == 0 ? 0 : -6e-3, mpm_solid_value(box, "hi")[d] = d == 0 ? 2e-3 : 6e-3;
        const double lo = d == 0 ? -4.5e-3 : 0, hi = d == 0 ? 4e-3 : 6e-3, cell = 0.5e-3;
        s.axis[d] = (mpm_axis){ lo,
                                hi,
                                lo,
                                hi,
                                cell,
                                cell,
                                .growth = 1.2,
                                .boundary = { d == 0 ? MPM_BOUNDARY_FREE : MPM_BOUNDARY_SYMMETRY } };
    }
    if (done.code == BASE_STATUS_OK) done = add(&s, &copper, "ball", "sphere", &ball, &sphere);
    if (done.code == BASE_STATUS_OK) {
        mpm_solid_value(sphere, "center")[0] = -2.1e-3, *mpm_solid_value(sphere, "radius") = 2e-3;
        ball->velocity[0] = 800;
        done = mpm_create(&s, 1, &m);
    }
    if (done.code == BASE_STATUS_OK) done = mpm_advance(m, 4e-6, NULL);
    if (done.code == BASE_STATUS_OK)
        printf("%.2f GPa in the plate, momentum error %.0e, energy error %.0e\n",
               1e-9 * mpm_body_state(m, 0).peak_pressure, mpm_balance(m).momentum_error, mpm_balance(m).energy_error);
    if (done.code != BASE_STATUS_OK) fprintf(stderr, "%s\n", done.text);
    mpm_free(m);
    mpm_scene_free(&s);
    return done.code == BASE_STATUS_OK ? 0 : 1;
}
