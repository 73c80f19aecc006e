/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/utf8.h"

int host_utf8_length(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    const int n = c[0] < 0x80 ? 1 : c[0] < 0xc2 ? 0 : c[0] < 0xe0 ? 2 : c[0] < 0xf0 ? 3 : c[0] < 0xf5 ? 4 : 0;
    for (int k = 1; k < n; k++)
        if ((c[k] & 0xc0) != 0x80) return 0;
    if ((c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90)) return 0; /* longer than need be */
    if ((c[0] == 0xed && c[1] > 0x9f) || (c[0] == 0xf4 && c[1] > 0x8f)) return 0; /* half a pair; no such number */
    return n;
}

void host_utf8_repair(char *text)
{
    while (*text) {
        const int n = host_utf8_length(text);
        if (n == 0) *text = '?';
        text += n ? n : 1;
    }
}
