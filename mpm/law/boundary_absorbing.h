/* SPDX-License-Identifier: BSD-3-Clause */
/* Viscous boundary of Lysmer and Kuhlemeyer (1969), implicit in v, which also holds up the pressure P that the bodies
 * start with, as what goes on beyond it would:
 *   f = P A e - rho c_p A v_n - rho c_s A v_t,   e inwards
 * The node's mass is rho A h/2, so rho c A = 2 c m/h and P A = 2 (P/rho) m/h with the density rho at the start.  With
 * gimp a body at rest under pressure stays so to rounding; with bspline to some per cent of the pressure, for the
 * splines of two nodes on either side of the end share the face.
 */
BOUNDARY(ABSORBING, absorbing, BOUNDARY_ONCE,
         "takes up waves of pressure and of shear: as if the bodies went on beyond it")

#ifdef BOUNDARY_ACTS
static inline void absorb(node_state *n, const wall_place *at, int k, double J)
{
    at->sum->impulse_boundary[k] += J;
    n->absorbed[k] += J;
    n->f[k] += J / at->dt;
}

static inline void boundary_absorbing(node_state *n, const wall *w, const wall_place *at)
{
    const end_matter beyond = matter_at(at->m, at->brick, at->cell);
    const double push = (w->end ? -2 : 2) * beyond.start * n->m / w->size;
    if (push != 0 && !n->held[w->axis]) absorb(n, at, w->axis, at->dt * push);
    for (int q = 0; q < 3; q++) {
        if (n->held[q]) continue; /* by a wall of an axis before */
        const double rate = 2 * (q == w->axis ? beyond.p : beyond.s) / w->size;
        const double v = (n->v[q] + at->dt * n->f[q] / n->m) / (1 + at->dt * rate);
        absorb(n, at, q, -n->m * at->dt * rate * v);
    }
}
#endif
