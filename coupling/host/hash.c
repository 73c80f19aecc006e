/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/hash.h"

#include <string.h>

/* One round is a bijection of the state for a given word and of the word for a given state: a changed word shows. */
static uint64_t mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * UINT64_C(0x9E3779B97F4A7C15);
    return hash ^ (hash >> 32);
}

uint64_t host_hash_bytes(uint64_t hash, const void *data, size_t bytes)
{
    const unsigned char *p = data;
    uint64_t word;
    size_t i = 0;
    for (; i + sizeof word <= bytes; i += sizeof word) {
        memcpy(&word, p + i, sizeof word);
        hash = mix(hash, word);
    }
    word = 0;
    if (i < bytes) memcpy(&word, p + i, bytes - i);
    hash = mix(hash, word);
    return mix(hash, (uint64_t)bytes);
}
