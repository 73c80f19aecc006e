/*   dD = de/e_f,   e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln max(edot/edot0, 1)) (1 + D5 T*)                       (M-2)
 * s* = mean stress / von Mises stress, tension positive, capped at 1.5; e_f floored at 0.01.
 * Johnson and Cook, Engineering Fracture Mechanics 21 (1985) 31. */
FAILURE(johnson_cook, "Johnson-Cook (M-2)")
CONSTANT(damage_D1, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D1")
CONSTANT(damage_D2, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D2")
CONSTANT(damage_D3, "1", REQUIRED, -20.0, 20.0,
         "Johnson-Cook failure D3, times mean stress / von Mises stress, tension positive")
CONSTANT(damage_D4, "1", REQUIRED, -1.0, 10.0, "Johnson-Cook failure D4: strain rate")
CONSTANT(damage_D5, "1", REQUIRED, -10.0, 100.0, "Johnson-Cook failure D5: temperature")
NEEDS(rate_0)
NEEDS(melting_temperature)

#ifdef LAW_STRUCT
typedef struct {
    double D1, D2, D3, D4, D5;
} failure_johnson_cook;
#endif

#ifdef LAW_DERIVE
static status failure_johnson_cook_derive(law *k, const material *m)
{
    k->failure.johnson_cook =
        (failure_johnson_cook){ m->damage_D1, m->damage_D2, m->damage_D3, m->damage_D4, m->damage_D5 };
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd failure_johnson_cook_grow(const failure_johnson_cook *k, const failure_state *s)
{
    const vd x = vd_max(vd_min(s->triaxiality, vd_set(1.5)), vd_set(-5));
    const vd f = (k->D1 + k->D2 * vd_exp(k->D3 * x)) * (1 + k->D4 * s->log_rate) * (1 + k->D5 * s->T_star);
    return s->plastic / vd_max(f, vd_set(0.01));
}
#endif
