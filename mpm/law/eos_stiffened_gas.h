/* SPDX-License-Identifier: BSD-3-Clause */
/* Stiffened gas, P = (gamma - 1) rho E - gamma p_inf, and an ideal gas where p_inf = 0.  With the pressure counted from
 * that of the surroundings, p = P - Pa, and the energy from rest, e = E - E0 - Pa (1/rho0 - 1/rho), it is
 *   p = A + (rho0 c0^2 - (gamma - 1) A) mu + (gamma - 1) rho e,   A = P0 - Pa,   rho0 c0^2 = gamma (p_inf + P0),
 *   c^2 = gamma (p + p_s)/rho,   p_s = p_inf + Pa.
 * On the isentrope from rest, x = rho/rho0:  p + p_s = (A + p_s) x^gamma,  T = T_r x^(gamma - 1).
 * Where the scene does not say what surrounds it, Pa = P0 and A = 0.  Then a void is a place at P0 that has no mass: it
 * pushes on gas that has expanded below P0, and grows wherever points part by chance.  A gas that expands wants
 * surroundings of 0, a vacuum, from which its pressure is never negative. */
EOS(stiffened_gas, "stiffened gas; an ideal gas where gas_stiffness is 0")
CONSTANT(gas_gamma, "1", REQUIRED, 1.01, 20.0, "ratio of specific heats gamma")
CONSTANT(gas_stiffness, "Pa", REQUIRED, 0.0, 1e11, "p_inf of a stiffened gas; 0: an ideal gas")
CONSTANT(gas_pressure, "Pa", REQUIRED, 0.0, 1e9, "absolute pressure at rest, at which it has `density`")

#ifdef LAW_STRUCT
typedef struct {
    double gamma, gamma1; /* gamma, gamma - 1 */
    double p_s, slope;    /* p_s; slope of p with mu at e = 0 [Pa] */
    double heat, cold;    /* of the reference energy: heat (x^(gamma - 1) - 1) + cold (1/x - 1) [J/kg] */
} eos_stiffened_gas;
#endif

#ifdef LAW_DERIVE
static double eos_stiffened_gas_pressure_at(const law *k, double mu, double e)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    return k->p_rest + c->slope * mu + c->gamma1 * k->rho0 * (1 + mu) * e;
}

static double eos_stiffened_gas_reference_at(const law *k, double mu)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    return c->heat * (pow(1 + mu, c->gamma1) - 1) + c->cold * (1 / (1 + mu) - 1);
}

static status eos_stiffened_gas_derive(law *k, const mpm_material *m)
{
    const double stiff = m->gas_stiffness + m->gas_pressure, g1 = m->gas_gamma - 1;
    CHECK(stiff > 0, STATUS_BAD_INPUT,
          "material %.40s: gas_pressure = 0 Pa: must be above zero where gas_stiffness is 0", m->name);
    const double energy = stiff / (g1 * k->rho0), heat = k->c_v * k->T_r;
    CHECK(m->gas_stiffness > 0 || fabs(heat / energy - 1) < 0.02, STATUS_BAD_INPUT,
          "material %.40s: of an ideal gas, gas_pressure = %g Pa must be (gas_gamma - 1) density specific_heat "
          "reference_temperature = %g Pa",
          m->name, stiff, g1 * k->rho0 * heat);
    const double most = m->gas_gamma * stiff / (k->rho0 * g1 * g1 * k->T_r);
    CHECK(k->c_v < most, STATUS_BAD_INPUT,
          "material %.40s: specific_heat = %g J/(kg K): must be below %g J/(kg K), or this stiffened gas yields to "
          "slow pressing",
          m->name, k->c_v, most);
    k->K0 = m->gas_gamma * stiff;
    if (!isnan(k->surroundings)) k->p_rest = m->gas_pressure - k->surroundings;
    const double p_s = stiff - k->p_rest;
    k->eos.stiffened_gas = (eos_stiffened_gas){ .gamma = m->gas_gamma,
                                                .gamma1 = g1,
                                                .p_s = p_s,
                                                .slope = k->K0 - g1 * k->p_rest,
                                                .heat = energy - heat,
                                                .cold = p_s / k->rho0 };
    k->mu_least = -0.999, k->mu_most = 99;
    k->volume_min = 0.01 * k->volume0, k->volume_max = 1000 * k->volume0;
    if (m->gas_stiffness <= 0) k->vacuum = -stiff;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LAW_CALL vd eos_stiffened_gas_pressure(const law *k, vd mu, vd rho, vd e, vd half)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    const vd slope = c->gamma1 * rho;
    return (k->p_rest + c->slope * mu + slope * e) / (1 + slope * half);
}

LAW_CALL vd eos_stiffened_gas_reference(const law *k, vd mu)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    const vd x = 1 + mu;
    return c->heat * (vd_exp(c->gamma1 * vd_log(x)) - 1) + c->cold * (1 / x - 1);
}

LAW_CALL vd eos_stiffened_gas_wave(const law *k, vd volume, vd p, vd shear)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    return c->gamma * vd_max(p + c->p_s, vd_set(1e-3 / c->gamma * k->K0)) * volume + shear;
}
#endif
