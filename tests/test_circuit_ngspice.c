/* SPDX-License-Identifier: BSD-3-Clause */
/* The same shot by ngspice, from a netlist written here out of the configuration: armature and rails as behavioural
 * sources, flux form.  Both must agree to 0.1 %, and ngspice must take at least five times as long at its own error.
 * Skipped where BREECH_FULL is not 1 or ngspice (Debian package) is not there. */
#include "tests/circuit_common.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <spawn.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "full_common.h"
#include "status_common.h"

extern char **environ;

enum { GROUPS = 16 };

/* ---- the netlist ---- */

static void put_module(FILE *f, const circuit_shot_module *m, int k)
{
    const double n = m->count;
    fprintf(f, "C%d c%d 0 %.12g IC=%.12g\n", k, k, n * m->capacitance, m->charge);
    fprintf(f, "Vd%d d%d c%d %.12g\nDc%d 0 d%d DC%d\n", k, k, k, m->crowbar_drop, k, k, k);
    fprintf(f, ".model DC%d D(IS=1e-3 N=0.5 RS=%.12g)\n", k, m->crowbar_resistance / n);
    fprintf(f, "L%d c%d l%d %.12g IC=0\n", k, k, k, (m->inductance + m->cable_inductance) / n);
    fprintf(f, "R%d l%d r%d %.12g\n", k, k, k, (m->resistance + m->cable_resistance) / n);
    fprintf(f, "Vg%d g%d 0 PULSE(0 1 %.12g 1n 1n 1 2)\nS%d r%d s%d g%d 0 GATE\nDt%d s%d b DT\n", k, k, m->fire_at, k, k,
            k, k, k, k);
}

/* The diodes are as sharp as ngspice bears: about 0.2 V at 100 kA, of the 500 V of the module's own resistance. */
/* V(x), V(v): position and speed, capacitors of 1 F; V(phi) = L' x I, its derivative the current of 1 F. */
static void put_barrel(FILE *f, const circuit_shot_config *c)
{
    const circuit_shot_armature *a = &c->armature;
    const double L = c->rails.inductance_gradient, sound = sqrt(a->gas_gamma * a->gas_pressure / a->gas_density);
    fprintf(f, "Vi b q 0\nBv q 0 V=I(Vp)+(%.12g*V(x)+%.12g)*I(Vi)+%.12g*tanh(I(Vi)/50)\n", c->rails.resistance_gradient,
            a->resistance, a->contact_voltage);
    fprintf(f, "Bp phi 0 V=%.12g*V(x)*I(Vi)\nVp phi pc 0\nCp pc 0 1 IC=0\n", L);
    fprintf(f, "Cx x 0 1 IC=%.12g\nBx 0 x I=V(v)\nCv v 0 1 IC=%.12g\n", c->barrel.start, a->velocity);
    fprintf(f, "Bf 0 v I=(0.5*%.12g*I(Vi)*I(Vi)", L);
    fprintf(f, "-2*(%.12g+%.12g*exp(-V(v)/%.12g))*(%.12g+%.12g*I(Vi)*I(Vi))", a->friction_melted,
            a->friction_dry - a->friction_melted, a->friction_speed, a->preload, a->spreading);
    fprintf(f, "-%.12g*V(v)*(%.12g*V(v)+sqrt(%.12g*V(v)*V(v)+%.12g)))/%.12g\n",
            a->gas_density * c->rails.height * c->rails.separation, 0.25 * (a->gas_gamma + 1.0),
            pow(0.25 * (a->gas_gamma + 1.0), 2.0), sound * sound, a->mass);
}

static void write_netlist(const char *path, const circuit_shot_config *c, double end, double step)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs("* a shot\n.model GATE SW(RON=1e-6 ROFF=1e5 VT=0.5 VH=0.1)\n.model DT D(IS=1e-3 N=0.5 RS=1e-6)\n", f);
    for (int k = 0; k < c->supplies[CIRCUIT_SUPPLY_capacitor].n; k++)
        put_module(f, (const circuit_shot_module *)c->supplies[CIRCUIT_SUPPLY_capacitor].item + k, k);
    put_barrel(f, c);
    fprintf(f, ".options reltol=1e-4 method=gear itl4=200\n.tran %g %g 0 %g uic\n", step, end, step);
    fprintf(f, ".meas tran vexit FIND V(v) WHEN V(x)=%.12g\n.meas tran texit WHEN V(x)=%.12g\n", c->barrel.length,
            c->barrel.length);
    fputs(".meas tran ipeak MAX I(Vi)\n.end\n", f);
    assert_int_equal(fclose(f), 0);
}

static void write_nothing(const char *path)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs("* nothing\nV1 a 0 1\nR1 a 0 1\n.tran 1 1\n.end\n", f);
    assert_int_equal(fclose(f), 0);
}

/* ---- running it ---- */

static double children_seconds(void)
{
    struct rusage u;
    assert_int_equal(getrusage(RUSAGE_CHILDREN, &u), 0);
    return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

/* Processor's time; < 0: there is no ngspice. */
static double ngspice(const char *netlist, const char *log)
{
    posix_spawn_file_actions_t files;
    assert_int_equal(posix_spawn_file_actions_init(&files), 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    char name[] = "ngspice", batch[] = "-b", file[200];
    snprintf(file, sizeof file, "%s", netlist);
    char *const argv[] = { name, batch, file, NULL };
    const double before = children_seconds();
    pid_t child;
    const int bad = posix_spawnp(&child, name, &files, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&files);
    if (bad) return -1.0;
    int result = 0;
    while (waitpid(child, &result, 0) < 0) assert_int_equal(errno, EINTR);
    if (WIFEXITED(result) && WEXITSTATUS(result) == 127) return -1.0;
    return children_seconds() - before;
}

static double measured(const char *log, const char *key)
{
    FILE *f = fopen(log, "r");
    assert_non_null(f);
    char line[400];
    double value = NAN;
    while (fgets(line, sizeof line, f)) {
        char *equals = strchr(line, '=');
        if (strncmp(line, key, strlen(key)) == 0 && equals) value = strtod(equals + 1, NULL);
    }
    fclose(f);
    if (isnan(value)) fail_msg("ngspice gave no %s: see %s", key, log);
    return value;
}

static bool until_muzzle(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    (void)user;
    (void)s;
    return e->kind != CIRCUIT_SHOT_MUZZLE;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static circuit_shot_summary shoot(circuit_shot_config c, double rtol, double *took)
{
    const circuit_shot_sink sink = { .event = until_muzzle };
    circuit_shot *s = NULL;
    c.options.rtol = rtol;
    c.options.atol = 0.01 * rtol;
    const double since = now();
    OK(circuit_shot_create(&c, &s));
    assert_int_equal(circuit_shot_advance(s, INFINITY, &sink).code, STATUS_STOPPED);
    *took = now() - since;
    const circuit_shot_summary r = circuit_shot_result(s);
    circuit_shot_free(s);
    return r;
}

static void same_shot(void **state)
{
    (void)state;
    write_nothing("nothing.cir");
    const double idle = full_tests() ? ngspice("nothing.cir", "nothing.log") : -1.0;
    if (idle < 0.0) skip();
    circuit_shot_module m[GROUPS];
    for (int k = 0; k < GROUPS; k++) {
        m[k] = unit_200kJ(1, k < 4 ? 0.0 : (k - 3) * 2e-4);
        m[k].cable_inductance = 1e-6;
        m[k].cable_resistance = 1e-3;
    }
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ GROUPS, m };
    c.armature.velocity = 10.0;
    c.barrel.length = 4.0;
    double took;
    const circuit_shot_summary exact = shoot(c, 1e-12, &took);
    for (int k = 0; k < 2; k++) { /* two maximal steps: its error, and what less of it costs */
        const double step = k == 0 ? 2e-6 : 5e-7;
        write_netlist("shot.cir", &c, 1.05 * exact.muzzle_time, step);
        const double spice = ngspice("shot.cir", "shot.log") - idle, v = measured("shot.log", "vexit");
        const double error = fabs(v / exact.muzzle_velocity - 1.0), peak = measured("shot.log", "ipeak");
        double rtol = 1e-3, own = INFINITY, own_error = INFINITY;
        for (; rtol > 1e-9; rtol *= 0.1) {
            own_error = fabs(shoot(c, rtol, &took).muzzle_velocity / exact.muzzle_velocity - 1.0);
            if (own_error <= error) break;
        }
        for (int r = 0; r < 5; r++) {
            (void)shoot(c, rtol, &took);
            own = fmin(own, took);
        }
        print_message("ngspice, steps to %.1e s: %.3f m/s (%.3f), off by %.1e, peak off by %.1e, %.3f s; breech at "
                      "rtol %.0e: %.1e, "
                      "%.4f s: %.1f times faster\n",
                      step, v, exact.muzzle_velocity, error, fabs(peak / exact.peak_current - 1.0), spice, rtol,
                      own_error, own, spice / own);
        assert_true(error < 1e-3 && fabs(peak / exact.peak_current - 1.0) < 1e-3);
        assert_true(fabs(measured("shot.log", "texit") / exact.muzzle_time - 1.0) < 1e-3);
        assert_true(spice > 5.0 * own);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(same_shot) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
