/* SPDX-License-Identifier: BSD-3-Clause */
/* Mie-Grueneisen with the Hugoniot us = c0 + s up:
 *   p = rho0 c0^2 mu [1 + (1 - g0/2) mu] / [1 - (s-1) mu]^2 + g0 rho0 e for mu >= 0,                      (M-3)
 *   p = rho0 c0^2 mu + g0 rho e below.
 * With rho0 in the second line too, the thermal pressure of expanded hot debris would not fall with its density, and
 * the debris would fly apart.  So the Grueneisen coefficient is g0 rho0/rho in compression and g0 in expansion. */
EOS(mie_gruneisen, "Mie-Grueneisen with us = c0 + s up (M-3)")
CONSTANT(gruneisen, "1", REQUIRED, 0.0, 10.0, "Grueneisen coefficient at the reference density")
NEEDS(sound_speed)
NEEDS(hugoniot_slope)

#ifdef LAW_STRUCT
enum { EOS_TERMS = 6 };

typedef struct {
    double g, s1;                /* Grueneisen coefficient, s - 1 [1] */
    double K_slope;              /* dK/dp = 4 s - 1 [1] */
    double squeezed[EOS_TERMS];  /* reference energy mu (c0 + c1 mu + ..) in compression [J/kg] */
    double stretched[EOS_TERMS]; /* the same in expansion */
} eos_mie_gruneisen;
#endif

#ifdef LAW_DERIVE
static double eos_mie_gruneisen_pressure_at(const law *k, double mu, double e)
{
    const eos_mie_gruneisen *c = &k->eos.mie_gruneisen;
    if (mu < 0) return k->K0 * mu + c->g * k->rho0 * (1 + mu) * e;
    const double d = 1 - c->s1 * mu;
    return k->K0 * mu * (1 + (1 - 0.5 * c->g) * mu) / (d * d) + c->g * k->rho0 * e;
}

static double eos_mie_gruneisen_reference_at(const law *k, double mu)
{
    const double *c = mu < 0 ? k->eos.mie_gruneisen.stretched : k->eos.mie_gruneisen.squeezed;
    double sum = 0;
    for (int i = EOS_TERMS - 1; i >= 0; i--) sum = c[i] + mu * sum;
    return mu * sum;
}

/* ---- the isentrope through rest at T_r (M-4) ---- */

/*   de/dmu = p(mu, e) / (rho0 (1 + mu)^2) */
static double isentrope_slope(const law *k, double mu, double e)
{
    return eos_mie_gruneisen_pressure_at(k, mu, e) / (k->rho0 * (1 + mu) * (1 + mu));
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
    const double g = k->eos.mie_gruneisen.g;
    return k->T_r * (mu > 0 ? exp(g * mu / (1 + mu)) : pow(1 + mu, g));
}

/* Gauss elimination with pivoting; the unknowns go to x. */
static void solve(double a[EOS_TERMS][EOS_TERMS + 1], double x[EOS_TERMS])
{
    for (int c = 0; c < EOS_TERMS; c++) {
        int pivot = c;
        for (int r = c + 1; r < EOS_TERMS; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        for (int q = 0; q <= EOS_TERMS; q++) {
            const double t = a[c][q];
            a[c][q] = a[pivot][q];
            a[pivot][q] = t;
        }
        for (int r = c + 1; r < EOS_TERMS; r++) {
            const double f = a[r][c] / a[c][c];
            for (int q = c; q <= EOS_TERMS; q++) a[r][q] -= f * a[c][q];
        }
    }
    for (int r = EOS_TERMS - 1; r >= 0; r--) {
        x[r] = a[r][EOS_TERMS];
        for (int q = r + 1; q < EOS_TERMS; q++) x[r] -= a[r][q] * x[q];
        x[r] /= a[r][r];
    }
}

/* Least squares of e_s - c_v (T_s - T_r) = mu (c0 + c1 mu + ..) from rest to mu_end. */
static void fit_reference(const law *k, double mu_end, double out[EOS_TERMS])
{
    enum { STEPS = 600 };
    const double d = mu_end / STEPS;
    double a[EOS_TERMS][EOS_TERMS + 1], e = 0;
    memset(a, 0, sizeof a);
    for (int i = 1; i <= STEPS; i++) {
        const double mu = i * d;
        double basis[EOS_TERMS] = { mu / mu_end }; /* of order one, or the system is badly conditioned */
        for (int r = 1; r < EOS_TERMS; r++) basis[r] = basis[r - 1] * mu / mu_end;
        e = isentrope_step(k, (i - 1) * d, e, d);
        const double y = e - k->c_v * (isentrope_temperature(k, mu) - k->T_r);
        for (int r = 0; r < EOS_TERMS; r++) {
            for (int c = 0; c < EOS_TERMS; c++) a[r][c] += basis[r] * basis[c];
            a[r][EOS_TERMS] += basis[r] * y;
        }
    }
    solve(a, out);
    for (int r = 0; r < EOS_TERMS; r++) out[r] /= pow(mu_end, r + 1);
}

/* The density is limited below the pole at mu = 1/(s - 1); the fit ends further below it. */
static status eos_mie_gruneisen_derive(law *k, const mpm_material *m)
{
    eos_mie_gruneisen *c = &k->eos.mie_gruneisen;
    *c = (eos_mie_gruneisen){ .g = m->gruneisen, .s1 = m->hugoniot_slope - 1, .K_slope = 4 * m->hugoniot_slope - 1 };
    k->K0 = m->density * m->sound_speed * m->sound_speed;
    k->volume_min = k->volume0 / (1 + fmin(1.5, 0.8 / fmax(c->s1, 0.01)));
    k->mu_least = -0.5, k->mu_most = fmin(0.6, 0.7 / fmax(c->s1, 0.01));
    fit_reference(k, k->mu_most, c->squeezed);
    fit_reference(k, k->mu_least, c->stretched);
    return status_ok();
}
#endif

#ifdef LAW_LANES
/* In one division. */
LANE_INLINE vd eos_mie_gruneisen_pressure(const law *k, vd mu, vd rho, vd e, vd half)
{
    const eos_mie_gruneisen *c = &k->eos.mie_gruneisen;
    const vd d = 1 - c->s1 * mu, one = vd_set(1);
    const vm compressed = vd_less(vd_set(0), mu);
    const vd above = k->K0 * mu * vd_select(compressed, 1 + (1 - 0.5 * c->g) * mu, one);
    const vd below = vd_select(compressed, d * d, one), slope = c->g * vd_min(rho, vd_set(k->rho0));
    return (above + slope * e * below) / (below * (1 + slope * half));
}

LANE_INLINE vd eos_mie_gruneisen_reference(const law *k, vd mu)
{
    const eos_mie_gruneisen *c = &k->eos.mie_gruneisen;
    const vd zero = vd_set(0), x = vd_min(vd_max(mu, vd_set(k->mu_least)), vd_set(k->mu_most));
    const vm out = vd_less(x, zero);
    vd sum = zero;
    for (int i = EOS_TERMS - 1; i >= 0; i--)
        sum = vd_select(out, vd_set(c->stretched[i]), vd_set(c->squeezed[i])) + x * sum;
    return x * sum;
}

/* K = K0 + K' p in compression, c0 in expansion */
LANE_INLINE vd eos_mie_gruneisen_wave(const law *k, vd volume, vd p, vd shear)
{
    const vd K = k->K0 + k->eos.mie_gruneisen.K_slope * vd_max(p, vd_set(0));
    return K * vd_min(volume, vd_set(k->volume0)) + shear;
}
#endif
