/* SPDX-License-Identifier: BSD-3-Clause */
/* What differs between SUNDIALS 6.4 and 7.x, for circuit/dae.c alone. */
#ifndef BREECH_CIRCUIT_SUNDIALS_COMPAT_H
#define BREECH_CIRCUIT_SUNDIALS_COMPAT_H

#include <sundials/sundials_config.h>
#if SUNDIALS_VERSION_MAJOR >= 7
#define COMPAT_NO_COMM SUN_COMM_NULL
#define COMPAT_SILENCE(context, memory) ((void)(memory), SUNContext_ClearErrHandlers(context))
#else
#define COMPAT_NO_COMM NULL
#define COMPAT_SILENCE(context, memory) ((void)(context), IDASetErrFile((memory), NULL))
#endif

#endif
