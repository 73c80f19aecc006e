#include "mpm/law/law.h"

#include <math.h>
#include <string.h>

/* (M-3), with the energy e [Pa] */
static double pressure(const law *k, double mu, double e)
{
    if (mu < 0) return k->K0 * mu + k->g * k->rho0 * (1 + mu) * e;
    const double d = 1 - k->s1 * mu;
    return k->K0 * mu * (1 + (1 - 0.5 * k->g) * mu) / (d * d) + k->g * k->rho0 * e;
}

/* ---- the isentrope through rest at T_r (M-4) ---- */

/*   de/dmu = p(mu, e) / (rho0 (1 + mu)^2) */
static double isentrope_slope(const law *k, double mu, double e)
{
    return pressure(k, mu, e) / (k->rho0 * (1 + mu) * (1 + mu));
}

static double isentrope_step(const law *k, double mu, double e, double d)
{
    const double k1 = isentrope_slope(k, mu, e);
    const double k2 = isentrope_slope(k, mu + d / 2, e + d / 2 * k1);
    const double k3 = isentrope_slope(k, mu + d / 2, e + d / 2 * k2);
    const double k4 = isentrope_slope(k, mu + d, e + d * k3);
    return e + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

/*   dT/T = g d rho/rho, and the pressure law has g rho = g0 rho0 in compression, g = g0 in expansion:
 *   T_s = T_r exp(g0 mu/(1 + mu)),   T_s = T_r (1 + mu)^g0                                                  */
static double isentrope_temperature(const law *k, double mu)
{
    return k->T_r * (mu > 0 ? exp(k->g * mu / (1 + mu)) : pow(1 + mu, k->g));
}

/* Gauss elimination with pivoting; the unknowns go to x. */
static void solve(double a[LAW_COLD][LAW_COLD + 1], double x[LAW_COLD])
{
    for (int c = 0; c < LAW_COLD; c++) {
        int pivot = c;
        for (int r = c + 1; r < LAW_COLD; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        for (int q = 0; q <= LAW_COLD; q++) {
            const double t = a[c][q];
            a[c][q] = a[pivot][q];
            a[pivot][q] = t;
        }
        for (int r = c + 1; r < LAW_COLD; r++) {
            const double f = a[r][c] / a[c][c];
            for (int q = c; q <= LAW_COLD; q++) a[r][q] -= f * a[c][q];
        }
    }
    for (int r = LAW_COLD - 1; r >= 0; r--) {
        x[r] = a[r][LAW_COLD];
        for (int q = r + 1; q < LAW_COLD; q++) x[r] -= a[r][q] * x[q];
        x[r] /= a[r][r];
    }
}

/* Least squares of e_r = e_s - c_v (T_s - T_r) = mu (c0 + c1 mu + ..) from rest to mu_end. */
static void fit_reference(const law *k, double mu_end, double out[LAW_COLD])
{
    enum { STEPS = 600 };
    const double d = mu_end / STEPS;
    double a[LAW_COLD][LAW_COLD + 1], e = 0;
    memset(a, 0, sizeof a);
    for (int i = 1; i <= STEPS; i++) {
        const double mu = i * d;
        double basis[LAW_COLD] = { mu / mu_end }; /* of order one, or the system is badly conditioned */
        for (int r = 1; r < LAW_COLD; r++) basis[r] = basis[r - 1] * mu / mu_end;
        e = isentrope_step(k, (i - 1) * d, e, d);
        const double y = e - k->c_v * (isentrope_temperature(k, mu) - k->T_r);
        for (int r = 0; r < LAW_COLD; r++) {
            for (int c = 0; c < LAW_COLD; c++) a[r][c] += basis[r] * basis[c];
            a[r][LAW_COLD] += basis[r] * y;
        }
    }
    solve(a, out);
    for (int r = 0; r < LAW_COLD; r++) out[r] /= pow(mu_end, r + 1);
}

static double reference_energy(const law *k, double mu)
{
    const double *c = mu < 0 ? k->stretched : k->squeezed;
    double sum = 0;
    for (int i = LAW_COLD - 1; i >= 0; i--) sum = c[i] + mu * sum;
    return mu * sum;
}

/* Energy and density at which the temperature is the body's and the pressure zero. */
static void start_at(law *k, double temperature)
{
    enum { ITERATIONS = 200 };
    const double thermal = k->c_v * (temperature - k->T_r) + (temperature > k->T_m ? k->latent : 0);
    double mu = 0;
    k->e_start = thermal;
    for (int i = 0; i < ITERATIONS; i++) {
        mu = fmin(fmax(mu - pressure(k, mu, k->e_start) / k->K0, k->mu_least), k->mu_most);
        k->e_start = thermal + reference_energy(k, mu);
    }
    k->rho_start = k->rho0 * (1 + mu);
}

static double or_zero(double value)
{
    return isnan(value) ? 0 : value;
}

static void thermal(law *k, const material *m)
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
}

/* (M-23), see mpm/law/law_lanes.h; here for the bound below and the start only. */
static double ptw_flow(const ptw *k, double e, double log_rate, double T)
{
    const double T_hat = T * k->inv_T_m, soft = 1 - k->alpha * T_hat;
    const double x = log_rate + k->log_rate - 0.5 * log(soft), f = erf(-k->kappa * T_hat * x);
    const double driven = k->s0 * exp(k->beta * x), s = fmax(k->s0 - k->s_fall * f, driven);
    const double y = fmax(k->y0 - k->y_fall * f, fmin(k->y1 * exp(k->y2 * x), driven));
    const double room = (k->s0 - y) * k->inv_p;
    if (!(room > 1e-6 * k->s0) || !(s - y > 1e-6 * s)) return k->G2 * soft * s;
    const double D = exp(fmin((s - y) / room, 50));
    return k->G2 * soft * (s + room * log(1 - (1 - 1 / D) * exp(-k->theta * (e + k->cold_work) / (room * (D - 1)))));
}

/* Least of sigma_y/(1 - T*) over temperature, at the strain and the rate at which a metal is weakest. */
static double ptw_least(const law *k)
{
    enum { STEPS = 200 };
    double least = HUGE_VAL;
    for (int i = 0; i < STEPS; i++) {
        const double T_star = (double)i / STEPS, T = k->T_r + T_star * (k->T_m - k->T_r);
        least = fmin(least, ptw_flow(&k->ptw, 0, 0, T) / (1 - T_star));
    }
    return least;
}

/*   xi = 1/2 (4 pi rho0/(3 M))^(1/3) sqrt(G0/rho0), M the mass of an atom                              (M-23) [1/s] */
static void strength_ptw(law *k, const material *m, double scale)
{
    const double avogadro = 6.02214076e23, third = 1.0 / 3.0, four_pi = 16 * atan(1);
    const double atom = m->molar_mass / avogadro;
    const double xi = 0.5 * pow(four_pi * m->density / (3 * atom), third) * sqrt(m->ptw_G0 / m->density);
    k->is_ptw = true;
    k->ptw = (ptw){
        .theta = m->ptw_theta,
        .inv_p = 1 / fmax(m->ptw_p, 1e-4), /* p = 0: the limit, to 1e-4 */
        .s0 = m->ptw_s0,
        .s_fall = m->ptw_s0 - m->ptw_s_inf,
        .kappa = m->ptw_kappa,
        .y0 = m->ptw_y0,
        .y_fall = m->ptw_y0 - m->ptw_y_inf,
        .y1 = m->ptw_y1,
        .y2 = m->ptw_y2,
        .beta = m->ptw_beta,
        .G2 = 2 * scale * m->ptw_G0,
        .alpha = m->ptw_alpha,
        .inv_T_m = 1 / k->T_m,
        .log_rate = -log(m->ptw_gamma * xi * k->inv_rate0),
        .cold_work = or_zero(m->ptw_cold_work),
    };
    k->least_flow = ptw_least(k);
    k->flow_start = ptw_flow(&k->ptw, 0, 0, k->T_r);
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
    k->least_flow = k->B >= 0 && k->C >= 0 && k->m >= 1 ? k->A : 0;
    if (m->strength == STRENGTH_PTW) strength_ptw(k, m, scale);
    k->D1 = -1;
    if (body->damage) {
        k->D1 = m->damage_D1, k->D2 = m->damage_D2, k->D3 = m->damage_D3;
        k->D4 = m->damage_D4, k->D5 = m->damage_D5;
    }
}

status mpm_law_make(const mpm_body *body, const mpm_scene *scene, law *out)
{
    const material *m = body->material;
    CHECK(m, STATUS_BAD_INPUT, "body `%s` has no material", body->name);
    TRY(mpm_material_check(m, MATERIAL_FOR_SCENE | (body->damage ? MATERIAL_FOR_DAMAGE : 0u)));
    law k = { .rho0 = m->density, .c0 = m->sound_speed, .g = m->gruneisen, .s1 = m->hugoniot_slope - 1 };
    k.K0 = k.rho0 * k.c0 * k.c0;
    k.K_slope = 4 * m->hugoniot_slope - 1;
    k.G = m->youngs_modulus / (2 * (1 + m->poisson));
    k.volume0 = 1 / k.rho0;
    k.volume_max = 20 * k.volume0;
    k.volume_min = k.volume0 / (1 + fmin(1.5, 0.8 / fmax(k.s1, 0.01)));
    k.q1 = scene->viscosity_linear, k.q2 = scene->viscosity_quadratic;
    k.plastic_heat = scene->heat_by_plastic_work;
    k.chi = isnan(m->taylor_quinney) ? 0.9 : m->taylor_quinney;
    thermal(&k, m);
    strength(&k, m, body);
    k.mu_least = -0.5, k.mu_most = fmin(0.6, 0.7 / fmax(k.s1, 0.01));
    fit_reference(&k, k.mu_most, k.squeezed);
    fit_reference(&k, k.mu_least, k.stretched);
    start_at(&k, body->temperature);
    *out = k;
    return status_ok();
}
