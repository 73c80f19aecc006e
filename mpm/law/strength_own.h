/* SPDX-License-Identifier: BSD-3-Clause */
/* The caller's own law: a function of one point (mpm_own_strength of material.h), called from all threads.  Its shear
 * modulus is that of E and nu all the same; VARIES leaves the kernel of the usual metals as it is. */
STRENGTH(own, VARIES, "own: a function of the program that uses the library")
NEEDS(rate_0)
NEEDS(youngs_modulus)
NEEDS(poisson)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    mpm_own_strength own;
    double scale, G;
} strength_own;
#endif

#ifdef LAW_DERIVE
static status strength_own_derive(law *k, const mpm_material *m, double scale)
{
    CHECK(m->own_strength.flow, STATUS_BAD_INPUT,
          "material %.40s: strength `own` is for programs that use the library and give material.own_strength",
          m->name);
    const mpm_strength_point start = { .strain = k->cold_work, .log_rate = 0, .T = k->T_r, .T_star = 0 };
    k->G = mpm_material_shear_modulus(m);
    k->strength.own = (strength_own){ m->own_strength, scale, k->G };
    k->flow_start = scale * m->own_strength.flow(m->own_strength.user, &start);
    CHECK(k->flow_start > 0 && isfinite(k->flow_start), STATUS_BAD_INPUT,
          "material %.40s: its own law of strength gives %g Pa at the start, must be above zero", m->name,
          k->flow_start);
    k->least_flow = 0;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LAW_CALL vd strength_own_flow(const strength_own *k, const flow_state *s)
{
    vd flow = vd_set(0);
    for (int i = 0; i < (int)(sizeof flow / sizeof flow[0]); i++) {
        const mpm_strength_point at = { s->strain[i], s->log_rate[i], s->T[i], s->T_star[i] };
        flow[i] = at.T_star < 1 ? k->scale * k->own.flow(k->own.user, &at) : 0;
    }
    return flow;
}

LAW_CALL vd strength_own_shear(const strength_own *k, vd p, vd rho, vd T)
{
    (void)p, (void)rho, (void)T;
    return vd_set(k->G);
}
#endif
