/* SPDX-License-Identifier: BSD-3-Clause */
BOUNDARY(FIXED, fixed, BOUNDARY_AGAIN, "no motion at all")

#ifdef BOUNDARY_ACTS
static inline void boundary_fixed(node_state *n, const wall *w, const wall_place *at)
{
    (void)w, (void)at;
    for (int q = 0; q < 3; q++) wall_hold(n, q, 0);
}
#endif
