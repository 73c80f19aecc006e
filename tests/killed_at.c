/* SPDX-License-Identifier: BSD-3-Clause */
/* LD_PRELOAD of this kills the program where it puts a file in place: all that Breech writes is written beside its
 * name and renamed.  $KILLED_AT: a part of the path; $KILLED_COUNT: at which such file, from 1; $KILLED_AFTER: 0 before
 * it is in place, 1 after.  Parts of other paths: $LATE_AT takes a second to be put in place, $FULL_AT has no room on
 * the disk.  tests/test_killed.c. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static atomic_int seen; /* files are put in place by two threads */

static int number_in(const char *name)
{
    const char *text = getenv(name);
    return text ? atoi(text) : 0;
}

static bool is_at(const char *path, const char *name)
{
    const char *at = getenv(name);
    return at && strstr(path, at);
}

int rename(const char *from, const char *to)
{
    int (*real)(const char *, const char *) = NULL;
    *(void **)(void *)&real = dlsym(RTLD_NEXT, "rename");
    const bool now = is_at(to, "KILLED_AT") && ++seen == number_in("KILLED_COUNT"), after = number_in("KILLED_AFTER");
    if (is_at(to, "LATE_AT")) sleep(1);
    if (is_at(to, "FULL_AT")) {
        errno = ENOSPC;
        return -1;
    }
    if (now && !after) kill(getpid(), SIGKILL);
    const int done = real(from, to);
    if (now && after) kill(getpid(), SIGKILL);
    return done;
}
