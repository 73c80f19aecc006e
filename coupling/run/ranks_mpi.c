/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/ranks_carrier.h"

#include <limits.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>

static MPI_Request under_way = MPI_REQUEST_NULL;

static status begin_to_send(int to, int kind, const void *data, size_t bytes)
{
    CHECK(bytes <= INT_MAX, STATUS_MEMORY, "a message of %zu bytes between processes: at most %d", bytes, INT_MAX);
    MPI_Isend(data, (int)bytes, MPI_BYTE, to, kind, MPI_COMM_WORLD, &under_way);
    return status_ok();
}

static status has_sent(bool *all)
{
    int done = 0;
    MPI_Test(&under_way, &done, MPI_STATUS_IGNORE);
    *all = done;
    return status_ok();
}

static status receive(message *out, bool *any)
{
    MPI_Status about;
    int there = 0, bytes = 0;
    *out = (message){ .data = NULL };
    *any = false;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &about);
    if (!there) return status_ok();
    MPI_Get_count(&about, MPI_BYTE, &bytes);
    char *data = malloc((size_t)bytes + 1);
    CHECK(data, STATUS_MEMORY, "no memory for a message of %d bytes", bytes);
    MPI_Recv(data, bytes, MPI_BYTE, about.MPI_SOURCE, about.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    data[bytes] = '\0';
    *out = (message){ about.MPI_SOURCE, about.MPI_TAG, data, (size_t)bytes };
    *any = true;
    return status_ok();
}

static status share(const void *mine, size_t bytes, ranks_memory *out)
{
    MPI_Comm machine;
    MPI_Aint size;
    int unit;
    void *here;
    MPI_Win *window = malloc(sizeof *window);
    CHECK(window, STATUS_MEMORY, "no memory for a window of MPI");
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &out->n);
    MPI_Comm_rank(machine, &out->me);
    MPI_Win_allocate_shared((MPI_Aint)bytes, 1, MPI_INFO_NULL, machine, &here, window);
    MPI_Win_shared_query(*window, 0, &size, &unit, &out->part);
    MPI_Comm_free(&machine);
    out->window = window;
    memcpy(here, mine, bytes);
    MPI_Win_fence(0, *window);
    return status_ok();
}

static void unshare(ranks_memory *m)
{
    MPI_Win_free(m->window);
    free(m->window);
}

static void finish(void)
{
    MPI_Finalize();
}

/* Outside mpirun MPI is not started: it would take half a second and a network. */
static bool under_mpirun(void)
{
    static const char *const signs[] = { "OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE",
                                         "MV2_COMM_WORLD_SIZE" };
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if (getenv(signs[i])) return true;
    return false;
}

status run_ranks_mpi(const ranks_carrier **out)
{
    static ranks_carrier mpi = { .finish = finish,
                                 .send = begin_to_send,
                                 .sent = has_sent,
                                 .receive = receive,
                                 .share = share,
                                 .unshare = unshare };
    MPI_Comm machine;
    *out = NULL;
    if (!under_mpirun()) return status_ok();
    MPI_Init(NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, &mpi.number);
    MPI_Comm_size(MPI_COMM_WORLD, &mpi.count);
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &mpi.on_machine);
    MPI_Comm_free(&machine);
    *out = &mpi;
    return status_ok();
}
