/* SPDX-License-Identifier: BSD-3-Clause */
/* Mechanical threshold stress: Follansbee and Kocks, Acta Metall. 36 (1988) 81, of one structure at the strain, the
 * rate and the temperature of now:                                                                        (M-25)
 *   sigma_y = sigma_a + mu/mu0 S sigma_e,   mu = mu0 - D/(exp(T0/T) - 1)  [Pa]; zero when molten
 *   S = [1 - (k T/(mu b^3 g0) ln(edot_0/edot))^(1/q)]^(1/p), in 0 .. 1
 *   d sigma_e/de = theta (1 - tanh(alpha sigma_e/sigma_s)/tanh alpha),   sigma_e = 0 at e = 0
 *   theta = a0 + a1 ln(edot s) + a2 sqrt(edot s),   sigma_s = sigma_s0 (edot/edot_s)^(k T/(mu b^3 g0_s))
 * The paper lets sigma_e remember under which rates and temperatures it grew; here it is that of a test at the present
 * ones, as with the other laws, so that a point needs no variable of its own. */
STRENGTH(mts, FIXED, "mechanical threshold stress (M-25)")
CONSTANT(mts_sigma_a, "Pa", REQUIRED, 0.0, 1e10,
         "mechanical threshold stress sigma_a: part without rate or temperature")
CONSTANT(mts_mu0, "Pa", REQUIRED, 1e6, 1e12, "mechanical threshold stress mu0: shear modulus at T = 0")
CONSTANT(mts_D, "Pa", REQUIRED, 0.0, 1e11, "mechanical threshold stress D: its fall with temperature")
CONSTANT(mts_T0, "K", REQUIRED, 1.0, 2e3, "mechanical threshold stress T0: temperature of that fall")
CONSTANT(mts_k_b3, "Pa/K", REQUIRED, 1e4, 1e8,
         "mechanical threshold stress k/b^3: Boltzmann's constant, Burgers vector")
CONSTANT(mts_g0, "1", REQUIRED, 1e-3, 100.0, "mechanical threshold stress g0: activation energy of flow")
CONSTANT(mts_rate, "1/s", REQUIRED, 1.0, 1e15, "mechanical threshold stress edot_0: rate of flow without barriers")
CONSTANT(mts_p, "1", REQUIRED, 0.1, 2.0, "mechanical threshold stress p: form of the barriers")
CONSTANT(mts_q, "1", REQUIRED, 0.1, 3.0, "mechanical threshold stress q: form of the barriers")
CONSTANT(mts_a0, "Pa", REQUIRED, 0.0, 1e12, "mechanical threshold stress a0: first rate of hardening")
CONSTANT(mts_a1, "Pa", REQUIRED, 0.0, 1e10, "mechanical threshold stress a1: times ln of the rate in 1/s")
CONSTANT(mts_a2, "Pa", REQUIRED, 0.0, 1e10, "mechanical threshold stress a2: times the root of the rate in 1/s")
CONSTANT(mts_alpha, "1", REQUIRED, 0.1, 2.0, "mechanical threshold stress alpha: how hardening ends")
CONSTANT(mts_g0_s, "1", REQUIRED, 1e-3, 100.0, "mechanical threshold stress g0_s: activation energy of saturation")
CONSTANT(mts_rate_s, "1/s", REQUIRED, 1.0, 1e15, "mechanical threshold stress edot_s: rate of saturation at sigma_s0")
CONSTANT(mts_sigma_s0, "Pa", REQUIRED, 1e5, 1e11, "mechanical threshold stress sigma_s0: where hardening ends at T = 0")
NEEDS(rate_0)
NEEDS(youngs_modulus)
NEEDS(poisson)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
enum { MTS_TERMS = 8 };

typedef struct {
    double sigma_a, sigma_s0; /* times the body's yield_scale [Pa] */
    double mu0, D, T0, k_b3, inv_g0, inv_p, inv_q, inv_g0_s;
    double a0, a1, a2; /* times the body's yield_scale [Pa] */
    double alpha, sinh_alpha, cosh_alpha, inv_tanh;
    double chebyshev[MTS_TERMS];   /* of the distance of w from its asymptote, mts_hardened */
    double ln_rate0;               /* ln of rate_0 in 1/s */
    double ln_barrier, ln_plateau; /* ln(edot_0/rate_0), ln(edot_s/rate_0) */
} strength_mts;

static const double MTS_SCALE = 4; /* x at which half of the fit's range is passed */
#endif

#ifdef LAW_DERIVE
/* The flow stress where sigma_e = 0 and, with cold work, by its equation: for the start only. */
static double strength_mts_start(const strength_mts *k, double strain, double T)
{
    enum { STEPS = 4000 };
    const double mu = k->mu0 - k->D / expm1(k->T0 / T), barrier = k->k_b3 * T / mu;
    const double open = pow(fmax(barrier * k->inv_g0 * k->ln_barrier, 0), k->inv_q);
    const double S = pow(fmax(1 - open, 0), k->inv_p);
    const double end = k->sigma_s0 * exp(-barrier * k->inv_g0_s * k->ln_plateau);
    const double theta = k->a0 + k->a1 * k->ln_rate0 + k->a2 * exp(0.5 * k->ln_rate0), d = theta * strain / STEPS;
    double sigma = 0; /* by the midpoint rule */
    for (int i = 0; i < STEPS; i++) {
        const double half = sigma + 0.5 * d * (1 - tanh(k->alpha * sigma / end) * k->inv_tanh);
        sigma += d * (1 - tanh(k->alpha * half / end) * k->inv_tanh);
    }
    return k->sigma_a + mu / k->mu0 * S * sigma;
}

/* w of mts_hardened at x: Newton's rule on a convex function, from the least of two bounds above the root. */
static double strength_mts_root(const strength_mts *k, double x)
{
    enum { STEPS = 30 };
    const double a = k->alpha, S = k->sinh_alpha, C = k->cosh_alpha, want = a * x;
    double w = fmin(want * k->inv_tanh, (want + S * S * a) / (S * C));
    for (int i = 0; i < STEPS; i++) {
        const double z = S * exp(-w);
        w -= (S * (C * w - S * (a - asinh(z))) - want) / (S * (C - S * z / sqrt(1 + z * z)));
    }
    return w;
}

/* Minimum of sigma_y/(1 - T*) over temperature, at the strain and the rate with the lowest flow stress. */
static double strength_mts_least(const law *k)
{
    enum { STEPS = 100 };
    const strength_mts *c = &k->strength.mts;
    const double theta = c->a0 + c->a1 * c->ln_rate0 + c->a2 * exp(0.5 * c->ln_rate0);
    double least = HUGE_VAL;
    for (int i = 0; i < STEPS; i++) {
        const double T_star = (double)i / STEPS, T = k->T_r + T_star * (k->T_m - k->T_r);
        const double mu = c->mu0 - c->D / expm1(c->T0 / T), barrier = c->k_b3 * T / mu;
        const double open = pow(fmax(barrier * c->inv_g0 * c->ln_barrier, 0), c->inv_q);
        const double end = c->sigma_s0 * exp(-barrier * c->inv_g0_s * c->ln_plateau);
        const double w = strength_mts_root(c, k->cold_work * theta / end);
        const double hardened = end * (1 - asinh(c->sinh_alpha * exp(-w)) / c->alpha);
        const double flow = c->sigma_a + mu / c->mu0 * pow(fmax(1 - open, 0), c->inv_p) * hardened;
        least = fmin(least, flow / (1 - T_star));
    }
    return least;
}

static void strength_mts_fit(strength_mts *k)
{
    const double pi = 4 * atan(1), S = k->sinh_alpha, C = k->cosh_alpha;
    memset(k->chebyshev, 0, sizeof k->chebyshev);
    for (int i = 0; i < MTS_TERMS; i++) {
        const double angle = pi * (i + 0.5) / MTS_TERMS, part = 0.5 * (1 + cos(angle)),
                     x = MTS_SCALE * part / (1 - part);
        const double off = k->alpha * (x + S * S) / (S * C) - strength_mts_root(k, x);
        for (int j = 0; j < MTS_TERMS; j++) k->chebyshev[j] += (j ? 2.0 : 1.0) / MTS_TERMS * off * cos(j * angle);
    }
}

/* 1/x; the tables print 2/3 as 0.666667. */
static double strength_mts_inverse(double x)
{
    return fabs(x - 2.0 / 3.0) < 1e-6 ? 1.5 : 1 / x;
}

static status strength_mts_derive(law *k, const mpm_material *m, double scale)
{
    CHECK(m->mts_mu0 > m->mts_D / expm1(m->mts_T0 / m->melting_temperature), STATUS_BAD_INPUT,
          "material %.40s: melting_temperature = %g K, but its shear modulus, mts_mu0 - mts_D/(exp(mts_T0/T) - 1), has "
          "fallen to none before",
          m->name, m->melting_temperature);
    k->strength.mts = (strength_mts){ .sigma_a = scale * m->mts_sigma_a,
                                      .sigma_s0 = scale * m->mts_sigma_s0,
                                      .mu0 = m->mts_mu0,
                                      .D = m->mts_D,
                                      .T0 = m->mts_T0,
                                      .k_b3 = m->mts_k_b3,
                                      .inv_g0 = 1 / m->mts_g0,
                                      .inv_p = strength_mts_inverse(m->mts_p),
                                      .inv_q = strength_mts_inverse(m->mts_q),
                                      .inv_g0_s = 1 / m->mts_g0_s,
                                      .a0 = scale * m->mts_a0,
                                      .a1 = scale * m->mts_a1,
                                      .a2 = scale * m->mts_a2,
                                      .alpha = m->mts_alpha,
                                      .sinh_alpha = sinh(m->mts_alpha),
                                      .cosh_alpha = cosh(m->mts_alpha),
                                      .inv_tanh = 1 / tanh(m->mts_alpha),
                                      .ln_rate0 = -log(k->inv_rate0),
                                      .ln_barrier = log(m->mts_rate * k->inv_rate0),
                                      .ln_plateau = log(m->mts_rate_s * k->inv_rate0) };
    strength_mts_fit(&k->strength.mts);
    k->least_flow = strength_mts_least(k);
    k->flow_start = strength_mts_start(&k->strength.mts, k->cold_work, k->T_r);
    return status_ok();
}
#endif

#ifdef LAW_LANES
/* x^n, zero at zero: without exponential and logarithm for the exponents of the tables, 1 and 3/2 */
LANE_INLINE vd mts_power(vd x, double n)
{
    if (n == 1) return x;
    return n == 1.5 ? x * vd_sqrt(x) : power(x, n);
}

/* sigma_e/sigma_s at a strain of x sigma_s/theta, from the closed integral of its equation:
 *   sinh a (w cosh a - sinh a (a - y)) = a x,   sinh y = sinh a exp(-w),   sigma_e/sigma_s = 1 - y/a.
 * w begins a polynomial of x/(x + 4) below its asymptote a (x + sinh^2 a)/(sinh a cosh a); one step of Halley's rule
 * then leaves less than 1e-10 of sigma_s.  y follows it by its series in the step d,
 *   y' = -z/r,   y'' = z/r^3,   z = sinh y,   r = cosh y. */
LANE_INLINE vd mts_hardened(const strength_mts *k, vd x)
{
    const double a = k->alpha, S = k->sinh_alpha, C = k->cosh_alpha;
    const vd t = 2 * x / (x + MTS_SCALE) - 1;
    vd b1 = vd_set(0), b2 = vd_set(0);
    for (int j = MTS_TERMS - 1; j > 0; j--) {
        const vd b = 2 * t * b1 - b2 + k->chebyshev[j];
        b2 = b1, b1 = b;
    }
    const vd w = a / (S * C) * (x + S * S) - (t * b1 - b2 + k->chebyshev[0]);
    const vd z = S * vd_exp(-w), square = 1 + z * z, root = vd_sqrt(square), y = vd_log(z + root);
    const vd slope = z / root, bend = slope / square;
    const vd miss = S * (C * w - S * (a - y)) - a * x, rate = 1 / (S * (C - S * slope)), first = miss * rate;
    const vd d = first * (1 + 0.5 * S * S * first * bend * rate);
    return 1 - (y + d * (slope + 0.5 * d * bend)) / a;
}

LAW_CALL vd strength_mts_flow(const strength_mts *k, const flow_state *s)
{
    const vd one = vd_set(1), zero = vd_set(0);
    const vd mu = k->mu0 - k->D / (vd_exp(k->T0 / s->T) - 1), barrier = k->k_b3 * s->T / mu;
    const vd open = barrier * k->inv_g0 * vd_max(k->ln_barrier - s->log_rate, zero);
    const vd S = mts_power(vd_max(1 - mts_power(open, k->inv_q), zero), k->inv_p);
    const vd end = k->sigma_s0 * vd_exp(barrier * k->inv_g0_s * (s->log_rate - k->ln_plateau));
    const vd ln_rate = s->log_rate + k->ln_rate0;
    const vd theta = k->a0 + k->a1 * ln_rate + k->a2 * vd_exp(0.5 * ln_rate);
    const vd stress = k->sigma_a + mu * (1 / k->mu0) * S * end * mts_hardened(k, s->strain * theta / end);
    return vd_where(vd_less(s->T_star, one), stress);
}
#endif
