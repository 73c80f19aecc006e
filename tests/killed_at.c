/* SPDX-License-Identifier: BSD-3-Clause */
/* LD_PRELOAD of this kills the program where it puts a file in place: all that Breech writes is written beside its
 * name and renamed.  $KILLED_AT: a part of the path; $KILLED_COUNT: at which such file, from 1; $KILLED_AFTER: 0 before
 * it is in place, 1 after.  tests/test_killed.c. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int seen;

static int number_in(const char *name)
{
    const char *text = getenv(name);
    return text ? atoi(text) : 0;
}

int rename(const char *from, const char *to)
{
    int (*real)(const char *, const char *) = NULL;
    *(void **)(void *)&real = dlsym(RTLD_NEXT, "rename");
    const char *at = getenv("KILLED_AT");
    const int now = at && strstr(to, at) && ++seen == number_in("KILLED_COUNT"), after = number_in("KILLED_AFTER");
    if (now && !after) kill(getpid(), SIGKILL);
    const int done = real(from, to);
    if (now && after) kill(getpid(), SIGKILL);
    return done;
}
