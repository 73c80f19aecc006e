/* SPDX-License-Identifier: BSD-3-Clause */
/* Viscous boundary of Lysmer and Kuhlemeyer (1969), implicit in v: the node's mass is rho A h/2, so rho c A = 2 c m/h.
 */
BOUNDARY(ABSORBING, absorbing, BOUNDARY_ONCE,
         "takes up waves of pressure and of shear: as if the bodies went on beyond it")

#ifdef BOUNDARY_ACTS
static inline void boundary_absorbing(node_state *n, const wall *w, const wall_place *at)
{
    const wave_speeds c = speeds_at(at->m, at->brick, at->cell);
    for (int q = 0; q < 3; q++) {
        if (n->held[q]) continue; /* by a wall of an axis before */
        const double rate = 2 * (q == w->axis ? c.p : c.s) / w->size;
        const double v = (n->v[q] + at->dt * n->f[q] / n->m) / (1 + at->dt * rate);
        const double J = -n->m * at->dt * rate * v;
        at->sum->impulse_boundary[q] += J;
        n->absorbed[q] += J;
        n->f[q] += J / at->dt;
    }
}
#endif
