/* SPDX-License-Identifier: BSD-3-Clause */
/* Rough surfaces: no sliding while they are pressed on each other, whatever the shear; they part freely.
 *
 *   J = -m v where v . n < 0 */
CONTACT_BEGIN(stick, "no sliding under pressure, no hold in tension")
CONTACT_END(stick)

#ifdef CONTACT_IMPULSE
static inline bool contact_stick(const double *value, const contact_touch *t, double J[3])
{
    (void)value;
    const double closing = contact_closing(t), left = closing - dot(t->apart, t->n); /* for the gap to close */
    for (int k = 0; k < 3; k++) J[k] = -t->reduced * (t->apart[k] + left * t->n[k]);
    return closing < 0;
}
#endif
