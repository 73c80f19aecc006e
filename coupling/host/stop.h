/* SPDX-License-Identifier: BSD-3-Clause */
/* Stop requests: SIGINT, SIGTERM and --max-walltime, polled by the sinks.
 *
 * The first signal asks: the step is finished, a checkpoint written, exit 75.  A second SIGINT ends the process at
 * once. */
#ifndef BREECH_COUPLING_STOP_H
#define BREECH_COUPLING_STOP_H

#include <stdbool.h>

/* Installs the handlers; max_walltime [s] counts from `since` on, of host_wall_clock [s]; INFINITY or NAN: no limit. */
void host_stop_install(double since, double max_walltime);
bool host_stop_requested(void);
/* "SIGTERM", "SIGINT", "--max-walltime reached", or "" when none. */
const char *host_stop_reason(void);

#endif
