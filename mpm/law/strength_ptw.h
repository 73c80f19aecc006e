/* SPDX-License-Identifier: BSD-3-Clause */
/* Preston, Tonks, Wallace, J. Appl. Phys. 93 (2003) 211, at the density of rest:                          (M-23)
 *   sigma_y = 2 G0 (1 - alpha T^) {s + r ln[1 - (1 - 1/D) exp(-theta (e + e_0)/(r (D - 1)))]}  [Pa], zero when molten;
 *   T^ = T/T_m,   x = ln(edot/(gamma xi(T))),   f = erf(-kappa T^ x),   r = (s0 - y)/p,   D = exp((s - y)/r),
 *   s = max(s0 - (s0 - s_inf) f, s0 exp(beta x)),   y = max(y0 - (y0 - y_inf) f, min(y1 exp(y2 x), s0 exp(beta x))).
 * y is the stress at which hardening begins, s the one at which it saturates; sigma_y = s where y >= s. */
STRENGTH(ptw, FIXED, "Preston-Tonks-Wallace (M-23)")
CONSTANT(ptw_theta, "1", REQUIRED, 0.0, 10.0, "Preston-Tonks-Wallace theta: first rate of hardening")
CONSTANT(ptw_p, "1", REQUIRED, 0.0, 20.0, "Preston-Tonks-Wallace p: hardening")
CONSTANT(ptw_s0, "1", REQUIRED, 1e-6, 1.0, "Preston-Tonks-Wallace s0: saturation stress at T = 0")
CONSTANT(ptw_s_inf, "1", REQUIRED, 0.0, 1.0, "Preston-Tonks-Wallace s_inf: saturation stress when hot")
CONSTANT(ptw_kappa, "1", REQUIRED, 0.0, 10.0, "Preston-Tonks-Wallace kappa: dependence on temperature")
CONSTANT(ptw_gamma, "1", REQUIRED, 1e-9, 1.0, "Preston-Tonks-Wallace gamma: dependence on strain rate")
CONSTANT(ptw_y0, "1", REQUIRED, 0.0, 1.0, "Preston-Tonks-Wallace y0: yield stress at T = 0")
CONSTANT(ptw_y_inf, "1", REQUIRED, 0.0, 1.0, "Preston-Tonks-Wallace y_inf: yield stress when hot")
CONSTANT(ptw_y1, "1", REQUIRED, 0.0, 10.0, "Preston-Tonks-Wallace y1: yield stress at middling rates")
CONSTANT(ptw_y2, "1", REQUIRED, 0.0, 2.0, "Preston-Tonks-Wallace y2: its exponent")
CONSTANT(ptw_beta, "1", REQUIRED, 0.0, 1.0, "Preston-Tonks-Wallace beta: exponent of the overdriven regime")
CONSTANT(ptw_G0, "Pa", REQUIRED, 1e6, 1e12, "Preston-Tonks-Wallace shear modulus at T = 0")
CONSTANT(ptw_alpha, "1", REQUIRED, 0.0, 0.95, "Preston-Tonks-Wallace alpha: fraction of that modulus lost at melting")
CONSTANT(ptw_cold_work, "1", 0.0, 0.0, 100.0,
         "Preston-Tonks-Wallace: plastic strain the metal has had before; not given: none")
NEEDS(molar_mass)
NEEDS(rate_0)
NEEDS(youngs_modulus)
NEEDS(poisson)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    double theta, inv_p, s0, s_fall, kappa, y0, y_fall, y1, y2, beta; /* s_fall = s0 - s_inf, y_fall = y0 - y_inf */
    double G2, alpha, inv_T_m;                                        /* 2 G0 x the body's yield_scale [Pa]; [1, 1/K] */
    double log_rate; /* ln(rate_0/(gamma xi)), xi the rate at T = 0 at which a shear wave crosses an atom */
    double cold_work;
} strength_ptw;
#endif

#ifdef LAW_DERIVE
/* The flow stress, for the bound below and the start only. */
static double strength_ptw_flow_at(const strength_ptw *k, double e, double log_rate, double T)
{
    const double T_hat = T * k->inv_T_m, soft = 1 - k->alpha * T_hat;
    const double x = log_rate + k->log_rate - 0.5 * log(soft), f = erf(-k->kappa * T_hat * x);
    const double driven = k->s0 * exp(k->beta * x), s = fmax(k->s0 - k->s_fall * f, driven);
    const double y = fmax(k->y0 - k->y_fall * f, fmin(k->y1 * exp(k->y2 * x), driven));
    const double room = (k->s0 - y) * k->inv_p;
    if (!(room > 1e-6 * k->s0) || !(s - y > 1e-6 * s)) return k->G2 * soft * s;
    const double D = exp(fmin((s - y) / room, 50));
    const double left = 1 - (1 - 1 / D) * exp(-k->theta * (e + k->cold_work) / (room * (D - 1)));
    return k->G2 * soft * (s + room * log(left > 0 ? left : 1 / D)); /* 0: rounding has lost 1/D */
}

/* Minimum of sigma_y/(1 - T*) over temperature, at the strain and the strain rate with the lowest flow stress. */
static double strength_ptw_least(const law *k)
{
    enum { STEPS = 200 };
    double least = HUGE_VAL;
    for (int i = 0; i < STEPS; i++) {
        const double T_star = (double)i / STEPS, T = k->T_r + T_star * (k->T_m - k->T_r);
        least = fmin(least, strength_ptw_flow_at(&k->strength.ptw, k->cold_work, 0, T) / (1 - T_star));
    }
    return least;
}

/*   xi = 1/2 (4 pi rho0/(3 M))^(1/3) sqrt(G0/rho0), M the mass of an atom                              (M-23) [1/s] */
static status strength_ptw_derive(law *k, const mpm_material *m, double scale)
{
    const double avogadro = 6.02214076e23, third = 1.0 / 3.0, four_pi = 16 * atan(1);
    const double atom = m->molar_mass / avogadro;
    const double xi = 0.5 * pow(four_pi * m->density / (3 * atom), third) * sqrt(m->ptw_G0 / m->density);
    k->strength.ptw = (strength_ptw){
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
        .cold_work = m->ptw_cold_work,
    };
    k->least_flow = strength_ptw_least(k);
    k->flow_start = strength_ptw_flow_at(&k->strength.ptw, k->cold_work, 0, k->T_r);
    return status_ok();
}
#endif

#ifdef LAW_LANES
/* Error function: Abramowitz and Stegun, Handbook of Mathematical Functions, 7.1.26; off by at most 1.5e-7. */
LANE_INLINE vd error_function(vd x)
{
    const vd a = vd_max(x, -x), t = 1 / (1 + 0.3275911 * a);
    const vd sum = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    const vd r = 1 - sum * vd_exp(-a * a);
    return vd_select(vd_less(x, vd_set(0)), -r, r);
}

LAW_CALL vd strength_ptw_flow(const strength_ptw *k, const flow_state *p)
{
    const vd one = vd_set(1), T_hat = p->T * k->inv_T_m, soft = vd_max(1 - k->alpha * T_hat, vd_set(0.01));
    const vd x = p->log_rate + k->log_rate - 0.5 * vd_log(soft), f = error_function(-k->kappa * T_hat * x);
    const vd driven = k->s0 * vd_exp(k->beta * x), s = vd_max(k->s0 - k->s_fall * f, driven);
    const vd y = vd_max(k->y0 - k->y_fall * f, vd_min(k->y1 * vd_exp(k->y2 * x), driven));
    const vd room = (k->s0 - y) * k->inv_p;
    const vm hardens = vd_less(vd_set(1e-6 * k->s0), room) & vd_less(1e-6 * s, s - y);
    const vd r = vd_select(hardens, room, one), D = vd_exp(vd_select(hardens, vd_min((s - y) / r, vd_set(50)), one));
    const vd left = 1 - (1 - 1 / D) * vd_exp(-k->theta * (p->strain + k->cold_work) / (r * (D - 1)));
    const vd known = vd_select(vd_less(vd_set(0), left), left, 1 / D); /* 0: rounding has lost 1/D */
    const vd stress = k->G2 * soft * (s + vd_where(hardens, r * vd_log(known)));
    return vd_where(vd_less(p->T_star, one), stress);
}
#endif
