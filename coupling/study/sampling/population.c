/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/sampling/population.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static const double TAIL = 0.02; /* share of the grains beyond the last class at each end [1] */
enum { PER_DECADE = 10 };

static double deviation(const case_population *p, double radius)
{
    return log(radius / p->radius_median) / p->radius_spread;
}

static double sum_of_shares(const case_sizes *s, int from)
{
    double sum = 0.0;
    for (int i = from; i < s->n; i++) sum += s->item[i].share;
    return sum;
}

double study_population_share_from(const case_population *p, double radius)
{
    int k = 0;
    if (p->sizes.n == 0 && !(p->radius_spread > 0.0)) return radius <= p->radius_median ? 1.0 : 0.0;
    if (p->sizes.n == 0) return gsl_cdf_ugaussian_Q(deviation(p, radius));
    while (k < p->sizes.n && p->sizes.item[k].radius < radius) k++;
    return sum_of_shares(&p->sizes, k) / sum_of_shares(&p->sizes, 0);
}

double study_population_quantile(const case_population *p, double share)
{
    if (p->sizes.n == 0) return p->radius_median * exp(p->radius_spread * gsl_cdf_ugaussian_Pinv(share));
    int k = 0;
    const double all = sum_of_shares(&p->sizes, 0);
    while (k + 1 < p->sizes.n && sum_of_shares(&p->sizes, k + 1) > (1.0 - share) * all) k++;
    return p->sizes.item[k].radius;
}

static status tabulated(const case_population *p, double smallest, double grains, population_sizes *out)
{
    const double all = sum_of_shares(&p->sizes, 0);
    int n = 0;
    for (int i = 0; i < p->sizes.n; i++) {
        const case_size *s = &p->sizes.item[i];
        if (s->radius < smallest || !(s->share > 0.0)) continue;
        if (n < POPULATION_MAX_SIZES) {
            out->size[n] = s->radius;
            out->number[n] = grains * s->share / all;
        }
        n++;
    }
    CHECK(n <= POPULATION_MAX_SIZES, STATUS_BAD_INPUT,
          "sizes: %d of a share and at least study.smallest_radius = %g m, may be at most %d: join some", n, smallest,
          POPULATION_MAX_SIZES);
    out->n = n;
    return status_ok();
}

static double series(double i)
{
    return pow(10.0, i / PER_DECADE);
}

status study_population_sizes(const case_population *p, double smallest, population_sizes *out)
{
    out->n = 0;
    const double grains = p->density * (p->to - p->from);
    if (p->sizes.n > 0) return tabulated(p, smallest, grains, out);
    if (!(study_population_share_from(p, smallest) > 0.0)) return status_ok();
    const double low = fmax(smallest, study_population_quantile(p, TAIL)),
                 high = study_population_quantile(p, 1.0 - TAIL);
    const int first = (int)ceil(PER_DECADE * log10(low) - 1e-6);
    const int last = (int)fmax(floor(PER_DECADE * log10(high) + 1e-6), first);
    int n = 0;
    for (int i = first; i <= last && n < POPULATION_MAX_SIZES; i++, n++) {
        const bool open = i == last || n + 1 == POPULATION_MAX_SIZES;
        const double from = i == first ? smallest : series(i - 0.5);
        out->size[n] = series(i);
        out->number[n] = grains * (study_population_share_from(p, from) -
                                   (open ? 0.0 : study_population_share_from(p, series(i + 0.5))));
    }
    out->n = n;
    return status_ok();
}
