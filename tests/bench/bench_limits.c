/* SPDX-License-Identifier: BSD-3-Clause */
/* What the machine can do at most, for the roofline of docs/notes/speed.md: memory bandwidth by a triad over
 * arrays that no cache holds, arithmetic by independent multiply-adds in registers, division.
 *
 *   breech_bench_limits [--tiny]
 *
 * Best of ten, on one thread and on all. */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef double v8 __attribute__((vector_size(64)));

enum { REPEATS = 10, CHAINS = 12 };
static long array = 16 << 20; /* doubles */
static int rounds = 2000000;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BEST_SET __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), noinline))
#else
#define BEST_SET __attribute__((noinline))
#endif

static double *allocate(void)
{
    double *a = malloc((size_t)array * sizeof *a);
    if (!a) exit(1);
#pragma omp parallel for schedule(static)
    for (long i = 0; i < array; i++) a[i] = 1.0;
    return a;
}

/* a = b + s c: two reads, one write and the read that a write begins with [GB/s] */
static double triad(double *a, const double *b, const double *c, int threads)
{
    double best = 0.0;
    for (int r = 0; r < REPEATS; r++) {
        const double start = omp_get_wtime();
#pragma omp parallel for schedule(static) num_threads(threads)
        for (long i = 0; i < array; i++) a[i] = b[i] + 0.5 * c[i];
        const double rate = 4e-9 * (double)array * sizeof(double) / (omp_get_wtime() - start);
        if (rate > best) best = rate;
    }
    return best;
}

BEST_SET static double multiply_adds(double seed)
{
    v8 x[CHAINS];
    const v8 a = { seed, seed, seed, seed, seed, seed, seed, seed };
    for (int k = 0; k < CHAINS; k++) x[k] = a * k;
    for (int i = 0; i < rounds; i++)
#pragma GCC unroll 12
        for (int k = 0; k < CHAINS; k++) x[k] = x[k] * a + a;
    double sum = 0.0;
    for (int k = 0; k < CHAINS; k++)
        for (int l = 0; l < 8; l++) sum += x[k][l];
    return sum;
}

BEST_SET static double divisions(double seed)
{
    v8 x[4];
    const v8 a = { seed, seed, seed, seed, seed, seed, seed, seed };
    for (int k = 0; k < 4; k++) x[k] = a + k;
    for (int i = 0; i < rounds; i++)
#pragma GCC unroll 4
        for (int k = 0; k < 4; k++) x[k] = a / x[k];
    return x[0][0] + x[1][1] + x[2][2] + x[3][3];
}

/* Seconds for one call on each of `threads`, the least. */
static double timed(double (*work)(double), int threads, double *sink)
{
    double best = 1e9;
    for (int r = 0; r < 5; r++) {
        double sum = 0.0;
        const double start = omp_get_wtime();
#pragma omp parallel num_threads(threads) reduction(+ : sum)
        sum += work(0.999);
        const double t = omp_get_wtime() - start;
        if (t < best) best = t;
        *sink += sum;
    }
    return best;
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--tiny") == 0) array = 1 << 12, rounds = 1000;
    double *a = allocate(), *b = allocate(), *c = allocate(), sink = 0.0;
    for (int threads = 1; threads <= omp_get_max_threads(); threads *= 2) {
        const double fma = timed(multiply_adds, threads, &sink), division = timed(divisions, threads, &sink);
        printf("%d threads: triad %.1f GB/s, multiply-adds %.1f Gflop/s, division of eight %.2f ns\n", threads,
               triad(a, b, c, threads), 2e-9 * 8.0 * CHAINS * rounds * threads / fma, 1e9 * division / (4.0 * rounds));
    }
    free(a), free(b), free(c);
    return sink == 0.123; /* keeps the work from being optimised away */
}
