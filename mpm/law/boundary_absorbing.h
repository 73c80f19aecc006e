/* SPDX-License-Identifier: BSD-3-Clause */
/* Viscous boundary of Lysmer and Kuhlemeyer (1969), implicit in v, which also holds up the pressure P that the bodies
 * start with, as what goes on beyond it would:
 *   f = P A e - rho c_p A v_n - rho c_s A v_t,   e inwards
 * A is the part of the face that belongs to the node, from the volume gradient, V = m/rho its volume.  With gimp a body
 * at rest under pressure stays so to rounding, and one that moves through the end carries an even pressure; with
 * bspline, A/V = 2/h, to some per cent of the pressure: the splines of two nodes on either side share the face.
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

/* A / V of the node [1/m]. */
static inline double face_per_volume(const node_state *n, const wall *w, const mpm *m)
{
    const double area = (w->end ? 1 : -1) * n->extra[w->axis];
    if (m->scene.basis == MPM_BASIS_BSPLINE) return 2 / w->size;
    return area > 0 ? area / n->extra[3] : 0;
}

static inline void boundary_absorbing(node_state *n, const wall *w, const wall_place *at)
{
    const end_matter beyond = matter_at(at->m, at->brick, at->cell);
    const double face = face_per_volume(n, w, at->m), push = (w->end ? -1 : 1) * face * beyond.start * n->m;
    if (push != 0 && !n->held[w->axis]) absorb(n, at, w->axis, at->dt * push);
    for (int q = 0; q < 3; q++) {
        if (n->held[q]) continue; /* by a wall of an axis before */
        const double rate = face * (q == w->axis ? beyond.p : beyond.s);
        const double v = (n->v[q] + at->dt * n->f[q] / n->m) / (1 + at->dt * rate);
        absorb(n, at, q, -n->m * at->dt * rate * v);
    }
}
#endif
