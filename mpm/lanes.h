/* Eight particles at a time: one GCC vector of eight doubles, whatever the machine's own width is. */
#ifndef BREECH_MPM_LANES_H
#define BREECH_MPM_LANES_H

#include <stdint.h>

enum { LANES = 8 };

typedef double v8 __attribute__((vector_size(64), aligned(64)));
typedef int64_t m8 __attribute__((vector_size(64), aligned(64))); /* all ones where true */

#define LANE_INLINE static inline __attribute__((always_inline))

LANE_INLINE v8 v8_set(double a)
{
    return (v8){ a, a, a, a, a, a, a, a };
}

LANE_INLINE v8 v8_load(const double *p) /* 64-byte aligned */
{
    return *(const v8 *)(const void *)p;
}

LANE_INLINE void v8_store(double *p, v8 a)
{
    *(v8 *)(void *)p = a;
}

/* gcc splits the arithmetic of v8 into the vectors a machine has, but takes comparisons and masks apart into single
 * numbers: where vectors are narrower those work on the parts. */
#if defined(__AVX512F__)
enum { LANES_PART = 8 };
#elif defined(__AVX__)
enum { LANES_PART = 4 };
#else
enum { LANES_PART = 2 };
#endif
typedef double part_v __attribute__((vector_size(8 * LANES_PART)));
typedef int64_t part_m __attribute__((vector_size(8 * LANES_PART)));
typedef union {
    v8 v;
    m8 m;
    part_v pv[LANES / LANES_PART];
    part_m pm[LANES / LANES_PART];
} lane_parts;

LANE_INLINE m8 v8_less(v8 a, v8 b)
{
    lane_parts x = { .v = a }, y = { .v = b };
    for (int i = 0; i < LANES / LANES_PART; i++) x.pm[i] = x.pv[i] < y.pv[i];
    return x.m;
}

LANE_INLINE m8 v8_at_least(v8 a, v8 b) /* a >= b */
{
    lane_parts x = { .v = a }, y = { .v = b };
    for (int i = 0; i < LANES / LANES_PART; i++) x.pm[i] = x.pv[i] >= y.pv[i];
    return x.m;
}

LANE_INLINE m8 m8_and(m8 a, m8 b)
{
    lane_parts x = { .m = a }, y = { .m = b };
    for (int i = 0; i < LANES / LANES_PART; i++) x.pm[i] &= y.pm[i];
    return x.m;
}

LANE_INLINE m8 m8_or(m8 a, m8 b)
{
    lane_parts x = { .m = a }, y = { .m = b };
    for (int i = 0; i < LANES / LANES_PART; i++) x.pm[i] |= y.pm[i];
    return x.m;
}

LANE_INLINE v8 v8_select(m8 mask, v8 yes, v8 no)
{
    lane_parts m = { .m = mask }, y = { .v = yes }, n = { .v = no };
    for (int i = 0; i < LANES / LANES_PART; i++) m.pm[i] = (y.pm[i] & m.pm[i]) | (n.pm[i] & ~m.pm[i]);
    return m.v;
}

LANE_INLINE v8 v8_min(v8 a, v8 b)
{
    lane_parts x = { .v = a }, y = { .v = b };
    for (int i = 0; i < LANES / LANES_PART; i++) {
        const part_m less = x.pv[i] < y.pv[i];
        x.pm[i] = (x.pm[i] & less) | (y.pm[i] & ~less);
    }
    return x.v;
}

LANE_INLINE v8 v8_max(v8 a, v8 b)
{
    lane_parts x = { .v = a }, y = { .v = b };
    for (int i = 0; i < LANES / LANES_PART; i++) {
        const part_m more = x.pv[i] > y.pv[i];
        x.pm[i] = (x.pm[i] & more) | (y.pm[i] & ~more);
    }
    return x.v;
}

LANE_INLINE double v8_largest(v8 a)
{
    double r = a[0];
    for (int l = 1; l < LANES; l++) r = a[l] > r ? a[l] : r;
    return r;
}

LANE_INLINE double v8_sum(v8 a) /* one fixed order on every machine */
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

/* r[row][column] -> r[column][row] */
LANE_INLINE void v8_transpose(v8 r[8])
{
    v8 a[8], b[8];
    for (int k = 0; k < 4; k++) {
        a[2 * k] = __builtin_shufflevector(r[2 * k], r[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        a[2 * k + 1] = __builtin_shufflevector(r[2 * k], r[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int k = 0; k < 2; k++)
        for (int q = 0; q < 2; q++) {
            b[4 * k + q] = __builtin_shufflevector(a[4 * k + q], a[4 * k + q + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            b[4 * k + q + 2] = __builtin_shufflevector(a[4 * k + q], a[4 * k + q + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; k++) {
        r[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        r[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

/* ---- sqrt, exp, log of eight lanes: glibc's vector functions by their published names (x86 vector function ABI) ---- */

#include <math.h>

LANE_INLINE v8 v8_sqrt(v8 a)
{
    double t[LANES] __attribute__((aligned(64)));
    v8_store(t, a);
    for (int l = 0; l < LANES; l++) t[l] = sqrt(t[l]);
    return v8_load(t);
}

#if defined(__AVX512F__)
v8 _ZGVeN8v_exp(v8);
v8 _ZGVeN8v_log(v8);
LANE_INLINE v8 v8_exp(v8 a)
{
    return _ZGVeN8v_exp(a);
}
LANE_INLINE v8 v8_log(v8 a)
{
    return _ZGVeN8v_log(a);
}
#elif defined(__x86_64__)
#if defined(__AVX2__)
enum { LANES_MATH = 4 };
typedef double v_math __attribute__((vector_size(32)));
v_math _ZGVdN4v_exp(v_math);
v_math _ZGVdN4v_log(v_math);
#define V_MATH_EXP _ZGVdN4v_exp
#define V_MATH_LOG _ZGVdN4v_log
#else
enum { LANES_MATH = 2 };
typedef double v_math __attribute__((vector_size(16)));
v_math _ZGVbN2v_exp(v_math);
v_math _ZGVbN2v_log(v_math);
#define V_MATH_EXP _ZGVbN2v_exp
#define V_MATH_LOG _ZGVbN2v_log
#endif
typedef union {
    v8 all;
    v_math part[LANES / LANES_MATH];
} v8_parts;
LANE_INLINE v8 v8_exp(v8 a)
{
    v8_parts u = { a };
    for (int i = 0; i < LANES / LANES_MATH; i++) u.part[i] = V_MATH_EXP(u.part[i]);
    return u.all;
}
LANE_INLINE v8 v8_log(v8 a)
{
    v8_parts u = { a };
    for (int i = 0; i < LANES / LANES_MATH; i++) u.part[i] = V_MATH_LOG(u.part[i]);
    return u.all;
}
#else
LANE_INLINE v8 v8_exp(v8 a)
{
    for (int l = 0; l < LANES; l++) a[l] = exp(a[l]);
    return a;
}
LANE_INLINE v8 v8_log(v8 a)
{
    for (int l = 0; l < LANES; l++) a[l] = log(a[l]);
    return a;
}
#endif

#endif
