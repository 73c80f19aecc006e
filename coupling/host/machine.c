/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/machine.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 2048 };

/* Of the machine. */
static double installed(const char *root)
{
    char path[PATH_SIZE], line[200];
    double kilobytes = INFINITY;
    snprintf(path, sizeof path, "%.1000s/proc/meminfo", root);
    FILE *f = fopen(path, "r");
    if (!f) return INFINITY;
    while (fgets(line, sizeof line, f) && sscanf(line, "MemTotal: %lf kB", &kilobytes) != 1) continue;
    fclose(f);
    return 1024.0 * kilobytes;
}

static double limit_in(const char *path)
{
    double limit;
    FILE *f = fopen(path, "r");
    if (!f) return INFINITY;
    const bool is_number = fscanf(f, "%lf", &limit) == 1; /* else "max" */
    fclose(f);
    return is_number ? limit : INFINITY;
}

/* Of a group and of all above it; what is inside a container has its own group at the top. */
static double limit_up(const char *top, char *group, const char *file)
{
    char path[PATH_SIZE];
    double limit = INFINITY;
    for (;;) {
        snprintf(path, sizeof path, "%.1000s%.900s/%s", top, group, file);
        limit = fmin(limit, limit_in(path));
        char *slash = strrchr(group, '/');
        if (!slash) return limit;
        *slash = '\0';
    }
}

/* A line of /proc/self/cgroup: "0::/group" of version 2, "4:memory:/group" of version 1. */
static double limit_of_line(const char *root, char *line)
{
    char top[PATH_SIZE];
    line[strcspn(line, "\n")] = '\0';
    char *kind = strchr(line, ':'), *group = kind ? strchr(kind + 1, ':') : NULL;
    if (!group) return INFINITY;
    const bool unified = group == kind + 1, memory = strncmp(kind, ":memory:", 8) == 0;
    if (!unified && !memory) return INFINITY;
    snprintf(top, sizeof top, "%.900s/sys/fs/cgroup%s", root, memory ? "/memory" : "");
    return limit_up(top, group + 1, memory ? "memory.limit_in_bytes" : "memory.max");
}

double host_memory(const char *root)
{
    char path[PATH_SIZE], line[PATH_SIZE];
    double limit = installed(root);
    snprintf(path, sizeof path, "%.1000s/proc/self/cgroup", root);
    FILE *f = fopen(path, "r");
    if (!f) return limit;
    while (fgets(line, sizeof line, f)) limit = fmin(limit, limit_of_line(root, line));
    fclose(f);
    return limit;
}
