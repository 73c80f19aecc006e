/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/snapshot.h"

static void read_all(const void *source, float *const out[MPM_FIELD_COUNT])
{
    mpm_read_all(source, out);
}

status output_snapshots_write(snapshots *s, const mpm *m)
{
    const snapshot_source source = { mpm_glance(m).time, mpm_points(m), read_all, m };
    return output_snapshots_write_source(s, &source);
}
