/* SPDX-License-Identifier: BSD-3-Clause */
/* Which version of Breech this is. */
#ifndef BREECH_COUPLING_HOST_VERSION_H
#define BREECH_COUPLING_HOST_VERSION_H

const char *host_version(void); /* "0.2.0"; "unknown" where the build does not say */

#endif
