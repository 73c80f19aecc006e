/* SPDX-License-Identifier: BSD-3-Clause */
/* Progress for the one who waits: a live line on a terminal, a plain line every ten seconds elsewhere, or every
 * $BREECH_PROGRESS seconds, nothing but warnings if quiet. And where the time went: seconds by phase. */
#ifndef BREECH_COUPLING_PROGRESS_H
#define BREECH_COUPLING_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Seconds on a clock that only goes forward [s]. */
double host_wall_clock(void);

typedef struct {
    FILE *stream; /* borrowed; where lines go (stderr) */
    bool terminal, quiet, shown;
    char task[160];             /* "scene 3 of 8, 1480 m/s" */
    double started, last_shown; /* wall clock [s] */
    double interval;            /* between two lines [s] */
    double fraction_started;    /* of the task, where this process took it up (resumed runs) */
    uint64_t steps_started;
} progress;

void host_progress_open(progress *p, FILE *stream, bool quiet);
/* A new task; `fraction` and `particle_steps` where it is taken up, 0 unless resumed. */
void host_progress_task(progress *p, const char *task, double fraction, uint64_t particle_steps);
/* As often as you like: it looks at the clock and mostly returns.  fraction of the task done, 0..1. */
void host_progress_update(progress *p, double fraction, uint64_t particle_steps);
/* A line that stays (an event, a result), above the live line. */
void host_progress_say(progress *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same for what must be known, with "warning: " before it: said even if quiet. */
void host_progress_warn(progress *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Clears the live line. */
void host_progress_close(progress *p);

/* The text of a line: "scene 3 of 8  42 %  1 min 20 s left  31.2 M point-steps/s".
 * elapsed, the time spent on the `gained` fraction [s]. */
void host_progress_text(const progress *p, double fraction, double elapsed, uint64_t particle_steps, char *text,
                        size_t size);
/* "45 s", "1 min 20 s", "2 h 05 min", "3 d 04 h" */
void host_duration_text(double seconds, char *text, size_t size);

/* ---- where the time went ---- */

enum { TIMING_MAX_PHASES = 24 };
typedef struct {
    int phases;
    struct {
        char name[40];
        double seconds;
        uint64_t calls;
    } phase[TIMING_MAX_PHASES];
    double started;
} timing;

void host_timing_open(timing *t);
/* seconds = host_wall_clock() - what it was at the phase's start; phases are made on first use. */
void host_timing_add(timing *t, const char *phase, double seconds);
/* A table: phase, calls, seconds, part of the whole; the rest as `other`. */
void host_timing_print(const timing *t, FILE *out);

#endif
