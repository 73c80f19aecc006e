/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#define TERMINAL_INTERVAL 0.2 /* between two pictures of the live line [s] */
#define PLAIN_INTERVAL 10.0   /* between two plain lines [s], where $BREECH_PROGRESS gives no other */

double host_wall_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void host_duration_text(double seconds, char *text, size_t size)
{
    if (!(seconds >= 0.0 && seconds < 1e9)) {
        snprintf(text, size, "unknown");
        return;
    }
    const long s = lround(seconds);
    if (s < 60)
        snprintf(text, size, "%ld s", s);
    else if (s < 3600)
        snprintf(text, size, "%ld min %02ld s", s / 60, s % 60);
    else if (s < 86400)
        snprintf(text, size, "%ld h %02ld min", s / 3600, s / 60 % 60);
    else
        snprintf(text, size, "%ld d %02ld h", s / 86400, s / 3600 % 24);
}

static double plain_interval(void)
{
    const char *wanted = getenv("BREECH_PROGRESS");
    char *end;
    const double seconds = wanted ? strtod(wanted, &end) : NAN;
    return wanted && end != wanted && *end == '\0' && seconds >= 0.0 ? seconds : PLAIN_INTERVAL;
}

void host_progress_open(progress *p, FILE *stream, bool quiet)
{
    memset(p, 0, sizeof *p);
    p->stream = stream;
    p->quiet = quiet;
    p->terminal = isatty(fileno(stream)) == 1;
    p->interval = p->terminal ? TERMINAL_INTERVAL : plain_interval();
    p->started = p->last_shown = host_wall_clock();
}

void host_progress_task(progress *p, const char *task, double fraction, uint64_t particle_steps)
{
    host_progress_close(p);
    snprintf(p->task, sizeof p->task, "%s", task);
    p->started = host_wall_clock();
    p->last_shown = p->terminal ? p->started - TERMINAL_INTERVAL : p->started;
    p->fraction_started = fraction;
    p->steps_started = particle_steps;
}

void host_progress_text(const progress *p, double fraction, double elapsed, uint64_t particle_steps, char *text,
                        size_t size)
{
    const double done = fmin(fmax(fraction, 0.0), 1.0), gained = done - p->fraction_started;
    int n = snprintf(text, size, "%s  %.0f %%", p->task, floor(100.0 * done));
    if (gained > 0.0 && elapsed > 0.0 && n > 0 && (size_t)n < size) {
        char left[32];
        host_duration_text(elapsed * (1.0 - done) / gained, left, sizeof left);
        n += snprintf(text + n, size - (size_t)n, "  %s left", left);
    }
    const double rate = elapsed > 0.0 ? (double)(particle_steps - p->steps_started) / elapsed : 0.0;
    if (particle_steps > p->steps_started && rate > 0.0 && n > 0 && (size_t)n < size)
        snprintf(text + n, size - (size_t)n, "  %.1f M point-steps/s", 1e-6 * rate);
}

void host_progress_update(progress *p, double fraction, uint64_t particle_steps)
{
    if (p->quiet) return;
    const double now = host_wall_clock();
    if (now - p->last_shown < p->interval) return;
    char text[300];
    host_progress_text(p, fraction, now - p->started, particle_steps, text, sizeof text);
    struct winsize w; /* a live line that wraps would not be cleared */
    if (p->terminal && ioctl(fileno(p->stream), TIOCGWINSZ, &w) == 0 && w.ws_col > 1 && w.ws_col < sizeof text)
        text[w.ws_col - 1] = '\0';
    fprintf(p->stream, p->terminal ? "\r\033[K%s" : "%s\n", text);
    fflush(p->stream);
    p->shown = p->terminal;
    p->last_shown = now;
}

static void say(progress *p, const char *before, const char *format, va_list args)
{
    host_progress_close(p);
    fputs(before, p->stream);
    vfprintf(p->stream, format, args);
    fputc('\n', p->stream);
    fflush(p->stream);
}

void host_progress_say(progress *p, const char *format, ...)
{
    if (p->quiet) return;
    va_list args;
    va_start(args, format);
    say(p, "", format, args);
    va_end(args);
}

void host_progress_warn(progress *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(p, "warning: ", format, args);
    va_end(args);
}

void host_progress_close(progress *p)
{
    if (p->shown) {
        fputs("\r\033[K", p->stream);
        fflush(p->stream);
    }
    p->shown = false;
}

/* ---- where the time went ---- */

void host_timing_open(timing *t)
{
    memset(t, 0, sizeof *t);
    t->started = host_wall_clock();
}

/* Past the last place everything goes into the last phase made: nothing is lost, the name says "others". */
void host_timing_add(timing *t, const char *phase, double seconds)
{
    int i = 0;
    while (i < t->phases && strcmp(t->phase[i].name, phase) != 0) i++;
    if (i == t->phases) {
        if (t->phases == TIMING_MAX_PHASES)
            i = TIMING_MAX_PHASES - 1;
        else
            t->phases++;
        snprintf(t->phase[i].name, sizeof t->phase[i].name, "%s", i == TIMING_MAX_PHASES - 1 ? "others" : phase);
    }
    t->phase[i].seconds += seconds;
    t->phase[i].calls++;
}

void host_timing_print(const timing *t, FILE *out)
{
    const double total = host_wall_clock() - t->started;
    double booked = 0.0;
    int width = 5;
    for (int i = 0; i < t->phases; i++) {
        booked += t->phase[i].seconds;
        const int w = (int)strlen(t->phase[i].name);
        if (w > width) width = w;
    }
    const double unit = total > 0.0 ? 100.0 / total : 0.0;
    fprintf(out, "%-*s  %8s  %10s  %6s\n", width, "phase", "calls", "time [s]", "part");
    for (int i = 0; i < t->phases; i++)
        fprintf(out, "%-*s  %8llu  %10.3f  %4.0f %%\n", width, t->phase[i].name, (unsigned long long)t->phase[i].calls,
                t->phase[i].seconds, unit * t->phase[i].seconds);
    const double other = fmax(total - booked, 0.0);
    fprintf(out, "%-*s  %8s  %10.3f  %4.0f %%\n", width, "other", "", other, unit * other);
    fprintf(out, "%-*s  %8s  %10.3f  %4.0f %%\n", width, "total", "", total, 100.0);
}
