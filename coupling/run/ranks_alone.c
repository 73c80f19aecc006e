/* SPDX-License-Identifier: BSD-3-Clause */
/* A build without MPI: one process, and a refusal where mpirun started several. */
#include "coupling/run/ranks.h"

#include <stdlib.h>

status run_ranks_start(void)
{
    static const char *const sizes[] = { "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE" };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const char *size = getenv(sizes[i]);
        CHECK(!size || atoi(size) <= 1, STATUS_BAD_INPUT,
              "started as one of %.20s processes, but built without MPI; build again with libopenmpi-dev installed",
              size);
    }
    return status_ok();
}

void run_ranks_finish(void)
{
}

int run_ranks_number(void)
{
    return 0;
}

int run_ranks_count(void)
{
    return 1;
}

int run_ranks_on_machine(void)
{
    return 1;
}

status run_ranks_send(int to, int kind, const void *data, size_t bytes)
{
    (void)to, (void)kind, (void)data, (void)bytes;
    return base_status_error(STATUS_BAD_INPUT, "built without MPI");
}

status run_ranks_receive(message *out, bool *any)
{
    *out = (message){ .data = NULL };
    *any = false;
    return status_ok();
}

void run_message_free(message *m)
{
    m->data = NULL;
}

status run_ranks_share(const void *mine, size_t bytes, ranks_memory *out)
{
    (void)mine, (void)bytes, (void)out;
    return base_status_error(STATUS_BAD_INPUT, "built without MPI");
}

void run_ranks_unshare(ranks_memory *m)
{
    (void)m;
}

void run_ranks_pause(void)
{
}
