/* SPDX-License-Identifier: BSD-3-Clause */
/* How deep a node lies below a body's face, from two sums over the body's points.
 *
 * The volume and the area of the face that belong to a node are integrals of its weight, which for GIMP is a hat along
 * each axis, over the body and over its face.  Of a body with a plane face whose outward normal is n
 *
 *   V = B h F(d),   A = B w(d),   F(d) = integral of w from -infinity to d,
 *
 * with d the depth of the node below the face and w the weight projected on n, both in units of the cell's width h
 * along n.  B is the part of the cell's section that the body takes; it cancels in
 *
 *   r = V/(A h) = F(d)/w(d),                                                                       (N-13)
 *
 * so that the end of a face reads as the face itself.  r grows with d.  A table over the direction of n turns it round;
 * it is made from the closed form of the projected weight: three hats, as wide as the normal's components, folded. */
#ifndef BREECH_MPM_FACE_DEPTH_H
#define BREECH_MPM_FACE_DEPTH_H

#include <math.h>

enum { FACE_DIRECTIONS = 9, FACE_RATIOS = 64 };

typedef struct face_depths {
    double more[FACE_DIRECTIONS][FACE_DIRECTIONS][FACE_RATIOS + 1]; /* d beyond that of a face across an axis, by n2/n1,
                                                                       n3/n2, n1 >= n2 >= n3, and face_ratio_at [1] */
} face_depths;

void mpm_face_depths_make(face_depths *t);

/* F(d) and w(d) of the hat's weight across a normal with these components >= 0 of length 1. */
void mpm_face_weight(const double n[3], double d, double *F, double *w);

/* Place on a table's axis of n intervals: its interval and what is left. */
static inline double face_place(double x, int n, int *i)
{
    const double at = fmin(fmax(x, 0), 1) * n;
    *i = at < n ? (int)at : n - 1;
    return at - *i;
}

/* Where a ratio stands in the table, 0 .. 1, and back: fine enough where r is large and d nearly its end. */
static inline double face_ratio_place(double r)
{
    const double s = cbrt(r);
    return s / (s + 0.8);
}

static inline double face_ratio_at(double place)
{
    const double s = 0.8 * place / (1 - place);
    return s * s * s;
}

/* d of a face across an axis, the hat itself: exact, so that faces along the grid touch to rounding. */
static inline double face_depth_aligned(double r)
{
    if (!(r < 1e9)) return 1;
    return r < 0.5 ? 2 * r - 1 : 1 + r - sqrt(r * r + 2);
}

/* d for components >= 0 of any order and of length 1 (of the normal times the cell's sizes, over their length). */
static inline double face_depth(const face_depths *t, const double n[3], double r)
{
    const double a = fmax(n[0], n[1]), b = fmin(n[0], n[1]);
    const double n1 = fmax(a, n[2]), n3 = fmin(b, n[2]), n2 = fmax(fmin(a, n[2]), b);
    int i, j, k;
    const double u = face_place(n2 / n1, FACE_DIRECTIONS - 1, &i),
                 v = face_place(n2 > 0 ? n3 / n2 : 0, FACE_DIRECTIONS - 1, &j);
    const double q = face_place(face_ratio_place(r), FACE_RATIOS, &k);
    double s = face_depth_aligned(r);
    for (int c = 0; c < 4; c++) {
        const double *row = t->more[i + c % 2][j + c / 2];
        s += (c % 2 ? u : 1 - u) * (c / 2 ? v : 1 - v) * ((1 - q) * row[k] + q * row[k + 1]);
    }
    return s;
}

#endif
