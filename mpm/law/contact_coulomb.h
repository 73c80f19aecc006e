/* SPDX-License-Identifier: BSD-3-Clause */
/* Coulomb friction with a bond that can break (M-6).
 *
 *   J_n = -m (v . n) where they approach,   |J_t| = min(mu J_n, min(tau_max, tau) A dt, m |v_t|)
 * v = v_b - v_a, m the reduced mass, tau the strength in shear of the weaker side: a molten or failed layer slides
 * freely.  Surfaces with a bond move together, in tension too, while m |v| <= sigma_bond A dt. */
CONTACT_BEGIN(coulomb, "Coulomb friction, limited in shear, and a bond that can break")
CONTACT_VALUE(COULOMB_FRICTION, "friction", "1", 0.0, 0.0, 10.0, "Coulomb coefficient")
CONTACT_VALUE(COULOMB_SHEAR_LIMIT, "shear_limit", "Pa", CONTACT_NO_LIMIT, 0.0, CONTACT_NO_LIMIT,
              "upper limit of the friction stress; left out: none but the weaker side's strength")
CONTACT_VALUE(COULOMB_BOND_STRENGTH, "bond_strength", "Pa", 0.0, 0.0, 1e12,
              "held together where the traction is below it; 0: never bonded")
CONTACT_END(coulomb)

#ifdef CONTACT_IMPULSE
/* Beyond this gap, in widths of a cell, a bond is torn. */
static const double COULOMB_BOND_REACH = 0.5;

static inline bool contact_coulomb(const double *value, const contact_touch *t, double J[3])
{
    const double bond = value[COULOMB_BOND_STRENGTH];
    const double vn = dot(t->apart, t->n), v2 = dot(t->apart, t->apart), closing = contact_closing(t);
    if (bond > 0 && t->gap < COULOMB_BOND_REACH * t->width && t->reduced * sqrt(v2) <= bond * t->area * t->dt) {
        for (int k = 0; k < 3; k++) J[k] = -t->reduced * t->apart[k];
        return true;
    }
    if (!(closing < 0)) return false;
    double vt[3], Jn = -t->reduced * closing;
    for (int k = 0; k < 3; k++) vt[k] = t->apart[k] - vn * t->n[k];
    const double slip = sqrt(dot(vt, vt));
    const double strength = fmin(value[COULOMB_SHEAR_LIMIT], t->shear);
    const double limit = fmin(value[COULOMB_FRICTION] * Jn, strength * t->area * t->dt);
    const double Jt = fmin(limit, t->reduced * slip);
    for (int k = 0; k < 3; k++) J[k] = Jn * t->n[k] - (slip > 0 ? Jt * vt[k] / slip : 0);
    return true;
}
#endif
