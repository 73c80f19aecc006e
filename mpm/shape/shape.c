/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/shape/shape.h"

/* Distance to the nearest edge; inside by the parity of the edges that a ray towards +x crosses. */
double mpm_shape_polygon(int n, const double *corner, double x, double y)
{
    double nearest2 = INFINITY;
    int inside = 0;
    for (int i = 0, j = n - 1; i < n; j = i++) {
        const double ax = corner[2 * j], ay = corner[2 * j + 1];
        const double ex = corner[2 * i] - ax, ey = corner[2 * i + 1] - ay;
        const double length2 = ex * ex + ey * ey;
        const double along = length2 > 0.0 ? ((x - ax) * ex + (y - ay) * ey) / length2 : 0.0;
        const double t = along > 1.0 ? 1.0 : along > 0.0 ? along : 0.0;
        const double dx = x - ax - t * ex, dy = y - ay - t * ey, distance2 = dx * dx + dy * dy;
        if (distance2 < nearest2) nearest2 = distance2;
        const int spans = (ay > y) != (corner[2 * i + 1] > y);
        if (spans && x < ax + (y - ay) / ey * ex) inside = !inside;
    }
    return inside ? sqrt(nearest2) : -sqrt(nearest2);
}

double mpm_shape_extrude(double profile, double slab)
{
    if (profile > 0.0 && slab > 0.0) return fmin(profile, slab);
    return -hypot(fmin(profile, 0.0), fmin(slab, 0.0));
}

/* With k = |(r / radius, y / height)|, the curved side is k = 1 and (1 - k) k / |grad(k^2 / 2)| the distance to first
 * order; below the flat side the nearest point is on it or at its corner. */
double mpm_shape_dome(double radius, double height, double r, double y)
{
    if (y < 0.0) return r <= radius ? y : -hypot(y, r - radius);
    const double k = hypot(r / radius, y / height);
    const double slope = hypot(r / (radius * radius), y / (height * height));
    const double curved = slope > 0.0 ? k * (1.0 - k) / slope : fmin(radius, height);
    return fmin(curved, y);
}

void mpm_shape_box_about(const double middle[3], const double down[3], const double up[3], double lo[3], double hi[3])
{
    for (int k = 0; k < 3; k++) lo[k] = middle[k] - down[k], hi[k] = middle[k] + up[k];
}
