/* SPDX-License-Identifier: BSD-3-Clause */
/* Lanes: points that are worked on together.  A block has eight; an instruction set takes them WIDTH at a time, as
 * many as its vectors have doubles, so a block is eight, four or two `vd` wide parts of one, two or four.  The same
 * source for all: gcc and clang turn comparisons and selects of a machine's own width into its compare and blend, but
 * take wider vectors apart into single numbers. */
#ifndef BREECH_MPM_LANES_H
#define BREECH_MPM_LANES_H

#include <math.h>
#include <stdint.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#if defined(__AVX512DQ__)
enum { WIDTH = 8 };
#elif defined(__AVX2__)
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif
enum { LANES = 8 };

typedef double vd __attribute__((vector_size(8 * WIDTH)));
typedef int64_t vm __attribute__((vector_size(8 * WIDTH))); /* all ones where true */

#define LANE_INLINE static inline __attribute__((always_inline))

/* Literals: gcc takes a loop that fills a vector apart. */
LANE_INLINE vd vd_set(double a)
{
#if defined(__AVX512DQ__)
    return (vd){ a, a, a, a, a, a, a, a };
#elif defined(__AVX2__)
    return (vd){ a, a, a, a };
#else
    return (vd){ a, a };
#endif
}

LANE_INLINE vd vd_load(const double *p) /* aligned like a vd */
{
    return *(const vd *)(const void *)p;
}

LANE_INLINE void vd_store(double *p, vd a)
{
    *(vd *)(void *)p = a;
}

LANE_INLINE vm vd_less(vd a, vd b)
{
    return a < b;
}

LANE_INLINE vd vd_select(vm mask, vd yes, vd no)
{
    return (vd)(((vm)yes & mask) | ((vm)no & ~mask));
}

LANE_INLINE vd vd_where(vm mask, vd yes) /* else zero */
{
    return (vd)((vm)yes & mask);
}

/* a < b ? a : b and a > b ? a : b, so b where one is not a number: the machine's own, which gcc does not see in the
 * selects. */
LANE_INLINE vd vd_min(vd a, vd b)
{
#if defined(__AVX512DQ__)
    return (vd)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX2__)
    return (vd)_mm256_min_pd((__m256d)a, (__m256d)b);
#elif defined(__x86_64__)
    return (vd)_mm_min_pd((__m128d)a, (__m128d)b);
#else
    return vd_select(a < b, a, b);
#endif
}

LANE_INLINE vd vd_max(vd a, vd b)
{
#if defined(__AVX512DQ__)
    return (vd)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX2__)
    return (vd)_mm256_max_pd((__m256d)a, (__m256d)b);
#elif defined(__x86_64__)
    return (vd)_mm_max_pd((__m128d)a, (__m128d)b);
#else
    return vd_select(a > b, a, b);
#endif
}

LANE_INLINE double vd_largest(vd a)
{
    double r = a[0];
    for (int l = 1; l < WIDTH; l++) r = a[l] > r ? a[l] : r;
    return r;
}

LANE_INLINE double vd_sum(vd a)
{
    double r[WIDTH];
    for (int l = 0; l < WIDTH; l++) r[l] = a[l];
    for (int n = WIDTH / 2; n > 0; n /= 2)
        for (int l = 0; l < n; l++) r[l] += r[l + n];
    return r[0];
}

/* Bit l: lane l is true. */
LANE_INLINE int vm_bits(vm a)
{
#if defined(__AVX512DQ__)
    return _mm512_movepi64_mask((__m512i)a);
#elif defined(__AVX2__)
    return _mm256_movemask_pd((__m256d)a);
#elif defined(__x86_64__)
    return _mm_movemask_pd((__m128d)a);
#else
    int r = 0;
    for (int l = 0; l < WIDTH; l++) r |= a[l] ? 1 << l : 0;
    return r;
#endif
}

/* r[row][column] -> r[column][row] */
LANE_INLINE void vd_transpose(vd r[WIDTH])
{
#if defined(__AVX512DQ__)
    vd a[8], b[8];
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
#elif defined(__AVX2__)
    vd a[4];
    for (int k = 0; k < 2; k++) {
        a[2 * k] = __builtin_shufflevector(r[2 * k], r[2 * k + 1], 0, 4, 2, 6);
        a[2 * k + 1] = __builtin_shufflevector(r[2 * k], r[2 * k + 1], 1, 5, 3, 7);
    }
    for (int k = 0; k < 2; k++) {
        r[k] = __builtin_shufflevector(a[k], a[k + 2], 0, 1, 4, 5);
        r[k + 2] = __builtin_shufflevector(a[k], a[k + 2], 2, 3, 6, 7);
    }
#else
    const vd a = r[0];
    r[0] = __builtin_shufflevector(a, r[1], 0, 2);
    r[1] = __builtin_shufflevector(a, r[1], 1, 3);
#endif
}

/* ---- sqrt, exp, log: glibc's vector functions by their published names (x86 vector function ABI) ---- */

LANE_INLINE vd vd_sqrt(vd a)
{
    for (int l = 0; l < WIDTH; l++) a[l] = sqrt(a[l]);
    return a;
}

#if defined(__x86_64__)
#if defined(__AVX512DQ__)
#define VD_MATH(name) _ZGVeN8v_##name
#elif defined(__AVX2__)
#define VD_MATH(name) _ZGVdN4v_##name
#else
#define VD_MATH(name) _ZGVbN2v_##name
#endif
vd VD_MATH(exp)(vd);
vd VD_MATH(log)(vd);
#define VD_FUNCTION(name)          \
    LANE_INLINE vd vd_##name(vd a) \
    {                              \
        return VD_MATH(name)(a);   \
    }
#else
#define VD_FUNCTION(name)                                  \
    LANE_INLINE vd vd_##name(vd a)                         \
    {                                                      \
        for (int l = 0; l < WIDTH; l++) a[l] = name(a[l]); \
        return a;                                          \
    }
#endif
VD_FUNCTION(exp)
VD_FUNCTION(log)

#endif
