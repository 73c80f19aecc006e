/* SPDX-License-Identifier: BSD-3-Clause */
/* Speed of a shot: error against run time over rtol, for three shots.
 *
 *   breech_bench_shot [--tiny] [repetitions]
 *
 * Error: of the muzzle velocity, against the same shot at rtol 1e-13; atol = rtol.  Time: the processor's, of
 * circuit_shot_advance from start to exit, one thread, the least of the repetitions; the ladder is fitted once,
 * beforehand (its time is the first line's).  Nothing is judged here: what is printed holds for this machine and
 * whatever else ran on it. */
#include "circuit/shot_model.h"
#include "tests/circuit_common.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { UNITS = 16, MAX_GROUPS = 64 };

typedef struct {
    const char *name, *text;
    circuit_shot_module module[MAX_GROUPS];
    circuit_shot_config config;
} bench_shot;

static void die(status s)
{
    if (s.code == STATUS_OK) return;
    fprintf(stderr, "bench_shot: %s\n", s.text);
    exit(1);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t); /* others on the machine do not count */
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void set_units(bench_shot *b, int groups, int first, double spacing)
{
    for (int k = 0; k < groups; k++) {
        b->module[k] = unit_200kJ(k == 0 ? first : 1, k * spacing);
        b->module[k].cable_inductance = 1e-6;
        b->module[k].cable_resistance = 1e-3;
    }
    b->config = plain_barrel();
    b->config.barrel.length = 4.0;
    b->config.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ groups, b->module };
}

/* 16 modules, each a group of its own, 4 m: the issue's.  Then all at once, and spread along the barrel. */
static void set_shots(bench_shot *b)
{
    b[0].name = "sixteen", b[0].text = "16 units, one after another, 4 m, diffusing rails";
    set_units(&b[0], UNITS, 1, 2e-4);
    for (int k = 0; k < 4; k++) b[0].module[k].fire_at = 0.0;
    b[0].config.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    b[1].name = "skin", b[1].text = "the same at level skin";
    set_units(&b[1], UNITS, 1, 2e-4);
    for (int k = 0; k < 4; k++) b[1].module[k].fire_at = 0.0;
    b[1].config.rails.level = CIRCUIT_SHOT_RAILS_SKIN;
    b[2].name = "distributed", b[2].text = "10 units at the breech, 6 along 4 m, diffusing rails";
    set_units(&b[2], 7, 10, 0.0);
    for (int k = 1; k < 7; k++) b[2].module[k].position = 0.5 * k;
    b[2].config.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
}

static bool until_muzzle(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    (void)user;
    (void)s;
    return e->kind != CIRCUIT_SHOT_MUZZLE;
}

/* Least time of the repetitions; the muzzle velocity and the steps. */
static double run(const bench_shot *b, double rtol, int repetitions, circuit_shot_summary *out)
{
    double least = INFINITY;
    const circuit_shot_sink sink = { .event = until_muzzle };
    circuit_shot_config c = b->config;
    c.options.rtol = rtol;
    c.options.atol = rtol;
    for (int r = 0; r < repetitions; r++) {
        circuit_shot *s = NULL;
        die(circuit_shot_create(&c, &s));
        const double since = seconds();
        const status done = circuit_shot_advance(s, INFINITY, &sink);
        if (done.code != STATUS_STOPPED) die(done);
        least = fmin(least, seconds() - since);
        *out = circuit_shot_result(s);
        circuit_shot_free(s);
    }
    return least;
}

static void curve(bench_shot *b, bool tiny, int repetitions)
{
    circuit_ladder fitted;
    circuit_shot_summary exact, got;
    double since = seconds();
    circuit_rails_load load;
    die(circuit_shot_rails_fit(&b->config, &load));
    fitted = load.ladder;
    printf("%s: %s; %d rungs, fitted in %.0f ms\n", b->name, b->text, fitted.n, 1e3 * (seconds() - since));
    b->config.fitted = &fitted;
    run(b, tiny ? 1e-9 : 1e-13, 1, &exact);
    printf("  muzzle velocity %.6f m/s after %.4f ms\n", exact.muzzle_velocity, 1e3 * exact.muzzle_time);
    for (int k = tiny ? 10 : 6; k <= (tiny ? 10 : 20); k++) {
        const double rtol = pow(10.0, -0.5 * k), took = run(b, rtol, repetitions, &got);
        printf("  rtol %.1e  error %8.1e  %8.3f ms  %6llu steps\n", rtol,
               fabs(got.muzzle_velocity / exact.muzzle_velocity - 1.0), 1e3 * took, (unsigned long long)got.steps);
    }
    b->config.fitted = NULL;
}

int main(int argc, char **argv)
{
    const bool tiny = argc > 1 && strcmp(argv[1], "--tiny") == 0;
    const int repetitions = tiny ? 1 : argc > 1 ? atoi(argv[1]) : 7;
    static bench_shot shots[3];
    set_shots(shots);
    for (int k = 0; k < (tiny ? 1 : 3); k++) curve(&shots[k], tiny, repetitions);
    return 0;
}
