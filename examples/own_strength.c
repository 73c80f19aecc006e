/* SPDX-License-Identifier: BSD-3-Clause */
/* A law of strength of one's own: a square bar hits a rigid wall (a mirror) at 200 m/s; how long is it afterwards?
 * Voce's law has hardening that ends: sigma_y = (s0 + (s1 - s0) (1 - exp(-e/e0))) (1 + C ln(rate/rate0)) (1 - T*). */
#include "mpm/mpm.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
    double s0, s1, e0, C;
} voce;

static double voce_flow(const void *user, const mpm_strength_point *at)
{
    const voce *v = user;
    return (v->s0 + (v->s1 - v->s0) * (1 - exp(-at->strain / v->e0))) * (1 + v->C * at->log_rate) * (1 - at->T_star);
}

/* Length of the bar, which was 20 mm, after 40 us [m]; negative: *s says what went wrong. */
static double length_after(const voce *law, base_status *s)
{
    static const double hi[3] = { 22e-3, 8e-3, 8e-3 }, size[3] = { 20e-3, 3e-3, 3e-3 };
    mpm_material copper;
    base_params_default(mpm_material_params, &copper);
    snprintf(copper.name, sizeof copper.name, "copper");
    copper.density = 8960, copper.youngs_modulus = 124e9, copper.poisson = 0.34, copper.specific_heat = 383;
    copper.reference_temperature = 293, copper.melting_temperature = 1356, copper.rate_0 = 1;
    copper.sound_speed = 3940, copper.hugoniot_slope = 1.489, copper.gruneisen = 2.02;
    copper.strength = MPM_STRENGTH_own;
    copper.own_strength.flow = voce_flow, copper.own_strength.user = law;
    mpm_scene scene;
    mpm_body *bar;
    mpm_solid *box;
    mpm *m = NULL;
    mpm_scene_default(&scene);
    *s = mpm_scene_add_body(&scene, &bar);
    if (s->code == BASE_STATUS_OK) *s = mpm_scene_add_solid(&scene, "box", -1, -1, &box);
    if (s->code != BASE_STATUS_OK) return -1;
    snprintf(bar->name, sizeof bar->name, "bar");
    bar->material = &copper, bar->solid = 0, bar->velocity[0] = -200;
    for (int d = 0; d < 3; d++) {
        mpm_solid_value(box, "lo")[d] = d == 0 ? 0 : -size[d], mpm_solid_value(box, "hi")[d] = size[d];
        scene.axis[d] = (mpm_axis){ .hi = hi[d],
                                    .fine_hi = hi[d],
                                    .fine = 1e-3,
                                    .coarse = 1e-3,
                                    .growth = 1.2,
                                    .boundary = { MPM_BOUNDARY_SYMMETRY } };
    }
    double length = -1;
    *s = mpm_create(&scene, 1, &m);
    if (s->code == BASE_STATUS_OK) *s = mpm_advance(m, 40e-6, NULL);
    double *x = s->code == BASE_STATUS_OK ? malloc(3 * mpm_points(m) * sizeof *x) : NULL;
    if (x) mpm_read(m, MPM_position, x);
    for (size_t i = 0; x && i < mpm_points(m); i++) length = fmax(length, x[3 * i]);
    free(x);
    mpm_free(m);
    mpm_scene_free(&scene);
    return length;
}

int main(void)
{
    const voce soft = { 150e6, 350e6, 0.2, 0.02 }, hard = { 300e6, 700e6, 0.2, 0.02 };
    base_status s;
    const double a = length_after(&soft, &s), b = a > 0 ? length_after(&hard, &s) : -1;
    if (a > 0 && b > 0) printf("20 mm before, %.2f mm after; twice as strong %.2f mm\n", 1e3 * a, 1e3 * b);
    if (s.code != BASE_STATUS_OK) fprintf(stderr, "%s\n", s.text);
    return a > 0 && b > 0 ? 0 : 1;
}
