/* Stiffened gas, P = (gamma - 1) rho E - gamma p_inf, and an ideal gas where p_inf = 0.  With pressure and energy
 * counted from rest at the surroundings' pressure P0, p = P - P0 and e = E - E0 - P0 (1/rho0 - 1/rho), it is
 *   p = rho0 c0^2 mu + (gamma - 1) rho e,   rho0 c0^2 = gamma (p_inf + P0),   c^2 = gamma (p + p_inf + P0)/rho.
 * On the isentrope from rest, x = rho/rho0:  p + p_s = p_s x^gamma,  T = T_r x^(gamma - 1),  p_s = p_inf + P0. */
EOS(stiffened_gas, "stiffened gas; an ideal gas where gas_stiffness is 0")
CONSTANT(gas_gamma, "1", REQUIRED, 1.01, 20.0, "ratio of specific heats gamma")
CONSTANT(gas_stiffness, "Pa", REQUIRED, 0.0, 1e11, "p_inf of a stiffened gas; 0: an ideal gas")
CONSTANT(gas_pressure, "Pa", REQUIRED, 0.0, 1e9, "pressure of the surroundings, at which it has `density`")

#ifdef LAW_STRUCT
typedef struct {
    double gamma, gamma1; /* gamma, gamma - 1 */
    double p_s;           /* [Pa] */
    double heat, cold;    /* of the reference energy: heat (x^(gamma - 1) - 1) + cold (1/x - 1) [J/kg] */
} eos_stiffened_gas;
#endif

#ifdef LAW_DERIVE
static double eos_stiffened_gas_pressure_at(const law *k, double mu, double e)
{
    return k->K0 * mu + k->eos.stiffened_gas.gamma1 * k->rho0 * (1 + mu) * e;
}

static double eos_stiffened_gas_reference_at(const law *k, double mu)
{
    const eos_stiffened_gas *c = &k->eos.stiffened_gas;
    return c->heat * (pow(1 + mu, c->gamma1) - 1) + c->cold * (1 / (1 + mu) - 1);
}

static status eos_stiffened_gas_derive(law *k, const material *m)
{
    const double p_s = m->gas_stiffness + m->gas_pressure, g1 = m->gas_gamma - 1;
    CHECK(p_s > 0, STATUS_BAD_INPUT, "material %.40s: gas_pressure = 0 Pa: must be above zero where gas_stiffness is 0",
          m->name);
    const double energy = p_s / (g1 * k->rho0), heat = k->c_v * k->T_r;
    CHECK(m->gas_stiffness > 0 || fabs(heat / energy - 1) < 0.02, STATUS_BAD_INPUT,
          "material %.40s: of an ideal gas, gas_pressure = %g Pa must be (gas_gamma - 1) density specific_heat "
          "reference_temperature = %g Pa",
          m->name, p_s, g1 * k->rho0 * heat);
    const double most = m->gas_gamma * p_s / (k->rho0 * g1 * g1 * k->T_r);
    CHECK(k->c_v < most, STATUS_BAD_INPUT,
          "material %.40s: specific_heat = %g J/(kg K): must be below %g J/(kg K), or this stiffened gas yields to "
          "slow pressing",
          m->name, k->c_v, most);
    k->eos.stiffened_gas = (eos_stiffened_gas){
        .gamma = m->gas_gamma, .gamma1 = g1, .p_s = p_s, .heat = energy - heat, .cold = p_s / k->rho0
    };
    k->K0 = m->gas_gamma * p_s;
    k->mu_least = -0.999, k->mu_most = 99;
    k->volume_min = 0.01 * k->volume0, k->volume_max = 1000 * k->volume0;
    if (m->gas_stiffness <= 0) k->vacuum = -p_s;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LAW_CALL vd eos_stiffened_gas_pressure(const law *k, vd mu, vd rho, vd e, vd half)
{
    const vd slope = k->eos.stiffened_gas.gamma1 * rho;
    return (k->K0 * mu + slope * e) / (1 + slope * half);
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
    return c->gamma * vd_max(p + c->p_s, vd_set(1e-3 * c->p_s)) * volume + shear;
}
#endif
