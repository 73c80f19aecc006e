/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/snapshot.h"

static void read_field(const void *source, mpm_field field, double *out)
{
    mpm_read(source, field, out);
}

status output_snapshots_write(snapshots *s, const mpm *m)
{
    const snapshot_source source = { mpm_glance(m).time, mpm_points(m), read_field, m };
    return output_snapshots_write_source(s, &source);
}
