/* SPDX-License-Identifier: BSD-3-Clause */
/* Rail sections: error against run time over the mesh, all frequencies up to 20 kHz from one solution.
 *
 * Error: the largest over 1 Hz .. 20 kHz of L' and R', against the same section at the finest mesh.  Time: processor
 * time of one solution, least of three.  The last column is Kerrisk's formula against the perfect conductor, where it
 * applies. */
#include "base/constants.h"
#include "circuit/rails/inductance.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define TOP 20e3 /* [Hz] */
enum { POINTS = 25 };

typedef struct {
    const char *name;
    circuit_rail_section section;
} sample;

#define COPPER .resistivity = 1.72e-8
static const sample samples[] = {
    { "25 x 20 x 25 mm", { 0.025, 0.020, 0.025, COPPER, .rails = 2 } },
    { "narrow gap, s/h 0.05", { 0.025, 0.020, 0.00125, COPPER, .rails = 2 } },
    { "thin, w 1 mm", { 0.025, 0.001, 0.025, COPPER, .rails = 2 } },
    { "D", { 0.025, 0.020, 0.025, COPPER, .back_crown = 0.0125, .rails = 2 } },
    { "convex faces", { 0.025, 0.020, 0.025, COPPER, .face_crown = 0.003, .rails = 2 } },
    { "round", { 0.025, 0.025, 0.025, COPPER, .face_crown = 0.0125, .back_crown = 0.0125, .rails = 2 } },
    { "clad, 1 mm of 5 rho",
      { 0.025, 0.020, 0.025, COPPER, .cladding = 0.001, .cladding_resistivity = 8.6e-8, .rails = 2 } },
    { "four", { 0.020, 0.020, 0.025, COPPER, .rails = 4 } },
};
enum { SAMPLES = sizeof samples / sizeof samples[0] };

typedef struct {
    double L[POINTS], R[POINTS], seconds;
    int filaments;
} curve;

static void must(status s)
{
    if (s.code == STATUS_OK) return;
    fprintf(stderr, "%s\n", s.text);
    exit(1);
}

static double processor_time(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static curve solve(const circuit_rail_section *s, double fineness, int repetitions)
{
    curve c = { .seconds = INFINITY };
    for (int k = 0; k < repetitions; k++) {
        circuit_impedance z;
        const double since = processor_time();
        must(circuit_inductance_response(s, TOP, fineness, &z));
        for (int i = 0; i < POINTS; i++) {
            const double omega = 2.0 * PI * pow(TOP, i / (POINTS - 1.0));
            const double complex Z = circuit_impedance_at(&z, _Complex_I * omega);
            c.L[i] = cimag(Z) / omega;
            c.R[i] = creal(Z);
        }
        c.seconds = fmin(c.seconds, processor_time() - since);
        c.filaments = z.n;
        circuit_impedance_free(&z);
    }
    return c;
}

static double difference(const double *a, const double *b)
{
    double worst = 0.0;
    for (int i = 0; i < POINTS; i++) worst = fmax(worst, fabs(a[i] / b[i] - 1.0));
    return worst;
}

int main(int argc, char **argv)
{
    const bool tiny = argc > 1 && strcmp(argv[1], "--tiny") == 0;
    const double finest = tiny ? 3.0 : 14.0;
    for (int k = 0; k < SAMPLES; k++) {
        const circuit_rail_section *s = &samples[k].section;
        const curve best = solve(s, finest, 1);
        double limit = 0.0;
        must(circuit_inductance_limit(s, &limit));
        printf("%s: L'(inf) %.4f uH/m, finest mesh %d filaments", samples[k].name, 1e6 * limit, best.filaments);
        if (s->rails == 2 && s->face_crown == 0.0 && s->back_crown == 0.0)
            printf(", Kerrisk %+.2f %%",
                   100.0 * (circuit_inductance_kerrisk(s->height, s->thickness, s->separation) / limit - 1.0));
        printf("\n  fineness filaments    ms   L' off   R' off\n");
        for (double fineness = 1.5; fineness < finest - 1.0; fineness *= sqrt(2.0)) {
            const curve c = solve(s, fineness, tiny ? 1 : 3);
            printf("  %8.2f %9d %6.1f %7.3f%% %7.3f%%\n", fineness, c.filaments, 1e3 * c.seconds,
                   100.0 * difference(c.L, best.L), 100.0 * difference(c.R, best.R));
        }
        const curve normal = solve(s, INDUCTANCE_FINENESS, tiny ? 1 : 3);
        printf("  default  %9d %6.1f %7.3f%% %7.3f%%\n", normal.filaments, 1e3 * normal.seconds,
               100.0 * difference(normal.L, best.L), 100.0 * difference(normal.R, best.R));
    }
    return 0;
}
