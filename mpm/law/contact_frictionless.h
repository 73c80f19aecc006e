/* SPDX-License-Identifier: BSD-3-Clause */
/* Surfaces that slide freely:   J = -m (v . n) n where they approach. */
CONTACT_BEGIN(frictionless, "no force along the surface")
CONTACT_END(frictionless)

#ifdef CONTACT_IMPULSE
static inline bool contact_frictionless(const double *value, const contact_touch *t, double J[3])
{
    (void)value;
    const double closing = contact_closing(t);
    for (int k = 0; k < 3; k++) J[k] = -t->reduced * closing * t->n[k];
    return closing < 0;
}
#endif
