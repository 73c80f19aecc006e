/* SPDX-License-Identifier: BSD-3-Clause */
/* Tait's equation for liquids, without the energy:  p = B [(rho/rho0)^n - 1],   B = rho0 c0^2/n,   g = 0, T_s = T_r.
 *   e_s = B/rho0 [(x^(n-1) - 1)/(n - 1) + 1/x - 1],   x = rho/rho0 */
EOS(tait, "Tait: p = rho0 c0^2/n [(rho/rho0)^n - 1]")
CONSTANT(tait_exponent, "1", REQUIRED, 1.01, 20.0, "Tait's n")
NEEDS(sound_speed)

#ifdef LAW_STRUCT
typedef struct {
    double n, B; /* [1, Pa] */
} eos_tait;
#endif

#ifdef LAW_DERIVE
static double eos_tait_pressure_at(const law *k, double mu, double e)
{
    (void)e;
    return k->eos.tait.B * (pow(1 + mu, k->eos.tait.n) - 1);
}

static double eos_tait_reference_at(const law *k, double mu)
{
    const double x = 1 + mu, n = k->eos.tait.n;
    return k->eos.tait.B * k->volume0 * ((pow(x, n - 1) - 1) / (n - 1) + 1 / x - 1);
}

static status eos_tait_derive(law *k, const mpm_material *m)
{
    k->K0 = m->density * m->sound_speed * m->sound_speed;
    k->eos.tait = (eos_tait){ .n = m->tait_exponent, .B = k->K0 / m->tait_exponent };
    k->volume_min = 0.4 * k->volume0;
    k->mu_least = -0.5, k->mu_most = 1.5;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LAW_CALL vd eos_tait_pressure(const law *k, vd mu, vd rho, vd e, vd half)
{
    (void)rho, (void)e, (void)half;
    return k->eos.tait.B * (vd_exp(k->eos.tait.n * vd_log(1 + mu)) - 1);
}

LAW_CALL vd eos_tait_reference(const law *k, vd mu)
{
    const double n = k->eos.tait.n;
    const vd x = 1 + mu;
    return k->eos.tait.B * k->volume0 * ((vd_exp((n - 1) * vd_log(x)) - 1) * (1 / (n - 1)) + 1 / x - 1);
}

LAW_CALL vd eos_tait_wave(const law *k, vd volume, vd p, vd shear)
{
    return vd_max(k->K0 + k->eos.tait.n * p, vd_set(1e-3 * k->K0)) * volume + shear;
}
#endif
