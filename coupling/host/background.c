/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/background.h"

#include "coupling/host/outdir.h"

#include <signal.h>
#include <string.h>

static void *write_files(void *user)
{
    background *b = user;
    b->done = status_ok();
    for (int i = 0; i < BACKGROUND_FILES && b->done.code == STATUS_OK; i++)
        b->done = host_file_write(b->file[i].path, b->file[i].data, b->file[i].bytes);
    return NULL;
}

/* Signals are for the thread that asks whether one came. */
void host_background_start(background *b, const background_file file[BACKGROUND_FILES])
{
    sigset_t all, before;
    memcpy(b->file, file, sizeof b->file);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    b->started = pthread_create(&b->thread, NULL, write_files, b) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!b->started) write_files(b);
}

status host_background_wait(background *b)
{
    if (b->started) pthread_join(b->thread, NULL);
    const status done = b->done;
    b->started = false;
    b->done = status_ok();
    return done;
}
