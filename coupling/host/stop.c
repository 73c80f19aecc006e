/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/stop.h"

#include "coupling/host/progress.h"

#include <math.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

/* The only state of the program that a signal handler may touch; written there, read by the sinks. */
static volatile sig_atomic_t signal_seen;
/* Set once before any work starts [s of host_wall_clock]. */
static double deadline = INFINITY;

static void on_signal(int number)
{
    if (signal_seen && number == SIGINT) _exit(128 + SIGINT);
    signal_seen = number;
}

void host_stop_install(double since, double max_walltime)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    signal_seen = 0;
    deadline = isnan(max_walltime) ? INFINITY : since + max_walltime;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool host_stop_requested(void)
{
    return signal_seen || (isfinite(deadline) && host_wall_clock() >= deadline);
}

const char *host_stop_reason(void)
{
    if (signal_seen == SIGTERM) return "SIGTERM";
    if (signal_seen == SIGINT) return "SIGINT";
    return host_stop_requested() ? "--max-walltime reached" : "";
}
