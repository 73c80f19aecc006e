/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/report/report_gnuplot.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAX_POINTS = 1500 };

extern char **environ;

static const struct {
    const char *outcome, *colour;
} colours[] = { { "gouge", "#c0392b" },     { "scratch", "#d99a00" }, { "none", "#3d8b4f" },
                { "undecided", "#7b5ea7" }, { "skipped", "#8fb8dc" }, { "not_reached", "#b0b0b0" } };
_Static_assert(sizeof colours / sizeof *colours == OUTCOMES, "a colour an outcome");

const char *report_colour(const char *outcome)
{
    for (int i = 0; i < OUTCOMES; i++)
        if (strcmp(colours[i].outcome, outcome) == 0) return colours[i].colour;
    return "#555555";
}

/* ---- gnuplot: a script file in, an SVG file out, no shell ---- */

static int run_gnuplot(const char *script, const char *svg)
{
    posix_spawn_file_actions_t files;
    if (posix_spawn_file_actions_init(&files) != 0) return ENOMEM;
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, script, O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, svg, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    char name[] = "gnuplot", quiet[] = "-d";
    char *const argv[] = { name, quiet, NULL };
    pid_t child;
    int error = posix_spawnp(&child, "gnuplot", &files, NULL, argv, environ), result = 0;
    posix_spawn_file_actions_destroy(&files);
    if (error) return error;
    while (waitpid(child, &result, 0) < 0)
        if (errno != EINTR) return errno;
    if (WIFEXITED(result) && WEXITSTATUS(result) == 0) return 0;
    return WIFEXITED(result) && WEXITSTATUS(result) == 127 ? ENOENT : EIO;
}

bool report_gnuplot_exists(void)
{
    return run_gnuplot("/dev/null", "/dev/null") == 0;
}

status report_plot_begin(plot *p, const report_source *r, const char *name, int width, int height)
{
    const int n = snprintf(p->svg, sizeof p->svg, "%.900s/plot-%.80s.svg", r->dir, name);
    CHECK(n > 0 && n < OUTDIR_PATH_SIZE - 16, STATUS_IO, "%.300s: path too long", r->dir);
    snprintf(p->part, sizeof p->part, "%.1000s.part", p->svg);
    snprintf(p->script_path, sizeof p->script_path, "%.1000s.gp.part", p->svg);
    p->script = fopen(p->script_path, "w");
    CHECK(p->script, STATUS_IO, "%.300s: cannot be written: %s", p->script_path, strerror(errno));
    char id[100]; /* gnuplot wants an identifier */
    snprintf(id, sizeof id, "plot_%s", name);
    for (char *c = id; *c; c++)
        if (!isalnum((unsigned char)*c)) *c = '_';
    fprintf(p->script,
            "set encoding utf8\nset terminal svg size %d,%d dynamic noenhanced font 'sans-serif,13' name '%s'\n", width,
            height, id);
    fputs("set border 3 lc rgb '#666666'\nset tics nomirror textcolor rgb '#333333'\nset grid lc rgb '#e4e4e4' lw 1\n"
          "set key outside top center horizontal samplen 1.5 spacing 1.1\nset datafile missing 'nan'\n",
          p->script);
    return status_ok();
}

status report_plot_end(plot *p)
{
    const bool written = !ferror(p->script);
    const bool closed = fclose(p->script) == 0;
    const int error = written && closed ? run_gnuplot(p->script_path, p->part) : EIO;
    unlink(p->script_path);
    if (!error && rename(p->part, p->svg) == 0) return status_ok();
    unlink(p->part);
    return base_status_error(STATUS_IO, "%.300s: gnuplot could not draw it: %s", p->svg,
                             strerror(error ? error : errno));
}

/* A named data block of two columns, thinned to what a screen shows; the last point is kept. */
void report_plot_data(FILE *script, const char *name, const double *x, const double *y, size_t n)
{
    const size_t stride = n / MAX_POINTS + 1;
    fprintf(script, "$%s << EOD\n", name);
    for (size_t i = 0; i < n; i += stride) fprintf(script, "%.7g %.7g\n", x[i], y[i]);
    if (n > 0 && (n - 1) % stride != 0) fprintf(script, "%.7g %.7g\n", x[n - 1], y[n - 1]);
    fputs("EOD\n", script);
}

int report_plot_outcome_data(FILE *script, const report_source *r, const point_source *from, bool used[OUTCOMES])
{
    int total = 0;
    for (int o = 0; o < OUTCOMES; o++) {
        used[o] = false;
        fprintf(script, "$%s << EOD\n", colours[o].outcome);
        const cJSON *item;
        cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(r->summary, from->list))
        {
            const double x = report_number(item, from->x) / from->x_unit, y = report_number(item, from->y);
            if (strcmp(report_text(item, from->outcome_key), colours[o].outcome) != 0 || isnan(x) || isnan(y)) continue;
            fprintf(script, "%.7g %.7g\n", x, y);
            used[o] = true;
            total++;
        }
        fputs("EOD\n", script);
    }
    return total;
}

void report_plot_outcomes(FILE *script, const bool used[OUTCOMES], bool first)
{
    for (int o = 0; o < OUTCOMES; o++) {
        if (!used[o]) continue;
        fprintf(script, "%s$%s with points pt 7 ps 0.9 lc rgb '%s' title '%s'", first ? "" : ", ", colours[o].outcome,
                colours[o].colour, colours[o].outcome);
        first = false;
    }
    fputc('\n', script);
}

const char report_gouge_band[] = "#e58a7f", report_scratch_band[] = "#e9cf8a";

void report_plot_band(FILE *script, int object, const cJSON *summary, const char *key, bool along_x, const char *colour)
{
    const double lo = report_element(summary, key, 0), hi = report_element(summary, key, 1);
    if (isnan(lo) || isnan(hi)) return;
    if (along_x)
        fprintf(script, "set object %d rectangle from %.7g,graph 0 to %.7g,graph 1", object, lo, hi);
    else
        fprintf(script, "set object %d rectangle from graph 0,first %.7g to graph 1,first %.7g", object, lo, hi);
    fprintf(script, " behind fillstyle solid 0.25 noborder fillcolor rgb '%s'\n", colour);
}
