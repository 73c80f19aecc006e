/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/law/law.h"

#include <math.h>
#include <string.h>

static double compression_at(const law *k, double thermal, double pressure, double *e);

#define LAW_DERIVE
#include "mpm/law/eos.def"
#include "mpm/law/failure.def"
#include "mpm/law/strength.def"
#undef LAW_DERIVE

static status derive_strength(law *k, const mpm_material *m, double scale)
{
#define STRENGTH(name, shear, text) \
    if (k->strength.kind == MPM_STRENGTH_##name) return strength_##name##_derive(k, m, scale);
#include "mpm/law/strength.def"
    return base_status_error(STATUS_BAD_INPUT, "material %.40s: no law of strength has number %d", m->name,
                             m->strength);
}

static status derive_eos(law *k, const mpm_material *m)
{
#define EOS(name, text) \
    if (k->eos.kind == MPM_EOS_##name) return eos_##name##_derive(k, m);
#include "mpm/law/eos.def"
    return base_status_error(STATUS_BAD_INPUT, "material %.40s: no equation of state has number %d", m->name, m->eos);
}

static status derive_failure(law *k, const mpm_material *m)
{
#define FAILURE(name, text) \
    if (k->failure.kind == MPM_FAILURE_##name) return failure_##name##_derive(k, m);
#include "mpm/law/failure.def"
    return base_status_error(STATUS_BAD_INPUT, "material %.40s: no law of failure has number %d", m->name, m->failure);
}

double mpm_law_pressure(const law *k, double mu, double e)
{
#define EOS(name, text) \
    if (k->eos.kind == MPM_EOS_##name) return eos_##name##_pressure_at(k, mu, e);
#include "mpm/law/eos.def"
    return NAN;
}

static double reference_at(const law *k, double mu)
{
#define EOS(name, text) \
    if (k->eos.kind == MPM_EOS_##name) return eos_##name##_reference_at(k, mu);
#include "mpm/law/eos.def"
    return NAN;
}

/* Along the isentrope K = K0 + (4 s - 1) p, so p = p0 + K0 [mu + (2 s - 1) mu^2 + b mu^3], and e = c0^2/2 mu^2 beside
 * the work of the pressure at rest.  Two points in compression, where every law bends, tell the bend from b. */
double mpm_law_slope(const law *k)
{
    const double mu = 1e-4, e = 0.5 * k->K0 / k->rho0 * mu * mu;
    const double rest = mpm_law_pressure(k, 0, 0),
                 work = rest / k->rho0; /* a gas's own less that of what is around it */
    const double once = (mpm_law_pressure(k, mu, e + work * (mu - mu * mu)) - rest) / (k->K0 * mu);
    const double twice = (mpm_law_pressure(k, 2 * mu, 4 * e + 2 * work * (mu - 2 * mu * mu)) - rest) / (2 * k->K0 * mu);
    return 0.5 * ((2 * (once - 1) - 0.5 * (twice - 1)) / mu + 1);
}

/* At the thermal energy that e has beside its reference [J/kg] */
static double pressure_at(const law *k, double mu, double thermal)
{
    return mpm_law_pressure(k, mu, thermal + reference_at(k, mu));
}

/* rho/rho0 - 1 and the energy *e at a thermal energy and a pressure: simple iteration with the slope K0. */
static double compression_at(const law *k, double thermal, double pressure, double *e)
{
    enum { ITERATIONS = 200 };
    double mu = 0;
    *e = thermal;
    for (int i = 0; i < ITERATIONS; i++) {
        mu = fmin(fmax(mu - (mpm_law_pressure(k, mu, *e) - pressure) / k->K0, k->mu_least), k->mu_most);
        *e = thermal + reference_at(k, mu);
    }
    /* Of a hot gas that does not converge: bisection. */
    double lo = k->mu_least, hi = k->mu_most;
    for (int i = 0; i < ITERATIONS && fabs(mpm_law_pressure(k, mu, *e) - pressure) > 1e-9 * k->K0; i++) {
        mu = 0.5 * (lo + hi);
        *e = thermal + reference_at(k, mu);
        *(mpm_law_pressure(k, mu, *e) > pressure ? &hi : &lo) = mu;
    }
    return mu;
}

/* Energy and density of the body at its temperature and pressure. */
static status start_at(law *k, const mpm_body *body)
{
    const double temperature = body->temperature, pressure = isnan(body->pressure) ? k->p_rest : body->pressure;
    const double thermal = k->c_v * (temperature - k->T_r) + (temperature > k->T_m ? k->latent : 0);
    const double mu = compression_at(k, thermal, pressure, &k->e_start);
    CHECK(isnan(body->pressure) || fabs(mpm_law_pressure(k, mu, k->e_start) - pressure) < 1e-6 * k->K0,
          STATUS_BAD_INPUT, "body `%s`: at %g K its equation of state has pressures of %.4g to %.4g Pa, not %.4g Pa",
          body->name, temperature, pressure_at(k, k->mu_least, thermal), pressure_at(k, k->mu_most, thermal), pressure);
    CHECK(k->strength.kind != MPM_STRENGTH_none || pressure >= k->strength.none.least_pressure, STATUS_BAD_INPUT,
          "body `%s`: a pressure of %.4g Pa at the start, but its fluid cavitates at %.4g Pa", body->name, pressure,
          k->strength.none.least_pressure);
    k->rho_start = k->rho0 * (1 + mu);
    k->p_start = pressure;
    return status_ok();
}

static void thermal(law *k, const mpm_material *m)
{
    k->c_v = m->specific_heat;
    k->inv_c = 1 / m->specific_heat;
    k->latent = isnan(m->latent_heat) ? 0 : m->latent_heat;
    k->T_r = m->reference_temperature;
    const bool never_melts = isnan(m->melting_temperature);
    k->T_m = never_melts ? 1e9 : m->melting_temperature;
    k->inv_T_range = 1 / (k->T_m - k->T_r);
    /* Limits of validity.  Five times the melting temperature (copper and aluminium boil at two to three times); of
     * what has none, such as a fluid, a temperature where molecules have come apart.  Dust: failed or molten, at a
     * quarter of the solid's density. */
    const double hottest = never_melts ? 2e4 : 5 * k->T_m; /* [K] */
    k->e_hottest = k->c_v * (hottest - k->T_r) + k->latent;
    k->rho_dust = 0.25 * k->rho0;
}

status mpm_law_make(const mpm_body *body, const mpm_scene *scene, law *out)
{
    CHECK(body->material, STATUS_BAD_INPUT, "body `%s` has no material", body->name);
    TRY(mpm_material_check(body->material, MPM_MATERIAL_FOR_SCENE | (body->damage ? MPM_MATERIAL_FOR_DAMAGE : 0u)));
    const mpm_material m = mpm_material_complete(body->material);
    law k = { .rho0 = m.density, .volume0 = 1 / m.density };
    k.strength.kind = m.strength, k.eos.kind = m.eos, k.shear = mpm_material_shear(&m);
    k.kernel = k.shear == MPM_SHEAR_NONE                                      ? LAW_FLUID
               : k.shear == MPM_SHEAR_FIXED && m.eos == MPM_EOS_mie_gruneisen ? LAW_METAL
                                                                              : LAW_SOLID;
    k.failure.kind = body->damage && k.shear != MPM_SHEAR_NONE ? m.failure : MPM_FAILURE_none;
    k.G = k.shear == MPM_SHEAR_FIXED ? mpm_material_shear_modulus(&m) : 0;
    k.spall = HUGE_VAL;
    k.volume_max = 20 * k.volume0;
    k.surroundings = scene->surroundings;
    k.q1 = scene->viscosity_linear, k.q2 = scene->viscosity_quadratic;
    k.plastic_heat = scene->heat_by_plastic_work;
    k.chi = isnan(m.taylor_quinney) ? 0.9 : m.taylor_quinney;
    const double given = isnan(body->cold_work) ? m.cold_work : body->cold_work;
    k.cold_work = isnan(given) ? 0 : given;
    k.inv_rate0 = 1 / (isnan(m.rate_0) ? 1 : m.rate_0);
    thermal(&k, &m);
    TRY(derive_eos(&k, &m));
    TRY(derive_strength(&k, &m, body->yield_scale > 0 ? body->yield_scale : 1));
    TRY(derive_failure(&k, &m));
    k.least_flow *= 1 - k.softening;
    k.sound = sqrt((k.K0 + 4.0 / 3.0 * mpm_law_shear(&k)) / k.rho0);
    TRY(start_at(&k, body));
    *out = k;
    return status_ok();
}
