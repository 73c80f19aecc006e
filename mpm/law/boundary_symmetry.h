/* SPDX-License-Identifier: BSD-3-Clause */
/* Ghost nodes beyond it are folded back by others, which ask for this kind by its place. */
BOUNDARY(SYMMETRY, symmetry, BOUNDARY_AGAIN, "a mirror: nothing moves through it, all slides along it; also a roller")

#ifdef BOUNDARY_ACTS
static inline void boundary_symmetry(node_state *n, const wall *w, const wall_place *at)
{
    (void)at;
    wall_hold(n, w->axis, 0);
}
#endif
