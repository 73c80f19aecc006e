#include "mpm/law.h"

#include <math.h>
#include <string.h>

/* Pressure on the Hugoniot part of (M-3), without the energy term [Pa] */
static double cold_pressure(const law *k, double mu)
{
    if (mu < 0) return k->K0 * mu;
    const double d = 1 - k->s1 * mu;
    return k->K0 * mu * (1 + (1 - 0.5 * k->g) * mu) / (d * d);
}

/*   de/dmu = [p_H(mu) + g0 rho0 e] / (rho0 (1 + mu)^2)                              the isentrope through T = 0, (M-4) */
static double cold_slope(const law *k, double mu, double e)
{
    return (cold_pressure(k, mu) + k->g * k->rho0 * e) / (k->rho0 * (1 + mu) * (1 + mu));
}

static double cold_step(const law *k, double mu, double e, double d)
{
    const double k1 = cold_slope(k, mu, e);
    const double k2 = cold_slope(k, mu + d / 2, e + d / 2 * k1);
    const double k3 = cold_slope(k, mu + d / 2, e + d / 2 * k2);
    const double k4 = cold_slope(k, mu + d, e + d * k3);
    return e + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/* Gauss elimination with pivoting of a 5 x 6 system; the unknowns go to x. */
static void solve5(double a[5][6], double x[5])
{
    for (int c = 0; c < 5; c++) {
        int pivot = c;
        for (int r = c + 1; r < 5; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        for (int q = 0; q < 6; q++) {
            const double t = a[c][q];
            a[c][q] = a[pivot][q];
            a[pivot][q] = t;
        }
        for (int r = c + 1; r < 5; r++) {
            const double f = a[r][c] / a[c][c];
            for (int q = c; q < 6; q++) a[r][q] -= f * a[c][q];
        }
    }
    for (int r = 4; r >= 0; r--) {
        x[r] = a[r][5];
        for (int q = r + 1; q < 5; q++) x[r] -= a[r][q] * x[q];
        x[r] /= a[r][r];
    }
}

/* Least squares of e_cold / mu^2 by a quartic over 0 .. 0.6 in compression (0.3 of the pole at most 0.7 / s1);
 * in expansion the same polynomial serves: e_cold there is below c0^2 mu^2 / 2 and small. */
static void fit_cold(law *k)
{
    enum { STEPS = 600 };
    const double mu_end = fmin(0.6, 0.7 / fmax(k->s1, 0.01)), d = mu_end / STEPS;
    double a[5][6];
    memset(a, 0, sizeof a);
    double e = 0;
    for (int i = 1; i <= STEPS; i++) {
        e = cold_step(k, (i - 1) * d, e, d);
        const double mu = i * d, y = e / (mu * mu);
        double basis[5] = { 1, mu, mu * mu, mu * mu * mu, mu * mu * mu * mu };
        for (int r = 0; r < 5; r++) {
            for (int c = 0; c < 5; c++) a[r][c] += basis[r] * basis[c];
            a[r][5] += basis[r] * y;
        }
    }
    solve5(a, k->cold);
}

static double or_zero(double value)
{
    return isnan(value) ? 0 : value;
}

static void thermal(law *k, const material *m, const mpm_body *body)
{
    k->c_v = m->specific_heat;
    k->inv_c = 1 / m->specific_heat;
    k->latent = or_zero(m->latent_heat);
    k->T_r = isnan(m->reference_temperature) ? 293 : m->reference_temperature;
    const bool cold_metal = isnan(m->melting_temperature);
    k->T_m = cold_metal ? 1e9 : m->melting_temperature;
    k->inv_T_range = 1 / (k->T_m - k->T_r);
    /* vapour: beyond five times the melting temperature the law is void (copper and aluminium boil at two to three
     * times); dust: failed or molten and four times as thin as the solid */
    k->e_vapour = cold_metal ? HUGE_VAL : k->c_v * (5 * k->T_m - k->T_r) + k->latent;
    k->rho_dust = 0.25 * k->rho0;
    k->e_start = k->c_v * (body->temperature - k->T_r);
    k->rho_start = k->rho0 * (1 - k->g * k->rho0 * k->e_start / k->K0);
}

static void strength(law *k, const material *m, const mpm_body *body)
{
    const double scale = body->yield_scale > 0 ? body->yield_scale : 1;
    k->A = scale * m->yield_A;
    k->B = scale * or_zero(m->hardening_B);
    k->n = isnan(m->hardening_n) ? 1 : m->hardening_n;
    k->C = or_zero(m->rate_C);
    k->m = isnan(m->softening_m) ? 1 : m->softening_m;
    k->inv_rate0 = 1 / (isnan(m->rate_0) ? 1 : m->rate_0);
    k->flow_start = k->A;
    k->D1 = -1;
    if (body->damage) {
        k->D1 = m->damage_D1, k->D2 = m->damage_D2, k->D3 = m->damage_D3;
        k->D4 = m->damage_D4, k->D5 = m->damage_D5;
    }
}

status law_make(const mpm_body *body, const mpm_scene *scene, law *out)
{
    const material *m = body->material;
    CHECK(m, STATUS_BAD_INPUT, "body `%s` has no material", body->name);
    TRY(material_check(m, MATERIAL_FOR_SCENE | (body->damage ? MATERIAL_FOR_DAMAGE : 0u)));
    law k = { .rho0 = m->density, .c0 = m->sound_speed, .g = m->gruneisen, .s1 = m->hugoniot_slope - 1 };
    k.K0 = k.rho0 * k.c0 * k.c0;
    k.K_slope = 4 * m->hugoniot_slope - 1;
    k.G = m->youngs_modulus / (2 * (1 + m->poisson));
    k.rho_min = 0.05 * k.rho0;
    k.rho_max = k.rho0 * (1 + fmin(1.5, 0.8 / fmax(k.s1, 0.01)));
    k.q1 = scene->viscosity_linear, k.q2 = scene->viscosity_quadratic;
    k.plastic_heat = scene->heat_by_plastic_work;
    k.chi = isnan(m->taylor_quinney) ? 0.9 : m->taylor_quinney;
    thermal(&k, m, body);
    strength(&k, m, body);
    fit_cold(&k);
    *out = k;
    return status_ok();
}
