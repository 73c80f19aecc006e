/* SPDX-License-Identifier: BSD-3-Clause */
/* One hash for keys and checksums. */
#ifndef BREECH_COUPLING_HOST_HASH_H
#define BREECH_COUPLING_HOST_HASH_H

#include <stddef.h>
#include <stdint.h>

/* 64-bit hash, chained: start with 0.  Any change of one 8-byte word changes it. */
uint64_t host_hash_bytes(uint64_t hash, const void *data, size_t bytes);

#endif
