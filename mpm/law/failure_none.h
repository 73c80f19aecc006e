/* SPDX-License-Identifier: BSD-3-Clause */
/* The material never fails; constants of other laws of failure are ignored. */
FAILURE(none, "none")

#ifdef LAW_STRUCT
typedef char failure_none; /* keeps nothing */
#endif

#ifdef LAW_DERIVE
static status failure_none_derive(law *k, const mpm_material *m)
{
    (void)k, (void)m;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd failure_none_grow(const failure_none *k, const failure_state *s)
{
    (void)k;
    return 0 * s->plastic;
}
#endif
