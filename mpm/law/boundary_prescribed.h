/* SPDX-License-Identifier: BSD-3-Clause */
BOUNDARY(PRESCRIBED, prescribed, BOUNDARY_AGAIN, "moves all at a velocity, `{prescribed: 3 0 0 m/s}`")

#ifdef BOUNDARY_ACTS
static inline void boundary_prescribed(node_state *n, const wall *w, const wall_place *at)
{
    (void)at;
    for (int q = 0; q < 3; q++) wall_hold(n, q, w->velocity[q]);
}
#endif
