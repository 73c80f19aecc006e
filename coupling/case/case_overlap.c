/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies that overlap: both would fill the same place. */
#include "coupling/case/case_bodies.h"

#include <math.h>

enum { LOOKS = 48 };                 /* along each axis of the box that two bodies share */
static const double TOUCHING = 1e-6; /* of the bodies' least extent: bodies that touch overlap by rounding */

typedef struct {
    double depth, at[3]; /* deepest place found in both [m] */
} overlap;

static overlap between(const mpm_solid *a, const mpm_solid *b)
{
    double one[2][3], other[2][3], lo[3], h[3], least = INFINITY;
    overlap found = { .depth = 0.0 };
    mpm_solid_bounds(a, one[0], one[1]);
    mpm_solid_bounds(b, other[0], other[1]);
    for (int k = 0; k < 3; k++) {
        lo[k] = fmax(one[0][k], other[0][k]);
        const double length = fmin(one[1][k], other[1][k]) - lo[k];
        if (!(length > 0.0)) return found;
        h[k] = length / LOOKS;
        least = fmin(least, fmin(one[1][k] - one[0][k], other[1][k] - other[0][k]));
    }
    for (int i = 0; i < LOOKS * LOOKS * LOOKS; i++) {
        const int at[3] = { i / (LOOKS * LOOKS), i / LOOKS % LOOKS, i % LOOKS };
        double x[3];
        for (int k = 0; k < 3; k++) x[k] = lo[k] + (at[k] + 0.5) * h[k];
        const double depth = fmin(mpm_solid_inside(a, x), mpm_solid_inside(b, x));
        if (depth > fmax(found.depth, TOUCHING * least)) found = (overlap){ depth, { x[0], x[1], x[2] } };
    }
    return found;
}

void case_overlap_check(case_reader *r, const tree_node *list)
{
    const mpm_scene *s = &r->out->bodies.scene;
    for (int b = 1; b < s->bodies; b++)
        for (int a = 0; a < b; a++) {
            const overlap o = between(&s->solid[s->body[a].solid], &s->solid[s->body[b].solid]);
            if (!(o.depth > 0.0)) continue;
            case_errors_add(
                r->errors, host_tree_find(case_entry_node(list, b), "shape"),
                "scene.bodies[%d].shape: %s overlaps %s by %.3g m or more at [%.4g, %.4g, %.4g] m: move one, "
                "cut it out with `minus`, or give the later one what both claim (scene.overlap: later)",
                b, s->body[b].name, s->body[a].name, o.depth, o.at[0], o.at[1], o.at[2]);
        }
}
