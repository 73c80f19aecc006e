/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/version.h"

const char *host_version(void)
{
#ifdef BREECH_VERSION
    return BREECH_VERSION;
#else
    return "unknown";
#endif
}
