/* SPDX-License-Identifier: BSD-3-Clause */
/* Steinberg, Cochran, Guinan, J. Appl. Phys. 51 (1980) 1498:                                               (M-24)
 *   G = G0 [1 + A p/eta^(1/3) - B (T - 300 K)],   eta = rho/rho0
 *   sigma_y = min(Y0 [1 + beta (e + e_0)]^n, Y_max) G/G0  [Pa]
 *   zero beyond T_m0 f(eta),   f = exp[2 a (1 - 1/eta)] eta^(2 (g0 - a - 1/3)),   T_m0 at most T_m/f(eta_m)
 * with eta_m where the metal has its melting temperature T_m without pressure: so a melt without pressure, or in
 * tension, has no strength, whatever T_m0 is, and under pressure the metal melts at more than T_m, as the law says.
 * Without a rate: meant for more than 1e5/s.  G is at least 5 % of G0, so that plastic strain stays finite; a melt has
 * no deviator because sigma_y = 0. */
STRENGTH(steinberg_guinan, VARIES, "Steinberg-Guinan (M-24)")
CONSTANT(sg_G0, "Pa", REQUIRED, 1e6, 1e12, "Steinberg-Guinan shear modulus at 300 K without pressure")
CONSTANT(sg_A, "1/Pa", REQUIRED, 0.0, 1e-8, "Steinberg-Guinan A: growth of the shear modulus with pressure")
CONSTANT(sg_B, "1/K", REQUIRED, 0.0, 1e-2, "Steinberg-Guinan B: fall of the shear modulus with temperature")
CONSTANT(sg_Y0, "Pa", REQUIRED, 1e5, 1e11, "Steinberg-Guinan Y0: yield stress")
CONSTANT(sg_Y_max, "Pa", REQUIRED, 1e5, 1e11, "Steinberg-Guinan Y_max: largest stress that hardening leads to")
CONSTANT(sg_beta, "1", REQUIRED, 0.0, 1e5, "Steinberg-Guinan beta: hardening")
CONSTANT(sg_n, "1", REQUIRED, 0.0, 2.0, "Steinberg-Guinan n: hardening exponent")
CONSTANT(sg_strain, "1", 0.0, 0.0, 100.0, "Steinberg-Guinan: plastic strain the metal has had before; not given: none")
CONSTANT(sg_T_m0, "K", REQUIRED, 200.0, 1e4, "Steinberg-Guinan melting temperature at the reference density")
CONSTANT(sg_a, "1", REQUIRED, 0.0, 10.0, "Steinberg-Guinan a: change of the melting temperature with density")
CONSTANT(sg_g0, "1", REQUIRED, 0.0, 10.0, "Steinberg-Guinan g0: Grueneisen coefficient of the melting temperature")
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    double G0, A, B, Y0, Y_max, beta, n, strain, T_m0, a, eta_power, inv_rho0;
} strength_steinberg_guinan;

static const double STEINBERG_GUINAN_T = 300, STEINBERG_GUINAN_SOFTEST = 0.05;
#endif

#ifdef LAW_DERIVE
static status strength_steinberg_guinan_derive(law *k, const mpm_material *m, double scale)
{
    const double eta_power = 2 * (m->sg_g0 - m->sg_a - 1.0 / 3.0);
    double e; /* as it begins to melt */
    const double eta_m = 1 + compression_at(k, k->c_v * (k->T_m - k->T_r), 0, &e);
    const double through = k->T_m / (exp(2 * m->sg_a * (1 - 1 / eta_m)) * pow(eta_m, eta_power));
    k->strength.steinberg_guinan = (strength_steinberg_guinan){ .G0 = m->sg_G0,
                                                                .A = m->sg_A,
                                                                .B = m->sg_B,
                                                                .Y0 = scale * m->sg_Y0,
                                                                .Y_max = scale * m->sg_Y_max,
                                                                .beta = m->sg_beta,
                                                                .n = m->sg_n,
                                                                .strain = m->sg_strain,
                                                                .T_m0 = fmin(m->sg_T_m0, through),
                                                                .a = m->sg_a,
                                                                .eta_power = eta_power,
                                                                .inv_rho0 = 1 / m->density };
    const double soft = fmax(1 - m->sg_B * (k->T_r - STEINBERG_GUINAN_T), STEINBERG_GUINAN_SOFTEST);
    k->G = m->sg_G0 * soft;
    const double strain = m->sg_strain + k->cold_work;
    k->flow_start = scale * fmin(m->sg_Y0 * pow(1 + m->sg_beta * strain, m->sg_n), m->sg_Y_max) * soft;
    return status_ok();
}
#endif

#ifdef LAW_LANES
/* G/G0 */
LANE_INLINE vd steinberg_guinan_soft(const strength_steinberg_guinan *k, vd p, vd T, vd log_eta)
{
    const vd soft = 1 + k->A * p * vd_exp(log_eta * (-1.0 / 3.0)) - k->B * (T - STEINBERG_GUINAN_T);
    return vd_max(soft, vd_set(STEINBERG_GUINAN_SOFTEST));
}

LANE_INLINE vd strength_steinberg_guinan_shear(const strength_steinberg_guinan *k, vd p, vd rho, vd T)
{
    return k->G0 * steinberg_guinan_soft(k, p, T, vd_log(rho * k->inv_rho0));
}

LAW_CALL vd strength_steinberg_guinan_flow(const strength_steinberg_guinan *k, const flow_state *s)
{
    const vd eta = s->rho * k->inv_rho0, log_eta = vd_log(eta);
    const vd hard = k->Y0 * vd_exp(k->n * vd_log(1 + k->beta * (s->strain + k->strain)));
    const vd melting = k->T_m0 * vd_exp(2 * k->a * (1 - 1 / eta) + k->eta_power * log_eta);
    const vd soft = steinberg_guinan_soft(k, s->p, s->T, log_eta);
    return vd_where(vd_less(s->T, melting), vd_min(hard, vd_set(k->Y_max)) * soft);
}
#endif
