/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/run/ranks.h"

#include "coupling/run/ranks_carrier.h"

#include <stdlib.h>

static const ranks_carrier *carrier; /* NULL: one process */
static bool launched;

/* Came while something was being sent; read before what comes next. */
typedef struct waiting {
    message m;
    struct waiting *next;
} waiting;
static waiting *first, **last = &first;

status run_ranks_start(int processes)
{
    TRY(run_ranks_mpi(&carrier));
    launched = carrier != NULL;
    if (!carrier && processes > 1) TRY(run_ranks_fork(processes, &carrier));
    return status_ok();
}

void run_ranks_finish(void)
{
    if (carrier) carrier->finish();
    carrier = NULL;
}

int run_ranks_number(void)
{
    return carrier ? carrier->number : 0;
}

int run_ranks_count(void)
{
    return carrier ? carrier->count : 1;
}

bool run_ranks_launched(void)
{
    return launched;
}

int run_ranks_on_machine(void)
{
    return carrier ? carrier->on_machine : 1;
}

/* Takes what has come off the other one's hands, who may be sending to this one and wait for that. */
static status take_in(bool *any)
{
    message m;
    TRY(carrier->receive(&m, any));
    if (!*any) return status_ok();
    waiting *w = malloc(sizeof *w);
    if (!w) run_message_free(&m);
    CHECK(w, STATUS_MEMORY, "no memory for a message");
    *w = (waiting){ .m = m };
    *last = w, last = &w->next;
    return status_ok();
}

status run_ranks_send(int to, int kind, const void *data, size_t bytes)
{
    bool all = false, any;
    TRY(carrier->send(to, kind, data, bytes));
    for (;;) {
        TRY(carrier->sent(&all));
        if (all) return status_ok();
        TRY(take_in(&any));
        if (!any) run_ranks_pause();
    }
}

status run_ranks_receive(message *out, bool *any)
{
    *out = (message){ .data = NULL };
    *any = first != NULL;
    if (!first) return carrier ? carrier->receive(out, any) : status_ok();
    waiting *w = first;
    *out = w->m;
    first = w->next;
    if (!first) last = &first;
    free(w);
    return status_ok();
}

void run_message_free(message *m)
{
    free(m->data);
    m->data = NULL;
}

status run_ranks_share(const void *mine, size_t bytes, ranks_memory *out)
{
    return carrier->share(mine, bytes, out);
}

void run_ranks_unshare(ranks_memory *m)
{
    carrier->unshare(m);
}
