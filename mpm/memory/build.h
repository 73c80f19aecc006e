/* SPDX-License-Identifier: BSD-3-Clause */
/* From bodies to material points. */
#ifndef BREECH_MPM_BUILD_H
#define BREECH_MPM_BUILD_H

#include "mpm/grid/grid.h"
#include "mpm/law/law.h"
#include "mpm/mpm.h"

typedef struct {
    double x[3], v[3], half[3]; /* [m, m/s, m] */
    double L[9], ka;            /* velocity gradient dv_i/dx_k at 3 i + k, and its kinetic energy [1/s, J/kg] */
    double mass, area;          /* [kg]; face under the body's traction [m2] */
} build_point;

typedef struct {
    status (*point)(void *user, int body, const build_point *p);
    void *user; /* borrowed */
} build_sink;

/* Between two places on an axis [m]. */
typedef struct {
    int along;
    double lo, hi;
} build_range;

extern const build_range mpm_build_everywhere; /* all that lies in the window */

/* Calls the sink for every material point of one body in a range, in a fixed order. */
status mpm_build_body(const mpm_scene *s, int body, const law *k, const grids *g, const build_range *range,
                      const build_sink *sink);

/* The same in a sample of about `most` boxes of the body's lattice, evenly at random and always the same ones; *share:
 * of all of them, 1 where they are fewer.  Of a body that spins the points have the velocity of its middle. */
status mpm_build_sample(const mpm_scene *s, int body, const law *k, const grids *g, double most, const build_sink *sink,
                        double *share);

/* Does a traction or a wave act on its surface towards traction_face? */
bool mpm_build_is_loaded(const mpm_body *b);

/* Largest speed of a body's points at the start that its spin gives [m/s]. */
double mpm_build_spin_speed(const mpm_scene *s, int body);

#endif
