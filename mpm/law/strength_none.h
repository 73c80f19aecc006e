/* SPDX-License-Identifier: BSD-3-Clause */
/* A fluid: no stress but pressure, and no constants of a solid.  Where its equation of state gives less than the
 * cavitation pressure it cavitates: it holds that pressure at any volume, without loss, and closes again when it is
 * squeezed. */
STRENGTH(none, NONE, "none: a fluid")
CONSTANT(cavitation_pressure, "Pa", OPTIONAL, -1e9, 0.0,
         "least pressure of a fluid, from that at rest; not given: 0, of an ideal gas: vacuum")
CONSTANT(viscosity_linear, "1", OPTIONAL, 0.0, 10.0, "of a fluid, in place of the scene's linear viscosity (M-5)")
CONSTANT(viscosity_quadratic, "1", OPTIONAL, 0.0, 10.0, "of a fluid, in place of the scene's quadratic viscosity (M-5)")

#ifdef LAW_STRUCT
typedef struct {
    double least_pressure; /* [Pa] */
} strength_none;
#endif

#ifdef LAW_DERIVE
static status strength_none_derive(law *k, const mpm_material *m, double scale)
{
    (void)scale;
    k->strength.none.least_pressure = k->p_rest + (isnan(m->cavitation_pressure) ? k->vacuum : m->cavitation_pressure);
    k->flow_start = k->least_flow = 0;
    k->rho_dust = 0; /* spray is a fluid too */
    if (!isnan(m->viscosity_linear)) k->q1 = m->viscosity_linear;
    if (!isnan(m->viscosity_quadratic)) k->q2 = m->viscosity_quadratic;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd strength_none_flow(const strength_none *k, const flow_state *s)
{
    (void)k;
    return 0 * s->strain;
}
#endif
