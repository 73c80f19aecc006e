/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/fatigue.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>

const char *const mpm_fatigue_measure_names[] = {
    [FATIGUE_BOND] = "bond", [FATIGUE_TENSION] = "tension", [FATIGUE_SHEAR] = "shear", NULL
};

/* ---- the law ---- */

fatigue_law mpm_fatigue_law(const mpm_material *m)
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

void mpm_fatigue_take(const fatigue_fan *fan, fatigue_measure measure, double poisson, const double strain[3],
                      fatigue_extremes *of)
{
    for (int k = 0; k < fan->n; k++) {
        const double is = mpm_fatigue_strain(fan, k, measure, poisson, strain);
        of->least[k] = fmin(of->least[k], is);
        of->largest[k] = fmax(of->largest[k], is);
    }
}

double mpm_fatigue_range(fatigue_measure measure, double least, double largest)
{
    const double up = fmax(largest, 0.0), down = fmin(least, 0.0);
    return measure == FATIGUE_TENSION ? up : up - down;
}

/* ---- many points ---- */

static const double AT_ONCE = 1e-9; /* cuts that lie no further apart, over the cycles, are one event */

status mpm_fatigue_create(int points, const fatigue_fan *fan, const fatigue_law *law, fatigue_points *out)
{
    const size_t n = (size_t)points * (size_t)fan->n;
    *out = (fatigue_points){ .points = points, .fan = *fan, .law = *law };
    out->life = malloc((2 * n + (size_t)points) * sizeof *out->life);
    out->is_cut = calloc(n, sizeof *out->is_cut);
    out->cut = malloc(n * sizeof *out->cut);
    if (!out->life || !out->is_cut || !out->cut) {
        mpm_fatigue_free(out);
        return base_status_error(STATUS_MEMORY, "no memory for the directions of %d points", points);
    }
    out->rate = out->life + n, out->index = out->rate + n;
    for (size_t i = 0; i < n; i++) out->life[i] = 1.0, out->rate[i] = 0.0;
    for (int i = 0; i < points; i++) out->index[i] = 0.0;
    return status_ok();
}

void mpm_fatigue_free(fatigue_points *f)
{
    free(f->life);
    free(f->is_cut);
    free(f->cut);
    *f = (fatigue_points){ .points = 0 };
}

void mpm_fatigue_set_range(fatigue_points *f, int point, int k, double range)
{
    f->rate[(size_t)point * (size_t)f->fan.n + (size_t)k] = mpm_fatigue_rate(&f->law, range);
}

/* Cycles that direction i of all has left; one that is cut, and one that loses nothing, lasts for ever. */
static double left(const fatigue_points *f, size_t i)
{
    return f->is_cut[i] || f->rate[i] == 0.0 ? INFINITY : f->life[i] / f->rate[i];
}

double mpm_fatigue_wait(const fatigue_points *f)
{
    const size_t n = (size_t)f->points * (size_t)f->fan.n;
    double least = INFINITY;
    for (size_t i = 0; i < n; i++) least = fmin(least, left(f, i));
    return least;
}

/* By time, at the same time by their places. */
static int by_cycles(const void *a, const void *b)
{
    const fatigue_cut *one = a, *two = b;
    if (one->cycles != two->cycles) return one->cycles < two->cycles ? -1 : 1;
    if (one->point != two->point) return one->point < two->point ? -1 : 1;
    return (one->direction > two->direction) - (one->direction < two->direction);
}

status mpm_fatigue_jump(fatigue_points *f, double batch)
{
    const size_t n = (size_t)f->points * (size_t)f->fan.n;
    const double wait = mpm_fatigue_wait(f), next = f->cycles + wait;
    const int before = f->n_cuts;
    CHECK(isfinite(wait), STATUS_BAD_INPUT, "no direction is ever cut: all ranges lie below the fatigue limit");
    double last = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double own = left(f, i);
        if (f->cycles + own > next * (1.0 + batch) * (1.0 + AT_ONCE)) continue;
        f->cut[f->n_cuts++] =
            (fatigue_cut){ (int)(i / (size_t)f->fan.n), (int)(i % (size_t)f->fan.n), f->cycles + own };
        last = fmax(last, own);
    }
    for (size_t i = 0; i < n; i++) f->life[i] = fmax(0.0, f->life[i] - f->rate[i] * last);
    f->cycles += last;
    qsort(f->cut + before, (size_t)(f->n_cuts - before), sizeof *f->cut, by_cycles);
    for (int c = before; c < f->n_cuts; c++) {
        const fatigue_cut *cut = &f->cut[c];
        const size_t i = (size_t)cut->point * (size_t)f->fan.n + (size_t)cut->direction;
        f->is_cut[i] = true;
        f->life[i] = 0.0;
        f->index[cut->point] += f->fan.share[cut->direction];
    }
    return status_ok();
}

double mpm_fatigue_alone(const fatigue_points *f, int point, double limit)
{
    const size_t first = (size_t)point * (size_t)f->fan.n;
    double waits[FATIGUE_MAX_DIRECTIONS], share = f->index[point];
    bool used[FATIGUE_MAX_DIRECTIONS];
    if (share >= limit - AT_ONCE) return f->cycles;
    for (int k = 0; k < f->fan.n; k++) waits[k] = left(f, first + (size_t)k), used[k] = f->is_cut[first + (size_t)k];
    for (;;) {
        int next = -1;
        for (int k = 0; k < f->fan.n; k++)
            if (!used[k] && (next < 0 || waits[k] < waits[next])) next = k;
        if (next < 0) return INFINITY;
        used[next] = true;
        share += f->fan.share[next];
        if (share >= limit - AT_ONCE) return f->cycles + waits[next];
    }
}
