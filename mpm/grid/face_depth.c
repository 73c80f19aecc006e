/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/grid/face_depth.h"

/* A hat of half width n, minus twice its middle and plus its ends, is a second difference of ramps, so three of them
 * folded are 27 ramps to the fifth power.  None may be so narrow that they cancel to nothing. */
static const double NARROWEST = 0.04;

void mpm_face_weight(const double n[3], double d, double *F, double *w)
{
    double m[3], scale = 1;
    for (int k = 0; k < 3; k++) m[k] = fmax(n[k], NARROWEST), scale *= m[k] * m[k];
    *F = *w = 0;
    if (d > 0) { /* the same from the other end: fewer ramps, less to cancel */
        mpm_face_weight(n, -d, F, w);
        *F = 1 - *F;
        return;
    }
    for (int i = 0; i < 27; i++) {
        const int at[3] = { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 };
        double x = d, sign = 1;
        for (int k = 0; k < 3; k++) x += at[k] * m[k], sign *= at[k] ? 1 : -2;
        if (x <= 0) continue;
        const double power = sign * x * x * x * x * x;
        *F += power * x / 720, *w += power / 120;
    }
    *F /= scale, *w /= scale;
}

/* Ratios at depths from one end of the weight to the other, which grow with the depth. */
enum { DEPTHS = 256 };

static void sample_ratios(const double n[3], double reach, double ratio[DEPTHS + 1])
{
    double last = 0;
    for (int i = 0; i <= DEPTHS; i++) {
        double F, w;
        mpm_face_weight(n, reach * (2.0 * i / DEPTHS - 1), &F, &w);
        const double end = i < DEPTHS / 2 ? 0 : HUGE_VAL; /* there rounding is all that is left of F and w */
        ratio[i] = last = fmax(w > 1e-9 ? F / w : end, last);
    }
}

/* A direction's row: what it has beyond the hat's depth.  By straight lines between the samples; beyond the weight's
 * end there is no face, and the end is the depth. */
static void make_row(const double n[3], double row[FACE_RATIOS + 1])
{
    const double reach = n[0] + n[1] + n[2];
    double ratio[DEPTHS + 1];
    sample_ratios(n, reach, ratio);
    for (int k = 0, i = 0; k <= FACE_RATIOS; k++) {
        const double r = face_ratio_at((double)k / FACE_RATIOS);
        while (i < DEPTHS && ratio[i + 1] <= r) i++;
        const double part = i < DEPTHS && isfinite(ratio[i + 1]) ? (r - ratio[i]) / (ratio[i + 1] - ratio[i]) : 0;
        row[k] = reach * (2 * (i + part) / DEPTHS - 1) - face_depth_aligned(r);
    }
}

void mpm_face_depths_make(face_depths *t)
{
    for (int j = 0; j < FACE_DIRECTIONS; j++)
        for (int k = 0; k <= FACE_RATIOS; k++) t->more[0][j][k] = 0;
    for (int i = 1; i < FACE_DIRECTIONS; i++)
        for (int j = 0; j < FACE_DIRECTIONS; j++) {
            const double u = (double)i / (FACE_DIRECTIONS - 1), v = u * j / (FACE_DIRECTIONS - 1);
            const double n1 = 1 / sqrt(1 + u * u + v * v);
            make_row((const double[3]){ n1, u * n1, v * n1 }, t->more[i][j]);
        }
}
