/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/fatigue.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

const char *const mpm_fatigue_measure_names[] = {
    [FATIGUE_BOND] = "bond", [FATIGUE_TENSION] = "tension", [FATIGUE_SHEAR] = "shear", NULL
};

/* ---- the law ---- */

fatigue_law mpm_fatigue_law(const material *m)
{
    return (fatigue_law){ m->fatigue_A, m->fatigue_m, isnan(m->fatigue_limit) ? 0.0 : m->fatigue_limit };
}

double mpm_fatigue_rate(const fatigue_law *law, double range)
{
    return range > law->limit ? law->A * pow(range, law->m) : 0.0;
}

double mpm_fatigue_cycles(const fatigue_law *law, double range)
{
    return 1.0 / mpm_fatigue_rate(law, range);
}

/* ---- directions ---- */

static void set_angle(fatigue_fan *fan, int k, double angle)
{
    fan->angle[k] = angle;
    fan->cosine[k] = cos(angle);
    fan->sine[k] = sin(angle);
}

static void make_sums_one(fatigue_fan *fan)
{
    double share = 0.0, stiffness = 0.0;
    for (int k = 0; k < fan->n; k++) share += fan->share[k], stiffness += fan->stiffness[k];
    for (int k = 0; k < fan->n; k++) fan->share[k] /= share, fan->stiffness[k] /= stiffness;
}

fatigue_fan mpm_fatigue_fan_even(int n)
{
    fatigue_fan fan = { .n = n };
    for (int k = 0; k < n; k++) {
        set_angle(&fan, k, PI * k / n);
        fan.share[k] = fan.stiffness[k] = 1.0;
    }
    make_sums_one(&fan);
    return fan;
}

/* The direction of the fan with this angle, a new one where there is none. */
static int direction_of(fatigue_fan *fan, double angle)
{
    for (int k = 0; k < fan->n; k++)
        if (fabs(fan->angle[k] - angle) < 1e-9) return k;
    set_angle(fan, fan->n, angle);
    return fan->n++;
}

fatigue_fan mpm_fatigue_fan_lattice(void)
{
    fatigue_fan fan = { .n = 0 };
    double isotropy[2] = { 0.0, 0.0 }; /* sum of stiffness cos 4 a: along the axes; elsewhere */
    for (int j = 0; j <= 3; j++)
        for (int i = -3; i <= 3; i++) {
            if (i * i + j * j > 3.015 * 3.015 || (j == 0 && i <= 0)) continue; /* a bond and its opposite are one */
            const double angle = atan2(j, i);
            const int k = direction_of(&fan, angle);
            fan.share[k] += 1.0;
            fan.stiffness[k] += hypot(i, j);
            isotropy[i != 0 && j != 0] += hypot(i, j) * cos(4.0 * angle);
        }
    for (int k = 0; k < fan.n; k++)
        if (fabs(fan.sine[k] * fan.cosine[k]) < 1e-9) fan.stiffness[k] *= -isotropy[1] / isotropy[0];
    make_sums_one(&fan);
    return fan;
}

/* ---- strain ---- */

double mpm_fatigue_strain(const fatigue_fan *fan, int k, fatigue_measure measure, double poisson,
                          const double strain[3])
{
    const double c = fan->cosine[k], s = fan->sine[k];
    if (measure == FATIGUE_SHEAR)
        return (2.0 * c * s * (strain[1] - strain[0]) + (c * c - s * s) * strain[2]) / (1.0 + poisson);
    return c * c * strain[0] + s * s * strain[1] + c * s * strain[2];
}

double mpm_fatigue_range(fatigue_measure measure, double least, double largest)
{
    const double up = fmax(largest, 0.0), down = fmin(least, 0.0);
    return measure == FATIGUE_TENSION ? up : up - down;
}
