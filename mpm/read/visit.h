/* SPDX-License-Identifier: BSD-3-Clause */
/* Walks over all points, in an order that no number of threads changes. */
#ifndef BREECH_MPM_VISIT_H
#define BREECH_MPM_VISIT_H

#include "mpm/memory/store.h"

typedef void mpm_block_visitor(void *user, const mpm *m, const brick *b, int index);

/* Calls `each` for every block, each share of the bricks on its own by all threads, in the order of bricks, cells and
 * chains.  `sums` are SHARES of `bytes`, for the caller to add up in order. */
void mpm_visit_shares(const mpm *m, mpm_block_visitor *each, void *sums, size_t bytes);

/* Does a probe of this body read the block's points? */
static inline bool visit_wants(const mpm *m, int index, int body)
{
    return body < 0 || m->links[index].body == body;
}

#endif
