/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/law/law_point.h"

#include "mpm/law/law_lanes.h"

#include <stdlib.h>
#include <string.h>

struct mpm_point_law {
    law law;
    law_form form;
    double T, T_star; /* [K, 1] */
    double mu, e;     /* compression and energy at no pressure [1, J/kg] */
};

status mpm_point_law_make(const mpm_material *m, double temperature, mpm_point_law **out)
{
    const size_t line = 64, size = (sizeof **out + line - 1) / line * line;
    mpm_scene scene;
    mpm_scene_default(&scene);
    const mpm_body body = { .material = m,
                            .temperature = temperature,
                            .yield_scale = 1,
                            .cold_work = NAN,
                            .damage = mpm_material_shear(m) != MPM_SHEAR_NONE };
    mpm_point_law *k = *out = aligned_alloc(line, size);
    CHECK(k, STATUS_MEMORY, "no memory for a law");
    memset(k, 0, size);
    const status made = mpm_law_make(&body, &scene, &k->law);
    k->form = law_form_of(&k->law, k->law.kernel);
    k->T = temperature;
    k->T_star = homologous(&k->law, vd_set(temperature))[0];
    k->mu = k->law.rho_start * k->law.volume0 - 1, k->e = k->law.e_start;
    if (made.code != STATUS_OK) free(k), *out = NULL;
    return made;
}

void mpm_point_law_free(mpm_point_law *k)
{
    free(k);
}

static double fast(const mpm_point_law *k, const mpm_law_point *at)
{
    return at->rate * k->law.inv_rate0;
}

double mpm_point_law_flow(const mpm_point_law *k, const mpm_law_point *at)
{
    const flow_state s = { .strain = vd_set(at->strain),
                           .log_rate = vd_set(log(fmax(fast(k, at), 1))),
                           .T = vd_set(k->T),
                           .T_star = vd_set(k->T_star),
                           .rho = vd_set(k->law.rho_start) };
    return flow_stress(&k->law, k->form, &s)[0] * (1 - k->law.softening * at->damage);
}

double mpm_point_law_damage(const mpm_point_law *k, const mpm_law_point *at, double plastic)
{
    const failure_state s = { .plastic = vd_set(plastic),
                              .strain = vd_set(at->strain),
                              .triaxiality = vd_set(at->triaxiality),
                              .rate_square = vd_set(fast(k, at) * fast(k, at)),
                              .log_rate = vd_set(log(fmax(fast(k, at), 1))),
                              .T_star = vd_set(k->T_star) };
    return damage_growth(&k->law, &s)[0];
}

double mpm_point_law_shear(const mpm_point_law *k)
{
    return k->law.G;
}

/* How far the pressure at a compression is above one, at the temperature that stays [Pa] */
static double pressure_over(const mpm_point_law *k, double mu, double pressure_wanted)
{
    const law *l = &k->law;
    const vd at = vd_set(mu), rest = reference_energy(l, k->form, vd_set(k->mu));
    const vd e = k->e - rest + reference_energy(l, k->form, at);
    return pressure(l, k->form, at, vd_set(l->rho0 * (1 + mu)), e, vd_set(0))[0] - pressure_wanted;
}

/* Simple iteration with the slope at rest; bisection where that does not converge, beyond twice the stiffness at rest.
 */
double mpm_point_law_compression(const mpm_point_law *k, double at_pressure)
{
    enum { ITERATIONS = 100 };
    const law *l = &k->law;
    double mu = k->mu, off = INFINITY;
    for (int i = 0; i < ITERATIONS && fabs(off) > 1e-13 * l->K0; i++) {
        off = pressure_over(k, mu, at_pressure);
        mu = fmin(fmax(mu - off / l->K0, l->mu_least), l->mu_most);
    }
    double lo = l->mu_least, hi = l->mu_most;
    for (int i = 0; i < ITERATIONS && !(fabs(off) < 1e-9 * l->K0); i++) {
        mu = 0.5 * (lo + hi);
        off = pressure_over(k, mu, at_pressure);
        *(off > 0 ? &hi : &lo) = mu;
    }
    return fabs(off) < 1e-6 * l->K0 ? (1 + mu) / (1 + k->mu) : NAN;
}
