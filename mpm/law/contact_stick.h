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
    for (int k = 0; k < 3; k++) J[k] = -t->reduced * t->apart[k];
    return dot(t->apart, t->n) < 0;
}
#endif
