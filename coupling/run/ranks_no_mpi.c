/* SPDX-License-Identifier: BSD-3-Clause */
/* A build without MPI: a refusal where mpirun has started several processes. */
#include "coupling/run/ranks_carrier.h"

#include <stdlib.h>

status run_ranks_mpi(const ranks_carrier **out)
{
    static const char *const sizes[] = { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE" };
    *out = NULL;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const char *size = getenv(sizes[i]);
        CHECK(!size || atoi(size) <= 1, STATUS_BAD_INPUT,
              "started as one of %.20s processes, but built without MPI; build again with libopenmpi-dev installed, or "
              "take --processes on one machine",
              size);
    }
    return status_ok();
}
