/* SPDX-License-Identifier: BSD-3-Clause */
/* Letters of more than one byte, as browsers and readers of JSON take them. */
#ifndef BREECH_COUPLING_HOST_UTF8_H
#define BREECH_COUPLING_HOST_UTF8_H

/* Bytes of the UTF-8 sequence that begins here, 0 where none does (Unicode 15, table 3-7); text is not empty. */
int host_utf8_length(const char *text);

/* Puts ? in place of every byte that belongs to no UTF-8 sequence. */
void host_utf8_repair(char *text);

#endif
