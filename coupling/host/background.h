/* SPDX-License-Identifier: BSD-3-Clause */
/* Files that a thread of their own writes while the program goes on.
 *
 * They are written in the order given, each as by host_file_write; after one that fails, no other is.  The thread lives
 * from host_background_start to host_background_wait and sees nothing but those bytes: HDF5 may not be called by two
 * threads.  Paths and data are borrowed until the wait. */
#ifndef BREECH_COUPLING_BACKGROUND_H
#define BREECH_COUPLING_BACKGROUND_H

#include "base/status.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

enum { BACKGROUND_FILES = 2 };

typedef struct {
    const char *path;
    const void *data;
    size_t bytes;
} background_file;

/* All zero: nothing is being written. */
typedef struct {
    background_file file[BACKGROUND_FILES];
    pthread_t thread;
    bool started; /* the thread */
    status done;  /* what became of the files; the thread's until it has ended */
} background;

/* After the wait for what was started before.  Where no thread can be had, the files are written here and now. */
void host_background_start(background *b, const background_file file[BACKGROUND_FILES]);
/* Until all are written; STATUS_IO as host_file_write.  STATUS_OK where there is nothing to wait for. */
status host_background_wait(background *b);

#endif
