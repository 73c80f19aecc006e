/* SPDX-License-Identifier: BSD-3-Clause */
/*   sigma_y = (A + B min(e, e_h)^n) (1 + C ln max(edot/edot0, 1)) (1 - T*^m)        (M-1) [Pa]; zero when molten
 * e_h, where it is given, ends the hardening: beyond the strains of the tests the power law is an extrapolation.
 * Johnson and Cook, 7th International Symposium on Ballistics (1983) 541. */
STRENGTH(johnson_cook, FIXED, "Johnson-Cook (M-1)")
CONSTANT(yield_A, "Pa", REQUIRED, 0.0, 1e10, "Johnson-Cook A: yield stress")
CONSTANT(hardening_B, "Pa", REQUIRED, 0.0, 1e10, "Johnson-Cook B: hardening")
CONSTANT(hardening_n, "1", REQUIRED, 0.0, 2.0, "Johnson-Cook n: hardening exponent")
CONSTANT(rate_C, "1", REQUIRED, 0.0, 1.0, "Johnson-Cook C: rate sensitivity")
CONSTANT(softening_m, "1", REQUIRED, 0.0, 10.0, "Johnson-Cook m: thermal softening exponent")
CONSTANT(hardening_strain, "1", OPTIONAL, 0.0, 100.0,
         "Johnson-Cook: plastic strain beyond which it hardens no more; not given: it always does")
NEEDS(rate_0)
NEEDS(youngs_modulus)
NEEDS(poisson)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    double A, B, n, C, m, most;
} strength_johnson_cook;
#endif

#ifdef LAW_DERIVE
static status strength_johnson_cook_derive(law *k, const mpm_material *m, double scale)
{
    const double most = isnan(m->hardening_strain) ? HUGE_VAL : m->hardening_strain;
    k->strength.johnson_cook = (strength_johnson_cook){ .A = scale * m->yield_A,
                                                        .B = scale * m->hardening_B,
                                                        .n = m->hardening_n,
                                                        .C = m->rate_C,
                                                        .m = m->softening_m,
                                                        .most = most };
    const double strain = fmin(k->cold_work, most), worked = strain > 0 ? pow(strain, m->hardening_n) : 0;
    k->flow_start = scale * (m->yield_A + m->hardening_B * worked);
    k->least_flow = m->softening_m >= 1 ? k->flow_start : 0;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd strength_johnson_cook_flow(const strength_johnson_cook *k, const flow_state *s)
{
    const vd strain = vd_min(s->strain, vd_set(k->most));
    return (k->A + k->B * power(strain, k->n)) * (1 + k->C * s->log_rate) * (1 - power(s->T_star, k->m));
}
#endif
