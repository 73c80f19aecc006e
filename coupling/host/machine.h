/* SPDX-License-Identifier: BSD-3-Clause */
/* What the machine has. */
#ifndef BREECH_COUPLING_HOST_MACHINE_H
#define BREECH_COUPLING_HOST_MACHINE_H

/* Memory that this process may use: of the machine, or of its control group or a group above that, where one of these
 * has less.  INFINITY where nothing is known.  root: "", or a folder that holds proc/ and sys/ [bytes]. */
double host_memory(const char *root);

#endif
