/* SPDX-License-Identifier: BSD-3-Clause */
/* Which word did the user mean? */
#ifndef BREECH_COUPLING_HOST_WORDS_H
#define BREECH_COUPLING_HOST_WORDS_H

/* The nearest of the names to a mistyped one, NULL if none is near.  next(user, i) gives the names, NULL at the end. */
const char *host_nearest_name(const char *name, const char *(*next)(const void *user, int i), const void *user);

/* How far apart two words are: letters changed, added, left out or swapped; case, - and _ do not count. */
int host_word_distance(const char *a, const char *b);

#endif
