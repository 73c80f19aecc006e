/* SPDX-License-Identifier: BSD-3-Clause */
/* No wall: walls_at of mpm/kernel/nodes.c passes it over. */
BOUNDARY(FREE, free, BOUNDARY_ONCE, "nothing; what leaves the window is booked as ejected")

#ifdef BOUNDARY_ACTS
static inline void boundary_free(node_state *n, const wall *w, const wall_place *at)
{
    (void)n, (void)w, (void)at;
}
#endif
