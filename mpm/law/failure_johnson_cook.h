/* SPDX-License-Identifier: BSD-3-Clause */
/*   dD = D_c de/(e_f - e_th) of what strains beyond e_th, none where s* lies below s_c; failed at D_c;          (M-2)
 *   e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln max(r, 1)) (1 + r)^q (1 + D5 T*),   r = edot/edot0
 *   e_f at most e_c max(1, exp(-|D3| (s* + 1/3))) where e_c, the fracture strain of a compressed cylinder, is given
 * s* = mean stress / von Mises stress, tension positive, capped at 1.5; e_f - e_th floored at 0.01.  The flow stress is
 * multiplied by 1 - w D.  A point keeps D/D_c, which is 1 when it fails.  Where e_th, q, w and s_c are not given it is
 * the law of Johnson and Cook, Engineering Fracture Mechanics 21 (1985) 31.  Tension beyond a spall strength that is
 * given fails a point at once. */
FAILURE(johnson_cook, "Johnson-Cook (M-2)")
CONSTANT(damage_D1, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D1")
CONSTANT(damage_D2, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D2")
CONSTANT(damage_D3, "1", REQUIRED, -20.0, 20.0,
         "Johnson-Cook failure D3, times mean stress / von Mises stress, tension positive")
CONSTANT(damage_D4, "1", REQUIRED, -1.0, 10.0, "Johnson-Cook failure D4: strain rate")
CONSTANT(damage_D5, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D5: temperature")
CONSTANT(damage_threshold, "1", 0.0, 0.0, 10.0, "plastic strain e_th at which damage begins; not given: 0")
CONSTANT(damage_critical, "1", 1.0, 1e-3, 1.0, "damage D_c at which it fails; not given: 1")
CONSTANT(damage_softening, "1", 0.0, 0.0, 1.0, "w in the factor 1 - w D on the flow stress; not given: 0")
CONSTANT(damage_rate_power, "1", 0.0, -2.0, 2.0, "q in the rate factor (1 + edot/edot0)^q; not given: 0")
CONSTANT(damage_cutoff, "1", OPTIONAL, -10.0, 1.5,
         "mean stress / von Mises stress below which there is no damage; not given: none")
CONSTANT(damage_compression, "1", OPTIONAL, 1e-3, 100.0,
         "fracture strain in uniaxial compression, an upper limit of that of the formula; not given: none")
NEEDS(rate_0)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    double D1, D2, D3, D4, D5, threshold, rate_power, cutoff, compression;
} failure_johnson_cook;
#endif

#ifdef LAW_DERIVE
static status failure_johnson_cook_derive(law *k, const mpm_material *m)
{
    k->failure.johnson_cook =
        (failure_johnson_cook){ .D1 = m->damage_D1,
                                .D2 = m->damage_D2,
                                .D3 = m->damage_D3,
                                .D4 = m->damage_D4,
                                .D5 = m->damage_D5,
                                .threshold = m->damage_threshold,
                                .rate_power = m->damage_rate_power,
                                .cutoff = isnan(m->damage_cutoff) ? -HUGE_VAL : m->damage_cutoff,
                                .compression = isnan(m->damage_compression) ? HUGE_VAL : m->damage_compression };
    k->softening = m->damage_softening * m->damage_critical;
    if (!isnan(m->spall_strength)) k->spall = m->spall_strength;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd failure_johnson_cook_grow(const failure_johnson_cook *k, const failure_state *s)
{
    const vd x = vd_max(vd_min(s->triaxiality, vd_set(1.5)), vd_set(-5)), zero = vd_set(0);
    vd f = (k->D1 + k->D2 * vd_exp(k->D3 * x)) * (1 + k->D4 * s->log_rate) * (1 + k->D5 * s->T_star);
    if (k->rate_power != 0) f *= vd_exp(k->rate_power * vd_log(1 + vd_sqrt(s->rate_square)));
    if (k->compression < HUGE_VAL) f = vd_min(f, k->compression * vd_exp(-fabs(k->D3) * vd_min(x + 1.0 / 3.0, zero)));
    const vd beyond = vd_min(s->plastic, vd_max(s->strain - k->threshold, zero));
    const vd growth = beyond / vd_max(f - k->threshold, vd_set(0.01));
    return vd_where(~vd_less(s->triaxiality, vd_set(k->cutoff)), growth);
}
#endif
