/* SPDX-License-Identifier: BSD-3-Clause */
/* Spall alone: a point fails when its tension exceeds the spall strength.  law_lanes.h tests that for every law of
 * failure that sets k->spall. */
FAILURE(spall, "tension beyond spall_strength")
NEEDS(spall_strength)

#ifdef LAW_STRUCT
typedef char failure_spall; /* keeps nothing: k->spall */
#endif

#ifdef LAW_DERIVE
static status failure_spall_derive(law *k, const mpm_material *m)
{
    k->spall = m->spall_strength;
    return status_ok();
}
#endif

#ifdef LAW_LANES
LANE_INLINE vd failure_spall_grow(const failure_spall *k, const failure_state *s)
{
    (void)k;
    return 0 * s->plastic;
}
#endif
